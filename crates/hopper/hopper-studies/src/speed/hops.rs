//! Hops of the paper's window, one by one and many in one call.

use crate::error::Error;
use crate::reference::{ReferenceHop, window_hops};
use crate::timing::median_seconds;
use hopper_basin::first_humps;
use hopper_reference::UNITS_PER_FLIGHT;
use passive_hopper::{LiftOffMap, MassRatio};

/// Numbers of mass ratios and of speeds for each in the timed set: 65 536 different hops, too many for a branch
/// predictor to learn.
const MAPS: usize = 64;
const SPEEDS: usize = 1024;

/// Hops in the paper's window, distributed as in the reference file: M log-uniform in [0.05, 20], α uniform in
/// [α*₁, α*₆].
///
/// Multiples of 1/φ (φ² = φ + 1) and of 1/ρ (ρ³ = ρ + 1) modulo 1 fill an interval evenly, without random numbers.
fn window_maps() -> Vec<(LiftOffMap, Vec<f64>)> {
    let (low, high) = (first_humps(5).left, first_humps(5).right);
    let part = |k: usize, step: f64| (k as f64 * step).fract();
    let speed = |k: usize| low + (high - low) * part(k, 0.754_877_666_246_693);
    (1..=MAPS)
        .filter_map(|j| {
            let m = 0.05 * pxfm::f_pow(400.0, part(j, 0.618_033_988_749_895));
            let map = LiftOffMap::new(MassRatio::new(m).ok()?);
            Some((map, (0..SPEEDS).map(|k| speed(k * MAPS + j)).collect()))
        })
        .collect()
}

/// Compares single hops with the reference, and hops in one call with single hops.
pub(super) fn check() -> Result<String, Error> {
    let hops = window_hops()?;
    for hop in &hops {
        let map = LiftOffMap::new(hop.mass_ratio);
        let mut many = vec![Some(hop.alpha); 32];
        map.images(&mut many)?;
        let found = map.image(hop.alpha)?;
        let right = many.iter().all(|image| *image == found)
            && match (found, hop.next) {
                (Some(found), Some(exact)) => {
                    (found - exact).abs() <= hop.allowed(UNITS_PER_FLIGHT)
                }
                (None, None) => true,
                _ => false,
            };
        if !right {
            return Err(wrong(hop, &found));
        }
    }
    for (map, speeds) in window_maps() {
        let mut many: Vec<_> = speeds.iter().copied().map(Some).collect();
        map.images(&mut many)?;
        for (&alpha, image) in speeds.iter().zip(many) {
            if map.image(alpha)? != image {
                let m = map.mass_ratio().value();
                return Err(Error::CheckFailed(format!("M = {m}, α = {alpha}: {image:?} at once")));
            }
        }
    }
    Ok(format!("{} reference hops; {} at once bit for bit", hops.len(), MAPS * SPEEDS))
}

/// Compares the number of landings of each hop, and the sum of the energies that they take, with the reference.
pub(super) fn check_landings() -> Result<String, Error> {
    let mut count = 0;
    for hop in &window_hops()? {
        let map = LiftOffMap::new(hop.mass_ratio);
        let landings = map.landings(hop.alpha)?;
        let squares: f64 = landings.iter().map(|l| l.closing_speed * l.closing_speed).sum();
        let next_speed_squared = hop.alpha * hop.alpha - hop.mass_ratio.mu() * squares;
        let right = landings.len() == 1 + hop.sudden
            && match hop.next {
                // α′² = α² − μ Σ v²: an error e of α′ is an error 2α′e of α′².
                Some(next) => {
                    (next_speed_squared - next * next).abs()
                        <= 2.0 * next * hop.allowed(UNITS_PER_FLIGHT)
                }
                None => next_speed_squared < 0.0,
            };
        if !right {
            return Err(wrong(hop, &landings));
        }
        count += landings.len();
    }
    Ok(format!("{count} landings of the reference's hops"))
}

fn wrong(hop: &ReferenceHop, found: &impl std::fmt::Debug) -> Error {
    let (m, alpha) = (hop.mass_ratio.value(), hop.alpha);
    Error::CheckFailed(format!("M = {m}, α = {alpha}: {found:?}"))
}

/// Seconds for a hop by `LiftOffMap::image`.
pub(super) fn scalar_time() -> f64 {
    let maps = window_maps();
    // Neighbouring calls have different M and α, so that a branch predictor cannot use the previous call.
    median_seconds(MAPS * SPEEDS, |k| {
        let (map, speeds) = &maps[k % MAPS];
        map.image(speeds[k / MAPS])
    })
}

/// Seconds for a hop by `LiftOffMap::images`, on one core.
pub(super) fn bulk_time() -> f64 {
    let maps = window_maps();
    let buffer = std::cell::RefCell::new(vec![None; SPEEDS]);
    median_seconds(MAPS, |k| {
        let (map, speeds) = &maps[k];
        let mut buffer = buffer.borrow_mut();
        for (slot, &speed) in buffer.iter_mut().zip(speeds) {
            *slot = Some(speed);
        }
        map.images(&mut buffer)
    }) / SPEEDS as f64
}

/// Seconds for a landing by `LiftOffMap::landings`, which gives the time and the state.
pub(super) fn landing_time() -> f64 {
    let maps = window_maps();
    let landings = |k: usize| {
        let (map, speeds) = &maps[k % MAPS];
        map.landings(speeds[k / MAPS]).map_or(0, |landings| landings.len())
    };
    let count: usize = (0..MAPS * SPEEDS).map(landings).sum();
    median_seconds(MAPS * SPEEDS, landings) * (MAPS * SPEEDS) as f64 / count as f64
}
