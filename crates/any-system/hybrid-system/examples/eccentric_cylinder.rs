//! A cylinder whose centre of mass is off its axis bounces on a floor. It keeps its energy, or its impacts end and it
//! rocks on the floor, or it comes to rest.
//!
//! The model is `example_systems::eccentric_cylinder`, with its derivation. Run with
//! `cargo run -p hybrid-system --features ode --example eccentric_cylinder`; `cargo xtask model-figures` draws it.

#![allow(clippy::print_stdout)] // a program

use example_systems::eccentric_cylinder::{EccentricCylinder, Mode};
use hybrid_system::{Error, Execution, Limits};
use nalgebra::Vector4;

fn main() -> Result<(), Error> {
    println!("released at rest, the lowest point 1.02 above the floor, for 300 units of time");
    println!(
        "{:>4} {:>4} {:>8} {:>13} {:>13}  at the end",
        "e", "mu", "impacts", "contact after", "energy"
    );
    for (restitution, rolling_resistance) in [(1.0, 0.0), (0.8, 0.0), (0.8, 0.1), (0.0, 0.1)] {
        let cylinder = EccentricCylinder {
            eccentricity: 0.3,
            radius_of_gyration: 0.6,
            restitution,
            rolling_resistance,
        };
        let start = Vector4::new(2.0, 0.0, 1.5, 0.0);
        let (mut impacts, mut contact) = (0, String::from("never"));
        let (mut mode, mut end) = (Mode::Flight, start);
        for arc in Execution::new(&cylinder, Mode::Flight, start, Limits::new(300.0, 100_000)) {
            let arc = arc?;
            impacts += usize::from(arc.mode == Mode::Flight && arc.event().is_some());
            if arc.mode == Mode::Contact && mode == Mode::Flight {
                contact = format!("{:.9}", arc.time);
            }
            (mode, end) = (arc.mode, arc.state(&cylinder, arc.duration)?);
        }
        let energy = cylinder.energy(&end);
        println!(
            "{restitution:>4} {rolling_resistance:>4} {impacts:>8} {contact:>13} {energy:>13.9}  {mode:?}, angular \
             velocity {:.1e}",
            end[3]
        );
    }
    Ok(())
}
