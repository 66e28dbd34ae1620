//! A hop by one solver: every landing with its bounds, in the arithmetic of the solver.

use crate::error::Error;
use crate::kernel::scalar::hop::watched_kernel_hop;
use crate::kernel::scalar::landing_bracket::maximum_test_of;
use crate::landing::error_bound::ErrorBound;
use crate::landing::flight_derivative::Variation;
use crate::landing::next_landing::MaximumTest;
use crate::map::extended_hop::{ExtendedHop, ExtendedMasses, HopStart, watched_hop_with};
use crate::map::lift_off_map::{Hop, LiftOffMap, check_speed};
use crate::precision::real::{Extended, Real};

/// A hop with its landings and bounds.
#[derive(Debug, Clone)]
pub(crate) struct TracedHop<R> {
    pub(crate) alpha: f64,
    pub(crate) landings: Vec<TracedLanding<R>>,
    /// Number of sudden lift-offs. It may exceed the number of later landings by one: if x′ of a sudden landing
    /// rounds to zero, the flight after it is too short to be represented, and loses no energy.
    pub(crate) sudden: usize,
    /// α′²/α².
    pub(crate) ratio: R,
    /// Bound on the error of the ratio.
    pub(crate) ratio_error: f64,
    /// α′, or `None` if the hopper is grounded.
    pub(crate) next: Option<R>,
    /// Bound on the error of forming α′ from the ratio, relative to α′.
    pub(crate) rounding_of_next: f64,
    /// Whether every decision is larger than its bound.
    pub(crate) certain: bool,
}

/// A landing with its bounds.
#[derive(Debug, Clone)]
pub(crate) struct TracedLanding<R> {
    pub(crate) time: R,
    pub(crate) closing_speed: R,
    pub(crate) excess: R,
    pub(crate) velocity: R,
    /// Bounds on the errors of x′ and V′.
    pub(crate) state_error: Variation,
    /// μ Γ²/α².
    pub(crate) loss: R,
    /// Bound on the error of μ Γ²/α².
    pub(crate) loss_error: f64,
    /// The test that chose the branch; `None` if only one branch was possible.
    pub(crate) maximum_test: Option<MaximumTest>,
}

/// Rounding error of α′ in `f64`, in ulps of α′, after the ratio α′²/α² with its own bound.
///
/// The kernel takes one root, which rounds once. The general solver forms α√r with two roundings, or α − αt/(1 +
/// √(1−t)) for t < ½: there the quotient has at most four roundings and is at most 0.42 α′, and the difference
/// rounds once. Both are below 3 half ulps.
const ROUNDINGS_OF_NEXT: f64 = 1.5 * f64::EPSILON;

/// Three roundings of the longer arithmetics: the ratio, its root, and the product with α.
const EXTENDED_ROUNDINGS: f64 = 3.0;

/// The smallest positive `f64`, 2⁻¹⁰⁷⁴: an ulp of a subnormal α′.
pub(crate) const SMALLEST: f64 = f64::from_bits(1);

impl<R: Real> TracedHop<R> {
    /// α′ with a bound on its error; `None` if the hopper is grounded.
    ///
    /// With r = α′²/α² and a bound b < r on its error, |√r − √(r ± b)| ≤ b/(√r + √(r − b)). If r ≤ b, the sign of r is
    /// inconclusive, and the bound is that for r − b = 0.
    pub(crate) fn bounded_next(&self) -> Option<(R, f64)> {
        let next = self.next?;
        let (r, b) = (self.ratio.nearest(), self.ratio_error);
        let propagated = self.alpha * (b / (r.sqrt() + (r - b).max(0.0).sqrt()));
        Some((next, propagated + self.rounding_of_next * next.nearest() + 2.0 * SMALLEST))
    }
}

