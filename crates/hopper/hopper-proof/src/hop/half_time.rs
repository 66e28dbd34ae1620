//! The functions of half the time of flight, enclosed at one time.
//!
//! ```text
//!   S = sin h    C = cos h    D = h − S C > 0    u = h C − S
//!
//!   V_x(h) = h + (S u − x S²)/D        the start speed of the flight that lasts 2h from the stretch x
//! ```
//!
//! The height after 2h of the flight with the start speed V is 2D (V − V_x(h)) (docs/theory.md, Lemmas 5 and 91).

use interval_arithmetic::{Enclosure, PI};

/// Below this h the terms of D and of u cancel, and their series are summed.
const SERIES_BELOW: f64 = 0.5;

/// The quotients of neighbouring terms of D/(2h³/3), (2k+2)(2k+3)/4, and of −u/(h³/3), 2k(2k+3), without h². The
/// first term that is left out is below 10⁻¹⁸ of the sum for h ≤ ½.
const OF_D: [f64; 8] = [5.0, 10.5, 18.0, 27.5, 39.0, 52.5, 68.0, 85.5];
const OF_U: [f64; 8] = [10.0, 28.0, 54.0, 88.0, 130.0, 180.0, 238.0, 304.0];

/// Terms below this are left out. It is far below an ulp of the sum, which is about 1.
const NEGLIGIBLE: f64 = 1e-18;

/// 1 − t/c₁ (1 − t/c₂ (1 − … )) for 0 ≤ t ≤ c₁. The terms alternate and fall, so that an inner bracket lies between
/// 0 and 1 wherever the sum ends.
pub(crate) fn alternating(t: Enclosure, quotients: &[f64]) -> Enclosure {
    let mut term = 1.0;
    let counts = |&quotient: &f64| {
        let before = term;
        term *= t.high() / quotient;
        before > NEGLIGIBLE
    };
    let count = quotients.iter().copied().take_while(counts).count();
    quotients[..count]
        .iter()
        .rev()
        .fold(Enclosure::new(0.0, 1.0), |inner, &quotient| Enclosure::ONE - t * inner / quotient)
}

/// The functions at one h > 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AtHalfTime {
    pub(crate) h: f64,
    pub(crate) sin: Enclosure,
    /// D.
    pub(crate) d: Enclosure,
    /// u.
    pub(crate) u: Enclosure,
}

impl AtHalfTime {
    pub(crate) fn new(h: f64) -> Self {
        let half = Enclosure::from(h);
        let (sin, cos) = half.sin_cos();
        let (d, u) = if h < SERIES_BELOW {
            let square = half.squared();
            let third = square * half / 3.0;
            (2.0 * third * alternating(square, &OF_D), -(third * alternating(square, &OF_U)))
        } else {
            (half - sin * cos, half * cos - sin)
        };
        AtHalfTime { h, sin, d, u }
    }

    /// The functions at kπ, k ≥ 1, exactly; `h` is a bound of kπ.
    pub(crate) fn at_multiple_of_pi(k: u64, h: f64) -> Self {
        let multiple = PI * k as f64;
        let u = if k.is_multiple_of(2) { multiple } else { -multiple };
        AtHalfTime { h, sin: Enclosure::ZERO, d: multiple, u }
    }

    /// u/D.
    pub(crate) fn rho(&self) -> Enclosure {
        self.u / self.d
    }

    /// Γ = 2u²/D of the flight from x = 0.
    pub(crate) fn closing_speed(&self) -> Enclosure {
        2.0 * self.u.squared() / self.d
    }

    /// W = −Su.
    pub(crate) fn w(&self) -> Enclosure {
        -(self.sin * self.u)
    }

    /// V − V_x(h), which has the sign of the height after 2h.
    pub(crate) fn speed_to_spare(&self, x: f64, v: f64) -> Enclosure {
        let beyond = self.sin * (self.u - x * self.sin) / self.d;
        (Enclosure::from(v) - self.h) - beyond
    }
}
