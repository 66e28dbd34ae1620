//! The functions of the time of flight τ that occur in a landing.
//!
//! ```text
//!   r = 1 − cos τ ≥ 0     p = τ − sin τ ≥ 0     q = τ²/2 − 1 + cos τ ≥ 0       for τ ≥ 0
//!
//!   a flight from the stretch x and the velocity V:   G(τ) = x r + V p − q     (docs/theory.md, Lemma 91)
//! ```
//!
//! p and q rise with τ, since p′ = r and q′ = p.

use interval_arithmetic::Enclosure;

/// Below this time p and q are computed from their series, because τ and sin τ cancel.
const SERIES_BELOW: f64 = 1.0;

/// The quotients of neighbouring terms of p/(τ³/6) and of q/(τ⁴/24), without τ²: (2k)(2k+1) and (2k+1)(2k+2). The first term that is
/// left out is below 10⁻¹⁸ of the sum for τ ≤ 1.
const OF_P: [f64; 8] = [20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0, 342.0];
const OF_Q: [f64; 8] = [30.0, 56.0, 90.0, 132.0, 182.0, 240.0, 306.0, 380.0];

/// 1 − t/c₁ (1 − t/c₂ (1 − … )) for 0 ≤ t ≤ 1. The terms alternate and fall, so the innermost bracket lies between 0 and 1.
fn alternating(t: Enclosure, quotients: &[f64]) -> Enclosure {
    quotients
        .iter()
        .rev()
        .fold(Enclosure::new(0.0, 1.0), |inner, &quotient| Enclosure::ONE - t * inner / quotient)
}

fn p_at(time: f64) -> Enclosure {
    let t = Enclosure::new(time, time);
    if time < SERIES_BELOW {
        let square = t.squared();
        return square * t / 6.0 * alternating(square, &OF_P);
    }
    t - t.sin()
}

fn q_at(time: f64) -> Enclosure {
    let t = Enclosure::new(time, time);
    let square = t.squared();
    if time < SERIES_BELOW {
        return square.squared() / 24.0 * alternating(square, &OF_Q);
    }
    square * 0.5 - Enclosure::ONE + t.cos()
}

/// Enclosures over an interval of times τ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TimeFunctions {
    /// sin τ.
    pub(crate) sin: Enclosure,
    /// cos τ.
    pub(crate) cos: Enclosure,
    /// 1 − cos τ.
    pub(crate) r: Enclosure,
    /// τ − sin τ.
    pub(crate) p: Enclosure,
    /// τ²/2 − 1 + cos τ.
    pub(crate) q: Enclosure,
}

impl TimeFunctions {
    /// Over the times of an interval.
    pub(crate) fn over(time: Enclosure) -> Self {
        let (p, q) = if time.low == time.high {
            (p_at(time.low), q_at(time.low))
        } else {
            let between = |f: fn(f64) -> Enclosure| {
                Enclosure::new(f(time.low).low.max(0.0), f(time.high).high)
            };
            (between(p_at), between(q_at))
        };
        // 1 − cos τ = 2 sin² ½τ keeps its digits for small τ.
        let r = 2.0 * (0.5 * time).sin().squared();
        TimeFunctions { sin: time.sin(), cos: time.cos(), r, p, q }
    }

    /// At one time.
    pub(crate) fn at(time: f64) -> Self {
        TimeFunctions::over(Enclosure::new(time, time))
    }

    /// G = x r + V p − q: the height of the lower mass, times 1 + M.
    pub(crate) fn height(&self, x: Enclosure, v: Enclosure) -> Enclosure {
        x * self.r + v * self.p - self.q
    }
}
