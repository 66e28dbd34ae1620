//! How stable attractors are against random shocks: fractions, times and distances, in one pass.

use crate::boundaries::boundary_between::boundary_between;
use crate::error::Error;
use crate::features::metric::Metric;
use crate::shares::region_fractions::LabelCounts;
use crate::space::label::Label;
use crate::space::vectors::check_dimension;
use crate::space::vectors::check_point;
use crate::statistics::confidence_interval::{
    ConfidenceInterval, open_proportion, student_interval,
};
use std::collections::BTreeMap;

/// What random starts show of the stability of each attractor.
///
/// A start is a shock to each attractor: the displacement from the nearest of its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Stability {
    counts: LabelCounts,
    attractors: BTreeMap<Label, AttractorStability>,
    metric: Metric,
}

/// The stability of one attractor, by random starts.
///
/// The pace of convergence, time over size of shock, is not here. Inside the cells of an attractor, or its distance, the time is 0, so that the pace of
/// small shocks is a property of the cells; without them it grows like ln(1/r)/r, which has no mean on the line and no variance in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct AttractorStability {
    /// The fraction of its basin, with a 95 % interval that counts undecided starts in its upper end: basin stability (P. J. Menck et al. 2013).
    pub fraction: ConfidenceInterval,
    /// The mean time of convergence in its basin, with Student's 95 % interval, which holds for many starts; `None` for fewer than two.
    pub mean_time: Option<ConfidenceInterval>,
    /// The start that took longest; `None` without starts in its basin.
    pub longest: Option<LongestTime>,
    /// The smallest fatal shock that was found, to another basin or beyond escape: an upper bound on the smallest one, with its end as a witness.
    pub fatal: Option<Shock>,
    /// The largest harmless shock that was found: a lower bound on the largest one, with its end as a witness.
    pub harmless: Option<Shock>,
    /// The mean size of harmless shocks, with Student's 95 % interval; `None` for fewer than two.
    pub mean_harmless: Option<ConfidenceInterval>,
    /// The sizes of all shocks in increasing order, each with the numbers of fatal and of undecided ones up to there.
    shocks: Vec<(f64, [usize; 2])>,
    /// The times in its basin, in increasing order.
    times: Vec<usize>,
    /// The steps of undecided starts, and the number of all starts.
    undecided: Vec<usize>,
    inside: usize,
}

/// The longest time that was seen.
#[derive(Debug, Clone, PartialEq)]
pub struct LongestTime {
    /// The steps.
    pub steps: usize,
    /// The start.
    pub start: Vec<f64>,
    /// At most this share of the basin takes longer, in 95 of 100 cases.
    pub longer: f64,
}

/// A shock, and where it leads.
#[derive(Debug, Clone, PartialEq)]
pub struct Shock {
    /// Its size.
    pub size: f64,
    /// The nearest point of the attractor, where it begins.
    pub from: Vec<f64>,
    /// The state after it.
    pub state: Vec<f64>,
    /// The label of this state.
    pub label: Label,
}

/// No share of random starts was seen in n of them: it is below 1 − 0.05^(1/n) in 95 of 100 cases.
const UNSEEN: f64 = 0.05;

impl Stability {
    /// The stability of attractors with these points. `starts` are independent random points of the region of shocks, and `found` has their labels and
    /// times, as [`Attractors::convergences`](crate::Attractors::convergences) gives them.
    ///
    /// Distances are Euclidean; [`with_distance`](Self::with_distance) takes any. An attractor without points, or without one that has a distance from a
    /// start, has times, and no shocks.
    ///
    /// ```
    /// use basin_of_attraction::{Attractors, Interval, Label, RecurrenceLimits, SplitMix64, Stability, StateGrid, array_map};
    /// // 3x/2 − x³/2 has the attractors ±1, and 0 is between their basins.
    /// let cubic = array_map(|[x]| Some([1.5 * x - 0.5 * x * x * x]));
    /// let grid = StateGrid::uniform(Interval::new(-1.7, 1.6)?.try_into()?, 100)?;
    /// let found = Attractors::search(&cubic, grid, &[vec![0.3], vec![-0.3]], RecurrenceLimits::default())?;
    /// let random = SplitMix64::from_seed(1);
    /// let starts: Vec<Vec<f64>> = (0..1000).map(|k| vec![3.0 * random.uniform(k) - 1.5]).collect();
    /// let times = found.convergences(&cubic, 1000, |k, state| state.copy_from_slice(&starts[k]))?;
    /// let mut stability = Stability::new(&found.positions(), &starts, &times)?;
    /// stability.shorten_fatal_shocks(1e-9, |state| found.label(&cubic, state))?;
    /// let right = stability.of(Label::from(1)).expect("an attractor");
    /// assert!(right.fraction.covers(0.5));
    /// assert!((right.fatal.as_ref().expect("a shock").size - 1.0).abs() < 1e-8);
    /// // Of all shocks up to 0.9 less than one in a hundred is fatal.
    /// assert!(right.fatal_share(0.9)?.upper < 0.01);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NothingInside`] without starts in the region of interest; [`Error::BadPoint`] for a coordinate that is not finite; [`Error::WrongDimension`] for another number of labels than starts, and for
    /// points of different dimensions.
    pub fn new(
        attractors: &BTreeMap<Label, Vec<Vec<f64>>>,
        starts: &[Vec<f64>],
        found: &[(Label, usize)],
    ) -> Result<Stability, Error> {
        Stability::with_distance(attractors, starts, found, Metric::euclidean())
    }

