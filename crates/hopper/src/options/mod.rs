//! Options that several commands share, and how their values are read.

pub(crate) mod form;
pub(crate) mod lines;
pub(crate) mod quantity;
pub(crate) mod values;
