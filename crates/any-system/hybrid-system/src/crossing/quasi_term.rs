//! One term of a quasi-polynomial.

use super::rounded::Rounded;
use smallvec::SmallVec;

/// The coefficients of a polynomial. Those of an oscillation and of a fall are kept without allocating.
pub(crate) type Coefficients = SmallVec<[Rounded; 3]>;

/// The rounding of a term by its evaluation, in ulps of its coefficient.
#[cfg(feature = "ode")]
const TERM_ULPS: f64 = 2.0;

/// exp(σt) (p(t) cos ωt + q(t) sin ωt), with polynomials p and q, lowest power first, and ω ≥ 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Term {
    /// σ, the rate of growth.
    pub(crate) sigma: Rounded,
    /// ω, the frequency.
    pub(crate) omega: Rounded,
    /// p.
    pub(crate) cos: Coefficients,
    /// q.
    pub(crate) sin: Coefficients,
}

impl Term {
    /// The same function with ω ≥ 0, so that terms of the same frequency are found, and without a sine of zero.
    pub(crate) fn normalized(mut self) -> Self {
        if self.omega.value < 0.0 {
            self.omega = -self.omega;
            self.sin.iter_mut().for_each(|c| *c = -*c);
        }
        if self.omega == Rounded::default() {
            self.sin.clear();
        }
        self
    }

    /// True if both terms have the same rate and the same frequency, so that their coefficients can be added.
    pub(crate) fn is_like(&self, other: &Term) -> bool {
        self.sigma == other.sigma && self.omega == other.omega
    }

    /// Adds the coefficients of a term of the same rate and frequency.
    pub(crate) fn add(&mut self, other: &Term) {
        add_to(&mut self.cos, other.cos.iter().copied());
        add_to(&mut self.sin, other.sin.iter().copied());
    }

