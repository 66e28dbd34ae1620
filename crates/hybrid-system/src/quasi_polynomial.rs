//! Guards along closed-form flows as functions of time: sums of polynomials times sines and cosines.

use crate::Error;

/// p(t) cos ωt + q(t) sin ωt, with p and q polynomials, lowest power first.
#[derive(Debug, Clone, PartialEq)]
struct Term {
    omega: f64,
    cos: Vec<f64>,
    sin: Vec<f64>,
}

/// g(t) = Σ pₖ(t) cos ωₖt + qₖ(t) sin ωₖt: what a guard becomes along a flow of constant forces,
/// springs and their like.
///
/// It is closed under sums, products and derivatives, and bounds on it over an interval of time follow,
/// so that its first zero can be found with [certainty](crate::Certainty::Certain).
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

    /// This signal times a number.
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

    /// Whether all coefficients are finite numbers.
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

    /// Bound on |g| over times of size up to `time`.
    pub(crate) fn bound(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.bound(time)).sum()
    }

    /// Whether its constant term outweighs all others up to `time`: a small swing that never reaches zero,
    /// however many periods it has.
    pub(crate) fn stays_away(&self, time: f64) -> bool {
        let still = self.terms.iter().find(|term| term.omega == 0.0);
        let constant = still.and_then(|term| term.cos.first()).map_or(0.0, |c| c.abs());
        2.0 * constant > self.bound(time) + self.rounding(time)
    }

    /// Bound on the rounding error of [`value`](Self::value) over times of size up to `time`: of the sums,
    /// and of the phases ωt.
    pub(crate) fn rounding(&self, time: f64) -> f64 {
        let of = |term: &Term| {
            let terms = (term.cos.len() + term.sin.len() + self.terms.len()) as f64;
            (2.0 * terms + 4.0 + term.omega.abs() * time) * term.bound(time)
        };
        f64::EPSILON * self.terms.iter().map(of).sum::<f64>()
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

fn horner(coefficients: &[f64], time: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c)
}

impl std::ops::Add for QuasiPolynomial {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for term in other.terms {
            match self.terms.iter_mut().find(|own| own.omega == term.omega) {
                Some(own) => {
                    accumulate(&mut own.cos, &term.cos);
                    accumulate(&mut own.sin, &term.sin);
                }
                None => self.terms.push(term),
            }
        }
        self
    }
}

fn accumulate(sum: &mut Vec<f64>, other: &[f64]) {
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
    /// By the addition theorems.
    fn mul(self, other: Self) -> Self {
        let mut product = QuasiPolynomial::default();
        for a in &self.terms {
            for b in &other.terms {
                let (cc, ss) = (times(&a.cos, &b.cos), times(&a.sin, &b.sin));
                let (cs, sc) = (times(&a.cos, &b.sin), times(&a.sin, &b.cos));
                // cos a cos b = ½ [cos(a−b) + cos(a+b)], and so on.
                let half = |x: &[f64], y: &[f64], sign: f64| {
                    let mut sum: Vec<f64> = x.iter().map(|c| 0.5 * c).collect();
                    accumulate(&mut sum, &y.iter().map(|c| 0.5 * sign * c).collect::<Vec<_>>());
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

    fn signals() -> impl Strategy<Value = QuasiPolynomial> {
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
        fn sums_products_and_derivatives(a in signals(), b in signals(), t in -3.0..3.0f64) {
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
        fn bounds_hold(a in signals(), t in -3.0..3.0f64) {
            prop_assert!(a.value(t).abs() <= a.bound(t.abs()) * (1.0 + 1e-14));
        }
    }
}
