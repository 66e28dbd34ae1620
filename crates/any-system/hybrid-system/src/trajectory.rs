//! An execution as arrays: sampled states, and events in columns.

use crate::arc::{Arc, ArcEnd};
use crate::crossing::{Certainty, EventKind};
use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::state::StateVector;
use crate::system::HybridSystem;
use nalgebra::DMatrix;
use std::fmt::Debug;

/// An execution, sampled: one row for each sample. Arrays of equal length, as plotting programs take them.
///
/// Every arc has a row at its start and a row at its end, so that each event has both of its one-sided states: x⁻
/// at (t, j) and x⁺ at (t, j + 1). Between them are the times of the grid. An arc of no duration has one row, an
/// arc that never ends has none at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory<M, S> {
    /// Continuous time t of each row, in ascending order.
    pub times: Vec<f64>,
    /// Number of events before each row, j.
    pub jumps: Vec<usize>,
    /// The mode of each row.
    pub modes: Vec<M>,
    /// The states: one row for each sample, one column for each component.
    pub states: DMatrix<f64>,
    /// True for one row at each time of the grid, also if the grid has it twice. At the time of an event it is the
    /// row after the last jump of that instant.
    pub on_grid: Vec<bool>,
    /// The events, in columns.
    pub events: EventColumns<M, S>,
}

/// Events in columns: one entry of each vector, and one row of each matrix, for each event.
#[derive(Debug, Clone, PartialEq)]
pub struct EventColumns<M, S> {
    /// Continuous time t.
    pub times: Vec<f64>,
    /// The surface.
    pub surfaces: Vec<S>,
    /// The mode before the event.
    pub modes: Vec<M>,
    /// The mode after the event; `None` for an event that ends the execution.
    pub next_modes: Vec<Option<M>>,
    /// The state before each event, x⁻.
    pub before: DMatrix<f64>,
    /// The state after each event, x⁺; the state before, for an event that ends the execution.
    pub after: DMatrix<f64>,
    /// Crossing, touch, event at once, or preset time.
    pub kinds: Vec<EventKind>,
    /// How certain it is that no event came before.
    pub certainties: Vec<Certainty>,
}

impl<T: HybridSystem> Execution<'_, T> {
    /// The rest of the execution as arrays, with states at the times of `grid`, which are continuous times t in
    /// ascending order. Times before the first arc or after the last one have no row.
    ///
    /// Along an integrated arc all states take one integration.
    ///
    /// ```
    /// use hybrid_system::*;
    ///
    /// let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
    ///     .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
    ///     .sampled(0.01);
    /// let trajectory = ball.run((), [0.5, 0.0], 1.5).trajectory(&[0.0, 0.5, 1.0, 1.5])?;
    /// // The bounce at 1 has two rows.
    /// assert_eq!(trajectory.times, [0.0, 0.5, 1.0, 1.0, 1.5]);
    /// assert_eq!(trajectory.jumps, [0, 0, 0, 1, 1]);
    /// assert_eq!(trajectory.on_grid, [true, true, false, true, true]);
    /// assert_eq!(trajectory.states.column(1).as_slice(), [0.0, -0.5, -1.0, 0.5, 0.0]);
    /// assert_eq!(trajectory.events.times, [1.0]);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadLimit`] for a grid that is not in ascending order, or not finite; [`Error::Dimension`] if an event changes
    /// the number of components, for which a [`Solution`](crate::Solution) has no such limit; the errors of the execution, and
    /// those of [`Arc::states`].
    pub fn trajectory(&mut self, grid: &[f64]) -> Result<Trajectory<T::Mode, T::Surface>, Error> {
        let from = (self.at.time.value(), self.at.state.dimension());
        trajectory(self.system, from, self.by_ref(), grid)
    }
}

/// The rows of arcs that begin at a time, with states of a dimension.
pub(crate) fn trajectory<T: HybridSystem>(
    system: &T,
    (start, dimension): (f64, usize),
    arcs: impl Iterator<Item = Result<AnArc<T>, Error>>,
    grid: &[f64],
) -> Result<Trajectory<T::Mode, T::Surface>, Error> {
    check_grid(grid)?;
    let mut rows = Rows::new(dimension);
    // Times before the start have no row.
    let mut next = grid.partition_point(|&time| time < start);
    let mut last_end = None;
    for arc in arcs {
        let arc = arc?;
        let (expected, found) = (rows.dimension, arc.start.dimension());
        if expected != found {
            return Err(Error::Dimension { what: "a state of the run", expected, found });
        }
        let end = end_of(&arc);
        rows.arc(system, &arc, end, &grid[next..])?;
        // Grid times at the end belong to the next arc, if there is one.
        next += grid[next..].partition_point(|&time| time < end);
        last_end = Some(end);
    }
    // Grid times at the end of the last arc.
    if let (Some(last), Some(end)) = (rows.on_grid.last_mut(), last_end) {
        *last |= grid.get(next) == Some(&end);
    }
    Ok(rows.trajectory())
}

pub(crate) fn check_grid(grid: &[f64]) -> Result<(), Error> {
    let what = "a time of a grid, which must be finite and in ascending order,";
    let out_of_order = grid.windows(2).find(|pair| !(pair[0] <= pair[1])).map(|pair| pair[1]);
    match grid.iter().copied().find(|time| !time.is_finite()).or(out_of_order) {
        Some(value) => Err(Error::BadLimit { what, value }),
        None => Ok(()),
    }
}

