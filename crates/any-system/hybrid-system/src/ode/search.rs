//! The first event of all guards of a mode along an integrated flow.

use super::followed_guard::GuardOnStep;
use super::integration::Integration;
use super::polish::{Accuracy, CorrectedStep, polished, rate};
use super::step::Step;
use super::tolerances::Tolerances;
use crate::crossing::{
    Certainty, Crossing, EventKind, Found, NextEvent, Search, ZeroSearch, guard_rate,
    rounding_beside_zero, rounding_of_state, side_of_surface, stated_or_measured,
};
use crate::error::Error;
use crate::guard::{Guard, Role, Touch};
use crate::looked::Looked;
use crate::state::StateVector;
use crate::system::HybridSystem;
use smallvec::SmallVec;

/// Guards of one mode that are followed without allocating. With more guards each search allocates once.
const GUARDS_ON_STACK: usize = 8;

/// Rounding error of an interpolant, in units of that of the largest state on its step. The value is an estimate, not
/// derived: with the factors of `guard_rounding` it is 6·10⁻¹⁴ of the state. Measured on the problem of `schemes`, steps of
/// 1/16 and 1/32: the pair 9(8) is wrong by 2·10⁻¹⁶. If the value is too small, rounding is taken for a crossing; if it is
/// too large, touches are reported too early.
const INTERPOLANT_ROUNDING: f64 = 64.0;

/// If rounding hides the guard at a time on the first step, and this multiple of the time is shorter than the step, the
/// search is repeated with a first step of that length: the rounding of an interpolant shrinks with its step, until only
/// the rounding of the state is left. The hidden time then lies in the middle of the step. A smaller number might end
/// the step before it, a larger one leaves more rounding.
const SHORTER_FIRST_STEP: f64 = 2.0;

/// A repetition must shorten the first step by this factor at least, so that the repetitions end.
const SHORTER: f64 = 0.5;

/// A step is skipped if the guard's smallest distance from zero is more than one half of its variation.
const AWAY: f64 = 2.0;

/// The states that are compared with the surfaces before a step is skipped are this part of the step apart.
const PARTS: f64 = 8.0;

/// One guard, followed from step to step.
struct Followed<S> {
    guard: Guard<S>,
    /// The stated error of the guard's own arithmetic, or zero.
    stated: f64,
    search: ZeroSearch,
}

/// What is found first on a step.
struct Finding<'a, S> {
    found: Found,
    time: f64,
    followed: &'a Followed<S>,
    /// The guard had not left the zero at its start.
    leaving: bool,
}

/// The guards that are on a known side where a step begins.
fn sides_before<S: Copy>(followed: &[Followed<S>]) -> SmallVec<[(Guard<S>, f64); GUARDS_ON_STACK]> {
    let known = |followed: &Followed<S>| Some((followed.guard, followed.search.known_side()?));
    followed.iter().filter_map(known).collect()
}

/// The result of a search with one choice of the first step.
enum Outcome<S, X> {
    Finished(NextEvent<S, X>),
    /// Rounding hides an event on the first step; on a first step of this length it may be visible.
    Hidden {
        first_step: f64,
    },
}

/// Follows `field` from `start` until a guard of `mode` has an event, or to the horizon of `request`.
pub(super) fn search<T>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    request: &Search<T::Surface>,
    field: impl Fn(f64, &T::State) -> T::State,
    tolerances: Tolerances,
) -> Result<NextEvent<T::Surface, T::State>, Error>
where
    T: HybridSystem + ?Sized,
{
    let horizon = request.horizon;
    if !(horizon >= 0.0) {
        return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
    }
    let searched = |guard: &Guard<T::Surface>| guard.role != Role::Clock;
    if !system.guards(mode).iter().any(searched) || horizon == 0.0 {
        return Ok(NextEvent::None { state: None, certainty: Certainty::Interpolated });
    }
    let mut first_step = f64::INFINITY;
    loop {
        let integration = Integration::new(&field, start, tolerances)?
            .autonomous()
            .until(horizon)?
            .starting_with(first_step);
        let rate = field(0.0, start);
        let pass = Pass { system, mode, request, tolerances };
        match pass.run(start, &rate, integration)? {
            Outcome::Finished(next) => return Ok(next),
            Outcome::Hidden { first_step: shorter } => first_step = shorter,
        }
    }
}

/// A search with one choice of the first step.
struct Pass<'a, T: HybridSystem + ?Sized> {
    system: &'a T,
    mode: T::Mode,
    request: &'a Search<'a, T::Surface>,
    tolerances: Tolerances,
}

