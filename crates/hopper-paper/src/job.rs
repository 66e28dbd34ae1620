//! Long computations whose finished rows are kept on disk.

use crate::checkpoint::{Checkpoint, program_digest};
use crate::error::Error;
use repository_tools::Progress;
use std::path::{Path, PathBuf};

/// A run whose scans keep their finished rows on disk until all of it is done.
#[derive(Debug, Clone)]
pub struct Job {
    scans: PathBuf,
}

impl Job {
    /// A run whose rows are kept in a folder beside its results. Each build of the program has a folder of its own, since
    /// another build may compute other numbers.
    pub fn new(results: &Path) -> Result<Self, Error> {
        Ok(Job { scans: results.join("scans").join(program_digest()?) })
    }

    /// `count` rows of numbers. A row that an earlier run finished is read instead of computed.
    pub(crate) fn scan(
        &self,
        name: &'static str,
        count: usize,
        row: impl Fn(usize) -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let kept = Checkpoint::open(&self.scans.join(name), name)?;
        let bar = Progress.bar(name, count as u64);
        let mut rows = Vec::with_capacity(count);
        for k in 0..count {
            let bytes = match kept.read(k)? {
                Some(bytes) => bytes,
                None => {
                    let bytes: Vec<u8> = row(k)?.iter().flat_map(|x| x.to_le_bytes()).collect();
                    kept.write(k, &bytes)?;
                    bytes
                }
            };
            let number = |word: &[u8]| word.try_into().map_or(f64::NAN, f64::from_le_bytes);
            rows.push(bytes.chunks(8).map(number).collect());
            bar.set(k as u64 + 1);
        }
        bar.finish();
        Ok(rows)
    }

    /// Removes the kept rows. Called once all results are written.
    pub fn done(self) -> Result<(), Error> {
        match std::fs::remove_dir_all(&self.scans) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                return Err(Error::File { path: self.scans, source });
            }
            _ => {}
        }
        // Another build may keep its rows beside: then the folder is not empty and stays.
        let _ = self.scans.parent().map(std::fs::remove_dir);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan that breaks off is continued with the first row that is missing.
    #[test]
    fn scans_go_on() {
        let folder = std::env::temp_dir().join(format!("hopper_scans_{}", std::process::id()));
        let job = Job::new(&folder).unwrap();
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
        job.done().unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
