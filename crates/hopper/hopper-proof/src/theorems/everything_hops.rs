//! Below the first crisis every speed from α*_1 up hops for ever.

use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::hop_enclosure::HopEnclosure;
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use crate::theorems::digits::{at_least, at_most};
use crate::theorems::theorem::Theorem;
use crate::traps::ProvedCrisis;
use hopper_basin::{ONE_SUDDEN, rising_window};
use interval_arithmetic::{Enclosure, PI};

/// Equal parts of a contact part on which F is enclosed. More parts would give narrower enclosures than the proof
/// needs.
const PARTS: usize = 256;

/// The last hump whose contact part is enclosed. Beyond it the bound on the loss of a hop suffices.
const LAST: u64 = 8;

/// For every M ≤ M_c(1) and every α ≥ α*_1 the hopper hops for ever.
///
/// # Errors
/// [`Error::Open`] if the crisis is not enclosed.
pub fn everything_hops() -> Result<Theorem, Error> {
    let touch = ProvedCrisis::new(1)?;
    let crisis = touch.mass_ratio();
    let mut theorem = Theorem::new(
        "everything-hops",
        format!(
            "For every M ≤ M_c(1), a number in [{}, {}], and every α ≥ α*_1: f(α) ≥ α*_1. So every such orbit \
             converges to a fixed point α*_n, n ≥ 1: the hopper hops for ever (docs/theory.md, Theorems 24 and 29). On \
             the contact part of hump 1 this is Theorem 29. On a contact part f falls with μ (Theorem 4), so that \
             μ_c(1) is the worst. A window rises (Theorems 48 and 81) from the end of the contact part below it. From \
             9π on the bound on the loss of a hop suffices (Lemma 32): R/α and B/α fall with α.",
            crisis.low(),
            crisis.high()
        ),
    );
    let star = fixed_point(1).squared();
    let strip = Strip::at(crisis.high())?;
    theorem.evidence.push(CertificateLine::Crisis {
        n: 1,
        mass_ratio: crisis,
        speed: touch.speed.middle(),
    });
    for n in 2..=LAST {
        let (begin, end) = (fixed_point(n).low(), (PI * (n + 1) as f64).high());
        let mut least = f64::INFINITY;
        for k in 0..PARTS {
            let at = |k: usize| begin + (end - begin) * k as f64 / PARTS as f64;
            // The ends lie some ulps beyond the contact part, where F is the same formula.
            let part = Enclosure::new(at(k), at(k + 1));
            let found = HopEnclosure::plain(part, SpeedPart::Contact(n), &strip);
            let bound = found.map_or(f64::NEG_INFINITY, |hop| hop.reached.square.low());
            least = least.min(bound);
            theorem.evidence.push(CertificateLine::ContactPart {
                n,
                mass_ratio: crisis.high(),
                speeds: part,
                least_square: bound,
            });
        }
        theorem.step(
            format!("F ≥ α*_1² on the contact part of hump {n} at μ_c(1)"),
            format!("F ≥ {}, α*_1² ≤ {}", at_least(least, 4), at_most(star.high(), 4)),
            least >= star.high(),
        );
        let proved = rising_window(n).map_or(0.0, |window| window.largest_mass_ratio);
        theorem.step(
            format!("f rises in window {n} for M ≤ M_c(1) (Theorem 48)"),
            format!("proved for M ≤ {proved}"),
            crisis.high() <= proved,
        );
    }
    // Lemma 32 at 9π, with the margin of its two sides over α².
    let alpha = PI * (LAST + 1) as f64;
    let root = |square: Enclosure| square.sqrt().unwrap_or(Enclosure::WHOLE);
    let (mut y, mut v) = (Enclosure::ONE, alpha);
    let mut losses = Enclosure::ZERO;
    for _ in 0..2 {
        let r = root(y.squared() + v.squared());
        let b = root(v.squared() + 2.0 * (y + r));
        losses = losses + (r + b).squared();
        (y, v) = (r, Enclosure::new(r.low().max(b.low()), r.high().max(b.high())));
    }
    let left = strip.mu * losses + star;
    theorem.step(
        "μ_c [(R₁+B₁)² + (R₂+B₂)²] + α*_1² ≤ α² at α = 9π",
        format!("{} ≤ {}", at_most(left.high(), 2), at_least(alpha.squared().low(), 2)),
        left.high() <= alpha.squared().low(),
    );
    theorem.evidence.push(CertificateLine::Losses {
        multiple_of_pi: LAST + 1,
        mass_ratio: crisis.high(),
        losses: left.high(),
        square: alpha.squared().low(),
    });
    theorem.step(
        "M_c(1) ≤ M₁: at most two flights a hop",
        format!("{} ≤ {ONE_SUDDEN}", crisis.high()),
        crisis.high() <= ONE_SUDDEN,
    );
    Ok(theorem)
}
