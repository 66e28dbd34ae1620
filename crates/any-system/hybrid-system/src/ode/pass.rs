//! One search along an integrated flow: how guards are followed, and which event is the first on the corrected step.

use super::followed_guard::GuardOnStep;
use super::polish::{Accuracy, CorrectedStep};
use super::power_test::stays;
use super::step::Step;
use super::stepping::Stepping;
use super::tolerances::Tolerances;
use crate::crossing::{
    Certainty, Crossing, EventKind, NextEvent, Search, ZeroSearch, guard_rate, rounding_around,
    rounding_beside_zero, rounding_of_state, side_of_surface, stated_or_measured,
};
use crate::error::Error;
use crate::guard::Guard;
use crate::state::StateVector;
use crate::system::HybridSystem;
use smallvec::SmallVec;

/// A step is skipped if the guard's smallest distance from zero is more than one half of its variation.
const AWAY: f64 = 2.0;

/// The states that are compared with the surfaces before a step is skipped are this part of the step apart.
const PARTS: f64 = 8.0;

/// Guards of one mode that are followed without allocating. With more guards each search allocates once.
pub(super) const GUARDS_ON_STACK: usize = 8;

/// One guard, followed from step to step.
#[derive(Clone, Copy)]
pub(super) struct Followed<S> {
    pub(super) guard: Guard<S>,
    /// Its place among the searched guards.
    pub(super) place: usize,
    /// The stated error of the guard's own arithmetic, or zero.
    pub(super) stated: f64,
    pub(super) search: ZeroSearch,
}

/// The guards that are on a known side where a step begins.
pub(super) fn sides_before<S: Copy>(
    followed: &[Followed<S>],
) -> SmallVec<[(Guard<S>, f64); GUARDS_ON_STACK]> {
    let known = |followed: &Followed<S>| Some((followed.guard, followed.search.known_side()?));
    followed.iter().filter_map(known).collect()
}

/// A search with one choice of the first step.
pub(super) struct Pass<'a, T: HybridSystem + ?Sized> {
    pub(super) system: &'a T,
    pub(super) mode: T::Mode,
    pub(super) request: &'a Search<'a, T::Surface>,
    pub(super) tolerances: Tolerances,
}

/// Looks at a guard behind a jump, each four times as far as the one before: up to 2¹⁶ ulps. A motion that takes
/// longer to come back over the surface may turn round before, so that its side is left open.
const LOOKS: u32 = 9;

