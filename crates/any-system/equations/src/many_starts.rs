//! The motions of many starts, side by side, with the bits of one.

use crate::algebra::Arithmetic;
use crate::columns::{Columns, Table};
use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::lanes::{Lanes, WIDTH};
use crate::simd;
use crate::step::{Step, end_of, memory};
use crate::taylor_flow::{MOST_STEPS, TaylorFlow};
use std::ops::Range;

/// One step of all lanes: where it is right. Elsewhere the step is to be done alone.
#[inline(always)]
pub(crate) fn step_of_lanes(
    flow: &TaylorFlow<'_>,
    (time, end): (Lanes, Lanes),
    state: &[Lanes],
    step: &mut Step<Lanes>,
) -> Lanes {
    let zero = flow.series.compute(&time, state, &mut step.coefficients);
    step.time = time;
    let left = end.with(time, |end, time| (end - time).abs());
    let length = flow.length_for_state(&step.coefficients).smaller(left);
    step.end = end_of(time, length, end);
    let moved = step.end.with(time, |end, time| f64::from(end != time));
    let right = flow.is_right(step).with(zero, |right, zero| right + zero);
    right.with(moved, |right, moved| f64::from(right == 1.0 && moved == 1.0))
}

impl TaylorFlow<'_> {
    /// The states of many starts at later or earlier times, with the bits of [`state_at`](Self::state_at). `states` has a
    /// column for each component, `times` the time of each start or one time of all, and so has `ends`.
    ///
    /// Eight motions are computed side by side, each with its own steps. A series with watched formulas, whose steps need
    /// more tests, is followed one by one.
    ///
    /// ```
    /// # use equations::{Formulas, Names, Series, TaylorFlow};
    /// let growth = Formulas::from_text(Names::new(&["x"], &[])?, &["x"])?;
    /// let series = Series::new(&growth, None)?;
    /// let flow = TaylorFlow::new(&series, 1e-15, 1e-15)?;
    /// let found = flow.states_at(&[0.0], &[&[1.0, 2.0, 3.0]], &[1.0])?;
    /// assert!((found.values[0][2] - 3.0 * 1f64.exp()).abs() < 1e-14);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of columns, and for columns or times of different lengths. The errors of single
    /// motions are in [`Columns::failed`].
    pub fn states_at(
        &self,
        times: &[f64],
        states: &[&[f64]],
        ends: &[f64],
    ) -> Result<Columns, Error> {
        let starts = Table::new(self.series.dimension(), states, [times, ends])?;
        let mut found = Columns::of(self.series.dimension(), starts.count);
        let watches = self.series.watched_part(0).is_some();
        match watches {
            true => self.one_by_one(&starts, &mut found)?,
            false => self.side_by_side(&starts, &mut found)?,
        }
        found.failed.sort_by_key(|(start, _)| *start);
        Ok(found)
    }

    fn one_by_one(&self, starts: &Table<'_, 2>, found: &mut Columns) -> Result<(), Error> {
        for start in 0..starts.count {
            let (time, end) = (starts.time(0, start), starts.time(1, start));
            match self.state_at(time, &starts.state(start), end) {
                Ok(state) => found.keep(start, state.into_iter()),
                Err(error) => found.failed.push((start, error)),
            }
        }
        Ok(())
    }

    fn side_by_side(&self, starts: &Table<'_, 2>, found: &mut Columns) -> Result<(), Error> {
        let mut waiting = 0..starts.count;
        let mut motions = Motions::new(self)?;
        loop {
            for lane in 0..WIDTH {
                motions.fill(lane, starts, &mut waiting, found);
            }
            let Some(followed) = motions.followed.iter().position(Option::is_some) else {
                return Ok(());
            };
            motions.repeat(followed);
            let right = simd::step_of_lanes(self, motions.times, &motions.state, &mut motions.step);
            for lane in 0..WIDTH {
                motions.go_on(lane, right.0[lane] == 1.0, found);
            }
        }
    }
}

