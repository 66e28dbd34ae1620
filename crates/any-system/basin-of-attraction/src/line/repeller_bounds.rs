//! Proved bounds on the dimension and the escape rate of the Cantor set that full branches leave.

use crate::error::Error;
use crate::line::full_branches::{check, refused};
use crate::space::interval::Interval;
use crate::statistics::bounds::Bounds;
use interval_arithmetic::{Enclosure, bracketed_root};

/// Bounds on the numbers of a [`Repeller`](crate::Repeller), rounded outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepellerBounds {
    /// Its dimension: Hausdorff's and that of boxes are the same.
    pub dimension: Bounds,
    /// The rate γ at which points leave: of equally distributed ones e^(−γn) are left after n steps.
    pub escape_rate: Bounds,
}

/// The most slopes, one for each word and branch: more take minutes.
const MOST_SLOPES: usize = 1 << 19;

/// Steps of the power method. The bounds hold after each of them; a contraction of a half a step ends in rounding after 52.
const STEPS: usize = 60;

/// Bounds on the dimension and the escape rate of the set of points that never leave some branches, each onto an interval. `inverse` gives for a branch, by its
/// number, and an enclosure of points of the interval enclosures of the preimages on this branch and of the sizes of the slopes there, those of
/// the inverse branch; `None` if it cannot. The caller knows that the branches are monotone, and that the images of two that touch to rounding, within 10⁻¹² of the shorter one, do not overlap: all else is
/// proved.
///
/// The set is covered by the images of the interval under all words of so many `letters`, each a branch. On each of them the slopes have bounds, and so has the
/// operator (Lₛφ)(x) = Σ |gₖ′(x)|ˢ φ(gₖ(x)) on functions that are constant there: if least ≤ (Lₛφ)/φ ≤ most for a positive φ, its largest eigenvalue is between these
/// (L. Collatz, 1942). The dimension is the s at which it is 1 (R. Bowen, 1979), and the escape rate −ln of it at s = 1. Each letter makes the
/// bounds closer by the contraction of the branches, and takes as many times longer as there are branches. [`repeller`](fn@crate::repeller) has more digits, with
/// an estimate of its error.
///
/// ```
/// use basin_of_attraction::{Enclosure, Interval, repeller_bounds};
/// // Numbers with the continued fraction digits 1 and 2: x = 1/(k + y).
/// let found = repeller_bounds(2, Interval::new(0.0, 1.0)?, 12, |k, y| {
///     let x = Enclosure::ONE / (Enclosure::from(k as f64 + 1.0) + y);
///     Some((x, x.squared()))
/// })?;
/// assert!(found.dimension.covers(0.531_280_506_277_205_1) && found.dimension.half_width() < 1e-4);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadSearch`] for no branch or letter, for preimages outside of the interval, for branches that overlap, and for slopes that are not positive, or
/// unbounded; [`Error::TooManySamples`] for more than 524 288 slopes, one for each word and branch.
pub fn repeller_bounds(
    branches: usize,
    interval: Interval,
    letters: usize,
    inverse: impl Fn(usize, Enclosure) -> Option<(Enclosure, Enclosure)>,
) -> Result<RepellerBounds, Error> {
    if letters == 0 {
        return Err(refused("a number of letters", 0.0, ""));
    }
    let longer = u32::try_from(letters).ok().and_then(|letters| letters.checked_add(1));
    let slopes = longer.and_then(|letters| branches.checked_pow(letters));
    let slopes = slopes.unwrap_or(usize::MAX).max(letters);
    if slopes > MOST_SLOPES {
        let remedy = "give fewer letters: there is one for each word and branch";
        return Err(Error::TooManySamples { samples: slopes, most: MOST_SLOPES, remedy });
    }
    // The outer ends of enclosures: what they do not show to be apart may overlap.
    let image = |k: usize| {
        let ends = [interval.left, interval.right].map(|y| Some(inverse(k, Enclosure::from(y))?.0));
        match ends {
            [Some(a), Some(b)] => [a.low().min(b.low()), a.high().max(b.high())],
            _ => [f64::NAN; 2],
        }
    };
    check(branches, interval, &image)?;
    let operator = Operator::new(branches, interval, letters, &inverse)?;
    let at_one = operator.bounds(1.0);
    let logarithm =
        |x: f64| Enclosure::from(x).ln().unwrap_or(Enclosure::new(f64::NEG_INFINITY, 0.0));
    let escape_rate = Bounds {
        lower: (-logarithm(at_one.upper).high()).max(0.0),
        upper: (-logarithm(at_one.lower).low()).max(0.0),
    };
    Ok(RepellerBounds { dimension: operator.dimension(), escape_rate })
}

