//! Duffing's oscillator ẍ + 0.15ẋ − x + x³ = 0.2 cos t: the basins of its two periodic orbits on [−2.2, 2.2]², at t = 0.
//!
//! `cargo run --release --example duffing -- 9 11 100000` divides the window from 2⁻⁹ of its sides down to 2⁻¹¹, with at most so many images.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use std::ops::ControlFlow;
use std::time::Instant;
use validated_dynamics::{
    Division, Enclosure, Error, Limits, ProvedBasins, ProvedFate, SectionMap, Trap,
    ValidatedSystem, fixed_point,
};

fn main() -> Result<(), Error> {
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse().ok());
    let mut number = |default: usize| numbers.next().unwrap_or(default);
    let (first, last, images) = (number(8) as u32, number(9) as u32, number(100_000));
    let duffing = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"])
        .rising_text("period", "t - 2*pi");
    let system = ValidatedSystem::new(&duffing)?;
    let start = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
    let period = SectionMap::new(&system, start, "period", 1, &["x", "v"])?
        .within(Limits { width: 1.0, ..Limits::default() });
    let begin = Instant::now();
    let mut traps = Vec::new();
    for guess in [[-0.8, 0.0], [1.2, 0.1]] {
        let orbit = fixed_point(&period, &guess, &[])?;
        let trap = Trap::new(&period, &orbit, 20_000)?;
        println!("x in {}, trap of size {:.3}, {:?}", orbit.point[0], trap.size(), begin.elapsed());
        traps.push(trap);
    }
    let window = [Enclosure::new(-2.2, 2.2), Enclosure::new(-2.2, 2.2)];
    let division = Division { first, last, images };
    let basins = ProvedBasins::watched(&[&period], traps, &[&window], division, &mut |progress| {
        println!(
            "{:.2} %, {} images, {:?}",
            100.0 * progress.proved,
            progress.images,
            begin.elapsed()
        );
        ControlFlow::Continue(())
    })?;
    for trap in [0, 1] {
        println!("basin {trap}: {:.2} %", 100.0 * basins.share(ProvedFate::Trap(trap)));
    }
    Ok(())
}
