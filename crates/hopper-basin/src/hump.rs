//! The contact part of a hump, (α*_n, (n+1)π), in the half time of flight h.
//!
//! There α'² = A(h)² − μ Γ(h)² and α' dα'/dα = α (1 − 4μ W(h)), with W = sin h (sin h − h cos h)
//! rising from 0 at α*_n to its only maximum at h = ½ α*_{2n+1} and falling to 0 at (n+1)π:
//! dW/dh = sin 2h − 2h cos 2h up to sign, and tan 2h = 2h has one root inside (theory: e.2).

use crate::Error;
use hybrid_system::bracketed_root;
use passive_hopper::{DoubleDouble, HalfFlight, alpha_star};
use std::f64::consts::PI;

/// One hump of the map, whatever the mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hump {
    pub(crate) n: u64,
    pub(crate) star: DoubleDouble,
    /// h at which W is largest.
    steepest: f64,
    /// (n+1)π, where h and α end.
    end: f64,
}

impl Hump {
    pub(crate) fn new(n: u64) -> Self {
        let steepest = 0.5 * alpha_star(2 * n + 1).high;
        Hump { n, star: alpha_star(n), steepest, end: (n + 1) as f64 * PI }
    }

    /// α'² − target² at h, with α − α*_n taken without cancellation.
    fn above(&self, h: f64, mu: f64, target: f64) -> f64 {
        let half = HalfFlight::at(h);
        let offset = self.offset(&half);
        let closing = half.closing_speed(0.0);
        let alpha = self.star.high + offset;
        let squares = if target == 0.0 { alpha * alpha } else { offset * (alpha + self.star.high) };
        squares - mu * closing * closing
    }

    /// A(h) − α*_n.
    fn offset(&self, half: &HalfFlight) -> f64 {
        self.star.offset_of(half.h) + half.speed_beyond_h(0.0)
    }

    /// The two critical points, maximum and minimum of the map, in h; nothing if it is monotone.
    pub(crate) fn critical(&self, mu: f64) -> Result<Option<(f64, f64)>, Error> {
        let slope = |h: f64| 4.0 * mu * HalfFlight::at(h).w() - 1.0;
        if slope(self.steepest) <= 0.0 {
            return Ok(None);
        }
        // At α*_0 = 0 the functions have no value; W ≈ h⁴/3 is far below 1/(4μ) ≥ 1 at a half.
        let left = if self.n == 0 { 0.5 } else { self.star.high };
        let maximum = self.root(slope, left, self.steepest)?;
        let minimum = self.root(slope, self.steepest, self.end)?;
        Ok(Some((maximum, minimum)))
    }

    /// The α at a given h.
    pub(crate) fn alpha(&self, h: f64) -> f64 {
        HalfFlight::at(h).start_speed(0.0)
    }

    /// The offset α − α*_n at which α' first falls to α*_n (to 0 for n = 0); nothing if it does
    /// not on this part. It lies between the critical points, where the map falls.
    pub(crate) fn first_fall(&self, mu: f64) -> Result<Option<f64>, Error> {
        let target = self.star.high;
        let Some((maximum, minimum)) = self.critical(mu)? else { return Ok(None) };
        if self.above(minimum, mu, target) >= 0.0 {
            return Ok(None);
        }
        let h = self.root(|h| self.above(h, mu, target), maximum, minimum)?;
        Ok(Some(self.offset(&HalfFlight::at(h))))
    }

    /// (μ, α) at which the minimum of the map touches α*_n, or zero: there
    /// α'² = target² and dα'/dα = 0, so that Γ² = 4 W (A² − target²).
    pub(crate) fn touch(&self, target_is_zero: bool) -> Result<(f64, f64), Error> {
        let condition = |h: f64| {
            let half = HalfFlight::at(h);
            let closing = half.closing_speed(0.0);
            let alpha = half.start_speed(0.0);
            let squares = if target_is_zero {
                alpha * alpha
            } else {
                self.offset(&half) * (alpha + self.star.high)
            };
            closing * closing - 4.0 * half.w() * squares
        };
        let h = self.root(condition, self.steepest, self.end)?;
        let half = HalfFlight::at(h);
        Ok((0.25 / half.w(), half.start_speed(0.0)))
    }

    fn root(&self, f: impl FnMut(f64) -> f64, left: f64, right: f64) -> Result<f64, Error> {
        bracketed_root(f, left, right).map_err(|source| Error::Root { n: self.n, source })
    }
}
