//! Guards along closed-form flows as functions of time: quasi-polynomials.

use crate::error::Error;

/// Roundings for each coefficient of a term and for each term of a sum: Horner's product and sum.
const ROUNDINGS_PER_COEFFICIENT: f64 = 2.0;

/// Roundings of the sine, the cosine and the two products with them.
const ROUNDINGS_OF_SINE_AND_COSINE: f64 = 4.0;

/// p(t) cos ωt + q(t) sin ωt, with polynomials p and q, lowest power first.
#[derive(Debug, Clone, PartialEq)]
struct Term {
    omega: f64,
    cos: Vec<f64>,
    sin: Vec<f64>,
}

/// A quasi-polynomial: g(t) = Σ pₖ(t) cos ωₖt + qₖ(t) sin ωₖt, a sum of polynomials times sines and cosines.
/// Quasi-polynomials are the solutions of linear differential equations with constant coefficients whose exponents are
/// imaginary. Along the flow of constant forces, undamped springs and harmonic excitation a guard is a
/// quasi-polynomial. (In general the pₖ may also multiply real exponentials, which this type does not support.)
///
/// Sums, products and derivatives of quasi-polynomials are quasi-polynomials. Their coefficients give bounds over an
/// interval of time, so that the first zero is found with [certainty](crate::Certainty::Certain).
///
/// ```
/// use hybrid_system::{Direction, FirstCrossing, QuasiPolynomial};
/// // A parabola meets a sine: t²/2 − 4t + 5 sin t.
/// let height = QuasiPolynomial::polynomial(&[0.0, -4.0, 0.5]) + QuasiPolynomial::sine(5.0, 1.0);
/// let FirstCrossing::At { time, .. } = height.first_crossing(Direction::Falling, 20.0)? else {
///     panic!("it falls")
/// };
/// assert!((time * time / 2.0 - 4.0 * time + 5.0 * time.sin()).abs() < 1e-14);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuasiPolynomial {
    terms: Vec<Term>,
}

impl QuasiPolynomial {
    /// A polynomial, lowest power first.
    pub fn polynomial(coefficients: &[f64]) -> Self {
        QuasiPolynomial {
            terms: vec![Term { omega: 0.0, cos: coefficients.to_vec(), sin: Vec::new() }],
        }
    }

    /// amplitude · sin ωt.
    pub fn sine(amplitude: f64, omega: f64) -> Self {
        QuasiPolynomial { terms: vec![Term { omega, cos: Vec::new(), sin: vec![amplitude] }] }
    }

    /// amplitude · cos ωt.
    pub fn cosine(amplitude: f64, omega: f64) -> Self {
        QuasiPolynomial { terms: vec![Term { omega, cos: vec![amplitude], sin: Vec::new() }] }
    }

