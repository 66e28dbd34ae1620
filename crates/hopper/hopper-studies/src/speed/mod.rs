//! The figures of speed. Each is measured after its output was compared with the reference.

mod hops;
mod rasters;
mod zooms;

use crate::error::Error;
use crate::repository::Progress;
use crate::timing::sin_cos_seconds;
use std::time::Duration;

/// A figure of speed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measured {
    pub(crate) name: &'static str,
    pub(crate) value: f64,
    pub(crate) unit: &'static str,
    /// The reference with which its output was compared.
    pub(crate) checked: String,
}

/// Number of repeats of a raster; the median is used. A raster takes some 60 ms, so that fifteen take a second. The
/// median then ignores up to seven repeats that another process disturbed.
const REPEATS: usize = 15;

/// All figures, measured in one run.
pub(crate) fn measure(progress: &Progress) -> Result<Vec<Measured>, Error> {
    let bar = progress.bar("speed", 5);
    let (checked, landings) = (hops::check()?, hops::check_landings()?);
    bar.set(1);
    // A processor is slower just after an idle time. The unit is therefore measured before and after the hops, and the
    // smaller time is used.
    let before = sin_cos_seconds();
    let (scalar, bulk, landing) = (hops::scalar_time(), hops::bulk_time(), hops::landing_time());
    let unit = before.min(sin_cos_seconds());
    bar.set(2);
    let figure = |name, value, unit| Measured { name, value, unit, checked: checked.clone() };
    let mut figures = vec![
        figure("sin_cos", unit * 1e9, "ns"),
        figure("hop_scalar_per_sin_cos", scalar / unit, "sin_cos"),
        figure("hop_bulk_per_sin_cos", bulk / unit, "sin_cos"),
        Measured { checked: landings, ..figure("landing_per_sin_cos", landing / unit, "sin_cos") },
        figure("hops_per_second_per_core", 1.0 / bulk, "1/s"),
    ];
    figures.extend(rasters::measure(&bar)?);
    figures.extend(zooms::measure()?);
    bar.set(5);
    bar.finish();
    Ok(figures)
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}