impl<T: HybridSystem + ?Sized> Pass<'_, T> {
    /// How a guard starts: on a side, or on its surface.
    pub(super) fn follow(
        &self,
        (place, guard): (usize, Guard<T::Surface>),
        start: &T::State,
        rate: &T::State,
    ) -> Result<Followed<T::Surface>, Error> {
        let Guard { surface, direction, .. } = guard;
        let along = |state: &T::State| self.system.guard_value(surface, state);
        let value = along(start);
        if !value.is_finite() {
            return Err(Error::NotFinite { at: 0.0, value });
        }
        let stated = self.system.guard_error(surface, start);
        if let Some(side) = self.request.side_before(surface) {
            let error = stated_or_measured(stated, start, &along);
            let search = ZeroSearch::before_zero(direction, 0.0, side, error);
            return Ok(Followed { guard, place, stated: stated.unwrap_or(0.0), search });
        }
        let known = self.request.side(surface);
        let search = match side_of_surface(start, stated, along) {
            Some(side) if known.is_none() => ZeroSearch::on_side(direction, 0.0, side),
            // A touch that it has had is no further one.
            Some(side) if known == Some(side) => {
                let error = stated_or_measured(stated, start, &along);
                ZeroSearch::before_zero(direction, 0.0, side, error)
            }
            Some(side)
                if known == Some(-side) && self.passes_at_once(surface, (start, rate), -side) =>
            {
                ZeroSearch::passing(direction, 0.0, side)
            }
            _ => {
                // An exact zero has no error of its own, but the states of the step have.
                let error = match value == 0.0 {
                    true => rounding_around(start, &along),
                    false => stated_or_measured(stated, start, &along),
                };
                let side =
                    known.or_else(|| guard_rate(start, rate, error, &along).map(f64::signum));
                // Until then the signs of the steps are noise.
                let hidden = self.request.hidden(surface);
                ZeroSearch::leaving(direction, (hidden, value), error, side)
            }
        };
        Ok(Followed { guard, place, stated: stated.unwrap_or(0.0), search })
    }

    /// Whether the guard comes to `side` as soon as the state moves along its field: it jumps there.
    fn passes_at_once(
        &self,
        surface: T::Surface,
        (start, rate): (&T::State, &T::State),
        side: f64,
    ) -> bool {
        let scale = f64::EPSILON * (1.0 + start.largest()) / rate.largest();
        let is_there = |state: &T::State| self.system.guard_value(surface, state) * side > 0.0;
        (0..LOOKS).any(|look| {
            let time = scale * f64::from(1 << (2 * look));
            let mut moved = start.clone();
            moved.add_scaled(time, rate);
            // Further on as well: the motion must not have turned round.
            let further = self.system.vector_field(self.mode, &moved).map(|rate| {
                let mut further = moved.clone();
                further.add_scaled(time, &rate);
                further
            });
            is_there(&moved) && further.is_none_or(|further| is_there(&further))
        })
    }

    /// True if the guard stays on its side along the last step: by the bounds of a polynomial, or as far as a few values
    /// show. The search then moves to `until`.
    pub(super) fn stays_away(
        &self,
        followed: &mut Followed<T::Surface>,
        integration: &impl Stepping<T::State>,
        until: f64,
    ) -> bool {
        let Some(side) = followed.search.clear_side() else { return false };
        let (from, to) = integration.interval();
        let away = match self.polynomial(followed, integration) {
            Some(coefficients) => stays(coefficients, side, to - from),
            None => {
                to - from <= PARTS * self.tolerances.check_interval
                    && self.samples_stay(followed.guard.surface, side, integration)
            }
        };
        if away {
            followed.search = ZeroSearch::on_side(followed.guard.direction, until, side);
        }
        away
    }

    /// The polynomial of a guard on the last step, if the guard has its sign at every look.
    pub(super) fn polynomial<'i>(
        &self,
        followed: &Followed<T::Surface>,
        integration: &'i impl Stepping<T::State>,
    ) -> Option<&'i [f64]> {
        let coefficients = integration.guard(followed.place)?;
        let (from, to) = integration.interval();
        let looks = ((to - from).abs() / self.tolerances.check_interval).ceil();
        if looks > self.request.intervals as f64 {
            return None;
        }
        let agrees = |look: f64| {
            let since = (to - from) * look / looks;
            let state = integration.state_on_step(from + since)?;
            let value = self.system.guard_value(followed.guard.surface, &state);
            Some((value > 0.0) == (equations::horner(coefficients, since) > 0.0))
        };
        let agree = (1..looks as usize).all(|look| agrees(look as f64) == Some(true));
        agree.then_some(coefficients)
    }

    /// The smallest distance of some values from zero is more than half of the difference between the largest and the
    /// smallest.
    ///
    /// This test is no bound. A dip to zero and back is visible in the values if it takes an eighth of the step.
    fn samples_stay(
        &self,
        surface: T::Surface,
        side: f64,
        integration: &impl Stepping<T::State>,
    ) -> bool {
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0);
        for state in integration.samples() {
            let distance = side * self.system.guard_value(surface, &state);
            // The condition is also true for NaN, which the polynomial's test then returns as an error.
            if !(distance > 0.0) {
                return false;
            }
            nearest = if distance < nearest { distance } else { nearest };
            farthest = if distance > farthest { distance } else { farthest };
        }
        AWAY * nearest > farthest - nearest
    }

    /// Another guard that has its zero before the event of `surface`, if any, at `time`, on the step as it is
    /// corrected there.
    ///
    /// The search compares zeros along the interpolant. The correction may exchange two of them that are nearer to
    /// each other than it is large. The next arc begins on the corrected step: a guard that has changed its sign
    /// there has had its zero.
    pub(super) fn sooner_on(
        &self,
        on_step: &CorrectedStep<T::State>,
        (surface, time): (Option<T::Surface>, f64),
        sides: &[(Guard<T::Surface>, f64)],
    ) -> Result<Option<(f64, T::Surface, f64)>, Error> {
        let mut first: Option<(f64, T::Surface, f64)> = None;
        for &(guard, side) in sides {
            let along = |at: f64| self.system.guard_value(guard.surface, &on_step.state(at));
            let before = time.next_down().max(on_step.from());
            let [at_end, at_before] = [along(time), along(before)];
            // At the same double as the event, it comes at the same instant: the next arc begins with it.
            let passes = Some(guard.surface) == surface || at_end * side < 0.0;
            if !passes || at_before * side > 0.0 || !guard.direction.admits(side, -side) {
                continue;
            }
            if let Some(at) = on_step.first_zero((before, at_before), side, along)?
                && first.is_none_or(|(first, ..)| at < first)
            {
                first = Some((at, guard.surface, side));
            }
        }
        Ok(first)
    }

    /// A guard as a function of time on a step, with its polynomial if it has one.
    pub(super) fn on_step<'a>(
        &'a self,
        step: &'a Step<T::State>,
        surface: T::Surface,
        stated: f64,
        powers: Option<&'a [f64]>,
    ) -> GuardOnStep<'a, impl Fn(f64) -> f64 + 'a, impl Fn(f64, f64) -> f64 + 'a> {
        let value = move |state: &T::State| self.system.guard_value(surface, state);
        // The middle one of three places stands for the interval: at one of them a guard may have a rate of zero,
        // and at another one it may jump.
        let rounding = move |left: f64, right: f64| {
            let size = step.rounding_size();
            let middle = left + 0.5 * (right - left);
            let mut roundings = [left, middle, right]
                .map(|time| stated + rounding_of_state(&step.state(time), &size, &value));
            roundings.sort_by(f64::total_cmp);
            roundings[1]
        };
        let along = move |time: f64| value(&step.state(time));
        let checked = self.tolerances.check_interval;
        GuardOnStep::new(along, rounding, (step.from, step.to), checked, powers)
    }

    /// The event of a surface at a time of a step, with both errors of its time.
    pub(super) fn crossing(
        &self,
        on_step: &CorrectedStep<T::State>,
        (time, hidden): (f64, f64),
        (surface, kind, from): (T::Surface, EventKind, Option<f64>),
        accuracy: Accuracy<T::State>,
    ) -> Crossing<T::Surface, T::State> {
        let value = |state: &T::State| self.system.guard_value(surface, state);
        let stated = self.system.guard_error(surface, &on_step.state(time));
        let [before, behind] = on_step.beside(time);
        let own = rounding_beside_zero(stated, [&before, &behind], &value);
        let rounding = |state: &T::State| own + rounding_of_state(state, state, &value);
        let time_rounding = on_step.time_rounding((time, hidden), value, rounding);
        let time_error = on_step.time_error((time, time_rounding), value, accuracy);
        Crossing {
            surface,
            time,
            time_rounding,
            time_error,
            state: on_step.state(time),
            kind,
            from,
            certainty: Certainty::Interpolated,
        }
    }

    /// Whether a guard comes to its surface from `side` at the end of the last step, as far as rounding shows.
    pub(super) fn approaches(
        &self,
        surface: T::Surface,
        side: f64,
        integration: &impl Stepping<T::State>,
    ) -> bool {
        let state = integration.state();
        let value = |state: &T::State| self.system.guard_value(surface, state);
        let stated = self.system.guard_error(surface, &state);
        let rounding = stated_or_measured(stated, &state, &value);
        let rate = guard_rate(&state, &integration.slope(), rounding, &value);
        rate.is_some_and(|rate| rate * side < 0.0)
    }

    /// No event before the horizon. A guard on its way to its surface that comes there within some ulps of time has its
    /// event on the horizon: the field is not evaluated beyond.
    pub(super) fn at_horizon(
        &self,
        followed: &[Followed<T::Surface>],
        mut integration: impl Stepping<T::State>,
        (steps, sizes): (usize, &T::State),
    ) -> Result<NextEvent<T::Surface, T::State>, Error> {
        let state = integration.state();
        let certainty = Certainty::Interpolated;
        let accuracy = Accuracy { tolerances: self.tolerances, steps, sizes };
        // A guard that has changed its sign so near to the horizon that rounding hid it on the step.
        let changed = |followed: &&Followed<T::Surface>| {
            let value = self.system.guard_value(followed.guard.surface, &state);
            let admitted =
                |side: &f64| value * side < 0.0 && followed.guard.direction.admits(*side, -side);
            followed.search.known_side().is_some_and(|side| admitted(&side))
        };
        if let Some(changed) = followed.iter().find(changed)
            && !integration.at_rest()
        {
            let sides = sides_before(followed);
            let step = integration.last_step()?;
            let on_step = CorrectedStep::ending_at(&step, &state);
            let first = self.sooner_on(&on_step, (None, step.to), &sides)?;
            // The corrected step may end an ulp beside the state, still on the other side.
            let side = changed.search.known_side().unwrap_or(0.0);
            let (time, surface, side) = first.unwrap_or((step.to, changed.guard.surface, side));
            let event = (surface, EventKind::Crossing, Some(side));
            let mut crossing = self.crossing(&on_step, (time, 0.0), event, accuracy);
            if first.is_none() {
                crossing.state = state;
            }
            return Ok(NextEvent::Crossing(crossing));
        }
        Ok(NextEvent::None { state: Some(state), certainty })
    }
}
