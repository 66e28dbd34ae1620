//! The ends of traps.

use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::strip::Strip;
use crate::theorems::theorem::Theorem;
use crate::traps::{ProvedCrisis, falls_below, proved_trap};

/// The widest enclosure of Δ_n that counts.
const WIDTH: f64 = 1e-12;

/// Δ_n, enclosed for n up to `humps` at `count` mass ratios between the crisis and 1, equally spaced.
///
/// # Errors
/// [`Error::Open`] if a trap is not enclosed.
pub fn trap_edges(humps: u64, count: usize) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "traps",
        "At each M with a crossing, f maps [α*_n, α*_n + Δ_n] into itself, every orbit in it converges to α*_n, and f \
         is below α*_n just beyond. A shorter interval is a trap for all smaller μ = M/(1+M)², so for M and 1/M alike. \
         Without a crossing the trap is the contact part (docs/theory.md, Theorem 29).",
    );
    for n in 1..=humps {
        let crisis = ProvedCrisis::new(n)?.mass_ratio().high();
        let mut widest: f64 = 0.0;
        let mut missing = 0usize;
        for k in 1..=count {
            let ratio = crisis + (1.0 - crisis) * k as f64 / count as f64;
            let strip = Strip::at(ratio)?;
            let inside = proved_trap(n, &strip)?.right;
            // A speed beyond with f below α*_n, as near as it is found.
            let outside = (4..192)
                .map(|k| inside + f64::EPSILON * 2f64.powi(k / 4) * (1.0 + 0.25 * f64::from(k % 4)))
                .find(|&speed| falls_below(n, speed, &strip));
            match outside {
                Some(outside) => widest = widest.max(outside - inside),
                None => missing += 1,
            }
            theorem.evidence.push(CertificateLine::trap(n, ratio, inside, outside));
        }
        theorem.step(
            format!("Δ_{n} is enclosed to {WIDTH:e} at {count} mass ratios from M_c({n}) to 1"),
            format!(
                "widest {widest:.1e}, not enclosed {missing}; Δ_{n}(1) = {:.12}",
                proved_trap(n, &Strip::at(1.0)?)?.right - fixed_point(n).middle()
            ),
            missing == 0 && widest <= WIDTH,
        );
    }
    Ok(theorem)
}
