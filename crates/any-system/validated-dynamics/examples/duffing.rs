//! Duffing's oscillator ẍ + 0.15ẋ − x + x³ = 0.2 cos t: the basins of its two periodic orbits on [−2.2, 2.2]², at t = 0.
//!
//! `cargo run --release --example duffing -- 9 11 100000` divides the window from 2⁻⁹ of its sides down to 2⁻¹¹, with at most so many images; a file behind these numbers gets a certificate. At first it
//! says how much a proof with such cells could show at best: of some cells of the last size, how many have one fate at nine of their points.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::{Equations, Integration, Tolerances};
use nalgebra::Vector2;
use std::error::Error;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::Instant;
use validated_dynamics::{
    Certificate, Division, Enclosure, Limits, ProvedBasins, ProvedFate, SectionMap, Trap,
    ValidatedSystem, fixed_point,
};

/// Half of the window's sides.
const HALF: f64 = 2.2;

/// The cells of the last size that are looked at: three standard errors of a share are 3.3 %.
const LOOKED: u32 = 2000;

/// The periods for which a cell is followed. All but some have come to a periodic orbit.
const PERIODS: usize = 200;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let mut number =
        |default: u32| words.next().and_then(|word| word.parse().ok()).unwrap_or(default);
    let (first, last, images) = (number(8), number(9), number(100_000) as usize);
    let file = words.next();
    let duffing = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"])
        .rising_text("period", "t - 2*pi");
    let system = ValidatedSystem::new(&duffing)?;
    let start = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
    let mut period = SectionMap::new(&system, start, "period", 1, &["x", "v"])?
        .within(Limits { width: 1.0, ..Limits::default() });
    if file.is_some() {
        period = period.recorded();
    }
    let mut certificate = Certificate::new("duffing");
    let begin = Instant::now();
    let (mut traps, mut numbers) = (Vec::new(), Vec::new());
    for guess in [[-0.8, 0.0], [1.2, 0.1]] {
        let orbit = fixed_point(&period, &guess, &[])?;
        let trap = Trap::new(&period, &orbit, 20_000)?;
        println!("x in {}, trap of size {:.3}, {:?}", orbit.point[0], trap.size(), begin.elapsed());
        if file.is_some() {
            numbers.push(certificate.trap(&period, &trap)?);
        }
        traps.push(trap);
    }
    let at_best = with_one_fate(&traps, last)?;
    println!("one fate: {:.1} % of cells of 2^-{last}, {:?}", 100.0 * at_best, begin.elapsed());
    let side = Enclosure::new(-HALF, HALF);
    let window = [side, side];
    let division = Division { first, last, images };
    let basins = ProvedBasins::watched(&[&period], traps, &[&window], division, &mut |progress| {
        let (share, images) = (100.0 * progress.proved, progress.images);
        println!("{share:.2} %, {images} images, {:?}", begin.elapsed());
        ControlFlow::Continue(())
    })?;
    for trap in [0, 1] {
        println!("basin {trap}: {:.2} %", 100.0 * basins.share(ProvedFate::Trap(trap)));
    }
    if let Some(file) = file {
        certificate.basins(&period, &basins, &numbers)?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}

/// The share of cells with sides of 2^−`halvings` of the window's that have nine points of one fate, without a proof.
fn with_one_fate(traps: &[Trap], halvings: u32) -> Result<f64, Box<dyn Error>> {
    let half = HALF / f64::from(1 << halvings);
    let mut same = 0;
    for cell in 1..=LOOKED {
        // Multiples of irrational numbers fill the window evenly.
        let [x, v] = [std::f64::consts::SQRT_2, 1.732_050_807_568_877_2]
            .map(|root| HALF * (2.0 * (f64::from(cell) * root).fract() - 1.0));
        let mut points: Vec<[f64; 2]> = (0..9)
            .map(|place| [x + half * f64::from(place % 3 - 1), v + half * f64::from(place / 3 - 1)])
            .collect();
        for _ in 0..PERIODS {
            for point in &mut points {
                *point = after_a_period(*point)?;
            }
            let holds = |trap: &Trap, own: &[f64; 2]| trap.contains(&own.map(Enclosure::from));
            if traps.iter().any(|trap| points.iter().all(|own| holds(trap, own))) {
                same += 1;
                break;
            }
        }
    }
    Ok(f64::from(same) / f64::from(LOOKED))
}

fn after_a_period(start: [f64; 2]) -> Result<[f64; 2], hybrid_system::Error> {
    let field = |t: f64, s: &Vector2<f64>| {
        let force = 0.2 * pxfm::f_cos(t);
        Vector2::new(s.y, force - 0.15 * s.y + s.x - s.x * s.x * s.x)
    };
    let start = Vector2::from(start);
    let mut motion = Integration::new(field, &start, Tolerances::both(1e-8))?.until(TAU)?;
    while !motion.ended() {
        motion.step()?;
    }
    Ok([motion.state().x, motion.state().y])
}
