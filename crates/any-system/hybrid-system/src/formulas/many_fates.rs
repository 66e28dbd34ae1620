//! The fates of many runs of equations, whose motions are followed side by side.

use super::equations::EquationsModel;
use super::label::Label;
use super::programs::ModeProgram;
use crate::error::Error;
use crate::execution::Execution;
use crate::fate::{End, FateOf, end_of_arc, in_order};
use crate::guard::{Direction, Role};
use crate::ode::{Ahead, taylor_flow};
use crate::state::StateVector;
use crate::system::HybridSystem;
use equations::{SideBySide, Step, horner};
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Runs that are followed together. In a mode eight of them move side by side, so that several times as many keep the lanes
/// full; more would leave processors without work at the end.
const TOGETHER: usize = 64;

/// The most steps of an arc that are taken before its events are searched. They are kept: more steps need more memory, and
/// behind fewer ones the rest of a long arc is followed alone.
const MOST_AHEAD: usize = 2000;

/// The most numbers that are kept of an arc in one lane: 16 MB.
const MEMORY: usize = 1 << 21;

/// The fate of a run, or why it has not begun.
type Ended<X> = Result<FateOf<EquationsModel<X>>, Error>;

impl<X: StateVector + Send + Sync> EquationsModel<X> {
    /// The [fates](Execution::fate) of many runs, as [`many`](crate::many) gives them, with the same bits and in less time: their
    /// motions are followed side by side, eight in a vector. `run` makes the execution with a
    /// number, of this model. One of another model, for example with other parameters, has its own fate too, without the gain.
    ///
    /// `progress` receives the number of runs that have finished. If it breaks, the runs that are followed at that time are
    /// finished, up to 64 on each processor; the others are `None`.
    ///
    /// ```
    /// use hybrid_system::{End, Equations, State};
    /// use std::ops::ControlFlow::Continue;
    /// let swing = Equations::new(&["angle", "speed"], &[])
    ///     .mode_text("swing", &["speed", "-sin(angle) - speed/10"])
    ///     .rising_text("over", "angle - pi")
    ///     .stops()
    ///     .model::<State<2>>()?;
    /// let run = |k| swing.start("swing", [0.0, 0.03 * k as f64], 20.0);
    /// let fates = swing.fates(100, run, |_| Continue(()));
    /// let fates = fates.into_iter().flatten().collect::<Result<Vec<_>, _>>()?;
    /// let over = fates.iter().filter(|fate| matches!(fate.end, End::Terminal(_))).count();
    /// assert_eq!(fates[99], run(99)?.fate());
    /// assert!((20..40).contains(&over));
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    pub fn fates<'m>(
        &'m self,
        runs: usize,
        run: impl Fn(usize) -> Result<Execution<'m, Self>, Error> + Sync,
        progress: impl Fn(usize) -> ControlFlow<()> + Sync,
    ) -> Vec<Option<Ended<X>>> {
        let (finished, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let note = || {
            if progress(finished.fetch_add(1, Ordering::Relaxed) + 1).is_break() {
                stopped.store(true, Ordering::Relaxed);
            }
        };
        let together = |block: usize| {
            let numbers = block * TOGETHER..runs.min((block + 1) * TOGETHER);
            match stopped.load(Ordering::Relaxed) {
                true => Some(numbers.map(|_| None).collect()),
                false => Some(Block::new(self, &numbers, note).follow(numbers, &run)),
            }
        };
        in_order(runs.div_ceil(TOGETHER), together).into_iter().flatten().flatten().collect()
    }
}

/// A run that is followed.
struct Followed<'m, X: StateVector> {
    place: usize,
    execution: Execution<'m, EquationsModel<X>>,
    /// How the last arc has ended the run.
    end: Option<End<Label>>,
    /// The time up to which its arc is to be followed in a lane.
    horizon: f64,
}

/// Some runs, each in one of the modes or at its end.
struct Block<'m, X: StateVector, N> {
    model: &'m EquationsModel<X>,
    /// For each mode the runs whose next arc is in it.
    waiting: Vec<Vec<Followed<'m, X>>>,
    results: Vec<Option<Ended<X>>>,
    note: N,
}

impl<'m, X: StateVector, N: Fn()> Block<'m, X, N> {
    fn new(model: &'m EquationsModel<X>, numbers: &Range<usize>, note: N) -> Self {
        let waiting = model.motion.programs.modes.iter().map(|_| Vec::new()).collect();
        Block { model, waiting, results: numbers.clone().map(|_| None).collect(), note }
    }

    fn follow(
        mut self,
        numbers: Range<usize>,
        run: &impl Fn(usize) -> Result<Execution<'m, EquationsModel<X>>, Error>,
    ) -> Vec<Option<Ended<X>>> {
        for (place, number) in numbers.enumerate() {
            match run(number) {
                Ok(execution) => self.sort(Followed { place, execution, end: None, horizon: 0.0 }),
                Err(error) => self.finish(place, Err(error)),
            }
        }
        // The mode in which most of them are.
        let most = |waiting: &[Vec<_>]| {
            let (mode, runs) = waiting.iter().enumerate().max_by_key(|(_, runs)| runs.len())?;
            (!runs.is_empty()).then_some(mode)
        };
        while let Some(mode) = most(&self.waiting) {
            if self.in_mode(mode).is_err() {
                // Nothing can be followed side by side; each run says why.
                std::mem::take(&mut self.waiting[mode]).into_iter().for_each(|run| self.alone(run));
            }
        }
        self.results
    }

