//! `hopper basins --coverage`: the share of every basin in each pixel of a window of (M, α).
//!
//! A call that is killed leaves its finished columns, and the next call computes the others.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::column_bytes;
use crate::basins::job_folder::{JobFolder, Share};
use crate::basins::layer::window;
use crate::basins::pieces::compute;
use crate::basins::shares::{COLUMNS, LEGEND, MOST_PIXELS, PICTURE_FILE, RESULTS, finish};
use crate::basins::tables::{self, Tables};
use crate::error::Error;
use crate::output::number;
use basin_of_attraction::{Grid, PixelShares};
use hopper_basin::{
    CoverageColumn, CoverageLimits, CoverageSummary, SHARE_VERSION, ShareColumn, ShareRaster,
    Upwards,
};
use hopper_figures::draw_coverage;
use serde_json::{Value, json};
use std::path::Path;

/// The tolerances that are accepted. Below, a pixel beside a fixed point has more basins than can be found; above,
/// a picture means nothing.
const SMALLEST: f64 = 1e-6;
const LARGEST: f64 = 0.5;

/// The least number of `f64` in the undecided part of a pixel: images of gaps are known to some ten ulps.
const FEWEST_NUMBERS: f64 = 1e3;

/// A raster of shares over (M, α).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coverage {
    grid: Grid,
    limits: CoverageLimits,
}

impl Coverage {
    /// The raster, if it can be covered to this tolerance.
    ///
    /// # Errors
    /// [`Error::Misuse`] if it cannot.
    pub(crate) fn new(grid: Grid, tolerance: f64) -> Result<Self, Error> {
        if !(SMALLEST..=LARGEST).contains(&tolerance) {
            let reason = format!(
                "the undecided part of a pixel must be from {SMALLEST} to {LARGEST}; give 0.05, which is a good value"
            );
            return Err(Error::misuse("--coverage", number(tolerance), &reason));
        }
        let Grid { columns, rows, y, .. } = grid;
        if columns.saturating_mul(rows) > MOST_PIXELS {
            let reason = format!(
                "a raster of shares has at most {MOST_PIXELS} pixels; give fewer, or divide the window"
            );
            return Err(Error::misuse("--pixels", format!("{columns} {rows}"), &reason));
        }
        let (open, least) =
            (tolerance * y.length() / rows as f64, FEWEST_NUMBERS * f64::EPSILON * y.right);
        if PixelShares::edges(y, rows).is_err() || open < least {
            let reason = format!(
                "with {rows} rows, {} of a pixel is {}, and must be at least {}, where f64 has a thousand numbers; \
                 give fewer rows, a higher window, or a larger number in --coverage",
                number(tolerance),
                number(open),
                number(least)
            );
            let speeds = format!("{} {}", number(y.left), number(y.right));
            return Err(Error::misuse("--speed", speeds, &reason));
        }
        Ok(Coverage { grid, limits: CoverageLimits { tolerance, ..CoverageLimits::default() } })
    }
}

/// Computes a raster of shares over (M, α).
pub(crate) fn run(
    place: (&Path, Share, bool),
    &Coverage { grid, limits }: &Coverage,
    call: &mut Call<'_>,
) -> Result<Tables, Error> {
    let description = format!(
        "coverage to {:?}, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels; computation {SHARE_VERSION}",
        limits.tolerance,
        grid.x.left,
        grid.x.right,
        grid.y.left,
        grid.y.right,
        grid.columns,
        grid.rows
    );
    let job = JobFolder::open(place, description, &[PICTURE_FILE, LEGEND, RESULTS.digests])?;
    let mut tables = Tables::default();
    let count = grid.columns;
    let payload = Payload::Column { rows: grid.rows, may_be_blank: false };
    let work = Work { folder: COLUMNS, unit: COLUMNS, count, pixels: grid.rows, payload };
    let legend = match job.complete(&RESULTS, &work, call)? {
        Some(legend) => legend,
        None => {
            let column = |at: usize| {
                let own = CoverageColumn::of_grid(&grid, at, limits)?;
                Ok(column_bytes::bytes(Some(&ShareColumn::from(&own))))
            };
            let finished = compute(&job, &work, call, column)?;
            if let Share::Part(part) = job.share {
                tables.push_part(part, COLUMNS, &finished);
                return Ok(tables);
            }
            let columns = (0..count).map(|at| column_bytes::column(&finished.kept.finished(at)?));
            let columns = columns.collect::<Result<_, _>>()?;
            let raster = ShareRaster::from_columns(grid, Upwards::LiftOffSpeed, columns)?;
            let notes = vec![ground(&grid, limits, &raster, call)?];
            let drawing = draw_coverage(&window(&grid, "shares"), &raster)?;
            finish(&job, &raster, &drawing, notes, (finished.kept, count), &call.interrupt)?
        }
    };
    tables.shares = tables::shares(&legend);
    tables.push_file(job.place_of(PICTURE_FILE), "the picture, colours mixed by shares");
    tables.push_file(
        job.place_of(LEGEND),
        "the labels, their mean shares and arrays, and what they stand on",
    );
    Ok(tables)
}

/// What the shares stand on, and what is undecided, for the legend.
fn ground(
    grid: &Grid,
    limits: CoverageLimits,
    raster: &ShareRaster,
    call: &mut Call<'_>,
) -> Result<Value, Error> {
    let found = CoverageSummary::new(raster, limits)?;
    call.note(&format!(
        "undecided: {:.4} % of the area, at most {:.3} of a pixel; {} pixels above {}; {} of {} columns by laps, which \
         miss no basin",
        100.0 * found.mean_undecided,
        found.most_undecided,
        found.above_tolerance,
        limits.tolerance,
        found.columns_by_laps,
        grid.columns
    ));
    Ok(json!({
        "tolerance": limits.tolerance,
        "mean_undecided": found.mean_undecided,
        "most_undecided_of_a_pixel": found.most_undecided,
        "pixels_above_tolerance": found.above_tolerance,
        "columns_by_laps": found.columns_by_laps,
        "columns_by_samples": grid.columns - found.columns_by_laps,
        "spacing_of_samples": found.spacing,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::Interval;

    #[test]
    fn rasters_that_cannot_be_covered_are_refused() {
        let grid = |y: (f64, f64), columns, rows| Grid {
            x: Interval::new(0.1, 0.2).unwrap(),
            y: Interval::new(y.0, y.1).unwrap(),
            columns,
            rows,
        };
        assert!(Coverage::new(grid((4.5, 20.0), 10, 10), 0.05).is_ok());
        for (grid, tolerance, option) in [
            (grid((4.5, 20.0), 10, 10), 0.0, "--coverage 0: "),
            (grid((4.5, 20.0), 10, 10), 0.6, "--coverage 0.6: "),
            (grid((4.5, 20.0), 10, 10), f64::NAN, "--coverage "),
            (grid((4.5, 20.0), 1 << 13, 1 << 13), 0.05, "--pixels 8192 8192: "),
            (grid((4.5, 4.5 + 1e-12), 10, 10), 0.05, "--speed 4.5 "),
        ] {
            let error = Coverage::new(grid, tolerance).unwrap_err();
            assert_eq!(error.exit_status(), 2);
            let text = error.to_string();
            assert!(text.starts_with(option) && text.contains("; give "), "{text}");
        }
    }
}
