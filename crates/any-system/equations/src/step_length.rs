//! How long a step of Taylor's method may be, and the values of its polynomials.

use crate::elementwise::Elementwise;
use crate::series::Coefficients;
use crate::step::WATCHED_ERROR;
use crate::taylor_flow::TaylorFlow;

/// How often a step is shortened for a series that bends more than the state. Each time it gets at least a tenth shorter;
/// two or three times are usual.
const MOST_SHORTENINGS: usize = 40;

/// A term of a lower order may be so many times larger than the last two let expect. A smaller number shortens steps of
/// regular series; a larger one sees fewer of those with gaps, such as 1/(1 + x⁴).
const GAP: f64 = 1000.0;

/// For a watched formula a step is made no shorter than this part of it: next to a pole of the formula its values are
/// looked at instead.
const SHORTEST_FOR_WATCHED: f64 = 1.0 / 1024.0;

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
#[inline(always)]
pub(crate) fn allowed<A: Elementwise>((absolute, relative): (f64, f64), size: A, largest: A) -> A {
    match absolute > 0.0 {
        true => size.each(|size| absolute + relative * size),
        false => A::times(&largest, relative),
    }
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
#[inline(always)]
pub(crate) fn value_and_slope<A: Elementwise>(series: &[A], x: A) -> (A, A) {
    let add = |sum: A, c: A| A::sum(&A::product(&sum, &x), &c);
    let step = |(value, slope): (A, A), c: &A| (add(value, *c), add(slope, value));
    series.iter().rev().fold((A::zero(), A::zero()), step)
}

/// The value of a polynomial, and the sum of the sizes of its terms.
#[inline(always)]
pub(crate) fn value_and_size<A: Elementwise>(series: &[A], x: A) -> (A, A) {
    let size_of_x = x.size();
    let add = |sum: A, x: A, c: A| A::sum(&A::product(&sum, &x), &c);
    let step = |(value, size): (A, A), c: &A| (add(value, x, *c), add(size, size_of_x, c.size()));
    series.iter().rev().fold((A::zero(), A::zero()), step)
}

/// A power by products.
#[inline(always)]
fn powi(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

/// The n-th root of a size, for the length of a step: to nine digits, in a fraction of the time of a power, and side by
/// side for some states.
#[inline(always)]
pub(crate) fn root(size: f64, n: usize) -> f64 {
    let found = power_of_two(logarithm(size) / n as f64);
    // Also 0, ∞ and NaN.
    if size > 0.0 && size < f64::INFINITY { found } else { size }
}

/// 2⁵², whose last bit is 1: the integers below it are the last bits of a sum with it.
const INTEGERS: f64 = 4_503_599_627_370_496.0;

/// The bits of 1 without its exponent.
const FRACTION: u64 = (1 << 52) - 1;

/// The logarithm of a number above zero to the base 2: of the fraction by 2 artanh((m − 1)/(m + 1))/ln 2, for m between
/// √½ and √2.
#[inline(always)]
fn logarithm(x: f64) -> f64 {
    // Numbers below the smallest regular one lack an exponent.
    let (x, scale) = if x < f64::MIN_POSITIVE { (x * INTEGERS, 52.0) } else { (x, 0.0) };
    let exponent = f64::from_bits(INTEGERS.to_bits() | (x.to_bits() >> 52)) - INTEGERS - 1023.0;
    let fraction = f64::from_bits(1f64.to_bits() | (x.to_bits() & FRACTION));
    let is_large = fraction > std::f64::consts::SQRT_2;
    let m = if is_large { 0.5 * fraction } else { fraction };
    let exponent = if is_large { exponent + 1.0 } else { exponent };
    let s = (m - 1.0) / (m + 1.0);
    let q = s * s;
    let sum = 1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))));
    exponent - scale + s * sum * (2.0 * std::f64::consts::LOG2_E)
}

/// 2^x for x between −1022 and 1023; beyond them the value there.
#[inline(always)]
fn power_of_two(x: f64) -> f64 {
    let x = x.clamp(-1022.0, 1023.0);
    // To the nearest integer.
    let shifted = x + 1.5 * INTEGERS;
    let whole = shifted - 1.5 * INTEGERS;
    let u = (x - whole) * std::f64::consts::LN_2;
    let terms = [1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5];
    let sum = terms.iter().fold(0.0, |sum, term| sum * u + term);
    let fraction = 1.0 + u + u * u * sum;
    let exponent = (shifted.to_bits().wrapping_add(1023)) << 52;
    fraction * f64::from_bits(exponent)
}

impl TaylorFlow<'_> {
    /// The length of a step of whose state the terms that are left out are below the tolerances.
    #[inline(always)]
    pub(crate) fn length_for_state<A: Elementwise>(&self, coefficients: &Coefficients<A>) -> A {
        let mut sizes = [A::zero(); 2];
        let first = coefficients.states().map(|series| series[0].size());
        let largest = first.fold(A::zero(), A::larger);
        for (series, tolerances) in coefficients.states().zip(&self.tolerances) {
            let allowed = allowed(*tolerances, series[0].size(), largest);
            for (size, order) in sizes.iter_mut().zip([self.order - 1, self.order]) {
                // 0/0: a component that is zero and stays.
                *size = A::quotient(&series[order].size(), &allowed).larger(*size);
            }
        }
        let radius = |size: A, order: usize| {
            A::times(&size, self.tolerance).each(|size| root(size, order).recip())
        };
        let [before, last] = sizes;
        let radius = radius(before, self.order - 1).smaller(radius(last, self.order));
        let radius = radius.smaller(A::number(f64::MAX));
        let radius = self.without_gaps(coefficients, radius, largest);
        A::number(self.longest_step).smaller(A::times(&radius, safety(self.order)))
    }

    /// The radius at which terms of lower orders are no larger than the last two let expect.
    #[inline(always)]
    fn without_gaps<A: Elementwise>(
        &self,
        coefficients: &Coefficients<A>,
        mut radius: A,
        largest: A,
    ) -> A {
        let first = self.order / 2;
        for (series, tolerances) in coefficients.states().zip(&self.tolerances) {
            let allowed = allowed(*tolerances, series[0].size(), largest);
            let scale = allowed.each(|allowed| allowed / self.tolerance);
            let mut power = radius.each(|radius| powi(radius, first));
            for (k, coefficient) in series.iter().enumerate().skip(first) {
                let term = A::product(&coefficient.size(), &power);
                let gap = term.exceeds(A::times(&scale, GAP));
                if gap.any() {
                    let own = A::quotient(&coefficient.size(), &scale);
                    radius = gap.select(own.each(|own| root(own, k).recip()), radius);
                    power = gap.select(radius.each(|radius| powi(radius, k)), power);
                }
                power = A::product(&power, &radius);
            }
        }
        radius
    }

    /// The length at which also the last terms of the watched formulas are small beside their largest ones: a formula
    /// may bend more than the state, as sin(x) does along x = t. `of` takes the number of one state.
    #[inline(always)]
    pub(crate) fn length_for_watched<A: Elementwise>(
        &self,
        coefficients: &Coefficients<A>,
        of: impl Fn(&A) -> f64,
        length: f64,
    ) -> f64 {
        let least = SHORTEST_FOR_WATCHED * length;
        coefficients.all_watched().fold(length, |length, series| {
            let tolerance = WATCHED_ERROR * self.tolerance;
            let found = shortened(series.len(), |k| of(&series[k]).abs(), tolerance, length);
            // Without values there is nothing to be shortened for.
            if found >= least { found } else { length.min(least) }
        })
    }
}
