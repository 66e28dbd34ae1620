//! What another program needs to check a theorem.
//!
//! A certificate has the numbers of a proof and no formula: intervals of speeds, enclosures, bounds.
//! docs/certificates.md says what each kind of line means, and how `xtask/generators/check_certificate.py` checks
//! it.

use crate::fixed_points::fixed_point;
use crate::theorems::cells::ProvedStrip;
use basin_of_attraction::{Grid, Interval, Label};
use interval_arithmetic::Enclosure;

/// The version of the format. It changes with the meaning or the name of a field.
pub const CERTIFICATE_VERSION: u32 = 2;

/// Speeds with one fate, from `left` to `right`.
pub type BasinInterval = (Interval, Label);

/// Speeds between intervals of one fate.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinGap {
    /// The speeds.
    pub speeds: Interval,
    /// The length that a basin has of them at least. Of basins that are left out nothing is known.
    pub at_least: Vec<(Label, f64)>,
}

/// One line of a certificate.
#[derive(Debug, Clone, PartialEq)]
pub enum CertificateLine {
    /// The inequality of Theorem 20 of docs/theory.md: `available` < `needed`, for all mass ratios up to the largest.
    OneSudden {
        /// α*_1.
        fixed_point: Enclosure,
        /// M₁, from below.
        largest_mass_ratio: f64,
        /// An upper bound of V + Y/α*_1 after a sudden first landing.
        available: f64,
        /// A lower bound of what a second sudden lift-off needs.
        needed: f64,
    },
    /// Every speed from α*_n to `right` converges to α*_n, at this mass ratio.
    Trap {
        /// The hump.
        n: u64,
        /// α*_n.
        fixed_point: Enclosure,
        /// M.
        mass_ratio: f64,
        /// The end of the trap.
        right: f64,
        /// A speed beyond with f below α*_n, if one is claimed.
        beyond: Option<f64>,
    },
    /// The minimum of hump n reaches α*_n at a mass ratio of the interval.
    Crisis {
        /// The hump.
        n: u64,
        /// M_c(n).
        mass_ratio: Enclosure,
        /// A speed with f below α*_n at the upper end.
        speed: f64,
    },
    /// f² has a lower bound on speeds of a contact part, at one mass ratio.
    ContactPart {
        /// The hump.
        n: u64,
        /// M.
        mass_ratio: f64,
        /// The speeds.
        speeds: Enclosure,
        /// The bound.
        least_square: f64,
    },
    /// The two sides of Lemma 32 of docs/theory.md at α = kπ: `losses` ≤ `square`, with α*_1² among the losses.
    Losses {
        /// k.
        multiple_of_pi: u64,
        /// M.
        mass_ratio: f64,
        /// The left side, from above.
        losses: f64,
        /// α², from below.
        square: f64,
    },
    /// f rises on the speeds of a window at all mass ratios up to the largest; the boxes that follow cover them.
    RisingWindow {
        /// The window.
        n: u64,
        /// The speeds.
        speeds: Enclosure,
        /// The largest M.
        largest_mass_ratio: f64,
    },
    /// f² has a positive derivative by α on a box.
    RisingBox {
        /// The window.
        n: u64,
        /// The speeds.
        speeds: Enclosure,
        /// κ = M/(1+M).
        kappas: Enclosure,
    },
    /// The intervals of each fate at all mass ratios of a strip: disjoint, from the lowest up.
    Basins {
        /// M.
        mass_ratios: Interval,
        /// The intervals.
        intervals: Vec<BasinInterval>,
    },
    /// The gaps between the intervals of the line of basins before, and parts of gaps: disjoint, from the lowest up.
    Gaps(Vec<BasinGap>),
    /// So many lines of [`CertificateLine::Basins`], which are too long to be held: those of
    /// [`proved_strips`](crate::proved_strips), from the left.
    Strips(usize),
    /// The fraction of a basin on humps 1 to `humps`, at the mass ratio of the line of basins before.
    Fraction {
        /// The basin.
        label: Label,
        /// The number of humps.
        humps: u64,
        /// The fraction by length.
        uniform: Enclosure,
        /// The mean of the fractions of the humps.
        by_humps: Enclosure,
    },
    /// The pixels of a figure; the lines that follow are its columns from the left, or the strips of their mass ratios.
    Grid(Grid),
    /// The speeds in the middle of the rows, from the lowest up.
    Speeds(Vec<f64>),
    /// The fates of all speeds at one mass ratio, and traps in which their orbits end.
    Points {
        /// M.
        mass_ratio: f64,
        /// The traps.
        traps: Vec<BasinInterval>,
        /// One for each speed.
        labels: Vec<Label>,
    },
    /// The share of a basin of the window's area.
    Area {
        /// The basin.
        label: Label,
        /// The share.
        share: Enclosure,
    },
    /// The edges of the rows, and the number of cells that lie in intervals of one fate at all their mass ratios.
    Cells {
        /// The edges, from the lowest up.
        edges: Vec<f64>,
        /// The number.
        of_one_basin: usize,
    },
}

impl CertificateLine {
    /// A trap, whose left end is α*_n.
    pub(crate) fn trap(n: u64, mass_ratio: f64, right: f64, beyond: Option<f64>) -> Self {
        CertificateLine::Trap { n, fixed_point: fixed_point(n), mass_ratio, right, beyond }
    }

    /// The intervals of a strip.
    pub fn of_strip((mass_ratios, line): ProvedStrip) -> Self {
        CertificateLine::Basins { mass_ratios, intervals: line.into_intervals() }
    }

    /// The number of lines that it has in a certificate.
    pub fn lines(&self) -> usize {
        if let CertificateLine::Strips(count) = self { *count } else { 1 }
    }
}
