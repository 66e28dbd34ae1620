//! How large can the error of a hop be, and how large is it?
//!
//! ```text
//!   solver.rs          the ways to compute a hop, from the kernel to 1024 bits
//!   traced_hop.rs      a hop by one of them: every landing with its bounds, unrounded
//!   bounded_hop.rs     a hop as users see it, with its bounds
//!   enclosed.rs        a number with a bound on its error
//!   enclosed_hop.rs    a hop with all its numbers enclosed
//!   enclosed_state.rs  the positions and velocities of both masses, enclosed
//!   enclosed_touch.rs  the mass ratio at which the map's minimum touches a fixed point or zero, enclosed
//!   reference_hop.rs   a hop in longer arithmetic, and the errors of other ways against it
//!   reference_local_hop.rs   a hop near a fixed point in 512 or 1024 bits
//!   function_errors.rs the same for sines and cosines
//!   compared.rs        an actual error beside its bound
//! ```
//!
//! Each way is the code that computes hops, watched: the room contains no second solver. It uses all other rooms.

pub(crate) mod bounded_hop;
pub(crate) mod compared;
pub(crate) mod enclosed;
pub(crate) mod enclosed_hop;
pub(crate) mod enclosed_state;
pub(crate) mod enclosed_touch;
pub(crate) mod function_errors;
pub(crate) mod reference_hop;
pub(crate) mod reference_local_hop;
pub(crate) mod solver;
pub(crate) mod traced_hop;
