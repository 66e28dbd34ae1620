//! How far an interval of attraction really reaches, the sudden windows included.

use crate::hump::Hump;
use crate::{Error, Fates, Trap, TrapEdge, crisis};
use basin_of_attraction::{Image, ScalarMap};
use passive_hopper::{FixedPointSpeed, MassRatio};

/// The largest interval [α*_n, α*_n + Δ) on which f ≥ α*_n, up to the next fixed point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImmediateBasin {
    /// Δ, with the bound on its error beside it.
    pub delta: f64,
    /// Bound on the error of Δ, given that its edge is the one found.
    pub error: f64,
    /// Where it ends.
    pub edge: ImmediateBasinEdge,
}

/// Where a reach ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImmediateBasinEdge {
    /// On the contact part of the hump: the only crossing there, proved.
    Contact,
    /// In the sudden window: the first place where f < α*_n was found on a scan. An earlier fall,
    /// narrower than this width, would not have been seen.
    Sudden {
        /// The spacing of the scan.
        width: f64,
    },
    /// At the next fixed point, by a bound that needs no map.
    NextFixedPoint,
    /// At the next fixed point, on a scan: a fall narrower than this width would not have been seen.
    NotFound {
        /// The spacing of the scan.
        width: f64,
    },
}

/// The reach of α*_n, certain on the contact part of its hump, and scanned at a spacing of `width` in
/// the sudden window beyond.
///
/// For M ≳ 10 the map has needles narrower than any spacing (canards): the answer is the one at
/// that width.
///
/// ```
/// use hopper_basin::{Fates, ImmediateBasinEdge, immediate_basin};
/// use passive_hopper::MassRatio;
/// let reach = immediate_basin(&Fates::new(MassRatio::new(10.0)?)?, 1, 1e-3)?;
/// assert!((reach.delta - 2.57746178999).abs() < 1e-10);
/// assert!(matches!(reach.edge, ImmediateBasinEdge::Sudden { .. }));
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`Trap::new`]; [`Error::Width`] unless the width is positive and leaves at most ten million
/// places; [`Error::Hopper`] where the map cannot be evaluated.
pub fn immediate_basin(fates: &Fates, n: u64, width: f64) -> Result<ImmediateBasin, Error> {
    let trap = fates.trap(n)?;
    let edge = match trap.edge {
        TrapEdge::Crossing => ImmediateBasinEdge::Contact,
        TrapEdge::NextFixedPoint => ImmediateBasinEdge::NextFixedPoint,
        TrapEdge::ContactEnd => return scan(fates, &trap, width),
    };
    Ok(ImmediateBasin { delta: trap.delta, error: trap.error, edge })
}

fn scan(fates: &Fates, trap: &Trap, width: f64) -> Result<ImmediateBasin, Error> {
    let next = FixedPointSpeed::new(trap.n + 1);
    let (left, right) = (trap.right(), next.value().next_down());
    let places = ((right - left) / width).ceil();
    if !(width > 0.0 && (1.0..=1e7).contains(&places)) {
        return Err(Error::Width { width, length: right - left });
    }
    // The star itself maps to itself: "below" is below its f64.
    let falls = |alpha: f64| match fates.image(alpha) {
        Image::Point(image) => Ok(image < trap.fixed_point.value()),
        Image::Stops => Ok(true),
        Image::Undecided => {
            fates.map().image(alpha).map(|image| image.is_none()).map_err(Error::from)
        }
    };
    let mut above = left;
    for place in 1..=places as u64 {
        let at = (left + (right - left) * (place as f64 / places)).min(right);
        if falls(at)? {
            let mut below = at;
            // To neighbouring f64: f is continuous where it first falls (theory: e.1).
            while above.next_up() < below {
                let middle = above + 0.5 * (below - above);
                if falls(middle)? { below = middle } else { above = middle }
            }
            let delta = trap.fixed_point.offset_of(below);
            let error = place_error(fates, below)?;
            return Ok(ImmediateBasin { delta, error, edge: ImmediateBasinEdge::Sudden { width } });
        }
        above = at;
    }
    let delta = trap.fixed_point.offset_of(next.value());
    Ok(ImmediateBasin {
        delta,
        error: f64::EPSILON * delta,
        edge: ImmediateBasinEdge::NotFound { width },
    })
}

/// How far off a place may be at which the map was compared with a number: an ulp, and the map's own
/// error, 4 (1 + sudden) of its unit, over its slope.
fn place_error(fates: &Fates, alpha: f64) -> Result<f64, Error> {
    let ulp = f64::EPSILON * alpha;
    let (hop, slopes) = (fates.map().hop(alpha)?, fates.map().slopes(alpha)?);
    let (Some(next), Some(slopes)) = (hop.next, slopes) else { return Ok(ulp) };
    let m = fates.map().mass_ratio().value();
    let slope = slopes.by_speed.abs();
    let unit = next + slope * alpha + slopes.by_mass_ratio.abs() * m + alpha * (alpha / next);
    Ok(ulp + 2.0 * (1 + hop.sudden) as f64 * f64::EPSILON * unit / slope)
}

/// Between which mass ratios above 1 the sudden window stops to let orbits fall through α*_n, at this
/// width: at the first a fall was found, at the second none. The counterpart for M > 1 of the
/// [`crisis`], which concerns the contact part alone.
///
/// The bracket is closed to a relative 10⁻⁶; that falls stay away above it is scanned at `width`
/// for mass ratios up to `largest`, 32 of them, and at no others.
///
/// # Errors
/// As [`immediate_basin`] and [`crisis`]; [`Error::Width`] too if falls are found up to `largest`.
pub fn recovery(n: u64, width: f64, largest: f64) -> Result<(f64, f64), Error> {
    const SCAN: u32 = 32;
    let contact = 1.0 / crisis(n)?.mass_ratio;
    let falls = |m: f64| -> Result<bool, Error> {
        let found = immediate_basin(&Fates::new(MassRatio::new(m)?)?, n, width)?;
        Ok(!matches!(
            found.edge,
            ImmediateBasinEdge::NotFound { .. } | ImmediateBasinEdge::NextFixedPoint
        ))
    };
    // Geometric steps from the largest down to where the contact part takes over.
    let at = |k: u32| {
        let part = f64::from(k) / f64::from(SCAN);
        contact * pxfm::f_pow(largest / contact, part)
    };
    let mut stays = None;
    for k in (0..=SCAN).rev() {
        if falls(at(k))? {
            let Some(mut stays) = stays else {
                return Err(Error::Width { width, length: largest });
            };
            let mut below = at(k);
            while stays - below > 1e-6 * stays {
                let middle = 0.5 * (below + stays);
                if falls(middle)? { below = middle } else { stays = middle }
            }
            return Ok((below, stays));
        }
        stays = Some(at(k));
    }
    Ok((contact, contact))
}

/// Bound on the rounding error of the offset at which f first falls to α*_n.
///
/// The equation α² − α*² = μΓ² is evaluated to some ulps of either side; the slope of their
/// difference in δ is 2α (1 − 4μW).
pub(crate) fn crossing_error(hump: &Hump, mu: f64, t: f64) -> f64 {
    const ULPS: f64 = 16.0;
    let (delta, w) = (hump.delta(t), hump.w(t));
    let alpha = hump.star.value() + delta;
    let sides = delta * (alpha + hump.star.value());
    let slope = 2.0 * alpha * (4.0 * mu * w - 1.0).abs();
    f64::EPSILON * (ULPS * sides / slope + 2.0 * delta)
}
