//! How a search for zeros starts: on a side, on a zero that it leaves, before a zero, or behind a jump.

use super::zero_search::{Phase, ZeroSearch};
use crate::guard::Direction;
use interval_arithmetic::Enclosure;

impl ZeroSearch {
    /// Starts at `time`, where the function is clearly on `side`, ±1.
    pub(crate) fn on_side(direction: Direction, time: f64, side: f64) -> Self {
        ZeroSearch {
            direction,
            time,
            side: Some(side),
            clear: time,
            phase: Phase::OnSide,
            unclear: false,
            level: 0.0,
            level_error: 0.0,
            hidden: None,
            left_hidden: false,
        }
    }

    /// Starts at `time` on a zero: the computed `value` counts as zero, with an error of at least its size. The
    /// function leaves to `side`, if that is known; a side of 0 says that it stays there, as far as the start
    /// shows.
    pub(crate) fn leaving(
        direction: Direction,
        (time, value): (f64, f64),
        error: f64,
        side: Option<f64>,
    ) -> Self {
        ZeroSearch {
            side: side.filter(|side| *side != 0.0),
            phase: if side == Some(0.0) { Phase::Staying } else { Phase::Leaving },
            unclear: true,
            level: value,
            level_error: error.max(value.abs()),
            ..Self::on_side(direction, time, 0.0)
        }
    }

    /// Starts at `time` on `side`, ±1, although rounding may hide the function there: its zero is still to come.
    pub(crate) fn before_zero(direction: Direction, time: f64, side: f64, error: f64) -> Self {
        ZeroSearch { unclear: true, level_error: error, ..Self::on_side(direction, time, side) }
    }

    /// Starts at `time` on `side`, ±1, behind a zero that the function has had, at a jump: it passes to its other
    /// side first.
    #[cfg(feature = "ode")]
    pub(crate) fn passing(direction: Direction, time: f64, side: f64) -> Self {
        ZeroSearch { phase: Phase::Passing, ..Self::on_side(direction, time, side) }
    }

    /// Starts at `time`, where `at` encloses the function and `value` is the computed one, wrong by `error` at
    /// most. The side to which the function leaves a zero there may be known.
    pub(crate) fn new(
        direction: Direction,
        (time, value): (f64, f64),
        at: Enclosure,
        error: f64,
        leaving: Option<f64>,
    ) -> Self {
        match (leaving, at.widened(error).sign()) {
            (None, Some(side)) => Self::on_side(direction, time, side),
            // A side that the bounds show is the height of a jump at the start.
            (Some(leaving), Some(side)) if leaving == side => {
                Self::before_zero(direction, time, side, error)
            }
            _ => Self::leaving(direction, (time, value), error.max(at.magnitude()), leaving),
        }
    }
}
