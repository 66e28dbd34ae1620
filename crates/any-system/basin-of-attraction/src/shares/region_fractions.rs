//! Basin fractions of a region of any dimension from random points.

use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::label::Label;
use crate::statistics::confidence_interval::{ConfidenceInterval, open_proportion};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Random points of a region, counted by their labels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelCounts {
    counts: BTreeMap<Label, usize>,
    /// Points inside the region of interest, decided or not.
    inside: usize,
    undecided: usize,
}

impl LabelCounts {
    /// Counts labels.
    ///
    /// # Errors
    /// [`Error::NothingInside`] if no label is inside the region of interest.
    pub fn new(labels: impl IntoIterator<Item = Label>) -> Result<Self, Error> {
        let mut counts: BTreeMap<Label, usize> = BTreeMap::new();
        for label in labels {
            *counts.entry(label).or_insert(0) += 1;
        }
        let sum = |condition: fn(Label) -> bool| {
            let own = counts.iter().filter(|(label, _)| condition(**label));
            own.map(|(_, count)| count).sum::<usize>()
        };
        let (outside, undecided) = (sum(Label::is_outside), sum(Label::is_undecided));
        let points: usize = counts.values().sum();
        if points == outside {
            return Err(Error::NothingInside { points });
        }
        Ok(LabelCounts { counts, inside: points - outside, undecided })
    }

    /// The basins that were seen.
    pub fn basins(&self) -> impl Iterator<Item = Label> + '_ {
        self.counts.keys().copied().filter(|label| label.is_decided())
    }

    /// The number of points with a label.
    pub fn count(&self, label: Label) -> usize {
        self.counts.get(&label).copied().unwrap_or(0)
    }

    /// The number of points inside the region of interest.
    pub fn inside(&self) -> usize {
        self.inside
    }

    /// The number of points without a known basin.
    pub fn undecided(&self) -> usize {
        self.undecided
    }

    /// The fraction of a basin, with a 95 % interval, also of one without points.
    ///
    /// An undecided point may belong to any basin. The interval begins at the lower end of [`proportion_interval`](crate::proportion_interval)
    /// for the points of the basin, and ends at the upper end for these and all undecided points. The value counts
    /// no undecided point.
    ///
    /// # Errors
    /// None for points inside the region of interest, of which [`new`](Self::new) demands one.
    pub fn fraction(&self, label: Label) -> Result<ConfidenceInterval, Error> {
        let found = self.count(label);
        let open = if label.is_decided() { self.undecided } else { 0 };
        open_proportion(found, open, self.inside)
    }
}

/// The labels of `count` independent random points of a region of any dimension.
///
/// The points are uniform in the region. The same seed gives the same points, with any number of threads. Points
/// with the label [`Label::OUTSIDE`] are not counted: so fractions of a disc, or of any other part of the region,
/// are found.
///
/// If the region is that of the shocks of interest, the fraction of an attractor's basin is its *basin stability*
/// (P. J. Menck, J. Heitzig, N. Marwan, J. Kurths, Nat. Phys. 9, 89, 2013).
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, Label, region_fractions};
/// let cube = Hyperrectangle::new(vec![Interval::new(-1.0, 1.0)?; 3])?;
/// let ball = |x: &[f64]| Label::from(x.iter().map(|x| x * x).sum::<f64>() < 1.0);
/// let volume = region_fractions(&cube, 10_000, 1, ball)?.fraction(Label::from(1))?;
/// assert!(volume.covers(std::f64::consts::PI / 6.0) && volume.half_width() < 0.01);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooManySamples`] for more than a billion points; [`Error::NothingInside`] if no point is inside the
/// region of interest, also for a `count` of 0.
pub fn region_fractions(
    region: &Hyperrectangle,
    count: usize,
    seed: u64,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<LabelCounts, Error> {
    check_count(count)?;
    let random = SplitMix64::from_seed(seed);
    let one = |k: usize| label(&region.random_point(&random, k as u64));
    LabelCounts::new((0..count).into_par_iter().map(one).collect::<Vec<Label>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;

    fn square() -> Hyperrectangle {
        Hyperrectangle::new(vec![Interval { left: 0.0, right: 1.0 }; 2]).unwrap()
    }

    #[test]
    fn fractions_count_undecided_points_as_open_and_leave_out_points_outside() {
        let label = |x: &[f64]| match x[0] {
            ..0.5 => Label::OUTSIDE,
            ..0.6 => Label::UNDECIDED,
            ..0.8 => Label::from(0),
            _ => Label::from(1),
        };
        let found = region_fractions(&square(), 40_000, 2, label).unwrap();
        assert!((found.inside() as f64 - 20_000.0).abs() < 600.0);
        let [zero, one] = [0, 1].map(|n| found.fraction(Label::from(n)).unwrap());
        assert!((zero.value - 0.4).abs() < 0.02 && zero.lower > 0.38 && zero.upper > 0.59);
        assert!((one.value - 0.4).abs() < 0.02 && one.upper < 0.63);
        // A basin without points may have all undecided ones.
        let none = found.fraction(Label::from(7)).unwrap();
        assert!(none.value == 0.0 && none.lower == 0.0 && none.upper > 0.2);
        assert_eq!(found.basins().collect::<Vec<_>>(), [Label::from(0), Label::from(1)]);
        let outside = region_fractions(&square(), 10, 2, |_| Label::OUTSIDE);
        assert_eq!(outside, Err(Error::NothingInside { points: 10 }));
        assert_eq!(
            region_fractions(&square(), 0, 2, label),
            Err(Error::NothingInside { points: 0 })
        );
    }

    /// Of 1000 intervals of 95 %, 930 to 970 contain the true fraction.
    #[test]
    fn intervals_of_a_region_cover_the_fraction_as_often_as_stated() {
        let disc = |x: &[f64]| Label::from((x[0] - 0.5).powi(2) + (x[1] - 0.5).powi(2) < 0.09);
        let truth = std::f64::consts::PI * 0.09;
        let covers = |seed: &u64| {
            let found = region_fractions(&square(), 500, *seed, disc).unwrap();
            found.fraction(Label::from(1)).unwrap().covers(truth)
        };
        let covered = (0..1000).filter(covers).count();
        assert!((930..=970).contains(&covered), "{covered}");
    }
}
