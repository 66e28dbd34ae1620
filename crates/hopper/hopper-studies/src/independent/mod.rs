//! By what are claims tested that does not contain them?
//!
//! | file | how a hop is computed |
//! |---|---|
//! | `map.rs` | the printed Eqs. 6–8; the stable map |
//! | `blind_landing.rs` | a landing by Eqs. 6 and 8 that is searched without brackets from theory, and one found by an execution that samples the height |
//! | `integrated_hopper.rs` | the equations of motion, integrated |
//! | `trap_edge.rs` | the edge of a trap, searched on any map |
//! | `followed_orbits.rs` | fates of orbits of any map, with these edges |

pub(crate) mod blind_landing;
pub(crate) mod followed_orbits;
pub(crate) mod integrated_hopper;
pub(crate) mod map;
pub(crate) mod trap_edge;
