//! The exponent of a power law of proportions, from counts, by the likelihood of their binomial distributions.
//!
//! ```text
//!   k of n pairs are uncertain at ε        p = exp(a + b x)        x = ln ε
//!
//!   U(b) = Σ (k − n p)(x − x̄)/(1 − p)      V(b) = Σ W (x − x̄)²      W = n p/(1 − p)
//! ```
//!
//! a is that of the greatest likelihood for each b: Σ (k − n p)/(1 − p) = 0; x̄ is the mean of x with the weights
//! W. If b is the exponent, U/√V has the mean 0 and the variance 1 to leading order. So the estimate has U = 0, and
//! the 95 % interval is that of the b with |U| ≤ 1.96 √V: Rao's score interval, as Wilson's is for one proportion.
//! Counts of 0 need no exception, and no count is selected by its size.

use crate::statistics::confidence_interval::{ConfidenceInterval, NORMAL_QUANTILE};

/// Pairs at one distance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScaleCount {
    /// ln ε.
    pub(crate) log_scale: f64,
    /// All pairs.
    pub(crate) pairs: f64,
    /// Uncertain pairs.
    pub(crate) uncertain: f64,
    /// Pairs that may be uncertain.
    pub(crate) open: f64,
}

/// A fitted exponent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExponentFit {
    pub(crate) exponent: ConfidenceInterval,
    /// Σ (k − n p)²/(n p (1 − p)).
    pub(crate) chi_squared: f64,
}

/// Halvings of a bracket: they leave 10⁻¹⁵ of it.
const HALVINGS: usize = 52;

/// Largest exponent that is searched. Exponents are between 0 and the dimension of the region; counts without a
/// bound on the exponent exceed every limit.
const LARGEST: f64 = 64.0;

/// The exponent; `None` if the counts give no bound on it: all uncertain pairs at the largest distance, or none at all.
pub(crate) fn fit_exponent(counts: &[ScaleCount]) -> Option<ExponentFit> {
    let value = exponent_with(counts, 0.0)?;
    let middle = Law::new(counts, value).mean();
    // An open pair at a large distance may raise the exponent, and one at a small distance may lower it.
    let worst = |above: bool| -> Vec<ScaleCount> {
        let count = |count: &ScaleCount| {
            let counted = (count.log_scale > middle) == above;
            let uncertain = count.uncertain + if counted { count.open } else { 0.0 };
            ScaleCount { uncertain, ..*count }
        };
        counts.iter().map(count).collect()
    };
    let lower = exponent_with(&worst(false), NORMAL_QUANTILE)?;
    let upper = exponent_with(&worst(true), -NORMAL_QUANTILE)?;
    let law = Law::new(counts, value);
    Some(ExponentFit {
        exponent: ConfidenceInterval { value, lower, upper },
        chi_squared: law.chi_squared(),
    })
}

/// The exponent b at which U/√V, which falls as b grows, has the value `aim`; `None` beyond [`LARGEST`].
fn exponent_with(counts: &[ScaleCount], aim: f64) -> Option<f64> {
    let above = |b: f64| Law::new(counts, b).score() > aim;
    let below = |b: f64| Law::new(counts, b).score() <= aim;
    let (mut left, mut right) = (-1.0, 1.0);
    while !above(left) {
        left *= 2.0;
        if left < -LARGEST {
            return None;
        }
    }
    while !below(right) {
        right *= 2.0;
        if right > LARGEST {
            return None;
        }
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (left + right);
        if above(middle) {
            left = middle;
        } else {
            right = middle;
        }
    }
    Some(0.5 * (left + right))
}

/// One term for each distance, at the level of the greatest likelihood.
struct Law<'a> {
    counts: &'a [ScaleCount],
    exponent: f64,
    level: f64,
}

impl<'a> Law<'a> {
    fn new(counts: &'a [ScaleCount], exponent: f64) -> Self {
        // At the top p = 1 at one distance. Σ (k − n p)/(1 − p) falls from Σ k > 0 to −∞ there.
        let top =
            counts.iter().map(|count| -exponent * count.log_scale).fold(f64::INFINITY, f64::min);
        let mut law = Law { counts, exponent, level: top };
        let (mut low, mut high) = (top - 1.0, top);
        // p is below 10⁻³⁰⁰ after 10 doublings: the sum is positive there, unless no pair is uncertain.
        for _ in 0..10 {
            law.level = low;
            if law.sum(|_, residual, _| residual) > 0.0 {
                break;
            }
            low = top - 2.0 * (top - low);
        }
        for _ in 0..HALVINGS {
            law.level = 0.5 * (low + high);
            if law.sum(|_, residual, _| residual) > 0.0 {
                low = law.level;
            } else {
                high = law.level;
            }
        }
        law
    }

