//! Probe.
use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::*;
fn main() -> Result<(), Error> {
    for parts in [1, 2, 4, 8] {
        let eq = Equations::new(&["x", "v"], &[])
            .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"])
            .rising_text("end", &format!("t - 2*pi/{parts}"));
        let system = ValidatedSystem::new(&eq)?;
        let chart = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
        let map = SectionMap::new(&system, chart, "end", 1, &["x", "v"])?.within(Limits { width: 1.0, ..Limits::default() });
        for k in [4, 5, 6, 7, 8, 10, 12] {
            let side = 4.4 / f64::from(1 << k);
            let begin = Instant::now();
            let (mut ok, mut sum, mut steps, mut exact) = (0, 0.0, 0, 0.0);
            for i in 0..50 {
                let x = -2.2 + 4.4 * (f64::from(i) * 0.618034).fract();
                let v = -2.2 + 4.4 * (f64::from(i) * 0.754877).fract();
                let cell = [Enclosure::new(x, x + side), Enclosure::new(v, v + side)];
                if let Ok(image) = map.carry(StartSet::of_box(&cell).without_derivatives()) {
                    ok += 1; sum += image.set.hull().iter().map(|x| x.width()).fold(0.0, f64::max) / side;
                    let m = map.image(&[Enclosure::from(x), Enclosure::from(v)])?.derivatives.middle();
                    exact += (0..2).map(|r| m[(r, 0)].abs() + m[(r, 1)].abs()).fold(0.0, f64::max);
                    let mut run = map.run(&cell)?.without_derivatives(); run.next_event()?; steps += run.steps();
                }
            }
            println!("{parts} 2^-{k} ok {ok} stretch {:.2} of {:.2} steps {} each {:?}", sum / f64::from(ok), exact / f64::from(ok), steps as f64 / f64::from(ok), begin.elapsed() / 150);
        }
    }
    Ok(())
}
