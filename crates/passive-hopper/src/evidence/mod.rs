//! How large can the error of a hop be, and how large is it?
//!
//! ```text
//!   solver.rs          the ways to compute a hop, from the kernel to 1024 bits
//!   traced_hop.rs      a hop by one of them: every landing with its bounds, unrounded
//!   bounded_hop.rs     a hop as users see it, with its bounds
//!   reference_hop.rs   a hop in longer arithmetic, and the errors of other ways against it
//!   reference_local_hop.rs   a hop near a fixed point in 512 or 1024 bits
//!   function_errors.rs the same for sines and cosines
//!   compared.rs        an actual error beside its bound
//! ```
//!
//! Each way is the code that computes hops, watched: the room contains no second solver. It uses all other rooms.

pub(crate) mod bounded_hop;
pub(crate) mod compared;
pub(crate) mod function_errors;
pub(crate) mod reference_hop;
pub(crate) mod reference_local_hop;
pub(crate) mod solver;
pub(crate) mod traced_hop;
