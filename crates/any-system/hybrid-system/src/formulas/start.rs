//! Where an execution of equations starts: with the time as a component where the formulas use it.

use crate::state::State;
use nalgebra::DVector;

/// What can be the start of an execution of [`Equations`](crate::Equations): an array, a [`State<N>`](crate::State), a `Vec` or
/// a `DVector`. It has the components with names. If the formulas use the time, the state of the model has it behind them; the
/// start may leave it out.
pub trait Start<X> {
    /// The state of a model of this dimension, with the time as its last component if it is left out and the model has a `time`; the number of components, or that of the type, if it does not fit.
    #[doc(hidden)]
    fn state(self, dimension: usize, time: Option<f64>) -> Result<X, usize>;
}

impl<const M: usize, const N: usize> Start<State<N>> for [f64; M] {
    fn state(self, dimension: usize, time: Option<f64>) -> Result<State<N>, usize> {
        let whole = self.into_iter().chain(time.filter(|_| M + 1 == dimension));
        match whole.clone().count() == dimension && dimension == N {
            true => Ok(State::from_iterator(whole)),
            false => Err(if whole.count() == dimension { N } else { M }),
        }
    }
}

impl<const M: usize, const N: usize> Start<State<N>> for State<M> {
    fn state(self, dimension: usize, time: Option<f64>) -> Result<State<N>, usize> {
        let [components] = self.data.0;
        components.state(dimension, time)
    }
}

impl Start<DVector<f64>> for Vec<f64> {
    fn state(mut self, dimension: usize, time: Option<f64>) -> Result<DVector<f64>, usize> {
        if self.len() + 1 == dimension {
            self.extend(time);
        }
        if self.len() == dimension { Ok(DVector::from(self)) } else { Err(self.len()) }
    }
}

impl Start<DVector<f64>> for DVector<f64> {
    fn state(self, dimension: usize, time: Option<f64>) -> Result<DVector<f64>, usize> {
        self.as_slice().to_vec().state(dimension, time)
    }
}
