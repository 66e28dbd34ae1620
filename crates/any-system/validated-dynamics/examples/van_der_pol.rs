//! Van der Pol's oscillator, ẍ − (1 − x²)ẋ + x = 0: every orbit that starts in the annulus 0.5 ≤ r ≤ 3 converges to its cycle.
//!
//! Orbits cross each half of an axis in one direction. The return map of the right half has a trap: an interval all of whose points converge. Points of the
//! other halves come into it, and each part of the annulus comes to one of the halves.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::{
    Budget, EnclosedMap, Enclosure, Error, Limits, SectionMap, StartSet, Trap, ValidatedSystem,
    divided, fixed_point, halves,
};

/// The part of each half of an axis of which convergence is shown.
const HALF: Enclosure = Enclosure::new(0.1, 3.9);

/// The halves of the axes, with their states at a distance r.
const HALVES: [(&str, [&str; 2]); 4] =
    [("right", ["r", "0"]), ("below", ["0", "-r"]), ("left", ["-r", "0"]), ("above", ["0", "r"])];

fn main() -> Result<(), Error> {
    let begin = Instant::now();
    let free = Equations::new(&["x", "y"], &[]).mode_text("flow", &["y", "(1 - x^2)*y - x"]);
    let axes = free.clone();
    let axes = axes.falling_text("right", "y").rising_text("left", "y");
    let axes = axes.falling_text("below", "x").rising_text("above", "x");
    let (free, axes) = (ValidatedSystem::new(&free)?, ValidatedSystem::new(&axes)?);
    let limits = Limits { width: 1.0, ..Limits::default() };
    let to_the_right = |(_, states): (&str, [&str; 2])| {
        SectionMap::new(&axes, axes.chart("flow", &["r"], &states)?, "right", 1, &["x"])
    };

    let returns = to_the_right(HALVES[0])?.within(limits);
    let cycle = fixed_point(&returns, &[2.0], &[])?;
    println!("the cycle crosses at {}, multiplier {}", cycle.point[0], cycle.multipliers[0]);
    let trap = Trap::new(&returns, &cycle, 20_000)?;
    println!("on the right {HALF} converges: {}, {:?}", trap.contains(&[HALF]), begin.elapsed());

    let budget = Budget { boxes: 50_000, divisions: 12 };
    for half in &HALVES[1..] {
        let map = to_the_right(*half)?.within(limits);
        let found = divided(&[HALF], budget, halves, |part| {
            let image = map.carry(StartSet::of_box(part).without_derivatives())?;
            Ok(trap.contains_set(&image.set).then_some(()))
        })?;
        let (decided, open) = (found.decided.len(), found.open.len());
        println!("{}: {decided} parts converge, {open} are open, {:?}", half.0, begin.elapsed());
    }

    // Parts of the annulus that begin on an axis leave it first, for the time ¼.
    let polar = free.chart("flow", &["r", "a"], &["r*cos(a)", "r*sin(a)"])?;
    let annulus = [Enclosure::new(0.5, 3.0), Enclosure::new(0.0, 6.3)];
    let found = divided(&annulus, budget, halves, |part| {
        let after = |time: f64| {
            let mut run = free.start_on(&polar, part)?.within(limits).without_derivatives();
            run.advance(Enclosure::from(time))?;
            let start = StartSet::of_set(run.set()).without_derivatives();
            let event = axes.start_from("flow", start)?.within(limits).next_event()?;
            let distance = event.after.iter().fold(Enclosure::ZERO, |sum, x| sum + x.abs());
            Ok::<_, Error>(distance.is_inside(&HALF).then_some(()))
        };
        after(0.0).or_else(|_| after(0.25))
    })?;
    let (decided, open) = (found.decided.len(), found.open.len());
    println!("annulus: {decided} parts come to a half, {open} are open, {:?}", begin.elapsed());
    Ok(())
}