/// A motion that is followed in a lane: its start, and its number of steps.
#[derive(Clone, Copy)]
struct Followed {
    start: usize,
    steps: usize,
}

/// Motions side by side.
struct Motions<'f> {
    flow: &'f TaylorFlow<'f>,
    followed: [Option<Followed>; WIDTH],
    /// Where each one is, and its end.
    times: (Lanes, Lanes),
    state: Vec<Lanes>,
    step: Step<Lanes>,
    /// Memory for a step that is done alone.
    single: Step,
    single_state: Vec<f64>,
}

impl<'f> Motions<'f> {
    fn new(flow: &'f TaylorFlow<'f>) -> Result<Self, Error> {
        let dimension = flow.series.dimension();
        Ok(Motions {
            flow,
            followed: [None; WIDTH],
            times: (Lanes::zero(), Lanes::zero()),
            state: vec![Lanes::zero(); dimension],
            step: memory(flow.series, flow.order)?,
            single: flow.memory()?,
            single_state: vec![0.0; dimension],
        })
    }

    /// Gives a free lane the next start that has times.
    fn fill(
        &mut self,
        lane: usize,
        starts: &Table<'_, 2>,
        waiting: &mut Range<usize>,
        found: &mut Columns,
    ) {
        while self.followed[lane].is_none()
            && let Some(start) = waiting.next()
        {
            let (time, end) = (starts.time(0, start), starts.time(1, start));
            if !(time.is_finite() && end.is_finite()) {
                found.failed.push((start, Error::Time { time, end }));
                continue;
            }
            (self.times.0.0[lane], self.times.1.0[lane]) = (time, end);
            for (x, column) in self.state.iter_mut().zip(starts.columns) {
                x.0[lane] = column[start];
            }
            self.followed[lane] = Some(Followed { start, steps: 0 });
        }
    }

    /// Lets free lanes repeat one that is followed: every number that is computed belongs to a motion that was asked for.
    fn repeat(&mut self, lane: usize) {
        let Motions { followed, times: (time, end), state, .. } = self;
        for lanes in [time, end].into_iter().chain(state) {
            let repeated = lanes.0[lane];
            let free = (0..WIDTH).filter(|free| followed[*free].is_none());
            free.for_each(|free| lanes.0[free] = repeated);
        }
    }

    /// Moves a lane behind its step, and frees it at the end of its motion.
    fn go_on(&mut self, lane: usize, is_right: bool, found: &mut Columns) {
        let Some(Followed { start, steps }) = self.followed[lane] else { return };
        let end = self.times.1.0[lane];
        let steps = steps + 1;
        self.followed[lane] = match self.moved(lane, is_right) {
            Err(error) => {
                found.failed.push((start, error));
                None
            }
            Ok(time) if time == end => {
                found.keep(start, self.state.iter().map(|x| x.0[lane]));
                None
            }
            Ok(time) if steps >= MOST_STEPS => {
                found.failed.push((start, Error::Stuck { time, end }));
                None
            }
            Ok(time) => {
                self.times.0.0[lane] = time;
                Some(Followed { start, steps })
            }
        };
    }

    /// Puts the state of a lane behind its step, which is done alone unless it is right; the time there.
    fn moved(&mut self, lane: usize, is_right: bool) -> Result<f64, Error> {
        if is_right {
            for (x, end) in self.state.iter_mut().zip(&self.step.state_at_end) {
                x.0[lane] = end.0[lane];
            }
            return Ok(self.step.end.0[lane]);
        }
        let (time, end) = (self.times.0.0[lane], self.times.1.0[lane]);
        self.single_state.iter_mut().zip(&self.state).for_each(|(own, x)| *own = x.0[lane]);
        let reached = self.flow.one_step(time, &mut self.single_state, end, &mut self.single)?;
        self.state.iter_mut().zip(&self.single_state).for_each(|(x, own)| x.0[lane] = *own);
        Ok(reached)
    }
}
