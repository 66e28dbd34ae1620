//! The circle of fates of α*_n, and the basins at one mass ratio as intervals.

use crate::json::{Json, numbers, objects};
use crate::labels;
use crate::refusal::Refusal;
use basin_of_attraction::{Label, Refinement};
use hopper_basin::{
    BranchGround, CircleLimits, Fates, Ground, HopperBasins, PhaseBasins, hopper_basins,
};
use passive_hopper::MassRatio;

/// Parts of a circle or of a line that a panel shows.
const MOST_PARTS: usize = 4000;

/// Samples of a sudden window, in which branches of the map are searched: as `hopper intervals` takes.
const SAMPLES: usize = 200;

/// The circle of fates left of α*_n, as JSON.
///
/// # Errors
/// The refusals of [`PhaseBasins::new`].
pub fn circle(mass_ratio: f64, n: u64) -> Result<String, Refusal> {
    Ok(circle_json(mass_ratio, n)?.finish())
}

pub(crate) fn circle_json(mass_ratio: f64, n: u64) -> Result<Json, Refusal> {
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let refinement = Refinement {
        undecided: 1e-5,
        shortest: 1e-8,
        intervals: MOST_PARTS,
        ..Refinement::default()
    };
    // A circle of some hundred pixels does not show more; its shares are right to 10⁻⁵ as well.
    let limits = CircleLimits { refinement, fate_samples: 2000, ..CircleLimits::default() };
    let circle = PhaseBasins::new(&fates, n, limits)?;
    let parts = circle.parts().iter();
    let flat = parts.flat_map(|part| [part.from, part.to, f64::from(part.label.code())]);
    let all = circle.fractions();
    let fraction = |label: Label| {
        let bounds = all.of(label);
        labels::label(label).number("lower", bounds.lower).number("upper", bounds.upper)
    };
    let ground = match circle.ground() {
        Ground::Branches { .. } => "branches",
        Ground::Spacing { .. } => "samples",
    };
    Ok(Json::object()
        .integer("n", n)
        .text("ground", ground)
        .json("parts", numbers(flat))
        .integer("boundary", circle.boundary().len() as u64)
        .integer("undecided", circle.undecided().len() as u64)
        .json("fractions", objects(all.labels().map(fraction))))
}

/// The basins between α*_first and α*_last at one mass ratio, as JSON.
///
/// # Errors
/// The refusals of [`hopper_basins`].
pub fn intervals(mass_ratio: f64, first: u64, last: u64) -> Result<String, Refusal> {
    Ok(intervals_json(mass_ratio, first, last)?.finish())
}

pub(crate) fn intervals_json(mass_ratio: f64, first: u64, last: u64) -> Result<Json, Refusal> {
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let refinement = Refinement {
        undecided: 1e-3,
        shortest: 1e-9,
        intervals: MOST_PARTS,
        ..Refinement::default()
    };
    let HopperBasins { basins, ground, probes } =
        hopper_basins(&fates, first, last, SAMPLES, refinement)?;
    let window = basins.window();
    let parts = basins.intervals().iter();
    let flat = parts
        .flat_map(|part| [part.interval.left, part.interval.right, f64::from(part.label.code())]);
    let share = |label: Label| {
        let length = basins.basin_length(label);
        let whole = window.length();
        labels::label(label)
            .number("lower", length.lower / whole)
            .number("upper", length.upper / whole)
    };
    let proved = ground == BranchGround::Proved;
    Ok(Json::object()
        .number("from", window.left)
        .number("to", window.right)
        .text("ground", if proved { "proved" } else { "contact parts" })
        .integer("compared", probes.compared as u64)
        .integer("wrong", probes.wrong as u64)
        .number("undecided", basins.undecided())
        .json("parts", numbers(flat))
        .json("fractions", objects(basins.labels().into_iter().map(share))))
}
