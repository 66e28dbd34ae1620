//! Probe.
use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::*;

fn main() -> Result<(), Error> {
    let eq = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"])
        .rising_text("period", "t - 2*pi");
    let system = ValidatedSystem::new(&eq)?;
    let chart = system.chart("flow", &["x", "v"], &["x", "v", "0"])?;
    let map = SectionMap::new(&system, chart, "period", 1, &["x", "v"])?;
    for k in [8, 10, 12] {
        let side = 4.4 / f64::from(1 << k);
        let begin = Instant::now();
        let mut ok = 0; let mut sum = 0.0; let mut largest: f64 = 0.0; let mut steps = 0;
        let mut reasons = std::collections::BTreeMap::new();
        for i in 0..100 {
            let x = -2.2 + 4.4 * (f64::from(i) * 0.618034).fract();
            let v = -2.2 + 4.4 * (f64::from(i) * 0.754877).fract();
            let cell = [Enclosure::new(x, x + side), Enclosure::new(v, v + side)];
            match map.set_image(&cell) {
                Ok(image) => { ok += 1; let w = image.hull().iter().map(|x| x.width()).fold(0.0, f64::max); sum += w / side; largest = largest.max(w / side); 
                    let mut run = map.run(&cell)?.without_derivatives(); run.next_event()?; steps += run.steps(); }
                Err(e) => { let _ = e; *reasons.entry(0).or_insert(0) += 1; }
            }
        }
        println!("2^-{k} ok {ok} mean stretch {:.2} largest {largest:.2} steps {} {:?} each {:?}", sum / f64::from(ok), steps / ok.max(1) as usize, begin.elapsed() / 200, reasons);
    }
    Ok(())
}
