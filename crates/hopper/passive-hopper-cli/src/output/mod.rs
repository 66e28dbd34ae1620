//! Tables, and how they are printed: as plain text for people, as CSV and JSON for programs.

mod csv;
mod form;
mod json;
mod motion_table;
mod number;
mod plain;
mod table;

pub(crate) use form::Form;
pub(crate) use motion_table::motion_table;
pub(crate) use number::number;
pub(crate) use table::{Cell, Column, Table, TableKind, after};
