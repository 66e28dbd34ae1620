//! Long jobs on disk. A run that is killed at any instant leaves pieces from which the next run continues, and the
//! result has the bytes of an undisturbed run.
//!
//! ```text
//!   lock the folder ─► compute the missing pieces ─► assemble ─► check ─► rename ─► remove the pieces
//!        │                      ▲      │                           │
//!   one process           a killed run │                  compares the assembled file
//!   per named part        goes on here └► each renamed    with every piece, byte for byte
//!                                         when complete
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`Lock`] | gives one named part of a folder to one process; ends with the process |
//! | [`Pieces`] | the finished pieces of one job; [`Pieces::assemble`] joins them to one checked file |
//! | [`AtomicFile`], [`write_atomically`] | a file that appears under its name complete or not at all |
//! | [`make_folder`] | makes a folder with its parents, and tells a file that has its name |
//! | [`remove_leftovers`] | removes temporary files of processes that no longer run |
//! | [`npy_header`], [`Order`] | the header of a NumPy file for a two-dimensional array of 16-bit labels |
//! | [`digest`], [`program_digest`] | 64-bit FNV-1a of bytes; of the running program |
//! | [`Error`] | the reason of a failure, with path, process number and remedy |
//!
//! ```
//! use resumable_job::{Lock, Order, Pieces, npy_header};
//! # let folder = std::env::temp_dir().join(format!("resumable_job_doc_{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! let lock = Lock::take(&folder, "squares")?;
//! assert!(Lock::take(&folder, "squares").is_err());
//! let pieces = Pieces::open(&folder.join("pieces"), "squares of 0 to 3")?;
//! for k in 0..4u16 {
//!     if pieces.read(k.into())?.is_none() {
//!         pieces.write(k.into(), &(k * k).to_le_bytes())?;
//!     }
//! }
//! let array = folder.join("squares.npy");
//! let header = npy_header(Order::Fortran, 1, 4);
//! pieces.assemble(&array, &header, 4, |_, _| ())?;
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
//! - A damaged piece, and a piece of another job or another build, is an error that names its file.
//!
//! The check of [`Pieces::assemble`] reads the file through the operating system's cache. It finds errors of programs.
//! It does not find data that a disk loses later.
//!
//! # Not here
//! Threads, progress, printing: the caller computes the pieces, in any order and on any number of threads.
//! Cryptographic digests: FNV-1a finds accidents, not forgeries. Locks between machines, unless the file system
//! provides them.
//!
//! # References
//! NumPy Enhancement Proposal 1 (the npy format); G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, *The FNV
//! Non-Cryptographic Hash Algorithm*, RFC 9923.

mod atomic_file;
mod digest;
mod error;
mod lock;
mod npy;
mod open_file;
mod pieces;

pub use atomic_file::{AtomicFile, make_folder, remove_leftovers, write_atomically};
pub use digest::{digest, program_digest};
pub use error::Error;
pub use lock::Lock;
pub use npy::{Order, npy_header};
pub use pieces::Pieces;
