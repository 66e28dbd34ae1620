//! Hybrid systems with known answers that several places of this workspace share.
//!
//! | module | system | used by |
//! |---|---|---|
//! | [`eccentric_cylinder`] | a cylinder whose centre of mass is off its axis, bouncing on a floor | an example of `hybrid-system`, a figure of `hopper-studies` |
//! | [`forced_oscillator`] | the forced oscillator of Sommerer and Ott, as a stroboscopic map | an example of `return-map`, a figure of `hopper-studies` |
//! | [`scenes`] | small systems in which something happens at once, slides or touches | tests of `hybrid-system`, figures of `hopper-studies` |
//! | [`valve`] | a pressure relief valve whose disc hits its seat | an example and a benchmark of `return-map`, a figure of `hopper-studies` |
//!
//! A system that is needed in only one place is in the `examples` folder of its crate.

pub mod eccentric_cylinder;
pub mod forced_oscillator;
pub mod scenes;
pub mod valve;
