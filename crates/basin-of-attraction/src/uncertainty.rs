//! The fraction of starts whose fate a perturbation ε changes.

use crate::bounds::Bounds;
use crate::confidence_interval::{ConfidenceInterval, proportion_interval};
use crate::error::Error;
use crate::interval::{Interval, IntervalSet};
use crate::interval_basins::IntervalBasins;
use crate::label::Label;
use crate::sampling::check_count;
use crate::split_mix::SplitMix64;
use rayon::prelude::*;

/// The fraction of starts x whose label differs from that of x + ε or of x − ε (Grebogi, McDonald, Ott, Yorke
/// 1983), with a 95 % interval ([`proportion_interval`]).
///
/// `count` uniform random starts in `window` are tried. For small ε the fraction grows like a power of ε. Its
/// exponent is the uncertainty exponent, which [`power_law`](crate::power_law) fits.
///
/// # Errors
/// [`Error::BadTrials`] for a `count` of 0, [`Error::TooManySamples`] for more than a billion, [`Error::BadPerturbation`]
/// unless `epsilon` is positive and finite, [`Error::BadInterval`] for a window that is reversed or not finite.
pub fn uncertain_fraction(
    window: Interval,
    epsilon: f64,
    count: usize,
    seed: u64,
    label: impl Fn(f64) -> Label + Sync,
) -> Result<ConfidenceInterval, Error> {
    Interval::new(window.left, window.right)?;
    check_perturbation(epsilon)?;
    check_count(count)?;
    let random = SplitMix64::from_seed(seed);
    let uncertain = |k: usize| {
        let x = window.left + window.length() * random.uniform(k as u64);
        let here = label(x);
        label(x + epsilon) != here || label(x - epsilon) != here
    };
    proportion_interval((0..count).into_par_iter().filter(|&k| uncertain(k)).count(), count)
}

/// An error for a perturbation that is not positive and finite.
pub(crate) fn check_perturbation(epsilon: f64) -> Result<(), Error> {
    if epsilon > 0.0 && epsilon.is_finite() {
        Ok(())
    } else {
        Err(Error::BadPerturbation { epsilon })
    }
}

impl IntervalBasins {
    /// The fraction of the window within ε of the boundary between basins.
    ///
    /// The lower bound counts only points within ε of every possible boundary in a gap. The upper bound counts every
    /// undecided gap longer than `resolution` as boundary, over its whole length.
    ///
    /// # Errors
    /// [`Error::BadPerturbation`] unless `epsilon` is positive and finite.
    pub fn uncertain_fraction(&self, epsilon: f64, resolution: f64) -> Result<Bounds, Error> {
        check_perturbation(epsilon)?;
        let window = self.window();
        let (mut certain, mut possible) = (Vec::new(), Vec::new());
        for pair in self.intervals().windows(2) {
            let (before, after) = (pair[0].interval.right, pair[1].interval.left);
            let differ = pair[0].label != pair[1].label;
            if differ {
                // The boundary b is somewhere in [before, after]. |x − b| ≤ ε for all such b means
                // after − ε ≤ x ≤ before + ε.
                let (left, right) = (after - epsilon, before + epsilon);
                if left < right {
                    certain.push(Interval { left, right });
                }
            }
            if differ || after - before > resolution {
                possible.push(Interval { left: before - epsilon, right: after + epsilon });
            }
        }
        let fraction = |parts: Vec<Interval>| {
            let inside = parts.iter().filter_map(|part| part.intersection(&window)).collect();
            IntervalSet::union(inside).measure() / window.length()
        };
        Ok(Bounds { lower: fraction(certain), upper: fraction(possible).min(1.0) })
    }
}
