//! Van der Pol's oscillator, ẍ − (1 − x²)ẋ + x = 0: every orbit that starts in the annulus 0.5 ≤ r ≤ 3 converges to its cycle.
//!
//! Orbits cross each half of an axis in one direction. The return map of the right half has a trap: an interval all of whose points converge. Points of all
//! halves come into it, and each part of the annulus comes to one of the halves.
//!
//! `cargo run --release --example van_der_pol -- van_der_pol.jsonl` writes a certificate, too.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::time::Instant;
use validated_dynamics::{
    Budget, Certificate, EnclosedMap, Enclosure, Limits, SectionMap, StartSet, Target, Trap,
    ValidatedSystem, divided, fixed_point, halves,
};

/// The part of each half of an axis of which convergence is shown.
const HALF: Enclosure = Enclosure::new(0.1, 3.9);

/// The halves of the axes, against the turn: the angle, the states at a distance r, the distance.
const HALVES: [(&str, [&str; 2], &str); 4] = [
    ("right", ["r", "0"], "x"),
    ("above", ["0", "r"], "y"),
    ("left", ["-r", "0"], "-x"),
    ("below", ["0", "-r"], "-y"),
];

/// Sectors begin at this angle before a half: orbits come to it within a finite time.
const BEFORE: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let oscillator = Equations::new(&["x", "y"], &[])
        .mode_text("flow", &["y", "(1 - x^2)*y - x"])
        .falling_text("right", "y")
        .rising_text("left", "y")
        .falling_text("below", "x")
        .rising_text("above", "x");
    let system = ValidatedSystem::new(&oscillator)?;
    let limits = Limits { width: 1.0, ..Limits::default() };
    let map = |variables: &[&str], states: [&str; 2], surface: &str, read: &str| {
        let chart = system.chart("flow", variables, &states)?;
        Ok::<_, Box<dyn Error>>(
            SectionMap::new(&system, chart, surface, 1, &[read])?.within(limits).recorded(),
        )
    };
    let mut certificate = Certificate::new();

    let returns = map(&["r"], HALVES[0].1, "right", "x")?;
    let cycle = fixed_point(&returns, &[2.0], &[])?;
    println!("the cycle crosses at {}, multiplier {}", cycle.point[0], cycle.multipliers[0]);
    certificate.fixed_point(&returns, &cycle)?;
    let trap = Trap::new(&returns, &cycle, 20_000)?;
    println!("a trap of size {} about it, {:?}", trap.size(), begin.elapsed());
    let into_trap = Target::Trap(certificate.trap(&returns, &trap)?);

    let mut is_whole = true;
    let mut led = |map: &SectionMap<'_>, whole: &[Enclosure], target: Target| {
        let budget = Budget { boxes: 100_000, divisions: 14 };
        let found = divided(whole, budget, halves, |part| {
            let image = map.carry(StartSet::of_box(part).without_derivatives())?;
            let is_led = match target {
                Target::Trap(_) => trap.contains_set(&image.set),
                _ => image.set.hull()[0].is_inside(&HALF),
            };
            Ok(is_led.then_some(()))
        })?;
        let parts: Vec<_> = found.decided.into_iter().map(|(part, ())| part).collect();
        let open = found.open.len();
        println!("{map:?}: {} parts are led, {open} are open, {:?}", parts.len(), begin.elapsed());
        is_whole &= open == 0;
        Ok::<_, Box<dyn Error>>(certificate.leads(map, whole, &parts, target)?)
    };
    for (number, (name, states, read)) in HALVES.into_iter().enumerate() {
        let half = led(&map(&["r"], states, "right", "x")?, &[HALF], into_trap)?;
        let low = number as f64 * FRAC_PI_2 + BEFORE;
        let sector = [Enclosure::new(0.5, 3.0), Enclosure::new(low, low + 1.0001 * FRAC_PI_2)];
        let polar = map(&["r", "a"], ["r*cos(a)", "r*sin(a)"], name, read)?;
        led(&polar, &sector, Target::Box(half))?;
    }
    println!("the whole annulus converges: {is_whole}");
    if let Some(file) = std::env::args().nth(1) {
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
