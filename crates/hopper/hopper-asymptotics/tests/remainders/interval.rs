//! Enclosures as the remainders need them.

use interval_arithmetic::Enclosure;

/// The quotient of two numbers that are exact.
pub(crate) fn fraction(numerator: f64, denominator: f64) -> Enclosure {
    Enclosure::from(numerator) / Enclosure::from(denominator)
}

/// The cube root; pxfm rounds it correctly.
pub(crate) fn cube_root(of: Enclosure) -> Enclosure {
    Enclosure::new(pxfm::f_cbrt(of.low()).next_down(), pxfm::f_cbrt(of.high()).next_up())
}

/// The numbers from `low` to `high` in `parts` parts.
pub(crate) fn split(low: f64, high: f64, parts: u32) -> Vec<Enclosure> {
    let at = |k: u32| {
        if k == parts { high } else { low + (high - low) * f64::from(k) / f64::from(parts) }
    };
    (0..parts).map(|k| Enclosure::new(at(k), at(k + 1))).collect()
}
