//! `hopper basins`, `coverage`, `scales` and `zoom`: how is a raster computed that takes hours, on one computer or on
//! many, and is never lost or spoiled?
//!
//! ```text
//!   options ─► job ─► job_folder ─► pieces ─────────► rasters (layer), coverage, shares, zoom ─► tables
//!              words    lock          find, compute,      join, draw, sum up
//!                       job.txt       progress, signals
//!                       call.txt ─► status, going on
//! ```
//!
//! A job is cut into pieces: tiles of a raster ([`rasters`], [`layer`]), columns of shares ([`shares`],
//! [`coverage`]) or frames of a zoom ([`zoom`]). A folder has one job ([`job_folder`]), and the call that began it
//! ([`job`]), so that it goes on, or is looked at ([`status`]), without being given again. Its pieces are found or
//! computed ([`pieces`]) with the progress shown and signals obeyed ([`Interrupt`]); [`call`] has what they need.
//! [`picture`] and [`column_bytes`] are forms of data. A [`preview`] has no folder.

mod call;
mod column_bytes;
mod coverage;
mod job;
mod job_folder;
mod layer;
mod options;
mod picture;
mod pieces;
mod preview;
mod rasters;
mod shares;
mod status;
mod tables;
mod window;
mod zoom;

use crate::commands::page::Page;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::options::form::OutputOptions;
use crate::streams::Streams;
use call::Call;
pub(crate) use coverage::CoverageOptions;
use job::{Job, job_in};
use job_folder::{Place, Share};
pub(crate) use options::{Action, JobOptions, Options, PAGE};
use options::{FolderOptions, PlaceOptions, RasterOptions};
pub(crate) use shares::ScalesOptions;
use status::{Look, STATUS, status};
use std::path::Path;
pub(crate) use zoom::ZoomOptions;

/// The help of the commands with jobs of other kinds.
pub(crate) const PAGES: [(&str, &Page); 3] =
    [("coverage", &coverage::PAGE), ("scales", &shares::PAGE), ("zoom", &zoom::PAGE)];

/// Runs `hopper basins`.
///
/// # Errors
/// [`Error::Misuse`] before anything is written; [`Error::Interrupted`] after a signal; failures of files.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    match &options.action {
        Some(Action::Status(folder)) => return look(folder, Look::Names, streams),
        Some(Action::Verify(folder)) => return look(folder, Look::Bytes, streams),
        None => {}
    }
    let Some(out) = &options.out else {
        let place = &options.place;
        let has_place = place.part.is_some() || place.join || place.force;
        if has_place || options.job.old_job().is_some() {
            return Err(Error::Misuse(
                "--out: the folder for the results is missing; give it".into(),
            ));
        }
        return preview::run(options, streams);
    };
    let Options { job, place, output, .. } = options;
    if *job == RasterOptions::default() && resumable_job::is_claimed(out) {
        // Without any option the job is that of the folder, which is refused if the folder does not say it.
        return run_job(&*job_in(out)?, (out, place), output, &mut streams);
    }
    match job.old_job() {
        Some((old, instead)) => {
            run_job(&*old, (out, place), output, &mut streams)?;
            let note = format_args!("{instead}; the option goes with version 0.4");
            output.note(&mut streams, note);
            Ok(())
        }
        None => run_job(job, (out, place), output, &mut streams),
    }
}

/// Runs a command with a job of another kind.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_other<T: Job + clap::Args>(
    options: &JobOptions<T>,
    mut streams: Streams<'_>,
) -> Result<(), Error> {
    run_job(&options.job, (&options.out, &options.place), &options.output, &mut streams)
}

fn run_job(
    job: &dyn Job,
    (out, options): (&Path, &PlaceOptions),
    output: &OutputOptions,
    streams: &mut Streams<'_>,
) -> Result<(), Error> {
    let form = output.form(&tables::ALL)?;
    let share = match (options.part, options.join) {
        (Some(part), _) => Share::Part(part),
        (None, true) => Share::Join,
        (None, false) => Share::Whole,
    };
    let force = options.force;
    let words = || if force { job.words() } else { job.words_in(out) };
    let place = Place { out, share, force, call: &|| words().line() };
    let mut call = Call {
        interrupt: Interrupt::watch()?,
        quiet: output.is_quiet(),
        messages: &mut *streams.messages,
    };
    let tables = job.run(&place, &mut call).map_err(|error| match error {
        Error::Interrupted { status, done } if force => {
            Error::Interrupted { status, done: format!("{done}, which --force would remove") }
        }
        other => other,
    })?;
    form.print(&tables.into_all(), streams.output)
}

/// Prints how far the job in a folder is.
fn look(options: &FolderOptions, look: Look, streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(&[&STATUS])?;
    let (table, verdict) = status(&options.folder, look)?;
    form.print(&[table], streams.output)?;
    verdict
}