/// The hop from `alpha` by the kernel; `None` if the kernel leaves it undecided.
pub(crate) fn kernel_trace(map: &LiftOffMap, alpha: f64) -> Option<(Hop, TracedHop<f64>)> {
    let mu = map.factors.mu;
    // The kernel's speeds are above 2⁻¹³, so that α² does not underflow.
    let square = alpha * alpha;
    let rounding = ErrorBound::of_f64(alpha).rounding_of_loss();
    let mut landings: Vec<TracedLanding<f64>> = Vec::new();
    let mut test = None;
    let decided = watched_kernel_hop(alpha, map.factors, |end| {
        let state = end.state;
        landings.push(TracedLanding {
            time: 2.0 * end.half_time,
            closing_speed: end.closing_speed_squared.sqrt(),
            excess: state.excess,
            velocity: state.velocity,
            state_error: Variation { excess: state.error, velocity: state.error },
            loss: mu * end.closing_speed_squared / square,
            loss_error: rounding + mu * end.closing_speed_squared_error / square,
            maximum_test: test,
        });
        test = maximum_test_of(&state);
    })?;
    let hop = decided.hop(alpha);
    let ratio_error = decided.sums.error_of_square(alpha, mu) / square;
    let ratio = decided.next_speed_squared / square;
    let next = hop.next;
    let rounding_of_next = ROUNDINGS_OF_NEXT;
    let (sudden, certain) = (hop.sudden, true);
    Some((
        hop,
        TracedHop { alpha, landings, sudden, ratio, ratio_error, next, rounding_of_next, certain },
    ))
}

/// The hop from `alpha` by the general solver, certain or not.
///
/// # Errors
/// The errors of [`LiftOffMap::hop`].
pub(crate) fn general_trace(map: &LiftOffMap, alpha: f64) -> Result<(Hop, TracedHop<f64>), Error> {
    check_speed(alpha)?;
    let mu = map.factors.mu;
    let mut landings: Vec<TracedLanding<f64>> = Vec::new();
    let (mut propagated, mut squares, mut ratio_error) = (0.0, 0.0, f64::INFINITY);
    let (hop, certain) = map.plain_hop(alpha, |landing, bound| {
        let share = landing.closing_speed / alpha;
        squares += share * share;
        let before = std::mem::replace(&mut propagated, bound.propagated(mu, alpha));
        landings.push(TracedLanding {
            time: landing.time,
            closing_speed: landing.closing_speed,
            excess: landing.excess,
            velocity: landing.velocity,
            state_error: bound.state_error(),
            loss: mu * (share * share),
            loss_error: bound.rounding_of_loss() + (propagated - before),
            maximum_test: bound.last_test(),
        });
        ratio_error = bound.ratio_error(mu, alpha);
    })?;
    let (next, sudden) = (hop.next, hop.sudden);
    let (ratio, rounding_of_next) = (1.0 - mu * squares, ROUNDINGS_OF_NEXT);
    Ok((
        hop,
        TracedHop { alpha, landings, sudden, ratio, ratio_error, next, rounding_of_next, certain },
    ))
}

/// The hop from `alpha` in the arithmetic `R`, certain or not; `None` if it exceeds the budget of `R`.
///
/// # Errors
/// The errors of [`LiftOffMap::hop`].
pub(crate) fn extended_trace<R: Extended>(
    map: &LiftOffMap,
    alpha: f64,
) -> Result<Option<(ExtendedHop, TracedHop<R>)>, Error> {
    check_speed(alpha)?;
    let mu = ExtendedMasses::<R>::new(map.mass_ratio()).mu;
    let (speed, short_mu) = (R::from(alpha), mu.nearest());
    let mut landings: Vec<TracedLanding<R>> = Vec::new();
    let (mut propagated, mut ratio, mut ratio_error) = (0.0, R::from(1.0), f64::INFINITY);
    let hop = watched_hop_with::<R>(HopStart::Speed(alpha), map.mass_ratio(), |landing, bound| {
        let loss = mu * (landing.closing_speed / speed).squared();
        let before = std::mem::replace(&mut propagated, bound.propagated(short_mu, alpha));
        landings.push(TracedLanding {
            time: landing.time,
            closing_speed: landing.closing_speed,
            excess: landing.excess,
            velocity: landing.velocity,
            state_error: bound.state_error(),
            loss,
            loss_error: bound.rounding_of_loss() + (propagated - before),
            maximum_test: bound.last_test(),
        });
        ratio = ratio - loss;
        ratio_error = bound.ratio_error(short_mu, alpha);
    })?;
    Ok(hop.map(|hop| {
        let next = (ratio.nearest() > 0.0).then(|| speed * ratio.sqrt());
        let (sudden, certain) = (hop.landings.len() - 1, hop.certain);
        let rounding_of_next = EXTENDED_ROUNDINGS * R::EPSILON;
        (
            hop,
            TracedHop {
                alpha,
                landings,
                sudden,
                ratio,
                ratio_error,
                next,
                rounding_of_next,
                certain,
            },
        )
    }))
}
