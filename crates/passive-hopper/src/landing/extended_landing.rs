//! A landing in extended arithmetic: Newton's method from the root that `f64` finds.

use crate::landing::flight_ends::Landing;
use crate::landing::half_time::HalfTime;
use crate::precision::real::Extended;

/// The end of a flight; [`Landing`] has the meaning of its fields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExtendedLanding<R> {
    pub(crate) closing_speed: R,
    pub(crate) excess: R,
    pub(crate) velocity: R,
    pub(crate) time: R,
}

/// Guard on the number of Newton steps. From a good `f64` start each step doubles the right digits, and seven suffice for
/// 1024 bits. Next to a double root (a flight that nearly touches the ground) a step only halves the error: until the
/// start is good, each step gains one bit. The value is chosen, not derived; past it the last h stands.
const NEWTON_STEPS: usize = 400;

impl<R: Extended> ExtendedLanding<R> {
    /// The landing of the flight from stretch 1 + `x` and speed `v`, from an `f64` near h.
    pub(crate) fn near(start: f64, x: R, v: R, kappa: R) -> Self {
        let mut h = R::from(start);
        let mut half = HalfTime::extended_at(h);
        for _ in 0..NEWTON_STEPS {
            let residual = (h - v) + half.speed_beyond_h(x);
            let slope = half.start_speed_slope(x);
            if slope.nearest() == 0.0 {
                break; // a double root: no step is possible, and none is needed
            }
            let step = residual / slope;
            if !(step.nearest().abs() > R::EPSILON * h.nearest()) {
                break;
            }
            h = h - step;
            half = HalfTime::extended_at(h);
        }
        let closing_speed = half.closing_speed(x);
        ExtendedLanding {
            closing_speed,
            excess: x + h * (v - h) * 2.0,
            velocity: v - h * 2.0 + kappa * closing_speed,
            time: h * 2.0,
        }
    }

    /// The landing in `f64`, with the decision `sudden`.
    pub(crate) fn rounded(&self, sudden: bool) -> Landing {
        Landing {
            time: self.time.nearest(),
            closing_speed: self.closing_speed.nearest(),
            excess: self.excess.nearest(),
            velocity: self.velocity.nearest(),
            sudden,
        }
    }
}
