//! How long a step of Taylor's method may be, and the values of its polynomials.

/// How often a step is shortened for a series that bends more than the state. Each time it gets at least a tenth shorter;
/// two or three times are usual.
const MOST_SHORTENINGS: usize = 40;

/// The polynomial with these coefficients at x.
#[inline]
pub fn horner(series: &[f64], x: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// The length, at most `length`, at which the last two terms of a series, given by the sizes of its coefficients, are small
/// beside its largest one.
pub(crate) fn shortened(
    terms: usize,
    size: impl Fn(usize) -> f64,
    tolerance: f64,
    mut length: f64,
) -> f64 {
    let order = terms - 1;
    for _ in 0..MOST_SHORTENINGS {
        let last = size(order - 1).max(size(order) * length);
        if last == 0.0 {
            break;
        }
        let (mut power, mut largest) = (1.0, f64::MIN_POSITIVE);
        for k in 0..order - 1 {
            let term = size(k) * power;
            largest = if term > largest { term } else { largest };
            power *= length;
        }
        let too_large = last * power / (tolerance * largest);
        if !(too_large > 1.0) {
            break;
        }
        length *= root(too_large, order - 1).recip().clamp(1e-3, 0.9);
    }
    length
}

/// The error of a component of this size, where the largest one is `largest`, that a step may make. Without an absolute
/// tolerance a component may pass through zero: the largest one gives the scale.
#[inline]
pub(crate) fn allowed((absolute, relative): (f64, f64), size: f64, largest: f64) -> f64 {
    if absolute > 0.0 { absolute + relative * size } else { relative * largest }
}

/// The order for a relative tolerance. A step reaches to e⁻² of the radius of convergence: the term of order p is e^(−2p) of
/// the state there.
pub(crate) fn order_of(relative: f64) -> usize {
    ((1.0 - 0.5 * pxfm::f_log(relative)).ceil() as usize).max(2)
}

/// The part of the radius of convergence to which a step reaches: e⁻², and a factor that covers the terms that follow
/// (Jorba and Zou, Section 3.2).
pub(crate) fn safety(order: usize) -> f64 {
    pxfm::f_exp(-2.0 - 0.7 / (order - 1) as f64)
}

/// The value of a polynomial and its slope.
#[inline]
pub(crate) fn value_and_slope(series: &[f64], x: f64) -> (f64, f64) {
    let step = |(value, slope): (f64, f64), c: &f64| (value * x + c, slope * x + value);
    series.iter().rev().fold((0.0, 0.0), step)
}

/// The value of a polynomial, and the sum of the sizes of its terms.
#[inline]
pub(crate) fn value_and_size(series: &[f64], x: f64) -> (f64, f64) {
    let step = |(value, size): (f64, f64), c: &f64| (value * x + c, size * x.abs() + c.abs());
    series.iter().rev().fold((0.0, 0.0), step)
}

/// A power by products.
pub(crate) fn powi(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

/// The n-th root of a size, for the length of a step: to some ten digits, in a third of the time of a power.
#[inline]
pub(crate) fn root(size: f64, n: usize) -> f64 {
    pxfm::f_exp(pxfm::f_log(size) / n as f64)
}
