//! The labels of a picture in a folder, band by band: a call that was stopped goes on.

use crate::error::Error;
use basin_of_attraction::Label;
use journal_figures::{Element, Order, npy_header};
use resumable_job::{AtomicFile, Lock, Pieces, StoredPiece, claim, make_folder, remove_leftovers};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The version of the computation: to be raised when it gives other labels.
const COMPUTATION: u32 = 1;

/// Pixels of a band, about: a band takes seconds of a slow model, and has much less overhead than that.
const BAND: usize = 4096;

/// The lock of a folder, and the names of what it has.
const LOCK: &str = "basin";
const ARRAY: &str = "basin.npy";
const BANDS: &str = "bands";

/// A folder with the labels of one picture.
#[derive(Debug)]
pub(crate) struct BasinStore {
    folder: PathBuf,
    bands: Pieces,
    lock: Lock,
    pixels: (usize, usize),
}

impl BasinStore {
    /// Opens the folder for the picture of `question`, which has all that the labels depend on.
    ///
    /// # Errors
    /// Those of files and locks; one that names both jobs if the folder has another picture.
    pub(crate) fn open(
        folder: &Path,
        question: &str,
        pixels: (usize, usize),
    ) -> Result<Self, Error> {
        make_folder(folder)?;
        // The trial file is dropped unfinished, which removes it.
        drop(AtomicFile::create(&folder.join(ARRAY))?);
        let lock = Lock::take(folder, LOCK)?;
        remove_leftovers(folder);
        let (columns, rows) = pixels;
        let job =
            format!("nonsmooth basin; computation {COMPUTATION}; {columns} x {rows}; {question}");
        claim(folder, &job, |name| name == ARRAY || name == BANDS)?;
        let bands = Pieces::open(&folder.join(BANDS), &job)?;
        Ok(BasinStore { folder: folder.to_owned(), bands, lock, pixels })
    }

    /// The rows of a band.
    fn rows_of(&self, band: usize) -> Range<usize> {
        let (columns, rows) = self.pixels;
        let height = (BAND / columns.max(1)).max(1);
        (band * height).min(rows)..((band + 1) * height).min(rows)
    }

    fn count(&self) -> usize {
        (0..).find(|band| self.rows_of(*band).is_empty()).unwrap_or(0)
    }

    /// The labels of all pixels, row after row: those of finished bands, and those that `compute` gives for the rows of the others. The array is written when
    /// all are there; the bands stay. `found` receives the pixels of bands that an earlier call had finished.
    ///
    /// # Errors
    /// Those of `compute` and of files. Finished bands stay.
    pub(crate) fn labels(
        &self,
        found: impl Fn(usize),
        compute: impl Fn(Range<usize>) -> Result<Vec<Label>, Error>,
    ) -> Result<Vec<Label>, Error> {
        let (columns, rows) = self.pixels;
        let mut all = Vec::with_capacity(columns * rows);
        for band in 0..self.count() {
            let own = self.rows_of(band);
            // A damaged band is computed again.
            let bytes = match self.bands.find(band)? {
                StoredPiece::Finished(bytes) => {
                    found(own.len() * columns);
                    bytes
                }
                StoredPiece::Missing | StoredPiece::Unusable(_) => {
                    let labels = compute(own)?;
                    let bytes: Vec<u8> =
                        labels.iter().flat_map(|label| label.code().to_le_bytes()).collect();
                    self.bands.write_if(band, &bytes, || self.lock.confirm())?;
                    bytes
                }
            };
            let (codes, _) = bytes.as_chunks::<2>();
            all.extend(codes.iter().map(|code| Label::from_code(u16::from_le_bytes(*code))));
        }
        let header = npy_header(Order::C, Element::U16, rows, columns);
        let array = self.folder.join(ARRAY);
        let go_on = || Ok::<(), Error>(self.lock.confirm()?);
        self.bands.assemble(&array, &header, self.count(), go_on, |_, _| ())?;
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_rows_without_gaps() {
        let folder = std::env::temp_dir().join(format!("basin_store_{}", std::process::id()));
        for pixels in [(3, 5), (5000, 3), (1, 10_000), (64, 200)] {
            let store = BasinStore::open(&folder, "a question", pixels).unwrap();
            let bands: Vec<Range<usize>> = (0..store.count()).map(|k| store.rows_of(k)).collect();
            assert!(bands.windows(2).all(|pair| pair[0].end == pair[1].start));
            assert_eq!((bands[0].start, bands.last().unwrap().end), (0, pixels.1));
            drop(store);
            std::fs::remove_dir_all(&folder).unwrap();
        }
    }
}
