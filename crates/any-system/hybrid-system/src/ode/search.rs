//! The first event of all guards of a mode along an integrated flow.

use super::integration::Integration;
use super::pass::{Followed, GUARDS_ON_STACK, Pass, sides_before};
use super::polish::{Accuracy, CorrectedStep, polished};
use super::step::Step;
use super::tolerances::Tolerances;
use crate::crossing::{Certainty, EventKind, Found, NextEvent, Search};
use crate::error::Error;
use crate::guard::{Guard, Role, Touch};
use crate::looked::Looked;
use crate::system::HybridSystem;
use smallvec::SmallVec;

/// If rounding hides the guard at a time on the first step, and this multiple of the time is shorter than the step,
/// the search is repeated with a first step of that length: the rounding of an interpolant shrinks with its step,
/// until only the rounding of the state is left. The hidden time then lies in the middle of the step. A smaller
/// number might end the step before it, a larger one leaves more rounding.
const SHORTER_FIRST_STEP: f64 = 2.0;

/// A repetition must shorten the first step by this factor at least, so that the repetitions end.
const SHORTER: f64 = 0.5;

/// What is found first on a step.
struct Finding<'a, S> {
    found: Found,
    time: f64,
    followed: &'a Followed<S>,
    /// The guard had not left the zero at its start.
    leaving: bool,
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

    /// The first crossing or touch of all guards on a step, no later than `until`. Of two at the same instant, that
    /// of the guard that is listed first.
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
}
