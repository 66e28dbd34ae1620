//! Claims about the map beside a fixed point: one-sided stability, the exponent 4/3, λ and β.

use super::claim::{Check, Evidence, Ground, largest};
use super::fixed_points::RATIOS;
use crate::error::Error;
use crate::independent::blind_landing::printed_landing;
use crate::independent::map::{Map, printed};
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use passive_hopper::{FixedPointSpeed, MassRatio};
use return_map::{OneSidedStability, Side, Stability, one_sided_stability};

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "one-way stability",
        place: "Secs. III, IV",
        ground: Ground::Test { test: "the printed Eqs. 6–8", proof: Some("Theorem 36") },
        evidence: || one_way(&printed),
    },
    Check {
        name: "the exponent 4/3, and 10 on the left",
        place: "Sec. IV, Eq. 19",
        ground: Ground::Test {
            test: "the printed Eqs. 6–8, which contain no expansion",
            proof: Some("Theorem 36"),
        },
        evidence: || exponents(&printed, LEFT_FACTOR),
    },
    Check {
        name: "β",
        place: "Sec. IV, Eq. 14",
        ground: Ground::Test {
            test: "flight times from the sign of the printed Eq. 8",
            proof: Some("Lemma 34"),
        },
        evidence: || beta(&|n| Ok(Coefficients::new(n, MassRatio::ONE, Form::Corrected)?.beta)),
    },
    Check {
        name: "λ (erratum)",
        place: "Sec. IV, Eqs. 18, 19",
        ground: Ground::Test {
            test: "the printed Eqs. 6–8, which contain no expansion",
            proof: Some("Theorem 35"),
        },
        evidence: || lambda(&printed, &|n, m| Ok(Coefficients::new(n, m, Form::Corrected)?.lambda)),
    },
];

/// Indices n of the checked fixed points.
const INDICES: [u64; 4] = [1, 2, 3, 10];

/// The largest distance at which stability is probed, as a part of λ⁻³, the leading order of Δ. Beyond the end of the
/// trap images lie on the other side of α*_n; the exact Δ is at least 0.75 λ⁻³ wherever this part is used.
const PART_OF_TRAP: f64 = 0.3;
/// The largest distance at which stability is probed, where 0.3 λ⁻³ is larger. Nearer than this the leading power
/// decides.
const FARTHEST: f64 = 1e-3;
/// Number of distances, each half of the last. The smallest is 2·10⁻⁹ or more; the loss there is ten times the rounding
/// of the printed equations.
const DISTANCES: usize = 12;

/// The largest of the distances δ, δ/8, δ/64 from which factors and exponents are extrapolated, unless the trap ends
/// before it. v = δ^{1/3} ≤ 0.05 is small enough for the extrapolation. The loss at the smallest distance of all cases,
/// 10⁻⁷, is still 10⁵ times the rounding of the printed equations.
const FACTOR_DISTANCE: f64 = 1e-4;
/// Largest error of the exponent 4/3. The extrapolation leaves 0.18 c₂v², with c₂ the coefficient of v² in the loss. On
/// the left |c₂| is 7 at most (docs/theory.md, Theorem 36), and v² ≤ 2.2·10⁻³: the sum is 2.7·10⁻³. On the right c₂ is
/// smaller.
const EXPONENT: f64 = 4e-3;
/// Largest relative error of the factor 10. The extrapolation leaves an eighth of a term of order v³ = 10⁻⁴. The bound
/// leaves room for its coefficient, and still tells 10 from 9.9 and 10.1.
const FACTOR: f64 = 1e-3;
/// Largest relative error of the corrected λ, for the same term; the printed λ is wrong by a third.
const LAMBDA_ERROR: f64 = 1e-4;
/// Largest relative error of β. With ratio(δ) = 1 + a w + c w² + …, w = βδ^{1/3}, the extrapolation 2·ratio(δ/8) −
/// ratio(δ) leaves −c w²/2, and w² ≤ 4.4·10⁻⁴: the bound holds for |c| < 0.45. A β without its factor 6 would be wrong
/// by 45 %.
const BETA_ERROR: f64 = 1e-4;

