//! The hopper as a hybrid system: both masses through flights, collisions and contacts.

use crate::landing::decided_landing::decided_landing;
use crate::landing::flight_ends::{TakeOff, is_sudden};
use crate::landing::from_air::landing_time;
use crate::model::contact::{contact_flow, contact_time, lift_off_energy};
use crate::model::mass_ratio::MassRatio;
use crate::model::motion::{Flight, LARGEST_LIFT_OFF_SPEED};
use crate::model::phase::Phase;
use crate::model::state::HopperState;
use hybrid_system::{
    Certainty, Crossing, Error, Guard, HybridSystem, NextEvent, Reset, Search, State,
};
use nalgebra::Vector4;

/// The surfaces at which a phase ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HopperSurface {
    /// y₂ = 0, falling.
    Landing,
    /// y₁ = 1 in contact, rising: the contact force vanishes.
    LiftOff,
}

/// The passive hopper with state (y₁, ẏ₁, y₂, ẏ₂).
///
/// Landings and lift-offs are solved for in closed form, not searched by an integrator. After a collision the spring
/// may pull the lower mass off again at once (a sudden lift-off: the event leads back to flight). Otherwise the contact
/// phase follows.
///
/// A landing after a lift-off is [`Certainty::Certain`]: that it is the first, and whether a sudden lift-off
/// follows, are decided from the given state with bounds on all errors, in up to 1024 bits. If these do not
/// suffice, the result is an error. There are two exceptions, which are [`Certainty::Exact`]: a landing at a
/// stretch so near to 1 that the rounded state is on the other side, and a landing after a start in the air. The
/// latter is solved for in `f64` without bounds on its errors: if a flight from the air nearly touches the ground,
/// its landing may be missed or found in error.
///
/// At an event the energy never grows by more than rounding. In the tests it is below 10⁻¹³ of
/// (1+M)α² + α⁴ + 10 (`energy_is_lost_at_landings_only`), and below 10⁻¹² of the energy after a fall at a speed of 10¹²
/// (`huge_falls_gain_no_energy`).
/// For speeds from 10¹¹ on, where an ulp of the time is no small angle, it is the square of that ulp.
///
/// ```
/// use hybrid_system::{Execution, Limits};
/// use passive_hopper::{Hopper, HopperState, MassRatio, Phase, alpha_star};
///
/// let hopper = Hopper::new(MassRatio::new(0.5)?);
/// let start = HopperState::lift_off(alpha_star(1));
/// let arcs: Vec<_> = Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(100.0, 2))
///     .collect::<Result<_, _>>()?;
/// // A lossless hop lands after 2α*: a triple root, so the time is good to the cube root of an ulp.
/// assert!((arcs[0].duration - 2.0 * alpha_star(1)).abs() < 1e-4);
/// assert_eq!(arcs[1].mode, Phase::Contact);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hopper {
    mass_ratio: MassRatio,
}

impl Hopper {
    /// The hopper with this mass ratio.
    pub fn new(mass_ratio: MassRatio) -> Self {
        Hopper { mass_ratio }
    }

    /// The mass ratio M.
    pub fn mass_ratio(&self) -> MassRatio {
        self.mass_ratio
    }

    /// Time and state of the landing after a lift-off from the ground.
    fn landing_from_ground(
        &self,
        start: TakeOff,
    ) -> Result<(f64, HopperState, Certainty), crate::error::Error> {
        let landing = decided_landing(start, self.mass_ratio)?;
        let state = HopperState {
            upper_position: 1.0 + landing.excess,
            upper_velocity: landing.velocity,
            lower_position: 0.0,
            lower_velocity: -landing.closing_speed / (1.0 + self.mass_ratio.value()),
        };
        // The sum 1 + x′ may round to 1, or `reset` may see the other sign for another reason: then the next phase
        // is not the one that was decided.
        let kept = is_sudden(state.upper_position - 1.0, landing.velocity) == landing.sudden;
        let certainty = if kept { Certainty::Certain } else { Certainty::Exact };
        Ok((landing.time, state, certainty))
    }

    /// The end of the contact phase; `None` if the hopper stays on the ground.
    fn lift_off(
        &self,
        start: &HopperState,
    ) -> Result<Option<Crossing<HopperSurface, State<4>>>, crate::error::Error> {
        let (height, velocity) = (start.lower_position, start.lower_velocity);
        if height != 0.0 || velocity != 0.0 {
            return Err(crate::error::Error::NotInContact { height, velocity });
        }
        let excess = start.upper_position - 1.0;
        let Some(time) = contact_time(self.mass_ratio, excess, start.upper_velocity)? else {
            return Ok(None);
        };
        let state = if time > 0.0 {
            let energy = lift_off_energy(self.mass_ratio, excess, start.upper_velocity);
            HopperState::lift_off(energy.sqrt())
        } else {
            *start
        };
        Ok(Some(Crossing::exact(HopperSurface::LiftOff, time, state.into())))
    }

