//! A forced oscillator that hits a stop, ẍ + 0.1ẋ + x = F cos 1.3t with the stop at x = 0.5 and restitution 0.8: the stable orbit with one impact in
//! each period, for all F from 0.95 to 1.05, and the forcing at which the motion without impacts grazes the stop first.
//!
//! `cargo run --release --example impact_oscillator -- impact_oscillator.jsonl` writes a certificate, too.

#![allow(clippy::print_stdout)] // a program

use example_systems::impact_oscillator::impact_oscillator;
use hybrid_system::Equations;
use std::error::Error;
use std::time::Instant;
use validated_dynamics::{
    Budget, Certificate, Enclosure, SectionMap, ValidatedSystem, divided, fixed_point, halves,
};

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let mut certificate = Certificate::new("impact_oscillator");
    let system = ValidatedSystem::new(&impact_oscillator("1"))?;
    let after = system.chart("free", &["v", "s"], &["stop", "v", "s"])?;
    let returns =
        SectionMap::new(&system, after, "stop", 1, &["v", "t - 2*pi/frequency"])?.recorded();
    let orbit = fixed_point(&returns, &[-1.48, 0.16], &[])?;
    certificate.fixed_point(&returns, &orbit)?;
    println!("F = 1: v in {}, t in {}", orbit.point[0], orbit.point[1]);
    println!("  a multiplier in {}, {:?}", orbit.multipliers[0], begin.elapsed());

    // The same for intervals of F, each of which continues the orbit of its neighbour: their unique orbits are the same at common ends.
    let system = ValidatedSystem::with_interval_parameters(&impact_oscillator("1"), &["forcing"])?;
    let after = system.chart("free", &["v", "s", "forcing"], &["stop", "v", "s", "forcing"])?;
    let returns =
        SectionMap::new(&system, after, "stop", 1, &["v", "t - 2*pi/frequency"])?.recorded();
    let forcings = [Enclosure::new(0.95, 1.05)];
    let budget = Budget { boxes: 1000, divisions: 8 };
    let found = divided(&forcings, budget, halves, |forcings| {
        let orbit = fixed_point(&returns, &[-1.48, 0.16], forcings)?;
        Ok(orbit.is_attracting().then_some(orbit))
    })?;
    for (_, orbit) in &found.decided {
        certificate.fixed_point(&returns, orbit)?;
    }
    println!(
        "0.95 ≤ F ≤ 1.05: {} intervals, {} open, {:?}",
        found.decided.len(),
        found.open.len(),
        begin.elapsed()
    );

    // Without the stop there is one periodic motion, of period 2π/1.3. Its largest x is below the stop at the first forcing, and above at the
    // second one.
    for forcing in ["0.351069793", "0.351069794"] {
        let free = Equations::new(&["x", "v"], &[("F", forcing)])
            .mode_text("free", &["v", "F*cos(1.3*t) - 0.1*v - x"])
            .falling_text("peak", "v");
        let system = ValidatedSystem::new(&free)?;
        let start = system.chart("free", &["x", "s"], &["x", "0", "s"])?;
        let returns =
            SectionMap::new(&system, start, "peak", 1, &["x", "t - 2*pi/1.3"])?.recorded();
        let orbit = fixed_point(&returns, &[0.5, 2.0], &[])?;
        certificate.fixed_point(&returns, &orbit)?;
        println!("F = {forcing}: the largest x is in {}", orbit.point[0]);
    }
    println!("{:?}", begin.elapsed());
    if let Some(file) = std::env::args().nth(1) {
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
