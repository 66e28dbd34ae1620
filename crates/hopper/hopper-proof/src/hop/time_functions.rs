//! The functions of the time of flight τ that occur in the change of a landing with its start.

use crate::hop::half_time::AtHalfTime;
use interval_arithmetic::Enclosure;

/// Enclosures over an interval of times τ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TimeFunctions {
    /// sin τ.
    pub(crate) sin: Enclosure,
    /// cos τ.
    pub(crate) cos: Enclosure,
    /// r = 1 − cos τ.
    pub(crate) r: Enclosure,
    /// p = τ − sin τ, which rises, since p′ = r.
    pub(crate) p: Enclosure,
}

impl TimeFunctions {
    /// Over the times between two halves of them.
    pub(crate) fn between([first, last]: &[AtHalfTime; 2]) -> Self {
        let time = Enclosure::new(2.0 * first.h, 2.0 * last.h);
        let (sin, cos) = time.sin_cos();
        // Small values of 1 − cos τ keep their digits as 2 sin² ½τ.
        let r = if cos.high() <= 0.5 {
            Enclosure::ONE - cos
        } else {
            2.0 * (0.5 * time).sin().squared()
        };
        let p = Enclosure::new((2.0 * first.d.low()).max(0.0), 2.0 * last.d.high());
        TimeFunctions { sin, cos, r, p }
    }
}
