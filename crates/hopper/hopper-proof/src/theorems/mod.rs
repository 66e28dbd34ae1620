//! What is proved, and by which steps?
//!
//! ```text
//!   theorem.rs          a statement with the steps of its proof
//!   digits.rs           bounds as they are printed
//!   one_sudden.rs       at most one sudden lift-off for M ≤ 0.9056…
//!   one_sided.rs        α*_n attracts from the right and repels to the left
//!   crisis.rs           the mass ratios at which traps reach through their humps
//!   trap_edges.rs       the ends of traps at a thousand mass ratios
//!   everything_hops.rs  below the first crisis all speeds from α*_1 up hop for ever
//!   rising.rs           the map rises in its windows
//!   measures.rs         the fractions of the basins at one mass ratio
//!   raster.rs           the basins over a window: every point
//!   cells.rs            every cell of it, as a whole
//!   raster_theorems.rs  the statements that these make
//! ```

pub(crate) mod cells;
pub(crate) mod crisis;
pub(crate) mod digits;
pub(crate) mod everything_hops;
pub(crate) mod measures;
pub(crate) mod one_sided;
pub(crate) mod one_sudden;
pub(crate) mod raster;
pub(crate) mod raster_theorems;
pub(crate) mod rising;
pub(crate) mod theorem;
pub(crate) mod trap_edges;