    /// This quasi-polynomial times a number.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.cos.iter_mut().chain(&mut term.sin).for_each(|c| *c *= factor);
        }
        self
    }

    /// g(t).
    pub fn value(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.value(time)).sum()
    }

    /// g′.
    #[must_use]
    pub fn derivative(&self) -> Self {
        QuasiPolynomial { terms: self.terms.iter().map(Term::derivative).collect() }
    }

    /// An error if a coefficient or a frequency is not finite.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for term in &self.terms {
            for &value in term.cos.iter().chain(&term.sin).chain([&term.omega]) {
                if !value.is_finite() {
                    return Err(Error::NotFinite { at: 0.0, value });
                }
            }
        }
        Ok(())
    }

    /// Bound on |g(t)| for |t| ≤ `time`: Σ|pᵢ||t|ⁱ + Σ|qᵢ||t|ⁱ, because |cos|, |sin| ≤ 1.
    pub(crate) fn bound(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.bound(time)).sum()
    }

    /// True if the constant term is larger than all other terms together up to `time`: then there is no zero.
    ///
    /// For an oscillation about a large constant one comparison decides, however many periods it has. The search by
    /// intervals would need several intervals for each period.
    pub(crate) fn stays_away(&self, time: f64) -> bool {
        let polynomial = self.terms.iter().find(|term| term.omega == 0.0);
        let constant = polynomial.and_then(|term| term.cos.first()).map_or(0.0, |c| c.abs());
        // The bound contains the constant itself once: |c| > bound − |c|.
        2.0 * constant > self.bound(time) + self.rounding(time)
    }

    /// Bound on the rounding error of [`value`](Self::value) for |t| ≤ `time`.
    ///
    /// In units of ε times the bound of each term: two roundings for each coefficient (Horner's product and sum)
    /// and two for each term of the sum; four for the sine, the cosine and the two products with them; |ωt| for the
    /// rounding of the phase, which moves a sine by that much. Each rounding is ε/2 at most. The other half covers the
    /// products of roundings and the rounding of this bound itself, as long as there are fewer than some 10⁷ of them.
    ///
    /// The coefficients count as exact. Those of a derivative are rounded, by ε of each of the two terms of which they
    /// are sums. This bound does not contain that error. It matters where the two terms cancel.
    pub(crate) fn rounding(&self, time: f64) -> f64 {
        let of_term = |term: &Term| {
            let terms = (term.cos.len() + term.sin.len() + self.terms.len()) as f64;
            let roundings = ROUNDINGS_PER_COEFFICIENT * terms + ROUNDINGS_OF_SINE_AND_COSINE;
            (roundings + term.omega.abs() * time) * term.bound(time)
        };
        f64::EPSILON * self.terms.iter().map(of_term).sum::<f64>()
    }
}

impl Term {
    fn value(&self, time: f64) -> f64 {
        if self.omega == 0.0 {
            return horner(&self.cos, time);
        }
        let (sin, cos) = pxfm::f_sincos(self.omega * time);
        horner(&self.cos, time) * cos + horner(&self.sin, time) * sin
    }

    /// (p cos + q sin)′ = (p′ + ωq) cos + (q′ − ωp) sin.
    fn derivative(&self) -> Self {
        // The coefficients of p′ + factor·q. Without the sine (ω = 0) the degree decreases, so that the derivatives of
        // a polynomial end at zero.
        let sum = |slope: &[f64], factor: f64, other: &[f64]| {
            let length =
                slope.len().saturating_sub(1).max(if factor == 0.0 { 0 } else { other.len() });
            let power = |k: usize| {
                let from_slope = slope.get(k + 1).map_or(0.0, |c| c * (k + 1) as f64);
                from_slope + factor * other.get(k).copied().unwrap_or(0.0)
            };
            (0..length).map(power).collect()
        };
        Term {
            omega: self.omega,
            cos: sum(&self.cos, self.omega, &self.sin),
            sin: sum(&self.sin, -self.omega, &self.cos),
        }
    }

    fn bound(&self, time: f64) -> f64 {
        let size = |coefficients: &[f64]| {
            coefficients.iter().rev().fold(0.0, |sum, c| sum * time.abs() + c.abs())
        };
        size(&self.cos) + size(&self.sin)
    }
}

/// p(t) by Horner's scheme.
fn horner(coefficients: &[f64], time: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c)
}

impl std::ops::Add for QuasiPolynomial {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for term in other.terms {
            match self.terms.iter_mut().find(|own| own.omega == term.omega) {
                Some(own) => {
                    add_to(&mut own.cos, &term.cos);
                    add_to(&mut own.sin, &term.sin);
                }
                None => self.terms.push(term),
            }
        }
        self
    }
}

/// Adds the coefficients of `other` to those of `sum`.
fn add_to(sum: &mut Vec<f64>, other: &[f64]) {
    sum.resize(sum.len().max(other.len()), 0.0);
    for (own, term) in sum.iter_mut().zip(other) {
        *own += term;
    }
}

