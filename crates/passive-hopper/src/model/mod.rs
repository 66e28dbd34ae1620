//! The equations of motion: parameters, states, fixed points, and every phase in closed form.

pub(crate) mod contact;
pub(crate) mod energy;
pub(crate) mod fixed_points;
pub(crate) mod mass_ratio;
pub(crate) mod motion;
pub(crate) mod state;
pub(crate) mod units;
