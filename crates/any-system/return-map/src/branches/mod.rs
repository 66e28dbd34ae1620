//! How do fixed and periodic points change with a parameter?
//!
//! A [`Branch`] is followed by pseudo-arclength (`curve`, `follow`, from `start`): H. B. Keller, *Numerical solution of bifurcation and nonlinear
//! eigenvalue problems* (1977). `orbit` has the equations of a periodic
//! point, `tests` the numbers that change their signs at bifurcations, `locate` finds these, `normal_form` has their coefficients,
//! `doubled` the branch behind a doubling and cascades of them, `continued` goes on with a branch that was stopped, `drawn` says what a drawing shows, `border` is where a branch meets another piece of the map (`touches` finds what is left again), and `behind` goes on there. `two_parameters` follows
//! curves in two parameters, of smooth bifurcations (`bifurcation_curve`), and of grazings and corners (`border_curve`). Y. A. Kuznetsov, *Elements of Applied Bifurcation Theory*, Springer
//! (2004).

mod behind;
mod bifurcation_curve;
mod border;
mod border_curve;
mod branch;
mod continued;
mod curve;
mod doubled;
mod drawn;
mod follow;
mod locate;
mod normal_form;
mod orbit;
mod start;
mod tests;
mod touches;
mod two_parameters;

pub use behind::follow_behind;
pub use bifurcation_curve::bifurcation_curve;
pub use border_curve::border_curve;
pub use branch::{Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint};
pub use continued::continue_branch;
pub use doubled::{cascade, doubled_branch};
pub use follow::{BranchSteps, follow_branch, follow_equilibria};
pub use start::branch_point;
pub(crate) use start::{size_of, solve_periodic};
pub use two_parameters::{BifurcationCurve, BifurcationCurvePoint, CurveEnd};
