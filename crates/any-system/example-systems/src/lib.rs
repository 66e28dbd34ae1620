//! Hybrid systems with known answers that several places of this workspace share.
//!
//! | module | system | used by |
//! |---|---|---|
//! | [`ball_on_table`] | a ball on a table that moves as a sine (Holmes 1982) | a figure |
//! | [`buck_converter`] | a DC–DC converter with its clock (Fossas and Olivar 1996) | a figure |
//! | [`eccentric_cylinder`] | a cylinder whose centre of mass is off its axis, bouncing on a floor | an example of `hybrid-system`, a figure |
//! | [`forced_oscillator`] | the forced oscillator of Sommerer and Ott (1993), as a stroboscopic map | an example of `return-map`, a figure |
//! | [`impact_oscillator`] | a forced oscillator at its first grazing of a stop (Nordmark 1991) | a figure, an example of `validated-dynamics` |
//! | [`scenes`] | small systems in which something happens at once, slides or touches | tests of `hybrid-system`, figures |
//! | [`spring_leg`] | a runner on a spring leg (Seyfarth and others 2002), who may fall | a figure, an example of `validated-dynamics` |
//! | [`stick_slip`] | a mass on a belt, with a friction that falls (Leine and others 1998) | a figure |
//! | [`valve`] | a pressure relief valve whose disc hits its seat | an example and a benchmark of `return-map`, a figure |
//!
//! The figures are made by `hopper-studies`. [`ball_on_table`], [`buck_converter`], [`impact_oscillator`], [`spring_leg`] and
//! [`stick_slip`] are equations; their known answers are in `tests/published.rs`.
//!
//! A system that is needed in only one place is in the `examples` folder of its crate.

pub mod ball_on_table;
pub mod buck_converter;
pub mod eccentric_cylinder;
pub mod forced_oscillator;
pub mod impact_oscillator;
pub mod scenes;
pub mod spring_leg;
pub mod stick_slip;
pub mod valve;
