//! Numbers with a bound on their error: a middle in extended arithmetic, and a radius.
//!
//! Each operation adds the bound on its own rounding (docs/theory.md, Lemmas 55 to 57) to what the errors of its
//! operands do. So a formula that is written once gives its value and a bound on the error of the value.

use crate::precision::real::Extended;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Covers the rounding of a radius, which has at most ten operations in `f64`.
const ROOM: f64 = 1.0 + 16.0 * f64::EPSILON;

/// Added to every radius: operands and products may lie below the smallest `f64`, where they have no relative error.
const UNDERFLOW: f64 = 1e-300;

/// All numbers within `radius` of `middle`. A radius that is infinite or NaN bounds nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ball<R> {
    pub(crate) middle: R,
    pub(crate) radius: f64,
}

impl<R: Extended> Ball<R> {
    /// This number alone.
    pub(crate) fn exact(value: f64) -> Self {
        Ball { middle: R::from(value), radius: 0.0 }
    }

    /// A number of `R` after some sums and quotients, each of which errs by an eighth of EPSILON.
    pub(crate) fn near(middle: R) -> Self {
        Ball { middle, radius: R::EPSILON * middle.nearest().abs() }
    }

    /// A number of `R`, rounded by one operation, and whatever lies within `error` of it.
    fn rounded(middle: R, error: f64) -> Self {
        let radius = error + R::EPSILON * middle.nearest().abs();
        Ball { middle, radius: ROOM * radius + UNDERFLOW }
    }

    /// The largest absolute value.
    fn size(self) -> f64 {
        ROOM * (self.middle.nearest().abs() + self.radius)
    }

    /// Whether all numbers are positive.
    pub(crate) fn is_positive(self) -> bool {
        self.middle.nearest() > ROOM * self.radius
    }

    /// Whether all numbers are negative.
    pub(crate) fn is_negative(self) -> bool {
        (-self).is_positive()
    }

    pub(crate) fn squared(self) -> Self {
        self * self
    }

    /// The root. Of a number that may be negative nothing is known.
    pub(crate) fn sqrt(self) -> Self {
        let root = self.middle.sqrt();
        let value = self.middle.nearest();
        // |√m − √(m ± r)| ≤ r/(√m + √(m − r)).
        let error = self.radius / (value.sqrt() + (value - ROOM * self.radius).sqrt());
        Ball::rounded(root, error)
    }

    /// sin and cos; neither moves by more than the argument, nor by more than 2.
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.middle.sin_cos();
        let size = self.middle.nearest().abs();
        let moved = if self.radius < 2.0 { self.radius } else { 2.0 };
        // Near zero a sine has a small relative error.
        let of_sine = R::EPSILON * if size < 1.0 { size } else { 1.0 + size };
        (Ball::rounded(sin, moved + of_sine), Ball::rounded(cos, moved + R::EPSILON * (1.0 + size)))
    }

    /// t − sin t and t²/2 − 1 + cos t, from sine and cosine of t ≥ 0.
    pub(crate) fn sine_remainders(self, sin: Self, cos: Self) -> (Self, Self) {
        let (lag, bend) = self.middle.sine_remainders(sin.middle, cos.middle);
        // Below 1 the series have small relative errors. From there on the differences have those of sine and
        // cosine, and of t and t²/2.
        let (t, longest) = (self.middle.nearest().abs(), self.size());
        let own = if t < 1.0 {
            (4.0 * lag.nearest(), 4.0 * bend.nearest())
        } else {
            (1.0 + 2.0 * t, 1.0 + t + t * t)
        };
        // Their slopes are 1 − cos t and t − sin t.
        let (steepest, rise) = ((0.5 * longest * longest).min(2.0), longest.min(longest.powi(3)));
        (
            Ball::rounded(lag, steepest * self.radius + R::EPSILON * own.0),
            Ball::rounded(bend, rise * self.radius + R::EPSILON * own.1),
        )
    }
}

impl<R: Extended> From<f64> for Ball<R> {
    fn from(value: f64) -> Self {
        Ball::exact(value)
    }
}

impl<R: Extended> Neg for Ball<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Ball { middle: -self.middle, radius: self.radius }
    }
}

impl<R: Extended> Add for Ball<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Ball::rounded(self.middle + other.middle, self.radius + other.radius)
    }
}

impl<R: Extended> Sub for Ball<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<R: Extended> Mul for Ball<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let error = self.size() * other.radius + other.size() * self.radius;
        Ball::rounded(self.middle * other.middle, error)
    }
}

impl<R: Extended> Mul<f64> for Ball<R> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self * Ball::exact(factor)
    }
}

impl<R: Extended> Div for Ball<R> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.middle / other.middle;
        let least = other.middle.nearest().abs() - ROOM * other.radius;
        // A divisor that may be zero bounds nothing.
        let error = if least > 0.0 {
            (self.radius + ROOM * quotient.nearest().abs() * other.radius) / least
        } else {
            f64::INFINITY
        };
        Ball::rounded(quotient, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::double_double::DoubleDouble;
    use crate::precision::long::Long;
    use crate::precision::real::Real;
    use proptest::prelude::*;

    type Short = Ball<DoubleDouble>;

    /// A formula with every operation, at a number.
    fn formula<R: Extended>(x: Ball<R>, y: Ball<R>) -> [Ball<R>; 4] {
        let (sin, cos) = x.sin_cos();
        let (lag, bend) = x.sine_remainders(sin, cos);
        [(x * y - sin) / (y + cos * 0.25), (x.squared() + y.squared()).sqrt(), lag / x, bend - x]
    }

    proptest! {
        /// The formula at any number of the balls is in its ball: the number is given in 256 bits.
        #[test]
        fn balls_hold_the_values_of_what_they_hold(
            x in 1e-6..60f64, y in 1.0..50f64, radius in -30.0..-2f64, a in -1.0..1f64, b in -1.0..1f64
        ) {
            let radius = pxfm::f_exp10(radius);
            let ball = |value| Short { radius, ..Short::exact(value) };
            let at = |value: f64, part: f64| Ball::<Long<4>> {
                middle: Long::from(value) + Long::from(radius * part),
                radius: 0.0,
            };
            let (whole, inside) = (formula(ball(x), ball(y)), formula(at(x, a), at(y, b)));
            for (whole, inside) in whole.into_iter().zip(inside) {
                let middle = Long::<4>::from(whole.middle.high) + Long::from(whole.middle.low);
                let off = (middle - inside.middle).nearest().abs();
                prop_assert!(off <= whole.radius + inside.radius, "{off:e} {whole:?}");
                // Not wider than the operations need.
                prop_assert!(!(whole.radius > 1e6 * (radius + 1e-26)), "{whole:?}");
            }
        }
    }

    #[test]
    fn what_may_be_zero_or_negative_bounds_nothing() {
        let wide = Short { radius: 2.0, ..Short::exact(1.0) };
        assert!(!(Short::exact(1.0) / wide).radius.is_finite());
        assert!(!wide.sqrt().radius.is_finite());
        assert!(!wide.is_positive() && !wide.is_negative());
    }
}
