//! Probe.
use hybrid_system::Equations;
use validated_dynamics::*;
fn main() -> Result<(), Error> {
    let oscillator = Equations::new(&["x", "y"], &[])
        .mode_text("flow", &["y", "(1 - x^2)*y - x"])
        .falling_text("right", "y")
        .only_where_text("x");
    let system = ValidatedSystem::new(&oscillator)?;
    let axis = system.chart("flow", &["x"], &["x", "0"])?;
    let returns = SectionMap::new(&system, axis, "right", 1, &["x"])?;
    for (a, b) in [(1.8, 1.8001), (1.8, 1.801), (1.8, 1.81), (1.8, 1.83), (1.0, 1.01), (0.5, 0.505), (2.5, 2.51), (3.0, 3.01)] {
        match returns.carry(StartSet::of_box(&[Enclosure::new(a, b)])) {
            Ok(c) => println!("{a} {b} {:?} {:?}", c.set.hull(), c.events.len()),
            Err(e) => println!("{a} {b} {e}"),
        }
    }
    Ok(())
}
