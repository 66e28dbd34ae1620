//! How many of many trials contain the truth.

use crate::error::Error;
use basin_of_attraction::{Bounds, ConfidenceInterval, FractionRange, wilson_interval};
use rayon::prelude::*;

/// One interval for one seed.
pub(super) struct Trial {
    pub(super) covered: bool,
    pub(super) half_width: f64,
    /// Half of Wilson's interval for as many random points, if the interval is that of a proportion.
    pub(super) wilson: Option<f64>,
}

impl Trial {
    pub(super) fn of(interval: ConfidenceInterval, truth: f64) -> Trial {
        Trial { covered: interval.covers(truth), half_width: interval.half_width(), wilson: None }
    }

    /// An interval of a proportion among `points`.
    pub(super) fn of_proportion(
        interval: ConfidenceInterval,
        truth: f64,
        points: usize,
    ) -> Result<Trial, Error> {
        let found = (interval.value * points as f64).round() as usize;
        let wilson = Some(wilson_interval(found, points)?.half_width());
        Ok(Trial { wilson, ..Trial::of(interval, truth) })
    }

    /// A range of a fraction.
    pub(super) fn of_range(range: FractionRange, truth: f64) -> Trial {
        let covered = range.lower <= truth && truth <= range.upper;
        Trial { covered, half_width: range.half_width(), wilson: None }
    }

    pub(super) fn of_bounds(bounds: Bounds, truth: f64) -> Trial {
        Trial { covered: bounds.covers(truth), half_width: bounds.half_width(), wilson: None }
    }
}

/// What an interval promises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Promise {
    /// In 95 % of the samples, and in 93 % at least.
    Probable,
    /// In every case.
    Certain,
}

/// A kind of interval on one scene.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) interval: &'static str,
    pub(crate) scene: String,
    pub(crate) promise: Promise,
    /// Trials with an interval.
    pub(crate) given: usize,
    /// Trials without one, for a reason that the function gave.
    pub(crate) refused: usize,
    /// Intervals that contain the truth.
    pub(crate) covered: usize,
    pub(crate) mean_half_width: f64,
    /// The mean half width over Wilson's.
    pub(crate) over_wilson: Option<f64>,
}

/// The smallest share of samples in which a 95 % interval must contain the truth.
const LEAST: f64 = 0.93;

impl Row {
    /// The share of intervals that contain the truth, with the interval of the measurement.
    pub(crate) fn share(&self) -> Result<ConfidenceInterval, Error> {
        Ok(wilson_interval(self.covered, self.given)?)
    }

    /// Whether the measured share is what is promised. A row without any interval does not hold.
    pub(crate) fn holds(&self) -> bool {
        match self.promise {
            Promise::Certain => self.given > 0 && self.covered == self.given,
            Promise::Probable => self.given > 0 && self.covered as f64 >= LEAST * self.given as f64,
        }
    }
}

/// Runs trials 0 … `trials` − 1. `None` is a refusal.
pub(super) fn repeat(
    interval: &'static str,
    scene: String,
    promise: Promise,
    trials: u64,
    one: impl Fn(u64) -> Result<Option<Trial>, Error> + Send + Sync,
) -> Result<Row, Error> {
    let all: Vec<Option<Trial>> = (0..trials).into_par_iter().map(one).collect::<Result<_, _>>()?;
    let given: Vec<Trial> = all.into_iter().flatten().collect();
    let sum = |of: &dyn Fn(&Trial) -> f64| given.iter().map(of).sum::<f64>();
    let half_widths = sum(&|trial| trial.half_width);
    let wilson = sum(&|trial| trial.wilson.unwrap_or(0.0));
    Ok(Row {
        interval,
        scene,
        promise,
        given: given.len(),
        refused: trials as usize - given.len(),
        covered: given.iter().filter(|trial| trial.covered).count(),
        mean_half_width: half_widths / given.len() as f64,
        over_wilson: (wilson > 0.0).then(|| half_widths / wilson),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_holds_from_93_of_100_on_and_a_certain_one_at_all() {
        let row = |promise, every: u64| {
            let one = |seed: u64| {
                let truth = if seed.is_multiple_of(every) { 2.0 } else { 0.5 };
                let interval = ConfidenceInterval { value: 0.5, lower: 0.0, upper: 1.0 };
                Ok((seed != 5).then(|| Trial::of(interval, truth)))
            };
            repeat("planted", "scene".into(), promise, 1000, one).unwrap()
        };
        let rare = row(Promise::Probable, 20);
        assert!(rare.holds() && rare.covered == 949 && rare.refused == 1 && rare.given == 999);
        assert_eq!(rare.mean_half_width, 0.5);
        assert!(!row(Promise::Probable, 10).holds() && !row(Promise::Certain, 500).holds());
        assert!(row(Promise::Certain, 1001).covered == 998);
    }
}