/// Time at the end of an arc.
pub(crate) fn end_of<M, S, X>(arc: &Arc<M, S, X>) -> f64 {
    match &arc.end {
        ArcEnd::Event(event) => event.time,
        ArcEnd::Zeno { limit, .. } => limit.time,
        ArcEnd::Sliding { sliding, .. } => sliding.time,
        ArcEnd::Never { .. } | ArcEnd::TimeLimit { .. } | ArcEnd::Unfinished { .. } => {
            arc.time + arc.duration
        }
    }
}

/// Rows of a trajectory, as they are collected. States are stored component by component, row after row.
struct Rows<M, S> {
    dimension: usize,
    times: Vec<f64>,
    jumps: Vec<usize>,
    modes: Vec<M>,
    states: Vec<f64>,
    on_grid: Vec<bool>,
    event_times: Vec<f64>,
    surfaces: Vec<S>,
    event_modes: Vec<M>,
    next_modes: Vec<Option<M>>,
    before: Vec<f64>,
    after: Vec<f64>,
    kinds: Vec<EventKind>,
    certainties: Vec<Certainty>,
}

impl<M: Copy + Eq + Debug, S: Copy + Eq + Debug> Rows<M, S> {
    fn new(dimension: usize) -> Self {
        Rows {
            dimension,
            times: Vec::new(),
            jumps: Vec::new(),
            modes: Vec::new(),
            states: Vec::new(),
            on_grid: Vec::new(),
            event_times: Vec::new(),
            surfaces: Vec::new(),
            event_modes: Vec::new(),
            next_modes: Vec::new(),
            before: Vec::new(),
            after: Vec::new(),
            kinds: Vec::new(),
            certainties: Vec::new(),
        }
    }

    /// The rows of an arc, with the first of the times that are not before it.
    fn arc<T>(
        &mut self,
        system: &T,
        arc: &Arc<M, S, T::State>,
        end: f64,
        grid: &[f64],
    ) -> Result<(), Error>
    where
        T: HybridSystem<Mode = M, Surface = S>,
    {
        let at_start = grid.iter().take_while(|&&time| time <= arc.time && time < end).count();
        self.push(arc.time, arc, arc.start.components(), at_start > 0);
        self.event(arc);
        if end <= arc.time {
            return Ok(());
        }
        let mut between = grid[at_start..grid.partition_point(|&time| time < end)].to_vec();
        between.dedup();
        let last_state = match &arc.end {
            ArcEnd::Event(event) => Some(&event.before),
            ArcEnd::Sliding { sliding, .. } => Some(&sliding.state),
            ArcEnd::Zeno { limit, .. } => {
                // The arc replaces infinitely many. All their states are as close to its start as to the limit.
                between.iter().for_each(|&time| self.push(time, arc, arc.start.components(), true));
                self.push(end, arc, limit.state.components(), false);
                return Ok(());
            }
            ArcEnd::Never { .. } | ArcEnd::TimeLimit { .. } | ArcEnd::Unfinished { .. } => None,
        };
        let mut elapsed: Vec<f64> = between.iter().map(|time| time - arc.time).collect();
        if last_state.is_none() && end.is_finite() {
            elapsed.push(arc.duration);
        }
        let states = arc.states(system, &elapsed)?;
        for (&time, state) in between.iter().zip(&states) {
            self.push(time, arc, state.components(), true);
        }
        if let Some(state) = last_state.or_else(|| states.get(between.len())) {
            self.push(end, arc, state.components(), false);
        }
        Ok(())
    }

    fn push<X>(&mut self, time: f64, arc: &Arc<M, S, X>, state: &[f64], on_grid: bool) {
        self.times.push(time);
        self.jumps.push(arc.jump);
        self.modes.push(arc.mode);
        self.states.extend_from_slice(state);
        self.on_grid.push(on_grid);
    }

    fn event<X: StateVector>(&mut self, arc: &Arc<M, S, X>) {
        let Some(event) = arc.event() else { return };
        self.event_times.push(event.time);
        self.surfaces.push(event.surface);
        self.event_modes.push(arc.mode);
        self.next_modes.push(event.after.as_ref().map(|after| after.0));
        self.before.extend_from_slice(event.before.components());
        let after = event.after.as_ref().map_or(&event.before, |after| &after.1);
        self.after.extend_from_slice(after.components());
        self.kinds.push(event.kind);
        self.certainties.push(event.certainty);
    }

    fn trajectory(self) -> Trajectory<M, S> {
        let matrix = |rows: usize, components: &[f64]| {
            DMatrix::from_row_slice(rows, self.dimension, components)
        };
        Trajectory {
            states: matrix(self.times.len(), &self.states),
            events: EventColumns {
                before: matrix(self.event_times.len(), &self.before),
                after: matrix(self.event_times.len(), &self.after),
                times: self.event_times,
                surfaces: self.surfaces,
                modes: self.event_modes,
                next_modes: self.next_modes,
                kinds: self.kinds,
                certainties: self.certainties,
            },
            times: self.times,
            jumps: self.jumps,
            modes: self.modes,
            on_grid: self.on_grid,
        }
    }
}