/// The map near α*_n as a map of the distance |δ|.
fn probe(
    map: &impl Map,
    n: u64,
    mass_ratio: MassRatio,
    side: Side,
    largest: f64,
    count: usize,
) -> OneSidedStability {
    let star = FixedPointSpeed::new(n);
    let sign = match side {
        Side::Left => -1.0,
        Side::Right => 1.0,
    };
    let displacement = |distance: f64| {
        let alpha = star.value() + sign * distance;
        let exact = sign * star.offset_of(alpha);
        let image = sign * star.offset_of(map(alpha, mass_ratio).ok()??);
        // The map is evaluated at the nearest f64, at the distance `exact`. Its loss is scaled to the given distance.
        // The loss grows like the power 4/3, so that the error of this scaling is a third of the relative difference.
        Some(distance - (exact - image) * (distance / exact))
    };
    one_sided_stability(displacement, side, largest, count)
}

pub(super) fn one_way(map: &impl Map) -> Result<Evidence, Error> {
    let (mut right_attracts, mut left_repels) = (0, 0);
    for m in RATIOS {
        for n in INDICES {
            let ratio = MassRatio::new(m)?;
            let local = Coefficients::new(n, ratio, Form::Corrected)?;
            let largest = (PART_OF_TRAP * local.trap_length()).min(FARTHEST);
            let [right, left] = [Side::Right, Side::Left]
                .map(|side| probe(map, n, ratio, side, largest, DISTANCES).stability);
            right_attracts += usize::from(right == Stability::Attracting);
            left_repels += usize::from(left == Stability::Repelling);
        }
    }
    let all = RATIOS.len() * INDICES.len();
    Ok(Evidence::about("each fixed point attracts from the right and not from the left")
        .ours(format!(
            "attracting from the right in {right_attracts} of {all} cases and repelling to the left in \
             {left_repels}, at every distance probed"
        ))
        .error(format!("{} wrong of {}", 2 * all - right_attracts - left_repels, 2 * all))
        .how(format!(
            "{DISTANCES} distances from min(0.3 $λ$^{{−3}}, 10^{{−3}}) down, each half of the last; $n$ = 1, 2, 3, 10, \
             {} mass ratios",
            RATIOS.len()
        ))
        .holds(right_attracts == all && left_repels == all))
}

/// |δ − δ′|/|δ|^{4/3} at the distances δ, δ/8 and δ/64.
fn losses(map: &impl Map, n: u64, ratio: MassRatio, side: Side) -> Result<[f64; 3], Error> {
    let trap = Coefficients::new(n, ratio, Form::Corrected)?.trap_length();
    let far = (PART_OF_TRAP * trap).min(FACTOR_DISTANCE);
    Ok([1.0, 8.0, 64.0].map(|part| {
        let probe = probe(map, n, ratio, side, far / part, 1);
        probe.approach.first().map_or(f64::NAN, |&(d, step)| step.abs() / (d * pxfm::f_cbrt(d)))
    }))
}

/// (δ − δ′)/|δ|^{4/3} as δ → 0 on one side.
fn coefficient(map: &impl Map, n: u64, ratio: MassRatio, side: Side) -> Result<f64, Error> {
    // (δ − δ′)/|δ|^{4/3} = c (1 + a δ^{1/3} + b δ^{2/3} + …). At δ, δ/8 and δ/64 the factors of a are 1, ½, ¼ and those
    // of b are 1, ¼, 1/16: with the weights 1, −6, 8 both vanish, and the weights add up to 3.
    let [far, middle, near] = losses(map, n, ratio, side)?;
    Ok((far - 6.0 * middle + 8.0 * near) / 3.0)
}

/// d ln(δ − δ′)/d ln δ as δ → 0 on one side.
fn exponent(map: &impl Map, n: u64, ratio: MassRatio, side: Side) -> Result<f64, Error> {
    // Over a factor of 8 the exponent is 4/3 + log₈ of the quotient of two losses, which is 4/3 + const·δ^{1/3}. Twice
    // the nearer value minus the farther one has no such term.
    let [far, middle, near] = losses(map, n, ratio, side)?;
    let log = |quotient: f64| pxfm::f_log2(quotient) / 3.0;
    Ok(4.0 / 3.0 + 2.0 * log(middle / near) - log(far / middle))
}