impl<T: HybridSystem + ?Sized> Pass<'_, T> {
    fn run<F>(
        &self,
        start: &T::State,
        rate: &T::State,
        mut integration: Integration<F, T::State>,
    ) -> Result<Outcome<T::Surface, T::State>, Error>
    where
        F: Fn(f64, &T::State) -> T::State,
    {
        let horizon = self.request.horizon;
        let mut budget = self.request.intervals;
        let mut followed: SmallVec<[Followed<T::Surface>; GUARDS_ON_STACK]> = SmallVec::new();
        for guard in self.system.guards(self.mode).iter().filter(|guard| guard.role != Role::Clock)
        {
            followed.push(self.follow(*guard, start, rate)?);
        }
        let mut steps = 0;
        while !integration.ended() && !integration.at_rest() {
            if steps >= self.request.steps || integration.steps_left() == 0 || budget == 0 {
                let (time, state) = (integration.interval().1, integration.state());
                let certainty = Certainty::Interpolated;
                return Ok(Outcome::Finished(NextEvent::Unfinished { time, state, certainty }));
            }
            integration.step()?;
            steps += 1;
            // In the common case neither the stages of the interpolant nor the polynomial of a guard are computed.
            let until = integration.interval().1.min(horizon);
            if followed.iter_mut().all(|followed| self.stays_away(followed, &integration, until)) {
                continue;
            }
            let step = integration.last_step()?;
            let sides = sides_before(&followed);
            let first = self.first_on_step(&mut followed, &step, until, &mut budget)?;
            let Some(Finding { found, time, followed, leaving }) = first else { continue };
            let first_step = SHORTER_FIRST_STEP * time;
            let hidden = leaving || matches!(found, Found::Touch { .. } | Found::Undecided { .. });
            if hidden && step.from == 0.0 && first_step > 0.0 && first_step < SHORTER * step.to {
                return Ok(Outcome::Hidden { first_step });
            }
            let surface = followed.guard.surface;
            let name = || format!("{surface:?}");
            let value = |state: &T::State| self.system.guard_value(surface, state);
            let accuracy = Accuracy { tolerances: self.tolerances, steps };
            let kind = match found {
                _ if leaving => {
                    let (surface, looked) = (name(), Looked::OnSteps);
                    return Err(Error::UndecidedStart { surface, interval: time, looked });
                }
                Found::Touch { value, .. } | Found::Undecided { value, .. }
                    if followed.guard.touch == Touch::Error =>
                {
                    return Err(Error::Grazing { surface: name(), time, value });
                }
                Found::Touch { .. } | Found::Undecided { .. } => EventKind::Touch,
                _ => EventKind::Crossing,
            };
            let (time, on_step) = match found {
                Found::Crossing { error, .. } => {
                    polished(&mut integration, &step, (time, error), until, value)?
                }
                _ => (time, CorrectedStep::uncorrected(&step)),
            };
            if let Some((time, sooner)) = self.sooner_on(&on_step, (Some(surface), time), &sides)? {
                let event = (sooner, EventKind::Crossing);
                let crossing = self.crossing(&on_step, (time, 0.0), event, accuracy);
                return Ok(Outcome::Finished(NextEvent::Crossing(crossing)));
            }
            // On the step itself the polished values show how long rounding hides the guard.
            let hidden = match found {
                Found::Touch { error, .. } => error,
                Found::Crossing { error, hidden: true, .. } if time - error < step.from => error,
                _ => 0.0,
            };
            let crossing = self.crossing(&on_step, (time, hidden), (surface, kind), accuracy);
            return Ok(Outcome::Finished(NextEvent::Crossing(crossing)));
        }
        self.at_horizon(&followed, integration, steps).map(Outcome::Finished)
    }

    /// How a guard starts: on a side, or on its surface.
    fn follow(
        &self,
        guard: Guard<T::Surface>,
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
            let error = stated_or_measured(stated, start, along).max(value.abs());
            let search = ZeroSearch::before_zero(direction, 0.0, side, error);
            return Ok(Followed { guard, stated: stated.unwrap_or(0.0), search });
        }
        let known = self.request.side(surface);
        let search = match side_of_surface(start, stated, along) {
            Some(side) if known.is_none() => ZeroSearch::on_side(direction, 0.0, side),
            _ => {
                // An exact zero has no error of its own.
                let error =
                    if value == 0.0 { 0.0 } else { stated_or_measured(stated, start, along) };
                let side = known.or_else(|| guard_rate(start, rate, error, along).map(f64::signum));
                ZeroSearch::leaving(direction, (0.0, value), error, side)
            }
        };
        Ok(Followed { guard, stated: stated.unwrap_or(0.0), search })
    }

    /// True if the guard stays on its side along the last step, as far as a few values show: the smallest distance from
    /// zero is more than half of the difference between the largest and the smallest. The search then moves to `until`.
    ///
    /// This test is no bound. A dip to zero and back is visible in the values if it takes an eighth of the step.
    fn stays_away<F>(
        &self,
        followed: &mut Followed<T::Surface>,
        integration: &Integration<F, T::State>,
        until: f64,
    ) -> bool
    where
        F: Fn(f64, &T::State) -> T::State,
    {
        let Some(side) = followed.search.clear_side() else { return false };
        let (from, to) = integration.interval();
        if to - from > PARTS * self.tolerances.check_interval {
            return false;
        }
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0);
        for state in integration.samples() {
            let distance = side * self.system.guard_value(followed.guard.surface, &state);
            // The condition is also true for NaN, which the polynomial's test then returns as an error.
            if !(distance > 0.0) {
                return false;
            }
            nearest = if distance < nearest { distance } else { nearest };
            farthest = if distance > farthest { distance } else { farthest };
        }
        let away = AWAY * nearest > farthest - nearest;
        if away {
            followed.search = ZeroSearch::on_side(followed.guard.direction, until, side);
        }
        away
    }

    /// The first crossing or touch of all guards on a step, no later than `until`. Of two at the same instant, that of the
    /// guard that is listed first.
    fn first_on_step<'a>(
        &self,
        followed: &'a mut [Followed<T::Surface>],
        step: &Step<T::State>,
        until: f64,
        budget: &mut usize,
    ) -> Result<Option<Finding<'a, T::Surface>>, Error> {
        let mut first: Option<Finding<T::Surface>> = None;
        let mut failure: Option<(f64, Error)> = None;
        for followed in followed.iter_mut() {
            let guard = followed.guard;
            let on_step = self.on_step(step, guard.surface, followed.stated);
            let horizon = until >= self.request.horizon;
            let found = loop {
                match followed.search.advance(&on_step, until, horizon, budget) {
                    Ok(Found::Touch { .. } | Found::Undecided { .. })
                        if guard.touch == Touch::Ignore => {}
                    // A crossing that leaves its surface has no event.
                    Ok(Found::Crossing { .. })
                        if followed.search.left_hidden() && guard.role == Role::Crossing => {}
                    other => break other,
                }
            };
            let time = match &found {
                Ok(
                    Found::Crossing { time, .. }
                    | Found::Touch { time, .. }
                    | Found::Undecided { time, .. },
                ) => *time,
                Ok(Found::Nothing | Found::BudgetEnded) => continue,
                // A region without values: an event before it counts.
                Err(Error::NotFinite { at, .. }) => *at,
                Err(_) => {
                    return Err(found
                        .err()
                        .unwrap_or(Error::UndecidedSign { order: 0, value: 0.0 }));
                }
            };
            match found {
                Ok(found) if first.as_ref().is_none_or(|first| time < first.time) => {
                    let leaving =
                        matches!(found, Found::Crossing { .. }) && followed.search.left_hidden();
                    first = Some(Finding { found, time, followed, leaving });
                }
                Err(error) if failure.as_ref().is_none_or(|(first, _)| time < *first) => {
                    failure = Some((time, error));
                }
                // Later than another one.
                _ => {}
            }
        }
        match failure {
            Some((time, error)) if first.as_ref().is_none_or(|first| time < first.time) => {
                Err(error)
            }
            _ => Ok(first),
        }
    }

    /// Another guard that has its zero before the event of `surface`, if any, at `time`, on the step as it is corrected there.
    ///
    /// The search compares zeros along the interpolant. The correction may exchange two of them that are nearer to each other
    /// than it is large. The next arc begins on the corrected step: a guard that has changed its sign there has had its zero.
    fn sooner_on(
        &self,
        on_step: &CorrectedStep<T::State>,
        (surface, time): (Option<T::Surface>, f64),
        sides: &[(Guard<T::Surface>, f64)],
    ) -> Result<Option<(f64, T::Surface)>, Error> {
        let mut first: Option<(f64, T::Surface)> = None;
        for &(guard, side) in sides.iter().filter(|(guard, _)| Some(guard.surface) != surface) {
            let along = |at: f64| self.system.guard_value(guard.surface, &on_step.state(at));
            let before = time.next_down().max(on_step.from());
            let [at_end, at_before] = [along(time), along(before)];
            // At the same double as the event, it comes at the same instant: the next arc begins with it.
            if !(at_end * side < 0.0 && at_before * side <= 0.0)
                || !guard.direction.admits(side, -side)
            {
                continue;
            }
            if let Some(at) = on_step.first_zero((before, at_before), side, along)?
                && first.is_none_or(|(first, _)| at < first)
            {
                first = Some((at, guard.surface));
            }
        }
        Ok(first)
    }

    /// A guard as a function of time on a step.
    fn on_step(
        &self,
        step: &Step<T::State>,
        surface: T::Surface,
        stated: f64,
    ) -> GuardOnStep<impl Fn(f64) -> f64, impl Fn(f64, f64) -> f64> {
        let value = move |state: &T::State| self.system.guard_value(surface, state);
        // The middle one of three places stands for the interval: at one of them a guard may have a rate of zero, and at
        // another one it may jump.
        let rounding = move |left: f64, right: f64| {
            let magnitude = step.magnitude();
            let size = magnitude.filled(|axis| INTERPOLANT_ROUNDING * magnitude.components()[axis]);
            let middle = left + 0.5 * (right - left);
            let mut roundings = [left, middle, right]
                .map(|time| stated + rounding_of_state(&step.state(time), &size, value));
            roundings.sort_by(f64::total_cmp);
            roundings[1]
        };
        let along = move |time: f64| value(&step.state(time));
        let checked = self.tolerances.check_interval;
        GuardOnStep::new(along, rounding, (step.from, step.to), checked)
    }

    /// The event of a surface at a time of a step, with both errors of its time.
    fn crossing(
        &self,
        on_step: &CorrectedStep<T::State>,
        (time, hidden): (f64, f64),
        (surface, kind): (T::Surface, EventKind),
        accuracy: Accuracy,
    ) -> Crossing<T::Surface, T::State> {
        let value = |state: &T::State| self.system.guard_value(surface, state);
        let stated = self.system.guard_error(surface, &on_step.state(time));
        let [before, behind] = on_step.beside(time);
        let own = rounding_beside_zero(stated, [&before, &behind], value);
        let rounding = |state: &T::State| own + rounding_of_state(state, state, value);
        let time_rounding = on_step.time_rounding((time, hidden), value, rounding);
        let time_error = on_step.time_error((time, time_rounding), value, accuracy);
        Crossing {
            surface,
            time,
            time_rounding,
            time_error,
            state: on_step.state(time),
            kind,
            certainty: Certainty::Interpolated,
        }
    }

    /// No event before the horizon. A guard on its way to the surface that is nearer to it than its rounding has its event
    /// on the horizon: the field is not evaluated beyond.
    fn at_horizon<F>(
        &self,
        followed: &[Followed<T::Surface>],
        mut integration: Integration<F, T::State>,
        steps: usize,
    ) -> Result<NextEvent<T::Surface, T::State>, Error>
    where
        F: Fn(f64, &T::State) -> T::State,
    {
        let state = integration.state();
        let certainty = Certainty::Interpolated;
        let accuracy = Accuracy { tolerances: self.tolerances, steps };
        // A guard that has changed its sign so near to the horizon that rounding hid it on the step.
        let changed = |followed: &&Followed<T::Surface>| {
            let value = self.system.guard_value(followed.guard.surface, &state);
            let admitted =
                |side: &f64| value * side < 0.0 && followed.guard.direction.admits(*side, -side);
            followed.search.known_side().is_some_and(|side| admitted(&side))
        };
        if followed.iter().any(|followed| changed(&followed)) && !integration.at_rest() {
            let sides = sides_before(followed);
            let step = integration.last_step()?;
            let on_step = CorrectedStep::uncorrected(&step);
            let first = self.sooner_on(&on_step, (None, step.to), &sides)?;
            if let Some((time, surface)) = first {
                let event = (surface, EventKind::Crossing);
                return Ok(NextEvent::Crossing(self.crossing(
                    &on_step,
                    (time, 0.0),
                    event,
                    accuracy,
                )));
            }
        }
        for Followed { guard, search, .. } in followed {
            let Some(side) = search.clear_side() else { continue };
            let surface = guard.surface;
            let value = |state: &T::State| self.system.guard_value(surface, state);
            if !guard.direction.admits(side, -side)
                || integration.at_rest()
                || !(value(&state).abs()
                    <= stated_or_measured(self.system.guard_error(surface, &state), &state, value))
            {
                continue;
            }
            let step = integration.last_step()?;
            if !(side * rate(&step, step.to, value) < 0.0) {
                continue;
            }
            let time = step.to;
            let on_step = CorrectedStep::uncorrected(&step);
            let kind = EventKind::Crossing;
            let crossing = self.crossing(&on_step, (time, 0.0), (surface, kind), accuracy);
            return Ok(NextEvent::Crossing(Crossing { state, ..crossing }));
        }
        Ok(NextEvent::None { state: Some(state), certainty })
    }
}
