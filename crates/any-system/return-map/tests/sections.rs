//! Return maps that several tests use.

#![allow(clippy::unwrap_used)]

use example_systems::impact_oscillator::impact_oscillator;
use return_map::EquationReturns;

/// The oscillator with a stop, once in a period of its forcing.
pub(crate) fn strobe() -> EquationReturns {
    let oscillator =
        impact_oscillator("0.3").clock_text("strobe", "2*pi/frequency", "2*pi/frequency");
    EquationReturns::new(&oscillator, "forcing", ("free", "strobe"), &["x", "v"]).unwrap()
}
