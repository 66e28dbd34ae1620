//! Offsets from a fixed point that are smaller than any `f64`.

use crate::error::Error;
use crate::fatou::phase::split;
use crate::fatou::quotient::{nearest_quotient, rational};
use num_bigint::BigUint;
use std::fmt;
use std::str::FromStr;

/// Powers of ten that take every `f64` beyond the largest one, or below half of the smallest one.
const BEYOND_DOUBLES: i64 = 640;

/// An offset δ from a fixed point: exactly `mantissa` · 10^`exponent`.
///
/// ```
/// use hopper_asymptotics::Offset;
/// let deep: Offset = "-3.7e-1000".parse()?;
/// assert_eq!(deep, Offset::new(-3.7, -1000)?);
/// assert_eq!(deep.to_string(), "-3.7e-1000");
/// assert_eq!(Offset::from(-1e-12).nearest(), -1e-12);
/// # Ok::<(), hopper_asymptotics::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    mantissa: f64,
    exponent: i64,
}

impl Offset {
    /// The largest |`exponent`|. The digits of a phase need a time that grows with the square of the exponent: some
    /// tenths of a second here. A deeper point is given by its [`Phase`](crate::Phase).
    pub const LARGEST_EXPONENT: i64 = 10_000;

    /// `mantissa` · 10^`exponent`.
    ///
    /// # Errors
    /// [`Error::Offset`] for a mantissa that is not finite, and for |`exponent`| above
    /// [`LARGEST_EXPONENT`](Self::LARGEST_EXPONENT).
    pub fn new(mantissa: f64, exponent: i64) -> Result<Self, Error> {
        if mantissa.is_finite() && exponent.unsigned_abs() <= Self::LARGEST_EXPONENT as u64 {
            Ok(Offset { mantissa, exponent })
        } else {
            Err(Error::Offset { text: format!("{mantissa:e} · 10^{exponent}") })
        }
    }

    /// The factor before the power of ten.
    pub fn mantissa(self) -> f64 {
        self.mantissa
    }

    /// The exponent of ten.
    pub fn exponent(self) -> i64 {
        self.exponent
    }

    /// The nearest `f64`, or one next to it if that is below the smallest normal one; ±∞ above the largest one.
    pub fn nearest(self) -> f64 {
        // A mantissa is between 10⁻³²⁴ and 10³⁰⁹: no `f64` is as large or as small as the offset then.
        if self.exponent.abs() > BEYOND_DOUBLES && self.mantissa != 0.0 {
            return self.mantissa * if self.exponent > 0 { f64::INFINITY } else { 0.0 };
        }
        let (p, q) = rational(self.mantissa.abs());
        let power = BigUint::from(10u32).pow(self.exponent.unsigned_abs() as u32);
        let (p, q) = if self.exponent < 0 { (p, q * power) } else { (p * power, q) };
        nearest_quotient(&p, &q).copysign(self.mantissa)
    }

    /// −log₁₀ |δ|, the number of decades below 1; ∞ for the offset 0.
    ///
    /// ```
    /// use hopper_asymptotics::Offset;
    /// assert_eq!(Offset::new(-1.0, -300)?.depth(), 300.0);
    /// assert_eq!(Offset::from(0.0).depth(), f64::INFINITY);
    /// # Ok::<(), hopper_asymptotics::Error>(())
    /// ```
    pub fn depth(self) -> f64 {
        -(pxfm::f_log10(self.mantissa.abs()) + self.exponent as f64)
    }

    /// For exponents beyond [`LARGEST_EXPONENT`](Self::LARGEST_EXPONENT), which a phase may have.
    pub(crate) fn deep(mantissa: f64, exponent: i64) -> Self {
        Offset { mantissa, exponent }
    }

    /// With the sign of `sign`.
    pub(crate) fn with_sign(self, sign: f64) -> Self {
        Offset { mantissa: self.mantissa.copysign(sign), ..self }
    }

    /// Bits of [`logarithm_in_units`](Self::logarithm_in_units) after the point.
    pub(crate) const LOGARITHM_BITS: u64 = 96;

    /// ln |δ| in units 2⁻⁹⁶, for an offset other than 0. The error is that of one logarithm between ln ½ and 0: 2⁻⁵⁴.
    pub(crate) fn logarithm_in_units(self) -> i128 {
        // ln 2 and ln 10 in these units, to the nearest integer. The products err by 2⁻⁸² at most.
        const LN_2: i128 = 54_916_777_467_707_473_351_141_471_128;
        const LN_10: i128 = 182_429_585_950_654_714_090_129_938_606;
        let (digits, power) = split(self.mantissa.abs());
        let logarithm = (pxfm::f_log(digits) * 2f64.powi(96)) as i128;
        logarithm + i128::from(power) * LN_2 + i128::from(self.exponent) * LN_10
    }

    /// ln |δ|.
    pub(crate) fn logarithm(self) -> f64 {
        self.logarithm_in_units() as f64 * 0.5f64.powi(96)
    }
}

/// Exact; an offset that is not finite becomes 0, which no expansion accepts.
impl From<f64> for Offset {
    fn from(delta: f64) -> Self {
        Offset { mantissa: if delta.is_finite() { delta } else { 0.0 }, exponent: 0 }
    }
}

impl fmt::Display for Offset {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:e}", self.mantissa);
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        let power: i64 = power.parse().unwrap_or(0);
        match power + self.exponent {
            0 => write!(out, "{digits}"),
            power => write!(out, "{digits}e{power}"),
        }
    }
}

impl FromStr for Offset {
    type Err = Error;

    /// A decimal number. Its digits are rounded to the nearest `f64`; its exponent is kept.
    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong = || Error::Offset { text: text.to_owned() };
        let (digits, power) = match text.split_once(['e', 'E']) {
            Some((digits, power)) => (digits, power.parse().map_err(|_| wrong())?),
            None => (text, 0),
        };
        Offset::new(digits.parse().map_err(|_| wrong())?, power).map_err(|_| wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_read_back_and_wrong_ones_refused() {
        for text in ["-1e-12", "2.5", "-7.25e-9999", "1e10000"] {
            let offset: Offset = text.parse().unwrap();
            assert_eq!(offset.to_string().parse::<Offset>().unwrap().nearest(), offset.nearest());
        }
        for text in ["", "e-3", "1e", "1e-10001", "nan", "inf", "1e9999999999999999999", "1e2.5"] {
            let error = text.parse::<Offset>().unwrap_err();
            assert!(error.to_string().contains(text), "{error}");
        }
    }

    #[test]
    fn logarithms_have_all_their_digits() {
        // ln 2 − 1000 ln 10 = −2301.89194581348573870857072…
        let units = Offset::new(-2.0, -1000).unwrap().logarithm_in_units();
        let whole = units >> 96;
        let rest = (units - (whole << 96)) as f64 * 0.5f64.powi(96);
        assert_eq!(whole, -2302);
        assert!((rest - 0.108_054_186_514_261_3).abs() < 6e-17, "{rest:e}");
        assert!(Offset::from(1.0).logarithm().abs() < 6e-17);
        assert_eq!(Offset::new(-2.0, -1000).unwrap().nearest(), 0.0);
        assert_eq!(Offset::new(3e-300, 295).unwrap().nearest(), 3e-5);
        assert_eq!(Offset::new(-2.0, 1000).unwrap().nearest(), f64::NEG_INFINITY);
        assert_eq!(Offset::new(0.0, 1000).unwrap().nearest(), 0.0);
    }
}
