//! Time and error of every way to compute a hop, on the same inputs and in one run.

mod case;
mod classes;
mod figure;
mod hybrid_hopper;
mod methods;
mod ode_hopper;
mod scenes;
mod score;
pub(crate) mod table;

pub(crate) use case::Case;
pub(crate) use figure::work_precision_figure;
pub(crate) use methods::Method;
pub(crate) use scenes::scenes;
pub(crate) use score::measure;
