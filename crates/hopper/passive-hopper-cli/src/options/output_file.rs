//! Files for figures and data: their ending says the format.

use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::refusal::shortened;
use crate::streams::Streams;
use resumable_job::{AtomicFile, destination, write_atomically};
use std::path::{Path, PathBuf};

/// The format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Csv,
    Svg,
    Png,
    Apng,
    Gif,
}

/// The endings of the formats.
const ENDINGS: [(&str, Format); 5] = [
    ("csv", Format::Csv),
    ("svg", Format::Svg),
    ("png", Format::Png),
    ("apng", Format::Apng),
    ("gif", Format::Gif),
];

/// A file, or standard output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OutputFile {
    /// `None` for standard output.
    path: Option<PathBuf>,
    pub(crate) format: Format,
}

/// A figure: SVG or PNG; "-" is SVG on standard output.
pub(crate) fn figure(text: &str) -> Result<OutputFile, String> {
    read(text, &[Format::Svg, Format::Png])
}

/// The data of a motion, or its figure; "-" is CSV.
pub(crate) fn motion(text: &str) -> Result<OutputFile, String> {
    read(text, &[Format::Csv, Format::Svg, Format::Png])
}

/// An animation; "-" is GIF. An animated PNG may have the ending of a PNG.
pub(crate) fn animation(text: &str) -> Result<OutputFile, String> {
    read(text, &[Format::Gif, Format::Apng, Format::Png])
}

fn read(text: &str, formats: &[Format]) -> Result<OutputFile, String> {
    if text == "-" {
        return Ok(OutputFile { path: None, format: formats[0] });
    }
    let path = PathBuf::from(text);
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let known = ENDINGS.iter().filter(|(_, format)| formats.contains(format));
    match known.clone().find(|(own, _)| ending.eq_ignore_ascii_case(own)) {
        Some(&(_, format)) => Ok(OutputFile { path: Some(path), format }),
        None => {
            let endings: Vec<String> = known.map(|(own, _)| format!(".{own}")).collect();
            let endings = endings.join(", ");
            Err(format!("the ending says the format; give a file that ends in {endings}, or -"))
        }
    }
}

impl OutputFile {
    /// The file that gets the bytes, with its folder resolved: the same for `a.svg`, `./a.svg` and a link to it.
    fn place(&self) -> Option<PathBuf> {
        let path = self.path.as_ref()?;
        let path = &destination(path).unwrap_or_else(|_| path.clone());
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = std::fs::canonicalize(folder.unwrap_or(Path::new(".")));
        // A folder that does not exist is refused when the file is tried.
        Some(
            folder.map_or(path.clone(), |folder| folder.join(path.file_name().unwrap_or_default())),
        )
    }

    /// Writes the file, whole or not at all, and notes its name.
    pub(crate) fn write(
        &self,
        bytes: &[u8],
        options: &OutputOptions,
        streams: &mut Streams<'_>,
    ) -> Result<(), Error> {
        match &self.path {
            None => streams.output.write_all(bytes).map_err(Error::output),
            Some(path) => {
                write_atomically(path, bytes)?;
                options.note(streams, format_args!("wrote {}", path.display()));
                Ok(())
            }
        }
    }
}

/// Checks the files of a call before its computation: they differ, at most one is standard output, and they can be
/// written. Says whether one is standard output, so that no table goes there.
///
/// # Errors
/// [`Error::Misuse`] for two of the same name; [`Error::Job`] for a file that cannot be written.
pub(crate) fn check(files: &[(&str, Option<&OutputFile>)]) -> Result<bool, Error> {
    let given: Vec<_> = files.iter().filter_map(|(name, file)| Some((*name, (*file)?))).collect();
    for (at, (name, file)) in given.iter().enumerate() {
        if let Some((other, _)) =
            given[..at].iter().find(|(_, other)| other.place() == file.place())
        {
            let path = file.path.as_ref().map_or("-".into(), |path| path.display().to_string());
            let reason = format!("{other} writes there, too; give each its own file");
            return Err(Error::misuse(name, shortened(&path), &reason));
        }
    }
    for path in given.iter().filter_map(|(_, file)| file.path.as_ref()) {
        // The trial file is dropped unfinished, which removes it.
        drop(AtomicFile::create(path)?);
    }
    Ok(given.iter().any(|(_, file)| file.path.is_none()))
}
