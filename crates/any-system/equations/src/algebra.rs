//! What formulas are computed in: numbers, or enclosures of numbers.

use crate::constant::Constant;
use crate::function::Function;
use crate::node::{Binary, Unary};
use interval_arithmetic::Enclosure;

/// What the coefficients of series are computed with.
pub trait Arithmetic: Clone {
    /// The number 0.
    fn zero() -> Self;
    /// The number 1.
    fn one() -> Self;
    /// −x.
    fn negative(x: &Self) -> Self;
    /// x + y.
    fn sum(x: &Self, y: &Self) -> Self;
    /// x − y.
    fn difference(x: &Self, y: &Self) -> Self;
    /// x y.
    fn product(x: &Self, y: &Self) -> Self;
    /// x / y. Where y may be zero the value is not [valid](Self::is_valid).
    fn quotient(x: &Self, y: &Self) -> Self;
    /// The square of a number: an enclosure of it is never below zero.
    fn square(x: &Self) -> Self;
    /// Whether the coefficients of a series are kept in reverse as well, so that a [convolution](Self::convolution) is one of
    /// two lists that are read forward: neighbours then fill a vector.
    const REVERSED: bool = false;
    /// Σ x_k y_{n−1−k} of two lists of the same length n; `y` is given from its last number to its first where
    /// [`REVERSED`](Self::REVERSED) is true. Of `f64` in an order that vectors of any width have: four sums, of k = 0, 4, 8,
    /// …, of k = 1, 5, … and so on, and then what is left at the end.
    fn convolution(x: &[Self], y: &[Self]) -> Self;
    /// x · k.
    fn times(x: &Self, k: f64) -> Self;
    /// x / k, of a whole number k above zero; `inverse` is the `f64` next to 1/k. A product takes a fourth of the time of a
    /// quotient, and has one more rounding.
    #[inline(always)]
    fn over(x: &Self, _k: f64, inverse: f64) -> Self {
        Self::times(x, inverse)
    }
    /// True if there is a value, and it is finite.
    fn is_valid(&self) -> bool;
}

/// A kind of number in which every part of a formula has a value.
pub trait Algebra: Arithmetic {
    /// A number of the formula.
    fn constant(constant: &Constant) -> Self;
    /// A function of one number. Outside its domain the value is not [valid](Arithmetic::is_valid).
    fn unary(function: Unary, x: &Self) -> Self;
    /// A function of two numbers. Outside its domain the value is not [valid](Arithmetic::is_valid).
    fn binary(function: Binary, x: &Self, y: &Self) -> Self;
    /// A user's function of one number. Outside its domain the value is not [valid](Arithmetic::is_valid).
    fn call(function: &Function, x: &Self) -> Self;
}

/// Each function of one `f64`.
#[inline]
pub(crate) fn of_number(function: Unary) -> fn(f64) -> f64 {
    match function {
        Unary::Negative => |x| -x,
        Unary::SquareRoot => f64::sqrt,
        Unary::Exponential => interval_arithmetic::exp,
        Unary::Logarithm => pxfm::f_log,
        Unary::Sine => pxfm::f_sin,
        Unary::Cosine => pxfm::f_cos,
        Unary::Tangent => pxfm::f_tan,
        Unary::ArcSine => pxfm::f_asin,
        Unary::ArcCosine => pxfm::f_acos,
        Unary::ArcTangent => pxfm::f_atan,
        Unary::HyperbolicSine => pxfm::f_sinh,
        Unary::HyperbolicCosine => pxfm::f_cosh,
        Unary::HyperbolicTangent => pxfm::f_tanh,
        // Where the cosine is above all `f64`, the secant is below 10⁻³⁰⁸.
        Unary::HyperbolicSecant => |x| 1.0 / pxfm::f_cosh(x),
        Unary::InverseHyperbolicSine => pxfm::f_asinh,
        Unary::InverseHyperbolicCosine => pxfm::f_acosh,
        Unary::InverseHyperbolicTangent => pxfm::f_atanh,
        Unary::Absolute => f64::abs,
        // 0 of 0, which `signum` does not give.
        Unary::Sign => |x| if x == 0.0 { 0.0 } else { x.signum() },
    }
}

