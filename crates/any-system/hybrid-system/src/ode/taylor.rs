//! Solutions of fields that are formulas, by Taylor's method.

use super::flow::{between, last_time};
use super::search::search;
use super::step::Step;
use super::stepping::Stepping;
use super::tolerances::Tolerances;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::state::StateVector;
use crate::system::HybridSystem;
use equations::{Series, TaylorFlow};
use smallvec::SmallVec;

/// The states that show whether a guard that is no formula stays far from zero are this part of a step apart. More of them
/// cost values; fewer miss longer dips.
const PARTS: u32 = 16;

/// The first step towards an infinite end, where no other length is known: of a motion that is a polynomial. Each further
/// one is twice as long. The number only decides in how many pieces it is looked at.
const FIRST_PIECE: f64 = 1024.0;

/// For each searched guard its place among the watched formulas of a series.
pub(crate) type Watched = SmallVec<[Option<usize>; 8]>;

/// The states at many times along a field of formulas: as [`integrated_states`](super::integrated_states).
pub(crate) fn taylor_states<X: StateVector>(
    series: &Series,
    start: &X,
    times: &[f64],
    tolerances: &Tolerances,
) -> Result<Vec<X>, Error> {
    let Some(end) = last_time(times)? else { return Ok(Vec::new()) };
    let mut states = Vec::with_capacity(times.len());
    let mut motion = TaylorIntegration::new(series, start, end, tolerances, (Watched::new(), &[]))?;
    for &time in times {
        while !between(motion.interval().0, time, motion.interval().1) {
            motion.step()?;
        }
        states.push(match time == motion.interval().1 {
            true => motion.state(),
            false => motion.at(time),
        });
    }
    Ok(states)
}

/// The first crossing of a guard of `mode` along a field of formulas: as
/// [`integrated_crossing`](super::integrated_crossing).
pub(crate) fn taylor_crossing<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    (request, tolerances): (&Search<T::Surface>, Tolerances),
    (series, watched): (&Series, Watched),
) -> Result<NextEvent<T::Surface, T::State>, Error> {
    let integration = |longest_first: f64| {
        // The known steps are those of a search whose first step may have any length.
        let ahead = if longest_first == f64::INFINITY { request.ahead } else { &[] };
        let known = (watched.clone(), ahead);
        let motion = TaylorIntegration::new(series, start, request.horizon, &tolerances, known)?;
        Ok(TaylorIntegration { longest_first, ..motion })
    };
    let rate = system.vector_field(mode, start);
    let rate = rate.unwrap_or_else(|| start.filled(|_| f64::NAN));
    search(system, mode, (start, &rate), request, integration, tolerances)
}

/// A solution that is followed by Taylor's method, and the formulas that are watched along it.
pub(crate) struct TaylorIntegration<'s, V> {
    flow: TaylorFlow<'s>,
    step: equations::Step,
    start: V,
    end: f64,
    piece: f64,
    taken: usize,
    most: usize,
    /// The first step is no longer.
    longest_first: f64,
    watched: Watched,
    /// Steps that are known already, from the first one on.
    ahead: &'s [equations::Step],
    /// The last step, if it is one of them.
    known: Option<&'s equations::Step>,
}

/// The Taylor series of a field, followed to these tolerances.
pub(crate) fn taylor_flow<'s>(
    series: &'s Series,
    dimension: usize,
    tolerances: &Tolerances,
) -> Result<TaylorFlow<'s>, Error> {
    tolerances.check(dimension)?;
    let each = (0..dimension).map(|axis| {
        let absolute = tolerances.of(axis, 0.0);
        (absolute, tolerances.of(axis, 1.0) - absolute)
    });
    Ok(TaylorFlow::new(series, tolerances.relative.clamp(1e-17, 0.1), 0.0)?
        .tolerances(each.collect())?
        .longest_step(tolerances.longest_step)?)
}

