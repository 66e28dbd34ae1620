//! The lift-off map α′ = f(α; M), one hop and many.

pub(crate) mod extended_hop;
pub(crate) mod lift_off_map;
pub(crate) mod many_at_once;
pub(crate) mod near_fixed_point;
pub(crate) mod printed;
pub(crate) mod slopes;
