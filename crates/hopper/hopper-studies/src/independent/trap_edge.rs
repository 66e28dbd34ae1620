//! The edge of the trap of a fixed point, searched on a map.

use super::map::Map;
use crate::error::Error;
use passive_hopper::{FixedPointSpeed, MassRatio};
use std::f64::consts::PI;

/// The distance right of α*_n at which the search begins. The map is above α*_n there if λ < 215, and its height over
/// α*_n is far above rounding.
const FIRST: f64 = 1e-7;
/// Ratio of neighbouring distances of the search. A dip of the map below α*_n that is narrower than a twentieth of its
/// distance is missed.
const RATIO: f64 = 1.05;
/// The distance over which the slope at the edge is measured, relative to Δ. The difference of two images is then some
/// 10⁻³Δ, far above rounding.
const SLOPE_STEP: f64 = 1e-3;

/// Where a map first falls below α*_n.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeasuredEdge {
    /// The distance from α*_n, Δ_n.
    pub(crate) delta: f64,
    /// The slope of the map there; negative.
    pub(crate) slope: f64,
    /// The speed of the edge.
    pub(crate) alpha: f64,
}

impl MeasuredEdge {
    /// The error of Δ if α′² of the map has this error relative to α².
    pub(crate) fn error(&self, relative: f64) -> f64 {
        0.5 * relative * self.alpha / self.slope.abs() + f64::EPSILON * self.alpha
    }
}

/// The first fall of `map` through α*_n on the contact part of hump n; `None` if it does not fall.
pub(crate) fn trap_edge(
    map: &impl Map,
    n: u64,
    mass_ratio: MassRatio,
) -> Result<Option<MeasuredEdge>, Error> {
    let star = FixedPointSpeed::new(n);
    let end = (n + 1) as f64 * PI - star.value();
    // A grounded hopper is below the fixed point, too.
    let height = |delta: f64| -> Result<f64, Error> {
        let image = map(star.value() + delta, mass_ratio)?;
        Ok(image.map_or(-star.value(), |image| star.offset_of(image)))
    };
    let mut above = FIRST;
    loop {
        let next = (RATIO * above).min(end);
        if height(next)? < 0.0 {
            let (mut left, mut right) = (above, next);
            loop {
                let middle = 0.5 * (left + right);
                let alpha = star.value() + middle;
                if alpha <= star.value() + left || alpha >= star.value() + right {
                    break;
                }
                if height(middle)? < 0.0 { right = middle } else { left = middle }
            }
            let alpha = star.value() + right;
            let delta = star.offset_of(alpha);
            let step = SLOPE_STEP * delta;
            let slope = (height(delta + step)? - height(delta - step)?) / (2.0 * step);
            return Ok(Some(MeasuredEdge { delta, slope, alpha }));
        }
        if next >= end {
            return Ok(None);
        }
        above = next;
    }
}
