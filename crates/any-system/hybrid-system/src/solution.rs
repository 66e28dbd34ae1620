//! A whole run as a function of time.

use crate::arc::{Arc, ArcEnd, Event};
use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::state::StateVector;
use crate::system::HybridSystem;
use crate::trajectory::{Trajectory, check_grid, end_of, trajectory};

/// Mode and state of a system.
pub type Place<T> = (<T as HybridSystem>::Mode, <T as HybridSystem>::State);

/// A whole run as a function of the time t: its arcs, one after the other.
///
/// ```
/// use hybrid_system::*;
/// let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
///     .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
///     .sampled(0.01);
/// let run = ball.run((), [0.5, 0.0], 1.9).solution()?;
/// // Between two events there is one state. At the landing there are two: before and after it.
/// let [before, after] = run.at(0.5)?;
/// assert_eq!((before.1[1], after.1[1]), (-0.5, -0.5));
/// let [before, after] = run.at(1.0)?;
/// assert_eq!((before.1[1], after.1[1]), (-1.0, 0.5));
/// assert_eq!(run.states(&[0.0, 1.0, 1.5])?[1][1], 0.5);
/// assert_eq!(run.counts(), [(0, 1)]);
/// # Ok::<(), Error>(())
/// ```
///
/// With the feature `serde` the arcs are written and read by serde, and [`new`](Self::new) takes those that were read.
#[derive(Debug, Clone)]
pub struct Solution<'a, T: HybridSystem> {
    system: &'a T,
    arcs: Vec<AnArc<T>>,
}

impl<'a, T: HybridSystem> Execution<'a, T> {
    /// The rest of the execution as a function of time.
    ///
    /// # Errors
    /// That of the execution, if it ends in one. To keep the arcs before it, collect them, and use [`Solution::new`].
    pub fn solution(self) -> Result<Solution<'a, T>, Error> {
        let system = self.system;
        Solution::new(system, self.collect::<Result<_, _>>()?)
    }
}

impl<'a, T: HybridSystem> Solution<'a, T> {
    /// The run with these arcs of a system. Only their times are checked: arcs of another system give wrong states.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for no arc, and for a time of an arc that is not the end of the arc before it.
    pub fn new(system: &'a T, arcs: Vec<AnArc<T>>) -> Result<Self, Error> {
        let what = "the number of arcs of a run";
        let Some(first) = arcs.first() else {
            return Err(Error::BadLimit { what, value: 0.0 });
        };
        let mut end = first.time;
        for arc in &arcs {
            // The end of an arc is its time and its duration, rounded.
            let near = (arc.time - end).abs() <= f64::EPSILON * end.abs();
            if !near || !(arc.duration >= 0.0) || !(end_of(arc) >= arc.time) {
                let what = "the time of an arc, which must be the end of the arc before it,";
                return Err(Error::BadLimit { what, value: arc.time });
            }
            end = end_of(arc);
        }
        Ok(Solution { system, arcs })
    }

    /// The arcs, in their order.
    pub fn arcs(&self) -> &[AnArc<T>] {
        &self.arcs
    }

    /// The events, in their order.
    pub fn events(&self) -> impl Iterator<Item = &Event<T::Mode, T::Surface, T::State>> {
        self.arcs.iter().filter_map(Arc::event)
    }

    /// The number of events of each surface that has some, in the order of their first events.
    pub fn counts(&self) -> Vec<(T::Surface, usize)> {
        let mut counts: Vec<(T::Surface, usize)> = Vec::new();
        for event in self.events() {
            match counts.iter_mut().find(|(surface, _)| *surface == event.surface) {
                Some((_, count)) => *count += 1,
                None => counts.push((event.surface, 1)),
            }
        }
        counts
    }

    /// The run as arrays, as [`Execution::trajectory`] gives them.
    ///
    /// # Errors
    /// As there.
    pub fn trajectory(&self, grid: &[f64]) -> Result<Trajectory<T::Mode, T::Surface>, Error> {
        let (start, first) = (self.times().0, self.arcs.first());
        let dimension = first.map_or(0, |arc| arc.start.dimension());
        trajectory(self.system, (start, dimension), self.arcs.iter().cloned().map(Ok), grid)
    }

