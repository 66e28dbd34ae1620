//! Powers of intervals with integer and real exponents.

use crate::enclosure::Enclosure;
use crate::rounding::{above, below};
use crate::small_results::{SMALLEST_CLAIMED, is_odd_power_below_zero};

/// A power, to one `f64` more than pxfm claims where its claim holds, see `elementary.rs`.
#[inline]
fn power_of(base: f64, exponent: f64) -> Enclosure {
    let near = |base: f64, exponent: f64| {
        let claimed = pxfm::f_pow(base, exponent);
        Enclosure { low: below(claimed), high: above(claimed) }
    };
    let claimed = near(base, exponent);
    if claimed.magnitude() < SMALLEST_CLAIMED && base != 0.0 {
        // As in `pow`.
        let size = near(base.abs(), 0.5 * exponent).squared();
        if is_odd_power_below_zero(base, exponent) { -size } else { size }
    } else {
        claimed
    }
}

impl Enclosure {
    /// The powers with an integer exponent. The power 0 is 1, also of zero. With a negative exponent these are all
    /// numbers if zero is inside; at an end at zero there is no bound, see `÷`.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let x = Enclosure::between(-1.0, 2.0)?;
    /// assert!(x.powi(3).contains(-1.0) && x.powi(3).low() > -1.1); // x · x² has −4 as its lower end
    /// assert_eq!(x.powi(4).low(), 0.0);
    /// assert_eq!(x.powi(-1), Enclosure::WHOLE);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    pub fn powi(self, exponent: i32) -> Self {
        match exponent {
            0 => Enclosure::ONE,
            1 => self,
            2 => self.squared(),
            ..0 if !self.is_positive() && !self.is_negative() => {
                Enclosure::ONE / self.powi(exponent.saturating_neg())
            }
            _ => self.raised(exponent),
        }
    }

    /// The powers with an exponent that is not zero. Those with one below zero are powers of numbers of one sign.
    fn raised(self, exponent: i32) -> Self {
        let even = exponent % 2 == 0;
        if !(self.low <= self.high) {
            let low = if even { 0.0 } else { f64::NEG_INFINITY };
            return Enclosure { low, high: f64::INFINITY };
        }
        let of = if even { self.abs() } else { self };
        // Monotone on numbers of one sign, and for odd exponents above zero on all.
        let (least, greatest) = if exponent > 0 { (of.low, of.high) } else { (of.high, of.low) };
        let at = |end: f64| power_of(end, exponent.into());
        let low = at(least).low;
        // Powers of numbers at or above zero are never below it.
        Enclosure { low: if of.low >= 0.0 { low.max(0.0) } else { low }, high: at(greatest).high }
    }

    /// The powers x^y of the numbers x with the exponents y; `None` if a number below zero is among the x. Where x has
    /// an end at zero, exponents below zero have no upper bound, and the power 0⁰ is 1.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let two = Enclosure::point(2.0)?;
    /// let root = two.powf(Enclosure::point(0.5)?);
    /// assert!(root.is_some_and(|root| root.contains(std::f64::consts::SQRT_2)));
    /// assert_eq!(Enclosure::point(-8.0)?.powf(Enclosure::ONE / 3.0), None);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    pub fn powf(self, exponent: Self) -> Option<Self> {
        if !(self.low >= 0.0 && self.low <= self.high) {
            return None;
        }
        if exponent.low.is_nan() || exponent.high.is_nan() || exponent.low > exponent.high {
            return Some(Enclosure { low: 0.0, high: f64::INFINITY });
        }
        // x^y is monotone in x and in y, so that its extremes are at corners: of x at and above 1, of x below 1. At
        // zero the powers of all signs of y are limits of others.
        let mut found = Enclosure { low: f64::INFINITY, high: 0.0 };
        for x in [self.low, self.high] {
            // −0 is zero.
            let x = x + 0.0;
            for y in [exponent.low, exponent.high] {
                let at = power_of(x, y);
                found = Enclosure { low: found.low.min(at.low), high: found.high.max(at.high) };
            }
        }
        let zero_and_less = self.low == 0.0 && exponent.low < 0.0;
        let jumps = self.low == 0.0 && exponent.low <= 0.0 && exponent.high >= 0.0;
        if zero_and_less {
            found.high = f64::INFINITY;
        }
        if jumps {
            // Next to (0, 0) there are powers of every size from 0 to ∞, or to 1.
            found.low = 0.0;
            found.high = found.high.max(1.0);
        }
        Some(Enclosure { low: found.low.max(0.0), high: found.high })
    }
}
