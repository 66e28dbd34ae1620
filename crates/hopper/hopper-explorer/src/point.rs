//! A point of the plane: its fate with the reasons, and its orbit hop by hop.

use crate::json::{Json, numbers, objects};
use crate::labels;
use crate::refusal::Refusal;
use basin_of_attraction::UndecidedReason;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate, Trap, TrapEdge};
use hopper_proof::ProvedPoints;
use passive_hopper::{
    Arithmetic, BoundedOrbit, ExtendedStep, Landing, LiftOffMap, MassRatio, index_below,
};

/// The fate of a point and up to `hops` hops of its orbit, as JSON.
///
/// # Errors
/// The refusals of the libraries for a mass ratio or a speed outside the model.
pub fn point(mass_ratio: f64, alpha: f64, hops: usize) -> Result<String, Refusal> {
    Ok(point_json(mass_ratio, alpha, hops)?.finish())
}

pub(crate) fn point_json(mass_ratio: f64, alpha: f64, hops: usize) -> Result<Json, Refusal> {
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let (fate, until) = fates.fate_within(alpha, HOP_BUDGET)?;
    let answer = Json::object()
        .number("massRatio", mass_ratio)
        .number("alpha", alpha)
        .json("fate", labels::label(fate.label()))
        .integer("hops", until as u64)
        .integer("below", index_below(alpha)?);
    let answer = match fate {
        HopperFate::Decaying => answer.json("trap", trap_json(&fates.trap(0)?)),
        HopperFate::Incessant { n } => answer.json("trap", trap_json(&fates.trap(n)?)),
        HopperFate::Grounded => answer.null("trap"),
        HopperFate::Undecided(reason) => answer.null("trap").text("reason", &reason_text(reason)),
    };
    let orbit = BoundedOrbit::follow(fates.map(), alpha, hops)?;
    // The last hop may be one that does not end.
    let tried = orbit.speeds.iter().take(hops);
    let details =
        tried.map(|&speed| hop_json(fates.map(), speed)).collect::<Result<Vec<_>, _>>()?;
    Ok(answer
        .truth("grounded", orbit.end == ExtendedStep::Grounded)
        .text("arithmetic", arithmetic_text(orbit.arithmetic))
        .json("speeds", numbers(orbit.speeds))
        .json("errors", numbers(orbit.errors))
        .json("orbit", objects(details)))
}

/// Whether the fate of a point is proved, as JSON: its label, or `null` without a proof.
///
/// # Errors
/// Those of [`ProvedPoints`].
pub fn proof(mass_ratio: f64, alpha: f64) -> Result<String, Refusal> {
    Ok(proof_json(mass_ratio, alpha)?.finish())
}

pub(crate) fn proof_json(mass_ratio: f64, alpha: f64) -> Result<Json, Refusal> {
    let label = ProvedPoints::new(mass_ratio)?.label(alpha)?;
    let answer = Json::object();
    Ok(if label.is_undecided() {
        answer.null("fate")
    } else {
        answer.json("fate", labels::label(label))
    })
}

fn arithmetic_text(arithmetic: Option<Arithmetic>) -> &'static str {
    match arithmetic {
        None => "53 bits",
        Some(Arithmetic::Bits106) => "106 bits",
        Some(Arithmetic::Bits256) => "256 bits",
        Some(Arithmetic::Bits512) => "512 bits",
        Some(Arithmetic::Bits1024) => "1024 bits",
    }
}

/// A trap, its interval with the bound on its error.
pub(crate) fn trap_json(trap: &Trap) -> Json {
    let edge = match trap.edge {
        TrapEdge::Crossing => "crossing",
        TrapEdge::ContactEnd => "contact end",
        TrapEdge::NextFixedPoint => "next fixed point",
    };
    Json::object()
        .integer("n", trap.n)
        .number("left", trap.fixed_point.value())
        .number("right", trap.right())
        .number("length", trap.delta)
        .number("error", trap.error)
        .text("edge", edge)
}

fn reason_text(reason: UndecidedReason) -> String {
    match reason {
        UndecidedReason::Budget => format!("its fate needs more than {HOP_BUDGET} hops"),
        UndecidedReason::Precision { at } => {
            format!("the hop from {at:?} needs more than 1024 bits, or too many hops in them")
        }
        UndecidedReason::Map { at } => {
            format!("the hop from {at:?} cannot be decided in 1024 bits")
        }
    }
}

/// One hop with its landings.
fn hop_json(map: &LiftOffMap, speed: f64) -> Result<Json, Refusal> {
    let ratio = map.mass_ratio();
    let (hop, landings, slopes) = (map.hop(speed)?, map.landings(speed)?, map.slopes(speed)?);
    let landing = |landing: &Landing| {
        Json::object()
            .number("time", landing.time)
            .number("closingSpeed", landing.closing_speed)
            .number("energyLoss", landing.energy_loss(ratio))
            .truth("sudden", landing.sudden)
    };
    Ok(Json::object()
        .number("speed", speed)
        .optional("next", hop.next)
        .number("energyLoss", hop.energy_loss(ratio))
        .number("flightTime", hop.flight_time)
        .integer("sudden", hop.sudden as u64)
        .optional("slope", slopes.map(|slopes| slopes.by_speed))
        .optional("massRatioSlope", slopes.map(|slopes| slopes.by_mass_ratio))
        .json("landings", objects(landings.iter().take(MOST_LANDINGS).map(landing))))
}

/// Landings of a hop that are listed. A hop of a large M has thousands.
const MOST_LANDINGS: usize = 50;
