//! The system with sliding modes, as a hybrid system.

use super::crossing_while_sliding::after_crossing;
use super::detection::same_surface;
use super::exit::side_after_exit;
use super::filippov::{Filippov, Sides};
use super::filippov_modes::{FilippovMode, FilippovSurface};
use super::sliding_point::Sliding;
use crate::crossing::{Crossing, Leaving, NextEvent, QuasiPolynomial, Search};
use crate::error::Error;
use crate::guard::{Guard, Touch};
use crate::ode::{integrated_flow, integrated_states};
use crate::state::StateVector;
use crate::system::{HybridSystem, Reset};
use interval_arithmetic::Enclosure;

impl<T: HybridSystem> HybridSystem for Filippov<T> {
    type State = T::State;
    type Mode = FilippovMode<T::Mode, T::Surface>;
    type Surface = FilippovSurface<T::Mode, T::Surface>;

    fn flow(&self, mode: Self::Mode, start: &T::State, time: f64) -> T::State {
        match mode {
            FilippovMode::Free(mode) => self.system.flow(mode, start, time),
            FilippovMode::Sliding { surface, below, above, .. } => {
                let end = integrated_flow(self, mode, start, time, self.tolerances);
                self.on_surface(&Sides { surface, below, above }, end)
            }
        }
    }

    fn slides_on(&self, mode: Self::Mode) -> Option<Self::Surface> {
        match mode {
            FilippovMode::Free(mode) => self.system.slides_on(mode).map(FilippovSurface::Model),
            FilippovMode::Sliding { surface, .. } => Some(FilippovSurface::Model(surface)),
        }
    }

    fn flow_at(
        &self,
        mode: Self::Mode,
        start: &T::State,
        times: &[f64],
    ) -> Result<Vec<T::State>, Error> {
        match mode {
            FilippovMode::Free(mode) => self.system.flow_at(mode, start, times),
            FilippovMode::Sliding { surface, below, above, .. } => {
                let states = integrated_states(self, mode, start, times, self.tolerances)?;
                let sides = Sides { surface, below, above };
                Ok(states.into_iter().map(|state| self.on_surface(&sides, state)).collect())
            }
        }
    }

    fn validate(&self, mode: Self::Mode, start: &T::State) -> Result<(), Error> {
        match mode {
            FilippovMode::Free(mode) => self.system.validate(mode, start),
            FilippovMode::Sliding { below, .. } => self.system.validate(below, start),
        }
    }

    fn guards(&self, mode: Self::Mode) -> &[Guard<Self::Surface>] {
        self.guards.guards(mode, || match mode {
            FilippovMode::Free(mode) => {
                self.system.guards(mode).iter().map(|guard| of_model(*guard)).collect()
            }
            FilippovMode::Sliding { surface, partner, below, above } => {
                // A rate that touches zero and goes back is no exit.
                let mut guards = vec![
                    Guard::falling(FilippovSurface::Tangent { surface, mode: below })
                        .touch(Touch::Ignore),
                    Guard::rising(FilippovSurface::Tangent { surface, mode: above })
                        .touch(Touch::Ignore),
                ];
                let both = [below, above].map(|mode| self.system.guards(mode));
                for guard in both.into_iter().flatten() {
                    let own = guard.surface == surface || guard.surface == partner;
                    if !own && !guards.contains(&of_model(*guard)) {
                        guards.push(of_model(*guard));
                    }
                }
                guards
            }
        })
    }

    fn guard_value(&self, surface: Self::Surface, state: &T::State) -> f64 {
        match surface {
            FilippovSurface::Model(surface) => self.system.guard_value(surface, state),
            FilippovSurface::Tangent { surface, mode } => {
                let field = self.system.vector_field(mode, state);
                field.map_or(f64::NAN, |field| self.rate(surface, state, &field))
            }
        }
    }

    fn reset(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &T::State,
    ) -> Reset<Self::Mode, T::State> {
        let free = |mode, state| Reset::Jump { mode: FilippovMode::Free(mode), state };
        match (mode, surface) {
            (FilippovMode::Free(mode), FilippovSurface::Model(surface)) => {
                match self.system.reset(mode, surface, before) {
                    Reset::Jump { mode, state } => free(mode, state),
                    Reset::Resize { mode, state } => {
                        Reset::Resize { mode: FilippovMode::Free(mode), state }
                    }
                    Reset::Stop => Reset::Stop,
                }
            }
            // The field of this mode is tangent: the sliding motion goes over into it without a kink.
            (_, FilippovSurface::Tangent { mode, .. }) => free(mode, before.clone()),
            (
                FilippovMode::Sliding { surface, partner, below, above },
                FilippovSurface::Model(other),
            ) => {
                let sides = Sides { surface, below, above };
                let after = after_crossing(self, (&sides, partner), other, before);
                // A search has returned this as an error already, but for clocks, which are not searched: `reset_error` says why
                // there is no state.
                after.unwrap_or_else(|_| {
                    let mut none = before.clone();
                    none.add_scaled(f64::NAN, before);
                    free(below, none)
                })
            }
        }
    }

