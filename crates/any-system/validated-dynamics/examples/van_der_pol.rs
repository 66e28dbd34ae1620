//! Van der Pol's oscillator, ẍ − (1 − x²)ẋ + x = 0: every orbit that starts in the annulus 0.5 ≤ r ≤ 3 converges to its cycle.
//!
//! The section is y = 0 with x > 0. Its return map has one fixed point in an interval that it leads into itself, so that all of the interval
//! converges. Each part of the annulus comes to the section in this interval.

use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::{
    Budget, Enclosure, Error, Limits, SectionMap, StartSet, Trap, ValidatedSystem, divided,
    fixed_point, halves,
};

fn main() -> Result<(), Error> {
    let begin = Instant::now();
    let oscillator = Equations::new(&["x", "y"], &[])
        .mode_text("flow", &["y", "(1 - x^2)*y - x"])
        .falling_text("right", "y")
        .only_where_text("x");
    let system = ValidatedSystem::new(&oscillator)?;
    let axis = system.chart("flow", &["x"], &["x", "0"])?;
    let returns = SectionMap::new(&system, axis, "right", 1, &["x"])?;
    let cycle = fixed_point(&returns, &[2.0], &[])?;
    println!("the cycle crosses at {:?}, multiplier {:?}", cycle.point[0], cycle.multipliers[0]);
    let trap = Trap::new(&returns, &cycle, 2000)?;
    let ends = trap.size * trap.directions[(0, 0)].abs();
    println!("|x − {}| < {ends} converges to it", trap.centre[0]);

    // Parts that begin on the section move away from it first, for the time 1.
    let free = Equations::new(&["x", "y"], &[]).mode_text("flow", &["y", "(1 - x^2)*y - x"]);
    let free = ValidatedSystem::new(&free)?;
    let polar = free.chart("flow", &["r", "a"], &["r*cos(a)", "r*sin(a)"])?;
    let annulus = [Enclosure::new(0.5, 3.0), Enclosure::new(0.0, 6.2832)];
    let budget = Budget { boxes: 100_000, divisions: 9 };
    let limits = Limits { width: 2.0, ..Limits::default() };
    let found = divided(&annulus, budget, halves, |part| {
        let after = |time: f64| {
            let mut run = free.start_on(&polar, part)?.within(limits).without_derivatives();
            run.advance(Enclosure::from(time))?;
            let start = StartSet::of_set(run.set()).without_derivatives();
            let event = system.start_from("flow", start)?.within(limits).next_event()?;
            Ok::<_, Error>(trap.contains(&event.after[..1]))
        };
        let comes = after(0.0).or_else(|_| after(1.0))?;
        Ok(comes.then_some(()))
    })?;
    println!("{} parts decided, {} open, {:?}", found.decided.len(), found.open.len(), begin.elapsed());
    for (part, why) in found.open.iter().take(5) {
        println!("  {part:?} {}", why.as_ref().map_or(String::new(), |why| why.reason.to_string()));
    }
    Ok(())
}