/// x^y for x ≥ 0. The powers of forces over distances are products of a root, to two units in the last place and in a
/// tenth of the time.
#[inline(always)]
fn power(x: f64, y: f64) -> f64 {
    if y == -1.5 {
        let inverse = 1.0 / x;
        inverse * inverse.sqrt()
    } else if y == 1.5 {
        x * x.sqrt()
    } else if y == -0.5 {
        1.0 / x.sqrt()
    } else if y == 0.5 {
        x.sqrt()
    } else {
        interval_arithmetic::pow(x, y)
    }
}

impl Arithmetic for f64 {
    fn one() -> Self {
        1.0
    }

    #[inline]
    fn negative(x: &Self) -> Self {
        -x
    }

    #[inline]
    fn sum(x: &Self, y: &Self) -> Self {
        x + y
    }

    #[inline]
    fn difference(x: &Self, y: &Self) -> Self {
        x - y
    }

    #[inline]
    fn product(x: &Self, y: &Self) -> Self {
        x * y
    }

    #[inline]
    fn quotient(x: &Self, y: &Self) -> Self {
        x / y
    }

    #[inline]
    fn square(x: &Self) -> Self {
        x * x
    }

    const REVERSED: bool = true;

    #[inline(always)]
    fn convolution(x: &[Self], y: &[Self]) -> Self {
        let ((x, x_left), (y, y_left)) = (x.as_chunks::<4>(), y.as_chunks::<4>());
        let mut sums = [0.0; 4];
        for (x, y) in x.iter().zip(y) {
            for ((sum, x), y) in sums.iter_mut().zip(x).zip(y) {
                *sum += x * y;
            }
        }
        let sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
        x_left.iter().zip(y_left).fold(sum, |sum, (x, y)| sum + x * y)
    }

    #[inline]
    fn times(x: &Self, k: f64) -> Self {
        x * k
    }

    fn zero() -> Self {
        0.0
    }

    #[inline]
    fn is_valid(&self) -> bool {
        self.is_finite()
    }
}

impl Algebra for f64 {
    fn constant(constant: &Constant) -> Self {
        constant.value()
    }

    #[inline(always)]
    fn unary(function: Unary, x: &Self) -> Self {
        of_number(function)(*x)
    }

    #[inline]
    fn binary(function: Binary, x: &Self, y: &Self) -> Self {
        let (x, y) = (*x, *y);
        match function {
            Binary::Sum => x + y,
            Binary::Difference => x - y,
            Binary::Product => x * y,
            Binary::Quotient => x / y,
            // A base below zero has integer powers only, which are products.
            Binary::Power if x < 0.0 => f64::NAN,
            Binary::Power => power(x, y),
            // −0 is zero.
            Binary::ArcTangent2 if x == 0.0 && y == 0.0 => f64::NAN,
            Binary::ArcTangent2 => pxfm::f_atan2(x + 0.0, y + 0.0),
            // Minima of `f64` pass over NaN.
            Binary::Minimum if x.is_nan() || y.is_nan() => f64::NAN,
            Binary::Maximum if x.is_nan() || y.is_nan() => f64::NAN,
            Binary::Minimum => x.min(y),
            Binary::Maximum => x.max(y),
        }
    }

    fn call(function: &Function, x: &Self) -> Self {
        function.value(*x)
    }
}

/// Outside of a domain.
const NO_VALUE: Enclosure = Enclosure::new(f64::NAN, f64::NAN);

impl Arithmetic for Enclosure {
    fn one() -> Self {
        Enclosure::ONE
    }

    fn negative(x: &Self) -> Self {
        if x.is_valid() { -*x } else { NO_VALUE }
    }

    fn sum(x: &Self, y: &Self) -> Self {
        if x.is_valid() && y.is_valid() { *x + *y } else { NO_VALUE }
    }

    fn difference(x: &Self, y: &Self) -> Self {
        if x.is_valid() && y.is_valid() { *x - *y } else { NO_VALUE }
    }

    fn product(x: &Self, y: &Self) -> Self {
        if x.is_valid() && y.is_valid() { *x * *y } else { NO_VALUE }
    }

    fn quotient(x: &Self, y: &Self) -> Self {
        let defined = x.is_valid() && y.is_valid() && !y.contains(0.0);
        if defined { *x / *y } else { NO_VALUE }
    }

    fn square(x: &Self) -> Self {
        if x.is_valid() { x.squared() } else { NO_VALUE }
    }

