//! The values of formulas at many states at once, with the bits of one.

use crate::algebra::Arithmetic;
use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::evaluate::compute;
use crate::formulas::{Formulas, length};
use crate::lanes::{Lanes, WIDTH};
use crate::simd;
use std::array::from_fn;

/// The values of formulas at many states, or the states at the ends of many motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// For each formula, or component, its values, state by state. They are NaN at the states in `failed`.
    pub values: Vec<Vec<f64>>,
    /// The places of states at which a formula has no value, or whose motions fail, with the errors.
    pub failed: Vec<(usize, Error)>,
}

impl Columns {
    /// Without values.
    pub(crate) fn of(formulas: usize, count: usize) -> Columns {
        Columns { values: vec![vec![f64::NAN; count]; formulas], failed: Vec::new() }
    }

    /// Writes the values at a state.
    pub(crate) fn keep(&mut self, state: usize, values: impl Iterator<Item = f64>) {
        self.values.iter_mut().zip(values).for_each(|(column, value)| column[state] = value);
    }
}

/// States by columns, with times of each or of all.
pub(crate) struct Table<'a, const N: usize> {
    pub(crate) columns: &'a [&'a [f64]],
    times: [&'a [f64]; N],
    pub(crate) count: usize,
}

impl<'a, const N: usize> Table<'a, N> {
    pub(crate) fn new(
        components: usize,
        columns: &'a [&'a [f64]],
        times: [&'a [f64]; N],
    ) -> Result<Self, Error> {
        length("columns", components, columns.len())?;
        let of_times = times.iter().map(|times| times.len()).max().unwrap_or(0);
        let count = columns.first().map_or(of_times, |column| column.len());
        for column in columns {
            length("states in a column", count, column.len())?;
        }
        for times in times.iter().filter(|times| times.len() != 1) {
            length("times", count, times.len())?;
        }
        Ok(Table { columns, times, count })
    }

    /// One of the times of a state.
    pub(crate) fn time(&self, list: usize, state: usize) -> f64 {
        let times = self.times[list];
        if times.len() == 1 { times[0] } else { times[state] }
    }
}

impl Formulas {
    /// The values at many states, with the bits of [`values`](Self::values). `states` has a column for each component of
    /// the state, and `times` the time of each state, or one time of all.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let formulas = Formulas::from_text(Names::new(&["x", "y"], &[])?, &["sqrt(x)", "y - x"])?;
    /// let found = formulas.columns(&[0.0], &[&[4.0, 9.0, -1.0], &[1.0, 2.0, 3.0]])?;
    /// assert_eq!(found.values[0][..2], [2.0, 3.0]);
    /// assert_eq!(found.values[1][..2], [-3.0, -7.0]);
    /// assert_eq!(found.failed[0].0, 2); // the root of −1
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of columns, and for columns or times of different lengths.
    pub fn columns(&self, times: &[f64], states: &[&[f64]]) -> Result<Columns, Error> {
        let table = Table::new(self.names().states.len(), states, [times])?;
        Ok(match table.count {
            0..=WIDTH => self.columns_of(&table, simd::values_of_lanes),
            _ => self.columns_of(&table, simd::values_of_many_lanes),
        })
    }

    /// The same, N states at a time.
    fn columns_of<const N: usize>(
        &self,
        table: &Table<'_, 1>,
        values_of: ValuesOfLanes<N>,
    ) -> Columns {
        let count = table.count;
        let Columns { mut values, mut failed } = Columns::of(self.count(), count);
        let mut parts: Vec<Lanes<N>> = self.numbers();
        let mut state = vec![Lanes::zero(); table.columns.len()];
        for first in (0..count).step_by(N) {
            let width = N.min(count - first);
            let time = Lanes(from_fn(|lane| table.time(0, first + lane.min(width - 1))));
            for (state, column) in state.iter_mut().zip(table.columns) {
                *state = block(&column[first..first + width]);
            }
            let is_valid = values_of(self, &time, &state, &mut parts);
            for (column, &at) in values.iter_mut().zip(&self.outputs) {
                column[first..first + width].copy_from_slice(&parts[at].0[..width]);
            }
            if is_valid.0 == [0.0; N] {
                continue;
            }
            for lane in 0..width {
                // The same computation of one state has the same bits, and names the part.
                let state: Vec<f64> = state.iter().map(|component| component.0[lane]).collect();
                if let Err(error) = self.values(time.0[lane], &state) {
                    values.iter_mut().for_each(|column| column[first + lane] = f64::NAN);
                    failed.push((first + lane, error));
                }
            }
        }
        Columns { values, failed }
    }

