//! The lift-off map as a return map of the hopper as a hybrid system.

use super::case::{Answer, Case};
use hybrid_system::{Event, HybridSystem, Limits, Searched, State, Stop};
use nalgebra::SVector;
use passive_hopper::{Hopper, HopperState, HopperSurface, Phase};
use return_map::{Error, ReturnMap, Section};

/// Interval at which the search samples a guard.
///
/// The value gives fifty samples a radian of the spring's motion. A smaller interval takes more time in proportion.
/// With a larger one a guard that is negative for a shorter time is missed.
const INTERVAL: f64 = 0.02;

/// A search over more samples is refused, so that the largest α do not delay all others.
const MOST_SAMPLES: f64 = 1e5;

/// Largest number of events in a hop; past it the hop is refused. The reference hops have up to 7831.
pub(super) const EVENTS: usize = 10_000;

/// The section of gradual lift-offs, with the speed α as coordinate.
struct GradualLiftOff;

impl<T> Section<T, 4, 1> for GradualLiftOff
where
    T: HybridSystem<State = State<4>, Mode = Phase, Surface = HopperSurface>,
{
    fn point(&self, alpha: &SVector<f64, 1>) -> (Phase, State<4>) {
        (Phase::Flight, HopperState::lift_off(alpha[0]).into())
    }
    fn coordinates(
        &self,
        event: &Event<Phase, HopperSurface, State<4>>,
    ) -> Option<SVector<f64, 1>> {
        (event.surface == HopperSurface::LiftOff).then(|| SVector::<f64, 1>::new(event.before[1]))
    }
}

/// The hop by the landings that the model solves.
pub(super) fn exact_landings(case: &Case) -> Option<Answer> {
    let hopper = Hopper::new(case.mass_ratio);
    answer(&hopper, Limits::new(f64::INFINITY, EVENTS), case)
}

/// The hop by sampled guards along the flows.
pub(super) fn searched_landings(case: &Case) -> Option<Answer> {
    // A flight from α takes about 2α; ten times α + 10 is enough for all but the longest chains of sudden lift-offs.
    // The contact phase has the period 2π/√κ. The search has no theory that excludes a later lift-off: a hopper without
    // a lift-off until then counts as grounded.
    let contact = std::f64::consts::TAU / case.mass_ratio.kappa().sqrt();
    let horizon = 10.0 * (case.alpha + 10.0) + contact;
    if horizon > MOST_SAMPLES * INTERVAL {
        return None;
    }
    let hopper = Searched(Hopper::new(case.mass_ratio));
    answer(&hopper, Limits::sampled(horizon, EVENTS, INTERVAL), case)
}

pub(super) fn answer<T>(hopper: &T, limits: Limits, case: &Case) -> Option<Answer>
where
    T: HybridSystem<State = State<4>, Mode = Phase, Surface = HopperSurface>,
{
    let returns = ReturnMap::new(hopper, &GradualLiftOff, limits);
    match returns.next(&SVector::<f64, 1>::new(case.alpha)) {
        // The events are the landings and the gradual lift-off. Each landing except the last is followed by a sudden
        // lift-off.
        Ok(back) => Some(Answer {
            next: Some(back.coordinates[0]),
            sudden: back.events.checked_sub(2),
            ..Answer::default()
        }),
        Err(Error::NoReturn { stop: Stop::NoFurtherEvent | Stop::TimeLimit, events, .. }) => {
            Some(Answer { sudden: events.checked_sub(1), ..Answer::default() })
        }
        Err(_) => None,
    }
}
