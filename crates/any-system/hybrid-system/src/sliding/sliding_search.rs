//! The first event of a sliding motion.

use super::crossing_while_sliding::after_crossing;
use super::filippov::{Fields, Filippov, OffSurface, Sides};
use super::filippov_modes::{FilippovMode, FilippovSurface};
use crate::crossing::{Crossing, NextEvent, Search};
use crate::error::Error;
use crate::ode::integrated_crossing;
use crate::state::StateVector;
use crate::system::HybridSystem;

/// The result of a search of the system with sliding modes.
type Next<T> = NextEvent<
    FilippovSurface<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface>,
    <T as HybridSystem>::State,
>;

impl<T: HybridSystem> Filippov<T> {
    /// The first event of a sliding motion: a crossing of another surface, or its exit.
    pub(super) fn first_crossing_while_sliding(
        &self,
        mode: FilippovMode<T::Mode, T::Surface>,
        (sides, partner): (&Sides<T::Mode, T::Surface>, T::Surface),
        start: &T::State,
        search: &Search<FilippovSurface<T::Mode, T::Surface>>,
    ) -> Result<Next<T>, Error> {
        if let Err(OffSurface { value, largest }) = self.check_on_surface(sides.surface, start) {
            let surface = format!("{:?}", sides.surface);
            return Err(Error::OffSurface { surface, value, largest });
        }
        let on = |state| self.on_surface(sides, state);
        let not_unique = |time, reason| Error::SlidingNotUnique {
            surface: format!("{:?}", sides.surface),
            time,
            reason,
        };
        match integrated_crossing(self, mode, start, search, self.tolerances)? {
            NextEvent::Crossing(mut crossing) => {
                crossing.state = on(crossing.state);
                match crossing.surface {
                    FilippovSurface::Model(other) => {
                        after_crossing(self, (sides, partner), other, &crossing.state)
                            .map_err(|reason| not_unique(crossing.time, reason.0))?;
                    }
                    FilippovSurface::Tangent { .. }
                        if self.both_tangent(sides, &crossing.state) =>
                    {
                        return Err(not_unique(crossing.time, "both fields are tangent"));
                    }
                    // An exit is where the rate has changed its sign. At a limit on time within the error of the exit
                    // both fields may still point at the surface, and a free mode would slide again at once.
                    FilippovSurface::Tangent { mode, .. }
                        if crossing.time >= search.horizon
                            && self.is_led_back(sides, mode, &crossing.state) =>
                    {
                        let Crossing { state, certainty, .. } = crossing;
                        return Ok(NextEvent::None { state: Some(state), certainty });
                    }
                    FilippovSurface::Tangent { .. } => {}
                }
                Ok(NextEvent::Crossing(crossing))
            }
            NextEvent::None { state, certainty } => {
                Ok(NextEvent::None { state: state.map(on), certainty })
            }
            NextEvent::Unfinished { time, state, certainty } => {
                Ok(NextEvent::Unfinished { time, state: on(state), certainty })
            }
        }
    }

    /// True if the field of `mode`, on one of the sides, points at the surface.
    fn is_led_back(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        mode: T::Mode,
        state: &T::State,
    ) -> bool {
        self.fields(sides, state).is_some_and(|Fields { rates: (below, above), .. }| {
            if mode == sides.below { below > 0.0 } else { above < 0.0 }
        })
    }

    /// True if both fields are tangent to the surface, within the tolerance of the flow.
    fn both_tangent(&self, sides: &Sides<T::Mode, T::Surface>, state: &T::State) -> bool {
        let Some(fields) = self.fields(sides, state) else { return false };
        let (a, b) = fields.rates;
        // Far from such a point one of the rates is as large as the difference of the fields allows.
        let mut difference = fields.above.clone();
        difference.add_scaled(-1.0, &fields.below);
        let scale = TANGENT_TOLERANCES * self.tolerances.relative;
        a.abs().max(b.abs()) <= scale * (difference.largest() + fields.below.largest())
    }
}

/// Two rates that are within this multiple of the tolerance of zero, relative to the fields, cannot be told from two
/// tangent fields: the errors of several steps add up in the state.
const TANGENT_TOLERANCES: f64 = 100.0;
