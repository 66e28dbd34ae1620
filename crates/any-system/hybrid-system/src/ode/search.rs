//! The first event of all guards of a mode along an integrated flow.

use super::pass::{Followed, GUARDS_ON_STACK, Pass, sides_before};
use super::polish::{Accuracy, CorrectedStep, polished};
use super::step::Step;
use super::stepping::Stepping;
use super::tolerances::Tolerances;
use crate::crossing::{Certainty, EventKind, Found, NextEvent, Search};
use crate::error::Error;
use crate::guard::{Guard, Role, Touch};
use crate::looked::Looked;
use crate::state::StateVector;
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
struct Finding<S> {
    found: Found,
    time: f64,
    followed: Followed<S>,
    /// The guard had not left the zero at its start.
    leaving: bool,
}

/// A step on which something is found.
struct OnStep<'a, S, X> {
    step: &'a Step<X>,
    /// The search ends here.
    until: f64,
    /// The number of steps from the start, and the largest components at their ends.
    steps: usize,
    sizes: &'a X,
    /// The guards as they are where the step begins.
    before: &'a [Followed<S>],
}

/// How long rounding hides a guard before what is found. On the step itself the polished values show it.
fn hidden_time(found: &Found, time: f64, from: f64) -> f64 {
    match *found {
        Found::Touch { error, .. } => error,
        Found::Crossing { error, hidden: true, .. } if time - error < from => error,
        _ => 0.0,
    }
}

/// The result of a search with one choice of the first step.
enum Outcome<S, X> {
    Finished(NextEvent<S, X>),
    /// Rounding hides an event on the first step; on a first step of this length it may be visible.
    Hidden {
        first_step: f64,
    },
}

type OutcomeOf<T> = Outcome<<T as HybridSystem>::Surface, <T as HybridSystem>::State>;

/// Follows an integration from `start`, where the field is `rate`, until a guard of `mode` has an event, or to the horizon
/// of `request`. `integration` begins one up to the horizon, with a first step no longer than its argument.
pub(super) fn search<T, I>(
    system: &T,
    mode: T::Mode,
    (start, rate): (&T::State, &T::State),
    request: &Search<T::Surface>,
    integration: impl Fn(f64) -> Result<I, Error>,
    tolerances: Tolerances,
) -> Result<NextEvent<T::Surface, T::State>, Error>
where
    T: HybridSystem + ?Sized,
    I: Stepping<T::State>,
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
        let pass = Pass { system, mode, request, tolerances };
        match pass.run(start, rate, integration(first_step)?)? {
            Outcome::Finished(next) => return Ok(next),
            Outcome::Hidden { first_step: shorter } => first_step = shorter,
        }
    }
}