    /// The first landing. It is at time zero if the lower mass is on the ground and does not leave it.
    fn landing(&self, start: &HopperState) -> Result<Crossing<HopperSurface, State<4>>, Error> {
        if start.lower_position < 0.0 {
            return Err(refused(crate::error::Error::BelowGround { height: start.lower_position }));
        }
        let flight = Flight::new(self.mass_ratio, start);
        if let Some(value) = flight.unresolved() {
            let largest = LARGEST_LIFT_OFF_SPEED;
            return Err(refused(crate::error::Error::MotionTooLarge { value, largest }));
        }
        let excess = start.upper_position - 1.0;
        let velocity = start.upper_velocity;
        let on_ground = start.lower_position == 0.0 && start.lower_velocity == 0.0;
        let (time, state, certainty) = if on_ground && is_sudden(excess, velocity) {
            self.landing_from_ground(TakeOff { excess, velocity }).map_err(refused)?
        } else {
            let time = landing_time(&flight)?;
            // At rest on the ground the signs of the given numbers decide that the lower mass does not leave.
            let certainty = if on_ground { Certainty::Certain } else { Certainty::Exact };
            // On the ground y₁ is the stretch itself. If y₁ were computed from P, which may be huge, it would lose
            // digits.
            let upper_position = flight.stretch(time).0;
            let state = HopperState { upper_position, lower_position: 0.0, ..flight.state(time) };
            (time, state, certainty)
        };
        let crossing = Crossing::exact(HopperSurface::Landing, time, state.into());
        Ok(Crossing { certainty, ..crossing })
    }
}

/// The hopper's own error as an error of the hybrid system.
fn refused(error: crate::error::Error) -> Error {
    Error::Model { reason: error.to_string() }
}

impl HybridSystem for Hopper {
    type State = State<4>;
    type Mode = Phase;
    type Surface = HopperSurface;

    fn flow(&self, phase: Phase, start: &State<4>, time: f64) -> State<4> {
        let start = HopperState::from(*start);
        match phase {
            Phase::Flight => Flight::new(self.mass_ratio, &start).state(time).into(),
            Phase::Contact => contact_flow(self.mass_ratio, &start, time).into(),
        }
    }

    fn guards(&self, phase: Phase) -> &[Guard<HopperSurface>] {
        match phase {
            Phase::Flight => const { &[Guard::falling(HopperSurface::Landing)] },
            Phase::Contact => const { &[Guard::rising(HopperSurface::LiftOff)] },
        }
    }

    fn guard_value(&self, surface: HopperSurface, state: &State<4>) -> f64 {
        match surface {
            HopperSurface::Landing => state[2],
            HopperSurface::LiftOff => state[0] - 1.0,
        }
    }

    fn reset(&self, _: Phase, surface: HopperSurface, before: &State<4>) -> Reset<Phase, State<4>> {
        let landed = HopperState { lower_position: 0.0, lower_velocity: 0.0, ..(*before).into() };
        let (y1, v1) = (landed.upper_position, landed.upper_velocity);
        let mode = match surface {
            HopperSurface::LiftOff => Phase::Flight,
            HopperSurface::Landing if is_sudden(y1 - 1.0, v1) => Phase::Flight,
            HopperSurface::Landing => Phase::Contact,
        };
        Reset::Jump { mode, state: landed.into() }
    }

    /// The signs of the given numbers decide.
    fn leaving_side(&self, phase: Phase, surface: HopperSurface, start: &State<4>) -> Option<f64> {
        let start = HopperState::from(*start);
        let excess = start.upper_position - 1.0;
        let leaves_ground = match phase {
            // In the air, however close to the ground.
            Phase::Flight if start.lower_position > 0.0 || start.lower_velocity > 0.0 => true,
            Phase::Flight => {
                start.lower_position == 0.0
                    && start.lower_velocity == 0.0
                    && is_sudden(excess, start.upper_velocity)
            }
            Phase::Contact => is_sudden(excess, start.upper_velocity),
        };
        let _ = surface;
        Some(if leaves_ground { 1.0 } else { -1.0 })
    }

    fn first_crossing(
        &self,
        phase: Phase,
        start: &State<4>,
        search: &Search<HopperSurface>,
    ) -> Result<NextEvent<HopperSurface, State<4>>, Error> {
        let start = HopperState::from(*start);
        let crossing = match phase {
            Phase::Flight => Some(self.landing(&start)?),
            Phase::Contact => self.lift_off(&start).map_err(refused)?,
        };
        Ok(crossing.filter(|crossing| crossing.time <= search.horizon).into())
    }
}

impl From<Vector4<f64>> for HopperState {
    /// From (y₁, ẏ₁, y₂, ẏ₂).
    fn from(y: Vector4<f64>) -> Self {
        HopperState {
            upper_position: y[0],
            upper_velocity: y[1],
            lower_position: y[2],
            lower_velocity: y[3],
        }
    }
}

impl From<HopperState> for Vector4<f64> {
    fn from(state: HopperState) -> Self {
        Vector4::new(
            state.upper_position,
            state.upper_velocity,
            state.lower_position,
            state.lower_velocity,
        )
    }
}
