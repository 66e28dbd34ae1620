//! One hop, landing by landing.

use crate::pickling::{Reduced, plain, reduced};
use passive_hopper::{BoundedHop, BoundedLanding};
use pyo3::prelude::*;

/// One landing of a hop.
#[pyclass(frozen, get_all, eq, from_py_object, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Landing {
    /// Time of flight before the landing, in units of 1/ω.
    time: f64,
    /// Γ, the speed at which the lower mass meets the ground times 1 + M, in units of m₂gω/k. The landing takes μ
    /// Γ² from α².
    closing_speed: f64,
    /// The stretch of the spring minus one just after the landing, in units of m₂g/k.
    excess: f64,
    /// The velocity of the upper mass, in units of m₂gω/k.
    velocity: f64,
    /// Whether the stretched spring pulls the lower mass off the ground at once.
    sudden: bool,
}

/// One hop: from a gradual lift-off to the next one.
#[pyclass(frozen, get_all, eq, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Hop {
    /// α, the lift-off speed, in units of m₂gω/k.
    speed: f64,
    /// α′, the next lift-off speed; None if the hopper is grounded.
    next: Option<f64>,
    /// Bound on the error of α′; None if the hopper is grounded.
    next_error: Option<f64>,
    /// α − α′, to full accuracy even where it is tiny; None if the hopper is grounded.
    loss: Option<f64>,
    /// α′²; negative if the hopper is grounded.
    next_speed_squared: f64,
    /// The number of sudden lift-offs.
    sudden: usize,
    /// The time of all flights of the hop, in units of 1/ω.
    flight_time: f64,
    /// The landings: one more than the sudden lift-offs, or as many if a last flight is too short for a float.
    landings: Vec<Landing>,
}

impl From<BoundedHop> for Hop {
    fn from(bounded: BoundedHop) -> Self {
        let BoundedHop { hop, next_error, landings, .. } = bounded;
        let landing = |of: &BoundedLanding| {
            let passive_hopper::Landing { time, closing_speed, excess, velocity, sudden } =
                of.landing;
            Landing { time, closing_speed, excess, velocity, sudden }
        };
        Hop {
            speed: hop.speed,
            next: hop.next,
            next_error,
            loss: hop.loss,
            next_speed_squared: hop.next_speed_squared,
            sudden: hop.sudden,
            flight_time: hop.flight_time,
            landings: landings.iter().map(landing).collect(),
        }
    }
}

plain!(Landing { time, closing_speed, excess, velocity, sudden });

#[pymethods]
impl Landing {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        let Landing { time, closing_speed, excess, velocity, sudden } = self;
        let sudden = if *sudden { "True" } else { "False" };
        format!(
            "Landing(time={time:?}, closing_speed={closing_speed:?}, excess={excess:?}, velocity={velocity:?}, \
             sudden={sudden})"
        )
    }
}

plain!(Hop { speed, next, next_error, loss, next_speed_squared, sudden, flight_time, landings });

#[pymethods]
impl Hop {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        let next = self.next.map_or("None".into(), |next| format!("{next:?}"));
        format!("Hop(speed={:?}, next={next}, sudden={})", self.speed, self.sudden)
    }
}
