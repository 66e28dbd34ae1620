//! The contact part of a hump, (α*_n, (n+1)π), in the time of flight.
//!
//! There α'² = α² − μ Γ² and α' dα'/dα = α (1 − 4μ W), with W = sin h (sin h − h cos h), h half the
//! time of flight, rising from 0 at α*_n to its only maximum at h = ½ α*_{2n+1} and falling to 0 at
//! (n+1)π (theory: e.2). For n ≥ 1 the coordinate is t = τ − 2α*_n, in which nothing cancels; for
//! n = 0 it is τ itself.

use crate::Error;
use hybrid_system::bracketed_root;
use passive_hopper::{
    FixedPointSpeed, HalfFlight, LARGEST_LIFT_OFF_SPEED, LocalFlight, alpha_star,
};
use std::f64::consts::PI;
use std::sync::OnceLock;

/// The last hump below the largest lift-off speed.
pub(crate) const LARGEST: u64 = (LARGEST_LIFT_OFF_SPEED / PI) as u64 - 1;

/// Steps of Newton's method before a bracketed search takes over.
const NEWTON_STEPS: usize = 12;

/// One hump of the map, whatever the mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hump {
    pub(crate) n: u64,
    pub(crate) star: FixedPointSpeed,
    flight: LocalFlight,
    /// t at which W is largest.
    steepest: f64,
    /// t at the end of the hump, where h = α = (n+1)π.
    end: f64,
}

/// Where μ makes the minimum of the map touch a target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    pub(crate) mu: f64,
    t: f64,
    pub(crate) alpha: f64,
}

impl Hump {
    /// Hump n, for α up to the largest lift-off speed.
    pub(crate) fn new(n: u64) -> Result<Self, Error> {
        if n > LARGEST {
            return Err(Error::Index { n, smallest: 0, largest: LARGEST });
        }
        let star = FixedPointSpeed::new(n);
        // Twice the offset of half of it: the difference is formed from 100 bits.
        let steepest = 2.0 * star.offset_of(0.5 * alpha_star(2 * n + 1));
        let end = 2.0 * star.offset_of((n + 1) as f64 * PI);
        Ok(Hump { n, star, flight: LocalFlight::new(n), steepest, end })
    }

    pub(crate) fn w(&self, t: f64) -> f64 {
        if self.n == 0 { HalfFlight::at(0.5 * t).w() } else { self.flight.w(t) }
    }

