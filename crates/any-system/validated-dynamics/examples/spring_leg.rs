//! A runner on a spring leg (80 kg, 1 m, 20 kN/m, an angle of attack of 68°) with the energy of 5 m/s at 1 m: its gait, the apex heights from which it is
//! attracted, and one from which the runner falls.
//!
//! `cargo run --release --example spring_leg -- spring_leg.jsonl` writes a certificate, too.

#![allow(clippy::print_stdout)] // a program

use example_systems::spring_leg::spring_leg_that_falls;
use std::error::Error;
use std::time::Instant;
use validated_dynamics::{
    Certificate, EnclosedMap, Enclosure, SectionMap, Target, Trap, ValidatedSystem, fixed_point,
};

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let system = ValidatedSystem::new(&spring_leg_that_falls())?;
    let apex = ["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"];
    let apexes = system.chart("flight", &["h"], &apex)?;
    let map = SectionMap::new(&system, apexes.clone(), "apex", 1, &["height"])?.recorded();
    let gait = fixed_point(&map, &[0.94], &[])?;
    println!("the gait has its apex in {} m", gait.point[0]);
    println!("  multiplier in {}, {:?}", gait.multipliers[0], begin.elapsed());
    let trap = Trap::new(&map, &gait, 3000)?;
    let radius = trap.size() * trap.directions()[(0, 0)].abs();
    println!("  attracts |h − {}| < {radius}, {:?}", trap.centre()[0], begin.elapsed());

    // From 2 m the runner falls in the third flight.
    let high = [Enclosure::from(2.0)];
    let fall = SectionMap::new(&system, apexes, "ground", 1, &["x"])?.recorded();
    let events = fall.image(&high)?.events;
    for event in &events {
        print!("{}, ", event.surface);
    }
    if let Some(event) = events.last() {
        println!("at {} s, {:?}", event.time, begin.elapsed());
    }

    if let Some(file) = std::env::args().nth(1) {
        let mut certificate = Certificate::new("spring_leg");
        certificate.fixed_point(&map, &gait)?;
        certificate.trap(&map, &trap)?;
        certificate.leads(&fall, &high, &[high.to_vec()], Target::Surface)?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
