//! A job: what its folder keeps of the call, and how it is found there again.

use crate::basins::call::{Call, Work};
use crate::basins::coverage::CoverageOptions;
use crate::basins::job_folder::{Place, Results, read_call};
use crate::basins::options::RasterOptions;
use crate::basins::shares::ScalesOptions;
use crate::basins::tables::Tables;
use crate::basins::zoom::ZoomOptions;
use crate::error::Error;
use clap::Parser;
use std::fmt::Debug;
use std::path::Path;

/// Is told the job of pieces, in the words of `job.txt`, the pieces, and their results.
pub(crate) type Visit<'a> = dyn FnMut(&str, &Work<'_>, &Results<'_>) -> Result<(), Error> + 'a;

/// A job of one of the kinds.
pub(crate) trait Job: Debug {
    /// The call, as it would be typed, without its place.
    fn words(&self) -> Words;

    /// The same, with what earlier calls of this job have added to its folder.
    fn words_in(&self, _folder: &Path) -> Words {
        self.words()
    }

    /// Visits its pieces, kind by kind.
    ///
    /// # Errors
    /// [`Error::Misuse`] for options that no job has; those of `visit`.
    fn visit(&self, visit: &mut Visit<'_>) -> Result<(), Error>;

    /// Computes what is missing.
    ///
    /// # Errors
    /// [`Error::Misuse`] before anything is written; [`Error::Interrupted`] after a signal; failures of files.
    fn run(&self, place: &Place<'_>, call: &mut Call<'_>) -> Result<Tables, Error>;
}

/// A call in words. Numbers have the digits that read back as the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Words(Vec<String>);

impl Words {
    /// The command.
    pub(crate) fn of(command: &str) -> Self {
        Words(vec!["hopper".into(), command.into()])
    }

    /// Adds an argument, if it is given.
    pub(crate) fn argument(&mut self, value: Option<impl Debug>) {
        self.0.extend(value.map(|value| word(&value)));
    }

    /// Adds an option with its values, if it is given.
    pub(crate) fn option(&mut self, name: &str, values: Option<&[impl Debug]>) {
        if let Some(values) = values {
            self.0.push(name.into());
            self.0.extend(values.iter().map(|value| word(value)));
        }
    }

    /// Adds the options of a window.
    pub(crate) fn window(
        &mut self,
        mass_ratio: Option<&[f64]>,
        speed: Option<&[f64]>,
        pixels: Option<&[usize]>,
    ) {
        self.option("--mass-ratio", mass_ratio);
        self.option("--speed", speed);
        self.option("--pixels", pixels);
    }

    /// The words as one line. None has a space.
    pub(crate) fn line(&self) -> String {
        self.0.join(" ")
    }
}

/// A number with all its digits; a text without its quotes.
fn word(value: &dyn Debug) -> String {
    format!("{value:?}").trim_matches('"').to_owned()
}

/// A call that a folder keeps.
#[derive(Debug, Parser)]
#[command(name = "hopper")]
enum Stored {
    Basins(RasterOptions),
    Coverage(CoverageOptions),
    Scales(ScalesOptions),
    Zoom(ZoomOptions),
}

/// The job whose call a folder keeps.
///
/// # Errors
/// [`Error::Misuse`] for a folder without one; [`Error::Job`] if it cannot be read.
pub(crate) fn job_in(folder: &Path) -> Result<Box<dyn Job>, Error> {
    Ok(match stored(folder)? {
        Stored::Basins(job) => match job.old_job() {
            Some((job, _)) => job,
            None => Box::new(job),
        },
        Stored::Coverage(job) => Box::new(job),
        Stored::Scales(job) => Box::new(job),
        Stored::Zoom(job) => Box::new(job),
    })
}

/// The raster whose call a folder keeps, if it is one.
pub(crate) fn raster_in(folder: &Path) -> Option<RasterOptions> {
    match stored(folder) {
        Ok(Stored::Basins(job)) => Some(job),
        _ => None,
    }
}

fn stored(folder: &Path) -> Result<Stored, Error> {
    let call = read_call(folder)?;
    Stored::try_parse_from(call.split_whitespace()).map_err(|_| {
        let reason =
            "its call.txt is damaged, or of another version; give the whole call, with its options";
        Error::misuse("folder", folder.display(), reason)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words that a folder keeps give the same job.
    #[test]
    fn calls_read_back() {
        for call in [
            "hopper basins --layer label",
            "hopper basins --mass-ratio 0.1 1.0 --speed 0.0 17.300000000000004 --pixels 3 4 --layer label hops",
            "hopper coverage",
            "hopper coverage 0.01 --pixels 3 4",
            "hopper scales 2 --mass-ratio 0.1 0.2 --offset 1e-2 1e-3000",
            "hopper scales 2 --preimage 0.1 7.5",
            "hopper scales 2 --turns 1e-7",
            "hopper zoom 0.12 11.9 --frames 3 --step 50.0 --pixels 3 4",
        ] {
            let words = |call: &str| match Stored::try_parse_from(call.split_whitespace()).unwrap()
            {
                Stored::Basins(job) => job.words(),
                Stored::Coverage(job) => job.words(),
                Stored::Scales(job) => job.words(),
                Stored::Zoom(job) => job.words(),
            };
            assert_eq!(words(call).line(), call);
            assert_eq!(words(&words(call).line()), words(call));
        }
    }
}
