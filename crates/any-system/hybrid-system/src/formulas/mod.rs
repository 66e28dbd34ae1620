//! How is a model of equations written, stored and run? (feature `ode`)
//!
//! [`Equations`] are what a user writes (`equations`, `builder`, `jumps`), as data, with [`Label`]s for modes and surfaces. `programs` has what
//! is evaluated of them: a Taylor series for each mode, with its guards as watched formulas. `closed_form`
//! solves linear fields, in functions of time that `quasi_values` computes with. `motion` and `part` are the
//! motion and the part of a [`Model`](crate::Model). `reversed` are equations backward in time. `jets` has the derivatives of whole executions, `derivatives` those of
//! [`Differentiable`](crate::Differentiable). `file` is the JSON of equations,
//! `saved_run` that of an execution. `parts` gives the formulas to other programs, `many_fates` follows many runs side by side. `turns` has the points at which guards turn, and equations along one sequence of events.

mod builder;
mod closed_form;
mod derivatives;
mod equations;
mod exact;
mod file;
mod jets;
mod jumps;
mod label;
mod many_fates;
mod motion;
mod part;
mod parts;
mod programs;
mod quasi_values;
mod reversed;
#[cfg(feature = "serde")]
mod saved_run;
mod start;
mod turns;

pub use self::equations::{Equations, EquationsModel};
pub use jets::{Along, ExecutionJet};
pub use label::Label;
pub use motion::TaylorMotion;
pub use part::FormulaPart;
pub use parts::{GuardParts, ModeParts};
#[cfg(feature = "serde")]
pub use saved_run::SavedRun;
pub use start::Start;
pub use turns::Turn;
