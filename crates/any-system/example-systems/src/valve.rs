//! A pressure relief valve whose disc hits its seat (Hős, Champneys; parameters from the tutorial of the MPGOS
//! package).

use hybrid_system::{
    Crossing, Equations, Error, Event, Execution, Guard, HybridSystem, Limits, NextEvent, Reset,
    Search, State, Tolerances, integrated_crossing, integrated_flow,
};
use nalgebra::{SVector, Vector2, Vector3};
use return_map::Section;

/// κ, the damping coefficient.
const DAMPING: f64 = 1.25;
/// δ, the precompression of the spring: the pressure that opens the valve.
const LOAD: f64 = 10.0;
/// β, the rate at which the pressure builds up.
const FILLING: f64 = 20.0;
/// r: y₂ → −r y₂ at the seat.
const RESTITUTION: f64 = 0.8;
/// The tolerances of the tutorial, so that speeds can be compared.
const TOLERANCES: Tolerances = Tolerances::both(1e-10);

/// Flow rates of the tutorial's diagram.
pub const SMALLEST_FLOW: f64 = 0.2;
/// The largest one.
pub const LARGEST_FLOW: f64 = 10.0;

/// The valve by its equations, with the flow rate q as the parameter `flow`.
pub fn valve_equations() -> Equations {
    let numbers = [
        ("flow", "1"),
        ("damping", "1.25"),
        ("load", "10"),
        ("filling", "20"),
        ("restitution", "0.8"),
    ];
    Equations::new(&["displacement", "velocity", "pressure"], &numbers)
        .mode_text(
            "open",
            &[
                "velocity",
                "pressure - load - displacement - damping*velocity",
                "filling*(flow - displacement*sqrt(pressure))",
            ],
        )
        .falling_text("seat", "displacement")
        .resets_text(&["0", "-restitution*velocity", "pressure"])
        .contact()
        .falling_text("turning point", "velocity")
        .crossing()
        .rests_at("closed", |_, x, _| [x[0].number(0.0), x[0].number(0.0), x[2]])
        .mode_text("closed", &["0", "0", "filling*flow"])
        .rising_text("release", "pressure - load")
        .resets_text(&["0", "0", "load"])
        .to("open")
}

/// The two modes of the disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The disc is off its seat: ẏ₁ = y₂, ẏ₂ = −κ y₂ − (y₁ + δ) + y₃, ẏ₃ = β (q − y₁ √y₃). This flow is
    /// integrated.
    Open,
    /// The spring presses the disc on its seat: ẏ₃ = β q. This flow has a closed form.
    Closed,
}

/// The events that end an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// y₁ = 0: the disc hits its seat.
    Seat,
    /// y₂ = 0, falling: a turning point, where the disc is farthest from its seat.
    TurningPoint,
    /// y₃ = δ: the pressure lifts the disc off its seat.
    Release,
}

/// The valve with flow rate q. State: displacement y₁, velocity y₂, pressure y₃, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Valve {
    /// q.
    pub flow_rate: f64,
}

impl HybridSystem for Valve {
    type State = State<3>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, y: &State<3>, t: f64) -> State<3> {
        match mode {
            Mode::Open => integrated_flow(self, mode, y, t, TOLERANCES),
            Mode::Closed => Vector3::new(0.0, 0.0, y[2] + FILLING * self.flow_rate * t),
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        match mode {
            Mode::Open => {
                const {
                    &[
                        Guard::falling(Surface::Seat).contact(),
                        Guard::falling(Surface::TurningPoint).crossing(),
                    ]
                }
            }
            Mode::Closed => const { &[Guard::rising(Surface::Release)] },
        }
    }

    fn guard_value(&self, surface: Surface, y: &State<3>) -> f64 {
        match surface {
            Surface::Seat => y[0],
            Surface::TurningPoint => y[1],
            Surface::Release => y[2] - LOAD,
        }
    }

    fn reset(&self, _: Mode, surface: Surface, y: &State<3>) -> Reset<Mode, State<3>> {
        let state = match surface {
            Surface::Seat => Vector3::new(0.0, -RESTITUTION * y[1], y[2]),
            Surface::TurningPoint => *y,
            Surface::Release => Vector3::new(0.0, 0.0, LOAD),
        };
        Reset::Jump { mode: Mode::Open, state }
    }

    /// After a Zeno limit the disc rests on its seat until the pressure equals the load.
    fn rest(&self, _: Mode, limit: &State<3>) -> Option<(Mode, State<3>)> {
        (limit[2] < LOAD).then_some((Mode::Closed, Vector3::new(0.0, 0.0, limit[2])))
    }

    fn first_crossing(
        &self,
        mode: Mode,
        y: &State<3>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<3>>, Error> {
        match mode {
            Mode::Open => integrated_crossing(self, mode, y, search, TOLERANCES),
            Mode::Closed => {
                let time = (LOAD - y[2]) / (FILLING * self.flow_rate);
                let state = Vector3::new(0.0, 0.0, LOAD);
                let crossing = Crossing::exact(Surface::Release, time.max(0.0), state);
                Ok((time <= search.horizon).then_some(crossing).into())
            }
        }
    }
    fn vector_field(&self, mode: Mode, y: &State<3>) -> Option<State<3>> {
        Some(match mode {
            Mode::Open => Vector3::new(
                y[1],
                y[2] - LOAD - y[0] - DAMPING * y[1],
                FILLING * (self.flow_rate - y[0] * y[2].sqrt()),
            ),
            Mode::Closed => Vector3::new(0.0, 0.0, FILLING * self.flow_rate),
        })
    }
}

/// The section of the turning points, with displacement and pressure as coordinates, as in the tutorial.
#[derive(Debug, Clone, Copy)]
pub struct TurningPoints;

impl Section<Valve, 3, 2> for TurningPoints {
    fn point(&self, y: &SVector<f64, 2>) -> (Mode, State<3>) {
        (Mode::Open, Vector3::new(y[0], 0.0, y[1]))
    }
    fn coordinates(&self, event: &Event<Mode, Surface, State<3>>) -> Option<SVector<f64, 2>> {
        (event.surface == Surface::TurningPoint)
            .then(|| Vector2::new(event.before[0], event.before[2]))
    }
}

/// The start of every orbit of the tutorial: displacement 0.2 and no pressure.
pub const START: Vector2<f64> = Vector2::new(0.2, 0.0);

/// Limits for an orbit of this number of turning points. The time and the number of events between two turning
/// points stay far below them for all flow rates of the diagram.
fn limits(turning_points: usize) -> Limits {
    Limits::new(1000.0 * (1 + turning_points) as f64, 10_000 * (1 + turning_points))
}

/// The displacements at `kept` turning points, after `transient` turning points that are left out.
///
/// The orbit may contain Zeno limits and rests on the seat.
pub fn turning_points(flow_rate: f64, transient: usize, kept: usize) -> Result<Vec<f64>, Error> {
    let valve = Valve { flow_rate };
    let (mode, start) = TurningPoints.point(&START);
    let mut found = Vec::with_capacity(kept);
    let mut turning_point = 0;
    for arc in Execution::new(&valve, mode, start, limits(transient + kept)) {
        let arc = arc?;
        let Some(at) = arc.event().and_then(|event| TurningPoints.coordinates(event)) else {
            continue;
        };
        if turning_point >= transient {
            found.push(at[0]);
        }
        turning_point += 1;
        if found.len() == kept {
            return Ok(found);
        }
    }
    let reason = format!(
        "{turning_point} turning points were found where {} were asked for",
        transient + kept
    );
    Err(Error::Model { reason })
}
