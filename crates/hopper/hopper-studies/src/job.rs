//! Long computations whose finished rows are stored on disk.

use crate::error::Error;
use crate::repository::Progress;
use resumable_job::{Lock, Pieces, StoredPiece, program_digest};
use std::path::{Path, PathBuf};

/// A run, and the folder that stores the finished rows of its scans until all its results are written.
#[derive(Debug)]
pub(crate) struct Job {
    scans: PathBuf,
    /// The build that computes the rows.
    build: String,
    /// Two runs in one folder would remove each other's rows at their end.
    lock: Lock,
}

impl Job {
    /// A run that stores its scans in a folder beside its results, which exists. Each build of the program has its
    /// own folder: a scan rests on most functions of all libraries, and no version says whether one of them has
    /// changed. While the run lasts, another run with the same results folder is an error.
    pub(crate) fn new(results: &Path) -> Result<Self, Error> {
        let lock = Lock::take(results, "scans")?;
        let build = program_digest()?;
        Ok(Job { scans: results.join("scans").join(&build), build, lock })
    }

    /// `count` rows of numbers. Rows that an earlier run finished are read; the others are computed.
    pub(crate) fn scan(
        &self,
        name: &'static str,
        count: usize,
        row: impl Fn(usize) -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let kept = self.pieces(name)?;
        let bar = Progress.bar(name, count as u64);
        let mut rows = Vec::with_capacity(count);
        for k in 0..count {
            rows.push(self.kept_row(&kept, k, || row(k))?);
            bar.set(k as u64 + 1);
        }
        bar.finish();
        Ok(rows)
    }

    /// Rows that are computed one after the other, each depending on those before it. Rows that an earlier run
    /// finished are read: it asked for the same ones in the same order. The name has the parameters, if the rows
    /// depend on some.
    pub(crate) fn rows(&self, name: &str) -> Result<Rows<'_>, Error> {
        Ok(Rows { job: self, kept: self.pieces(name)?, finished: 0 })
    }

    /// The finished rows of this name and build: lists of doubles.
    fn pieces(&self, name: &str) -> Result<Pieces, Error> {
        let description = format!("{name}; build {}", self.build);
        let kept = Pieces::open(&self.scans.join(name), &description)?;
        Ok(kept.holding(|_, bytes| bytes.len() % size_of::<f64>() == 0))
    }

    /// Row k, read or computed.
    fn kept_row(
        &self,
        kept: &Pieces,
        k: usize,
        row: impl FnOnce() -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<f64>, Error> {
        let bytes = match kept.find(k)? {
            StoredPiece::Finished(bytes) => bytes,
            StoredPiece::Missing | StoredPiece::Unusable(_) => {
                let bytes: Vec<u8> = row()?.iter().flat_map(|x| x.to_le_bytes()).collect();
                // Without its lock this run would write among the rows of another run.
                kept.write_if(k, &bytes, || self.lock.confirm())?;
                bytes
            }
        };
        Ok(bytes.as_chunks().0.iter().map(|word| f64::from_le_bytes(*word)).collect())
    }

    /// Removes the finished rows. Call it when all results are written.
    pub(crate) fn done(self) -> Result<(), Error> {
        self.lock.confirm()?;
        match std::fs::remove_dir_all(&self.scans) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                return Err(Error::File { path: self.scans, source });
            }
            _ => {}
        }
        // The folder of another build may be there too. Then the parent folder is not empty and stays.
        let _ = self.scans.parent().map(std::fs::remove_dir);
        Ok(())
    }
}

/// Rows of a scan whose number is not known before.
pub(crate) struct Rows<'a> {
    job: &'a Job,
    kept: Pieces,
    finished: usize,
}

impl Rows<'_> {
    /// The next row, read or computed.
    pub(crate) fn next(
        &mut self,
        row: impl FnOnce() -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<f64>, Error> {
        let found = self.job.kept_row(&self.kept, self.finished, row)?;
        self.finished += 1;
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan that was interrupted computes only the missing rows, and returns the same rows.
    #[test]
    fn an_interrupted_scan_goes_on() {
        let folder = std::env::temp_dir().join(format!("hopper_scans_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let job = Job::new(&folder).unwrap();
        assert!(matches!(Job::new(&folder), Err(Error::Job(_))), "two runs in one folder");
        let row = |k: usize| vec![k as f64, (k as f64).sqrt(), f64::MIN_POSITIVE];
        let breaks = |k: usize| {
            if k < 5 { Ok(row(k)) } else { Err(Error::CheckFailed("broken off".into())) }
        };
        assert!(job.scan("a scan", 8, breaks).is_err());
        let computed = std::cell::RefCell::new(Vec::new());
        let again = job.scan("a scan", 8, |k| {
            computed.borrow_mut().push(k);
            Ok(row(k))
        });
        assert_eq!(again.unwrap(), (0..8).map(row).collect::<Vec<_>>());
        assert_eq!(computed.into_inner(), [5, 6, 7]);
        // The same with rows that are asked for one by one.
        let mut first = job.rows("one by one").unwrap();
        assert_eq!(first.next(|| Ok(row(3))).unwrap(), row(3));
        assert!(first.next(|| breaks(5)).is_err());
        let mut second = job.rows("one by one").unwrap();
        let never = || -> Result<Vec<f64>, Error> { panic!("this row is stored") };
        assert_eq!(second.next(never).unwrap(), row(3));
        assert_eq!(second.next(|| Ok(row(7))).unwrap(), row(7));
        job.done().unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
