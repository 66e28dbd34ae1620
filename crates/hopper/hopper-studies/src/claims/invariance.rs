//! Claims about the invariance under M → 1/M.

use super::claim::{Check, Evidence, Ground, largest};
use crate::error::Error;
use crate::independent::integrated_hopper::{integrated, integrated_error};
use crate::independent::map::{Map, printed, printed_rounding, stable};
use basin_of_attraction::SplitMix64;
use passive_hopper::{MassRatio, alpha_star};
use rayon::prelude::*;
use std::f64::consts::PI;

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "$M$ → 1/$M$ invariance",
        place: "Sec. IV B, Eq. 23",
        ground: Ground::Test {
            test: "the printed Eqs. 6–8, where $M$ stands alone; integrated flows",
            proof: Some("Corollary 10"),
        },
        evidence: || {
            invariance(&printed, &integrated, Pairs { printed: 1_000_000, integrated: 4000 })
        },
    },
    Check {
        name: "no invariance with sudden lift-offs",
        place: "Sec. IV B",
        ground: Ground::Test {
            test: "the test of the invariance on the sudden windows, where it must fail",
            proof: None,
        },
        evidence: || {
            no_invariance(&printed, &integrated, Pairs { printed: 100_000, integrated: 1000 })
        },
    },
    Check {
        name: "the stable map contains $M$ in $μ$ alone",
        place: "Sec. IV B, Eq. 23",
        ground: Ground::Theorem { proof: "Corollary 10" },
        evidence: || stable_form(&stable, 100_000),
    },
];

/// Numbers of random pairs (M, α).
#[derive(Debug, Clone, Copy)]
pub(super) struct Pairs {
    pub(super) printed: u64,
    pub(super) integrated: u64,
}

/// The part of a hump from which speeds are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HumpPart {
    /// (α*_n, (n+1)π).
    Contact,
    /// ((n+1)π, α*_{n+1}).
    Window,
}

/// Where pairs are drawn, and the difference that rounding explains.
struct Range {
    /// M is between 10^−decades and 10^decades.
    decades: f64,
    /// The humps 0, 1, …, humps − 1.
    humps: u64,
    /// Distance of the speeds from the ends of their interval, as a part of its length.
    from_ends: f64,
    /// Bound on the error of α′² at M and α, relative to α².
    error: fn(MassRatio, f64) -> f64,
}

/// Printed equations: six decades of M, and some fifty thousand pairs on each hump. At the ends of an interval a
/// landing changes its kind, and rounding would decide which one is computed.
const PRINTED: Range =
    Range { decades: 3.0, humps: 19, from_ends: 1e-6, error: |_, alpha| printed_rounding(alpha) };

/// Integrated flows: a swing in contact takes 2π/ν, so that the error bound grows with 1/M and M; at 10^±2 it is still
/// below 10⁻⁶. The search of the end of a flight needs a speed with which the lower mass lands; at 10⁻² of the interval
/// from its ends it is far above the tolerance.
const INTEGRATED: Range = Range {
    decades: 2.0,
    humps: 6,
    from_ends: 1e-2,
    error: |mass_ratio, alpha| integrated_error(alpha, mass_ratio),
};

/// Stable form: α′² is zero for exact numbers; the roundings of 1/M, of both μ and of both α′² add up to 8 ulps at
/// most.
const STABLE: Range = Range { error: |_, _| 4.0 * f64::EPSILON, ..PRINTED };

/// The fraction of pairs that must differ where the map is not invariant. It need not be 1: at M near 1 the two
/// maps are nearly the same.
const MOST: f64 = 0.9;

/// A fixed sequence of random numbers. The state is made of digits of π.
const RANDOM: SplitMix64 = SplitMix64::from_state(0x243f_6a88_85a3_08d3);

/// The map at M against the map at 1/M.
struct Comparison {
    pairs: usize,
    /// The largest difference of α′², relative to 1 + α²: the terms of Eq. 7 are of order 1 for small α, too.
    largest: f64,
    /// The largest difference of α′², relative to its bound.
    of_bound: f64,
    /// Pairs that differ by more than the bound, those included that are grounded on one side only.
    differing: usize,
}

impl Comparison {
    fn invariant(&self) -> bool {
        self.pairs > 0 && self.differing == 0 && self.of_bound <= 1.0
    }

    fn fraction(&self) -> f64 {
        self.differing as f64 / self.pairs as f64
    }
}

/// M log-uniform, α uniform on one of the humps.
fn pair(k: u64, part: HumpPart, range: &Range) -> Result<(MassRatio, f64), Error> {
    let decade = range.decades * (2.0 * RANDOM.uniform(3 * k) - 1.0);
    let n = (range.humps as f64 * RANDOM.uniform(3 * k + 1)) as u64;
    let contact_end = (n + 1) as f64 * PI;
    let (left, right) = match part {
        HumpPart::Contact => (alpha_star(n), contact_end),
        HumpPart::Window => (contact_end, alpha_star(n + 1)),
    };
    let place = range.from_ends + (1.0 - 2.0 * range.from_ends) * RANDOM.uniform(3 * k + 2);
    Ok((MassRatio::new(pxfm::f_exp10(decade))?, left + (right - left) * place))
}

