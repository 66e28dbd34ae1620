//! The motions of many starts, side by side, with the bits of one.

use crate::columns::{Columns, Table};
use crate::error::Error;
use crate::side_by_side::SideBySide;
use crate::taylor_flow::{MOST_STEPS, TaylorFlow};

impl TaylorFlow<'_> {
    /// The states of many starts at later or earlier times, with the bits of [`state_at`](Self::state_at). `states` has a
    /// column for each component. `times` and `ends` have one value for each start, or one for all.
    ///
    /// Eight motions are computed [side by side](SideBySide), each with its own steps.
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
        let mut motions = SideBySide::new(self)?;
        let mut waiting = 0..starts.count;
        // For each lane its start, and its number of steps.
        let mut followed = [(0, 0); SideBySide::WIDTH];
        loop {
            for (lane, followed) in followed.iter_mut().enumerate() {
                while !motions.is_followed(lane)
                    && let Some(start) = waiting.next()
                {
                    let (time, end) = (starts.time(0, start), starts.time(1, start));
                    let state = starts.columns.iter().map(|column| column[start]);
                    match motions.begin(lane, time, state, end) {
                        Ok(()) => *followed = (start, 0),
                        Err(error) => found.failed.push((start, error)),
                    }
                }
            }
            if !motions.step() {
                found.failed.sort_by_key(|(start, _)| *start);
                return Ok(found);
            }
            for (lane, (start, steps)) in followed.iter_mut().enumerate() {
                if !motions.is_followed(lane) {
                    continue;
                }
                *steps += 1;
                let end = starts.time(1, *start);
                match motions.go_on(lane, None) {
                    Ok(time) if time == end => found.keep(*start, motions.state(lane)),
                    Ok(time) if *steps >= MOST_STEPS => {
                        found.failed.push((*start, Error::Stuck { time, end }));
                    }
                    Ok(_) => continue,
                    Err(error) => found.failed.push((*start, error)),
                }
                motions.end(lane);
            }
        }
    }
}
