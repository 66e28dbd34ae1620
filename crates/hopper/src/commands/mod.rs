//! The commands, one file each.

pub(crate) mod hop;
mod page;

pub(crate) use page::Page;
