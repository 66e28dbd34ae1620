//! Rasters of the paper's windows.

use super::{Measured, REPEATS, median};
use crate::error::Error;
use crate::repository::Bar;
use basin_of_attraction::{Grid, Interval, LabelImage};
use hopper_basin::{FIG_9, Fates, HopperFate, basin_raster, first_humps};
use passive_hopper::MassRatio;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Pixels along each side: a megapixel, the size in the documents.
const SIDE: usize = 1024;

/// The window of Fig. 6 from M = 0.1 on, or the window of Fig. 9.
fn grid(figure: u8, side: usize) -> Result<Grid, Error> {
    let (x, y) = match figure {
        6 => ((0.1, 1.0), (first_humps(5).left, first_humps(5).right)),
        _ => FIG_9,
    };
    let (x, y) = (Interval::new(x.0, x.1)?, Interval::new(y.0, y.1)?);
    Ok(Grid { x, y, columns: side, rows: side })
}

fn raster(grid: Grid) -> Result<LabelImage, Error> {
    Ok(basin_raster(grid, |_| ControlFlow::Continue(()))?)
}

/// The median time of a raster, and the raster. Every pixel is first compared with the fate of its centre.
fn checked_time(figure: u8, side: usize) -> Result<(Duration, LabelImage), Error> {
    let grid = grid(figure, side)?;
    let image = raster(grid)?;
    (0..grid.columns).into_par_iter().try_for_each(|column| {
        let fates = Fates::new(MassRatio::new(grid.x_at(column))?)?;
        for row in 0..grid.rows {
            let label =
                fates.fate(grid.y_at(row)).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
            if image.at(column, row) != Some(label) {
                return Err(Error::CheckFailed(format!(
                    "Fig. {figure}, pixel ({column}, {row}) of {side}²: {:?} instead of {label}",
                    image.at(column, row)
                )));
            }
        }
        Ok::<(), Error>(())
    })?;
    Ok((time(grid)?, image))
}

fn time(grid: Grid) -> Result<Duration, Error> {
    let times = (0..REPEATS).map(|_| {
        let begin = Instant::now();
        raster(grid).map(|_| begin.elapsed())
    });
    Ok(median(times.collect::<Result<_, Error>>()?))
}

/// The figures of rasters.
pub(super) fn measure(bar: &Bar) -> Result<Vec<Measured>, Error> {
    let figure = |name, value, unit: &'static str, checked: &str| Measured {
        name,
        value,
        unit,
        checked: checked.to_owned(),
    };
    let pixels = "every pixel against its fate";
    let ((six, image), (nine, _)) = (checked_time(6, SIDE)?, checked_time(9, SIDE)?);
    bar.set(3);
    let (four_times, _) = checked_time(6, 2 * SIDE)?;
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .map_err(|e| Error::CheckFailed(format!("no thread: {e}")))?;
    let (alone, same) = one.install(|| {
        let grid = grid(6, SIDE)?;
        Ok::<_, Error>((time(grid)?, raster(grid)? == image))
    })?;
    if !same {
        return Err(Error::CheckFailed("one thread gives another image".into()));
    }
    bar.set(4);
    let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
    let threads = rayon::current_num_threads();
    Ok(vec![
        figure("raster_fig6_ms", milliseconds(six), "ms", pixels),
        figure("raster_fig9_ms", milliseconds(nine), "ms", pixels),
        figure(
            "raster_growth_per_doubling",
            four_times.as_secs_f64() / six.as_secs_f64(),
            "",
            "every pixel of 1024² and 2048²",
        ),
        figure(
            "threads_speedup",
            alone.as_secs_f64() / six.as_secs_f64(),
            "",
            &format!("one thread against {threads}, the same image"),
        ),
    ])
}