    /// The time at which it starts, and that at which it ends, which may be infinite.
    pub fn times(&self) -> (f64, f64) {
        let (first, last) = (self.arcs.first(), self.arcs.last());
        (first.map_or(f64::NAN, |arc| arc.time), last.map_or(f64::NAN, end_of))
    }

    /// The limits from the left and from the right: mode and state before all events at the time, and after them. They are
    /// the states of the arcs, to the last bit. At the start, the first of both is the first state. If an event ends the run, both
    /// are the state before it. Inside an arc up to a Zeno limit, which replaces infinitely many, both are its first state.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for a time before the start or after the end; those of [`Arc::state`].
    pub fn at(&self, time: f64) -> Result<[Place<T>; 2], Error> {
        let time = self.check(time)?;
        // The first arc that ends at the time or later, and the last one that starts there or earlier.
        let first = self.arcs.partition_point(|arc| end_of(arc) < time).min(self.arcs.len() - 1);
        let last = self.arcs.partition_point(|arc| arc.time <= time).max(1) - 1;
        let before = match (first, time <= self.arcs[first].time) {
            (0, true) => (self.arcs[0].mode, self.arcs[0].start.clone()),
            _ => self.on(&self.arcs[first], time)?,
        };
        let arc = &self.arcs[last];
        let after = match &arc.end {
            _ if time < end_of(arc) => None,
            ArcEnd::Event(event) => event.after.clone(),
            ArcEnd::Zeno { after, .. } | ArcEnd::Sliding { after, .. } => after.clone(),
            _ => None,
        };
        let after = after.map_or_else(|| self.on(arc, time), Ok)?;
        Ok([before, after])
    }

    /// The states at the times of a grid, in ascending order: after all events at each of them. An integrated arc is
    /// integrated once.
    ///
    /// # Errors
    /// As [`at`](Self::at); [`Error::BadLimit`] for times that are not in order.
    pub fn states(&self, grid: &[f64]) -> Result<Vec<T::State>, Error> {
        check_grid(grid)?;
        let grid: Vec<f64> = grid.iter().map(|&time| self.check(time)).collect::<Result<_, _>>()?;
        let mut states = Vec::with_capacity(grid.len());
        while states.len() < grid.len() {
            let rest = &grid[states.len()..];
            let arc = &self.arcs[self.arcs.partition_point(|arc| arc.time <= rest[0]).max(1) - 1];
            // Those inside the arc. An arc that replaces infinitely many has no flow.
            let end = if matches!(arc.end, ArcEnd::Zeno { .. }) { arc.time } else { end_of(arc) };
            let inside = rest.partition_point(|&time| time < end);
            match inside {
                0 => states.push({
                    let [_, (_, after)] = self.at(rest[0])?;
                    after
                }),
                _ => {
                    let since: Vec<f64> =
                        rest[..inside].iter().map(|time| time - arc.time).collect();
                    states.extend(arc.states(self.system, &since)?);
                }
            }
        }
        Ok(states)
    }

    /// An error outside of the run. The limit on time may be a rounding later than the sum of the durations.
    fn check(&self, time: f64) -> Result<f64, Error> {
        let (start, end) = self.times();
        let rounded = time > end && time - end <= 2.0 * f64::EPSILON * end.abs();
        match time >= start && (time <= end || rounded) && time.is_finite() {
            true => Ok(time.min(end)),
            false => Err(Error::BadLimit { what: "a time outside of the run,", value: time }),
        }
    }

    /// Mode and state on an arc, before the event at its end.
    fn on(&self, arc: &AnArc<T>, time: f64) -> Result<Place<T>, Error> {
        let is_over = time >= end_of(arc);
        let state = match &arc.end {
            _ if time <= arc.time && arc.duration > 0.0 => arc.start.clone(),
            ArcEnd::Event(event) if is_over => event.before.clone(),
            ArcEnd::Zeno { limit, .. } if is_over => limit.state.clone(),
            ArcEnd::Sliding { sliding, .. } if is_over => sliding.state.clone(),
            ArcEnd::Zeno { .. } => arc.start.clone(),
            _ if is_over => arc.state(self.system, arc.duration)?,
            _ => arc.state(self.system, time - arc.time)?,
        };
        Ok((arc.mode, state))
    }
}