/// The transfer operator on functions that are constant on the images of words.
struct Operator {
    branches: usize,
    /// For each word and branch the sizes of slopes. The number of a word has its first letter first, in the base of the number of branches.
    slopes: Vec<Enclosure>,
}

impl Operator {
    fn new(
        branches: usize,
        interval: Interval,
        letters: usize,
        inverse: &impl Fn(usize, Enclosure) -> Option<(Enclosure, Enclosure)>,
    ) -> Result<Operator, Error> {
        let none = || refused("an inverse branch", f64::NAN, " has no value on the interval");
        let mut images = vec![Enclosure::new(interval.left, interval.right)];
        for _ in 0..letters {
            let longer = (0..branches).flat_map(|k| images.iter().map(move |image| (k, *image)));
            let longer = longer.map(|(k, image)| Some(inverse(k, image)?.0));
            images = longer.collect::<Option<Vec<_>>>().ok_or_else(none)?;
        }
        let mut slopes = Vec::with_capacity(images.len() * branches);
        for image in images {
            for k in 0..branches {
                let (_, slope) = inverse(k, image).ok_or_else(none)?;
                if !(slope.is_positive() && slope.high().is_finite()) {
                    return Err(refused("the slope of an inverse branch", slope.low(), ""));
                }
                slopes.push(slope);
            }
        }
        Ok(Operator { branches, slopes })
    }