impl<T: HybridSystem + ?Sized> Pass<'_, T> {
    fn run(
        &self,
        start: &T::State,
        rate: &T::State,
        mut integration: impl Stepping<T::State>,
    ) -> Result<Outcome<T::Surface, T::State>, Error> {
        let horizon = self.request.horizon;
        let mut budget = self.request.intervals;
        let mut followed: SmallVec<[Followed<T::Surface>; GUARDS_ON_STACK]> = SmallVec::new();
        let guards = self.system.guards(self.mode).iter();
        for placed in guards.filter(|guard| guard.role != Role::Clock).copied().enumerate() {
            followed.push(self.follow(placed, start, rate)?);
        }
        let mut steps = 0;
        let mut sizes = start.filled(|axis| start.components()[axis].abs());
        while !integration.ended() && !integration.at_rest() {
            if steps >= self.request.steps || integration.steps_left() == 0 || budget == 0 {
                let (time, state) = (integration.interval().1, integration.state());
                let certainty = Certainty::Interpolated;
                return Ok(Outcome::Finished(NextEvent::Unfinished { time, state, certainty }));
            }
            integration.step()?;
            integration.enlarge(&mut sizes);
            steps += 1;
            // In the common case neither the stages of the interpolant nor the polynomial of a guard are computed.
            let until = integration.interval().1.min(horizon);
            if followed.iter_mut().all(|followed| self.stays_away(followed, &integration, until)) {
                continue;
            }
            let step = integration.last_step()?;
            let before = followed.clone();
            let mut restart = before.clone();
            while let Some(finding) =
                self.first_on_step(&mut followed, &step, &integration, (until, &mut budget))?
            {
                let on_step = OnStep { step: &step, until, steps, sizes: &sizes, before: &before };
                if let Some(outcome) = self.event(&finding, &mut integration, &on_step)? {
                    return Ok(outcome);
                }
                // The searches of the other guards begin anew on this step, behind what each of them has passed: two
                // guards that are on their way to their zeros must not bring each other back.
                let passed = finding.followed.guard.surface;
                for (now, restart) in followed.iter_mut().zip(&mut restart) {
                    match now.guard.surface == passed {
                        true => *restart = *now,
                        false => *now = *restart,
                    }
                }
            }
        }
        self.at_horizon(&followed, integration, (steps, &sizes)).map(Outcome::Finished)
    }

    /// What is found first on a step, on the step as it is corrected there; `None` if it is no event: the guard
    /// crosses its surface in the direction that does not count, or it is still on its way to it where the search ends.
    fn event(
        &self,
        finding: &Finding<T::Surface>,
        integration: &mut impl Stepping<T::State>,
        on_step: &OnStep<T::Surface, T::State>,
    ) -> Result<Option<OutcomeOf<T>>, Error> {
        let Finding { ref found, time, ref followed, leaving } = *finding;
        let OnStep { step, until, steps, sizes, before } = *on_step;
        let shorter = |time: f64| {
            let first_step = SHORTER_FIRST_STEP * time;
            let is_shorter = step.from == 0.0 && first_step > 0.0 && first_step < SHORTER * step.to;
            is_shorter.then_some(Outcome::Hidden { first_step })
        };
        let hidden = leaving || matches!(found, Found::Touch { .. } | Found::Undecided { .. });
        if hidden && let Some(outcome) = shorter(time) {
            return Ok(Some(outcome));
        }
        let surface = followed.guard.surface;
        // Rounding hides the guard up to the end of the search, but it is still on its way to its zero.
        if matches!(found, Found::Undecided { .. })
            && let Some(side) = followed.search.known_side()
            && self.approaches(surface, side, integration)
        {
            return Ok(None);
        }
        let name = || format!("{surface:?}");
        let value = |state: &T::State| self.system.guard_value(surface, state);
        let accuracy = Accuracy { tolerances: self.tolerances, steps, sizes };
        let kind = match *found {
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
        let (time, corrected) = match *found {
            Found::Crossing { error, rising, .. } => {
                let polished = polished(integration, step, (time, error), until, value)?;
                if polished.1.is_no_crossing(polished.0, rising, value) {
                    return Ok(None);
                }
                polished
            }
            _ => (time, CorrectedStep::uncorrected(step)),
        };
        let mut sides = sides_before(before);
        if kind == EventKind::Touch {
            sides.retain(|(guard, _)| guard.surface != surface);
        }
        let found_first = (Some(surface), time);
        let (time, hidden, event) = match self.sooner_on(&corrected, found_first, &sides)? {
            Some((time, sooner, side)) => (time, 0.0, (sooner, EventKind::Crossing, Some(side))),
            None => (time, hidden_time(found, time, step.from), (surface, kind, found.from())),
        };
        let crossing = self.crossing(&corrected, (time, hidden), event, accuracy);
        // An event at the start itself: the rounding of a long first step hides a flight that is shorter.
        if time == 0.0
            && let Some(outcome) = shorter(crossing.time_rounding)
        {
            return Ok(Some(outcome));
        }
        Ok(Some(Outcome::Finished(NextEvent::Crossing(crossing))))
    }

    /// The first crossing or touch of all guards on a step, no later than `until`. Of two at the same instant, that
    /// of the guard that is listed first.
    fn first_on_step(
        &self,
        followed: &mut [Followed<T::Surface>],
        step: &Step<T::State>,
        integration: &impl Stepping<T::State>,
        (until, budget): (f64, &mut usize),
    ) -> Result<Option<Finding<T::Surface>>, Error> {
        let mut first: Option<Finding<T::Surface>> = None;
        let mut failure: Option<(f64, Error)> = None;
        for followed in followed.iter_mut() {
            let guard = followed.guard;
            let powers = self.polynomial(followed, integration);
            let on_step = self.on_step(step, guard.surface, followed.stated, powers);
            let is_last = until >= self.request.horizon;
            let found = loop {
                match followed.search.advance(&on_step, until, is_last, budget) {
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
                    let followed = *followed;
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
