//! A runner on a spring leg (80 kg, 1 m, 20 kN/m, an angle of attack of 68°) with the energy of 5 m/s at 1 m: its gait, the apex heights from which it is
//! attracted, and one from which the runner falls.

#![allow(clippy::print_stdout)] // a program

use example_systems::spring_leg::spring_leg_that_falls;
use std::time::Instant;
use validated_dynamics::{Error, SectionMap, Trap, ValidatedSystem, fixed_point};

fn main() -> Result<(), Error> {
    let begin = Instant::now();
    let system = ValidatedSystem::new(&spring_leg_that_falls())?;
    let apex = ["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"];
    let map =
        SectionMap::new(&system, system.chart("flight", &["h"], &apex)?, "apex", 1, &["height"])?;
    let gait = fixed_point(&map, &[0.94], &[])?;
    println!("the gait has its apex in {} m", gait.point[0]);
    println!("  multiplier in {}, {:?}", gait.multipliers[0], begin.elapsed());
    let trap = Trap::new(&map, &gait, 3000)?;
    let radius = trap.size() * trap.directions()[(0, 0)].abs();
    println!("  attracts |h − {}| < {radius}, {:?}", trap.centre()[0], begin.elapsed());

    // From 2 m the runner falls in the third flight.
    let mut run = system.start("flight", &["0", "2", "sqrt(25 + 2*gravity*(1 - 2))", "0"])?;
    let fall = loop {
        let event = run.next_event()?;
        print!("{}, ", event.surface);
        if event.next.is_none() {
            break event;
        }
    };
    println!("at {} s, {:?}", fall.time, begin.elapsed());
    Ok(())
}
