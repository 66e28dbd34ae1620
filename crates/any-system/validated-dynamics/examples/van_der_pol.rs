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

/// The halves of the axes, against the turn: the name, what falls to 0 there, the states at a distance r, the distance.
const HALVES: [(&str, &str, [&str; 2], &str); 4] = [
    ("right", "y", ["r", "0"], "x"),
    ("above", "-x", ["0", "r"], "y"),
    ("left", "-y", ["-r", "0"], "-x"),
    ("below", "x", ["0", "-r"], "-y"),
];

/// Sectors begin at this angle before a half: orbits come to it within a finite time.
const BEFORE: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let file = std::env::args().nth(1);
    // One system for each half, whose surface is that half alone: other halves are crossed unseen.
    let to_half = |(name, falls, ..): (&str, &str, [&str; 2], &str)| {
        let free = Equations::new(&["x", "y"], &[]).mode_text("flow", &["y", "(1 - x^2)*y - x"]);
        ValidatedSystem::new(&free.falling_text(name, falls))
    };
    let to_the_right = to_half(HALVES[0])?;
    let returns = |states: [&str; 2]| {
        let chart = to_the_right.chart("flow", &["r"], &states)?;
        let map = SectionMap::new(&to_the_right, chart, "right", 1, &["x"])?;
        Ok::<_, Box<dyn Error>>(prepared(map, file.is_some()))
    };
    let mut certificate = Certificate::new("van_der_pol");

    let own = returns(HALVES[0].2)?;
    let cycle = fixed_point(&own, &[2.0], &[])?;
    println!("the cycle crosses at {}, multiplier {}", cycle.point[0], cycle.multipliers[0]);
    let trap = Trap::new(&own, &cycle, 20_000)?;
    println!("a trap of size {} about it, {:?}", trap.size(), begin.elapsed());
    if file.is_some() {
        certificate.fixed_point(&own, &cycle)?;
        certificate.trap(&own, &trap)?;
    }

    let mut is_whole = true;
    let mut led = |map: &SectionMap<'_>, whole: &[Enclosure], target: Target| {
        let budget = Budget { boxes: 100_000, divisions: 12 };
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
        match file {
            Some(_) => Ok(certificate.leads(map, whole, &parts, target)?),
            None => Ok::<_, Box<dyn Error>>(0),
        }
    };
    for (number, half) in HALVES.into_iter().enumerate() {
        let (name, _, states, read) = half;
        let from_half = led(&returns(states)?, &[HALF], Target::Trap(0))?;
        let low = number as f64 * FRAC_PI_2 + BEFORE;
        let sector = [Enclosure::new(0.5, 3.0), Enclosure::new(low, low + 1.0001 * FRAC_PI_2)];
        let system = to_half(half)?;
        let polar = system.chart("flow", &["r", "a"], &["r*cos(a)", "r*sin(a)"])?;
        let to_it = SectionMap::new(&system, polar, name, 1, &[read])?;
        led(&prepared(to_it, file.is_some()), &sector, Target::Box(from_half))?;
    }
    println!("the whole annulus converges: {is_whole}");
    if let Some(file) = file {
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}

/// A map that gives up sets that have become too wide, and writes its steps down for a certificate.
fn prepared(map: SectionMap<'_>, is_recorded: bool) -> SectionMap<'_> {
    let map = map.within(Limits { width: 1.0, ..Limits::default() });
    if is_recorded { map.recorded() } else { map }
}