impl std::ops::Neg for QuasiPolynomial {
    type Output = Self;
    fn neg(self) -> Self {
        self.scaled(-1.0)
    }
}

impl std::ops::Sub for QuasiPolynomial {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for QuasiPolynomial {
    type Output = Self;
    /// By the addition theorems: with a = ω₁t and b = ω₂t,
    ///
    /// ```text
    ///   cos a cos b = ½[cos(a−b) + cos(a+b)]     sin a cos b = ½[sin(a−b) + sin(a+b)]
    ///   sin a sin b = ½[cos(a−b) − cos(a+b)]     cos a sin b = ½[−sin(a−b) + sin(a+b)]
    /// ```
    fn mul(self, other: Self) -> Self {
        let mut product = QuasiPolynomial::default();
        for a in &self.terms {
            for b in &other.terms {
                let (cc, ss) = (times(&a.cos, &b.cos), times(&a.sin, &b.sin));
                let (cs, sc) = (times(&a.cos, &b.sin), times(&a.sin, &b.cos));
                // ½(x + sign·y)
                let half = |x: &[f64], y: &[f64], sign: f64| {
                    let mut sum: Vec<f64> = x.iter().map(|c| 0.5 * c).collect();
                    add_to(&mut sum, &y.iter().map(|c| 0.5 * sign * c).collect::<Vec<_>>());
                    sum
                };
                let difference = Term {
                    omega: a.omega - b.omega,
                    cos: half(&cc, &ss, 1.0),
                    sin: half(&sc, &cs, -1.0),
                };
                let total = Term {
                    omega: a.omega + b.omega,
                    cos: half(&cc, &ss, -1.0),
                    sin: half(&sc, &cs, 1.0),
                };
                product = product
                    + QuasiPolynomial { terms: vec![difference] }
                    + QuasiPolynomial { terms: vec![total] };
            }
        }
        product
    }
}

/// The coefficients of a product of polynomials.
fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; (a.len() + b.len()).saturating_sub(1)];
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn quasi_polynomials() -> impl Strategy<Value = QuasiPolynomial> {
        let coefficients = || proptest::collection::vec(-3.0..3.0f64, 0..4);
        let term = (0..4i32, coefficients(), coefficients()).prop_map(|(k, cos, sin)| Term {
            omega: 0.7 * f64::from(k),
            cos,
            sin,
        });
        proptest::collection::vec(term, 0..4).prop_map(|terms| {
            terms.into_iter().fold(QuasiPolynomial::default(), |sum, term| {
                sum + QuasiPolynomial { terms: vec![term] }
            })
        })
    }

    proptest! {
        #[test]
        fn sums_products_and_derivatives(a in quasi_polynomials(), b in quasi_polynomials(), t in -3.0..3.0f64) {
            let close = |x: f64, y: f64, size: f64| (x - y).abs() <= 1e-12 * (1.0 + size);
            let size = a.bound(3.0) * b.bound(3.0) + a.bound(3.0) + b.bound(3.0);
            prop_assert!(close((a.clone() + b.clone()).value(t), a.value(t) + b.value(t), size));
            prop_assert!(close((a.clone() * b.clone()).value(t), a.value(t) * b.value(t), size));
            prop_assert!(close((-a.clone()).value(t), -a.value(t), size));
            let step = 1e-5;
            let difference = (a.value(t + step) - a.value(t - step)) / (2.0 * step);
            let third = a.derivative().derivative().derivative().bound(4.0);
            let slope = a.derivative().value(t);
            prop_assert!((difference - slope).abs() <= 1e-9 * (1.0 + third + a.bound(4.0)));
        }

        #[test]
        fn bounds_hold(a in quasi_polynomials(), t in -3.0..3.0f64) {
            prop_assert!(a.value(t).abs() <= a.bound(t.abs()) * (1.0 + 1e-14));
        }
    }
}
