//! The folder of one job: who may write there, which job it has, and whether its results are there already.

use crate::basins::call::{Call, Work};
use crate::basins::layer::stored_layers;
use crate::error::Error;
use resumable_job::{
    AtomicFile, Contents, Lock, Part, Pieces, claim, digest, file_digest, is_claimed, make_folder,
    read_regular, remove_leftovers, remove_results, write_atomically,
};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The lock of all jobs of this command: a folder has one job.
const LOCK: &str = "basins";

/// The beginning of the last line of a list of digests.
const SEAL: &str = "all of this job: ";

/// The folders with finished pieces of other jobs than rasters.
const PIECES: [&str; 2] = ["columns", "frames"];

/// The results of other jobs with fixed names.
const RESULTS: [&str; 7] = [
    "shares.png",
    "shares.json",
    "shares.digests",
    "zoom.png",
    "zoom_animation.png",
    "zoom.json",
    "zoom.digests",
];

/// What a call does of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Share {
    /// All of it.
    Whole,
    /// The pieces of one part, without joining them.
    Part(Part),
    /// Joining the pieces of all parts.
    Join,
}

/// The results of a job, or of a layer of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Results<'a> {
    /// The one that messages name.
    pub(crate) main: &'a str,
    /// What the table shows, as JSON.
    pub(crate) summary: &'a str,
    /// The digest of every result, one a line. Written last.
    pub(crate) digests: &'a str,
}

/// The folder of a job, locked for this call.
#[derive(Debug)]
pub(crate) struct JobFolder {
    pub(crate) path: PathBuf,
    pub(crate) description: String,
    pub(crate) share: Share,
    lock: Lock,
}

impl JobFolder {
    /// Makes the folder if it does not exist, locks it, and makes sure that it has this job or none.
    /// With `force` the results of any other job, and those of this one, are removed.
    ///
    /// A folder that cannot be written, and names that no result can have, are errors here, before the computation.
    ///
    /// # Errors
    /// [`Error::Job`]; [`Error::Misuse`] for a folder with another job.
    pub(crate) fn open(
        (out, share, force): (&Path, Share, bool),
        description: String,
        results: &[&str],
    ) -> Result<Self, Error> {
        if share == Share::Join && !is_claimed(out) {
            return Err(Error::misuse(
                "--join --out",
                out.display(),
                "this folder has no parts of a job; compute them before, such as --part 1/2 and --part 2/2, or give \
                 their folder",
            ));
        }
        make_folder(out)?;
        // The trial files are dropped unfinished, which removes them.
        drop(AtomicFile::create(&out.join(".writable"))?);
        let lock = match share {
            Share::Part(part) => Lock::take_part(out, LOCK, part)?,
            Share::Whole | Share::Join => Lock::take(out, LOCK)?,
        };
        remove_leftovers(out);
        for name in results {
            drop(AtomicFile::create(&out.join(name))?);
        }
        if force {
            remove_results(out, is_result)?;
        }
        claim(out, &description, is_result).map_err(|error| match error {
            resumable_job::Error::OtherJob { found, wanted, .. } => Error::misuse(
                "--out",
                out.display(),
                &format!(
                    "this folder has the results of another job or version: '{found}', and not '{wanted}'; give \
                     another folder, or add --force to replace them"
                ),
            ),
            resumable_job::Error::UnknownJob { path } => Error::misuse(
                "--out",
                out.display(),
                &format!(
                    "{} is here already, and no job.txt says which job made it; give another folder, or add --force to \
                     replace it",
                    path.display()
                ),
            ),
            other => other.into(),
        })?;
        Ok(JobFolder { path: out.to_path_buf(), description, share, lock })
    }

    /// The pieces of one layer of this job. The layer belongs to the identity of a piece: one of another layer is
    /// of another job.
    ///
    /// # Errors
    /// [`Error::Job`] if their folder cannot be made.
    pub(crate) fn pieces(&self, work: &Work<'_>) -> Result<Pieces, Error> {
        let description = format!("{}; {}", self.description, work.folder);
        let payload = work.payload;
        let kept = Pieces::open(&self.path.join(work.folder), &description)?;
        Ok(kept.holding(move |at, bytes| payload.holds(at, bytes)))
    }

    /// Makes sure that no other process works on the same part.
    ///
    /// # Errors
    /// As [`Lock::confirm`].
    pub(crate) fn confirm(&self) -> Result<(), Error> {
        Ok(self.lock.confirm()?)
    }

