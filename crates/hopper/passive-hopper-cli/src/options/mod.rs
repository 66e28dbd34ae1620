//! Options that several commands share, and how their values are read.

pub(crate) mod form;
pub(crate) mod input;
pub(crate) mod line_form;
pub(crate) mod lines;
pub(crate) mod output_file;
pub(crate) mod quantity;
pub(crate) mod values;
