//! One hop.

pub(crate) mod flight;
pub(crate) mod hop;
pub(crate) mod start;
pub(crate) mod turn;
