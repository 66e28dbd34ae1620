//! `basin-raster --coverage`: the share of every basin in each pixel of a window of (M, α).
//!
//! A run that is killed leaves its finished columns, and the next run computes the others.

use super::share_files::{LEGEND, MOST_PIXELS, PICTURE_FILE, write_results};
use super::{column_bytes, kept};
use crate::error::Error;
use crate::figures::basin_plot::Window;
use crate::figures::coverage_plot::{draw_coverage, undecided};
use basin_of_attraction::{Grid, PixelShares};
use hopper_basin::{
    CoverageColumn, CoverageGround, CoverageLimits, ShareColumn, ShareRaster, Upwards,
};
use passive_hopper::MassRatio;
use repository_tools::{Folder, say};
use resumable_job::{AtomicFile, Lock};
use std::path::Path;

/// The tolerances that are accepted. Below, a pixel beside a fixed point has more basins than can be found; above, a picture means nothing.
const SMALLEST: f64 = 1e-6;
const LARGEST: f64 = 0.5;

/// The least number of `f64` in the undecided part of a pixel: images of gaps are known to some ten ulps.
const FEWEST_NUMBERS: f64 = 1e3;

/// Runs the command.
pub(super) fn run(out: &Path, grid: Grid, tolerance: f64) -> Result<(), Error> {
    let limits = checked(&grid, tolerance)?;
    let folder = Folder::open(out)?;
    let lock = Lock::take(folder.path(), "basin-raster")?;
    // A result that cannot have its name is an error before the computation.
    for name in [PICTURE_FILE, LEGEND] {
        drop(AtomicFile::create(&folder.path().join(name))?);
    }
    let description = format!(
        "coverage to {tolerance:?}, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    );
    let column = |at: usize| {
        let own = CoverageColumn::of_grid(&grid, at, limits)?;
        Ok(column_bytes::bytes(Some(&ShareColumn::from(&own))))
    };
    let (kept, all) =
        kept::pieces(&folder, &lock, ("columns", &description), grid.columns, column)?;
    let all = all.iter().map(|bytes| column_bytes::column(bytes));
    let columns = all.collect::<Result<_, _>>()?;
    let raster = ShareRaster::from_columns(grid, Upwards::LiftOffSpeed, columns)?;
    let window = Window {
        name: "shares",
        mass_ratio: (grid.x.left, grid.x.right),
        alpha: (grid.y.left, grid.y.right),
        inset: None,
        tick_counts: (6, 8),
    };
    let notes = vec![note(&grid, limits, &raster)?];
    write_results(&folder, &lock, &raster, &draw_coverage(&window, &raster)?, notes)?;
    kept.remove(grid.columns)?;
    folder.remove_leftovers();
    drop(lock);
    say(folder.path().join(PICTURE_FILE).display())?;
    Ok(())
}

/// The limits, if the raster can be covered to this tolerance.
fn checked(grid: &Grid, tolerance: f64) -> Result<CoverageLimits, Error> {
    let fail = |text: String| Err(Error::CheckFailed(text));
    if !(SMALLEST..=LARGEST).contains(&tolerance) {
        return fail(format!(
            "--coverage {tolerance}: the undecided part of a pixel must be from {SMALLEST} to {LARGEST}; 0.05 is a good value"
        ));
    }
    let Grid { columns, rows, .. } = *grid;
    if columns.saturating_mul(rows) > MOST_PIXELS {
        return fail(format!(
            "--pixels {columns} {rows}: a raster of shares has at most {MOST_PIXELS} pixels; divide the window"
        ));
    }
    PixelShares::edges(grid.y, rows)?;
    let open = tolerance * grid.y.length() / rows as f64;
    let least = FEWEST_NUMBERS * f64::EPSILON * grid.y.right;
    if open < least {
        return fail(format!(
            "--speed {} {} with {rows} rows: {tolerance} of a pixel is {open:e}, and must be at least {least:e}, where f64 has a \
             thousand numbers; take fewer rows, a higher window, or a larger tolerance in --coverage",
            grid.y.left, grid.y.right
        ));
    }
    Ok(CoverageLimits { tolerance, ..CoverageLimits::default() })
}

/// What the shares stand on, and what is undecided, for the legend.
fn note(
    grid: &Grid,
    limits: CoverageLimits,
    raster: &ShareRaster,
) -> Result<serde_json::Value, Error> {
    let (mut by_laps, mut spacing) = (0, None);
    for at in 0..grid.columns {
        match CoverageGround::of(MassRatio::new(grid.x_at(at))?, grid.y, grid.rows, limits)? {
            CoverageGround::Laps => by_laps += 1,
            CoverageGround::Spacing { speeds } => spacing = Some(speeds),
        }
    }
    let (mut sum, mut most, mut above) = (0.0, 0.0, 0_u64);
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let open = undecided(raster, column, row);
            sum += open;
            most = f64::max(most, open);
            // Shares are stored in `f32`.
            above += u64::from(open > limits.tolerance + 1e-6);
        }
    }
    let mean = sum / (grid.columns * grid.rows) as f64;
    say(format_args!(
        "undecided: {:.4} % of the area, at most {most:.3} of a pixel; {above} pixels above {}; {by_laps} of {} columns by laps, which \
         miss no basin",
        100.0 * mean,
        limits.tolerance,
        grid.columns
    ))?;
    Ok(serde_json::json!({
        "tolerance": limits.tolerance,
        "mean_undecided": mean,
        "most_undecided_of_a_pixel": most,
        "pixels_above_tolerance": above,
        "columns_by_laps": by_laps,
        "columns_by_samples": grid.columns - by_laps,
        "spacing_of_samples": spacing,
    }))
}
