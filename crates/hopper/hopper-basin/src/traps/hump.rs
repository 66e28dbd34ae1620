//! The contact part of hump n: the speeds in (α*_n, (n+1)π), whose first landing is followed by contact.
//!
//! With h half the time of flight τ, and D = h − sin h cos h,
//!
//! ```text
//!   α′² = α² − μ Γ²      dα/dh = Γ/D      α′ dα′/dα = α (1 − 4μ W)      W = sin h (sin h − h cos h)
//!
//!   W:   0 at h = α*_n   ↗   its only maximum at h = ½ α*_{2n+1}   ↘   0 at h = (n+1)π
//! ```
//!
//! So the map rises, falls and rises again if μ > 1/(4 max W), and only rises otherwise.
//!
//! The coordinate on hump n ≥ 1 is t = τ − 2α*_n = 2(h − α*_n), because α − α*_n and Γ can be computed
//! from t without cancellation. On hump 0 it is t = τ, since α*_0 = 0.
//!
//! Proofs: docs/theory.md, Lemma 26, Lemma 27, Theorem 29 and Theorem 31.

use crate::error::Error;
use interval_arithmetic::bracketed_root;
use passive_hopper::{
    FixedPointSpeed, HalfFlight, LARGEST_LIFT_OFF_SPEED, LocalFlight, alpha_star,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// The index of the last hump that lies below the largest lift-off speed.
pub(crate) const LARGEST_HUMP: u64 = (LARGEST_LIFT_OFF_SPEED / PI) as u64 - 1;

/// Steps of Newton's method before the search in brackets is used instead.
///
/// The starts below have a digit or more, so that some five steps suffice. Next to a double root (μ just above
/// μ_c or 1/(4 max W)) convergence is slow: there the search takes over, which is slower and always succeeds.
const NEWTON_STEPS: usize = 12;

/// The number of humps whose touch is stored after its first computation; as many as the traps that
/// [`Fates`](crate::Fates) stores. Other touches are computed at each use.
const KEPT_TOUCHES: usize = 64;

/// The quantities of hump n that do not depend on the mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hump {
    pub(crate) n: u64,
    pub(crate) star: FixedPointSpeed,
    flight: LocalFlight,
    /// The t at which W is largest: there the map falls most steeply.
    steepest: f64,
    /// The t at the end of the contact part, where h = α = (n+1)π.
    end: f64,
}

/// The value that the minimum of the map is to touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    /// α*_n.
    FixedPoint,
    /// α′ = 0, below which the hopper is grounded.
    Ground,
}

/// The mass parameter and the place at which the minimum of the map touches a target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HumpTouch {
    pub(crate) mu: f64,
    t: f64,
}

/// arctan(1/α), the angle by which α*_n lies below (n+½)π.
fn inverse_tangent_of_inverse(alpha: f64) -> f64 {
    pxfm::f_atan(1.0 / alpha)
}

/// (n+1)π − α*_n = ½π + arctan(1/α*_n), the length of the contact part of hump n, to an ulp (docs/theory.md, Lemma 76).
pub(crate) fn contact_length(n: u64) -> f64 {
    FRAC_PI_2 + inverse_tangent_of_inverse(alpha_star(n))
}

/// α*_{n+1} − α*_n = π + arctan(1/α*_n) − arctan(1/α*_{n+1}), to an ulp (docs/theory.md, Lemma 76).
pub(crate) fn distance_to_next(n: u64) -> f64 {
    let [angle, next] = [n, n + 1].map(|n| inverse_tangent_of_inverse(alpha_star(n)));
    PI + (angle - next)
}

impl Hump {
    /// Hump n, if it lies below the largest lift-off speed.
    pub(crate) fn new(n: u64) -> Result<Self, Error> {
        if n > LARGEST_HUMP {
            return Err(Error::Index { n, smallest: 0, largest: LARGEST_HUMP });
        }
        let star = FixedPointSpeed::new(n);
        // t = 2(h − α*_n) at h = ½α*_{2n+1} and at h = (n+1)π, from α*_n = (n+½)π − arctan(1/α*_n) (docs/theory.md,
        // Lemma 6): no difference of large numbers remains.
        let angle = inverse_tangent_of_inverse(star.value());
        let double = inverse_tangent_of_inverse(alpha_star(2 * n + 1));
        let steepest = (FRAC_PI_2 + 2.0 * angle) - double;
        Ok(Hump { n, star, flight: LocalFlight::new(n), steepest, end: 2.0 * contact_length(n) })
    }

