//! Exponentials, logarithms, hyperbolic functions, tangents and arcs of intervals.
//!
//! What is taken as given: each function of pxfm is within half an ulp of the exact value, as pxfm claims after its own
//! comparisons. One `f64` outwards covers that; each end is moved by one more. Exponentials and powers next to the
//! smallest numbers, for which this is false, are squares of others. `cargo xtask check-certificates` compares every
//! function with Arb.

use crate::enclosure::Enclosure;
use crate::functions::{PI, multiples_of_pi};
use crate::rounding::{above, below};
use crate::small_results::SMALLEST_CLAIMED;

/// The values of a function that rises on the whole interval.
#[inline]
fn rising(x: Enclosure, f: fn(f64) -> f64) -> Enclosure {
    Enclosure { low: below(f(x.low)), high: above(f(x.high)) }
}

/// The exponential of one number.
#[inline]
fn exponential(x: f64) -> Enclosure {
    let claimed = pxfm::f_exp(x);
    if claimed < SMALLEST_CLAIMED {
        rising(Enclosure::from(0.5 * x), pxfm::f_exp).squared()
    } else {
        Enclosure { low: below(claimed), high: above(claimed) }
    }
}

impl Enclosure {
    /// The part in [`least`, `greatest`], for a function whose values are all there. An end without a bound stays on
    /// its side.
    #[inline]
    fn limited(self, least: f64, greatest: f64) -> Self {
        Enclosure { low: self.low.max(least), high: self.high.min(greatest) }
    }

    /// No end is NaN, and the ends are in order.
    #[inline]
    fn is_interval(self) -> bool {
        self.low <= self.high
    }

    /// The exponentials: never below zero.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let e = Enclosure::ONE.exp();
    /// assert!(e.contains(std::f64::consts::E) && e.width() < 2e-15);
    /// assert_eq!(Enclosure::WHOLE.exp(), Enclosure::new(0.0, f64::INFINITY));
    /// ```
    #[inline]
    pub fn exp(self) -> Self {
        let ends = Enclosure { low: exponential(self.low).low, high: exponential(self.high).high };
        ends.limited(0.0, f64::INFINITY)
    }

    /// The natural logarithms; `None` unless all numbers are at or above zero and some above. An end at zero has the
    /// logarithm −∞.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let logarithm = Enclosure::between(0.0, 1.0)?.ln();
    /// assert!(logarithm.is_some_and(|found| found.low() == f64::NEG_INFINITY && found.contains(0.0)));
    /// assert_eq!(Enclosure::between(-1.0, 1.0)?.ln(), None);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn ln(self) -> Option<Self> {
        // −0 is zero, whose logarithm would be the same; a rounded one has no sign to lose.
        (self.low >= 0.0 && self.high > 0.0).then(|| rising(self, pxfm::f_log))
    }

    /// The tangents, in radians; all numbers if a pole may be inside, or for an argument above 10⁹.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// assert!(Enclosure::between(-0.1, 0.1)?.tan().width() < 0.21);
    /// assert_eq!(Enclosure::between(1.0, 2.0)?.tan(), Enclosure::WHOLE); // the pole at ½π
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn tan(self) -> Self {
        let Some(mut poles) = multiples_of_pi(self, 0.5) else { return Enclosure::WHOLE };
        // No `f64` is a pole.
        if self.low < self.high && poles.next().is_some() {
            return Enclosure::WHOLE;
        }
        rising(self, pxfm::f_tan)
    }

    /// The arc sines, from −½π to ½π; `None` if a number outside [−1, 1] is among the values.
    #[inline]
    pub fn asin(self) -> Option<Self> {
        (self.is_interval() && self.magnitude() <= 1.0).then(|| rising(self, pxfm::f_asin))
    }

    /// The arc cosines, from 0 to π; `None` if a number outside [−1, 1] is among the values.
    #[inline]
    pub fn acos(self) -> Option<Self> {
        (self.is_interval() && self.magnitude() <= 1.0).then(|| {
            let turned = Enclosure {
                low: below(pxfm::f_acos(self.high)),
                high: above(pxfm::f_acos(self.low)),
            };
            turned.limited(0.0, PI.high)
        })
    }

    /// The angles of the points (x, y) from the positive x axis, above −π and up to π, where `self` has the y and
    /// `x` the x. If a point with x ≤ 0 may be on the axis, with points below it, and if the origin may be a point,
    /// these are all angles.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let (one, box_) = (Enclosure::ONE, Enclosure::between(-0.1, 0.1)?);
    /// assert!(box_.atan2(one).magnitude() < 0.1);
    /// assert!(box_.atan2(-one).width() > 6.28); // both sides of the cut
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    pub fn atan2(self, x: Self) -> Self {
        let y = self;
        if !(y.is_interval()
            && x.is_interval()
            && y.magnitude() < f64::INFINITY
            && x.magnitude() < f64::INFINITY)
        {
            return Enclosure { low: -PI.high, high: PI.high };
        }
        let at_axis = y.low <= 0.0 && 0.0 <= y.high && x.low <= 0.0;
        if at_axis && (y.low < 0.0 || x.high >= 0.0) {
            // The half plane alone, where the points are on one side of the axis and touch the origin.
            let low = if y.low >= 0.0 { 0.0 } else { -PI.high };
            return Enclosure { low, high: PI.high };
        }
        // −0 is zero: it has no side.
        let angle = |y: f64, x: f64| pxfm::f_atan2(y + 0.0, x);
        let corners = [(y.low, x.low), (y.low, x.high), (y.high, x.low), (y.high, x.high)];
        let angles = corners.map(|(y, x)| angle(y, x));
        let least = angles.into_iter().fold(f64::INFINITY, f64::min);
        let greatest = angles.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Enclosure { low: below(least), high: above(greatest) }.limited(-PI.high, PI.high)
    }

    /// The hyperbolic sines.
    #[inline]
    pub fn sinh(self) -> Self {
        rising(self, pxfm::f_sinh)
    }

    /// The hyperbolic cosines: never below 1.
    #[inline]
    pub fn cosh(self) -> Self {
        rising(self.abs(), pxfm::f_cosh).limited(1.0, f64::INFINITY)
    }

    /// The hyperbolic tangents, in [−1, 1].
    #[inline]
    pub fn tanh(self) -> Self {
        rising(self, pxfm::f_tanh).limited(-1.0, 1.0)
    }

    /// The inverse hyperbolic sines.
    #[inline]
    pub fn asinh(self) -> Self {
        rising(self, pxfm::f_asinh)
    }

    /// The inverse hyperbolic cosines, at or above zero; `None` if a number below 1 is among the values.
    #[inline]
    pub fn acosh(self) -> Option<Self> {
        (self.low >= 1.0 && self.is_interval())
            .then(|| rising(self, pxfm::f_acosh).limited(0.0, f64::INFINITY))
    }

    /// The inverse hyperbolic tangents; `None` if a number outside [−1, 1] is among the values. At an end at ±1 there
    /// is no bound.
    #[inline]
    pub fn atanh(self) -> Option<Self> {
        (self.is_interval() && self.magnitude() <= 1.0).then(|| rising(self, pxfm::f_atanh))
    }
}
