//! The map rises in its windows.

use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::hop_enclosure::HopEnclosure;
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use crate::theorems::theorem::Theorem;
use interval_arithmetic::{Enclosure, PI};

/// So far below α*_n Theorem 81 of docs/theory.md proves for M ≤ 1 what is to be proved here.
const BY_THEOREM: f64 = 0.0586;

/// Most boxes of a window. A proof takes far fewer; without the limit the boxes of a false claim would be divided
/// for ever.
const MOST_BOXES: usize = 2_000_000;

/// The map rises on window n for all M up to `heaviest` ≤ 1, as (n, `heaviest`) are listed.
///
/// # Errors
/// [`Error::MassRatios`] for a mass ratio that is not between 0 and 1: Theorem 81 has this range for M ≤ 1 alone.
pub fn rising(windows: &[(u64, f64)]) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "rising",
        "f rises on window n, from nπ to α*_n, for all M up to the mass ratio below: F has a positive derivative \
         (docs/theory.md, Theorem 81 next to α*_n, and by enclosures of the derivative elsewhere).",
    );
    for &(n, heaviest) in windows {
        if !(heaviest <= 1.0) {
            return Err(Error::MassRatios { low: 0.0, high: heaviest });
        }
        let all = Strip::up_to(heaviest)?;
        let range = Enclosure::new((PI * n as f64).low(), fixed_point(n).low() - 0.9 * BY_THEOREM);
        theorem.evidence.push(CertificateLine::RisingWindow {
            n,
            speeds: range,
            largest_mass_ratio: heaviest,
        });
        let mut boxes = 0;
        // There is no window 0.
        let proved = n >= 1 && rises(range, n, &all, &mut boxes, &mut theorem.evidence);
        theorem.step(
            format!("f rises on window {n} for M ≤ {heaviest}"),
            format!("{boxes} boxes of α and M"),
            proved,
        );
    }
    Ok(theorem)
}

/// ∂F/∂α > 0 on a box, which is halved until an enclosure shows it.
fn rises(
    alpha: Enclosure,
    n: u64,
    strip: &Strip,
    boxes: &mut usize,
    evidence: &mut Vec<CertificateLine>,
) -> bool {
    let mut open = vec![(alpha, *strip)];
    while let Some((alpha, strip)) = open.pop() {
        *boxes += 1;
        if *boxes > MOST_BOXES {
            return false;
        }
        let shown = HopEnclosure::plain(alpha, SpeedPart::Window(n), &strip)
            .is_some_and(|hop| hop.by_speed.is_positive());
        if shown {
            evidence.push(CertificateLine::RisingBox { n, speeds: alpha, kappas: strip.kappa });
            continue;
        }
        // The longer side in the scale on which the slope changes.
        if alpha.width() > strip.kappa_width() {
            let middle = alpha.middle();
            open.push((Enclosure::new(alpha.low(), middle), strip));
            open.push((Enclosure::new(middle, alpha.high()), strip));
        } else {
            open.extend(strip.halves().map(|half| (alpha, half)));
        }
    }
    true
}