    /// W at t.
    pub(crate) fn w(&self, t: f64) -> f64 {
        if self.n == 0 { HalfFlight::at(0.5 * t).w() } else { self.flight.w(t) }
    }

    /// The largest value of W on the hump.
    pub(crate) fn largest_w(&self) -> f64 {
        self.w(self.steepest)
    }

    /// α − α*_n at t.
    pub(crate) fn delta(&self, t: f64) -> f64 {
        if self.n == 0 { HalfFlight::at(0.5 * t).start_speed(0.0) } else { self.flight.delta(t) }
    }

    /// Γ at t.
    fn closing_speed(&self, t: f64) -> f64 {
        if self.n == 0 {
            HalfFlight::at(0.5 * t).closing_speed(0.0)
        } else {
            self.flight.closing_speed(t)
        }
    }

    /// α² − α*_n², or α² if the target is the ground.
    fn squares(&self, t: f64, target: Target) -> f64 {
        let delta = self.delta(t);
        let alpha = self.star.value() + delta;
        match target {
            // As a product: the difference of the squares would cancel next to α*_n.
            Target::FixedPoint => delta * (alpha + self.star.value()),
            Target::Ground => alpha * alpha,
        }
    }

    /// The maximum and the minimum of the map, in t; `None` if the map only rises.
    pub(crate) fn critical(&self, mu: f64) -> Result<Option<(f64, f64)>, Error> {
        let slope = |t: f64| 4.0 * mu * self.w(t) - 1.0;
        if slope(self.steepest) <= 0.0 {
            return Ok(None);
        }
        // At t = 0 of hump 0 the functions of the half flight divide by zero. The maximum has W = 1/(4μ) ≥ 1,
        // and W ≈ h⁴/3 is far smaller at h = ½: the bracket may start there.
        let left = if self.n == 0 { 1.0 } else { 0.0 };
        let maximum = self.root(slope, left, self.steepest)?;
        let minimum = self.root(slope, self.steepest, self.end)?;
        Ok(Some((maximum, minimum)))
    }

    /// The smallest t > 0 at which α′ = α*_n; `None` if the map stays above α*_n on the contact part.
    ///
    /// There μ Γ² = α² − α*_n². The function (α² − α*_n²)/Γ² falls from ∞ at t = 0 to its minimum μ_c at the touch.
    /// Such a t therefore exists if μ > μ_c. Only one of them lies left of the touch; it moves to the left as μ grows.
    pub(crate) fn first_fall(&self, mu: f64) -> Result<Option<f64>, Error> {
        let touch = self.touch_of_fixed_point()?;
        if mu <= touch.mu {
            return Ok(None);
        }
        let above = |t: f64| {
            let closing = self.closing_speed(t);
            self.squares(t, Target::FixedPoint) - mu * closing * closing
        };
        // μ exceeds μ_c by rounding errors only, and the computed function has no change of sign.
        if above(touch.t) >= 0.0 {
            return Ok(None);
        }
        // The start replaces μ_c Γ²/(α² − α*_n²) by the parabola 1 − (1 − t/t_c)², which is 0 at t = 0 and has its
        // maximum 1 at the touch t_c.
        let start = touch.t * (1.0 - (1.0 - touch.mu / mu).sqrt());
        if let Some(t) = self.newton(mu, start, above, touch.t) {
            return Ok(Some(t));
        }
        // A left end for the bracket. The loop ends: as t → 0, α² − α*_n² ∝ t³ (t² for n = 0) exceeds
        // μΓ² ∝ t⁴ (t⁶ for n = 0).
        let mut left = 0.5 * touch.t;
        while above(left) <= 0.0 {
            left *= 0.5;
        }
        self.root(above, left, touch.t).map(Some)
    }

