//! The contact part of a hump, (α*_n, (n+1)π), in the time of flight.
//!
//! There α'² = α² − μ Γ² and α' dα'/dα = α (1 − 4μ W), with W = sin h (sin h − h cos h), h half the
//! time of flight, rising from 0 at α*_n to its only maximum at h = ½ α*_{2n+1} and falling to 0 at
//! (n+1)π (theory: e.2). For n ≥ 1 the coordinate is t = τ − 2α*_n, in which nothing cancels; for
//! n = 0 it is τ itself.

use crate::Error;
use hybrid_system::bracketed_root;
use passive_hopper::{DoubleDouble, HalfFlight, LARGEST_LIFT_OFF_SPEED, LocalFlight, alpha_star};
use std::f64::consts::PI;

/// The last hump below the largest lift-off speed.
pub(crate) const LARGEST: u64 = (LARGEST_LIFT_OFF_SPEED / PI) as u64 - 1;

/// One hump of the map, whatever the mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hump {
    pub(crate) n: u64,
    pub(crate) star: DoubleDouble,
    flight: LocalFlight,
    /// t at which W is largest.
    steepest: f64,
    /// t at the end of the hump, where h = α = (n+1)π.
    end: f64,
}

/// Where μ makes the minimum of the map touch a target.
pub(crate) struct Touch {
    pub(crate) mu: f64,
    pub(crate) alpha: f64,
}

impl Hump {
    /// Hump n, for α up to the largest lift-off speed.
    pub(crate) fn new(n: u64) -> Result<Self, Error> {
        if n > LARGEST {
            return Err(Error::Index { n, smallest: 0, largest: LARGEST });
        }
        let star = alpha_star(n);
        // Twice the offset of half of it: the difference is formed from 100 bits.
        let steepest = 2.0 * star.offset_of(0.5 * alpha_star(2 * n + 1).high);
        let end = 2.0 * star.offset_of((n + 1) as f64 * PI);
        Ok(Hump { n, star, flight: LocalFlight::new(n), steepest, end })
    }

    pub(crate) fn w(&self, t: f64) -> f64 {
        if self.n == 0 { HalfFlight::at(0.5 * t).w() } else { self.flight.w(t) }
    }

    /// α − α*_n.
    pub(crate) fn delta(&self, t: f64) -> f64 {
        if self.n == 0 { HalfFlight::at(0.5 * t).start_speed(0.0) } else { self.flight.delta(t) }
    }

    fn closing_speed(&self, t: f64) -> f64 {
        if self.n == 0 {
            HalfFlight::at(0.5 * t).closing_speed(0.0)
        } else {
            self.flight.closing_speed(t)
        }
    }

    /// α² − α*_n², or α² if the target is zero.
    fn squares(&self, t: f64, target_is_zero: bool) -> f64 {
        let delta = self.delta(t);
        let alpha = self.star.high + delta;
        if target_is_zero { alpha * alpha } else { delta * (alpha + self.star.high) }
    }

    /// The two critical points, maximum and minimum of the map, in t; nothing if it is monotone.
    pub(crate) fn critical(&self, mu: f64) -> Result<Option<(f64, f64)>, Error> {
        let slope = |t: f64| 4.0 * mu * self.w(t) - 1.0;
        if slope(self.steepest) <= 0.0 {
            return Ok(None);
        }
        // At α*_0 = 0 the functions have no value; W ≈ h⁴/3 is far below 1/(4μ) ≥ 1 at h = ½.
        let left = if self.n == 0 { 1.0 } else { 0.0 };
        let maximum = self.root(slope, left, self.steepest)?;
        let minimum = self.root(slope, self.steepest, self.end)?;
        Ok(Some((maximum, minimum)))
    }

    /// The place t at which α' first falls to α*_n (to 0 for n = 0); nothing if it does not on this
    /// part. It lies between the critical points, where the map falls.
    pub(crate) fn first_fall(&self, mu: f64) -> Result<Option<f64>, Error> {
        let above = |t: f64| {
            let closing = self.closing_speed(t);
            self.squares(t, false) - mu * closing * closing
        };
        let Some((maximum, minimum)) = self.critical(mu)? else { return Ok(None) };
        if above(minimum) >= 0.0 {
            return Ok(None);
        }
        self.root(above, maximum, minimum).map(Some)
    }

    /// The minimum of the map touches α*_n, or zero: there α'² = target² and dα'/dα = 0, so that
    /// Γ² = 4 W (α² − target²).
    pub(crate) fn touch(&self, target_is_zero: bool) -> Result<Touch, Error> {
        let condition = |t: f64| {
            let closing = self.closing_speed(t);
            closing * closing - 4.0 * self.w(t) * self.squares(t, target_is_zero)
        };
        let t = self.root(condition, self.steepest, self.end)?;
        Ok(Touch { mu: 0.25 / self.w(t), alpha: self.star.high + self.delta(t) })
    }

    fn root(&self, f: impl FnMut(f64) -> f64, left: f64, right: f64) -> Result<f64, Error> {
        bracketed_root(f, left, right).map_err(|source| Error::Root { n: self.n, source })
    }
}
