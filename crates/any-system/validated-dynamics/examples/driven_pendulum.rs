//! The driven pendulum φ̈ + 0.1φ̇ + sin φ = 0.5: which starts with |φ̇| ≤ 10 come to rest at sin φ = 0.5, and which rotate for ever.
//!
//! The angle θ = φ − π/6 is counted from the point of rest. Every start at θ = π with a rate from 0 to 11 comes to the one rotation: a statement about
//! one variable, which is proved first. A start reaches π forwards with √(100 + 6π) < 11 at most, as (ω²)′ ≤ 3 over the angle on the way: so it rotates for
//! ever. One that reaches −π backwards goes on at π.
//!
//! `cargo run --release --example driven_pendulum -- 7 10 200000` divides the window from 2⁻⁷ of its sides down to 2⁻¹⁰, with at most so many images. A
//! file behind these numbers gets a certificate.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::{Equations, Label};
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::time::Instant;
use validated_dynamics::{
    Certificate, Division, Enclosure, Limits, Progress, ProvedBasins, ProvedFate, SectionMap, Trap,
    ValidatedSystem, fixed_point,
};

/// The rate of change of the angular rate ω.
const TORQUE: &str = "0.5 - 0.1*omega - sin(theta + pi/6)";

/// The time of the map: about one turn about the point of rest. A box is a trap only if its image has turned back into it.
const TIME: &str = "6.75";

/// The sets of a run are given up beyond this width.
const WIDEST: f64 = 1.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let mut number =
        |default: u32| words.next().and_then(|word| word.parse().ok()).unwrap_or(default);
    let (first, last, images) = (number(7), number(10), number(200_000) as usize);
    let mut output = words.next().map(|file| (file, Certificate::new("driven_pendulum")));
    let begin = Instant::now();
    // One open cell would leave 2⁻¹² open.
    if rotating(output.as_mut().map(|(_, certificate)| certificate))? < 0.9999 {
        return Err("not every start at θ = π is proved to rotate".into());
    }
    println!("all rates at θ = π rotate, {:?}", begin.elapsed());

    let pendulum = Equations::new(&["theta", "omega", "time"], &[])
        .mode_text("swing", &["omega", TORQUE, "1"])
        .rising_text("later", &format!("time - {TIME}"))
        .rising_text("over", "theta - pi")
        .stops()
        .falling_text("back", "theta + pi")
        .resets_text(&["pi", "omega", "time"]);
    let system = ValidatedSystem::new(&pendulum)?;
    let start = system.chart("swing", &["theta", "omega"], &["theta", "omega", "0"])?;
    let mut later = SectionMap::new(&system, start, "later", 1, &["theta", "omega"])?
        .within(Limits { width: WIDEST, ..Limits::default() });
    if output.is_some() {
        later = later.recorded();
    }
    let trap = Trap::new(&later, &fixed_point(&later, &[0.0, 0.0], &[])?, 2000)?;
    println!("at rest: a trap of size {:.3}, {:?}", trap.size(), begin.elapsed());
    // A little less than a whole turn, whose ends are no doubles.
    let half = PI - 1e-7;
    let window = [Enclosure::new(-half, half), Enclosure::new(-10.0, 10.0)];
    let division = Division { first, last, images };
    let mut watch = |progress: Progress| {
        let (share, images) = (100.0 * progress.proved, progress.images);
        println!("{share:.2} %, {images} images, {:?}", begin.elapsed());
        ControlFlow::Continue(())
    };
    let basins = ProvedBasins::watched(&[&later], vec![trap], &[&window], division, &mut watch)?;
    println!("rest: {:.4}", basins.share(ProvedFate::Trap(0)));
    println!("rotation: {:.4}", basins.share(ProvedFate::Stopped(Label::new("over")?)));
    if let Some((file, mut certificate)) = output {
        let trap = certificate.trap(&later, &basins.traps()[0])?;
        certificate.basins(&later, &basins, &[trap])?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}

/// The share of the rates from 0 to 11 at θ = π from which every start comes to the one rotation.
fn rotating(certificate: Option<&mut Certificate>) -> Result<f64, validated_dynamics::Error> {
    let pendulum = Equations::new(&["theta", "omega"], &[])
        .mode_text("swing", &["omega", TORQUE])
        .rising_text("around", "theta - 3*pi");
    let system = ValidatedSystem::new(&pendulum)?;
    let start = system.chart("swing", &["omega"], &["pi", "omega"])?;
    let mut around = SectionMap::new(&system, start, "around", 1, &["omega"])?;
    if certificate.is_some() {
        around = around.recorded();
    }
    let rotation = fixed_point(&around, &[5.0], &[])?;
    println!("rotation: ω = {} at π, multiplier {}", rotation.point[0], rotation.multipliers[0]);
    let trap = Trap::new(&around, &rotation, 500)?;
    let window = [Enclosure::new(0.0, 11.0)];
    let division = Division { first: 4, last: 12, images: 10_000 };
    let basins = ProvedBasins::new(&[&around], vec![trap], &[&window], division)?;
    if let Some(certificate) = certificate {
        certificate.fixed_point(&around, &rotation)?;
        let trap = certificate.trap(&around, &basins.traps()[0])?;
        certificate.basins(&around, &basins, &[trap])?;
    }
    Ok(basins.share(ProvedFate::Trap(0)))
}
