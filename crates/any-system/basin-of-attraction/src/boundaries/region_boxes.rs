//! Boxes of a region of any dimension, each labelled at random points.

use crate::boundaries::boxes::BoxCount;
use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Divides every side of a region by `divisions`, and counts the boxes by the labels of `points` random points in each.
///
/// [`BoxCount::size`] is 1/`divisions`, the side of a box over that of the region. A basin that no point of a box
/// meets is not seen: the number of mixed boxes is a lower bound. The entropy of a box of f basins is too small by
/// about (f − 1)/(2 `points`) in the mean. Without many points the entropies of small boxes cannot be compared with
/// those of large ones, which all have as many.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, Label, region_boxes};
/// let cube = Hyperrectangle::new(vec![Interval::new(0.0, 1.0)?; 3])?;
/// let count = region_boxes(&cube, 5, 200, 1, |x| Label::from(x[2] > 0.5))?;
/// assert_eq!((count.boxes, count.mixed), (125, 25));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooManySamples`] for more than a billion points of all boxes together; [`Error::BadTrials`] for no
/// divisions or no points.
pub fn region_boxes(
    region: &Hyperrectangle,
    divisions: usize,
    points: usize,
    seed: u64,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<BoxCount, Error> {
    if divisions == 0 || points == 0 {
        return Err(Error::BadTrials { successes: 0, trials: 0 });
    }
    let dimension = u32::try_from(region.dimension()).unwrap_or(u32::MAX);
    let boxes = divisions.checked_pow(dimension).unwrap_or(usize::MAX);
    check_count(boxes.saturating_mul(points))?;
    let random = SplitMix64::from_seed(seed);
    let of_box = |number: usize| -> Result<BoxCount, Error> {
        let mut rest = number;
        let side = |side: &Interval| {
            let at = |k: usize| side.left + side.length() * (k as f64 / divisions as f64);
            let k = rest % divisions;
            rest /= divisions;
            Interval { left: at(k), right: at(k + 1) }
        };
        let part = Hyperrectangle::new(region.sides().iter().map(side).collect())?;
        let mut basins: BTreeMap<Label, f64> = BTreeMap::new();
        let (mut undecided, mut inside) = (false, false);
        for k in 0..points {
            let found = label(&part.random_point(&random, (number * points + k) as u64));
            undecided |= found.is_undecided();
            inside |= !found.is_outside();
            if found.is_decided() {
                *basins.entry(found).or_insert(0.0) += 1.0;
            }
        }
        let mut count = BoxCount::new(1.0 / divisions as f64);
        if inside {
            count.count(&basins, undecided);
        }
        Ok(count)
    };
    // Sums of entropies are added in the order of the boxes, so that the result does not depend on the number of
    // threads.
    let all: Vec<BoxCount> =
        (0..boxes).into_par_iter().map(of_box).collect::<Result<_, Error>>()?;
    let mut sum = BoxCount::new(1.0 / divisions as f64);
    for one in &all {
        sum.boxes += one.boxes;
        sum.mixed += one.mixed;
        sum.open += one.open;
        sum.half_open += one.half_open;
        sum.entropy += one.entropy;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_a_line_a_square_and_a_cube_are_counted() {
        for dimension in 1..4 {
            let unit = Interval { left: 0.0, right: 1.0 };
            let region = Hyperrectangle::new(vec![unit; dimension]).unwrap();
            let label = |x: &[f64]| match x[0] {
                ..0.2 => Label::UNDECIDED,
                0.2..0.3 => Label::OUTSIDE,
                _ => Label::from(x[0] > 0.55),
            };
            let count = region_boxes(&region, 10, 50, 1, label).unwrap();
            let layer = 10u64.pow(dimension as u32 - 1);
            assert_eq!(
                (count.boxes, count.mixed, count.open, count.half_open),
                (9 * layer, layer, 2 * layer, 0)
            );
            assert!((count.boundary_entropy().unwrap() - std::f64::consts::LN_2).abs() < 0.2);
        }
        let line = Hyperrectangle::try_from(Interval { left: 0.0, right: 1.0 }).unwrap();
        let one = |_: &[f64]| Label::from(0);
        assert!(region_boxes(&line, 0, 1, 1, one).is_err());
        assert!(region_boxes(&line, 1, 0, 1, one).is_err());
        assert!(region_boxes(&line, usize::MAX, 2, 1, one).is_err());
    }
}
