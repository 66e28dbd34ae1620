//! Guards along closed-form flows as functions of time: quasi-polynomials.

use super::quasi_term::{Coefficients, Term};
use super::rounded::Rounded;
use crate::error::Error;

/// A quasi-polynomial: g(t) = Σ exp(σₖt) (pₖ(t) cos ωₖt + qₖ(t) sin ωₖt), a sum of polynomials times exponentials,
/// sines and cosines. Quasi-polynomials are the solutions of linear differential equations with constant
/// coefficients. Along the flow of constant forces, springs and linear dampers, and of harmonic excitation, a guard
/// is a quasi-polynomial.
///
/// Sums, products and derivatives of quasi-polynomials are quasi-polynomials. Their coefficients give bounds over
/// an interval of time, so that the first zero is found with [certainty](crate::Certainty::Certain). Each
/// coefficient carries a bound on its rounding error. The coefficients given by the caller count as exact.
///
/// ```
/// use hybrid_system::{Direction, FirstCrossing, QuasiPolynomial};
/// // A parabola meets a sine: t²/2 − 4t + 5 sin t.
/// let height = QuasiPolynomial::polynomial(&[0.0, -4.0, 0.5]) + QuasiPolynomial::sine(5.0, 1.0);
/// let FirstCrossing::At { time, .. } = height.first_crossing(Direction::Falling, 20.0)? else {
///     panic!("it falls")
/// };
/// assert!((time * time / 2.0 - 4.0 * time + 5.0 * time.sin()).abs() < 1e-14);
///
/// // A damped oscillator falls below 1/10: exp(−t/5) cos 3t − 1/10.
/// let damped = QuasiPolynomial::cosine(1.0, 3.0).damped(0.2) - QuasiPolynomial::polynomial(&[0.1]);
/// let FirstCrossing::At { time, .. } = damped.first_crossing(Direction::Falling, 20.0)? else {
///     panic!("it falls")
/// };
/// assert!(((-0.2 * time).exp() * (3.0 * time).cos() - 0.1).abs() < 1e-15);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuasiPolynomial {
    terms: Vec<Term>,
}

fn exact(coefficients: &[f64]) -> Coefficients {
    coefficients.iter().copied().map(Rounded::exact).collect()
}

/// A number and the bound on its error.
type WithError = (f64, f64);

/// A term exp(σt) (p(t) cos ωt + q(t) sin ωt): σ, ω, and the coefficients of p and q, each with the bound on its error.
pub type QuasiPolynomialPart = (WithError, WithError, Vec<WithError>, Vec<WithError>);

impl QuasiPolynomial {
    /// All that it has, to be stored.
    pub fn to_parts(&self) -> Vec<QuasiPolynomialPart> {
        let pair = |number: &Rounded| (number.value, number.error);
        let all = |numbers: &[Rounded]| numbers.iter().map(pair).collect();
        let part =
            |term: &Term| (pair(&term.sigma), pair(&term.omega), all(&term.cos), all(&term.sin));
        self.terms.iter().map(part).collect()
    }

    /// The function with the parts that [`to_parts`](Self::to_parts) gave.
    pub fn from_parts(parts: Vec<QuasiPolynomialPart>) -> Self {
        let number = |(value, error): WithError| Rounded { value, error };
        let all =
            |pairs: Vec<WithError>| -> Coefficients { pairs.into_iter().map(number).collect() };
        let term = |(sigma, omega, cos, sin): QuasiPolynomialPart| Term {
            sigma: number(sigma),
            omega: number(omega),
            cos: all(cos),
            sin: all(sin),
        };
        QuasiPolynomial { terms: parts.into_iter().map(term).collect() }
    }

    /// A polynomial, lowest power first.
    pub fn polynomial(coefficients: &[f64]) -> Self {
        Self::of(Term { cos: exact(coefficients), ..Term::default() })
    }

    /// amplitude · sin ωt.
    pub fn sine(amplitude: f64, omega: f64) -> Self {
        let omega = Rounded::exact(omega);
        Self::of(Term { omega, sin: exact(&[amplitude]), ..Term::default() })
    }