    pub(crate) fn value(&self, time: f64) -> f64 {
        let horner = |coefficients: &[Rounded]| {
            coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c.value)
        };
        let oscillation = if self.omega.value == 0.0 {
            horner(&self.cos)
        } else {
            let (sin, cos) = pxfm::f_sincos(self.omega.value * time);
            horner(&self.cos) * cos + horner(&self.sin) * sin
        };
        if self.sigma.value == 0.0 {
            oscillation
        } else {
            interval_arithmetic::exp(self.sigma.value * time) * oscillation
        }
    }

    /// e^(σt) Σ δ_k t^k where it is largest up to a time, with the errors δ_k of the coefficients and of their own evaluation.
    #[cfg(feature = "ode")]
    pub(crate) fn error_until(&self, time: f64) -> f64 {
        let error = |c: &Rounded| c.error + TERM_ULPS * f64::EPSILON * c.value.abs();
        let series = |coefficients: &[Rounded]| {
            coefficients.iter().rev().fold(0.0, |sum, c| sum * time.abs() + error(c))
        };
        let growth = self.sigma.value * time;
        let largest = if growth > 0.0 { interval_arithmetic::exp(growth) } else { 1.0 };
        largest * (series(&self.cos) + series(&self.sin))
    }

    /// (exp(σt)(p cos + q sin))′ = exp(σt)((p′ + σp + ωq) cos + (q′ + σq − ωp) sin).
    pub(crate) fn derivative(&self) -> Self {
        let (sigma, omega) = (self.sigma, self.omega);
        let slopes = |omega: Rounded, p: &[Rounded], q: &[Rounded]| {
            let length = slope_length(sigma, omega, p.len(), q.len());
            (0..length).map(|k| slope_coefficient(sigma, omega, (p, q), k)).collect()
        };
        let (cos, sin) =
            (slopes(omega, &self.cos, &self.sin), slopes(-omega, &self.sin, &self.cos));
        Term { sigma, omega, cos, sin }
    }

    /// The derivative at time zero: p₁ + σp₀ + ωq₀.
    pub(crate) fn slope_at_start(&self) -> Rounded {
        let at = |list: &[Rounded], k: usize| list.get(k).copied().unwrap_or_default();
        at(&self.cos, 1) + self.sigma * at(&self.cos, 0) + self.omega * at(&self.sin, 0)
    }

    /// The product of two terms. By the addition theorems, with a = ω₁t and b = ω₂t,
    ///
    /// ```text
    ///   cos a cos b = ½[cos(a−b) + cos(a+b)]     sin a cos b = ½[sin(a−b) + sin(a+b)]
    ///   sin a sin b = ½[cos(a−b) − cos(a+b)]     cos a sin b = ½[−sin(a−b) + sin(a+b)]
    /// ```
    pub(crate) fn times(&self, other: &Term) -> Vec<Term> {
        let sigma = self.sigma + other.sigma;
        // Without an oscillation there is no sum and difference of frequencies.
        if self.omega == Rounded::default() || other.omega == Rounded::default() {
            let (slow, fast) =
                if self.omega == Rounded::default() { (self, other) } else { (other, self) };
            let (cos, sin) = (product(&slow.cos, &fast.cos), product(&slow.cos, &fast.sin));
            return vec![Term { sigma, omega: fast.omega, cos, sin }];
        }
        let (cc, ss) = (product(&self.cos, &other.cos), product(&self.sin, &other.sin));
        let (cs, sc) = (product(&self.cos, &other.sin), product(&self.sin, &other.cos));
        // ½(x ± y)
        let half = |x: &[Rounded], y: &[Rounded], sign: f64| {
            let mut sum: Coefficients = x.iter().map(|c| c.shifted(0.5)).collect();
            add_to(
                &mut sum,
                y.iter().map(|c| if sign < 0.0 { -c.shifted(0.5) } else { c.shifted(0.5) }),
            );
            sum
        };
        let difference = Term {
            sigma,
            omega: self.omega + -other.omega,
            cos: half(&cc, &ss, 1.0),
            sin: half(&sc, &cs, -1.0),
        };
        let total = Term {
            sigma,
            omega: self.omega + other.omega,
            cos: half(&cc, &ss, -1.0),
            sin: half(&sc, &cs, 1.0),
        };
        vec![difference.normalized(), total.normalized()]
    }
}

/// Number of coefficients of p′ + σp + ωq, where p and q have these numbers of coefficients.
///
/// Without rate and frequency the degree decreases, so that the derivatives of a polynomial end at zero.
pub(crate) fn slope_length(sigma: Rounded, omega: Rounded, p: usize, q: usize) -> usize {
    let zero = Rounded::default();
    let from_p = if sigma == zero { p.saturating_sub(1) } else { p };
    from_p.max(if omega == zero { 0 } else { q })
}

/// Coefficient k of p′ + σp + ωq.
pub(crate) fn slope_coefficient(
    sigma: Rounded,
    omega: Rounded,
    (p, q): (&[Rounded], &[Rounded]),
    k: usize,
) -> Rounded {
    let at = |list: &[Rounded], k: usize| list.get(k).copied().unwrap_or_default();
    at(p, k + 1) * Rounded::exact((k + 1) as f64) + sigma * at(p, k) + omega * at(q, k)
}

/// Adds coefficients to those of `sum`.
fn add_to(sum: &mut Coefficients, other: impl ExactSizeIterator<Item = Rounded>) {
    sum.resize(sum.len().max(other.len()), Rounded::default());
    for (own, term) in sum.iter_mut().zip(other) {
        *own = *own + term;
    }
}

/// The coefficients of a product of polynomials.
fn product(a: &[Rounded], b: &[Rounded]) -> Coefficients {
    if a.is_empty() || b.is_empty() {
        return Coefficients::new();
    }
    let mut product = Coefficients::from_elem(Rounded::default(), a.len() + b.len() - 1);
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] = product[i + j] + *x * *y;
        }
    }
    product
}
