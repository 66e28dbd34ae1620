//! `hopper coverage`: the share of every basin in each pixel of a window of (M, α).
//!
//! A call that is killed leaves its finished columns, and the next call computes the others.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::column_bytes;
use crate::basins::job::{Job, Visit, Words};
use crate::basins::job_folder::{JobFolder, Place, Share};
use crate::basins::layer::window;
use crate::basins::options::mass_ratio;
use crate::basins::pieces::compute;
use crate::basins::rasters::{MASS_RATIOS, PIXELS};
use crate::basins::shares::{COLUMNS, LEGEND, MOST_PIXELS, PICTURE_FILE, RESULTS, finish};
use crate::basins::tables::{self, Tables};
use crate::basins::window::grid;
use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::values;
use crate::output::number;
use basin_of_attraction::{Grid, PixelShares};
use hopper_basin::{
    CoverageColumn, CoverageLimits, CoverageSummary, SHARE_VERSION, ShareColumn, ShareRaster,
    Upwards,
};
use hopper_figures::draw_coverage;
use serde_json::{Value, json};

/// The tolerances that are accepted. Below, a pixel beside a fixed point has more basins than can be found; above,
/// a picture means nothing.
const SMALLEST: f64 = 1e-6;
const LARGEST: f64 = 0.5;

/// The least number of `f64` in the undecided part of a pixel: images of gaps are known to some ten ulps.
const FEWEST_NUMBERS: f64 = 1e3;

/// What a job of `hopper coverage` is.
#[derive(Debug, Clone, PartialEq, clap::Args)]
pub(crate) struct CoverageOptions {
    /// The part of a pixel that may stay undecided [default: 0.05]
    #[arg(value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Mass ratios from and to [default: 0.1 1]
    #[arg(short = 'M', long, num_args = 2, value_names = ["FROM", "TO"], value_parser = mass_ratio, allow_negative_numbers = true)]
    pub(crate) mass_ratio: Option<Vec<f64>>,
    /// Lift-off speeds from and to, in m₂gω/k [default: the first and the sixth fixed point]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) speed: Option<Vec<f64>>,
    /// Pixels across and up [default: 1024 1024]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) pixels: Option<Vec<usize>>,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k.",
    limits: "At most 2²⁴ pixels. Each pixel has the shares of the basins in it at the mass ratio of its column: a \
             needle thinner than a pixel is a faint line. At most the given part of a pixel stays undecided, unless \
             too many basins meet there.\n\
             Pieces, parts and going on as in `hopper basins --help`.",
    is_filter: false,
    tables: &[&tables::SHARES, &tables::PARTS, &tables::FILES],
    examples: &[
        Example {
            about: "The share of every basin in each pixel.",
            line: "hopper coverage --mass-ratio 0.17 0.18 --speed 17 17.8 --pixels 8 32 --out coverage",
        },
        Example {
            about: "The same, more exactly, and its mean shares for a program.",
            line: "hopper coverage 0.01 --mass-ratio 0.17 0.18 --speed 17 17.8 --pixels 8 32 --out finer --json",
        },
    ],
};

/// The part of a pixel that may stay undecided unless another is given.
const TOLERANCE: f64 = 0.05;

impl Job for CoverageOptions {
    fn words(&self) -> Words {
        let mut words = Words::of("coverage");
        words.argument(self.tolerance);
        words.window(self.mass_ratio.as_deref(), self.speed.as_deref(), self.pixels.as_deref());
        words
    }

    fn visit(&self, visit: &mut Visit<'_>) -> Result<(), Error> {
        let coverage = self.coverage()?;
        visit(&coverage.description(), &coverage.work(), &RESULTS)
    }

    fn run(&self, place: &Place<'_>, call: &mut Call<'_>) -> Result<Tables, Error> {
        run(place, &self.coverage()?, call)
    }
}

impl CoverageOptions {
    fn coverage(&self) -> Result<Coverage, Error> {
        let mass_ratio = self.mass_ratio.as_deref().unwrap_or(&MASS_RATIOS);
        let pixels = self.pixels.as_deref().unwrap_or(&PIXELS);
        let grid = grid(mass_ratio, self.speed.as_deref(), pixels)?;
        Coverage::new(grid, self.tolerance.unwrap_or(TOLERANCE))
    }
}

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
            return Err(Error::misuse("TOLERANCE", number(tolerance), &reason));
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
                 give fewer rows, a higher window, or a larger tolerance",
                number(tolerance),
                number(open),
                number(least)
            );
            let speeds = format!("{} {}", number(y.left), number(y.right));
            return Err(Error::misuse("--speed", speeds, &reason));
        }
        Ok(Coverage { grid, limits: CoverageLimits { tolerance, ..CoverageLimits::default() } })
    }

    fn description(&self) -> String {
        let Coverage { grid, limits } = self;
        format!(
            "coverage to {:?}, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels; computation {SHARE_VERSION}",
            limits.tolerance,
            grid.x.left,
            grid.x.right,
            grid.y.left,
            grid.y.right,
            grid.columns,
            grid.rows
        )
    }

    fn work(&self) -> Work<'static> {
        let Grid { columns, rows, .. } = self.grid;
        let payload = Payload::Column { rows, may_be_blank: false };
        Work { folder: COLUMNS, unit: COLUMNS, count: columns, pixels: rows, payload }
    }
}

/// Computes a raster of shares over (M, α).
fn run(place: &Place<'_>, coverage: &Coverage, call: &mut Call<'_>) -> Result<Tables, Error> {
    let &Coverage { grid, limits } = coverage;
    let results = [PICTURE_FILE, LEGEND, RESULTS.digests];
    let job = JobFolder::open(place, coverage.description(), &results)?;
    let mut tables = Tables::default();
    let (work, count) = (coverage.work(), grid.columns);
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
            (grid((4.5, 20.0), 10, 10), 0.0, "TOLERANCE 0: "),
            (grid((4.5, 20.0), 10, 10), 0.6, "TOLERANCE 0.6: "),
            (grid((4.5, 20.0), 10, 10), f64::NAN, "TOLERANCE "),
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