    /// The speeds between which the map falls: its maximum and its minimum. `None` if the map only rises.
    ///
    /// Both solve 4μW = 1. The start replaces W by its parabola at the maximum, where W″ = 2h sin 2h ≈ −2h; Newton's
    /// method uses W′ = sin h cos h − h cos 2h. This is faster than [`critical`](Self::critical), and right to some
    /// ulps unless the two speeds nearly coincide.
    pub(crate) fn falling(&self, mu: f64) -> Result<Option<(f64, f64)>, Error> {
        let middle = self.star.value() + 0.5 * self.steepest;
        let level = 0.25 / mu; // 4μW = 1
        let rest = self.largest_w() - level;
        if rest <= 0.0 {
            return Ok(None);
        }
        let half_width = (rest / middle).sqrt();
        let end = |sign: f64| {
            let mut h = middle + sign * half_width;
            for _ in 0..NEWTON_STEPS {
                let half = HalfFlight::at(h);
                let slope = half.sin() * half.cos() - h * (1.0 - 2.0 * half.sin() * half.sin());
                let step = (half.w() - level) / slope;
                h -= step;
                // A step across the maximum of W would lead to the other root. A step below α*_n would lead to another
                // hump.
                let inside = h > self.star.value() && sign * (h - middle) > 0.0;
                if !inside || step.abs() < 4.0 * f64::EPSILON * h {
                    return inside.then(|| HalfFlight::at(h).start_speed(0.0));
                }
            }
            None
        };
        if let (Some(maximum), Some(minimum)) = (end(-1.0), end(1.0)) {
            return Ok(Some((maximum, minimum)));
        }
        // Newton's method failed, mostly because the two roots nearly coincide. The search in brackets is slower, but
        // always succeeds.
        let speed = |t: f64| self.star.value() + self.delta(t);
        Ok(self.critical(mu)?.map(|(maximum, minimum)| (speed(maximum), speed(minimum))))
    }

    /// The touch of α*_n. For the first humps it is computed once and stored, because every trap needs it.
    pub(crate) fn touch_of_fixed_point(&self) -> Result<HumpTouch, Error> {
        static FIRST: [OnceLock<HumpTouch>; KEPT_TOUCHES] =
            [const { OnceLock::new() }; KEPT_TOUCHES];
        let slot = usize::try_from(self.n).ok().and_then(|n| FIRST.get(n));
        if let Some(&touch) = slot.and_then(OnceLock::get) {
            return Ok(touch);
        }
        let touch = self.touch(Target::FixedPoint)?;
        Ok(slot.map_or(touch, |slot| *slot.get_or_init(|| touch)))
    }

    /// [`first_fall`](Self::first_fall) by Newton's method on `above`, whose derivative is
    /// d(α′²)/dt = ½ · 2α (1 − 4μW) · dα/dh = α (1 − 4μW) Γ/D.
    ///
    /// `None` if an iterate leaves (0, `right`), or reaches a place where the map rises: Newton's method would then
    /// lead to another root. Also `None` if it has not converged after [`NEWTON_STEPS`].
    fn newton(&self, mu: f64, start: f64, above: impl Fn(f64) -> f64, right: f64) -> Option<f64> {
        // First t to some digits, from functions of h; then t to all digits, from functions of t.
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

    /// t to six digits. Here α² − α*_n² may cancel; in return a step needs only one sine and one cosine.
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
            // The next step, which would double the six digits, uses the functions of t. Next to α*_n cancellation may
            // prevent six digits. The loop then takes all its steps, which costs time but no accuracy.
            if step.abs() < 1e-6 * (h - self.star.value()) {
                break;
            }
        }
        Some(2.0 * (h - self.star.value()))
    }

    /// The μ at which the minimum of the map equals `target`, and the place of this minimum.
    ///
    /// At the minimum 4μW = 1. The target gives μΓ² = α² − target². Eliminating μ leaves
    /// Γ² = 4W (α² − target²), which has one root between the maximum of W and the end of the hump.
    pub(crate) fn touch(&self, target: Target) -> Result<HumpTouch, Error> {
        let condition = |t: f64| {
            let closing = self.closing_speed(t);
            closing * closing - 4.0 * self.w(t) * self.squares(t, target)
        };
        let t = self.root(condition, self.steepest, self.end)?;
        Ok(HumpTouch { mu: 0.25 / self.w(t), t })
    }

    /// The time of the first flight at a touch.
    pub(crate) fn time_of(&self, touch: HumpTouch) -> f64 {
        2.0 * self.star.value() + touch.t
    }

    fn root(&self, f: impl FnMut(f64) -> f64, left: f64, right: f64) -> Result<f64, Error> {
        bracketed_root(f, left, right).map_err(|source| Error::RootSearch { n: self.n, source })
    }
}
