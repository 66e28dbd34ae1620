//! Rössler's equations with a = b = 0.2, c = 5.7: the periodic orbit that crosses x = 0 once.
//!
//! `cargo run --release --example rossler -- rossler.jsonl` writes a certificate, too.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use std::error::Error;
use validated_dynamics::{Certificate, SectionMap, ValidatedSystem, fixed_point};

fn main() -> Result<(), Box<dyn Error>> {
    let rossler = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("section", "x");
    let system = ValidatedSystem::new(&rossler)?;
    // The states of the section, by two variables, and what is read of the state when the orbit comes back.
    let section = system.chart("flow", &["y", "z"], &["0", "y", "z"])?;
    let returns = SectionMap::new(&system, section, "section", 1, &["y", "z"])?;
    let orbit = fixed_point(&returns, &[-8.4, 0.03], &[])?;
    println!("There is one orbit with y in {}, z in {}.", orbit.point[0], orbit.point[1]);
    println!("Its period is in {}.", orbit.image.events[0].time);
    for multiplier in &orbit.multipliers {
        println!("A multiplier is in {multiplier}.");
    }
    assert!(orbit.is_saddle());
    if let Some(file) = std::env::args().nth(1) {
        let returns = returns.recorded();
        let mut certificate = Certificate::new("rossler");
        certificate.fixed_point(&returns, &fixed_point(&returns, &[-8.4, 0.03], &[])?)?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
