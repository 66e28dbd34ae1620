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

/// The folder of a call, what it does there, and the call itself.
pub(crate) struct Place<'a> {
    pub(crate) out: &'a Path,
    pub(crate) share: Share,
    /// Whether results that are there are removed.
    pub(crate) force: bool,
    /// The call without its place, such as `hopper basins --pixels 64 64`. It is asked for when the folder is locked.
    pub(crate) call: &'a dyn Fn() -> String,
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
        place: &Place<'_>,
        description: String,
        results: &[&str],
    ) -> Result<Self, Error> {
        let &Place { out, share, force, call } = place;
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
        // Before the description: a call that is killed between the two leaves a folder that can go on.
        let is_new = !is_claimed(out) && !out.join(CALL).exists();
        if is_new {
            write_call(out, &call())?;
        }
        let claimed = claim(out, &description, is_result);
        if is_new && claimed.is_err() {
            // A folder of another one stays as it was. What cannot be removed is found by the next call.
            let _ = std::fs::remove_file(out.join(CALL));
        }
        claimed.map_err(|error| match error {
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
        write_call(out, &call())?;
        Ok(JobFolder { path: out.to_path_buf(), description, share, lock })
    }

    /// The pieces of one layer of this job.
    ///
    /// # Errors
    /// As [`pieces`].
    pub(crate) fn pieces(&self, work: &Work<'_>) -> Result<Pieces, Error> {
        pieces(&self.path, &self.description, work)
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
        let summary = match stored_results(&self.path, &self.description, results)? {
            StoredResults::None => return Ok(None),
            StoredResults::OfAnother => {
                call.note(&format!(
                    "{}: it is damaged, or of another version; the results are computed again",
                    self.place_of(results.digests)
                ));
                return Ok(None);
            }
            StoredResults::Damaged(path) => {
                call.note(&format!(
                    "{}: it is damaged or missing; it is computed again",
                    path.display()
                ));
                return Ok(None);
            }
            StoredResults::Whole(summary) => summary,
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
        digests += &format!("{}\n", seal(&self.description, &digests));
        self.write(results.digests, digests.as_bytes())?;
        kept.remove(count)?;
        // Another call that was refused, and killed before, leaves its trial file.
        remove_leftovers(&self.path);
        Ok(())
    }

    /// Rows of the table of files.
    pub(crate) fn place_of(&self, name: &str) -> String {
        self.path.join(name).display().to_string()
    }
}

/// The last line of a list of digests: that of the job and of the lines before. A list of another job, or one that was
/// cut, is none of this one.
fn seal(description: &str, lines: &str) -> String {
    format!("{SEAL}{}", digest(format!("{description}\n{lines}").as_bytes()))
}

/// What a folder has of the results of a job, or of a layer of it.
#[derive(Debug)]
pub(crate) enum StoredResults {
    /// The list of digests, which is written last, is not there.
    None,
    /// The list is damaged, or that of another version.
    OfAnother,
    /// A file is missing, or not as it was written.
    Damaged(PathBuf),
    /// All files are as they were written.
    Whole(Value),
}

/// Compares the results of a job with their digests.
///
/// # Errors
/// [`Error::Job`] if files cannot be read.
pub(crate) fn stored_results(
    folder: &Path,
    description: &str,
    results: &Results<'_>,
) -> Result<StoredResults, Error> {
    let list = folder.join(results.digests);
    let digests = match read_regular(&list)? {
        Contents::Bytes(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Contents::Missing | Contents::NoFile => return Ok(StoredResults::None),
    };
    let Some((lines, _)) = digests
        .trim_end()
        .rsplit_once('\n')
        .filter(|(lines, last)| *last == seal(description, &format!("{lines}\n")))
    else {
        return Ok(StoredResults::OfAnother);
    };
    let mut has_summary = false;
    for line in lines.lines() {
        let (digest, name) = line.split_once("  ").unwrap_or_default();
        let path = folder.join(name);
        has_summary |= name == results.summary;
        if name.contains('/') || !path.is_file() || file_digest(&path)? != digest {
            return Ok(StoredResults::Damaged(path));
        }
    }
    let summary = match read_regular(&folder.join(results.summary))? {
        Contents::Bytes(text) => serde_json::from_slice(&text).ok(),
        Contents::Missing | Contents::NoFile => None,
    };
    Ok(match summary.filter(|_| has_summary) {
        Some(summary) => StoredResults::Whole(summary),
        None => StoredResults::Damaged(list),
    })
}

/// The pieces of one layer of a job. The layer belongs to the identity of a piece: one of another layer is of another
/// job. Their folder is made if it is missing.
///
/// # Errors
/// [`Error::Job`] if it cannot be made.
pub(crate) fn pieces(folder: &Path, description: &str, work: &Work<'_>) -> Result<Pieces, Error> {
    let (description, payload) = (format!("{description}; {}", work.folder), work.payload);
    let kept = Pieces::open(&folder.join(work.folder), &description)?;
    Ok(kept.holding(move |at, bytes| payload.holds(at, bytes)))
}

/// The file with the call that made a folder.
pub(crate) const CALL: &str = "call.txt";

/// Keeps the call, so that it can go on without being given again.
fn write_call(folder: &Path, call: &str) -> Result<(), Error> {
    let path = folder.join(CALL);
    let text = format!("{call}\n");
    match read_regular(&path)? {
        Contents::Bytes(own) if own == text.as_bytes() => Ok(()),
        Contents::Bytes(own) if !own.starts_with(b"hopper ") && !is_claimed(folder) => {
            Err(Error::misuse(
                "--out",
                folder.display(),
                &format!(
                    "its {CALL} is no call of this program; give another folder, or another name to that file"
                ),
            ))
        }
        _ => Ok(write_atomically(&path, text.as_bytes())?),
    }
}

/// The call that made a folder.
///
/// # Errors
/// [`Error::Misuse`] if there is none; [`Error::Job`] if it cannot be read.
pub(crate) fn read_call(folder: &Path) -> Result<String, Error> {
    match read_regular(&folder.join(CALL))? {
        Contents::Bytes(bytes) => Ok(String::from_utf8_lossy(&bytes).trim_end().to_owned()),
        Contents::Missing | Contents::NoFile => {
            let reason = format!(
                "it has no {CALL}, and is no folder of a job, or one of an older version; give the whole call, with \
                 its options"
            );
            Err(Error::misuse("folder", folder.display(), &reason))
        }
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
