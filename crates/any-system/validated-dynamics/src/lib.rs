//! Proofs for hybrid systems, from their equations alone.

mod basins;
mod cells;
mod division;
mod enclosed_map;
mod expansion;
mod fixed_point;
mod frame;
mod matrix;
mod mode_series;
mod multipliers;
mod oriented_box;
mod piece;
mod run;
mod set;
mod start;
mod surface_image;
mod system;
mod trap;
mod tube;
mod undecided;
mod window;

pub use basins::{Division, Progress, ProvedBasins, ProvedFate};
pub use division::{Budget, Divided, divided, halves};
pub use enclosed_map::{Carried, EnclosedMap, FormulaMap, MapImage, SectionMap, StartSet};
pub use fixed_point::{ProvedFixedPoint, fixed_point};
pub use interval_arithmetic::Enclosure;
pub use matrix::Matrix;
pub use multipliers::{Multiplier, multipliers};
pub use piece::Piece;
pub use run::{Limits, ProvedEvent, ValidatedRun};
pub use set::AffineSet;
pub use start::Chart;
pub use system::ValidatedSystem;
pub use trap::Trap;
pub use undecided::{Error, Reason, Undecided};
