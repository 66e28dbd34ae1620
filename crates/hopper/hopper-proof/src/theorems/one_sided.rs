//! Fixed points that attract from the right and repel to the left.

use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::strip::Strip;
use crate::theorems::theorem::Theorem;
use crate::traps::proved_trap;

/// For every M, α*_n attracts all of an interval on its right, and every orbit that starts on its left leaves it.
///
/// On the left f(α) < α, and f has no fixed point between α*_{n−1} and α*_n (docs/theory.md, Corollary 9): an orbit
/// decreases, and its limit is below. On the right Theorem 29 gives a trap, which is shortest at M = 1 (Corollary
/// 30). The steps give it for `humps` humps.
///
/// # Errors
/// [`Error::Open`] if a trap is not enclosed.
pub fn one_sided(humps: u64) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "one-sided",
        "For every n ≥ 1 and every M > 0, α*_n attracts an interval on its right, and every orbit from a speed in \
         [α*_{n−1}, α*_n) stays below α*_n and does not converge to it (docs/theory.md, Corollary 9, Theorems 24 and \
         29, Corollary 30). The intervals below hold for all M.",
    );
    // The largest μ of all is that of M = 1, and a trap of it is one for every μ.
    let strip = Strip::at(1.0)?;
    for n in 1..=humps {
        let trap = proved_trap(n, &strip)?;
        let length = trap.right - fixed_point(n).high();
        theorem.step(
            format!("α*_{n} attracts [α*_{n}, {}]", trap.right),
            format!("α*_{n} in [{}, {}]", fixed_point(n).low(), fixed_point(n).high()),
            length > 0.0,
        );
        theorem.evidence.push(CertificateLine::trap(n, 1.0, trap.right, None));
    }
    Ok(theorem)
}
