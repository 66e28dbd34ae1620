//! Single hops along the slow side of a fixed point, where the series has no value.

use crate::error::Error;
use passive_hopper::LiftOffMap;

/// Most hops from the reach of a phase to the range of the series. The range begins at A x = 0.04, some 25 hops inside.
const MOST_HOPS: i64 = 10_000;

/// Relative error of δ′, in units of ε (`LiftOffMap::hop_near_fixed_point`), with the error of a search for a preimage.
const HOP_ULPS: f64 = 10.0;

/// Most steps of the search for a preimage.
const SEARCH_STEPS: usize = 60;

/// From `delta` towards α*_n until |δ| ≤ `range`: the offset, the number of hops, and a bound on the error of the phase. On the
/// left the hops are inverted.
pub(crate) fn inward(
    map: &LiftOffMap,
    n: u64,
    delta: f64,
    range: f64,
    drift: f64,
) -> Result<(f64, i64, f64), Error> {
    let (mut inner, mut hops, mut error) = (delta, 0, 0.0);
    while inner.abs() > range {
        inner = if delta < 0.0 { preimage(map, n, inner)? } else { next(map, n, inner)? };
        hops += 1;
        if hops > MOST_HOPS || !(inner.abs() < delta.abs()) {
            return Err(Error::OutsideRange { value: delta, left: -range, right: range });
        }
        // dΨ = dδ/(3 A |δ|^{4/3}); a fifth covers the next orders.
        error += 1.2 * HOP_ULPS * f64::EPSILON / (3.0 * drift * pxfm::f_cbrt(inner.abs()));
    }
    Ok((inner, hops, error))
}

/// `hops` hops away from α*_n, from an offset with an error; on the right they are inverted.
pub(crate) fn outward(
    map: &LiftOffMap,
    n: u64,
    (delta, error): (f64, f64),
    hops: f64,
    reach: f64,
) -> Result<(f64, f64), Error> {
    let (mut outer, mut left) = (delta, hops);
    // The relative error grows as dΨ/dδ falls: like |δ|^{1/3}.
    let mut relative = error / delta.abs();
    while left > 0.0 {
        let before = outer;
        outer = if delta < 0.0 { next(map, n, outer)? } else { preimage(map, n, outer)? };
        relative = relative * pxfm::f_cbrt(outer / before) * 1.01 + HOP_ULPS * f64::EPSILON;
        left -= 1.0;
        if !(outer.abs() <= reach) {
            let (left, right) = if delta < 0.0 { (-reach, 0.0) } else { (0.0, reach) };
            return Err(Error::OutsideRange { value: outer, left, right });
        }
    }
    Ok((outer, relative * outer.abs()))
}

fn next(map: &LiftOffMap, n: u64, delta: f64) -> Result<f64, Error> {
    let hop = map.hop_near_fixed_point(n, delta)?;
    hop.next.ok_or(Error::OutsideRange { value: delta, left: 0.0, right: 0.0 })
}

/// The offset on the same side from which a hop leads to `delta`, by the secant method. f rises there.
fn preimage(map: &LiftOffMap, n: u64, delta: f64) -> Result<f64, Error> {
    let loss = |at: f64| next(map, n, at).map(|next| at - next);
    // δ₀ = δ + loss(δ₀), and the loss changes slowly.
    let (mut a, mut value) = (delta, loss(delta)?);
    let mut b = delta + value * (delta.abs() / (delta.abs() + value)).powi(2);
    for _ in 0..SEARCH_STEPS {
        let other = loss(b)?;
        let slope = 1.0 - (other - value) / (b - a);
        let step = (b - delta - other) / slope;
        (a, value) = (b, other);
        b -= step;
        if !(step.abs() > 2.0 * f64::EPSILON * b.abs()) || a == b {
            return Ok(b);
        }
    }
    Err(Error::OutsideRange { value: delta, left: 0.0, right: 0.0 })
}