    /// The same with another distance, such as the short way round an angle.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_distance(
        attractors: &BTreeMap<Label, Vec<Vec<f64>>>,
        starts: &[Vec<f64>],
        found: &[(Label, usize)],
        metric: Metric,
    ) -> Result<Stability, Error> {
        check_dimension(found.len(), starts.len())?;
        let dimension = starts.first().map_or(0, Vec::len);
        let all = || attractors.values().flatten().chain(starts);
        all().try_for_each(|point| check_dimension(point.len(), dimension))?;
        all().try_for_each(|point| check_point(point))?;
        let counts = LabelCounts::new(found.iter().map(|(label, _)| *label))?;
        let inside = || starts.iter().zip(found).filter(|(_, (label, _))| !label.is_outside());
        let own = |(&label, points): (&Label, &Vec<Vec<f64>>)| {
            let nearest = |start: &[f64]| {
                let all = points.iter().map(|point| (metric.distance(point, start), point));
                all.filter(|(size, _)| !size.is_nan()).min_by(|a, b| a.0.total_cmp(&b.0))
            };
            let shocks = inside().filter_map(|(state, &(label, _))| {
                let (size, from) = nearest(state)?;
                Some(Shock { size, from: from.clone(), state: state.clone(), label })
            });
            let times: Vec<_> = inside().map(|(state, time)| (state.as_slice(), *time)).collect();
            Ok((label, AttractorStability::of(label, &counts, &times, shocks.collect())?))
        };
        let attractors = attractors.iter().map(own).collect::<Result<_, Error>>()?;
        Ok(Stability { counts, attractors, metric })
    }

    /// The stability of an attractor; `None` for another label.
    pub fn of(&self, label: Label) -> Option<&AttractorStability> {
        self.attractors.get(&label)
    }

    /// All attractors by their labels.
    pub fn attractors(&self) -> &BTreeMap<Label, AttractorStability> {
        &self.attractors
    }

    /// The numbers of starts with each label.
    pub fn counts(&self) -> &LabelCounts {
        &self.counts
    }

    /// Shortens the smallest fatal shock of each attractor, by bisection along it, to a precision: to the edge of the basin on this line.
    /// [`minimal_fatal_shock`](crate::minimal_fatal_shock) also changes the direction.
    ///
    /// # Errors
    /// As [`boundary_between`], but for shocks whose beginning, the nearest point of the attractor, has another label than the attractor.
    pub fn shorten_fatal_shocks(
        &mut self,
        precision: f64,
        label: impl Fn(&[f64]) -> Label,
    ) -> Result<(), Error> {
        let metric = &self.metric;
        for own in self.attractors.values_mut() {
            let Some(fatal) = &mut own.fatal else { continue };
            match boundary_between(&fatal.from, &fatal.state, precision, &label) {
                Ok(found) => {
                    let (state, label) = found.second;
                    let size = metric.distance(&fatal.from, &state);
                    // By another distance than the Euclidean one the straight line may be the long way.
                    if size < fatal.size {
                        (fatal.size, fatal.state, fatal.label) = (size, state, label);
                    }
                }
                Err(Error::NotTwoBasins { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

impl AttractorStability {
    /// From the labels and times of all starts, and from all shocks: there are fewer of these if the attractor has no points, or none with a distance.
    fn of(
        label: Label,
        counts: &LabelCounts,
        starts: &[(&[f64], (Label, usize))],
        shocks: Vec<Shock>,
    ) -> Result<AttractorStability, Error> {
        let own = || starts.iter().filter(|(_, (own, _))| *own == label);
        let mut times: Vec<usize> = own().map(|(_, (_, steps))| *steps).collect();
        times.sort_unstable();
        // Student's interval exists from two on.
        let mean = |of: Vec<f64>| (of.len() > 1).then(|| student_interval(&of)).transpose();
        let mean_time = mean(times.iter().map(|steps| *steps as f64).collect())?;
        let is_harmless = |shock: &&Shock| shock.label == label;
        let mean_harmless = mean(shocks.iter().filter(is_harmless).map(|own| own.size).collect())?;
        let open = starts.iter().filter(|(_, (own, _))| own.is_undecided());
        let undecided = open.map(|(_, (_, steps))| *steps).collect();
        let longest = own().max_by_key(|(_, (_, steps))| *steps).map(|(start, (_, steps))| {
            let longer = 1.0 - pxfm::f_pow(UNSEEN, 1.0 / times.len() as f64);
            LongestTime { steps: *steps, start: start.to_vec(), longer }
        });
        let is_fatal = |shock: &&Shock| shock.label.is_decided() && shock.label != label;
        let by_size = |a: &&Shock, b: &&Shock| a.size.total_cmp(&b.size);
        let fatal = shocks.iter().filter(is_fatal).min_by(by_size).cloned();
        let harmless = shocks.iter().filter(is_harmless).max_by(by_size).cloned();
        let mut sorted: Vec<&Shock> = shocks.iter().collect();
        sorted.sort_by(by_size);
        let mut counts_so_far = [0; 2];
        let up_to = |shock: &Shock| {
            let [fatal, open] = &mut counts_so_far;
            *fatal += usize::from(is_fatal(&shock));
            *open += usize::from(!shock.label.is_decided());
            (shock.size, counts_so_far)
        };
        let shocks = sorted.into_iter().map(up_to).collect();
        Ok(AttractorStability {
            fraction: counts.fraction(label)?,
            mean_time,
            longest,
            fatal,
            harmless,
            mean_harmless,
            shocks,
            times,
            undecided,
            inside: counts.inside(),
        })
    }

    /// The share of shocks up to a size that are fatal, with a 95 % interval that counts undecided ones in its upper end.
    ///
    /// # Errors
    /// [`Error::NothingInside`] if no start is so near.
    pub fn fatal_share(&self, size: f64) -> Result<ConfidenceInterval, Error> {
        let count = self.shocks.partition_point(|shock| shock.0 <= size);
        match self.shocks[..count].last() {
            Some(&(_, [fatal, open])) => open_proportion(fatal, open, count),
            None => Err(Error::NothingInside { points: self.shocks.len() }),
        }
    }

    /// The fraction of starts that come to the attractor within so many steps, with a 95 % interval: basin stability in finite time. Its upper end counts
    /// undecided starts that were followed for fewer steps.
    ///
    /// # Errors
    /// None for starts inside the region of interest, of which [`Stability::new`] demands one.
    pub fn fraction_within(&self, steps: usize) -> Result<ConfidenceInterval, Error> {
        let found = self.times.partition_point(|time| *time <= steps);
        let open = self.undecided.iter().filter(|made| **made < steps).count();
        open_proportion(found, open, self.inside)
    }

    /// A quantile of the times in the basin, such as ½ for the median, with the 95 % interval of the ranks of a binomial number: for any distribution.
    ///
    /// # Errors
    /// [`Error::BadSearch`] unless 0 < `part` < 1, and for so few starts that no ranks enclose the quantile: some 4/`part`, or 4/(1 − `part`).
    pub fn time_quantile(&self, part: f64) -> Result<ConfidenceInterval, Error> {
        let refused = |value, remedy| {
            Err(Error::BadSearch { name: "a part of the starts of a basin", value, remedy })
        };
        if !(0.0 < part && part < 1.0) {
            return refused(part, ", and below 1");
        }
        let Some((low, high)) = ranks(self.times.len(), part) else {
            return refused(part, "; for this one the basin has too few starts");
        };
        let at = |rank: usize| self.times[rank] as f64;
        let middle = ((part * self.times.len() as f64) as usize).min(self.times.len() - 1);
        Ok(ConfidenceInterval { value: at(middle), lower: at(low), upper: at(high) })
    }

    /// The largest size up to which at most this share of the shocks is fatal, by the upper ends of their intervals; `None` if there is none.
    ///
    /// Sizes are those of the starts. The nearest edge of the basin may be closer: at most this share of the shocks shows it.
    pub fn safe_size(&self, share: f64) -> Option<f64> {
        let is_safe = |size: &f64| self.fatal_share(*size).is_ok_and(|own| own.upper <= share);
        self.shocks.iter().map(|shock| shock.0).rev().find(is_safe)
    }
}

/// The ranks, from 0, between which a quantile of so many numbers is in 95 % of the samples at least.
fn ranks(count: usize, part: f64) -> Option<(usize, usize)> {
    /// The probability that is left on each side.
    const TAIL: f64 = 0.025;
    // The quantile is below the number of rank k if more than k numbers are above it. Probabilities of 0, 1, 2, … numbers below, one by one.
    let n = count as f64;
    let mut below = 0.0;
    let (mut low, mut high) = (None, None);
    for k in 0..=count {
        let x = k as f64;
        let choices =
            pxfm::f_lgamma(n + 1.0) - pxfm::f_lgamma(x + 1.0) - pxfm::f_lgamma(n - x + 1.0);
        let term = choices + x * pxfm::f_log(part) + (n - x) * pxfm::f_log1p(-part);
        below += pxfm::f_exp(term);
        if below <= TAIL {
            low = Some(k);
        }
        if below >= 1.0 - TAIL && high.is_none() {
            high = Some(k);
        }
    }
    Some((low?, high.filter(|high| *high < count)?))
}
