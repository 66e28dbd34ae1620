//! Claims about the fixed points: their values, and that the map touches the diagonal there.

use super::claim::{Check, Evidence, Ground, largest};
use crate::error::Error;
use crate::independent::map::{Map, printed, printed_rounding};
use hopper_asymptotics::{Coefficients, Form};
use passive_hopper::{MassRatio, alpha_star};
use return_map::{Intersection, fixed_points};

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "fixed points",
        place: "Sec. II, Eq. 3",
        ground: Ground::Test {
            test: "the sign of sin $α$ − $α$ cos $α$ on either side of each value; the paper's digits",
            proof: Some("Lemma 6"),
        },
        evidence: || Ok(digits(&alpha_star)),
    },
    Check {
        name: "incessant hopping is possible",
        place: "Sec. II",
        ground: Ground::Test { test: "the printed Eqs. 6–8", proof: Some("Corollary 9") },
        evidence: || all_are_fixed(&printed, &alpha_star, 30),
    },
    Check {
        name: "the fixed points are touches",
        place: "Sec. III, Fig. 2",
        ground: Ground::Test {
            test: "a search on the printed map, which does not know the fixed points",
            proof: Some("Corollary 9"),
        },
        evidence: || touches(&printed, &alpha_star),
    },
];

/// Mass ratios of the checks: 1, and three pairs of inverses.
pub(super) const RATIOS: [f64; 7] = [0.02, 0.1, 0.5, 1.0, 2.0, 10.0, 50.0];

/// A value of α*_n.
pub(super) trait Star: Fn(u64) -> f64 + Sync {}

impl<F: Fn(u64) -> f64 + Sync> Star for F {}

/// Relative distance from α*_n at which the sign of sin α − α cos α is taken: four ulps. The function has the slope
/// α sin α there, so that its value, 4εα², is far above its rounding, some ε of 1 + α.
const BESIDE: f64 = 4.0 * f64::EPSILON;

pub(super) fn digits(star: &impl Star) -> Evidence {
    let printed = [("4.493409", 6), ("7.725251", 6), ("10.90412", 5)];
    let excess = |x: f64| pxfm::f_sin(x) - x * pxfm::f_cos(x);
    let (mut right, mut ours, mut units, mut cut) = (true, Vec::new(), Vec::new(), Vec::new());
    for (n, (digits, decimals)) in (1u64..).zip(printed) {
        let star = star(n);
        // A root of tan α = α is a change of sign of sin α − α cos α.
        let signs = [1.0 - BESIDE, 1.0 + BESIDE].map(|part| excess(star * part) > 0.0);
        right &= signs[0] != signs[1];
        let value = digits.parse::<f64>().unwrap_or(f64::NAN);
        units.push((value - star).abs() * pxfm::f_exp10(f64::from(decimals)));
        if format!("{star:.*}", decimals as usize) != digits {
            cut.push(digits);
        }
        ours.push(format!("{star:.12}"));
    }
    let worst = largest(units);
    let rounding = match cut.as_slice() {
        [] => "all are rounded".into(),
        cut => format!("not rounded but cut: {}", cut.join(", ")),
    };
    Evidence::about("tan $α$ = $α$: 4.493409, 7.725251, 10.90412, …")
        .ours(ours.join(", "))
        .error(format!("at most {worst:.2} units of the last printed digit; {rounding}"))
        .how("$α$ = ($n$+½)$π$ − arctan(1/$α$) in double-double; sin $α$ − $α$ cos $α$ changes its sign within four \
              ulps")
        // The paper rounds some values and cuts others: both are within one unit of the last digit.
        .holds(right && worst < 1.0)
}

pub(super) fn all_are_fixed(
    map: &impl Map,
    star: &impl Star,
    last: u64,
) -> Result<Evidence, Error> {
    let (mut errors, mut of_bound) = (Vec::new(), Vec::new());
    for m in RATIOS {
        for n in 1..=last {
            let star = star(n);
            let image = map(star, MassRatio::new(m)?)?.unwrap_or(f64::NAN);
            let error = (image / star - 1.0).abs();
            errors.push(error);
            // An error of α′² is twice that of α′. The loss at the double nearest to α*_n is under an ulp.
            of_bound.push(error / (0.5 * printed_rounding(star) + f64::EPSILON));
        }
    }
    let bound = largest(of_bound);
    Ok(Evidence::about(
        "at $α$ = $α$^{∗} the landing takes no energy and the hop repeats for ever, for any $M$",
    )
    .ours(format!(
        "$f$($α$^{{∗}}_{{n}}) = $α$^{{∗}}_{{n}} for $n$ ≤ {last} and {} mass ratios from {} to {}",
        RATIOS.len(),
        RATIOS[0],
        RATIOS[RATIOS.len() - 1]
    ))
    .error(format!(
        "{:.1e} relative, {:.0} % of the rounding bound",
        largest(errors),
        100.0 * bound
    ))
    .how("the printed map at the double nearest to $α$^{∗}_{n}")
    .holds(bound <= 1.0))
}

/// The mass ratio of the search.
const M: f64 = 0.2;
/// Sampled speeds of the search. Two fixed points are 700 samples apart.
const SAMPLES: usize = 4001;

pub(super) fn touches(map: &impl Map, star: &impl Star) -> Result<Evidence, Error> {
    const COUNT: u64 = 5;
    let mass_ratio = MassRatio::new(M)?;
    let window = (star(1) - 1.0, star(COUNT) + 1.0);
    let image = |alpha: f64| map(alpha, mass_ratio).ok().flatten();
    let found = fixed_points(image, window.0, window.1, SAMPLES)?;
    let mut of_bound = Vec::new();
    let mut distances = Vec::new();
    for (point, n) in found.iter().zip(1..) {
        let distance = (point.location - star(n)).abs();
        // The search cannot tell α from α*_n where the loss λ|δ|^{4/3} is below the rounding of f.
        let lambda = Coefficients::new(n, mass_ratio, Form::Corrected)?.lambda;
        let hidden = 0.5 * printed_rounding(star(n)) * star(n) / lambda;
        distances.push(distance);
        of_bound.push(distance / pxfm::f_pow(hidden, 0.75));
    }
    let touching = found.iter().filter(|point| point.intersection == Intersection::Tangent).count();
    let worst = largest(of_bound);
    Ok(Evidence::about(
        "the map has infinitely many fixed points, where tan $α$ = $α$, and stays below the diagonal",
    )
    .ours(format!(
        "{} fixed points on [$α$^{{∗}}_{{1}} − 1, $α$^{{∗}}_{{{COUNT}}} + 1] at $M$ = {M}; the map touches the \
         diagonal at {touching} of them",
        found.len()
    ))
    .error(format!(
        "largest distance from $α$^{{∗}}_{{n}}: {:.1e}, {:.0} % of the distance at which rounding hides the loss",
        largest(distances),
        100.0 * worst
    ))
    .how(format!("{SAMPLES} equally spaced points, then golden section; $λ$|$δ$|^{{4/3}} is hidden by rounding from \
                  |$δ$| ≈ 10^{{−10}} down"))
    .holds(found.len() as u64 == COUNT && touching == found.len() && worst <= 1.0))
}
