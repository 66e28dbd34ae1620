//! The mass parameter at which the minimum of the map on a contact part touches α*_n or zero, enclosed.
//!
//! On the contact part of hump n the first landing is the only one. With the time of flight τ, L = τ − sin τ and B
//! = τ²/2 − 1 + cos τ,
//!
//! ```text
//!   α = B/L      Γ = L − α (1 − cos τ)      α′² − c² = α² − c² − μ Γ²      dα/dτ = Γ/L      dΓ/dτ = (1 − Γ/L)(1 − cos τ) − α sin τ
//! ```
//!
//! The minimum touches c at the least value of q = (α² − c²)/Γ². q falls up to it and rises from there
//! (docs/theory.md, Theorem 29).

use crate::error::Error;
use crate::evidence::enclosed::Enclosed;
use crate::model::fixed_points::fixed_point_in;
use crate::precision::ball::Ball;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;

/// A touch of the map's minimum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedTouch {
    /// μ = M/(1+M)².
    pub mu: Enclosed,
    /// The mass ratio M ≤ 1.
    pub mass_ratio: Enclosed,
    /// The lift-off speed of the minimum.
    pub alpha: Enclosed,
}

/// The touch of α*_n, or of zero if `of_ground`, whose flight lasts about `time`.
///
/// # Errors
/// [`Error::NoTouch`] if there is no such touch within a tenth of the time.
pub fn enclosed_touch(n: u64, of_ground: bool, time: f64) -> Result<EnclosedTouch, Error> {
    let sharp = |touch: &EnclosedTouch| touch.mu.is_sharp() && touch.mass_ratio.is_sharp();
    let found = enclose::<DoubleDouble>(n, of_ground, time).filter(sharp);
    found.or_else(|| enclose::<Long<4>>(n, of_ground, time)).ok_or(Error::NoTouch { n, time })
}

/// The part of the time in which the touch is searched.
const WIDEST: f64 = 0.1;

fn enclose<R: Extended>(n: u64, of_ground: bool, time: f64) -> Option<EnclosedTouch> {
    let star = fixed_point_in::<R>(if of_ground { 0 } else { n });
    let target = Ball { middle: star, radius: R::EPSILON * star.nearest() };
    let falls = |t: R| Flight::lasting(Ball { middle: t, radius: 0.0 }, target).falling();
    let middle = R::from(time);
    let mut reach = f64::EPSILON * time;
    while !(falls(middle + -reach).is_positive() && falls(middle + reach).is_negative()) {
        reach *= 4.0;
        if !(reach < WIDEST * time) {
            return None;
        }
    }
    let (mut left, mut right) = (middle + -reach, middle + reach);
    loop {
        let between = (left + right) * 0.5;
        let sign = falls(between);
        if sign.is_positive() {
            left = between;
        } else if sign.is_negative() {
            right = between;
        } else {
            break;
        }
    }
    // Both ends have certain signs, and the balls of the formula no longer tell more.
    let width = (right - left).nearest();
    let whole = Ball { middle: (left + right) * 0.5, radius: width };
    let flight = Flight::lasting(whole, target);
    let mu = flight.quotient;
    let four_mu = Ball::exact(1.0) - mu * 4.0;
    // The smaller root of μM² − (1 − 2μ)M + μ = 0, as the product of both over the larger one.
    let mass_ratio = mu * 2.0 / (Ball::exact(1.0) - mu * 2.0 + four_mu.sqrt());
    Some(EnclosedTouch {
        mu: Enclosed::of(mu),
        mass_ratio: Enclosed::of(mass_ratio),
        alpha: Enclosed::of(flight.alpha),
    })
}

/// A first flight on a contact part.
struct Flight<R> {
    alpha: Ball<R>,
    closing: Ball<R>,
    /// dα/dτ and dΓ/dτ.
    slopes: (Ball<R>, Ball<R>),
    /// α² − c².
    squares: Ball<R>,
    /// q.
    quotient: Ball<R>,
}

impl<R: Extended> Flight<R> {
    fn lasting(time: Ball<R>, target: Ball<R>) -> Self {
        let (sin, cos) = time.sin_cos();
        let (lag, bend) = time.sine_remainders(sin, cos);
        let half_sine = (time * 0.5).sin_cos().0;
        let rise = half_sine.squared() * 2.0;
        let alpha = bend / lag;
        let closing = lag - alpha * rise;
        let squares = (alpha - target) * (alpha + target);
        let faster = closing / lag;
        let slopes = (faster, rise - faster * rise - alpha * sin);
        Flight { alpha, closing, slopes, squares, quotient: squares / closing.squared() }
    }

    /// −½ Γ³ dq/dτ: positive where q falls.
    fn falling(&self) -> Ball<R> {
        self.squares * self.slopes.1 - self.alpha * self.slopes.0 * self.closing
    }
}
