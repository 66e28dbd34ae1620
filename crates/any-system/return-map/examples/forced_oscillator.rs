//! The fates of orbits of Sommerer and Ott's forced oscillator: they fall on the attractor in the plane y = 0, or
//! escape. Neighbouring starts have different fates.
//!
//! The model is `example_systems::forced_oscillator`. Run with
//! `cargo run --release -p return-map --example forced_oscillator`; `cargo xtask model-figures` draws it.

#![allow(clippy::print_stdout)] // a program

use example_systems::forced_oscillator::ForcedOscillator;
use hybrid_system::{Error, Execution, Limits, Stop};
use nalgebra::Vector5;

/// So close to the plane an orbit stays near it for longer than any run.
const REACHED: f64 = 1e-9;

fn main() -> Result<(), Error> {
    let oscillator = ForcedOscillator::PUBLISHED;
    println!("from (0.3, y) at rest:");
    for k in 0..20 {
        let y = 0.6 + 0.01 * f64::from(k);
        let start = Vector5::new(0.3, 0.0, y, 0.0, 0.0);
        let mut execution = Execution::new(&oscillator, (), start, Limits::new(1e5, 10_000));
        let mut fate = "neither";
        let mut periods = 0;
        for arc in execution.by_ref() {
            let arc = arc?;
            periods = arc.jump;
            if arc.start[2].abs() + arc.start[3].abs() < REACHED {
                fate = "the attractor";
                break;
            }
        }
        if execution.stop() == Some(Stop::Terminal) {
            fate = "infinity";
        }
        println!("y = {y:.2}: {fate} after {periods} periods");
    }
    Ok(())
}
