//! The damped double well ẍ + 0.15ẋ − x + x³ = 0: which starts in [−2.2, 2.2]² come to rest on the left, and which on the right.
//!
//! `cargo run --release --example double_well -- 7 10 200000` divides the window from 2⁻⁷ of its sides down to 2⁻¹⁰, with at most so many images. Behind
//! these numbers the time of the map may follow, and a file for a certificate.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use std::error::Error;
use std::ops::ControlFlow;
use std::time::Instant;
use validated_dynamics::{
    Certificate, Division, Enclosure, Limits, ProvedBasins, ProvedFate, SectionMap, Trap,
    ValidatedSystem, fixed_point,
};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let mut number =
        |default: u32| words.next().and_then(|word| word.parse().ok()).unwrap_or(default);
    let (first, last, images) = (number(8), number(11), number(800_000) as usize);
    // About one turn about a point of rest: a box is a trap only if its image has turned back into it.
    let time = words.next().unwrap_or_else(|| "4.45".to_owned());
    let file = words.next();
    let begin = Instant::now();
    // The map over a fixed time.
    let well = Equations::new(&["x", "v", "time"], &[])
        .mode_text("flow", &["v", "x - x^3 - 0.15*v", "1"])
        .rising_text("later", &format!("time - {time}"));
    let system = ValidatedSystem::new(&well)?;
    let start = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
    let mut later = SectionMap::new(&system, start, "later", 1, &["x", "v"])?
        .within(Limits { width: 1.0, ..Limits::default() });
    if file.is_some() {
        later = later.recorded();
    }
    let mut certificate = Certificate::new("double_well");
    let (mut traps, mut numbers) = (Vec::new(), Vec::new());
    for side in [-1.0, 1.0] {
        let rest = fixed_point(&later, &[side, 0.0], &[])?;
        let trap = Trap::new(&later, &rest, 500)?;
        println!("x in {}, trap of size {:.3}, {:?}", rest.point[0], trap.size(), begin.elapsed());
        if file.is_some() {
            numbers.push(certificate.trap(&later, &trap)?);
        }
        traps.push(trap);
    }
    let window = [Enclosure::new(-2.2, 2.2), Enclosure::new(-2.2, 2.2)];
    let division = Division { first, last, images };
    let basins = ProvedBasins::watched(&[&later], traps, &[&window], division, &mut |progress| {
        let (share, images) = (100.0 * progress.proved, progress.images);
        println!("{share:.2} %, {images} images, {:?}", begin.elapsed());
        ControlFlow::Continue(())
    })?;
    for trap in [0, 1] {
        println!("basin {trap}: {:.2} %", 100.0 * basins.share(ProvedFate::Trap(trap)));
    }
    if let Some(file) = file {
        certificate.basins(&later, &basins, &numbers)?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
