//! Claims about the humps of the map and about its crisis.

use super::claim::{Check, Evidence, Ground};
use crate::error::Error;
use crate::independent::map::{Map, printed};
use basin_of_attraction::{Branch, Interval, monotone_branches};
use hopper_basin::{crisis, first_humps};
use interval_arithmetic::golden_section_minimum;
use passive_hopper::{MassRatio, alpha_star};
use std::f64::consts::PI;

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "multimodality",
        place: "Secs. I, III, Fig. 2",
        ground: Ground::Test {
            test: "a scan of the printed map without theory about the humps",
            proof: Some("Corollary 28"),
        },
        evidence: || multimodal(&printed),
    },
    Check {
        name: "small M: the whole map is above α*₁",
        place: "Sec. V",
        ground: Ground::Test {
            test: "a scan of the printed map without theory about the humps",
            proof: Some("Theorem 29"),
        },
        evidence: || above_first(&printed),
    },
    Check {
        name: "where that ends",
        place: "Secs. V, VI",
        ground: Ground::Test {
            test: "bisection in $M$ on the lowest value of the printed map; a value of 34 digits by mpmath",
            proof: Some("Theorem 29"),
        },
        evidence: || falls_through(&printed, crisis(1)?.mass_ratio),
    },
];

/// Sampled speeds of a hump. The narrowest lap of the first five humps at the mass ratios below is 500 times as wide as
/// their spacing.
const SAMPLES: usize = 4001;

/// The monotone branches that a scan of hump n shows.
pub(super) fn scanned(map: &impl Map, mass_ratio: MassRatio, n: u64) -> Result<Vec<Branch>, Error> {
    let hump = Interval::new(alpha_star(n), alpha_star(n + 1))?;
    let image = |alpha: f64| map(alpha, mass_ratio).ok().flatten();
    Ok(monotone_branches(&image, hump, SAMPLES)?)
}

pub(super) fn multimodal(map: &impl Map) -> Result<Evidence, Error> {
    const M: f64 = 0.2;
    let mass_ratio = MassRatio::new(M)?;
    let mut found = Vec::new();
    for n in 1..=5 {
        let branches = scanned(map, mass_ratio, n)?;
        let turns = |rising: bool| {
            let turn =
                |pair: &&[Branch]| pair[0].increases() == rising && pair[1].increases() != rising;
            branches.windows(2).filter(turn).count()
        };
        found.push((turns(true), turns(false)));
    }
    let list: Vec<String> = found.iter().map(|(max, min)| format!("{max} and {min}")).collect();
    Ok(Evidence::about("the map has many humps, one between any two neighbouring fixed points")
        .ours(format!(
            "maxima and minima at $M$ = {M} between $α$^{{∗}}_{{n}} and $α$^{{∗}}_{{n+1}}, $n$ = 1…5: {}",
            list.join("; ")
        ))
        .how(format!("{SAMPLES} points between two fixed points, turning points by golden section"))
        .holds(found.iter().all(|&turns| turns == (1, 1))))
}

/// The lowest value of the map over α*_1, on [α*_1, α*_6] without the fixed point α*_1 itself: the lowest end of a
/// monotone branch that is not the left end of the first one.
fn lowest(map: &impl Map, mass_ratio: f64) -> Result<f64, Error> {
    let mass_ratio = MassRatio::new(mass_ratio)?;
    let mut least = f64::INFINITY;
    for n in 1..=5 {
        let branches = scanned(map, mass_ratio, n)?;
        let ends = branches.iter().flat_map(|b| [b.at_left, b.at_right]);
        least = ends.skip(usize::from(n == 1)).fold(least, f64::min);
    }
    Ok(least - alpha_star(1))
}

pub(super) fn above_first(map: &impl Map) -> Result<Evidence, Error> {
    let (light, heavy) = (lowest(map, 0.05)?, lowest(map, 0.1)?);
    let window = first_humps(5);
    Ok(Evidence::about("for low $M$ the entire map lies above the line $α$′ = $α$^{∗}_{1}: the whole range is \
                        attracted")
        .ours(format!("on ($α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}] the lowest turning point or end of the map lies at \
                       $α$^{{∗}}_{{1}} + {light:.4} at $M$ = 0.05 and at $α$^{{∗}}_{{1}} + {heavy:.4} at $M$ = 0.1"))
        .how(format!(
            "{} points on [{:.3}, {:.3}], turning points by golden section; from $α$^{{∗}}_{{1}} on the map rises",
            5 * SAMPLES,
            window.left,
            window.right
        ))
        .holds(light > 0.0 && heavy > 0.0))
}

/// M_c(1), computed with mpmath to 34 digits, independently of this code.
const CRISIS: f64 = 0.103_457_755_336_137_07;

/// Largest relative error of M_c(1). The lowest value of the printed map has an error of 5·10⁻¹⁴, and it falls by 6 per
/// unit of M: 8·10⁻¹⁵, or 8·10⁻¹⁴ of M_c. The bound has a digit of room.
const CRISIS_ERROR: f64 = 1e-12;

/// `crisis` is the library's M_c(1).
pub(super) fn falls_through(map: &impl Map, crisis: f64) -> Result<Evidence, Error> {
    /// Sampled speeds of hump 1 from which the search of the lowest value starts.
    const STARTS: u32 = 200;
    let (left, right) = (alpha_star(1), 2.0 * PI);
    // A grounded hopper counts as the value 0.
    let value = |alpha: f64, m: f64| -> Result<f64, Error> {
        Ok(map(alpha, MassRatio::new(m)?)?.unwrap_or(0.0))
    };
    // The lowest value on the contact part of hump 1 away from α*_1, and its place.
    let lowest = |m: f64| -> Result<(f64, f64), Error> {
        let at = |k: u32| left + (right - left) * (f64::from(k) / f64::from(STARTS));
        let mut best = (f64::INFINITY, STARTS);
        // The first tenth of the part, where the map rises from α*_1, is left out.
        for k in STARTS / 10..STARTS {
            let here = value(at(k), m)?;
            if here < best.0 {
                best = (here, k);
            }
        }
        let along = |alpha: f64| value(alpha, m).unwrap_or(f64::NAN);
        let place = golden_section_minimum(along, at(best.1 - 1), at(best.1 + 1));
        Ok((value(place, m)? - left, place))
    };
    let (mut above, mut below) = (0.1, 0.2);
    let bracketed = lowest(above)?.0 > 0.0 && lowest(below)?.0 < 0.0;
    loop {
        let middle = 0.5 * (above + below);
        if middle <= above || middle >= below {
            break;
        }
        if lowest(middle)?.0 > 0.0 { above = middle } else { below = middle }
    }
    let errors = [(crisis / below - 1.0).abs(), (crisis / CRISIS - 1.0).abs()];
    Ok(Evidence::about("as $M$ grows, larger and larger parts of the map drop below $α$^{∗}_{1}, between $M$ = 0.1 and \
                        0.2")
        .ours(format!("hump 1 touches $α$^{{∗}}_{{1}} at $M$_{{c}} = {crisis:.14}; on the printed map at {below:.14}, \
                       at $α$ = {:.6}", lowest(below)?.1))
        .error(format!("{:.1e} from the printed map, {:.1e} from the 34-digit value, both relative", errors[0], errors[1]))
        .how("$Γ$^{2} = 4$W$($A$^{2} − $α$^{∗2}), one root; printed map: golden section in $α$, bisection in $M$ \
              between 0.1 and 0.2")
        .holds(bracketed && errors.iter().all(|&error| error < CRISIS_ERROR)))
}
