//! At most one sudden lift-off.

use crate::certificate::CertificateLine;
use crate::fixed_points::fixed_point;
use crate::theorems::digits::at_least;
use crate::theorems::theorem::Theorem;
use interval_arithmetic::Enclosure;

/// M₁ from α*_1².
fn largest_mass_ratio(square: Enclosure) -> Enclosure {
    (square - Enclosure::ONE) / (square + Enclosure::ONE)
}

/// For M ≤ M₁ = (α*_1² − 1)/(α*_1² + 1) no hop has two sudden lift-offs.
///
/// The proof is that of docs/theory.md, Theorem 20. It needs two inequalities between numbers, which are the steps.
pub fn one_sudden() -> Theorem {
    let a = fixed_point(1);
    let square = a.squared();
    let largest = largest_mass_ratio(square);
    let mut theorem = Theorem::new(
        "one-sudden",
        format!(
            "For every M ≤ {} and every lift-off speed a hop has at most one sudden lift-off (docs/theory.md, Theorem \
             20).",
            at_least(largest.low(), 15)
        ),
    );
    // 1 − 2κ = (1 − M)/(1 + M) is 1/a² at M₁.
    let tilt = (Enclosure::ONE - largest) / (Enclosure::ONE + largest);
    theorem.step(
        "1 − 2κ at M₁ is 1/α*_1²",
        format!("1 − 2κ in [{}, {}]", tilt.low(), tilt.high()),
        tilt.intersection(&(Enclosure::ONE / square)).is_some(),
    );
    let root = (Enclosure::ONE + square).sqrt().unwrap_or(Enclosure::WHOLE);
    let needed = a / (2.0 * (Enclosure::ONE + Enclosure::ONE / root));
    let largest_sum = Enclosure::ONE / a;
    theorem.step(
        "V + Y/α*_1 ≤ 1/α*_1 is below α*_1/(2(1 + 1/R)), which a second sudden lift-off needs",
        format!("{} < {}", largest_sum.high(), needed.low()),
        largest_sum.high() < needed.low(),
    );
    theorem.evidence.push(CertificateLine::OneSudden {
        fixed_point: a,
        largest_mass_ratio: largest.low(),
        available: largest_sum.high(),
        needed: needed.low(),
    });
    theorem
}

#[cfg(test)]
mod tests {
    use super::*;
    use hopper_basin::ONE_SUDDEN;

    /// The constant that the libraries use is the number that is proved.
    #[test]
    fn the_constant_is_in_the_enclosure() {
        let proved = largest_mass_ratio(fixed_point(1).squared());
        assert!(
            proved.low() <= ONE_SUDDEN && ONE_SUDDEN <= proved.high(),
            "{ONE_SUDDEN} {proved:?}"
        );
        assert!(proved.high() - proved.low() < 1e-14, "{proved:?}");
    }
}