/// Compares the map at random M with the map at 1/M.
fn compare(map: &impl Map, part: HumpPart, range: &Range, pairs: u64) -> Result<Comparison, Error> {
    // The difference of α′² relative to 1 + α², and that relative to the bound.
    let difference = |k: u64| -> Result<(f64, f64), Error> {
        let (mass_ratio, alpha) = pair(k, part, range)?;
        let square = alpha * alpha;
        let bound = (range.error)(mass_ratio, alpha) + (range.error)(mass_ratio.inverted(), alpha);
        let difference = match (map(alpha, mass_ratio)?, map(alpha, mass_ratio.inverted())?) {
            (Some(here), Some(there)) => (here - there).abs() * (here + there) / square,
            (None, None) => 0.0,
            // α′² is at most 0 on one side.
            (Some(next), None) | (None, Some(next)) => next * next / square,
        };
        Ok((difference * square / (1.0 + square), difference / bound))
    };
    let found: Vec<(f64, f64)> =
        (0..pairs).into_par_iter().map(difference).collect::<Result<_, _>>()?;
    Ok(Comparison {
        pairs: found.len(),
        largest: largest(found.iter().map(|pair| pair.0)),
        of_bound: largest(found.iter().map(|pair| pair.1)),
        differing: found.iter().filter(|pair| !(pair.1 <= 1.0)).count(),
    })
}

/// f(α; M) = f(α; 1/M) on the contact parts.
pub(super) fn invariance(
    printed: &impl Map,
    integrated: &impl Map,
    pairs: Pairs,
) -> Result<Evidence, Error> {
    let printed = compare(printed, HumpPart::Contact, &PRINTED, pairs.printed)?;
    let integrated = compare(integrated, HumpPart::Contact, &INTEGRATED, pairs.integrated)?;
    Ok(Evidence::about("$f$($α$; $M$) = $f$($α$; 1/$M$) when no landing between is sudden")
        .ours(format!(
            "on the contact parts {} of {} random ($M$, $α$) differ by the printed equations, and {} of {} by \
             integrated flows",
            printed.differing, printed.pairs, integrated.differing, integrated.pairs
        ))
        .error(format!(
            "largest difference of $α$′^{{2}}: printed {:.1e} (1 + $α$^{{2}}), {:.0} % of the rounding bound; \
             integrated {:.1e} (1 + $α$^{{2}}), {:.1} % of the bound from the tolerance",
            printed.largest,
            100.0 * printed.of_bound,
            integrated.largest,
            100.0 * integrated.of_bound
        ))
        .how(format!(
            "$α$ uniform on the contact part of one of the first {} humps, $M$ log-uniform in [10^{{−3}}, 10^{{3}}]; \
             integrated: {} humps, $M$ in [10^{{−2}}, 10^{{2}}], steps with an error of 10^{{−12}}",
            PRINTED.humps, INTEGRATED.humps
        ))
        .holds(printed.invariant() && integrated.invariant()))
}

/// The same test on the sudden windows.
pub(super) fn no_invariance(
    printed: &impl Map,
    integrated: &impl Map,
    pairs: Pairs,
) -> Result<Evidence, Error> {
    let printed = compare(printed, HumpPart::Window, &PRINTED, pairs.printed)?;
    let integrated = compare(integrated, HumpPart::Window, &INTEGRATED, pairs.integrated)?;
    let differ = |found: &Comparison| !found.invariant() && found.fraction() > MOST;
    Ok(Evidence::about("the entire map between two fixed points is not invariant")
        .ours(format!(
            "on ($nπ$, $α$^{{∗}}_{{n}}) {:.1} % of {} random pairs differ by more than rounding (printed \
             equations), and {:.1} % of {} by more than the integration's error",
            100.0 * printed.fraction(),
            printed.pairs,
            100.0 * integrated.fraction(),
            integrated.pairs
        ))
        .error(format!(
            "largest differences of $α$′^{{2}}: {:.2} (1 + $α$^{{2}}) and {:.2} (1 + $α$^{{2}})",
            printed.largest, integrated.largest
        ))
        .how("the test of the row above on the sudden windows. Here it fails, which shows that it can fail")
        .holds(differ(&printed) && differ(&integrated)))
}

/// The stable map at M and at 1/M: equal by its formula.
pub(super) fn stable_form(map: &impl Map, pairs: u64) -> Result<Evidence, Error> {
    let found = compare(map, HumpPart::Contact, &STABLE, pairs)?;
    Ok(Evidence::about("$f$($α$; $M$) = $f$($α$; 1/$M$) when no landing between is sudden")
        .ours(
            "on the contact parts $α$′^{2} = $α$^{2} − $μΓ$^{2}: the formula contains $M$ only in $μ$, and \
             $μ$($M$) = $μ$(1/$M$)",
        )
        .error(format!(
            "largest difference of $α$′^{{2}} in {} pairs: {:.1e} (1 + $α$^{{2}}), {:.0} % of the rounding of 1/$M$, \
             of both $μ$ and of both $α$′^{{2}}",
            found.pairs,
            found.largest,
            100.0 * found.of_bound
        ))
        .how("the map in its stable form, on the pairs of the first row; this compares roundings only")
        .holds(found.invariant()))
}
