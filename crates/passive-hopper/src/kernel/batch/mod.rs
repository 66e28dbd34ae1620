//! Many hops at once.

pub(crate) mod bulk;
pub(crate) mod landings;
pub(crate) mod simd;
