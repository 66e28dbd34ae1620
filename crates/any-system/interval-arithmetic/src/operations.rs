//! + − × ÷, squares and roots.

use crate::enclosure::Enclosure;
use crate::rounding::{down, sum_down, sum_up, up};
use std::ops::{Add, Div, Mul, Neg, Sub};

impl Neg for Enclosure {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Enclosure { low: -self.high, high: -self.low }
    }
}

impl Add for Enclosure {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Enclosure { low: down(self.low + other.low), high: up(self.high + other.high) }
    }
}

impl Sub for Enclosure {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Enclosure { low: down(self.low - other.high), high: up(self.high - other.low) }
    }
}

/// The smallest and the largest of four numbers; NaN if one of them is.
#[inline]
fn extremes(all: [f64; 4]) -> (f64, f64) {
    let sum = all[0] + all[1] + all[2] + all[3];
    if sum.is_nan() && all.iter().any(|x| x.is_nan()) {
        return (f64::NAN, f64::NAN);
    }
    let low = all[0].min(all[1]).min(all[2].min(all[3]));
    (low, all[0].max(all[1]).max(all[2].max(all[3])))
}

impl Mul for Enclosure {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (low, high) = if self.low >= 0.0 && other.low >= 0.0 {
            (self.low * other.low, self.high * other.high)
        } else {
            extremes([
                self.low * other.low,
                self.low * other.high,
                self.high * other.low,
                self.high * other.high,
            ])
        };
        Enclosure { low: down(low), high: up(high) }
    }
}

/// The quotient; all numbers if the divisor holds zero inside. With zero as an end of the divisor, the quotient by its
/// other numbers: without a bound on one side, if the dividend has one sign.
///
/// ```
/// # use interval_arithmetic::Enclosure;
/// let near = Enclosure::ONE / Enclosure::between(0.0, 0.5)?;
/// assert!(near.low() > 1.99 && near.high() == f64::INFINITY);
/// # Ok::<(), interval_arithmetic::Error>(())
/// ```
impl Div for Enclosure {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.sign().is_none() {
            return self.divided_by_an_end_at_zero(other);
        }
        let (low, high) = extremes([
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ]);
        Enclosure { low: down(low), high: up(high) }
    }
}

// The `f64` is taken as the exact number that it is.
macro_rules! with_numbers {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator<f64> for Enclosure {
            type Output = Self;
            #[inline]
            fn $method(self, number: f64) -> Self {
                self.$method(Enclosure::from(number))
            }
        }
        impl $operator<Enclosure> for f64 {
            type Output = Enclosure;
            #[inline]
            fn $method(self, other: Enclosure) -> Enclosure {
                Enclosure::from(self).$method(other)
            }
        }
    )*};
}
with_numbers!(Add add, Sub sub, Mul mul, Div div);

impl Enclosure {
    /// The quotients by the numbers beside zero of a divisor that holds it.
    #[cold]
    fn divided_by_an_end_at_zero(self, other: Self) -> Self {
        if other.high == 0.0 && other.low < 0.0 {
            return (-self).divided_by_an_end_at_zero(-other);
        }
        if !(other.low == 0.0 && 0.0 < other.high) {
            return Enclosure::WHOLE;
        }
        // The divisors are from zero, without it, up to other.high.
        if self.low >= 0.0 && self.low <= self.high {
            Enclosure { low: down(self.low / other.high).max(0.0), high: f64::INFINITY }
        } else if self.high <= 0.0 && self.low <= self.high {
            Enclosure { low: f64::NEG_INFINITY, high: up(self.high / other.high).min(0.0) }
        } else {
            Enclosure::WHOLE
        }
    }

    /// The difference, with each end moved outwards only if it was rounded inwards: up to two `f64` narrower than
    /// by `−`, and slower.
    #[inline]
    pub fn sharp_difference(self, other: Self) -> Self {
        Enclosure { low: sum_down(self.low, -other.high), high: sum_up(self.high, -other.low) }
    }

    /// The absolute values.
    #[inline]
    pub fn abs(self) -> Self {
        if self.low >= 0.0 && self.low <= self.high {
            self
        } else if self.high <= 0.0 && self.low <= self.high {
            -self
        } else {
            Enclosure { low: 0.0, high: self.magnitude() }
        }
    }

    /// The squares: never below zero, unlike `x * x`.
    #[inline]
    pub fn squared(self) -> Self {
        let size = self.abs();
        let product = size * size;
        Enclosure { low: product.low.max(0.0), high: product.high }
    }

    /// The square roots; `None` if a number below zero is among the values.
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let two = Enclosure::point(2.0)?;
    /// assert!(two.sqrt().is_some_and(|root| root.squared().contains(2.0)));
    /// assert_eq!(Enclosure::between(-1e-300, 2.0)?.sqrt(), None);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn sqrt(self) -> Option<Self> {
        (self.low >= 0.0)
            .then(|| Enclosure { low: down(self.low.sqrt()).max(0.0), high: up(self.high.sqrt()) })
    }
}