    /// The values of some factors of slopes times a function on the words.
    fn applied<'a>(
        &'a self,
        factors: &'a [f64],
        function: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        let own = factors.chunks_exact(self.branches).enumerate();
        own.map(|(word, factors)| {
            let each = factors.iter().enumerate();
            each.map(|(k, factor)| factor * function[self.longer(k, word)]).sum()
        })
    }

    /// The word that a letter before a word begins.
    fn longer(&self, letter: usize, word: usize) -> usize {
        let words = self.slopes.len() / self.branches;
        letter * (words / self.branches) + word / self.branches
    }

    /// The largest eigenvalue for the middles of slopes, and its function, about.
    fn about(&self, s: f64) -> (f64, Vec<f64>) {
        let factors: Vec<f64> =
            self.slopes.iter().map(|slope| pxfm::f_pow(slope.middle(), s)).collect();
        let mut function = vec![1.0; self.slopes.len() / self.branches];
        let mut value = f64::NAN;
        for _ in 0..STEPS {
            let image: Vec<f64> = self.applied(&factors, &function).collect();
            value = image.iter().sum::<f64>() / function.iter().sum::<f64>();
            let largest = image.iter().fold(0.0f64, |most, x| most.max(*x));
            function = image.into_iter().map(|x| x / largest).collect();
        }
        (value, function)
    }

    /// Bounds on the largest eigenvalue at s.
    fn bounds(&self, s: f64) -> Bounds {
        let (_, function) = self.about(s);
        let mut found = Bounds { lower: f64::INFINITY, upper: 0.0 };
        for (word, slopes) in self.slopes.chunks_exact(self.branches).enumerate() {
            let mut sum = Enclosure::ZERO;
            for (k, slope) in slopes.iter().enumerate() {
                match slope.powf(Enclosure::from(s)) {
                    Some(factor) => sum = sum + factor * function[self.longer(k, word)],
                    None => return Bounds { lower: 0.0, upper: f64::INFINITY },
                }
            }
            let ratio = sum / Enclosure::from(function[word]);
            // What is no number bounds nothing.
            let (low, high) = if ratio.low() <= ratio.high() {
                (ratio.low(), ratio.high())
            } else {
                (0.0, f64::INFINITY)
            };
            found = Bounds { lower: found.lower.min(low), upper: found.upper.max(high) };
        }
        found
    }

    /// Bounds on the s at which the eigenvalue is 1, by steps away from about that place that grow until they prove it.
    fn dimension(&self) -> Bounds {
        let off = |s: f64| pxfm::f_log(self.about(s).0);
        let place = match (off(0.0) > 0.0, off(1.0) < 0.0) {
            (true, true) => bracketed_root(off, 0.0, 1.0).unwrap_or(0.5),
            (true, false) => 1.0,
            _ => 0.0,
        };
        let steps = || std::iter::successors(Some(f64::EPSILON), |step| Some(2.0 * step));
        let mut below = steps().map(|step| place - step).take_while(|s| *s > 0.0);
        let mut above = steps().map(|step| place + step).take_while(|s| *s < 1.0);
        let lower = below.find(|s| self.bounds(*s).lower >= 1.0).unwrap_or(0.0);
        let upper = above.find(|s| self.bounds(*s).upper <= 1.0).unwrap_or(1.0);
        // One branch that contracts has one point.
        let contracts = self.slopes.iter().all(|slope| slope.high() < 1.0);
        Bounds { lower, upper: if self.branches == 1 && contracts { 0.0 } else { upper } }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods)] // a test: bits do not matter

    use super::*;
    use crate::line::repeller::repeller;

    fn unit() -> Interval {
        Interval::new(0.0, 1.0).unwrap()
    }

    /// Parts of the unit interval with these ratios: Moran's equation and −ln Σ rₖ, to rounding.
    #[test]
    fn affine_branches_are_bounded_to_rounding() {
        for (ratios, dimension) in [
            (vec![1.0 / 3.0, 1.0 / 3.0], 2f64.ln() / 3f64.ln()),
            (vec![0.5, 0.25], ((1.0 + 5f64.sqrt()) / 2.0).ln() / 2f64.ln()),
            (vec![0.25; 3], 3f64.ln() / 4f64.ln()),
        ] {
            let step = (1.0 - ratios.iter().sum::<f64>()) / (ratios.len() - 1) as f64;
            let begin = |k: usize| ratios[..k].iter().sum::<f64>() + step * k as f64;
            let inverse = |k: usize, y: Enclosure| {
                Some((y * ratios[k] + Enclosure::from(begin(k)), Enclosure::from(ratios[k])))
            };
            let found = repeller_bounds(ratios.len(), unit(), 4, inverse).unwrap();
            let RepellerBounds { dimension: own, escape_rate } = found;
            assert!(own.lower <= dimension + 1e-15 && dimension - 1e-15 <= own.upper, "{own:?}");
            let rate = -ratios.iter().sum::<f64>().ln();
            assert!(escape_rate.lower <= rate + 1e-15 && rate - 1e-15 <= escape_rate.upper);
            assert!(own.half_width() < 1e-13 && escape_rate.half_width() < 1e-13, "{found:?}");
        }
    }

    /// The logistic map at r = 5: each letter makes the bounds closer, and the numbers of the operator at Chebyshev nodes are within them.
    #[test]
    fn the_logistic_map_is_bounded() {
        let root = |y: Enclosure| (Enclosure::ONE - y * 4.0 / Enclosure::from(5.0)).sqrt();
        let inverse = |k: usize, y: Enclosure| {
            let root = root(y)?;
            let x = if k == 0 { Enclosure::ONE - root } else { Enclosure::ONE + root };
            Some((x * 0.5, Enclosure::ONE / (root * 5.0)))
        };
        let exact = repeller(2, unit(), |k, y| {
            let (x, slope) = inverse(k, Enclosure::from(y)).unwrap();
            (x.middle(), slope.middle())
        })
        .unwrap();
        let mut before = f64::INFINITY;
        for (letters, width) in [(4, 2e-2), (8, 2e-3), (14, 1e-5)] {
            let found = repeller_bounds(2, unit(), letters, inverse).unwrap();
            assert!(found.dimension.covers(exact.dimension), "{found:?} {exact:?}");
            assert!(found.escape_rate.covers(exact.escape_rate), "{found:?} {exact:?}");
            let own = found.dimension.half_width();
            assert!(own < width && own < before, "{letters} {found:?}");
            before = own;
        }
    }

    #[test]
    fn ends_and_bad_input() {
        let half = |k: usize, y: Enclosure| {
            Some(((y + Enclosure::from(k as f64)) * 0.5, Enclosure::from(0.5)))
        };
        let full = repeller_bounds(2, unit(), 3, half).unwrap();
        assert!(full.dimension.upper == 1.0 && full.dimension.lower > 1.0 - 1e-13, "{full:?}");
        assert!(full.escape_rate.lower == 0.0 && full.escape_rate.upper < 1e-13, "{full:?}");
        let point = repeller_bounds(1, unit(), 3, half).unwrap();
        assert_eq!((point.dimension.lower, point.dimension.upper), (0.0, 0.0));
        let bad =
            |found: Result<RepellerBounds, Error>| matches!(found, Err(Error::BadSearch { .. }));
        assert!(
            bad(repeller_bounds(0, unit(), 3, half)) && bad(repeller_bounds(2, unit(), 0, half))
        );
        assert!(bad(repeller_bounds(3, unit(), 3, half)));
        assert!(bad(repeller_bounds(1, unit(), 3, |_, _| None)));
        assert!(bad(repeller_bounds(1, unit(), 3, |_, y| Some((y * 0.5, Enclosure::ZERO)))));
        let many = repeller_bounds(2, unit(), 40, half);
        assert!(matches!(many, Err(Error::TooManySamples { .. })), "{many:?}");
        assert!(repeller_bounds(2, unit(), usize::MAX, half).is_err());
        for (branches, letters) in [(1 << 18, 1), (512, 2), (64, 3), (1, 4_000_000_000)] {
            let many = repeller_bounds(branches, unit(), letters, half);
            assert!(matches!(many, Err(Error::TooManySamples { .. })), "{branches} {many:?}");
        }
        // Branches that are one, or outside, also if they are short; what enclosures do not tell apart; a width that overflows.
        let (thin, number) = (|y: Enclosure, by: f64| y * by, |x: f64| Enclosure::from(x));
        assert!(bad(repeller_bounds(2, unit(), 4, |_, y| Some((thin(y, 1e-13), number(1e-13))))));
        assert!(bad(repeller_bounds(2, unit(), 4, |k, y| Some(match k {
            0 => (thin(y, 0.3), number(0.3)),
            _ => (thin(y, 4e-13) + number(1.0 + 5e-13), number(4e-13)),
        }))));
        assert!(bad(repeller_bounds(2, unit(), 4, |k, y| {
            let from = if k == 0 { Enclosure::ZERO } else { Enclosure::new(0.0, 0.9) };
            Some((thin(y, 1e-3) + from, number(1e-3)))
        })));
        let huge = Interval::new(-1e308, 1e308).unwrap();
        assert!(bad(repeller_bounds(3, huge, 4, |_, y| Some((y * 0.25, number(0.25))))));
        // A branch that does not contract keeps all.
        let all = repeller_bounds(1, unit(), 4, |_, y| Some((y, Enclosure::ONE))).unwrap();
        assert_eq!((all.dimension.lower, all.dimension.upper), (0.0, 1.0));
    }
}
