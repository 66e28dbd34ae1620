//! Claims about Δ, the length of the interval of attraction.

use super::claim::{Check, Evidence, Ground, largest};
use crate::error::Error;
use crate::independent::integrated_hopper::{integrated, integrated_error};
use crate::independent::map::{Map, printed, printed_rounding};
use crate::independent::trap_edge::{MeasuredEdge, trap_edge};
use hopper_asymptotics::{Coefficients, Form};
use hopper_basin::{Trap, TrapEdge};
use passive_hopper::MassRatio;
use rayon::prelude::*;

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "Δ, the interval of attraction",
        place: "Sec. IV A, Eq. 20",
        ground: Ground::Test {
            test: "the edge found by bisection on the printed map",
            proof: Some("Theorem 29"),
        },
        evidence: || edges(&printed, &|n, m| Ok(Trap::new(n, m)?.delta)),
    },
    Check {
        name: "Δ = λ⁻³ as the leading order",
        place: "Sec. IV A, Eq. 20",
        ground: Ground::Test {
            test: "the edge found by bisection on the printed map",
            proof: Some("Lemma 40"),
        },
        evidence: || {
            leading_order(&printed, &|n| {
                Ok(Coefficients::new(n, MassRatio::ONE, Form::Corrected)?.lambda)
            })
        },
    },
    Check {
        name: "Δ is smallest at M = 1",
        place: "Sec. IV B",
        ground: Ground::Test {
            test: "edges found by bisection on the printed map and on an integrated hopper",
            proof: Some("Corollary 30"),
        },
        evidence: || smallest_at_one(&printed, &integrated, Places::ALL),
    },
    Check {
        name: "Δ is the same at M and 1/M",
        place: "Sec. IV B",
        ground: Ground::Test {
            test: "edges found by bisection on the printed map and on an integrated hopper",
            proof: Some("Corollary 30"),
        },
        evidence: || symmetric(&printed, &integrated, Places::ALL),
    },
    Check {
        name: "the computed trap contains $M$ in $μ$ alone",
        place: "Sec. IV B",
        ground: Ground::Theorem { proof: "Corollary 30" },
        evidence: || computed_traps(&|n, mass_ratio| Ok(Trap::new(n, mass_ratio)?)),
    },
];

/// The edge on a map, which must exist.
fn edge(map: &impl Map, n: u64, mass_ratio: MassRatio) -> Result<MeasuredEdge, Error> {
    trap_edge(map, n, mass_ratio)?.ok_or_else(|| {
        let m = mass_ratio.value();
        Error::CheckFailed(format!("the map does not fall through α*_{n} on its hump at M = {m}"))
    })
}

/// The error of an edge on the printed map.
fn printed_edge_error(edge: &MeasuredEdge) -> f64 {
    edge.error(printed_rounding(edge.alpha))
}

/// `delta` gives the Δ that the library computes.
pub(super) fn edges(
    map: &impl Map,
    delta: &(impl Fn(u64, MassRatio) -> Result<f64, Error> + Sync),
) -> Result<Evidence, Error> {
    let (mut errors, mut of_bound) = (Vec::new(), Vec::new());
    for n in [1, 2, 3, 10] {
        for m in [0.2, 0.5, 1.0, 2.0, 5.0] {
            let ratio = MassRatio::new(m)?;
            let measured = edge(map, n, ratio)?;
            let difference = (delta(n, ratio)? - measured.delta).abs();
            errors.push(difference / measured.delta);
            of_bound.push(difference / printed_edge_error(&measured));
        }
    }
    let bound = largest(of_bound);
    let length = |form| -> Result<f64, Error> {
        Ok(Coefficients::new(1, MassRatio::ONE, form)?.trap_length())
    };
    let (printed, corrected) = (length(Form::Printed)?, length(Form::Corrected)?);
    let measured = edge(map, 1, MassRatio::ONE)?.delta;
    let exact = delta(1, MassRatio::ONE)?;
    let (from_printed, from_corrected) = (printed / measured, corrected / measured);
    Ok(Evidence::about(format!("about $λ$^{{−3}}, with the printed $λ$ {printed:.6} for $n$ = $M$ = 1"))
        .ours(format!(
            "root of $A$^{{2}} − $μΓ$^{{2}} = $α$^{{∗2}}: {exact:.15}, on the printed map {measured:.12}; \
             $λ$^{{−3}} with the corrected $λ$ {corrected:.6}"
        ))
        .error(format!(
            "root against the printed map {:.1e} relative, {:.0} % of the rounding bound; $λ$^{{−3}} printed {:.0} % \
             of $Δ$, corrected {:.0} %",
            largest(errors),
            100.0 * bound,
            100.0 * from_printed,
            100.0 * from_corrected
        ))
        .how("$n$ = 1, 2, 3, 10, $M$ = 0.2, 0.5, 1, 2, 5; the root is checked in the tests against 40 digits, too")
        .corrected(bound <= 1.0 && (from_corrected - 1.0).abs() < (from_printed - 1.0).abs()))
}

