use basin_of_attraction::*;
use hopper_basin::*;
use std::ops::ControlFlow;
fn main() {
    let which = std::env::args().nth(1).unwrap();
    let side = 1024;
    let ((a, b), (c, d)) = match which.as_str() {
        "6" => ((0.1, 1.0), (first_humps(5).left, first_humps(5).right)),
        "7" => ((1.0, 10.0), (first_humps(5).left, first_humps(5).right)),
        _ => FIG_9,
    };
    let g = Grid {
        x: Interval::new(a, b).unwrap(),
        y: Interval::new(c, d).unwrap(),
        columns: side,
        rows: side,
    };
    for _ in 0..std::env::args().nth(2).unwrap().parse::<usize>().unwrap() {
        let i = basin_raster(g, |_| ControlFlow::Continue(())).unwrap();
        std::hint::black_box(&i);
        if std::env::args().nth(3).is_some() {
            let mut h = std::collections::BTreeMap::new();
            let mut hash = 0u64;
            for x in 0..side {
                for y in 0..side {
                    let l = i.at(x, y).unwrap();
                    *h.entry(l).or_insert(0) += 1;
                    hash = hash.wrapping_mul(6364136223846793005).wrapping_add(l as u64 + 1);
                }
            }
            println!("{hash:x} {h:?}");
        }
    }
}
