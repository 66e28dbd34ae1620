//! Many states at once, with the bits of one.

use crate::algebra::{Algebra, Arithmetic, of_number};
use crate::constant::Constant;
use crate::error::Error;
use crate::evaluate::Evaluator;
use crate::formulas::{Formulas, length};
use crate::node::{Binary, Unary};
use std::array::from_fn;

/// States that are computed side by side: eight `f64` fill a register of 512 bits, or two or four smaller ones. Each
/// part of a formula is then looked up once for all of them.
const WIDTH: usize = 8;

/// A number for each of some states.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lanes([f64; WIDTH]);

impl Lanes {
    #[inline]
    fn each(&self, f: impl Fn(f64) -> f64) -> Self {
        Lanes(from_fn(|lane| f(self.0[lane])))
    }

    #[inline]
    fn with(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Lanes(from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
}

impl Arithmetic for Lanes {
    fn one() -> Self {
        Lanes([1.0; WIDTH])
    }

    fn negative(x: &Self) -> Self {
        x.each(|x| -x)
    }

    fn sum(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x + y)
    }

    fn difference(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x - y)
    }

    fn product(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x * y)
    }

    fn quotient(x: &Self, y: &Self) -> Self {
        x.with(y, |x, y| x / y)
    }

    fn square(x: &Self) -> Self {
        x.each(|x| x * x)
    }

    fn sum_of_products(x: &[Self], y: &[Self]) -> Self {
        let ((x, x_left), (y, y_left)) = (x.as_chunks::<4>(), y.as_chunks::<4>());
        let add = |sum: Lanes, (x, y): (&Lanes, &Lanes)| {
            Lanes(from_fn(|lane| sum.0[lane] + x.0[lane] * y.0[lane]))
        };
        let mut sums = [Lanes::zero(); 4];
        for (x, y) in x.iter().zip(y) {
            sums = from_fn(|k| add(sums[k], (&x[k], &y[k])));
        }
        let [a, b, c, d] = sums;
        let sum = Lanes(from_fn(|lane| (a.0[lane] + c.0[lane]) + (b.0[lane] + d.0[lane])));
        x_left.iter().zip(y_left).fold(sum, add)
    }

    fn times(x: &Self, k: f64) -> Self {
        x.each(|x| x * k)
    }

    fn over(x: &Self, k: f64) -> Self {
        x.each(|x| x / k)
    }

    fn zero() -> Self {
        Lanes([0.0; WIDTH])
    }

    fn is_valid(&self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

impl Algebra for Lanes {
    fn constant(constant: &Constant) -> Self {
        Lanes([constant.value(); WIDTH])
    }

    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            // These are instructions of the processor for all lanes.
            Unary::Negative => Self::negative(x),
            Unary::SquareRoot => x.each(f64::sqrt),
            _ => x.each(of_number(function)),
        }
    }

    fn binary(function: Binary, x: &Self, y: &Self) -> Self {
        match function {
            Binary::Sum => Self::sum(x, y),
            Binary::Difference => Self::difference(x, y),
            Binary::Product => Self::product(x, y),
            Binary::Quotient => Self::quotient(x, y),
            _ => x.with(y, |x, y| f64::binary(function, &x, &y)),
        }
    }
}

/// The values of formulas at many states.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// For each formula its values, state by state. They are NaN at the states in `failed`.
    pub values: Vec<Vec<f64>>,
    /// The places of states at which a formula has no value, with the errors.
    pub failed: Vec<(usize, Error)>,
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
        length("columns", self.names().states.len(), states.len())?;
        let count = states.first().map_or(times.len(), |column| column.len());
        for column in states {
            length("states in a column", count, column.len())?;
        }
        if times.len() != 1 {
            length("times", count, times.len())?;
        }
        let mut values = vec![vec![f64::NAN; count]; self.count()];
        let mut failed = Vec::new();
        let mut evaluator = Evaluator::new(self);
        let mut state = vec![Lanes::zero(); states.len()];
        for first in (0..count).step_by(WIDTH) {
            let width = WIDTH.min(count - first);
            // The last block is filled with its last state.
            let lanes = |column: &[f64]| Lanes(from_fn(|lane| column[first + lane.min(width - 1)]));
            let time = if times.len() == 1 { Lanes([times[0]; WIDTH]) } else { lanes(times) };
            state.iter_mut().zip(states).for_each(|(state, column)| *state = lanes(column));
            evaluator.compute(&time, &state);
            let found = || self.outputs.iter().map(|&at| evaluator.parts[at]);
            for (column, found) in values.iter_mut().zip(found()) {
                column[first..first + width].copy_from_slice(&found.0[..width]);
            }
            let starts = state.iter().chain([&time]);
            if evaluator.parts.iter().chain(starts).all(Lanes::is_valid) {
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
        Ok(Columns { values, failed })
    }
}
