//! One column of a coverage raster.

use crate::circle::share_column::ShareColumn;
use crate::coverage::coverage_limits::{CoverageGround, CoverageLimits};
use crate::coverage::laps_sweep::laps_are_known;
use crate::coverage::line_basins::{by_fates, by_laps};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{Interval, Label, PixelShares};
use passive_hopper::{MassRatio, alpha_star};

/// The basins in a window of speeds at one mass ratio: as intervals, and as shares of pixels.
///
/// Where all laps of the map are known, a gap between two speeds has a label if its image lies in an interval of
/// known label. The sweep goes upwards from 0: orbits descend, so that images lie where the labels are known
/// already. What is not decided is divided at the guessed preimages of the known intervals, until less than the
/// tolerance is open (docs/theory.md, Theorem 95). So a basin inside a pixel is not missed, however thin it is: it
/// is labelled, or open. Elsewhere the fates of some speeds of each pixel decide, and the places where they change
/// are bisected ([`CoverageGround`]).
///
/// ```
/// use basin_of_attraction::Interval;
/// use hopper_basin::{CoverageColumn, CoverageGround, CoverageLimits, Fates, HopperFate};
/// use passive_hopper::MassRatio;
/// // The share of the basin of α*_1 in the lower one of two pixels.
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let window = Interval::new(8.0, 9.0)?;
/// let column = CoverageColumn::new(&fates, window, 2, CoverageLimits::default())?;
/// let share = column.shares().of(HopperFate::label_of_fixed_point(1), 0);
/// assert_eq!(column.ground(), CoverageGround::Laps);
/// assert!(share.upper - share.lower <= 0.05);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CoverageColumn {
    intervals: Vec<(Interval, Label)>,
    shares: PixelShares,
    ground: CoverageGround,
}

impl CoverageColumn {
    /// The shares in `pixels` equal parts of `window`.
    ///
    /// # Errors
    /// [`Error::Window`] if the window goes below zero, or contains fixed points without labels;
    /// [`Error::CoverageLimits`]; [`Error::TooManySpeeds`]; [`Error::BasinOfAttraction`] as for [`PixelShares::edges`].
    pub fn new(
        fates: &Fates,
        window: Interval,
        pixels: usize,
        limits: CoverageLimits,
    ) -> Result<Self, Error> {
        check_window(window)?;
        limits.check()?;
        let ground = CoverageGround::of(fates.map().mass_ratio(), window, pixels, limits)?;
        let edges = PixelShares::edges(window, pixels)?;
        let intervals = match ground {
            CoverageGround::Laps => by_laps(fates, &edges, limits)?,
            CoverageGround::Spacing { .. } => by_fates(fates, window, pixels, limits)?,
        };
        let shares = PixelShares::of_intervals(&intervals, window, pixels)?;
        Ok(CoverageColumn { intervals, shares, ground })
    }

    /// Disjoint intervals from the lowest up, each with the label of all its speeds. What is between them is undecided.
    pub fn intervals(&self) -> &[(Interval, Label)] {
        &self.intervals
    }

    /// The share of every basin in each pixel, the lowest first.
    pub fn shares(&self) -> &PixelShares {
        &self.shares
    }

    /// What the labels of the intervals stand on.
    pub fn ground(&self) -> CoverageGround {
        self.ground
    }
}

impl CoverageGround {
    /// What a [column](CoverageColumn::new) of these pixels stands on.
    ///
    /// # Errors
    /// As [`CoverageColumn::new`].
    pub fn of(
        mass_ratio: MassRatio,
        window: Interval,
        pixels: usize,
        limits: CoverageLimits,
    ) -> Result<Self, Error> {
        check_window(window)?;
        limits.check()?;
        if laps_are_known(mass_ratio, window.right) {
            return Ok(CoverageGround::Laps);
        }
        let gaps = pixels.saturating_mul(limits.samples).max(1);
        Ok(CoverageGround::Spacing { speeds: window.length() / gaps as f64 })
    }
}

/// Returns an error if speeds of a window are negative, or their fixed points have no labels.
fn check_window(window: Interval) -> Result<(), Error> {
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    let Interval { left: bottom, right: top } = window;
    if bottom >= 0.0 && bottom < top && top <= largest {
        return Ok(());
    }
    Err(Error::Window { bottom, top, largest })
}

impl From<&CoverageColumn> for ShareColumn {
    /// The certain shares, rounded down to `f32`.
    fn from(column: &CoverageColumn) -> Self {
        let shares = &column.shares;
        let rows = (0..shares.pixels()).filter_map(|row| shares.certain(row));
        let rounded = rows.flatten().map(|&share| rounded_down(share)).collect();
        ShareColumn { labels: shares.labels().to_vec(), shares: rounded }
    }
}

/// The largest `f32` that is not above a number from 0 to 1.
fn rounded_down(share: f64) -> f32 {
    let nearest = share as f32;
    if f64::from(nearest) > share { nearest.next_down() } else { nearest }
}