    fn rest(&self, mode: Self::Mode, limit: &T::State) -> Option<(Self::Mode, T::State)> {
        let FilippovMode::Free(mode) = mode else { return None };
        let (mode, state) = self.system.rest(mode, limit)?;
        Some((FilippovMode::Free(mode), state))
    }

    /// The model's own mode if it gives one, else the sliding mode on the surface. `None` where two sliding
    /// surfaces meet, and for a model without fields.
    fn slide(
        &self,
        sliding: &Sliding<Self::Mode, Self::Surface, T::State>,
    ) -> Option<(Self::Mode, T::State)> {
        let (FilippovMode::Free(below), FilippovMode::Free(above)) = (sliding.below, sliding.above)
        else {
            return None;
        };
        let FilippovSurface::Model(surface) = sliding.surface else { return None };
        let of_model = Sliding {
            surface,
            below,
            above,
            time: sliding.time,
            state: sliding.state.clone(),
            rates: sliding.rates,
            fields: sliding.fields.clone(),
            field: sliding.field.clone(),
        };
        if let Some((mode, state)) = self.system.slide(&of_model) {
            return Some((FilippovMode::Free(mode), state));
        }
        if !self.follows || sliding.field.is_none() {
            return None;
        }
        let names = |mode| self.system.guards(mode).iter().map(|guard| guard.surface);
        let is_partner = |&other: &T::Surface| {
            let leads = |from, to| {
                let after = self.system.reset(from, other, &sliding.state);
                matches!(after, Reset::Jump { mode, .. } if mode == to)
            };
            other != surface
                && same_surface(&self.system, surface, other, &sliding.state).is_some()
                && (leads(below, above) || leads(above, below))
        };
        let partner = names(below).chain(names(above)).find(is_partner).unwrap_or(surface);
        let state = self.on_surface(&Sides { surface, below, above }, sliding.state.clone());
        Some((FilippovMode::Sliding { surface, partner, below, above }, state))
    }

    fn vector_field(&self, mode: Self::Mode, state: &T::State) -> Option<T::State> {
        match mode {
            FilippovMode::Free(mode) => self.system.vector_field(mode, state),
            FilippovMode::Sliding { surface, below, above, .. } => {
                self.integrated_field(&Sides { surface, below, above }, state)
            }
        }
    }

    fn guard_error(&self, surface: Self::Surface, state: &T::State) -> Option<f64> {
        let FilippovSurface::Model(surface) = surface else { return None };
        self.system.guard_error(surface, state)
    }

    fn condition(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &T::State,
    ) -> Option<f64> {
        let FilippovSurface::Model(surface) = surface else { return None };
        let of = |mode| self.system.condition(mode, surface, before);
        match mode {
            FilippovMode::Free(mode) => of(mode),
            FilippovMode::Sliding { below, above, .. } => {
                let watches = |mode: &T::Mode| {
                    self.system.guards(*mode).iter().any(|guard| guard.surface == surface)
                };
                // Without a condition the event of a side always counts.
                let sides = [below, above].into_iter().filter(watches).map(of);
                sides.reduce(both).flatten()
            }
        }
    }

    fn observes(&self, surface: Self::Surface) -> bool {
        matches!(surface, FilippovSurface::Model(surface) if self.system.observes(surface))
    }

    fn reset_error(
        &self,
        mode: Self::Mode,
        surface: Option<Self::Surface>,
        before: &T::State,
        time: f64,
    ) -> Option<Error> {
        let mode = match mode {
            FilippovMode::Free(mode) => mode,
            FilippovMode::Sliding { surface: on, partner, below, above } => {
                let Some(FilippovSurface::Model(other)) = surface else { return None };
                let sides = Sides { surface: on, below, above };
                let reason = after_crossing(self, (&sides, partner), other, before).err()?.0;
                let surface = format!("{on:?}");
                return Some(Error::SlidingNotUnique { surface, time, reason });
            }
        };
        let surface = match surface {
            Some(FilippovSurface::Model(surface)) => Some(surface),
            Some(FilippovSurface::Tangent { .. }) => return None,
            None => None,
        };
        self.system.reset_error(mode, surface, before, time)
    }

