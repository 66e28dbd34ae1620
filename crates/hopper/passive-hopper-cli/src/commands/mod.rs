//! The commands, one file each.

pub(crate) mod fate;
pub(crate) mod hop;
pub(crate) mod intervals;
pub(crate) mod map;
pub(crate) mod orbit;
pub(crate) mod page;
pub(crate) mod search;
pub(crate) mod texts;
pub(crate) mod units;

pub(crate) use page::Page;
