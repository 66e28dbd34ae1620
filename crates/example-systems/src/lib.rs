//! Hybrid systems with known answers that several places of this workspace share.
//!
//! | module | system | used by |
//! |---|---|---|
//! | [`valve`] | a pressure relief valve whose disc hits its seat | an example and a benchmark of `return-map`, a figure of `hopper-paper` |
//!
//! Systems that only one place needs stand in the `examples` folder of their crate.

pub mod valve;