    fn leaving_side(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &T::State,
    ) -> Option<f64> {
        let (FilippovMode::Free(mode), FilippovSurface::Model(surface)) = (mode, surface) else {
            return None;
        };
        let own = self.system.leaving_side(mode, surface, start);
        let after_exit = || side_after_exit(self, mode, surface, start);
        own.or_else(|| self.follows.then(after_exit).flatten())
    }

    fn next_time(&self, mode: Self::Mode, surface: Self::Surface, after: f64) -> Option<f64> {
        let FilippovSurface::Model(surface) = surface else { return None };
        let of = |mode| self.system.next_time(mode, surface, after);
        match mode {
            FilippovMode::Free(mode) => of(mode),
            FilippovMode::Sliding { below, above, .. } => match (of(below), of(above)) {
                (Some(a), Some(b)) => Some(if a < b { a } else { b }),
                (one, other) => one.or(other),
            },
        }
    }

    fn guard_quasi_polynomial(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &T::State,
    ) -> Option<QuasiPolynomial> {
        let (FilippovMode::Free(mode), FilippovSurface::Model(surface)) = (mode, surface) else {
            return None;
        };
        self.system.guard_quasi_polynomial(mode, surface, start)
    }

    fn guard_enclosure(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &T::State,
        order: u32,
        times: (f64, f64),
    ) -> Option<Enclosure> {
        let (FilippovMode::Free(mode), FilippovSurface::Model(surface)) = (mode, surface) else {
            return None;
        };
        self.system.guard_enclosure(mode, surface, start, order, times)
    }

    fn first_crossing(
        &self,
        mode: Self::Mode,
        start: &T::State,
        search: &Search<Self::Surface>,
    ) -> Result<NextEvent<Self::Surface, T::State>, Error> {
        match mode {
            FilippovMode::Free(mode) => {
                let leaving: Vec<_> = search.leaving.iter().filter_map(leaving_of_model).collect();
                let search = Search {
                    horizon: search.horizon,
                    sampling_interval: search.sampling_interval,
                    intervals: search.intervals,
                    steps: search.steps,
                    time: search.time,
                    leaving: &leaving,
                    ahead: search.ahead,
                };
                Ok(next_of_model(self.system.first_crossing(mode, start, &search)?))
            }
            FilippovMode::Sliding { surface, partner, below, above } => {
                let sides = Sides { surface, below, above };
                self.first_crossing_while_sliding(mode, (&sides, partner), start, search)
            }
        }
    }
}

/// The condition of an event of both sides: the smaller one where both count, the larger one where neither does. NaN, which decides nothing, if it counts on one
/// side alone, or if one has no value.
fn both(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    let has_no_value = |condition: Option<f64>| condition.is_some_and(f64::is_nan);
    if has_no_value(one) || has_no_value(other) {
        return Some(f64::NAN);
    }
    let counts = |condition: Option<f64>| condition.is_none_or(|condition| condition > 0.0);
    match (counts(one), counts(other)) {
        (true, true) => match (one, other) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        },
        (false, false) => Some(one.unwrap_or(f64::NAN).max(other.unwrap_or(f64::NAN))),
        _ => Some(f64::NAN),
    }
}

fn of_model<M, S: Copy>(guard: Guard<S>) -> Guard<FilippovSurface<M, S>> {
    Guard {
        surface: FilippovSurface::Model(guard.surface),
        direction: guard.direction,
        role: guard.role,
        touch: guard.touch,
    }
}

fn leaving_of_model<M, S: Copy>(leaving: &Leaving<FilippovSurface<M, S>>) -> Option<Leaving<S>> {
    let FilippovSurface::Model(surface) = leaving.surface else { return None };
    Some(Leaving { surface, side: leaving.side, ahead: leaving.ahead, hidden: leaving.hidden })
}

fn next_of_model<M, S, X>(next: NextEvent<S, X>) -> NextEvent<FilippovSurface<M, S>, X> {
    match next {
        NextEvent::Crossing(crossing) => NextEvent::Crossing(Crossing {
            surface: FilippovSurface::Model(crossing.surface),
            time: crossing.time,
            time_rounding: crossing.time_rounding,
            time_error: crossing.time_error,
            state: crossing.state,
            from: crossing.from,
            kind: crossing.kind,
            certainty: crossing.certainty,
        }),
        NextEvent::None { state, certainty } => NextEvent::None { state, certainty },
        NextEvent::Unfinished { time, state, certainty } => {
            NextEvent::Unfinished { time, state, certainty }
        }
    }
}
