//! Numbers with derivatives: polynomials in one small number ε, cut off behind some terms.
//!
//! With x₀ + ε v for a state, the coefficient of ε^k of a result is its k-th derivative in the direction v, over k!. All
//! mixed derivatives are sums of such directional ones (A. Griewank, J. Utke, A. Walther, *Evaluating higher derivative
//! tensors by forward propagation of univariate Taylor series*, Math. Comp. 69, 2000).

use crate::algebra::Arithmetic;

/// A polynomial in ε with T terms: the value, the derivative, half of the second derivative, and so on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet<const T: usize>(pub [f64; T]);

impl<const T: usize> Jet<T> {
    /// A number without change.
    pub fn number(value: f64) -> Self {
        let mut terms = [0.0; T];
        terms.iter_mut().take(1).for_each(|first| *first = value);
        Jet(terms)
    }

    /// A number that changes at a rate.
    pub fn moving(value: f64, rate: f64) -> Self {
        let mut jet = Self::number(value);
        jet.0.iter_mut().skip(1).take(1).for_each(|first| *first = rate);
        jet
    }

    /// The value; 0 of a jet without terms.
    pub fn value(&self) -> f64 {
        self.0.first().copied().unwrap_or(0.0)
    }

    fn each(&self, f: impl Fn(f64) -> f64) -> Self {
        Jet(self.0.map(f))
    }

    fn with(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Jet(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }
}

impl<const T: usize> Arithmetic for Jet<T> {
    fn zero() -> Self {
        Jet([0.0; T])
    }

    fn one() -> Self {
        Self::number(1.0)
    }

    fn negative(x: &Self) -> Self {
        x.each(|x| -x)
    }

    fn sum(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x + y)
    }

    fn difference(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x - y)
    }

    fn product(x: &Self, y: &Self) -> Self {
        Jet(std::array::from_fn(|k| (0..=k).map(|j| x.0[j] * y.0[k - j]).sum()))
    }

    fn quotient(x: &Self, y: &Self) -> Self {
        let mut found = Self::zero();
        for k in 0..T {
            // x = z y: z_k = (x_k − Σ z_j y_{k−j})/y_0.
            let known: f64 = (0..k).map(|j| found.0[j] * y.0[k - j]).sum();
            found.0[k] = (x.0[k] - known) / y.0[0];
        }
        found
    }

    fn square(x: &Self) -> Self {
        Self::product(x, x)
    }

    fn convolution(x: &[Self], y: &[Self]) -> Self {
        x.iter()
            .zip(y.iter().rev())
            .fold(Self::zero(), |sum, (x, y)| Self::sum(&sum, &Self::product(x, y)))
    }

    fn times(x: &Self, k: f64) -> Self {
        x.each(|x| x * k)
    }

    fn is_valid(&self) -> bool {
        self.0.iter().all(|term| term.is_finite())
    }
}
