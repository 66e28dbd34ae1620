//! The parts of the line of speeds: sudden windows and contact parts.

use crate::fixed_points::fixed_point;
use interval_arithmetic::{Enclosure, PI};

/// A part of the speeds on which the first landing is of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpeedPart {
    /// (α*_n, (n+1)π): contact follows.
    Contact(u64),
    /// (nπ, α*_n), n ≥ 1: a sudden lift-off follows.
    Window(u64),
}

impl SpeedPart {
    /// The part that contains all speeds of an interval; `None` if it reaches to a multiple of π or a fixed point.
    pub(crate) fn of(alpha: Enclosure) -> Option<Self> {
        if !(alpha.low() > 0.0 && alpha.high() < 1e9) {
            return None;
        }
        let k = (alpha.low() / std::f64::consts::PI).floor();
        let (begin, end) = (PI * k, PI * (k + 1.0));
        if !((k == 0.0 || begin.high() <= alpha.low()) && alpha.high() <= end.low()) {
            return None;
        }
        let star = fixed_point(k as u64);
        if alpha.high() <= star.low() && k >= 1.0 {
            Some(SpeedPart::Window(k as u64))
        } else if alpha.low() >= star.high() {
            Some(SpeedPart::Contact(k as u64))
        } else {
            None
        }
    }
}
