//! Long jobs on disk. A run that is killed at any instant leaves pieces from which the next run continues, and the
//! result has the bytes of an undisturbed run.
//!
//! ```text
//!   lock ─► claim the folder ─► compute the missing pieces ─► assemble ─► check ─► rename ─► remove the pieces
//!    │          │                    ▲      │                           │
//!    │     one job a folder    a killed run │                  compares the assembled file
//!   the whole, or              goes on here └► each renamed    with every piece, byte for byte
//!   parts side by side                         when complete
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`Lock`] | gives a job in a folder to one process, or each of its parts to one process; ends with the process |
//! | [`Part`] | part K of N of a job: each N-th piece |
//! | [`claim`], [`is_claimed`], [`claimed_by`], [`remove_results`] | `job.txt`: the one job whose results a folder has |
//! | [`Pieces`], [`StoredPiece`] | the finished pieces of one job; [`Pieces::assemble`] joins them to one checked file |
//! | [`AtomicFile`], [`write_atomically`] | a file that appears under its name complete or not at all |
//! | [`Progress`], [`Pace`], [`Place`] | how far a job is and how long it still takes: a line on a terminal, or in a log every 30 seconds |
//! | [`make_folder`] | makes a folder with its parents, and tells a file that has its name |
//! | [`remove_leftovers`] | removes temporary files of processes that no longer run |
//! | [`digest`], [`file_digest`], [`program_digest`] | 64-bit FNV-1a of bytes; of a file; of the running program |
//! | [`Error`], [`UnusablePiece`] | the reason of a failure, with path, process number and remedy |
//!
//! ```
//! use resumable_job::{StoredPiece, Lock, Pieces, claim};
//! # let folder = std::env::temp_dir().join(format!("resumable_job_doc_{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! let lock = Lock::take(&folder, "squares")?;
//! assert!(Lock::take(&folder, "squares").is_err());
//! let job = "squares of 0 to 3; computation 1";
//! claim(&folder, job, |name| name == "squares.bin" || name == "pieces")?;
//! let pieces = Pieces::open(&folder.join("pieces"), job)?;
//! for k in 0..4u16 {
//!     if !matches!(pieces.find(k.into())?, StoredPiece::Finished(_)) {
//!         pieces.write(k.into(), &(k * k).to_le_bytes())?;
//!     }
//! }
//! let array = folder.join("squares.bin");
//! let header = b"squares";
//! pieces.assemble(&array, header, 4, || Ok::<(), resumable_job::Error>(()), |_, _| ())?;
//! pieces.remove(4)?;
//! assert_eq!(std::fs::read(&array)?[header.len()..], [0, 0, 1, 0, 4, 0, 9, 0]);
//! # drop(lock);
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Guarantees
//! - A file name shows the old bytes or the new bytes, never a part of them, however the process ends.
//! - A process that is killed or stopped never harms another one: temporary names are not shared, and a stopped
//!   process keeps its lock.
//! - A lock ends with its process, however the process ends. A lock file that is left on disk locks nothing.
//! - A lock file that another process removes or replaces is noticed by [`Lock::confirm`].
//! - Each file is flushed before it gets its name. A loss of power can therefore lose the newest file, but cannot leave
//!   it half written. On systems that cannot flush a folder this depends on the file system.
//! - A damaged piece, and a piece of another job, is told with its file. It is never part of a result, and is written
//!   again.
//! - A folder has the results of one job. Another job is refused with the description of the job that is there.
//!
//! # Which job is it?
//! The description of a job is all that its results depend on: the parameters, and the version of the computation. The
//! version is a constant of the caller, to be raised when the computation gives other bytes. (The time at which the
//! program was built says nothing about this: a new build mostly gives the same bytes, and a job of three weeks should
//! survive it.) A test should compare a digest of some results with the one that belongs to the version.
//!
//! # Many processes
//! The pieces of a job can be computed by many processes, also on several machines with one file system that has
//! locks. Each takes its part: [`Lock::take_part`], [`Part::pieces`]. Another process assembles them with
//! [`Lock::take`], which is refused while a part is at work.
//!
//! The check of [`Pieces::assemble`] reads the file through the operating system's cache. It finds errors of programs.
//! It does not find data that a disk loses later.
//!
//! # Not here
//! Threads and signals: the caller computes the pieces, in any order and on any number of threads.
//! Cryptographic digests: FNV-1a finds accidents, not forgeries. Locks between machines, unless the file system
//! provides them.
//!
//! # References
//! G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, *The FNV
//! Non-Cryptographic Hash Algorithm*, RFC 9923.

mod assembly;
mod atomic_file;
mod claim;
mod digest;
mod error;
mod lock;
mod locked_file;
mod open_file;
mod part;
mod pieces;
mod progress;
mod regular_file;

pub use atomic_file::{AtomicFile, destination, make_folder, remove_leftovers, write_atomically};
pub use claim::{claim, claimed_by, is_claimed, remove_results};
pub use digest::{digest, file_digest, program_digest};
pub use error::{Error, UnusablePiece};
pub use lock::Lock;
pub use part::Part;
pub use pieces::{Pieces, StoredPiece};
pub use progress::{Pace, Place, Progress};
pub use regular_file::{Contents, read_regular};
