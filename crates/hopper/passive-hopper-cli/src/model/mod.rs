//! The program `nonsmooth`: any hybrid system, from a file with its equations.
//!
//! ```text
//!   file.rs      a model as TOML or JSON, and its equations
//!   cli.rs       the commands
//!   question.rs  what all commands ask: the model, its parameters, a start
//!   places.rs    in which mode a state is
//!   period.rs    whether a time is a period of a model
//!   columns.rs   tables whose columns are the states of a model
//!   run.rs       a trajectory with its events
//!   section.rs   the returns to a surface
//!   returns.rs   a return map along a parameter
//!   branch.rs    periodic orbits along a parameter, with their bifurcations
//!   diagram.rs   where orbits are after a transient, along a parameter
//!   basin.rs     attractors and the basins of a window
//!   basin_store.rs  its labels in a folder, from which a stopped call goes on
//!   section_map.rs  the return map of a proof
//!   prove.rs     a periodic orbit that exists, with a certificate
//!   prove_basin.rs  which starts come to which orbit, as a theorem
//! ```
//!
//! As `hopper` it holds no mathematics: the crates for any system answer.

mod basin;
mod basin_store;
mod branch;
pub(crate) mod cli;
mod columns;
mod diagram;
mod file;
mod period;
mod places;
mod prove;
mod prove_basin;
mod question;
mod returns;
mod run;
mod section;
mod section_map;
