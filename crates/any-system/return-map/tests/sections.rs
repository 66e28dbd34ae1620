//! Return maps that several tests use.

#![allow(clippy::unwrap_used)]

use example_systems::impact_oscillator::impact_oscillator;
use example_systems::spring_leg::spring_leg;
use return_map::EquationReturns;

/// The spring leg from apex to apex, with the energy of 5 m/s at 1 m.
pub(crate) fn apexes() -> EquationReturns {
    EquationReturns::new(&spring_leg(), "attack", ("flight", "apex"), &["h"])
        .unwrap()
        .starting_text(&["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"])
        .unwrap()
        .coordinates_text(&["height"])
        .unwrap()
}

/// The oscillator with a stop, once in a period of its forcing.
pub(crate) fn strobe() -> EquationReturns {
    let oscillator =
        impact_oscillator("0.3").clock_text("strobe", "2*pi/frequency", "2*pi/frequency");
    EquationReturns::new(&oscillator, "forcing", ("free", "strobe"), &["x", "v"]).unwrap()
}
