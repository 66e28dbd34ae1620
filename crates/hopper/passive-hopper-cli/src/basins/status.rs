//! `hopper basins status` and `verify`: how far is a job, and are its files as they were written?

use crate::basins::job::job_in;
use crate::basins::job_folder::{StoredResults, pieces, stored_results};
use crate::error::Error;
use crate::output::{Column, Table, TableKind};
use rayon::prelude::*;
use resumable_job::{StoredPiece, claimed_by};
use std::path::Path;

/// What is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Look {
    /// The names of files.
    Names,
    /// The bytes of all of them.
    Bytes,
}

pub(crate) static STATUS: TableKind = TableKind {
    name: "status",
    about: "one row for each layer, of `status` and `verify`",
    long: false,
    columns: &[
        Column::new("results", "", "the main one of the files that the pieces are joined to"),
        Column::new("pieces", "", "the kind of the pieces"),
        Column::new("all", "", "pieces of the layer"),
        Column::new("finished", "", "those that are finished"),
        Column::new("damaged", "", "those that are damaged, if all are read"),
        Column::new(
            "state",
            "",
            "complete; damaged: a result is not as it was written; ready: all pieces are finished, and not joined; \
             begun; not begun",
        ),
    ],
};

/// The layers of the job in a folder. `verify` is an error if something in it is damaged; the table is printed before.
///
/// # Errors
/// [`Error::Misuse`] for a folder without a job; [`Error::Job`] if it cannot be read.
pub(crate) fn status(folder: &Path, look: Look) -> Result<(Table, Result<(), Error>), Error> {
    let described = claimed_by(folder)?;
    let mut table = Table::new(&STATUS);
    let mut damages: Vec<String> = Vec::new();
    job_in(folder)?.visit(&mut |description, work, results| {
        if described.as_deref() != Some(description) {
            let reason = "its job.txt and its call.txt have two jobs, or one is of another version; give the whole call, with its options";
            return Err(Error::misuse("folder", folder.display(), reason));
        }
        // The list of digests is written last, so that its name says that the results are complete.
        let found = match look {
            Look::Bytes => stored_results(folder, description, results)?,
            Look::Names
                if [results.digests, results.main, results.summary]
                    .iter()
                    .all(|name| folder.join(name).is_file()) =>
            {
                StoredResults::Whole(serde_json::Value::Null)
            }
            Look::Names => StoredResults::None,
        };
        let is_complete = matches!(found, StoredResults::Whole(_));
        let has_pieces = !is_complete && folder.join(work.folder).is_dir();
        let (mut finished, mut damaged) = (0, 0);
        if has_pieces {
            let kept = pieces(folder, description, work)?;
            let states = (0..work.count).into_par_iter().map(|at| match look {
                Look::Names => Ok((kept.has_file(at), None)),
                Look::Bytes => Ok(match kept.find(at)? {
                    StoredPiece::Finished(_) => (true, None),
                    StoredPiece::Missing => (false, None),
                    StoredPiece::Unusable(unusable) => (false, Some(unusable.to_string())),
                }),
            });
            for (is_finished, damage) in states.collect::<Result<Vec<_>, Error>>()? {
                finished += usize::from(is_finished);
                damaged += usize::from(damage.is_some());
                damages.extend(damage);
            }
        }
        let state = match &found {
            StoredResults::Whole(_) => "complete",
            StoredResults::Damaged(path) => {
                damages.push(format!("{} is damaged or missing", path.display()));
                "damaged"
            }
            StoredResults::OfAnother => {
                damages.push(format!("{} is damaged, or of another version", results.digests));
                "damaged"
            }
            StoredResults::None if finished == work.count => "ready",
            StoredResults::None if finished > 0 => "begun",
            StoredResults::None => "not begun",
        };
        table.push([
            results.main.to_owned().into(),
            work.unit.into(),
            work.count.into(),
            if is_complete { work.count } else { finished }.into(),
            (look == Look::Bytes).then_some(damaged).into(),
            state.into(),
        ]);
        Ok(())
    })?;
    let verdict = match (look, damages.first()) {
        (Look::Bytes, Some(first)) => {
            let (count, folder) = (damages.len(), folder.display().to_string());
            Err(Error::Damaged { count, first: first.clone(), folder })
        }
        _ => Ok(()),
    };
    Ok((table, verdict))
}
