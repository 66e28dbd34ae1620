//! The hopper by its equations of motion alone: each phase is integrated, and its end is searched along the solution.

use crate::error::Error;
use hybrid_system::{
    Guard, HybridSystem, NextEvent, Reset, Search, State, Tolerances, integrated_crossing,
    integrated_flow,
};
use nalgebra::Vector4;
use passive_hopper::MassRatio;
use std::f64::consts::TAU;

/// Tolerance of each step.
const TOLERANCE: f64 = 1e-12;

/// Most flights of a hop. The claims use mass ratios and speeds at which a hop has a few sudden lift-offs; a hop with
/// more gives an error.
const FLIGHTS: usize = 100;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Flight,
    Contact,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Ground,
    LiftOff,
}

/// The paper's Eq. 1 and its contact phase, with state (y₁, ẏ₁, y₂, ẏ₂).
struct IntegratedHopper {
    m: f64,
}

impl HybridSystem for IntegratedHopper {
    type State = State<4>;
    type Mode = Phase;
    type Surface = Surface;

    fn flow(&self, phase: Phase, x: &State<4>, time: f64) -> State<4> {
        integrated_flow(self, phase, x, time, Tolerances::both(TOLERANCE))
    }

    fn guards(&self, phase: Phase) -> &[Guard<Surface>] {
        match phase {
            Phase::Flight => const { &[Guard::falling(Surface::Ground)] },
            Phase::Contact => const { &[Guard::rising(Surface::LiftOff)] },
        }
    }

    fn guard_value(&self, surface: Surface, x: &State<4>) -> f64 {
        match surface {
            Surface::Ground => x[2],
            Surface::LiftOff => x[0] - 1.0,
        }
    }

    fn reset(&self, _: Phase, surface: Surface, x: &State<4>) -> Reset<Phase, State<4>> {
        let state = Vector4::new(x[0], x[1], 0.0, 0.0);
        let sudden = x[0] > 1.0 || (x[0] == 1.0 && x[1] > 0.0);
        let mode =
            if surface == Surface::LiftOff || sudden { Phase::Flight } else { Phase::Contact };
        Reset::Jump { mode, state }
    }

    fn first_crossing(
        &self,
        phase: Phase,
        x: &State<4>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<4>>, hybrid_system::Error> {
        integrated_crossing(self, phase, x, search, Tolerances::both(TOLERANCE))
    }
    fn vector_field(&self, phase: Phase, x: &State<4>) -> Option<State<4>> {
        let stretch = x[0] - x[2];
        let upper = (-self.m * stretch - 1.0) / (1.0 + self.m);
        Some(match phase {
            Phase::Flight => Vector4::new(x[1], upper, x[3], (stretch - 1.0) / (1.0 + self.m)),
            Phase::Contact => Vector4::new(x[1], upper, 0.0, 0.0),
        })
    }
}

/// f(α; M) by integration; `None` if the hopper is grounded: the upper mass swings for a whole period without reaching
/// y₁ = 1.
pub(crate) fn integrated(alpha: f64, mass_ratio: MassRatio) -> Result<Option<f64>, Error> {
    let hopper = IntegratedHopper { m: mass_ratio.value() };
    let period = TAU / mass_ratio.contact_frequency();
    let (mut phase, mut state) = (Phase::Flight, Vector4::new(1.0, alpha, 0.0, 0.0));
    for _ in 0..=FLIGHTS {
        let horizon = if phase == Phase::Flight { f64::INFINITY } else { period };
        let Some(crossing) =
            hopper.first_crossing(phase, &state, &Search::up_to(horizon))?.crossing()
        else {
            return Ok(None);
        };
        if crossing.surface == Surface::LiftOff {
            return Ok(Some(crossing.state[1]));
        }
        let Reset::Jump { mode, state: after } =
            hopper.reset(phase, crossing.surface, &crossing.state)
        else {
            break;
        };
        (phase, state) = (mode, after);
    }
    Err(Error::CheckFailed(format!("a hop from {alpha} has more than {FLIGHTS} flights")))
}

/// Bound on the error of α′² by integration on a contact part, relative to α².
///
/// A hop lasts up to T = 2α + π + 2π/ν and has about T steps. Each step is wrong by the tolerance times 1 + |x| in each
/// component, where |y| ≤ 1 + α²/2 and |ẏ| ≤ 1 + 3α. An error of a velocity grows in the position like T. So at the
/// end e = ẏ₁² + (y₁−1)(2 + κ(y₁−1)) is wrong by at most the tolerance times T (1 + α²)(8 + 4 (α + T)): the first term
/// is that of ẏ₁, the second that of y₁. The bound counts every step with its largest error and the same sign. It is an
/// estimate of the number of steps and no proof; the largest error seen is a part of it that the claims show.
pub(crate) fn integrated_error(alpha: f64, mass_ratio: MassRatio) -> f64 {
    let time = 2.0 * alpha + 0.5 * TAU + TAU / mass_ratio.contact_frequency();
    TOLERANCE * time * (8.0 + 4.0 * (alpha + time)) * (1.0 + 1.0 / (alpha * alpha))
}
