//! The lift-off map as a return map of the hopper as a hybrid system.

use super::case::{Answer, Case};
use hybrid_system::{Event, Guard, HybridSystem, Limits, Reset, State, Stop};
use nalgebra::SVector;
use passive_hopper::{Hopper, HopperState, HopperSurface, Phase};
use return_map::{Error, ReturnMap, Section};

/// Interval of the search for guards.
pub(crate) const INTERVAL: f64 = 0.02;

/// A search over more samples than this is refused.
const MOST_SAMPLES: f64 = 1e5;

/// Events that one hop may take.
const EVENTS: usize = 10_000;

/// Gradual lift-offs by their speed α.
struct GradualLiftOff;

impl<T> Section<T, 4, 1> for GradualLiftOff
where
    T: HybridSystem<4, Mode = Phase, Surface = HopperSurface>,
{
    fn point(&self, alpha: &SVector<f64, 1>) -> (Phase, State<4>) {
        (Phase::Flight, HopperState::lift_off(alpha[0]).into())
    }
    fn coordinates(&self, event: &Event<Phase, HopperSurface, 4>) -> Option<SVector<f64, 1>> {
        (event.surface == HopperSurface::LiftOff).then(|| SVector::<f64, 1>::new(event.before[1]))
    }
}

/// The hopper without its own landings and lift-offs: only flows, guards and resets.
struct Searched(Hopper);

impl HybridSystem<4> for Searched {
    type Mode = Phase;
    type Surface = HopperSurface;
    fn flow(&self, phase: Phase, start: &State<4>, time: f64) -> State<4> {
        self.0.flow(phase, start, time)
    }
    fn guards(&self, phase: Phase) -> &[Guard<HopperSurface>] {
        self.0.guards(phase)
    }
    fn guard_value(&self, surface: HopperSurface, state: &State<4>) -> f64 {
        self.0.guard_value(surface, state)
    }
    fn reset(&self, phase: Phase, surface: HopperSurface, before: &State<4>) -> Reset<Phase, 4> {
        self.0.reset(phase, surface, before)
    }
}

/// By the model's own landings.
pub(super) fn exact_landings(case: &Case) -> Option<Answer> {
    let hopper = Hopper::new(case.mass_ratio);
    answer(&hopper, Limits::new(f64::INFINITY, EVENTS), case)
}

/// By sampling guards along the flows.
pub(super) fn searched_landings(case: &Case) -> Option<Answer> {
    // Long enough for the flights of all but the longest chains, and for a turn of the contact phase:
    // no lift-off by then counts as grounded, as it must for a search that knows nothing.
    let contact = std::f64::consts::TAU / case.mass_ratio.kappa().sqrt();
    let horizon = 10.0 * (case.alpha + 10.0) + contact;
    if horizon > MOST_SAMPLES * INTERVAL {
        return None;
    }
    let hopper = Searched(Hopper::new(case.mass_ratio));
    answer(&hopper, Limits::sampled(horizon, EVENTS, INTERVAL), case)
}

fn answer<T>(hopper: &T, limits: Limits, case: &Case) -> Option<Answer>
where
    T: HybridSystem<4, Mode = Phase, Surface = HopperSurface>,
{
    let returns = ReturnMap::new(hopper, &GradualLiftOff, limits);
    match returns.next(&SVector::<f64, 1>::new(case.alpha)) {
        // Landings and the lift-off; all landings but the last are sudden lift-offs.
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