/// Largest distance of Δλ³ from 1 at n = 30. The relative correction is about 0.37 (μα*)⁻², as measured at n = 10, and
/// μα* = 24: 6.4·10⁻⁴.
const LEADING_ORDER: f64 = 1e-3;

/// `lambda` gives the corrected λ at M = 1.
pub(super) fn leading_order(
    map: &impl Map,
    lambda: &impl Fn(u64) -> Result<f64, Error>,
) -> Result<Evidence, Error> {
    let indices = [1, 3, 10, 30];
    let mut scaled = Vec::new();
    for n in indices {
        let lambda = lambda(n)?;
        scaled.push(edge(map, n, MassRatio::ONE)?.delta * lambda * lambda * lambda);
    }
    let rising = scaled.windows(2).all(|pair| pair[0] < pair[1]);
    let last = scaled[scaled.len() - 1];
    let values: Vec<String> = scaled.iter().map(|value| format!("{value:.4}")).collect();
    let printed = Coefficients::new(30, MassRatio::ONE, Form::Printed)?.trap_length();
    let measured = edge(map, 30, MassRatio::ONE)?.delta;
    Ok(Evidence::about("the size of the interval of attraction is approximately $λ$^{−3}")
        .ours(format!(
            "$Δλ$^{{3}} = {} for $n$ = 1, 3, 10, 30 at $M$ = 1, with the corrected $λ$; with the printed $λ$ it is \
             {:.4} at $n$ = 30, near 64/27 = 2.3704",
            values.join(", "),
            measured / printed
        ))
        .error(format!("{:.1e} at $n$ = 30", last - 1.0))
        .how("$Δ$ by bisection on the printed map; the relative correction falls like ($μα$^{∗})^{−2}")
        .corrected(rising && (last - 1.0).abs() < LEADING_ORDER))
}

/// The last fixed points whose edges are searched.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    pub(super) printed: u64,
    pub(super) integrated: u64,
}

impl Places {
    /// An integrated hop takes a hundred times as long as a printed one.
    const ALL: Places = Places { printed: 6, integrated: 2 };
}

/// Mass ratios at which edges are searched on the integrated hopper.
const INTEGRATED_RATIOS: [f64; 5] = [0.25, 0.5, 0.9, 1.1, 3.0];

/// Mass ratios from 1/9 to 9 in equal factors, and pairs that approach 1 from both sides down to a distance of 10⁻³. Δ
/// rises by about 0.7 (M − 1)² of itself. Nearer than 10⁻³ that is less than the rounding of the printed map at n = 6.
fn comb() -> impl Iterator<Item = f64> {
    let coarse = (-40..=40).filter(|&k| k != 0).map(|k| pxfm::f_exp10(f64::from(k) * 0.95 / 40.0));
    let fine = (1..=3).flat_map(|k| {
        let step = pxfm::f_exp10(-f64::from(k));
        [1.0 + step, 1.0 / (1.0 + step)]
    });
    coarse.chain(fine)
}

/// Δ_n at some mass ratios on one map, compared with a reference Δ each.
struct Compared {
    /// The smallest Δ/reference − 1.
    least: f64,
    /// The largest |Δ/reference − 1|.
    largest: f64,
    /// The largest |Δ − reference|, relative to the bound on its error.
    of_bound: f64,
    /// The smallest (Δ − reference), relative to the bound on its error.
    least_of_bound: f64,
}

/// Compares Δ_n(M) with Δ_n at the mass ratio `reference(M)`.
fn compare(
    map: &impl Map,
    last: u64,
    ratios: &[f64],
    error: impl Fn(&MeasuredEdge, MassRatio) -> f64 + Sync,
    reference: impl Fn(f64) -> f64 + Sync,
) -> Result<Compared, Error> {
    let places: Vec<(u64, f64)> =
        (1..=last).flat_map(|n| ratios.iter().map(move |&m| (n, m))).collect();
    let found: Vec<(f64, f64)> = places
        .into_par_iter()
        .map(|(n, m)| {
            let (here, there) = (MassRatio::new(m)?, MassRatio::new(reference(m))?);
            let (own, other) = (edge(map, n, here)?, edge(map, n, there)?);
            let difference = own.delta - other.delta;
            let bound = error(&own, here) + error(&other, there);
            Ok((difference / other.delta, difference / bound))
        })
        .collect::<Result<_, Error>>()?;
    let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
    Ok(Compared {
        least: least(&mut found.iter().map(|pair| pair.0)),
        largest: largest(found.iter().map(|pair| pair.0.abs())),
        of_bound: largest(found.iter().map(|pair| pair.1.abs())),
        least_of_bound: least(&mut found.iter().map(|pair| pair.1)),
    })
}

