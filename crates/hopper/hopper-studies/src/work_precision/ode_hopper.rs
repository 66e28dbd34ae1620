//! The hopper as a user of `hybrid-system` integrates it: its equations of motion, guards and resets, with
//! `integrated_flow` and `integrated_crossing`.

use super::case::{Answer, Case};
use super::hybrid_hopper::{EVENTS, answer};
use hybrid_system::{
    Error, Guard, HybridSystem, Limits, NextEvent, Reset, Search, State, Tolerances,
    integrated_crossing, integrated_flow,
};
use passive_hopper::{Hopper, HopperSurface, MassRatio, Phase};

/// Largest number of steps in a phase. Beyond it the method refuses the input: a single hop would take seconds.
const STEPS: usize = 20_000;

/// The hopper without its closed forms: the guards and resets are the model's, flows and crossings are integrated.
struct OdeHopper {
    hopper: Hopper,
    tolerances: Tolerances,
}

impl HybridSystem for OdeHopper {
    type State = State<4>;
    type Mode = Phase;
    type Surface = HopperSurface;

    fn flow(&self, phase: Phase, start: &State<4>, time: f64) -> State<4> {
        integrated_flow(self, phase, start, time, self.tolerances)
    }

    fn guards(&self, phase: Phase) -> &[Guard<HopperSurface>] {
        self.hopper.guards(phase)
    }

    fn guard_value(&self, surface: HopperSurface, state: &State<4>) -> f64 {
        self.hopper.guard_value(surface, state)
    }

    fn reset(
        &self,
        phase: Phase,
        surface: HopperSurface,
        before: &State<4>,
    ) -> Reset<Phase, State<4>> {
        self.hopper.reset(phase, surface, before)
    }

    fn first_crossing(
        &self,
        phase: Phase,
        start: &State<4>,
        search: &Search<HopperSurface>,
    ) -> Result<NextEvent<HopperSurface, State<4>>, Error> {
        let mut search = *search;
        if phase == Phase::Contact {
            // The upper mass oscillates: a lift-off is in the first period or never.
            search.horizon = search.horizon.min(contact_period(self.hopper.mass_ratio()));
        }
        let found = integrated_crossing(self, phase, start, &search, self.tolerances)?;
        Ok(match found {
            // This state is the one after a period, not the one at the horizon of the caller.
            NextEvent::None { certainty, .. } => NextEvent::None { state: None, certainty },
            found => found,
        })
    }
    fn vector_field(&self, phase: Phase, x: &State<4>) -> Option<State<4>> {
        let m = self.hopper.mass_ratio().value();
        // In contact the lower position is zero.
        let stretch = x[0] - x[2];
        let upper = (-m * stretch - 1.0) / (1.0 + m);
        let lower = match phase {
            Phase::Flight => (stretch - 1.0) / (1.0 + m),
            Phase::Contact => 0.0,
        };
        Some(State::<4>::new(x[1], upper, x[3], lower))
    }
}

/// The period of the upper mass in contact, 2π/√κ.
fn contact_period(mass_ratio: MassRatio) -> f64 {
    std::f64::consts::TAU / mass_ratio.kappa().sqrt()
}

/// The hop by integration at a tolerance; `None` if the integration fails, needs too many steps, or cannot decide a
/// crossing.
pub(super) fn integrated_hop(case: &Case, tolerance: f64) -> Option<Answer> {
    // A flight from α takes about 2α and a step is about one radian: a longer flight would use up the steps.
    if case.alpha > STEPS as f64 {
        return None;
    }
    let tolerances = Tolerances { steps: STEPS, ..Tolerances::both(tolerance) };
    let hopper = OdeHopper { hopper: Hopper::new(case.mass_ratio), tolerances };
    // Flights end by themselves, and contacts at their horizon.
    answer(&hopper, Limits::new(f64::INFINITY, EVENTS), case)
}