    /// Follows a run to its end.
    fn alone(&mut self, run: Followed<'m, X>) {
        self.finish(run.place, Ok(run.execution.fate_after(run.end)));
    }

    fn finish(&mut self, place: usize, ended: Ended<X>) {
        self.results[place] = Some(ended);
        (self.note)();
    }

    /// Brings a run to the next arc that is followed in a lane, or to its end.
    fn sort(&mut self, mut run: Followed<'m, X>) {
        loop {
            // An execution of another model is followed alone.
            if std::ptr::eq(run.execution.system, self.model)
                && let Some((mode, horizon)) = arc_in_a_lane(self.programs(), &run.execution)
            {
                run.horizon = horizon;
                self.waiting[mode].push(run);
                return;
            }
            match run.execution.next() {
                Some(arc) => run.end = end_of_arc::<EquationsModel<X>>(arc),
                None => return self.alone(run),
            }
        }
    }

    /// The modes.
    fn programs(&self) -> &'m [ModeProgram] {
        &self.model.motion.programs.modes
    }

    /// Follows the runs in a mode side by side, until none is left in it.
    fn in_mode(&mut self, mode: usize) -> Result<(), Error> {
        let program = &self.programs()[mode];
        let (series, tolerances) = (&program.series, &self.model.motion.tolerances);
        let flow = taylor_flow(series, series.dimension(), tolerances)?;
        let mut motions = SideBySide::new(&flow)?;
        let outline = flow.outline()?;
        let most_ahead = MOST_AHEAD.min(MEMORY / outline.size()).max(1);
        let guards = self.model.guards(program.name).iter();
        let guards = guards.filter(|guard| guard.role != Role::Clock);
        let directions: Vec<Direction> = guards.map(|guard| guard.direction).collect();
        let mut lanes: [Option<Followed<'m, X>>; SideBySide::WIDTH] = std::array::from_fn(|_| None);
        // Memory for steps, which goes from run to run.
        let mut memory: [Ahead; SideBySide::WIDTH] = std::array::from_fn(|_| Ahead::default());
        loop {
            for (lane, place) in lanes.iter_mut().enumerate() {
                if place.is_none()
                    && let Some(mut run) = self.waiting[mode].pop()
                {
                    run.execution.ahead = std::mem::take(&mut memory[lane]);
                    run.execution.ahead.begin(run.horizon);
                    let state = run.execution.state().components().iter().copied();
                    match motions.begin(lane, 0.0, state, run.horizon) {
                        Ok(()) => *place = Some(run),
                        Err(_) => self.alone(run),
                    }
                }
            }
            if !motions.step() {
                return Ok(());
            }
            for (lane, place) in lanes.iter_mut().enumerate() {
                let Some(run) = place.as_mut() else { continue };
                let step = run.execution.ahead.memory(|| outline.clone());
                let goes_on = match motions.go_on(lane, Some(step)) {
                    Ok(time) => {
                        let goes_on = time != run.horizon && !may_end_in(step, &directions);
                        run.execution.ahead.keep();
                        goes_on && run.execution.ahead.count() < most_ahead
                    }
                    // The search meets the same error on its own step.
                    Err(_) => false,
                };
                if !goes_on && let Some(mut run) = place.take() {
                    motions.end(lane);
                    if let Some(arc) = run.execution.next() {
                        run.end = end_of_arc::<EquationsModel<X>>(arc);
                    }
                    memory[lane] = std::mem::take(&mut run.execution.ahead);
                    self.sort(run);
                }
            }
        }
    }
}

/// The mode of the next arc, and the time up to which it is to be followed, if that is done by steps whose events are searched: not in
/// closed form, and not without guards.
fn arc_in_a_lane<X: StateVector>(
    programs: &[ModeProgram],
    execution: &Execution<'_, EquationsModel<X>>,
) -> Option<(usize, f64)> {
    let mode = programs.iter().position(|program| program.name == execution.mode())?;
    let start = execution.state().components();
    // Another length is an error of the execution.
    let fits = programs[mode].series.dimension() == start.len();
    let is_integrated =
        fits && !programs[mode].guards.is_empty() && programs[mode].closed_form(start).is_none();
    let horizon = execution.horizon().ok()?;
    let goes_on = execution.stop().is_none() && horizon.is_finite() && horizon > 0.0;
    (is_integrated && goes_on).then_some((mode, horizon))
}

/// The formulas are watched in the order of the mode's guards without its clocks, whose `directions` these are.
///
/// Whether a guard has another sign at the end of a step, in its direction. This only chooses when events are searched: the
/// search itself looks at every step.
fn may_end_in(step: &Step, directions: &[Direction]) -> bool {
    let length = step.end - step.time;
    step.coefficients
        .all_watched()
        .zip(directions)
        .any(|(series, direction)| direction.admits(series[0], horner(series, length)))
}