    /// Writes a result.
    ///
    /// # Errors
    /// As [`confirm`](Self::confirm) and [`write_atomically`].
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        self.confirm()?;
        Ok(write_atomically(&self.path.join(name), bytes)?)
    }

    /// The summary of results that are complete and undamaged: that of an earlier call. Pieces that are left of it
    /// are removed.
    ///
    /// # Errors
    /// [`Error::Job`] if files cannot be read or removed.
    pub(crate) fn complete(
        &self,
        results: &Results<'_>,
        work: &Work<'_>,
        call: &mut Call<'_>,
    ) -> Result<Option<Value>, Error> {
        // Without the digests, which are written last, the call was killed before its end.
        let digests = match read_regular(&self.path.join(results.digests))? {
            Contents::Bytes(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Contents::Missing | Contents::NoFile => return Ok(None),
        };
        // The last line has the digest of the job and of the lines before: a list of another job, or one that was
        // cut, is none of this one.
        let own = digests
            .trim_end()
            .rsplit_once('\n')
            .is_some_and(|(lines, last)| last == self.seal(&format!("{lines}\n")));
        if !own {
            call.note(&format!(
                "{}: it is damaged, or of another version; the results are computed again",
                self.place_of(results.digests)
            ));
            return Ok(None);
        }
        let mut has_summary = false;
        for line in digests.lines().filter(|line| !line.starts_with(SEAL)) {
            let (digest, name) = line.split_once("  ").unwrap_or_default();
            let path = self.path.join(name);
            has_summary |= name == results.summary;
            if name.contains('/') || !path.is_file() || file_digest(&path)? != digest {
                call.note(&format!(
                    "{}: it is damaged or missing; it is computed again",
                    path.display()
                ));
                return Ok(None);
            }
        }
        let summary = match read_regular(&self.path.join(results.summary))? {
            Contents::Bytes(text) => serde_json::from_slice(&text).ok(),
            Contents::Missing | Contents::NoFile => None,
        };
        let Some(summary) = summary.filter(|_| has_summary) else {
            call.note(&format!(
                "{}: it is damaged; the results are computed again",
                self.place_of(results.digests)
            ));
            return Ok(None);
        };
        call.note(&format!(
            "{} is complete already; --force computes it again",
            self.place_of(results.main)
        ));
        let pieces = self.path.join(work.folder);
        if !matches!(self.share, Share::Part(_)) && pieces.is_dir() {
            // A call was killed while it removed its pieces.
            self.pieces(work)?.remove(work.count)?;
        }
        Ok(Some(summary))
    }

    /// Writes the summary and the digests of all results, and removes the pieces.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub(crate) fn finish(
        &self,
        results: &Results<'_>,
        others: &[&str],
        summary: &Value,
        (kept, count): (Pieces, usize),
    ) -> Result<(), Error> {
        let text = serde_json::to_string_pretty(summary).map_err(|error| Error::File {
            path: self.path.join(results.summary),
            source: error.into(),
        })?;
        self.write(results.summary, text.as_bytes())?;
        let mut digests = String::new();
        for name in others.iter().chain(&[results.summary]) {
            digests += &format!("{}  {name}\n", file_digest(&self.path.join(name))?);
        }
        digests += &format!("{}\n", self.seal(&digests));
        self.write(results.digests, digests.as_bytes())?;
        kept.remove(count)?;
        // Another call that was refused, and killed before, leaves its trial file.
        remove_leftovers(&self.path);
        Ok(())
    }

    /// The last line of a list of digests.
    fn seal(&self, lines: &str) -> String {
        format!("{SEAL}{}", digest(format!("{}\n{lines}", self.description).as_bytes()))
    }

    /// Rows of the table of files.
    pub(crate) fn place_of(&self, name: &str) -> String {
        self.path.join(name).display().to_string()
    }
}

/// Whether a name is that of a result of this command, or of a folder with its pieces.
fn is_result(name: &str) -> bool {
    let numbered = |start: &str, end: &str| {
        let number = name.strip_prefix(start).and_then(|rest| rest.strip_suffix(end));
        number.is_some_and(|digits| {
            !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
        })
    };
    PIECES.contains(&name)
        || stored_layers().any(|layer| layer.files().contains(&name))
        || RESULTS.contains(&name)
        || numbered("share_", ".npy")
        || numbered("zoom_", ".png")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_users_are_no_results() {
        for name in
            ["basin.npy", "share_12.npy", "zoom_0100.png", "tiles", "basin.digests", "proof.npy"]
        {
            assert!(is_result(name), "{name}");
        }
        for name in ["job.txt", "notes.txt", "share_.npy", "share_x.npy", "zoom_1.pdf", "my_tiles"]
        {
            assert!(!is_result(name), "{name}");
        }
    }
}
