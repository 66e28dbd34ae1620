//! Claims about the measures of the basins.

use super::claim::{Check, Evidence, Ground};
use crate::error::Error;
use crate::independent::followed_orbits::FollowedOrbits;
use crate::independent::map::{Map, printed};
use hopper_basin::{Fates, HopperFate, basin_fractions};
use passive_hopper::{MassRatio, alpha_star};
use rayon::prelude::*;

/// The test of all measures.
const GROUND: Ground = Ground::Test {
    test: "the paper's printed value; orbits of the printed Eqs. 6–8, followed into traps found on that map",
    proof: None,
};

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "measure at M = 0.1, all basins",
        place: "Sec. VI B",
        ground: GROUND,
        evidence: || measure(&|m| counted(m, POINTS), &printed, &Printed::ALL_AT_ONE_TENTH, 1000),
    },
    Check {
        name: "measure at M = 0.1, first basin",
        place: "Sec. VI B",
        ground: GROUND,
        evidence: || measure(&|m| counted(m, POINTS), &printed, &Printed::FIRST_AT_ONE_TENTH, 1000),
    },
    Check {
        name: "measure at M = 0.2, all basins",
        place: "Sec. VI B",
        ground: GROUND,
        evidence: || measure(&|m| counted(m, POINTS), &printed, &Printed::ALL_AT_ONE_FIFTH, 1000),
    },
    Check {
        name: "fall and recovery of the measure",
        place: "Sec. VI B",
        ground: Ground::Test { test: "points counted by their fate", proof: None },
        evidence: || fall_and_recovery(&|m| counted(m, POINTS)),
    },
];

/// Points on each interval between neighbouring fixed points.
pub(super) const POINTS: usize = 10_000;
/// The window of the paper's measures, [α*_1, α*_6].
const HUMPS: std::ops::Range<u64> = 1..6;

/// The fractions of all basins and of the first one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fractions {
    pub(super) all: f64,
    pub(super) first: f64,
}

/// The fractions by counting points: this number on each interval.
pub(super) fn counted(mass_ratio: f64, points: usize) -> Result<Fractions, Error> {
    let found = basin_fractions(MassRatio::new(mass_ratio)?, HUMPS.start, HUMPS.end, points)?;
    Ok(Fractions { all: found.incessant(), first: found.of(1.into()) })
}

/// A measure that the paper prints.
pub(super) struct Printed {
    mass_ratio: f64,
    first: bool,
    text: &'static str,
    value: f64,
    /// Largest error: half a unit of the last printed digit.
    allowed: f64,
}

impl Printed {
    /// The measure 1 means that every point is attracted. A mean of fractions that are all 1 has no rounding.
    pub(super) const ALL_AT_ONE_TENTH: Printed =
        Printed { mass_ratio: 0.1, first: false, text: "1", value: 1.0, allowed: 0.0 };
    pub(super) const FIRST_AT_ONE_TENTH: Printed =
        Printed { mass_ratio: 0.1, first: true, text: "0.953", value: 0.953, allowed: 0.0005 };
    pub(super) const ALL_AT_ONE_FIFTH: Printed = Printed {
        mass_ratio: 0.2,
        first: false,
        text: "0.037 (one digit is illegible in our copy)",
        value: 0.037,
        allowed: 0.0005,
    };
}

/// Points of the window whose fate by `Fates` is not that of their orbit under `map`, out of `each` on every interval.
fn disagreements(map: &impl Map, mass_ratio: MassRatio, each: usize) -> Result<usize, Error> {
    let fates = Fates::new(mass_ratio)?;
    let orbits = FollowedOrbits::new(map, mass_ratio, HUMPS.end)?;
    let points: Vec<f64> = HUMPS
        .flat_map(|n| {
            let (left, right) = (alpha_star(n), alpha_star(n + 1));
            (0..each).map(move |k| left + (right - left) * ((k as f64 + 0.5) / each as f64))
        })
        .collect();
    let differs = |alpha: f64| -> Result<bool, Error> {
        let index = match fates.fate(alpha)? {
            HopperFate::Incessant { n } => Some(n),
            _ => None,
        };
        Ok(orbits.end(alpha)?.map(|(_, n)| n) != index)
    };
    let found: Vec<bool> = points.into_par_iter().map(differs).collect::<Result<_, _>>()?;
    Ok(found.into_iter().filter(|&differs| differs).count())
}

/// `fractions` counts; `map` follows `each` points on each interval.
pub(super) fn measure(
    fractions: &impl Fn(f64) -> Result<Fractions, Error>,
    map: &impl Map,
    printed: &Printed,
    each: usize,
) -> Result<Evidence, Error> {
    let found = fractions(printed.mass_ratio)?;
    let value = if printed.first { found.first } else { found.all };
    let differing = disagreements(map, MassRatio::new(printed.mass_ratio)?, each)?;
    let followed = each * HUMPS.count();
    Ok(Evidence::about(printed.text)
        .ours(format!("{value:.5}"))
        .error(format!("{:+.1e}; {differing} of {followed} orbits of the printed map end elsewhere", value - printed.value))
        .how(format!("{POINTS} equally spaced points, the middles of equal parts, on each of the five intervals \
                      [$α$^{{∗}}_{{i}}, $α$^{{∗}}_{{i+1}}], fractions averaged; fates by traps. The paper does not \
                      state whether the ends are included; the double nearest to $α$^{{∗}}_{{i}} may lie on its left, \
                      which is another basin"))
        .holds((value - printed.value).abs() <= printed.allowed && differing == 0))
}

pub(super) fn fall_and_recovery(
    fractions: &(impl Fn(f64) -> Result<Fractions, Error> + Sync),
) -> Result<Evidence, Error> {
    let ratios = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
    let total: Vec<f64> =
        ratios.into_par_iter().map(|m| Ok(fractions(m)?.all)).collect::<Result<_, Error>>()?;
    let table: Vec<String> =
        ratios.iter().zip(&total).map(|(m, t)| format!("{t:.4} at {m}")).collect();
    Ok(Evidence::about(
        "the measure decreases rapidly as $M$ increases, then increases again for very large $M$",
    )
    .ours(table.join(", "))
    .how(format!("{POINTS} equally spaced points on each of five intervals; fates by traps"))
    .holds(
        total[..4].windows(2).all(|p| p[0] > p[1]) && total[3..].windows(2).all(|p| p[0] < p[1]),
    ))
}
