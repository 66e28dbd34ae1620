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

use crate::error::Error;
use theorem::Theorem;

/// A theorem that takes seconds: its name, and its proof at the size that its statement has.
pub type QuickTheorem = (&'static str, fn() -> Result<Theorem, Error>);

/// The theorems that take seconds, in the order of their proofs.
pub static QUICK_THEOREMS: &[QuickTheorem] = &[
    ("one-sudden", || Ok(one_sudden::one_sudden())),
    ("one-sided", || one_sided::one_sided(8)),
    ("crisis", || crisis::crises(10)),
    // The ends of traps at a thousand mass ratios.
    ("traps", || trap_edges::trap_edges(8, 1000)),
    ("everything-hops", everything_hops::everything_hops),
    ("rising", rising_windows),
];

/// The windows in which rasters take the map to rise, with the largest M.
fn rising_windows() -> Result<Theorem, Error> {
    let window = |n| Some((n, hopper_basin::rising_window(n)?.largest_mass_ratio));
    let windows: Vec<_> = (1..).map_while(window).collect();
    rising::rising(&windows)
}
