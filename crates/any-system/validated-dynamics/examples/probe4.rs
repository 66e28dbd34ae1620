//! Probe.
use hybrid_system::Equations;
use validated_dynamics::*;
fn main() -> Result<(), Error> {
    let eq = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"])
        .rising_text("period", "t - 2*pi");
    let system = ValidatedSystem::new(&eq)?;
    let chart = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
    let map = SectionMap::new(&system, chart, "period", 1, &["x", "v"])?;
    let side = 4.4 / f64::from(1 << 12);
    for i in 0..10 {
        let x = -2.2 + 4.4 * (f64::from(i) * 0.618034).fract();
        let v = -2.2 + 4.4 * (f64::from(i) * 0.754877).fract();
        let cell = [Enclosure::new(x, x + side), Enclosure::new(v, v + side)];
        map.image(&cell)?;
    }
    Ok(())
}
