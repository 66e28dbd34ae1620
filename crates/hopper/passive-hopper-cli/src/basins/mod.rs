//! `hopper basins`: how is a raster computed that takes hours, on one computer or on many, and is never lost or
//! spoiled?
//!
//! ```text
//!   options ─► window ─► job_folder ─► pieces ─────────► rasters (layer), shares, zoom ─► tables
//!                          lock          find, compute,      join, draw, sum up
//!                          job.txt       progress, signals
//! ```
//!
//! A job is cut into pieces: tiles of a raster ([`rasters`], [`layer`]), columns of shares ([`shares`],
//! [`coverage`]) or frames of a zoom ([`zoom`]). A folder has one job ([`job_folder`]). Its pieces are found or
//! computed ([`pieces`]) with the progress shown and signals obeyed ([`Interrupt`]); [`call`] has what they need.
//! [`picture`] and [`column_bytes`] are forms of data.

mod call;
mod column_bytes;
mod coverage;
mod job_folder;
mod layer;
mod options;
mod picture;
mod pieces;
mod rasters;
mod shares;
mod tables;
mod window;
mod zoom;

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::streams::Streams;
use call::Call;
use job_folder::Share;
use layer::StoredLayer;
pub(crate) use options::{Options, PAGE};

/// Pixels across and up unless others are given.
const PIXELS_OF_RASTER: [usize; 2] = [1024, 1024];
const PIXELS_OF_FRAME: [usize; 2] = [320, 320];

/// Runs the command.
///
/// # Errors
/// [`Error::Misuse`] before anything is written; [`Error::Interrupted`] after a signal; failures of files.
pub(crate) fn run(options: &Options, streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let share = match (options.part, options.join) {
        (Some(part), _) => Share::Part(part),
        (None, true) => Share::Join,
        (None, false) => Share::Whole,
    };
    let place = (options.out.as_path(), share, options.force);
    let pixels = |default: [usize; 2]| options.pixels.clone().unwrap_or(default.to_vec());
    let mut call = Call {
        interrupt: Interrupt::watch()?,
        quiet: options.output.is_quiet(),
        messages: streams.messages,
    };
    let tables = if let Some(n) = options.about {
        shares::run(place, &shares::Shares::new(n, options, &pixels(PIXELS_OF_RASTER))?, &mut call)?
    } else if let Some(&[mass_ratio, speed]) = options.zoom.as_deref() {
        let [columns, rows] = window::pair_of_pixels(&pixels(PIXELS_OF_FRAME))?;
        let (frames, step) = (options.frames, options.step);
        let zoom = zoom::Zoom { mass_ratio, speed, frames, step, columns, rows };
        zoom::run(place, &zoom, &mut call)?
    } else {
        let pixels = pixels(PIXELS_OF_RASTER);
        let grid = window::grid(&options.mass_ratio, options.speed.as_deref(), &pixels)?;
        match options.coverage {
            Some(tolerance) => {
                coverage::run(place, &coverage::Coverage::new(grid, tolerance)?, &mut call)?
            }
            None => {
                let layers = options.layer.iter().filter_map(|key| StoredLayer::of(key));
                rasters::run(place, &grid, &layers.collect::<Vec<_>>(), &mut call)?
            }
        }
    };
    form.print(&tables.into_all(), streams.output)
}