    /// The sum over the distances of a function of x, (k − n p)/(1 − p) and W.
    fn sum(&self, of: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let term = |count: &ScaleCount| {
            let logarithm = (self.level + self.exponent * count.log_scale).min(0.0);
            let (p, rest) = (pxfm::f_exp(logarithm), -pxfm::f_expm1(logarithm));
            // If all pairs are uncertain, half a pair less keeps the level finite.
            let uncertain = count.uncertain.min(count.pairs - 0.5);
            let residual = (uncertain - count.pairs * p) / rest;
            of(count.log_scale, residual, count.pairs * p / rest)
        };
        self.counts.iter().map(term).sum()
    }

    /// x̄.
    fn mean(&self) -> f64 {
        self.sum(|x, _, weight| weight * x) / self.sum(|_, _, weight| weight)
    }

    /// U/√V; NaN where one distance has all of the weight.
    fn score(&self) -> f64 {
        let mean = self.mean();
        let score = self.sum(|x, residual, _| residual * (x - mean));
        score / self.sum(|x, _, weight| weight * (x - mean) * (x - mean)).sqrt()
    }

    /// (k − n p)²/(n p (1 − p)) is the squared residual over W.
    fn chi_squared(&self) -> f64 {
        self.sum(|_, residual, weight| residual * residual / weight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(all: &[(f64, f64, f64, f64)]) -> Vec<ScaleCount> {
        let one = |&(epsilon, pairs, uncertain, open): &(f64, f64, f64, f64)| ScaleCount {
            log_scale: pxfm::f_log(epsilon),
            pairs,
            uncertain,
            open,
        };
        all.iter().map(one).collect()
    }

    #[test]
    fn exact_laws_have_their_exponent_and_no_deviation() {
        for exponent in [0.0, 0.3, 1.0, 2.5] {
            let at = |k: i32| {
                (2f64.powi(-k), 1e6, 3e5 * pxfm::f_pow(2.0, -exponent * f64::from(k)), 0.0)
            };
            let found = fit_exponent(&counts(&[at(0), at(1), at(2), at(4)])).unwrap();
            assert!((found.exponent.value - exponent).abs() < 1e-12, "{found:?}");
            assert!(found.chi_squared < 1e-15);
            let (below, above) = (exponent - found.exponent.lower, found.exponent.upper - exponent);
            assert!(below > 1e-4 && (below / above - 1.0).abs() < 0.1, "{found:?}");
        }
    }

    /// Two distances, and few of many pairs: k₁ of k₁ + k₂ is then binomial with the odds 2^b. Wilson's interval of
    /// 30 of 40 has these ends.
    #[test]
    fn at_two_distances_the_interval_is_wilsons() {
        let found = fit_exponent(&counts(&[(1.0, 1e9, 10.0, 0.0), (2.0, 1e9, 30.0, 0.0)])).unwrap();
        let wilson = crate::statistics::confidence_interval::wilson_interval(30, 40).unwrap();
        let exponent = |share: f64| pxfm::f_log2(share / (1.0 - share));
        for (end, share) in [
            (found.exponent.lower, wilson.lower),
            (found.exponent.value, 0.75),
            (found.exponent.upper, wilson.upper),
        ] {
            assert!((end - exponent(share)).abs() < 1e-6, "{end} {share}");
        }
    }

    #[test]
    fn counts_without_a_bound_have_no_interval() {
        let at = |k: [f64; 3]| {
            counts(&[(0.1, 1e3, k[0], 0.0), (0.2, 1e3, k[1], 0.0), (0.4, 1e3, k[2], 0.0)])
        };
        assert!(fit_exponent(&at([0.0, 0.0, 50.0])).is_none());
        assert!(fit_exponent(&at([0.0, 0.0, 0.0])).is_none());
        assert!(fit_exponent(&at([50.0, 0.0, 0.0])).is_none());
        let zero = fit_exponent(&at([0.0, 20.0, 50.0])).unwrap();
        assert!(zero.exponent.lower > 0.5 && zero.exponent.upper < 5.0, "{zero:?}");
        let full = fit_exponent(&at([1e3, 1e3, 1e3])).unwrap();
        assert!(full.exponent.covers(0.0) && full.exponent.half_width() < 0.01, "{full:?}");
    }

    #[test]
    fn open_pairs_lengthen_the_interval_on_both_sides() {
        let at = |open: f64| {
            counts(&[(0.1, 1e5, 1000.0, open), (0.2, 1e5, 2000.0, open), (0.4, 1e5, 4000.0, open)])
        };
        let (closed, open) = (fit_exponent(&at(0.0)).unwrap(), fit_exponent(&at(90.0)).unwrap());
        assert_eq!(closed.exponent.value, open.exponent.value);
        assert!(open.exponent.lower < closed.exponent.lower - 0.01);
        assert!(open.exponent.upper > closed.exponent.upper + 0.005);
    }
}
