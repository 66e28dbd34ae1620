//! The pieces of a job: computed in parallel, stored one by one, found again by the next call.

use crate::basins::call::{Call, Work};
use crate::basins::job_folder::{JobFolder, Share};
use crate::error::Error;
use rayon::prelude::*;
use resumable_job::{Pace, Part, Pieces, Place, Progress, StoredPiece};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Time between two looks at signals and at the progress.
const LOOK: Duration = Duration::from_millis(50);

/// A message lists so many missing pieces; more would be no line that one reads.
const LISTED: usize = 5;

/// Pieces of which this call has finished its share.
pub(crate) struct Finished {
    pub(crate) kept: Pieces,
    /// The pieces of this call.
    pub(crate) wanted: usize,
    /// Those of them that an earlier call had finished.
    pub(crate) found: usize,
}

/// Computes the pieces that this call has to compute. A damaged piece is named, and computed again.
///
/// After a signal no piece is begun. Those at work are finished, and the error says how many there are.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::MissingPieces`] if the pieces are to be joined and some are missing; errors of
/// `piece`.
pub(crate) fn compute(
    job: &JobFolder,
    work: &Work<'_>,
    call: &mut Call<'_>,
    piece: impl Fn(usize) -> Result<Vec<u8>, Error> + Sync,
) -> Result<Finished, Error> {
    let kept = job.pieces(work)?;
    let wanted: Vec<usize> = match job.share {
        Share::Part(part) => {
            kept.note_parts(part.of())?;
            part.pieces(work.count).collect()
        }
        Share::Whole | Share::Join => (0..work.count).collect(),
    };
    let missing = missing(&kept, &wanted)?;
    let found = wanted.len() - missing.len();
    if job.share == Share::Join {
        return match missing.is_empty() {
            true => Ok(Finished { kept, wanted: wanted.len(), found }),
            false => Err(missing_pieces(&kept, work, &missing)),
        };
    }
    for reason in missing.iter().filter_map(|(_, reason)| reason.as_ref()) {
        call.note(&format!("{reason}; it is computed again"));
    }
    if found > 0 {
        call.note(&format!("{found} of {} {} found", wanted.len(), work.unit));
    }
    let place = Place::new(call.quiet, std::io::stderr().is_terminal());
    let each = Some((work.pixels, "pixels"));
    let pace = Pace { unit: work.unit, total: wanted.len(), found, each };
    let mut progress = Progress::new(pace, place, &mut *call.messages);
    let began = Instant::now();
    let interrupt = &call.interrupt;
    let (finished, events) = channel();
    let (result, computed) = std::thread::scope(|scope| {
        let (kept, missing, piece) = (&kept, &missing, &piece);
        let worker = scope.spawn(move || {
            missing.par_iter().try_for_each_with(finished, |finished, &(at, _)| {
                interrupt.check()?;
                let bytes = piece(at)?;
                // Without its lock this call would write among the pieces of another one.
                kept.write_if(at, &bytes, || job.confirm())?;
                // The receiver ends after all senders.
                let _ = finished.send(());
                Ok(())
            })
        });
        let (mut computed, mut is_told) = (0, false);
        loop {
            match events.recv_timeout(LOOK) {
                Ok(()) => computed += 1,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            if interrupt.status().is_some() && !is_told {
                is_told = true;
                progress.note(&format!(
                    "stopping after the {} at work; a second signal drops them",
                    work.unit
                ));
            }
            progress.tell(computed, began.elapsed());
        }
        (worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), computed)
    });
    progress.clear();
    match result {
        Ok(()) => Ok(Finished { kept, wanted: wanted.len(), found }),
        Err(Error::Interrupted { status, .. }) => {
            let (done, all) = (found + computed, wanted.len());
            let done = format!("{done} of {all} {} are finished", work.unit);
            Err(Error::Interrupted { status, done })
        }
        Err(error) => Err(error),
    }
}

/// The pieces that are not finished, each with the reason if its file cannot be used.
fn missing(kept: &Pieces, wanted: &[usize]) -> Result<Vec<(usize, Option<String>)>, Error> {
    let state = |&at: &usize| {
        Ok(match kept.find(at)? {
            StoredPiece::Finished(_) => None,
            StoredPiece::Missing => Some((at, None)),
            StoredPiece::Unusable(unusable) => Some((at, Some(unusable.to_string()))),
        })
    };
    let states = wanted.par_iter().map(state).collect::<Result<Vec<_>, Error>>()?;
    Ok(states.into_iter().flatten().collect())
}

/// The error that says which parts have not finished which pieces.
fn missing_pieces(kept: &Pieces, work: &Work<'_>, missing: &[(usize, Option<String>)]) -> Error {
    let name = |(at, reason): &(usize, Option<String>)| match reason {
        Some(reason) => reason.clone(),
        None => at.to_string(),
    };
    let mut list: Vec<String> = missing.iter().take(LISTED).map(name).collect();
    if missing.len() > LISTED {
        list.push("…".into());
    }
    // Without a note of its parts the job was not done in parts.
    let numbers = kept.numbers_of_parts().unwrap_or_default();
    let mut remedies = Vec::new();
    for of in numbers {
        let mut parts: Vec<usize> = missing
            .iter()
            .filter_map(|&(at, _)| Part::with(at, of).ok())
            .map(Part::number)
            .collect();
        parts.sort_unstable();
        parts.dedup();
        let mut names: Vec<String> =
            parts.iter().take(LISTED).map(|part| format!("{part}/{of}")).collect();
        if parts.len() > LISTED {
            names.push("…".into());
        }
        remedies.push(format!("--part {}", names.join(", ")));
    }
    remedies.push("the call without --join, which computes them".into());
    Error::MissingPieces(format!(
        "--join: {} of {} {} are missing or damaged: {}; run {}",
        missing.len(),
        work.count,
        work.unit,
        list.join(", "),
        remedies.join(", or ")
    ))
}