    /// The ends are summed with rounding to nearest, and moved outwards once, by a bound of all roundings: of n products p and their sums
    /// they are below (n + 1) u Σ|p|, with u = 2⁻⁵³, and n times the smallest number for products that underflow.
    fn convolution(x: &[Self], y: &[Self]) -> Self {
        let (mut low, mut high, mut size, mut all) = (0.0, 0.0, 0.0, 0.0);
        for (x, y) in x.iter().zip(y.iter().rev()) {
            let (a, b) = (x.low() * y.low(), x.low() * y.high());
            let (c, d) = (x.high() * y.low(), x.high() * y.high());
            let (least, most) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
            low += least;
            high += most;
            size += least.abs().max(most.abs());
            // Minima and maxima pass over NaN, sums do not.
            all += (a + b) + (c + d);
        }
        if !f64::is_finite(all) {
            return NO_VALUE;
        }
        let count = x.len() as f64;
        // One more for the rounding of the bound itself.
        let error = (count + 2.0) * (0.5 * f64::EPSILON) * size + count * f64::from_bits(1);
        match error == 0.0 {
            true => Enclosure::ZERO,
            false => Enclosure::new((low - error).next_down(), (high + error).next_up()),
        }
    }

    fn times(x: &Self, k: f64) -> Self {
        if x.is_valid() { *x * k } else { NO_VALUE }
    }

    fn over(x: &Self, k: f64, _: f64) -> Self {
        if x.is_valid() { *x / Enclosure::from(k) } else { NO_VALUE }
    }

    fn zero() -> Self {
        Enclosure::ZERO
    }

    fn is_valid(&self) -> bool {
        self.low() <= self.high() && self.low().is_finite() && self.high().is_finite()
    }
}

impl Algebra for Enclosure {
    fn constant(constant: &Constant) -> Self {
        constant.enclosure()
    }

    fn unary(function: Unary, x: &Self) -> Self {
        if !x.is_valid() {
            return NO_VALUE;
        }
        let x = *x;
        match function {
            Unary::Negative => -x,
            Unary::SquareRoot => x.sqrt().unwrap_or(NO_VALUE),
            Unary::Exponential => x.exp(),
            Unary::Logarithm => x.ln().unwrap_or(NO_VALUE),
            Unary::Sine => x.sin(),
            Unary::Cosine => x.cos(),
            Unary::Tangent => x.tan(),
            Unary::ArcSine => x.asin().unwrap_or(NO_VALUE),
            Unary::ArcCosine => x.acos().unwrap_or(NO_VALUE),
            Unary::ArcTangent => x.arctan(),
            Unary::HyperbolicSine => x.sinh(),
            Unary::HyperbolicCosine => x.cosh(),
            Unary::HyperbolicTangent => x.tanh(),
            Unary::HyperbolicSecant => Enclosure::ONE / x.cosh(),
            Unary::InverseHyperbolicSine => x.asinh(),
            Unary::InverseHyperbolicCosine => x.acosh().unwrap_or(NO_VALUE),
            Unary::InverseHyperbolicTangent => x.atanh().unwrap_or(NO_VALUE),
            Unary::Absolute => x.abs(),
            Unary::Sign => {
                let sign = |end: f64| f64::unary(Unary::Sign, &end);
                Enclosure::new(sign(x.low()), sign(x.high()))
            }
        }
    }

    fn binary(function: Binary, x: &Self, y: &Self) -> Self {
        if !(x.is_valid() && y.is_valid()) {
            return NO_VALUE;
        }
        let (x, y) = (*x, *y);
        match function {
            Binary::Sum => Self::sum(&x, &y),
            Binary::Difference => Self::difference(&x, &y),
            Binary::Product => Self::product(&x, &y),
            Binary::Quotient => Self::quotient(&x, &y),
            Binary::Power if x.low() < 0.0 => NO_VALUE,
            Binary::Power => x.powf(y).unwrap_or(NO_VALUE),
            Binary::ArcTangent2 if x.contains(0.0) && y.contains(0.0) => NO_VALUE,
            Binary::ArcTangent2 => x.atan2(y),
            Binary::Minimum => Enclosure::new(x.low().min(y.low()), x.high().min(y.high())),
            Binary::Maximum => Enclosure::new(x.low().max(y.low()), x.high().max(y.high())),
        }
    }

    fn call(function: &Function, x: &Self) -> Self {
        if x.is_valid() { function.enclosure(*x).unwrap_or(NO_VALUE) } else { NO_VALUE }
    }
}