fn integrated_edge_error(edge: &MeasuredEdge, mass_ratio: MassRatio) -> f64 {
    edge.error(integrated_error(edge.alpha, mass_ratio))
}

pub(super) fn smallest_at_one(
    printed: &impl Map,
    integrated: &impl Map,
    places: Places,
) -> Result<Evidence, Error> {
    let ratios: Vec<f64> = comb().collect();
    let error = |edge: &MeasuredEdge, _| printed_edge_error(edge);
    let printed = compare(printed, places.printed, &ratios, error, |_| 1.0)?;
    let integrated =
        compare(integrated, places.integrated, &INTEGRATED_RATIOS, integrated_edge_error, |_| 1.0)?;
    Ok(Evidence::about("the smallest interval of attraction is at $M$ = 1: from the approximate map, and by numerical \
                        evidence")
        .ours(format!(
            "$Δ$_{{n}}($M$)/$Δ$_{{n}}(1) − 1 is at least {:.1e} on the printed map ($n$ ≤ {}, {} mass ratios with \
             |$M$ − 1| ≥ 10^{{−3}}), and at least {:.1e} on the integrated hopper ($n$ ≤ {}, {} mass ratios)",
            printed.least,
            places.printed,
            ratios.len(),
            integrated.least,
            places.integrated,
            INTEGRATED_RATIOS.len()
        ))
        .error(format!(
            "the smallest differences are {:.0} and {:.0} times the bounds on their errors",
            printed.least_of_bound, integrated.least_of_bound
        ))
        .how("the first fall through $α$^{∗}_{n}, searched outwards from 10^{−7} and bisected; $M$ from 0.11 to 8.9, \
              crowding about 1")
        .holds(printed.least_of_bound > 1.0 && integrated.least_of_bound > 1.0))
}

pub(super) fn symmetric(
    printed: &impl Map,
    integrated: &impl Map,
    places: Places,
) -> Result<Evidence, Error> {
    let ratios: Vec<f64> = comb().collect();
    let error = |edge: &MeasuredEdge, _| printed_edge_error(edge);
    let printed = compare(printed, places.printed, &ratios, error, |m| 1.0 / m)?;
    let integrated =
        compare(integrated, places.integrated, &INTEGRATED_RATIOS, integrated_edge_error, |m| {
            1.0 / m
        })?;
    Ok(Evidence::about("the interval of attraction is unaffected by exchanging the masses")
        .ours(format!(
            "$Δ$_{{n}}($M$) and $Δ$_{{n}}(1/$M$) differ by at most {:.1e} of themselves on the printed map ($n$ ≤ {}, \
             {} mass ratios) and {:.1e} on the integrated hopper ($n$ ≤ {}, {} mass ratios)",
            printed.largest,
            places.printed,
            ratios.len(),
            integrated.largest,
            places.integrated,
            INTEGRATED_RATIOS.len()
        ))
        .error(format!(
            "{:.0} % of the rounding bound; {:.2} % of the bound from the integration's tolerance",
            100.0 * printed.of_bound,
            100.0 * integrated.of_bound
        ))
        .how("the edges of the row above, at $M$ and at 1/$M$; all lie on the contact interval")
        .holds(printed.of_bound <= 1.0 && integrated.of_bound <= 1.0))
}

/// Largest relative difference of the computed Δ between M and 1/M. Δ falls about like μ⁻³; the roundings of 1/M and of
/// both μ, some ulps each, change it by up to 10⁻¹⁴. The bound has a digit of room.
const SYMMETRY_ERROR: f64 = 1e-13;

/// `trap` gives the trap that the library computes.
pub(super) fn computed_traps(
    trap: &impl Fn(u64, MassRatio) -> Result<Trap, Error>,
) -> Result<Evidence, Error> {
    let mut errors = Vec::new();
    for n in 1..=Places::ALL.printed {
        for m in comb() {
            let ratio = MassRatio::new(m)?;
            let (here, there) = (trap(n, ratio)?, trap(n, ratio.inverted())?);
            if here.edge == TrapEdge::Crossing {
                errors.push((here.delta / there.delta - 1.0).abs());
            }
        }
    }
    let (count, worst) = (errors.len(), largest(errors));
    Ok(Evidence::about("the interval of attraction is unaffected by exchanging the masses")
        .ours("the root of $A$^{2} − $μΓ$^{2} = $α$^{∗2} contains $M$ only in $μ$")
        .error(format!("largest difference in {count} pairs: {worst:.1e} relative"))
        .how("the traps of the row above by their formula; this compares the roundings of 1/$M$ and of both $μ$ only")
        .holds(count > 0 && worst < SYMMETRY_ERROR))
}
