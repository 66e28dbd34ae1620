//! Single hops along the slow side of a fixed point, where the series has no value.

use crate::error::Error;
use passive_hopper::LiftOffMap;

/// Most hops from the reach of a phase to the range of the series. There are some ten to thirty, and more only if
/// the drift is so small (M below 10⁻⁴) that the range is limited by the series of the flights.
pub(crate) const MOST_HOPS: i64 = 10_000;

/// Relative error of δ′ in units of ε (`LiftOffMap::hop_near_fixed_point`).
const HOP_ULPS: f64 = 8.0;

/// Relative error of a preimage in units of ε: that of the hop, because f moves the preimage by a larger part of
/// itself than its image, and 2 for the end of the search.
const PREIMAGE_ULPS: f64 = 10.0;

/// Most steps of the search for a preimage.
const SEARCH_STEPS: usize = 60;

/// From `delta`, right to an ulp, towards α*_n until |δ| ≤ `range`: the offset, the number of hops, and a bound on
/// the error of the phase. On the left the hops are inverted.
///
/// A hop of length L changes Ψ by 1, and |dΨ/dδ| grows towards α*_n, by the factor f′ or 1/f′ from one end to the
/// other. So it is at most 1/L at the outer end, and at most f′/L or 1/(f′L) at the inner one. To leading order |f′
/// − 1| is (4/3) L/|δ|. With 1.5 L/|δ|, where δ is the start of the hop, and L ≤ |δ|/4 on the right,
///
/// ```text
///   |δ_inner| |dΨ/dδ| ≤ |δ|/L + 1.5
/// ```
pub(crate) fn inward(
    map: &LiftOffMap,
    n: u64,
    delta: f64,
    range: f64,
) -> Result<(f64, i64, f64), Error> {
    let (mut inner, mut hops, mut error) = (delta, 0, 0.0);
    let ulps = if delta < 0.0 { PREIMAGE_ULPS } else { HOP_ULPS };
    while inner.abs() > range {
        let before = inner;
        inner = if delta < 0.0 { preimage(map, n, inner)? } else { next(map, n, inner)? };
        hops += 1;
        let length = before.abs() - inner.abs();
        if hops > MOST_HOPS || !(length > 0.0 && inner * delta > 0.0) {
            return Err(Error::OutsideRange { value: delta, left: -range, right: range });
        }
        let start = if delta < 0.0 { inner } else { before };
        if hops == 1 {
            error += f64::EPSILON * delta.abs() / length;
        }
        error += ulps * f64::EPSILON * (start.abs() / length + 1.5);
    }
    Ok((inner, hops, error))
}

/// `hops` ≤ [`MOST_HOPS`] hops away from α*_n, from an offset with a relative error; on the right they are
/// inverted. The result has a relative error as well.
pub(crate) fn outward(
    map: &LiftOffMap,
    n: u64,
    (delta, error): (f64, f64),
    hops: i64,
    reach: f64,
) -> Result<(f64, f64), Error> {
    let (mut outer, mut relative) = (delta, error);
    for _ in 0..hops {
        let before = outer;
        outer = if delta < 0.0 { next(map, n, outer)? } else { preimage(map, n, outer)? };
        // f or its inverse multiplies a small error by f′ or 1/f′, where |f′ − 1| is (4/3) L/|δ| to leading order,
        // and less than 1.5 L/|δ| over the error.
        let length = outer.abs() - before.abs();
        let factor = if delta < 0.0 {
            (before.abs() + 1.5 * length) / outer.abs()
        } else {
            before.abs() / (outer.abs() - 1.5 * length)
        };
        relative = relative * factor + PREIMAGE_ULPS * f64::EPSILON;
        // Within its error the offset may be as far as the reach.
        if !(outer.abs() * (1.0 - relative) <= reach) {
            let (left, right) = if delta < 0.0 { (-reach, 0.0) } else { (0.0, reach) };
            return Err(Error::OutsideRange { value: outer, left, right });
        }
    }
    Ok((outer, relative))
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
