//! Probe.
use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::*;

fn show(name: &str, begin: Instant, found: Result<ProvedFixedPoint, Error>) {
    match found {
        Ok(orbit) => println!("{name} {:?} width {:e} point {:?}\n unique {:?}\n multipliers {:?} attracting {} saddle {} events {}", begin.elapsed(), orbit.image.derivatives.width(), orbit.point, orbit.unique_in, orbit.multipliers, orbit.is_attracting(), orbit.is_saddle(), orbit.image.events.len()),
        Err(error) => println!("{name} {:?} {error}", begin.elapsed()),
    }
}

fn main() -> Result<(), Error> {
    let eq = Equations::new(&["x", "v"], &[("F", "1")])
        .mode_text("free", &["v", "F*cos(1.3*t) - 0.1*v - x"])
        .rising_text("stop", "x - 0.5")
        .resets_text(&["x", "-0.8*v"]);
    let system = ValidatedSystem::new(&eq)?;
    let chart = system.chart("free", &["v", "s"], &["0.5", "v", "s"])?;
    let map = SectionMap::new(&system, chart, "stop", 1, &["v", "t - 2*pi/1.3"])?;
    let begin = Instant::now();
    show("impact", begin, fixed_point(&map, &[-1.4814, 0.1643], &[]));
    let system = ValidatedSystem::with_interval_parameters(&eq, &["F"])?;
    let chart = system.chart("free", &["v", "s", "f"], &["0.5", "v", "s", "f"])?;
    let map = SectionMap::new(&system, chart, "stop", 1, &["v", "t - 2*pi/1.3"])?;
    for width in [1e-6, 1e-4, 1e-3, 3e-3, 1e-2] {
        let begin = Instant::now();
        show(&format!("impact, F ± {width}"), begin, fixed_point(&map, &[-1.4814, 0.1643], &[Enclosure::new(1.0 - width, 1.0 + width)]));
    }
    // SLIP
    let eq = Equations::new(&["x", "height", "speed", "climb"], &[("mass", "80"), ("stiffness", "2e4"), ("leg", "1"), ("gravity", "9.81"), ("attack", "68")])
        .mode_text("flight", &["speed", "climb", "0", "-gravity"])
        .falling_text("touchdown", "height - leg*sin(attack*pi/180)")
        .crossing()
        .resets_text(&["-leg*cos(attack*pi/180)", "height", "speed", "climb"])
        .to("stance")
        .falling_text("apex", "climb")
        .mode_text("stance", &["speed", "climb", "stiffness/mass*(leg/sqrt(x^2 + height^2) - 1)*x", "stiffness/mass*(leg/sqrt(x^2 + height^2) - 1)*height - gravity"])
        .rising_text("take-off", "sqrt(x^2 + height^2) - leg")
        .crossing()
        .to("flight");
    let system = ValidatedSystem::new(&eq)?;
    let chart = system.chart("flight", &["h"], &["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"])?;
    let map = SectionMap::new(&system, chart, "apex", 1, &["height"])?;
    let begin = Instant::now();
    show("slip", begin, fixed_point(&map, &[0.940267], &[]));
    // van der Pol
    let eq = Equations::new(&["x", "y"], &[("mu", "1")])
        .mode_text("flow", &["y", "mu*(1 - x^2)*y - x"])
        .falling_text("section", "y");
    let system = ValidatedSystem::new(&eq)?;
    let chart = system.chart("flow", &["x"], &["x", "0"])?;
    let map = SectionMap::new(&system, chart, "section", 1, &["x"])?;
    let begin = Instant::now();
    show("van der Pol", begin, fixed_point(&map, &[2.0086], &[]));
    Ok(())
}
