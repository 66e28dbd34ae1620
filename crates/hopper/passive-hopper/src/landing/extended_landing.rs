//! A landing in extended arithmetic: Newton's method from the root that `f64` finds, inside the same bracket.

use crate::landing::flight_ends::Landing;
use crate::landing::half_time::HalfTime;
use crate::landing::half_time_root::HalfTimeRoot;
use crate::precision::real::Extended;

/// The end of a flight; [`Landing`] has the meaning of its fields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExtendedLanding<R> {
    pub(crate) closing_speed: R,
    pub(crate) excess: R,
    pub(crate) velocity: R,
    pub(crate) time: R,
    /// False if the search used up its steps before the residual was as small as its rounding error. Such a landing
    /// decides nothing.
    pub(crate) settled: bool,
}

/// Guard on the number of steps. From a good `f64` start each step doubles the number of right digits, and seven
/// steps suffice for 1024 bits. Next to a double root (a flight that nearly touches the ground) a step of Newton's
/// method only halves the distance, and a step that would leave the bracket is replaced by a bisection, which
/// halves the bracket: 1024 bits take fewer than 1100 such steps. A search that needs more is not settled, and the
/// hop is inconclusive.
const STEPS: usize = 1200;

/// The search takes its last step from a residual within this many EPSILON of 1 + x + |V| + h. It is twice the rounding
/// error of a residual (docs/theory.md, Lemma 63), so that it is met, and half of [`BACKWARD_ULPS`], which the error
/// bound counts for both. A larger value would save no step: the last one squares the error.
///
/// [`BACKWARD_ULPS`]: crate::landing::error_bound::BACKWARD_ULPS
const RESIDUAL_ULPS: f64 = 8.0;

/// Part by which a rounded end of the bracket, nπ or α*_n, is moved outwards: more than its rounding error of an ulp.
const ROUNDED_END: f64 = 2.0 * f64::EPSILON;

/// The ends of the interval that holds the root, in the arithmetic `R`. Where one end is V itself, V has all its bits.
///
/// Both ends may round to V, as for α = π in `f64`. Then both are moved outwards: V(h) increases there, too.
fn bracket<R: Extended>(root: &HalfTimeRoot, v: R) -> (R, R) {
    let (left, right) = root.bracket;
    let speed = v.nearest();
    let end = |end: f64, part: f64| {
        if end == speed && left != right { v } else { R::from(end * part) }
    };
    (end(left, 1.0 - ROUNDED_END), end(right, 1.0 + ROUNDED_END))
}

impl<R: Extended> ExtendedLanding<R> {
    /// The landing of the flight from stretch 1 + `x` and speed `v`, by Newton's method inside the bracket of `root`,
    /// the root in `f64`. V(h) increases there, so that no other landing can be found.
    pub(crate) fn near(root: &HalfTimeRoot, x: R, v: R, kappa: R) -> Self {
        let (mut left, mut right) = bracket(root, v);
        let size = 1.0 + x.nearest() + v.nearest().abs() + root.half.h;
        let tolerance = RESIDUAL_ULPS * R::EPSILON * size;
        let mut h = R::from(root.half.h);
        let mut half = HalfTime::extended_at(h);
        let mut settled = false;
        for _ in 0..STEPS {
            let residual = (h - v) + half.speed_beyond_h(x);
            let last = residual.nearest().abs() <= tolerance;
            if residual.nearest() > 0.0 {
                right = h;
            } else {
                left = h;
            }
            let slope = half.start_speed_slope(x);
            let newton = (slope.nearest() > 0.0).then(|| h - residual / slope);
            // Relative to h: the difference itself may be below the smallest `f64`.
            let positive = |difference: R| (difference / h).nearest() > 0.0;
            let inside = newton.filter(|&next| positive(next - left) && positive(right - next));
            settled = last;
            if last && inside.is_none() {
                break; // the root to the last bit, or a double root, where no step is needed
            }
            h = inside.unwrap_or((left + right) * 0.5);
            half = HalfTime::extended_at(h);
            if last {
                break;
            }
        }
        let closing_speed = half.closing_speed(x);
        ExtendedLanding {
            closing_speed,
            excess: x + h * (v - h) * 2.0,
            velocity: v - h * 2.0 + kappa * closing_speed,
            time: h * 2.0,
            settled,
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
