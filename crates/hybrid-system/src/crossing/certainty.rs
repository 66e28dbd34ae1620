//! The first crossing of a guard, and how certain it is that no other crossing comes before it.

use crate::state::State;

/// How certain it is that a crossing is the first one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// The model solved for the crossing itself.
    Exact,
    /// The crossing was found under bounds on the guard: no earlier crossing can exist.
    Certain,
    /// The crossing was found along an integrated flow.
    ///
    /// A step is skipped if the guard stays far from zero at the stages and at eighths of the step. On every other step
    /// the guard is replaced by polynomials, and none of their zeros is missed. The flow itself is accurate to its
    /// tolerances.
    Interpolated,
    /// The guard was sampled: two crossings between neighbouring samples are missed.
    Sampled {
        /// Time between two samples.
        interval: f64,
    },
}

/// A guard that is crossed after the start of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<S, const N: usize> {
    /// The surface that is crossed.
    pub surface: S,
    /// Time since the start of the arc.
    pub time: f64,
    /// The state on the surface, before any reset. A model that solves its crossings may know this state more
    /// accurately than its flow gives it at the rounded time.
    pub state: State<N>,
    /// How certain it is that this is the first crossing.
    pub certainty: Certainty,
}
