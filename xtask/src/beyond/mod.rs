//! What the paper could not say of the basins: new results, each with a figure and a table.

mod boundary;
mod entropy;
mod humps;
mod large_speeds;
mod measure;
mod needles;
mod tree;

use crate::Error;
use crate::figures::Figure;
use crate::progress::Progress;
use basin_of_attraction::{Estimate, Interval};
use hopper_basin::{Fates, HopperFate};
use passive_hopper::{MassRatio, alpha_star};
use resumable_job::{Lock, Pieces, program_digest};
use std::path::{Path, PathBuf};

/// A result.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Its figure, with the paper's claim and ours as texts.
    pub figure: Figure,
    /// Its table.
    pub table: Table,
}

/// A table with markup in its cells.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Names of the columns.
    pub header: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    fn new(header: &[&str]) -> Self {
        Table { header: header.iter().map(|&name| name.to_owned()).collect(), rows: Vec::new() }
    }

    fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}

/// How a result is made.
pub type Find = fn(&Job) -> Result<Finding, Error>;

/// A run, and the folder that keeps the finished rows of its scans until all its results are written.
#[derive(Debug)]
pub struct Job {
    scans: PathBuf,
    /// Two runs in one folder would remove each other's rows at their end.
    _lock: Lock,
}

impl Job {
    /// A run that keeps its scans in a folder beside its results, which exists. Each build of the program has a
    /// folder of its own. While the run lasts, another one with the same results folder is an error.
    pub fn new(results: &Path) -> Result<Self, Error> {
        let _lock = Lock::take(results, "scans")?;
        Ok(Job { scans: results.join("scans").join(program_digest()?), _lock })
    }

    /// `count` rows of numbers. Rows that an earlier run finished are read; the others are computed.
    pub(crate) fn scan(
        &self,
        name: &'static str,
        count: usize,
        row: impl Fn(usize) -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let kept = Pieces::open(&self.scans.join(name), name)?;
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

    /// Removes the finished rows. To be called when all results are written.
    pub fn done(self) -> Result<(), Error> {
        match std::fs::remove_dir_all(&self.scans) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                return Err(Error::File { path: self.scans, source });
            }
            _ => {}
        }
        // The folder of another build may stand beside: then the parent is not empty and stays.
        let _ = self.scans.parent().map(std::fs::remove_dir);
        Ok(())
    }
}

/// All results, by the name that `--only` takes.
pub const ALL: &[(&str, Find)] = &[
    ("measure", measure::measure),
    ("asymmetry", measure::asymmetry),
    ("boundary", boundary::boundary),
    ("uncertainty", boundary::uncertainty),
    ("entropy", entropy::entropy_of_basins),
    ("humps", humps::nested_basins),
    ("tree", tree::preimage_tree),
    ("large-speeds", large_speeds::large_speeds),
    ("needles", needles::needles),
];

/// The results with these names; all of them if none is named.
pub fn named(names: &[String]) -> Result<Vec<(&'static str, Find)>, Error> {
    if names.is_empty() {
        return Ok(ALL.to_vec());
    }
    let find = |name: &String| {
        ALL.iter().find(|(known, _)| known == name).copied().ok_or_else(|| Error::UnknownName {
            kind: "result",
            name: name.clone(),
            known: ALL.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
        })
    };
    names.iter().map(find).collect()
}

/// The first and the last fixed point of the paper's window.
const FROM: u64 = 1;
const TO: u64 = 6;

fn fates(mass_ratio: f64) -> Result<Fates, Error> {
    Ok(Fates::new(MassRatio::new(mass_ratio)?)?)
}

/// The label of a start; one of the undecided ones where none can be given.
fn label(fates: &Fates, alpha: f64) -> u16 {
    fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
}

fn is_incessant(label: u16) -> bool {
    (1..=HopperFate::LARGEST_LABEL as u16).contains(&label)
}

fn hump(n: u64) -> Result<Interval, Error> {
    Ok(Interval::new(alpha_star(n).high, alpha_star(n + 1).high)?)
}

/// The humps of the window laid side by side, each with length one, as the paper weighs them: the
/// speed at a place in [0, `TO` − `FROM`].
fn by_humps(place: f64) -> f64 {
    let whole = (place.floor() as u64).min(TO - FROM - 1);
    let (left, right) = (alpha_star(FROM + whole).high, alpha_star(FROM + whole + 1).high);
    left + (right - left) * (place - whole as f64)
}

/// Three numbers of a scan: value, lower and upper end.
fn estimate(three: &[f64]) -> Estimate {
    Estimate { value: three[0], lower: three[1], upper: three[2] }
}

/// A share with its interval, in per cent.
fn percent(share: &Estimate) -> String {
    let digits = if share.half_width() > 5e-4 { 2 } else { 4 };
    format!("{:.digits$} ± {:.digits$} %", 100.0 * share.value, 100.0 * share.half_width())
}

/// A range with certain ends, in per cent.
fn bounds(share: &Estimate) -> String {
    format!("{:.5} … {:.5} %", 100.0 * share.lower, 100.0 * share.upper)
}

/// `count` values from `first` to `last` in equal factors.
fn geometric(first: f64, last: f64, count: usize) -> Vec<f64> {
    let power = |k: usize| k as f64 / (count - 1) as f64;
    (0..count).map(|k| first * pxfm::f_pow(last / first, power(k))).collect()
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
        job.done().unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn places_are_on_their_humps() {
        assert_eq!(by_humps(0.0), alpha_star(1).high);
        assert_eq!(by_humps(5.0), alpha_star(6).high);
        let middle = by_humps(2.5);
        assert!(alpha_star(3).high < middle && middle < alpha_star(4).high);
        let values = geometric(0.02, 50.0, 5);
        assert!((values[2] - 1.0).abs() < 1e-14 && values[4] == 50.0);
    }
}
