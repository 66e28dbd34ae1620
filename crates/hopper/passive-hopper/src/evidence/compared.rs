//! An actual error beside its bound.

use crate::precision::real::{Extended, Real};

/// The error of a computed number against a longer computation, and the bounds of both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    /// |computed − longer|, subtracted in the longer arithmetic and then rounded.
    pub error: f64,
    /// Bound on the error of the computed number.
    pub bound: f64,
    /// Bound on the error of the longer computation.
    pub reference_bound: f64,
}

impl Compared {
    /// (error + bound of the longer computation)/bound: an upper limit of actual error / bound. A value of at most 1
    /// confirms the bound.
    ///
    /// It is 0 if error and both bounds are 0, and NaN if one of the numbers is.
    pub fn ratio(&self) -> f64 {
        let error = self.error + self.reference_bound;
        if error == 0.0 { 0.0 } else { error / self.bound }
    }

    /// `computed` against `exact`; each has its bound.
    pub(crate) fn of<C: Real, E: Extended>(
        (computed, bound): (C, f64),
        (exact, reference_bound): (E, f64),
    ) -> Self {
        let error = (lengthened::<C, E>(computed) - exact).nearest().abs();
        Compared { error, bound, reference_bound }
    }
}

/// Most `f64` that a number of 1024 bits is cut into, each with 53 bits, and two for gaps.
const MOST_PARTS: usize = 22;

/// The same number in a longer arithmetic: the sum of its leading `f64`, of the `f64` next to the rest, and so on.
fn lengthened<C: Real, E: Extended>(number: C) -> E {
    let (mut sum, mut rest) = (E::from(0.0), number);
    for _ in 0..MOST_PARTS {
        let part = rest.nearest();
        if part == 0.0 {
            break;
        }
        sum = sum + part;
        rest = rest - C::from(part);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::double_double::DoubleDouble;
    use crate::precision::long::Long;

    #[test]
    fn a_lengthened_number_keeps_all_its_bits() {
        let third = Long::<4>::from(1.0).over(3);
        let long: Long<8> = lengthened(third);
        // 3 · (1/3) misses 1 by a unit of the last of the 256 bits, no more and no less.
        let rest = (long * 3.0 + -1.0).nearest().abs();
        assert!(rest > 0.0 && rest < 2f64.powi(-254), "{rest:e}");
        let short = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
        let rest = (lengthened::<_, Long<4>>(short) - third).nearest().abs();
        assert!(rest > 0.0 && rest < 2f64.powi(-104), "{rest:e}");
    }

    #[test]
    fn the_ratio_counts_the_bound_of_the_reference() {
        let compared = Compared { error: 2.0, bound: 8.0, reference_bound: 1.0 };
        assert_eq!(compared.ratio(), 0.375);
        let exact = Compared { error: 0.0, bound: 0.0, reference_bound: 0.0 };
        assert_eq!(exact.ratio(), 0.0);
        assert!(Compared { error: f64::NAN, ..compared }.ratio().is_nan());
        assert_eq!(Compared { error: 1.0, ..exact }.ratio(), f64::INFINITY);
    }
}
