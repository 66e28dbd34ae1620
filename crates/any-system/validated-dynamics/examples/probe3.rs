//! Probe.
use hybrid_system::Equations;
use std::ops::ControlFlow;
use std::time::Instant;
use validated_dynamics::*;

fn main() -> Result<(), Error> {
    let last: u32 = std::env::args().nth(1).map_or(9, |x| x.parse().unwrap());
    let parts: usize = std::env::args().nth(2).map_or(4, |x| x.parse().unwrap());
    let images: usize = std::env::args().nth(3).map_or(100_000, |x| x.parse().unwrap());
    let mut eq = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "0.2*cos(t) - 0.15*v + x - x^3"]);
    for part in 1..=parts {
        eq = eq.rising_text(&format!("{part}"), &format!("t - 2*pi*{part}/{parts}"));
    }
    let system = ValidatedSystem::new(&eq)?;
    let chart = |part: usize| system.chart("flow", &["x", "v"], &["x", "v", &format!("2*pi*{part}/{parts}")]);
    let limits = Limits { width: 1.0, ..Limits::default() };
    let map = SectionMap::new(&system, chart(0)?, &format!("{parts}"), 1, &["x", "v"])?;
    let mut maps = Vec::new();
    for part in 0..parts {
        maps.push(SectionMap::new(&system, chart(part)?, &format!("{}", part + 1), 1, &["x", "v"])?.within(limits));
    }
    let mut traps = Vec::new();
    for guess in [[-1.1, 0.1], [1.1, 0.1]] {
        let found = fixed_point(&map, &guess, &[])?;
        let begin = Instant::now();
        let trap = Trap::new(&map, &found, 60_000)?;
        println!("{:?} trap {} {}", begin.elapsed(), trap.size, trap.contraction); traps.push(trap);
    }
    let window = [Enclosure::new(-2.2, 2.2), Enclosure::new(-2.2, 2.2)];
    let window2 = [Enclosure::new(-3.0, 3.0), Enclosure::new(-3.0, 3.0)];
    let mut windows: Vec<&[Enclosure]> = vec![&window2; parts];
    windows[0] = &window;
    let begin = Instant::now();
    let maps: Vec<&SectionMap> = maps.iter().collect();
    let mut k = 0;
    let basins = ProvedBasins::watched(&maps, traps, &windows, Division { first: std::env::args().nth(4).map_or(4, |x| x.parse().unwrap()), last, images }, &mut |p| { k += 1; if k % 10 == 0 || true { println!("{:?} {p:?}", begin.elapsed()); } ControlFlow::Continue(()) })?;
    println!("{:?} images {}", begin.elapsed(), basins.images);
    for (k, _) in basins.traps().iter().enumerate() {
        println!("{k} {}", basins.share(ProvedFate::Trap(k)));
    }
    Ok(())
}
