//! A runner on a spring leg (80 kg, 1 m, 20 kN/m, an angle of attack of 68°) with the energy of 5 m/s at 1 m: its gait, the apex heights from which it is
//! attracted, and one from which the runner falls.

use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::{EnclosedMap, Error, SectionMap, Trap, ValidatedSystem, fixed_point};

fn main() -> Result<(), Error> {
    let begin = Instant::now();
    let numbers =
        [("mass", "80"), ("stiffness", "2e4"), ("leg", "1"), ("gravity", "9.81"), ("attack", "68")];
    let push = "stiffness/mass*(leg/sqrt(x^2 + height^2) - 1)";
    let runner = Equations::new(&["x", "height", "speed", "climb"], &numbers)
        .mode_text("flight", &["speed", "climb", "0", "-gravity"])
        .falling_text("touchdown", "height - leg*sin(attack*pi/180)")
        .crossing()
        .resets_text(&["-leg*cos(attack*pi/180)", "height", "speed", "climb"])
        .to("stance")
        .falling_text("apex", "climb")
        .falling_text("ground", "height")
        .stops()
        .mode_text("stance", &["speed", "climb", &format!("{push}*x"), &format!("{push}*height - gravity")])
        .rising_text("take-off", "sqrt(x^2 + height^2) - leg")
        .crossing()
        .to("flight")
        .falling_text("stumble", "height")
        .stops();
    let system = ValidatedSystem::new(&runner)?;
    let apex = ["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"];
    let map = SectionMap::new(&system, system.chart("flight", &["h"], &apex)?, "apex", 1, &["height"])?;
    let gait = fixed_point(&map, &[0.94], &[])?;
    println!("the gait has its apex at {:?} m", gait.point[0]);
    println!("  multiplier {:?}, {:?}", gait.multipliers[0].real(), begin.elapsed());
    let trap = Trap::new(&map, &gait, 3000)?;
    let radius = trap.size * trap.directions[(0, 0)].abs();
    println!("  attracts |h − {}| < {radius}, {:?}", trap.centre[0], begin.elapsed());

    for (a, b) in [(0.85, 0.86), (0.82, 0.83), (0.82, 0.94), (0.9, 1.0), (0.81, 1.07)] {
        println!("{a} {b} {:?}", map.image(&[validated_dynamics::Enclosure::new(a, b)]).map(|x| (x.values, x.events.iter().map(|e| (e.surface, e.time)).collect::<Vec<_>>())));
    }
    println!("{:?} {:?}", trap.directions, trap.size);
    for height in ["2.0", "0.93", "0.9275", "0.927", "0.9", "0.85"] {
        let mut run = system.start("flight", &["0", height, &format!("sqrt(25 + 2*gravity*(1 - {height}))"), "0"])?;
        let mut path = Vec::new();
        let fate = loop {
            match run.next_event() {
                Ok(event) => {
                    path.push(event.surface.to_string());
                    if event.next.is_none() {
                        break format!("falls at t = {:?}", event.time);
                    }
                    if path.len() > 12 {
                        break "runs on".to_owned();
                    }
                }
                Err(error) => break error.to_string(),
            }
        };
        println!("from {height} m: {} {fate}", path.join(", "));
    }
    Ok(())
}