    /// Replaces many states by the values there, so many times: their images under a map with one formula for each component, with the bits of
    /// [`values`](Self::values). `states` has a column for each component. Where a state had no value at one of the steps `has_value` becomes false, and
    /// its numbers mean nothing.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let henon = Formulas::from_text(Names::new(&["x", "y"], &[])?, &["1 - 1.4*x^2 + y", "0.3*x"])?;
    /// let (mut states, mut has_value) = ([vec![0.5, 1e200], vec![0.0, 0.0]], [false; 2]);
    /// henon.map_columns(0.0, &mut states, 1, &mut has_value)?;
    /// assert_eq!((states[1][0], has_value), (0.15, [true, false]));
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of columns or formulas than components, and for columns of different lengths.
    pub fn map_columns(
        &self,
        time: f64,
        states: &mut [Vec<f64>],
        steps: usize,
        has_value: &mut [bool],
    ) -> Result<(), Error> {
        let (components, count) = (self.names().states.len(), has_value.len());
        length("columns", components, states.len())?;
        length("formulas of a map", components, self.count())?;
        for column in states.iter() {
            length("states in a column", count, column.len())?;
        }
        match count {
            0..=WIDTH => self.map_lanes(time, states, steps, has_value, simd::images_of_lanes),
            _ => self.map_lanes(time, states, steps, has_value, simd::images_of_many_lanes),
        }
        Ok(())
    }

    /// The same, N states at a time.
    fn map_lanes<const N: usize>(
        &self,
        time: f64,
        states: &mut [Vec<f64>],
        steps: usize,
        has_value: &mut [bool],
        images: ImagesOfLanes<N>,
    ) {
        let time = Lanes([time; N]);
        let mut parts: Vec<Lanes<N>> = self.numbers();
        let mut state = vec![Lanes::zero(); states.len()];
        for first in (0..has_value.len()).step_by(N) {
            let width = N.min(has_value.len() - first);
            for (state, column) in state.iter_mut().zip(states.iter()) {
                *state = block(&column[first..first + width]);
            }
            let is_valid = images(self, &time, &mut state, &mut parts, steps);
            for (column, state) in states.iter_mut().zip(&state) {
                column[first..first + width].copy_from_slice(&state.0[..width]);
            }
            let valid = is_valid.0.iter().map(|valid| *valid == 0.0);
            has_value[first..first + width].iter_mut().zip(valid).for_each(|(has, is)| *has = is);
        }
    }
}

/// Up to N states; of fewer ones the last one fills the rest.
fn block<const N: usize>(column: &[f64]) -> Lanes<N> {
    let filled = |_| from_fn(|lane| column[lane.min(column.len() - 1)]);
    Lanes(column.try_into().unwrap_or_else(filled))
}

/// See [`values_of_lanes`].
type ValuesOfLanes<const N: usize> =
    fn(&Formulas, &Lanes<N>, &[Lanes<N>], &mut [Lanes<N>]) -> Lanes<N>;

/// See [`images_of_lanes`].
type ImagesOfLanes<const N: usize> =
    fn(&Formulas, &Lanes<N>, &mut [Lanes<N>], &mut [Lanes<N>], usize) -> Lanes<N>;

/// The values of all parts for some states, and for each state 0 if all of them are finite, else NaN.
#[inline(always)]
pub(crate) fn values_of_lanes<const N: usize>(
    formulas: &Formulas,
    time: &Lanes<N>,
    state: &[Lanes<N>],
    parts: &mut [Lanes<N>],
) -> Lanes<N> {
    compute(&formulas.nodes, time, state, parts, 1);
    // 0 times what is not finite is NaN. Plain loops: what is not inlined would be compiled for narrow vectors.
    let mut sum = time.each(|x| 0.0 * x);
    for x in state {
        sum = sum.with(*x, |sum, x| sum + 0.0 * x);
    }
    for x in parts.iter() {
        sum = sum.with(*x, |sum, x| sum + 0.0 * x);
    }
    sum
}

/// Replaces some states by the values there, so many times. For each state 0 if all values were finite, else NaN.
#[inline(always)]
pub(crate) fn images_of_lanes<const N: usize>(
    formulas: &Formulas,
    time: &Lanes<N>,
    state: &mut [Lanes<N>],
    parts: &mut [Lanes<N>],
    steps: usize,
) -> Lanes<N> {
    let mut all = Lanes::zero();
    for _ in 0..steps {
        let is_valid = values_of_lanes(formulas, time, state, parts);
        all = all.with(is_valid, |all, is_valid| all + is_valid);
        for (state, &at) in state.iter_mut().zip(&formulas.outputs) {
            *state = parts[at];
        }
    }
    all
}
