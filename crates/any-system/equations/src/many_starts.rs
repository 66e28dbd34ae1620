//! The motions of many starts, side by side, with the bits of one.

use crate::columns::{Columns, Table};
use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::lanes::{Lanes, WIDTH};
use crate::simd;
use crate::step::{Step, end_of, memory};
use crate::taylor_flow::{MOST_STEPS, TaylorFlow};

/// A motion that is followed in a lane.
#[derive(Clone, Copy)]
struct Followed {
    start: usize,
    steps: usize,
}

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
        let mut lanes: [Option<Followed>; WIDTH] = [None; WIDTH];
        let (mut time, mut end) = (Lanes([0.0; WIDTH]), Lanes([0.0; WIDTH]));
        let mut state = vec![Lanes([0.0; WIDTH]); self.series.dimension()];
        let mut step = memory::<Lanes>(self.series, self.order)?;
        let mut single = self.memory()?;
        let mut own = vec![0.0; self.series.dimension()];
        loop {
            for (lane, followed) in lanes.iter_mut().enumerate() {
                while followed.is_none()
                    && let Some(start) = waiting.next()
                {
                    let (from, to) = (starts.time(0, start), starts.time(1, start));
                    if !(from.is_finite() && to.is_finite()) {
                        found.failed.push((start, Error::Time { time: from, end: to }));
                        continue;
                    }
                    (time.0[lane], end.0[lane]) = (from, to);
                    for (x, column) in state.iter_mut().zip(starts.columns) {
                        x.0[lane] = column[start];
                    }
                    *followed = Some(Followed { start, steps: 0 });
                }
            }
            if lanes.iter().all(Option::is_none) {
                return Ok(());
            }
            let right = simd::step_of_lanes(self, (time, end), &state, &mut step);
            for (lane, followed) in lanes.iter_mut().enumerate() {
                let Some(Followed { start, steps }) = followed else { continue };
                let (from, to) = (time.0[lane], end.0[lane]);
                let reached = if right.0[lane] == 1.0 {
                    for (x, end) in state.iter_mut().zip(&step.state_at_end) {
                        x.0[lane] = end.0[lane];
                    }
                    Ok(step.end.0[lane])
                } else {
                    own.iter_mut().zip(&state).for_each(|(own, x)| *own = x.0[lane]);
                    let reached = self.one_step(from, &mut own, to, &mut single);
                    state.iter_mut().zip(&own).for_each(|(x, own)| x.0[lane] = *own);
                    reached
                };
                *steps += 1;
                let reached = match reached {
                    Ok(at) if at != to && *steps >= MOST_STEPS => {
                        Err(Error::Stuck { time: at, end: to })
                    }
                    reached => reached,
                };
                match reached {
                    Ok(at) => {
                        time.0[lane] = at;
                        if at == to {
                            found.keep(*start, state.iter().map(|x| x.0[lane]));
                            *followed = None;
                        }
                    }
                    Err(error) => {
                        found.failed.push((*start, error));
                        *followed = None;
                    }
                }
            }
        }
    }
}
