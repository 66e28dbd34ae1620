//! What is proved of all speeds of an interval.

use basin_of_attraction::Label;

/// What is proved of a cell: all speeds of an interval, at all mass ratios of a strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// All its speeds have this fate, at all its mass ratios.
    Basin(Label),
    /// It contains speeds of two fates.
    Cut,
    /// Neither is proved.
    Open,
}
