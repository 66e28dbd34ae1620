//! How is the first crossing of a guard found?
//!
//! [`earliest_crossing`] searches every guard with the strongest information that the model gives and returns the
//! earliest result:
//!
//! | the model gives | file | no crossing is missed because |
//! |---|---|---|
//! | the guard as a quasi-polynomial | `quasi_polynomial_search` | bounds on g‴ and on rounding follow from the coefficients |
//! | enclosures of g, g′, g″ | `enclosure_search` | the model's enclosures are bounds |
//! | values along a step of an integrated flow | `ode/followed_guard` | polynomials through the values show it; an estimate, no bound |
//! | values only | `sampled` | no guarantee between two samples |
//!
//! `bounded` is what a source of bounds gives, and `zero_search` the search that uses it, also along integrated
//! flows. Where rounding hides a function, the search decides behind the hidden interval: a crossing or a touch.
//! `under_bounds` chooses the source for one guard. `bracketed_root` refines a change of sign. `departure` tells to
//! which side a guard leaves its zero.

mod bounded;
mod candidate;
mod certainty;
mod clear_distance;
mod departure;
mod earliest;
mod enclosure_search;
mod first_crossing;
mod found;
mod guard_rate;
mod guard_rounding;
mod guarded_flow;
mod hidden;
mod next_event;
mod one_guard;
mod quasi_layers;
mod quasi_polynomial;
mod quasi_polynomial_search;
mod quasi_term;
mod rounded;
mod sampled;
mod search_request;
mod under_bounds;
mod zero_search;
mod zero_search_end;
mod zero_search_start;
mod zero_test;

#[cfg(feature = "ode")]
pub(crate) use bounded::{Bounded, Leave};
pub use certainty::Certainty;
#[cfg(feature = "ode")]
pub(crate) use clear_distance::clear_distance;
pub(crate) use departure::{Departure, LONGEST_LOOK, StartsAs, departure};
pub(crate) use earliest::earliest_crossing;
pub use first_crossing::FirstCrossing;
#[cfg(feature = "ode")]
pub(crate) use found::Found;
pub(crate) use guard_rate::guard_rate;
pub(crate) use guard_rounding::{
    change_by_components, guard_rounding, is_far, spread, stated_or_measured,
};
#[cfg(feature = "ode")]
pub(crate) use guard_rounding::{
    rounding_around, rounding_beside_zero, rounding_of_state, side_of_surface,
};
pub(crate) use guarded_flow::GuardedFlow;
pub use next_event::{Crossing, EventKind, NextEvent};
pub use quasi_polynomial::{QuasiPolynomial, QuasiPolynomialPart};
#[cfg(feature = "ode")]
pub(crate) use quasi_term::{Coefficients, Term};
#[cfg(feature = "ode")]
pub(crate) use rounded::Rounded;
pub(crate) use search_request::LeavingGuards;
pub(crate) use search_request::MOST_INTERVALS;
pub use search_request::{Leaving, Search};
pub(crate) use under_bounds::as_searched;
#[cfg(feature = "ode")]
pub(crate) use zero_search::ZeroSearch;
#[cfg(feature = "ode")]
pub(crate) use zero_test::ZeroTest;
