//! The start of a free mode where a sliding motion ends.
//!
//! A sliding motion ends where the field of one mode is tangent to the surface. The time of this event has an
//! error, so the rate a of the guard along that field is zero only within an error. If its state is before the
//! tangent point, the sign of a still leads to the surface, and the second derivative away from it:
//!
//! ```text
//!   g(t) = a t + g̈ t²/2,   a < 0 < g̈:   g dips to −a²/(2g̈) and comes back after 2|a|/g̈
//! ```
//!
//! If the flow is not known to the depth of this dip, the state has left. By the sign of a alone it would enter the
//! sliding mode again, which ends at once, and so on without end.

use super::detection::is_unchanged;
use super::filippov::Filippov;
use super::rates::guard_rates;
use crate::system::{HybridSystem, Reset};

/// The side to which the guard of `surface` leaves its zero in the free `mode`, if a sliding motion ends at the
/// `start`: the other side's field points at the surface, and the guard dips by less than the tolerances of the
/// flow. `None` otherwise: the usual rule decides.
pub(super) fn side_after_exit<T: HybridSystem>(
    filippov: &Filippov<T>,
    mode: T::Mode,
    surface: T::Surface,
    start: &T::State,
) -> Option<f64> {
    let system = filippov.system();
    let rates = guard_rates(system, mode, surface, start)?;
    let bend = rates.second?;
    let side = bend.sign()?;
    if rates.first.sign() == Some(side) {
        return None;
    }
    let dip = 0.5 * rates.first.value * rates.first.value / bend.value.abs();
    if !(dip <= filippov.error_of_flow(surface, start, 1.0)) {
        return None;
    }
    let Reset::Jump { mode: other, state } = system.reset(mode, surface, start) else {
        return None;
    };
    let pushed_back = guard_rates(system, other, surface, start).and_then(|rates| rates.side());
    (is_unchanged(start, &state) && pushed_back == Some(side)).then_some(side)
}