impl<'s, V: StateVector> TaylorIntegration<'s, V> {
    /// The solution from `start` at the time zero to `end`, with the places of the searched guards among the watched
    /// formulas.
    ///
    /// # Errors
    /// As [`Integration`](super::integration::Integration).
    pub(crate) fn new(
        series: &'s Series,
        start: &V,
        end: f64,
        tolerances: &Tolerances,
        (watched, ahead): (Watched, &'s [equations::Step]),
    ) -> Result<Self, Error> {
        if end.is_nan() {
            return Err(Error::BadLimit { what: "the end of an integration", value: end });
        }
        let dimension = start.dimension();
        let (expected, found) = (series.dimension(), dimension);
        if expected != found {
            return Err(Error::Dimension { what: "the state of a field", expected, found });
        }
        let flow = taylor_flow(series, dimension, tolerances)?;
        let mut step = flow.memory()?;
        step.state_at_end.copy_from_slice(start.components());
        let (taken, most, start) = (0, tolerances.steps, start.clone());
        let (piece, longest_first) = (FIRST_PIECE, f64::INFINITY);
        Ok(TaylorIntegration {
            flow,
            step,
            start,
            end,
            piece,
            taken,
            most,
            longest_first,
            watched,
            ahead,
            known: None,
        })
    }

    /// The last step.
    fn last(&self) -> &equations::Step {
        self.known.unwrap_or(&self.step)
    }

    /// The state at a time in the last step.
    pub(crate) fn at(&self, time: f64) -> V {
        let since = time - self.last().time;
        let mut series = self.last().coefficients.states();
        self.start.filled(|_| series.next().map_or(f64::NAN, |own| equations::horner(own, since)))
    }
}

impl<V: StateVector> Stepping<V> for TaylorIntegration<'_, V> {
    fn step(&mut self) -> Result<(), Error> {
        let time = self.last().end;
        let failed = |reason| Err(Error::Integration { reason, time });
        if self.ended() {
            return failed("the end has been reached");
        }
        if self.steps_left() == 0 {
            return failed("no steps are left");
        }
        self.taken += 1;
        if let Some(known) = self.ahead.get(self.taken - 1) {
            self.known = Some(known);
            return Ok(());
        }
        let first = self.taken == 1 && self.longest_first < (self.end - time).abs();
        let end = if first {
            time + self.longest_first.copysign(self.end)
        } else if self.end.is_infinite() {
            time + self.piece.copysign(self.end)
        } else {
            self.end
        };
        let state: SmallVec<[f64; 8]> = SmallVec::from_slice(&self.last().state_at_end);
        self.known = None;
        match self.flow.step(time, &state, end, &mut self.step) {
            Ok(()) => {
                if self.last().end == end {
                    self.piece *= 2.0;
                }
                Ok(())
            }
            Err(equations::Error::Stuck { .. }) => failed("no step is short enough"),
            Err(error) => Err(error.into()),
        }
    }

    fn interval(&self) -> (f64, f64) {
        (self.last().time, self.last().end)
    }

    fn state(&self) -> V {
        self.start.filled(|axis| self.last().state_at_end[axis])
    }

    fn slope(&self) -> V {
        self.start.filled(|axis| self.last().rate_at_end[axis])
    }

    fn enlarge(&self, sizes: &mut V) {
        for (size, component) in sizes.components_mut().iter_mut().zip(&self.last().state_at_end) {
            *size = size.max(component.abs());
        }
    }

    fn ended(&self) -> bool {
        self.last().end == self.end
    }

    fn at_rest(&self) -> bool {
        self.taken > 0 && self.last().rate_at_end.iter().all(|rate| *rate == 0.0)
    }

    fn steps_left(&self) -> usize {
        self.most.saturating_sub(self.taken)
    }

    fn samples(&self) -> impl Iterator<Item = V> {
        let (from, to) = self.interval();
        (0..=PARTS).map(move |k| self.at(from + (to - from) * f64::from(k) / f64::from(PARTS)))
    }

    fn last_step(&mut self) -> Result<Step<V>, Error> {
        Ok(Step::of_powers(self.interval(), &self.start, self.last().coefficients.states()))
    }

    fn directly_at(&mut self, _: f64) -> Option<Result<V, Error>> {
        None
    }

    fn state_on_step(&self, time: f64) -> Option<V> {
        Some(self.at(time))
    }

    fn guard(&self, place: usize) -> Option<&[f64]> {
        let watched = (*self.watched.get(place)?)?;
        self.last().is_trusted(watched).then(|| self.last().coefficients.watched(watched))
    }
}