    /// The largest value of W.
    pub(crate) fn largest_w(&self) -> f64 {
        self.w(self.steepest)
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
        let alpha = self.star.value() + delta;
        if target_is_zero { alpha * alpha } else { delta * (alpha + self.star.value()) }
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
    /// part.
    ///
    /// There μ Γ² = α² − α*_n². On the rising side of the hump f > α*_n, on the falling side there is one such
    /// place if μ exceeds μ_c of the crisis, and the larger μ, the smaller t: it lies left of the touch at μ_c.
    pub(crate) fn first_fall(&self, mu: f64) -> Result<Option<f64>, Error> {
        let touch = self.fall_touch()?;
        if mu <= touch.mu {
            return Ok(None);
        }
        let above = |t: f64| {
            let closing = self.closing_speed(t);
            self.squares(t, false) - mu * closing * closing
        };
        if above(touch.t) >= 0.0 {
            return Ok(None); // μ is μ_c but for rounding
        }
        let start = touch.t * (1.0 - (1.0 - touch.mu / mu).sqrt());
        if let Some(t) = self.newton(mu, start, above, touch.t) {
            return Ok(Some(t));
        }
        let mut left = 0.5 * touch.t;
        while above(left) <= 0.0 {
            left *= 0.5; // ends: α² − α*_n² ∝ t³ (t² for n = 0) outweighs Γ² ∝ t⁴ (t⁶)
        }
        self.root(above, left, touch.t).map(Some)
    }

    /// The ends of the falling part of the hump as speeds, to some ulps; nothing if it rises throughout.
    ///
    /// There 4μW = 1, with W' = SC − h cos 2h and W″ = 2h sin 2h, about −2h at the maximum.
    pub(crate) fn falling(&self, mu: f64) -> Result<Option<(f64, f64)>, Error> {
        let middle = self.star.value() + 0.5 * self.steepest;
        let level = 0.25 / mu;
        let rest = self.largest_w() - level;
        if rest <= 0.0 {
            return Ok(None);
        }
        let reach = (rest / middle).sqrt();
        let end = |sign: f64| {
            let mut h = middle + sign * reach;
            for _ in 0..NEWTON_STEPS {
                let half = HalfFlight::at(h);
                let slope = half.sin() * half.cos() - h * (1.0 - 2.0 * half.sin() * half.sin());
                let step = (half.w() - level) / slope;
                h -= step;
                let inside = h > self.star.value() && sign * (h - middle) > 0.0;
                if !inside || step.abs() < 4.0 * f64::EPSILON * h {
                    return inside.then(|| HalfFlight::at(h).start_speed(0.0));
                }
            }
            None
        };
        if let (Some(top), Some(foot)) = (end(-1.0), end(1.0)) {
            return Ok(Some((top, foot)));
        }
        let place = |t: f64| self.star.value() + self.delta(t);
        Ok(self.critical(mu)?.map(|(top, foot)| (place(top), place(foot))))
    }

    /// The touch of α*_n by the minimum (of zero for n = 0); computed once for the first humps.
    fn fall_touch(&self) -> Result<Touch, Error> {
        static FIRST: [OnceLock<Touch>; 64] = [const { OnceLock::new() }; 64];
        let slot = usize::try_from(self.n).ok().and_then(|n| FIRST.get(n));
        if let Some(&touch) = slot.and_then(OnceLock::get) {
            return Ok(touch);
        }
        let touch = self.touch(self.n == 0)?;
        Ok(slot.map_or(touch, |slot| *slot.get_or_init(|| touch)))
    }

    /// The first fall by Newton's method on `above`, with d(α'²)/dt = 2α (1 − 4μW) Γ/(2D), from a parabola through 0 and the
    /// touch; nothing if it leaves (0, `right`), or where it falls no more.
    fn newton(&self, mu: f64, start: f64, above: impl Fn(f64) -> f64, right: f64) -> Option<f64> {
        let mut t = self.plain_newton(mu, start)?;
        for _ in 0..NEWTON_STEPS {
            let h = self.star.value() + 0.5 * t;
            let half = HalfFlight::at(h);
            let alpha = self.star.value() + self.delta(t);
            let slope = alpha * (1.0 - 4.0 * mu * self.w(t)) * self.closing_speed(t) / half.d();
            let step = above(t) / slope;
            t -= step;
            if !(slope < 0.0 && t > 0.0 && t < right) {
                return None;
            }
            if step.abs() <= 4.0 * f64::EPSILON * t {
                return Some(t);
            }
        }
        None
    }

    /// The same to some digits, from one sine and cosine a step: α − α*_n need not be exact.
    fn plain_newton(&self, mu: f64, start: f64) -> Option<f64> {
        let square = self.star.value() * self.star.value();
        let mut h = self.star.value() + 0.5 * start;
        for _ in 0..NEWTON_STEPS {
            let half = HalfFlight::at(h);
            let (alpha, closing) = (half.start_speed(0.0), half.closing_speed(0.0));
            let above = alpha * alpha - square - mu * closing * closing;
            let slope = 2.0 * alpha * (1.0 - 4.0 * mu * half.w()) * closing / half.d();
            let step = above / slope;
            h -= step;
            if !(slope < 0.0 && h > self.star.value()) {
                return None;
            }
            if step.abs() < 1e-6 * (h - self.star.value()) {
                break;
            }
        }
        Some(2.0 * (h - self.star.value()))
    }

    /// The minimum of the map touches α*_n, or zero: there α'² = target² and dα'/dα = 0, so that
    /// Γ² = 4 W (α² − target²).
    pub(crate) fn touch(&self, target_is_zero: bool) -> Result<Touch, Error> {
        let condition = |t: f64| {
            let closing = self.closing_speed(t);
            closing * closing - 4.0 * self.w(t) * self.squares(t, target_is_zero)
        };
        let t = self.root(condition, self.steepest, self.end)?;
        Ok(Touch { mu: 0.25 / self.w(t), t, alpha: self.star.value() + self.delta(t) })
    }

    fn root(&self, f: impl FnMut(f64) -> f64, left: f64, right: f64) -> Result<f64, Error> {
        bracketed_root(f, left, right).map_err(|source| Error::Root { n: self.n, source })
    }
}
