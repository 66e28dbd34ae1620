//! Hybrid systems with known answers that several places of this workspace share.
//!
//! | module | system | used by |
//! |---|---|---|
//! | [`valve`] | a pressure relief valve whose disc hits its seat | an example and a benchmark of `return-map`, a figure of `hopper-paper` |
//!
//! A system that is needed in only one place is in the `examples` folder of its crate.

pub mod eccentric_cylinder;
pub mod forced_oscillator;
pub mod valve;
