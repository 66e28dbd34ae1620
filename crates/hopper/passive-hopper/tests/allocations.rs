//! Hops do not allocate memory, neither one by one nor many at once.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

#[test]
fn hops_do_not_allocate() {
    let (low, high) = (alpha_star(1), alpha_star(6));
    let speeds: Vec<_> = (0..4000u32)
        .map(|k| Some(low + (high - low) * (f64::from(k) * 0.754_877_666_246_693).fract()))
        .collect();
    let maps = [0.05, 0.3, 1.0, 4.0, 20.0].map(|m| LiftOffMap::new(MassRatio::new(m).unwrap()));
    let mut buffer = speeds.clone();
    let mut each: Vec<_> = maps.iter().cycle().zip(speeds.iter().copied()).collect();
    let mut hops = || {
        for map in &maps {
            buffer.copy_from_slice(&speeds);
            map.images(&mut buffer).unwrap();
            for (&alpha, image) in speeds.iter().flatten().zip(&buffer) {
                assert_eq!(map.hop(alpha).unwrap().next, *image);
            }
        }
        for (hop, &speed) in each.iter_mut().zip(&speeds) {
            hop.1 = speed;
        }
        LiftOffMap::images_of_pairs(&mut each).unwrap();
    };
    // The first call builds the tables of the first flight and the arrays of the batch.
    hops();
    let info = allocation_counter::measure(hops);
    assert_eq!(info.count_total, 0, "{info:?}");
}
