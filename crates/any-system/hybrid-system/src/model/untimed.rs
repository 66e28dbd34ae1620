//! Vectors without the time, to which it is added.

use crate::state::{State, StateVector};
use crate::system::Reset;
use nalgebra::DVector;

/// A vector without the time: an array, a [`State<N>`](State), a `Vec` or a `DVector`. It is what the closures of a model with the
/// time return. An array of another length than the state has without its time does not compile. What a closure returns may be a state
/// with the time, too, such as its own argument: its last component is replaced. A start, and a state of another length
/// ([`Reset::Resize`]), never has it.
pub trait Untimed<X> {
    /// The vector with `time` as its last component. `dimension` is the number of components with it, if that is known.
    #[doc(hidden)]
    fn with_time(self, dimension: Option<usize>, time: f64) -> X;
}

impl<const M: usize, const N: usize> Untimed<State<N>> for [f64; M] {
    fn with_time(self, _: Option<usize>, time: f64) -> State<N> {
        const { assert!(M + 1 == N, "the state has one component more: the time") };
        State::from_fn(|axis, _| if axis + 1 < N { self[axis] } else { time })
    }
}

impl<const M: usize, const N: usize> Untimed<State<N>> for State<M> {
    fn with_time(self, _: Option<usize>, time: f64) -> State<N> {
        const { assert!(M == N || M + 1 == N, "the state has one component more: the time") };
        State::from_fn(|axis, _| if axis + 1 < N { self[axis] } else { time })
    }
}

impl Untimed<DVector<f64>> for Vec<f64> {
    fn with_time(mut self, dimension: Option<usize>, time: f64) -> DVector<f64> {
        match dimension {
            Some(dimension) if self.len() == dimension => {
                if let Some(last) = self.last_mut() {
                    *last = time;
                }
            }
            _ => self.push(time),
        }
        DVector::from(self)
    }
}

impl Untimed<DVector<f64>> for DVector<f64> {
    fn with_time(self, dimension: Option<usize>, time: f64) -> DVector<f64> {
        Vec::from(self.data).with_time(dimension, time)
    }
}

/// What the closure of a reset may return in a model with the time: the next mode and state, or a [`Reset`], without the time.
pub trait OutcomeInTime<M, X> {
    /// The reset, at the time of the state before it.
    #[doc(hidden)]
    fn reset_at(self, before: &X) -> Reset<M, X>;
}

impl<M, X: StateVector, Y: Untimed<X>> OutcomeInTime<M, X> for (M, Y) {
    fn reset_at(self, before: &X) -> Reset<M, X> {
        Reset::Jump {
            mode: self.0,
            state: self.1.with_time(Some(before.dimension()), time_of(before)),
        }
    }
}

impl<M, X: StateVector, Y: Untimed<X>> OutcomeInTime<M, X> for Reset<M, Y> {
    fn reset_at(self, before: &X) -> Reset<M, X> {
        match self {
            Reset::Jump { mode, state } => (mode, state).reset_at(before),
            Reset::Resize { mode, state } => {
                Reset::Resize { mode, state: state.with_time(None, time_of(before)) }
            }
            Reset::Stop => Reset::Stop,
        }
    }
}

/// The last component: the time; NaN for a state without components.
pub(super) fn time_of<X: StateVector>(state: &X) -> f64 {
    state.components().last().copied().unwrap_or(f64::NAN)
}
