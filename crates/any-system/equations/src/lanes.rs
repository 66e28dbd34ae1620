//! Many states at once, with the bits of one.

use crate::algebra::Algebra;
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

impl Algebra for Lanes {
    fn constant(constant: &Constant) -> Self {
        Lanes([constant.value(); WIDTH])
    }

    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            // These are instructions of the processor for all lanes.
            Unary::Negative => x.each(|x| -x),
            Unary::SquareRoot => x.each(f64::sqrt),
            _ => x.each(|x| f64::unary(function, &x)),
        }
    }

    fn binary(function: Binary, x: &Self, y: &Self) -> Self {
        match function {
            Binary::Sum => x.with(y, |x, y| x + y),
            Binary::Difference => x.with(y, |x, y| x - y),
            Binary::Product => x.with(y, |x, y| x * y),
            Binary::Quotient => x.with(y, |x, y| x / y),
            _ => x.with(y, |x, y| f64::binary(function, &x, &y)),
        }
    }

    fn square(x: &Self) -> Self {
        x.each(|x| x * x)
    }

    fn add_product(x: &Self, y: &Self, z: &Self) -> Self {
        Lanes(from_fn(|lane| x.0[lane] + y.0[lane] * z.0[lane]))
    }

    fn times(x: &Self, k: f64) -> Self {
        x.each(|x| x * k)
    }

    fn zero() -> Self {
        Lanes([0.0; WIDTH])
    }

    fn is_valid(&self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

impl Formulas {
    /// The values at many states, with the bits of [`values`](Self::values): the result of each state, or its error.
    ///
    /// `times` has the time of each state, or one time of all.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let root = Formulas::from_text(Names::new(&["x"], &[])?, &["sqrt(x)", "t"])?;
    /// let found = root.values_of_many(&[0.5], &[[4.0], [-1.0], [9.0]])?;
    /// assert_eq!(found[0], Ok(vec![2.0, 0.5]));
    /// assert!(found[1].is_err());
    /// assert_eq!(found[2], Ok(vec![3.0, 0.5]));
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for a state with another number of components, or another number of times.
    pub fn values_of_many<S: AsRef<[f64]>>(
        &self,
        times: &[f64],
        states: &[S],
    ) -> Result<Vec<Result<Vec<f64>, Error>>, Error> {
        if times.len() != 1 {
            length("times", states.len(), times.len())?;
        }
        for state in states {
            length("components of the state", self.names().states.len(), state.as_ref().len())?;
        }
        let time_of = |at: usize| if times.len() == 1 { times[0] } else { times[at] };
        let mut results = Vec::with_capacity(states.len());
        let mut evaluator = Evaluator::new(self);
        for (block, chunk) in states.chunks(WIDTH).enumerate() {
            let first = block * WIDTH;
            // The last block is filled with its last state.
            let lane_of = |lane: usize| lane.min(chunk.len() - 1);
            let time = Lanes(from_fn(|lane| time_of(first + lane_of(lane))));
            let state: Vec<Lanes> = (0..self.names().states.len())
                .map(|component| Lanes(from_fn(|lane| chunk[lane_of(lane)].as_ref()[component])))
                .collect();
            evaluator.compute(&time, &state);
            for (lane, start) in chunk.iter().enumerate() {
                let own: Vec<f64> =
                    self.outputs.iter().map(|&at| evaluator.parts[at].0[lane]).collect();
                results.push(match own.iter().all(|x| x.is_finite()) {
                    true => Ok(own),
                    // The same computation of one state, which names the part.
                    false => self.values(time_of(first + lane), start.as_ref()),
                });
            }
        }
        Ok(results)
    }
}
