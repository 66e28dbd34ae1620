//! Starts whose orbits belong to no attractor: why, and what helps.

use std::fmt;

/// A point beyond a border of the region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// The coordinate, from 0.
    pub coordinate: usize,
    /// The end of the region there.
    pub border: f64,
    /// The value of the coordinate.
    pub reached: f64,
}

impl Border {
    /// How far beyond the border the value is.
    pub(crate) fn excess(&self) -> f64 {
        (self.reached - self.border).abs()
    }
}

impl fmt::Display for Border {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Border { coordinate, border, reached } = self;
        write!(f, "coordinate {coordinate} reaches {reached} beyond the border {border}")
    }
}

/// Why the orbit of a start belongs to no attractor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnmatchedReason {
    /// The features of the orbit changed until the budget was used up.
    Budget,
    /// The features of the orbit are beside those of too few others, or of two groups.
    NoGroup,
    /// The orbit stayed outside the region.
    LeftRegion(Border),
    /// The orbit recurs, and leaves the region again and again: its attractor is cut by this border.
    CutByBorder(Border),
    /// The map has no value at a point of the orbit, or one that is not finite.
    Stopped,
    /// The orbit neither closes nor recurs within the budget: it still moves, or comes to its attractor too slowly.
    NotSettled {
        /// The distance by which the ends of its stretches move, a step, in the largest coordinate.
        drift: f64,
    },
    /// The orbit keeps to a few cells, but orbits that start in or beside these cells do not come to them and stay:
    /// the cells are a slow passage, or the attractor is too close to the boundary of its basin for this grid. The
    /// same for a group of features and orbits from beside it.
    NoTrap,
}

impl UnmatchedReason {
    /// The border beyond which the orbit went.
    fn border(&self) -> Option<Border> {
        match self {
            UnmatchedReason::LeftRegion(border) | UnmatchedReason::CutByBorder(border) => {
                Some(*border)
            }
            _ => None,
        }
    }
}

impl fmt::Display for UnmatchedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            UnmatchedReason::Budget => f.write_str("budget"),
            UnmatchedReason::NoGroup => f.write_str("no group"),
            UnmatchedReason::LeftRegion(border) => write!(f, "left the region: {border}"),
            UnmatchedReason::CutByBorder(border) => write!(f, "cut by the region: {border}"),
            UnmatchedReason::Stopped => f.write_str("stopped"),
            UnmatchedReason::NotSettled { drift } => {
                write!(f, "not settled: drift {drift:e} a step")
            }
            UnmatchedReason::NoTrap => f.write_str("no trap"),
        }
    }
}

/// A start whose orbit belongs to no attractor.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmatched {
    /// The start.
    pub start: Vec<f64>,
    /// The reason.
    pub reason: UnmatchedReason,
}

/// What would help a search that has found no attractor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remedy {
    /// A region that is larger at this border.
    LargerRegion(Border),
    /// More cells: candidates were refused on all grids up to this one.
    MoreCells {
        /// Cells along a side of the finest grid.
        tried: usize,
    },
    /// Longer orbits.
    LongerOrbits {
        /// The budget of the search.
        budget: usize,
        /// How fast the fastest of the orbits still moved, a step.
        drift: f64,
    },
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Remedy::LargerRegion(border) => {
                write!(f, "a larger region: {border}; or a distance of escape, if no orbit returns")
            }
            Remedy::MoreCells { tried } => write!(f, "more than {tried} cells a side"),
            Remedy::LongerOrbits { budget, drift } => {
                write!(f, "a budget above {budget} steps: orbits still drift by {drift:e} a step")
            }
        }
    }
}

/// What would help where no start belongs to an attractor: by the reason of most of them. `tried` is the number of
/// cells of the finest grid.
pub(crate) fn remedy(unmatched: &[Unmatched], budget: usize, tried: usize) -> Option<Remedy> {
    let reasons = || unmatched.iter().map(|own| own.reason);
    let border = reasons()
        .filter_map(|reason| reason.border())
        .max_by(|a, b| a.excess().total_cmp(&b.excess()));
    let drift = reasons()
        .filter_map(|reason| match reason {
            UnmatchedReason::NotSettled { drift } => Some(drift),
            _ => None,
        })
        .max_by(f64::total_cmp);
    let refused = reasons().any(|reason| reason == UnmatchedReason::NoTrap);
    let count = |kind: fn(&UnmatchedReason) -> bool| reasons().filter(kind).count();
    let choices = [
        (count(|reason| reason.border().is_some()), border.map(Remedy::LargerRegion)),
        (
            count(|reason| *reason == UnmatchedReason::NoTrap),
            refused.then_some(Remedy::MoreCells { tried }),
        ),
        (
            count(|reason| matches!(reason, UnmatchedReason::NotSettled { .. })),
            drift.map(|drift| Remedy::LongerOrbits { budget, drift }),
        ),
    ];
    choices.into_iter().max_by_key(|(count, _)| *count).and_then(|(_, remedy)| remedy)
}
