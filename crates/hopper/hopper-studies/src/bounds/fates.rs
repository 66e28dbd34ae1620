//! The error bounds of traps and of orbits, against longer arithmetic.

use super::measured::Measured;
use super::tally::Tally;
use crate::error::Error;
use basin_of_attraction::SplitMix64;
use hopper_basin::{Trap, TrapEdge};
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, HopWithin, LiftOffMap, MassRatio,
    index_below,
};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Seed of the inputs.
const SEED: u64 = 15;

/// An orbit has at most this many hops. Orbits of the paper's window have four on the average; slow ones have more.
const MOST_HOPS: usize = 60;

/// One orbit in so many is followed in 106 and in 512 bits. A hop in 512 bits takes milliseconds.
const ONE_IN: u64 = 8;
/// Most orbits of a class that are followed in 512 bits: some minutes for all classes.
const MOST_EXTENDED_ORBITS: u64 = 300;

/// A bound of the next speed: the kernel's, or the one with the signs of the derivative.
type Within = fn(&LiftOffMap, f64, f64) -> HopWithin;

const WAYS: [(&str, Within); 2] = [
    ("orbit in f64, sum of absolute values", LiftOffMap::hop_within),
    ("orbit in f64, signed derivative", LiftOffMap::signed_hop_within),
];

/// A start of an orbit, (M, α), from three random numbers.
type DrawStart = fn([f64; 3]) -> (f64, f64);

const STARTS: [(&str, DrawStart); 3] = [
    ("M in [0.1, 1], α in [4.5, 20]", |[a, b, _]| (0.1 + 0.9 * a, 4.5 + 15.5 * b)),
    ("M in [1, 20], α in [3, 60]", |[a, b, _]| (pxfm::f_pow(20.0, a), 3.0 + 57.0 * b)),
    ("left of a fixed point", |[a, b, c]| {
        let star = FixedPointSpeed::new(1 + (8.0 * b) as u64);
        (0.05 + 0.95 * a, star.value() - pxfm::f_pow(10.0, -7.0 * c - 1.0))
    }),
];

/// Measures the bounds of traps and of orbits on about `count` inputs a class.
pub(crate) fn measure(count: u64) -> Result<Vec<Measured>, Error> {
    let random = SplitMix64::from_seed(SEED);
    let part = |k: u64, which: u64| random.uniform(3 * k + which);
    let mut measured = Vec::new();
    for (class, n) in [("n = 0", 0..1), ("n = 1 … 40", 1..41)] {
        let at = |k: u64| {
            let n = n.start + (part(k, 1) * (n.end - n.start) as f64) as u64;
            (n, 0.35 + 2.0 * part(k, 0))
        };
        let tally = collect(count, |tally, k| {
            let (n, m) = at(k);
            crossing_ratio(n, m)?.into_iter().for_each(|ratio| tally.add(ratio, k));
            Ok(())
        })?;
        let text = |k| format!("(n, M) = {:?}", at(k));
        measured.push(tally.measured("length of a trap, crossing", "Lemma 77", class, text));
    }
    let at = |k: u64| (3.0 * pxfm::f_pow(10.0, 7.0 * part(k, 0))) as u64;
    let tally = collect(count, |tally, k| {
        contact_end_ratio(at(k))?.into_iter().for_each(|ratio| tally.add(ratio, k));
        Ok(())
    })?;
    let text = |k| format!("n = {}", at(k));
    measured.push(tally.measured(
        "length of a trap, closed form",
        "Lemma 76",
        "n up to 3·10⁷",
        text,
    ));
    for (bound, within) in WAYS {
        for (class, start) in STARTS {
            let at = |k: u64| start([0, 1, 2].map(|which| part(k, which)));
            let tally =
                collect(count, |tally, k| follow(at(k), within, |ratio| tally.add(ratio, k)))?;
            let text = |k| format!("(M, α) = {:?}", at(k));
            measured.push(tally.measured(bound, "Lemma 78", class, text));
        }
    }
    for (class, start) in STARTS {
        let at = |k: u64| start([0, 1, 2].map(|which| part(k, which)));
        let orbits = count.div_ceil(ONE_IN).min(MOST_EXTENDED_ORBITS);
        let tally =
            collect(orbits, |tally, k| follow_extended(at(k), |ratio| tally.add(ratio, k)))?;
        let text = |k| format!("(M, α) = {:?}", at(k));
        measured.push(tally.measured("orbit in 106 bits", "Lemma 78", class, text));
    }
    Ok(measured)
}

/// The tally of `count` inputs, the same for any number of threads.
fn collect(
    count: u64,
    add: impl Fn(&mut Tally, u64) -> Result<(), Error> + Sync,
) -> Result<Tally, Error> {
    (0..count)
        .into_par_iter()
        .try_fold(Tally::new, |mut tally, k| add(&mut tally, k).map(|()| tally))
        .try_reduce(Tally::new, |mut a, b| {
            a.merge(&b);
            Ok(a)
        })
}

