//! Equations, written once: values, exact derivatives, Taylor series in time, enclosures, text.
//!
//! A model's field, guard or jump is a [`Formulas`]: functions of time, state and parameters, from a closure that is
//! called once with symbols, or from text.
//!
//! | item | role |
//! |---|---|
//! | [`Names`] | the names of state and parameters, with the parameters' values |
//! | [`Formulas::new`], [`Formulas::from_text`] | formulas from a closure, from text |
//! | [`Formulas::values`], [`Formulas::enclosures`], [`Evaluator`] | what they are: in `f64`, for whole intervals |
//! | [`Formulas::columns`], [`Columns`] | the values at many states, with the same bits |
//! | [`Formulas::derivative`], [`Formulas::jacobian`], [`Formulas::parameter_jacobian`] | exact derivatives, as formulas again |
//! | [`Series`], [`Coefficients`] | Taylor series along the motion, to any order, in `f64` or in enclosures |
//! | [`TaylorFlow`], [`Step`] | the motion by Taylor's method: a polynomial for each step |
//! | [`TaylorFlow::states_at`] | the motions of many starts side by side, with the same bits |
//! | [`JetSeries`], [`Jet`] | derivatives of any order in one direction, of values and of motions, as polynomials |
//! | [`Formulas::composed`], [`Formulas::on`], [`Formulas::and`], [`Formulas::negative`], [`Formulas::rate`] | formulas of formulas, lists of them, rates along a field |
//! | [`Formulas::with_variations`], [`Formulas::with_states_for`] | formulas with their derivatives along a motion; with parameters as components of the state |
//! | [`Formulas::texts`], [`Formulas::latex`] | the formulas, written |
//! | [`Formulas::to_json`], [`Formulas::from_json`], [`Formulas::content_hash`] | the formulas as data, with exact numbers |
//! | [`Expression`], [`Term`], [`States`], [`Parameters`] | what a closure computes with |
//! | [`Function`], [`Names::with_functions`] | a function of the user's own, with its derivative and its enclosure |
//! | [`Constant`], [`Decimal`] | a number of a formula: the decimal that is written, or a double |
//!
//! ```
//! use equations::{Formulas, Names, Series};
//! let names = Names::new(&["angle", "speed"], &[("damping", "0.1")])?;
//! let pendulum = Formulas::new(names, |_, x, p| [x[1], -x[0].sin() - p["damping"] * x[1]])?;
//! assert_eq!(pendulum.texts()[1], "-sin(angle) - damping*speed");
//! assert_eq!(pendulum.jacobian()?.texts()[2], "-cos(angle)");
//! let motion = Series::new(&pendulum, None)?.coefficients(0.0, &[0.0, 1.0], 3)?;
//! assert_eq!(motion.state(0)[..3], [0.0, 1.0, -0.05]); // angle = s − 0.05 s² + …
//! # Ok::<(), equations::Error>(())
//! ```
//!
//! A number in text is the decimal that is written: 0.2 is 1/5, enclosures contain it, and `f64` takes the nearest
//! double. A number in a closure is its double, exactly. Functions come from pxfm, so that values have the same bits on
//! every machine.

mod algebra;
mod columns;
mod compose;
mod constant;
mod derivative;
mod elementwise;
mod error;
mod evaluate;
mod expression;
mod formulas;
mod function;
mod graph;
mod jet;
mod jet_flow;
mod jet_series;
mod json;
mod lanes;
mod many_starts;
mod names;
mod node;
mod print;
mod rules;
mod series;
mod side_by_side;
mod simd;
mod step;
mod step_length;
mod taylor_flow;
mod text;
mod variations;

pub use algebra::{Algebra, Arithmetic};
pub use columns::Columns;
pub use constant::{Constant, Decimal};
pub use error::Error;
pub use evaluate::Evaluator;
pub use expression::{Expression, Parameters, States, Term};
pub use formulas::Formulas;
pub use function::Function;
pub use interval_arithmetic::Enclosure;
pub use jet::Jet;
pub use jet_flow::jet_horner;
pub use jet_series::JetSeries;
pub use json::{bounded_value, content_hash};

pub use names::Names;
pub use node::{Binary, Node, Unary};
pub use series::{Coefficients, Series};
pub use side_by_side::SideBySide;
pub use step::Step;
pub use step_length::horner;
pub use taylor_flow::TaylorFlow;
