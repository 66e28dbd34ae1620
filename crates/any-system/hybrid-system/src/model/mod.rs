//! How is a model written with closures?
//!
//! A [`Model`] has a motion (`motion`: a flow in closed form, or a field that is integrated) and parts: guards with
//! their resets and clocks (`guarded`), their conditions (`condition`), bounds on guards (`bounds`), the modes after Zeno limits and sliding points
//! (`continued`). Each part has a type of its own, and a model contains the nested pairs of its parts (`part`). The
//! compiler therefore sees every closure: no call goes through a pointer. `guard_lists` has the guards of each
//! mode. `system` implements [`HybridSystem`](crate::HybridSystem), `derivatives` and `integrated_derivatives`
//! [`Differentiable`](crate::Differentiable); `family`, `integrated_family` and `filippov_family` have derivatives
//! by parameters.

mod autonomous;
mod bounds;
mod condition;
mod continued;
mod declared;
mod derivatives;
mod family;
#[cfg(feature = "ode")]
mod filippov_family;
mod guard_lists;
mod guarded;
mod in_time;
#[cfg(feature = "ode")]
mod integrated;
#[cfg(feature = "ode")]
mod integrated_derivatives;
#[cfg(feature = "ode")]
mod integrated_family;
#[allow(clippy::module_inception)]
mod model;
mod motion;
mod outcome;
mod part;
mod system;
mod untimed;

pub use bounds::{GuardEnclosure, Signal};
pub use condition::Condition;
pub use continued::{Field, Rest, Slide};
pub use derivatives::{gradient_by_differences, jacobian_by_differences, reset_by_differences};
pub use family::Family;
pub use guarded::{Clock, Jump, JumpEverywhere, Terminal, Watch};
pub use in_time::InTime;
#[cfg(feature = "ode")]
pub use integrated::Integrated;
pub use model::{Autonomous, Model};
pub use motion::{ClosedForm, Motion};
pub use outcome::Outcome;
pub use part::ModelPart;
#[cfg(feature = "ode")]
pub(crate) use part::smaller;
pub use untimed::{OutcomeInTime, Untimed};
