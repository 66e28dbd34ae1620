//! How often an error of ε in the start changes the fate.

use crate::sampling::uniform;
use crate::statistics::wilson_interval;
use crate::{Error, Estimate, Interval, IntervalBasins, IntervalSet};
use rayon::prelude::*;

/// The share of starts x whose label differs from that of x + ε or of x − ε (Grebogi, McDonald, Ott,
/// Yorke 1983), with Wilson's 95 % interval.
///
/// Its growth with ε is the uncertainty exponent: fit it with [`power_law`](crate::power_law).
///
/// # Errors
/// [`Error::BadTrials`] without points, [`Error::BadBoxSize`] unless `epsilon` is positive.
pub fn uncertain_fraction(
    window: Interval,
    epsilon: f64,
    count: usize,
    seed: u64,
    label: impl Fn(f64) -> u16 + Sync,
) -> Result<Estimate, Error> {
    if !(epsilon > 0.0 && epsilon.is_finite()) {
        return Err(Error::BadBoxSize { size: epsilon });
    }
    let uncertain = |k: usize| {
        let x = window.left + window.length() * uniform(seed, k as u64);
        let here = label(x);
        label(x + epsilon) != here || label(x - epsilon) != here
    };
    wilson_interval((0..count).into_par_iter().filter(|&k| uncertain(k)).count(), count)
}

impl IntervalBasins {
    /// The share of the window within ε of the boundary, with bounds.
    ///
    /// The lower bound knows of boundaries between decided parts only, the upper one takes every
    /// undecided gap longer than `resolution` for boundary throughout.
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] unless `epsilon` is positive and finite.
    pub fn uncertain_fraction(&self, epsilon: f64, resolution: f64) -> Result<Estimate, Error> {
        if !(epsilon > 0.0 && epsilon.is_finite()) {
            return Err(Error::BadBoxSize { size: epsilon });
        }
        let window = self.window();
        let (mut sure, mut possible) = (Vec::new(), Vec::new());
        for pair in self.intervals().windows(2) {
            let (before, after) = (pair[0].interval.right, pair[1].interval.left);
            let ball = Interval { left: before - epsilon, right: after + epsilon };
            let differ = pair[0].label != pair[1].label;
            if differ {
                // Wherever in the gap the boundary is: within ε of all of the gap's points at least.
                let (left, right) = (after - epsilon, before + epsilon);
                if left < right {
                    sure.push(Interval { left, right });
                }
            }
            if differ || after - before > resolution {
                possible.push(ball);
            }
        }
        let share = |balls: Vec<Interval>| {
            let inside = balls.iter().filter_map(|ball| ball.intersection(&window)).collect();
            IntervalSet::union(inside).measure() / window.length()
        };
        let (lower, upper) = (share(sure), share(possible).min(1.0));
        Ok(Estimate { value: 0.5 * (lower + upper), lower, upper })
    }
}
