//! Truncated polynomials without bounds, for the first solution of an equation; and what they share with Taylor models.

/// The number of terms. More terms cost time with their square; fewer leave more hops to be followed one by one.
/// With sixteen the series of a Fatou coordinate has an error of 3·10⁻¹³ at A x ≈ 0.035, and 10⁻⁶ at 0.12.
pub(crate) const ORDER: usize = 16;

/// Σ t_k u^k, k < ORDER. Higher terms are dropped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Polynomial(pub(crate) [f64; ORDER]);

/// 1, y, y², … for y = O(u²), up to the first power without a term below u^ORDER.
pub(crate) const EVEN_POWERS: usize = ORDER / 2 + 1;

/// The operations of an equation that is solved for polynomials, and then bounded with models.
pub(crate) trait Truncated: Copy {
    /// A number without error.
    fn number(value: f64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// −self.
    fn negative(&self) -> Self;
    /// (`factor` · u) · self, for an exact factor.
    fn shifted_by(&self, factor: f64) -> Self;
    /// Σ c_j y^j for coefficients with a relative error of 4ε, from the powers 1, y, … of a y that is O(u²). The
    /// last power is O(u^ORDER), and the terms beyond it are together at most as large as the last one.
    fn combination(powers: &[Self; EVEN_POWERS], coefficients: [f64; EVEN_POWERS]) -> Self;
}

impl Polynomial {
    /// 1/self, for a constant term other than 0.
    pub(crate) fn reciprocal(&self) -> Self {
        let mut inverse = [0.0; ORDER];
        inverse[0] = 1.0 / self.0[0];
        for k in 1..ORDER {
            let sum: f64 = (1..=k).map(|j| self.0[j] * inverse[k - j]).sum();
            inverse[k] = -sum * inverse[0];
        }
        Polynomial(inverse)
    }
}

impl Truncated for Polynomial {
    fn number(value: f64) -> Self {
        let mut terms = [0.0; ORDER];
        terms[0] = value;
        Polynomial(terms)
    }

    fn plus(&self, other: &Self) -> Self {
        Polynomial(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }

    fn minus(&self, other: &Self) -> Self {
        Polynomial(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = [0.0; ORDER];
        for (j, term) in self.0.iter().enumerate().filter(|(_, term)| **term != 0.0) {
            product[j..].iter_mut().zip(&other.0).for_each(|(sum, factor)| *sum += term * factor);
        }
        Polynomial(product)
    }

    fn negative(&self) -> Self {
        Polynomial(self.0.map(|term| -term))
    }

    fn shifted_by(&self, factor: f64) -> Self {
        let shifted = |k: usize| k.checked_sub(1).map_or(0.0, |below| factor * self.0[below]);
        Polynomial(std::array::from_fn(shifted))
    }

    fn combination(powers: &[Self; EVEN_POWERS], coefficients: [f64; EVEN_POWERS]) -> Self {
        let mut sum = [0.0; ORDER];
        for (j, (power, factor)) in powers.iter().zip(coefficients).enumerate() {
            // y^j has no terms below u^{2j}.
            let terms = sum[2 * j..].iter_mut().zip(&power.0[2 * j..]);
            terms.for_each(|(sum, term)| *sum += factor * term);
        }
        Polynomial(sum)
    }
}
