//! The fraction of starts whose fate a perturbation ε changes.

use crate::boundaries::region_uncertainty::{PairCount, check_perturbation};
use crate::error::Error;
use crate::line::interval_basins::IntervalBasins;
use crate::shares::sampling::{check_count, check_window};
use crate::space::interval::{Interval, IntervalSet};
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;
use crate::statistics::confidence_interval::ConfidenceInterval;
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;

/// The fraction of starts x whose label differs from that of x + ε or of x − ε (Grebogi, McDonald, Ott, Yorke
/// 1983), with a 95 % interval ([`proportion_interval`](crate::proportion_interval)).
///
/// `count` uniform random starts in `window` are tried. For small ε the fraction grows like a power of ε. Its
/// exponent is the uncertainty exponent, which [`power_law`](crate::power_law) fits.
///
/// An undecided label may be that of any basin: a start that is uncertain only then raises the upper end alone. A
/// start with one of the three points outside the region of interest does not count.
///
/// # Errors
/// [`Error::BadTrials`] for a `count` of 0, [`Error::TooManySamples`] for more than a billion,
/// [`Error::BadPerturbation`] unless `epsilon` is positive and finite, [`Error::BadInterval`] for a window that is
/// reversed or not finite, [`Error::NothingInside`] if no start counts.
pub fn uncertain_fraction(
    window: Interval,
    epsilon: f64,
    count: usize,
    seed: u64,
    label: impl Fn(f64) -> Label + Sync,
) -> Result<ConfidenceInterval, Error> {
    check_window(window)?;
    check_perturbation(epsilon)?;
    check_count(count)?;
    let random = SplitMix64::from_seed(seed);
    // Of each start: whether it counts, is uncertain, is open.
    let tally = |k: usize| {
        let x = window.left + window.length() * random.uniform(k as u64);
        let here = label(x);
        let beside = [label(x + epsilon), label(x - epsilon)];
        if here.is_outside() || beside.iter().any(|label| label.is_outside()) {
            return [0, 0, 0];
        }
        let known = |label: &Label| here.is_decided() && label.is_decided();
        if beside.iter().any(|label| known(label) && *label != here) {
            [1, 1, 0]
        } else {
            [1, 0, usize::from(!beside.iter().all(known))]
        }
    };
    let add = |a: [usize; 3], b: [usize; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let [pairs, uncertain, open] = (0..count).into_par_iter().map(tally).reduce(|| [0; 3], add);
    if pairs == 0 && count > 0 {
        return Err(Error::NothingInside { points: count });
    }
    PairCount { epsilon, pairs, uncertain, open }.fraction()
}

impl IntervalBasins {
    /// The fraction of the window within ε of the boundary between basins.
    ///
    /// The lower bound counts only points within ε of every possible boundary in a gap. The upper bound counts every
    /// undecided gap longer than `resolution` as boundary, over its whole length, those at the ends of the window too.
    ///
    /// # Errors
    /// [`Error::BadPerturbation`] unless `epsilon` is positive and finite; [`Error::BadInterval`] for a window of
    /// length 0.
    pub fn uncertain_fraction(&self, epsilon: f64, resolution: f64) -> Result<Bounds, Error> {
        check_perturbation(epsilon)?;
        let window = self.window();
        let Interval { left, right } = window;
        if left == right {
            return Err(Error::BadInterval { left, right });
        }
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
        let known = self.intervals();
        let first = known.first().map_or(right, |part| part.interval.left);
        let last = known.last().map_or(left, |part| part.interval.right);
        for (before, after) in [(left, first), (last, right)] {
            if after - before > resolution {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::line::refinement::StopReason;

    #[test]
    fn undecided_gaps_at_the_ends_of_the_window_may_contain_a_boundary() {
        let window = Interval { left: 0.0, right: 1.0 };
        let fraction = |left: f64, right: f64| {
            let known = [(Interval { left, right }, Label::from(1))];
            let stop = StopReason::AllFollowed;
            let basins = IntervalBasins::from_known(window, &known, stop).unwrap();
            basins.uncertain_fraction(0.01, 1e-9).unwrap()
        };
        // A boundary in the gap, at 0.2 or at 0.9, makes 0.02 uncertain.
        assert!(fraction(0.3, 1.0).covers(0.02) && fraction(0.0, 0.8).covers(0.02));
        assert_eq!(fraction(0.0, 1.0), Bounds { lower: 0.0, upper: 0.0 });
        let none = IntervalBasins::from_known(window, &[], StopReason::AllFollowed).unwrap();
        let all = Bounds { lower: 0.0, upper: 1.0 };
        assert_eq!(none.uncertain_fraction(0.01, 1e-9), Ok(all));
        let point = none.within(Interval { left: 0.5, right: 0.5 }).unwrap();
        let bad = Error::BadInterval { left: 0.5, right: 0.5 };
        assert_eq!(point.uncertain_fraction(0.01, 1e-9), Err(bad));
    }

    #[test]
    fn undecided_starts_are_not_known_to_be_uncertain() {
        let window = Interval { left: 0.0, right: 1.0 };
        let half = |other: Label| {
            let label = move |x: f64| if x < 0.5 { other } else { Label::from(1) };
            uncertain_fraction(window, 0.1, 1000, 2, label)
        };
        let known = half(Label::from(0)).unwrap();
        assert!(known.covers(0.2) && known.half_width() < 0.03, "{known:?}");
        // All starts below 0.6 have an undecided point.
        let open = half(Label::UNDECIDED).unwrap();
        assert!(open.value == 0.0 && open.covers(0.0) && open.covers(0.6), "{open:?}");
        assert!(half(Label::OUTSIDE).unwrap().upper < 0.02);
        let all = |label: Label| uncertain_fraction(window, 0.1, 100, 1, move |_| label);
        assert_eq!(all(Label::OUTSIDE), Err(Error::NothingInside { points: 100 }));
        assert!(all(Label::UNDECIDED).is_ok_and(|all| all.lower == 0.0 && all.upper == 1.0));
        let endless = Interval { left: f64::MIN, right: f64::MAX };
        let found = uncertain_fraction(endless, 0.1, 100, 1, |_| Label::from(1));
        assert!(matches!(found, Err(Error::BadInterval { .. })));
    }
}
