//! Taylor polynomials with a remainder that holds.

use interval_arithmetic::Enclosure;

/// A function of time on a step, Σ c_k s^k + r s^{p+1} for k ≤ p: exactly, with some r of its enclosure at each time s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Expansion<'e> {
    /// The coefficients, from k = 0 to p.
    pub(crate) coefficients: &'e [Enclosure],
    /// Encloses the coefficient p + 1 of Taylor's theorem, at all times of the step.
    pub(crate) rest: Enclosure,
}

impl Expansion<'_> {
    /// The values at the times of an interval.
    pub(crate) fn at(&self, time: Enclosure) -> Enclosure {
        self.coefficients.iter().rev().fold(self.rest, |sum, c| sum * time + *c)
    }

    /// The rates at the times of an interval: those of Taylor's theorem for the derivative, whose coefficient p is (p + 1) r.
    pub(crate) fn rate(&self, time: Enclosure) -> Enclosure {
        let order = self.coefficients.len() as f64;
        let terms = self.coefficients.iter().enumerate().skip(1).rev();
        terms.fold(self.rest * order, |sum, (k, c)| sum * time + *c * k as f64)
    }

    /// The values divided by the time, of a function that is 0 at the time 0.
    pub(crate) fn over_time(&self, time: Enclosure) -> Enclosure {
        self.coefficients.iter().skip(1).rev().fold(self.rest, |sum, c| sum * time + *c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_expansion_holds_the_exponential_and_its_rate() {
        let factorials = [1.0, 1.0, 2.0, 6.0, 24.0];
        let coefficients = factorials.map(|k| Enclosure::ONE / Enclosure::from(k));
        // The fifth derivative over 5!, on [0, 1].
        let rest = Enclosure::new(1.0, std::f64::consts::E.next_up()) / Enclosure::from(120.0);
        let expansion = Expansion { coefficients: &coefficients, rest };
        for time in [0.0, 0.3, 1.0] {
            let exact = interval_arithmetic::exp(time);
            let time = Enclosure::from(time);
            for found in [expansion.at(time), expansion.rate(time)] {
                assert!(found.contains(exact) && found.width() < 0.08, "{found:?}");
            }
            let known = expansion.over_time(time) * time + 1.0;
            assert!(known.contains(exact));
        }
    }
}