/// Error of Δ over its bound; `None` unless the trap ends by a crossing or by grounding.
///
/// The edge is where the exact image crosses α*_n. From the `f64` next to the computed edge one step of Newton's
/// method leads there, with the image in 256 bits and the slope in `f64`: the step is below an ulp of α, and its
/// relative error is that of the slope. For n = 0 the squares of the image are used, F = α′², since α′ has an
/// infinite slope at the edge.
fn crossing_ratio(n: u64, m: f64) -> Result<Option<f64>, Error> {
    let map = LiftOffMap::new(MassRatio::new(m)?);
    let trap = Trap::new(n, map.mass_ratio())?;
    if trap.edge != TrapEdge::Crossing {
        return Ok(None);
    }
    let mut alpha = trap.right();
    // For n = 0 the speeds beyond the edge have no image.
    let (mut orbit, mut step) = (None, ExtendedStep::Grounded);
    for _ in 0..64 {
        let mut found = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits256)?;
        step = found.hop()?;
        if step == ExtendedStep::LiftsOff {
            orbit = Some(found);
            break;
        }
        alpha = alpha.next_down();
    }
    let (Some(orbit), ExtendedStep::LiftsOff) = (orbit, step) else { return Ok(None) };
    let offset = trap.fixed_point.offset_of(alpha);
    // dF/dα = 2α (1 − 4μW) = 2α′ dα′/dα.
    let Some(slopes) = map.slopes(alpha)? else { return Ok(None) };
    let next = orbit.speed();
    let beyond = if n == 0 {
        next * next / (2.0 * next * slopes.by_speed)
    } else {
        orbit.offset_from(n).0 / slopes.by_speed
    };
    let exact = offset - beyond;
    Ok(Some((trap.delta - exact).abs() / trap.error))
}

/// Error of (n+1)π − α*_n over its bound, for a mass ratio so small that the trap has no crossing.
fn contact_end_ratio(n: u64) -> Result<Option<f64>, Error> {
    let trap = Trap::new(n, MassRatio::new(f64::MIN_POSITIVE)?)?;
    let star = trap.fixed_point;
    // (k π) − α in three exact pieces of π: 26 bits, 27 bits, and the rest.
    let head = f64::from_bits(PI.to_bits() >> 27 << 27);
    let tail = PI - head;
    let rest = 1.224_646_799_147_353_2e-16;
    let above = |k: f64, star: FixedPointSpeed| {
        ((head * k - star.value()) + tail * k) + (rest * k - star.rest())
    };
    let exact = match trap.edge {
        TrapEdge::Crossing => return Ok(None),
        TrapEdge::ContactEnd => above((n + 1) as f64, star),
        TrapEdge::NextFixedPoint => {
            let next = FixedPointSpeed::new(n + 1);
            (next.value() - star.value()) + (next.rest() - star.rest())
        }
    };
    Ok(Some((trap.delta - exact).abs() / trap.error))
}

/// Follows an orbit in `f64` and in 106 bits, and gives the ratio of their distance to the bound after each hop.
fn follow((m, alpha): (f64, f64), within: Within, mut see: impl FnMut(f64)) -> Result<(), Error> {
    let map = LiftOffMap::new(MassRatio::new(m)?);
    let mut exact = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits106)?;
    let (mut speed, mut error) = (alpha, 0.0);
    for _ in 0..MOST_HOPS {
        let HopWithin::Next { speed: next, error: bound } = within(&map, speed, error) else {
            break;
        };
        if exact.hop()? != ExtendedStep::LiftsOff {
            break;
        }
        (speed, error) = (next, bound);
        // Offsets from a fixed point have more digits than the speeds.
        let n = index_below(speed)?;
        let (offset, rounding) = exact.offset_from(n);
        let distance = (offset - FixedPointSpeed::new(n).offset_of(speed)).abs();
        see((distance - f64::EPSILON * offset.abs() + rounding).max(0.0) / error);
        if speed < 1.0 {
            break;
        }
    }
    Ok(())
}

/// Follows an orbit in 106 and in 512 bits, and gives the ratio of their distance to the bound of the first after
/// each hop. The bound of the second counts as an error.
fn follow_extended((m, alpha): (f64, f64), mut see: impl FnMut(f64)) -> Result<(), Error> {
    let map = LiftOffMap::new(MassRatio::new(m)?);
    let mut orbit = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits106)?;
    let mut exact = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits512)?;
    for _ in 0..MOST_HOPS {
        if orbit.hop()? != ExtendedStep::LiftsOff || exact.hop()? != ExtendedStep::LiftsOff {
            break;
        }
        let near = exact.speed();
        // Both differences are some 10⁻¹⁶ of the speed, so that their rounding to `f64` is far below the bounds.
        let distance = (orbit.minus(near) - exact.minus(near)).abs();
        see((distance + exact.error()) / orbit.error());
        if near < 1.0 {
            break;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_bound_of_traps_and_orbits_is_exceeded() {
        for found in measure(40).unwrap() {
            assert!(found.count > 5 && found.largest <= 1.0, "{found:?}");
        }
    }
}