pub(super) fn exponents(map: &impl Map, left_factor: f64) -> Result<Evidence, Error> {
    let (mut exponents, mut factors, mut measured) = (Vec::new(), Vec::new(), Vec::new());
    for m in RATIOS {
        for n in INDICES {
            let ratio = MassRatio::new(m)?;
            for side in [Side::Right, Side::Left] {
                exponents.push((exponent(map, n, ratio, side)? - 4.0 / 3.0).abs());
            }
            let right = coefficient(map, n, ratio, Side::Right)?;
            let left = coefficient(map, n, ratio, Side::Left)?;
            measured.push(left / right);
            factors.push((left / right / left_factor - 1.0).abs());
        }
    }
    let mean = measured.iter().sum::<f64>() / measured.len() as f64;
    let (exponent, factor) = (largest(exponents), largest(factors));
    Ok(Evidence::about("$f$ ≈ $α$ − $λ$($α$ − $α$^{∗})^{4/3}; the left side is not described")
        .ours(format!(
            "4/3 on both sides; the left loses {mean:.4} times as much in the mean of {} cases; by theory \
             {left_factor}, as its second landing is three times as fast",
            measured.len()
        ))
        .error(format!("exponent {exponent:.1e}; factor {left_factor} (1 ± {factor:.1e})"))
        .how("($δ$ − $δ$′)/|$δ$|^{4/3} at min(0.3 $λ$^{−3}, 10^{−4}), /8 and /64 on each side, extrapolated in \
              |$δ$|^{1/3}; $n$ = 1, 2, 3, 10, seven mass ratios")
        .holds(exponent < EXPONENT && factor < FACTOR))
}

/// `beta` gives β of α*_n.
pub(super) fn beta(beta: &impl Fn(u64) -> Result<f64, Error>) -> Result<Evidence, Error> {
    let mut errors = Vec::new();
    for n in INDICES {
        let star = FixedPointSpeed::new(n);
        let shift = beta(n)?;
        let ratio = |delta: f64| -> Result<f64, Error> {
            let alpha = star.value() + delta;
            let time = printed_landing(alpha, MassRatio::ONE)?.time;
            Ok((time - 2.0 * star.value()) / (shift * pxfm::f_cbrt(star.offset_of(alpha))))
        };
        // The ratio is 1 + w/(4α*) + … with w = βδ^{1/3}. An eighth of δ halves w: twice the second ratio minus the
        // first one tends to 1.
        errors.push((2.0 * ratio(1e-7)? - ratio(8e-7)? - 1.0).abs());
    }
    let worst = largest(errors);
    Ok(Evidence::about(
        "the flight near $α$^{∗} is longer by $βδ$^{1/3}, $β$ = [6(2$α$^{∗} − sin \
                        2$α$^{∗})/$α$^{∗}]^{1/3} (the 6 is illegible in our copy)",
    )
    .ours(format!(
        "$β$_{{1}} = {:.12}; the prolongation of the flight divided by $βδ$^{{1/3}} tends to 1",
        beta(1)?
    ))
    .error(format!("1 ± {worst:.1e}"))
    .how(
        "flight times at $δ$ = 8·10^{−7} and 10^{−7}, extrapolated in $δ$^{1/3}, $n$ = 1, 2, 3, 10",
    )
    .holds(worst < BETA_ERROR))
}

/// `corrected` gives the corrected λ.
pub(super) fn lambda(
    map: &impl Map,
    corrected: &impl Fn(u64, MassRatio) -> Result<f64, Error>,
) -> Result<Evidence, Error> {
    let (mut from_printed, mut from_corrected) = (Vec::new(), Vec::new());
    for n in [1, 2, 3, 7, 10] {
        for m in [0.1, 0.2, 0.5, 1.0, 10.0] {
            let ratio = MassRatio::new(m)?;
            let measured = coefficient(map, n, ratio, Side::Right)?;
            let printed = Coefficients::new(n, ratio, Form::Printed)?.lambda;
            from_printed.push((measured / printed - 0.75).abs());
            from_corrected.push((measured / corrected(n, ratio)? - 1.0).abs());
        }
    }
    let (worst_printed, worst_corrected) = (largest(from_printed), largest(from_corrected));
    let printed = Coefficients::new(1, MassRatio::ONE, Form::Printed)?.lambda;
    let ours = corrected(1, MassRatio::ONE)?;
    let measured = coefficient(map, 1, MassRatio::ONE, Side::Right)?;
    Ok(Evidence::about(format!("$λ$ = $βμ$(2$α$^{{∗}} − sin 2$α$^{{∗}}); {printed:.6} for $n$ = $M$ = 1"))
        .ours(format!("{:.4} of the printed $λ$: {ours:.9}; measured {measured:.9}", ours / printed))
        .error(format!("measured/printed = 0.75 ± {worst_printed:.1e}; measured/corrected = 1 ± {worst_corrected:.1e}"))
        .how("($δ$ − $δ$′)/$δ$^{4/3} at $δ$ = min(0.3 $λ$^{−3}, 10^{−4}), /8, /64, extrapolated; $n$ = 1, 2, 3, 7, 10, \
              $M$ = 0.1, 0.2, 0.5, 1, 10")
        .corrected(worst_corrected < LAMBDA_ERROR))
}