    /// amplitude · cos ωt.
    pub fn cosine(amplitude: f64, omega: f64) -> Self {
        let omega = Rounded::exact(omega);
        Self::of(Term { omega, cos: exact(&[amplitude]), ..Term::default() })
    }

    /// amplitude · exp(rate · t). A negative rate is a decay.
    pub fn exponential(amplitude: f64, rate: f64) -> Self {
        let sigma = Rounded::exact(rate);
        Self::of(Term { sigma, cos: exact(&[amplitude]), ..Term::default() })
    }

    fn of(term: Term) -> Self {
        QuasiPolynomial { terms: vec![term.normalized()] }
    }

    /// The same function with frequencies at or above zero, so that like terms are found.
    #[cfg(feature = "ode")]
    pub(crate) fn normalized(self) -> Self {
        let terms = self.terms.into_iter().map(Term::normalized).collect();
        QuasiPolynomial { terms }
    }

    /// Adds a term to one of the same rate and frequency, or to the list.
    fn push(&mut self, term: Term) {
        match self.terms.iter_mut().find(|own| own.is_like(&term)) {
            Some(own) => own.add(&term),
            None => self.terms.push(term),
        }
    }

    /// The function with these terms.
    #[cfg(feature = "ode")]
    pub(crate) fn from_terms(terms: Vec<Term>) -> Self {
        QuasiPolynomial { terms }
    }

    pub(crate) fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// This quasi-polynomial times exp(−rate · t): the same motion with a damping of this rate.
    #[must_use]
    pub fn damped(mut self, rate: f64) -> Self {
        for term in &mut self.terms {
            term.sigma = term.sigma + Rounded::exact(-rate);
        }
        self
    }

    /// This quasi-polynomial times a number.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.cos.iter_mut().chain(&mut term.sin).for_each(|c| *c = *c * Rounded::exact(factor));
        }
        self
    }

    /// g(t); not finite where a term overflows.
    pub fn value(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.value(time)).sum()
    }

    /// The number of terms, and of the coefficients of the longest polynomial.
    #[cfg(feature = "ode")]
    pub(crate) fn size(&self) -> (usize, usize) {
        let longest = self.terms.iter().map(|term| term.cos.len().max(term.sin.len())).max();
        (self.terms.len(), longest.unwrap_or(0))
    }

    /// Σ e^(σt) Σ δ_k t^k with the errors δ_k of the coefficients, and of their terms by evaluation, where it is largest up to
    /// this time.
    #[cfg(feature = "ode")]
    pub(crate) fn error_until(&self, time: f64) -> f64 {
        self.terms.iter().map(|term| term.error_until(time)).sum()
    }

    /// g′.
    #[must_use]
    pub fn derivative(&self) -> Self {
        QuasiPolynomial { terms: self.terms.iter().map(Term::derivative).collect() }
    }

    /// g′(0).
    pub(super) fn slope_at_start(&self) -> Rounded {
        self.terms.iter().fold(Rounded::default(), |sum, term| sum + term.slope_at_start())
    }

    /// An error if a coefficient, a rate or a frequency is not finite.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for term in &self.terms {
            for number in term.cos.iter().chain(&term.sin).chain([&term.sigma, &term.omega]) {
                for value in [number.value, number.error] {
                    if !value.is_finite() {
                        return Err(Error::NotFinite { at: 0.0, value });
                    }
                }
            }
        }
        Ok(())
    }
}

impl std::ops::Add for QuasiPolynomial {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        other.terms.into_iter().for_each(|term| self.push(term));
        self
    }
}

impl std::ops::Neg for QuasiPolynomial {
    type Output = Self;
    fn neg(mut self) -> Self {
        for term in &mut self.terms {
            term.cos.iter_mut().chain(&mut term.sin).for_each(|c| *c = -*c);
        }
        self
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
    fn mul(self, other: Self) -> Self {
        let mut product = QuasiPolynomial::default();
        for a in &self.terms {
            for b in &other.terms {
                for term in a.times(b) {
                    product.push(term);
                }
            }
        }
        product
    }
}
