//! The commands, one file each.

pub(crate) mod fate;
pub(crate) mod hop;
pub(crate) mod page;
pub(crate) mod units;

pub(crate) use page::Page;
