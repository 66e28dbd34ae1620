//! The mass ratios at which the minimum of the map reaches a fixed point.

use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::theorems::theorem::Theorem;
use crate::traps::ProvedCrisis;

/// The widest enclosure of a crisis that counts.
const WIDTH: f64 = 1e-13;

/// M_c(n), enclosed for n from 1 to `humps`.
///
/// # Errors
/// [`Error::Open`] if a touch is not enclosed.
pub fn crises(humps: u64) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "crisis",
        "The minimum of the map on hump n touches α*_n at exactly one M_c(n) ≤ 1, and at 1/M_c(n); below M_c(n) the \
         map stays above α*_n on the \
         contact part, and between the two it falls through α*_n (docs/theory.md, Theorem 29).",
    );
    for n in 1..=humps {
        let touch = ProvedCrisis::new(n)?;
        let crisis = touch.mass_ratio();
        theorem.step(
            format!("M_c({n}) is enclosed to 1e-13"),
            format!("M_c({n}) in [{}, {}]", crisis.low(), crisis.high()),
            crisis.width() <= WIDTH && crisis.high() < 1.0,
        );
        theorem.evidence.push(CertificateLine::Crisis {
            n,
            mass_ratio: crisis,
            speed: touch.speed.middle(),
        });
    }
    Ok(theorem)
}
