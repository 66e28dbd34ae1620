//! Motions as data, with their answers of 25 digits: `xtask/generators/motions.py` computes them with 45.

use crate::error::Error;

/// The scenes, one a line. The scripts of the other programs read them too.
pub(super) const SCENES: &str = include_str!("../../tests/data/motions.jsonl");

/// A motion, and for some a guard with what its event does.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
pub(super) struct Scene {
    #[serde(rename = "scene")]
    pub(super) name: String,
    /// Names of the components of the state, and their rates.
    pub(super) states: Vec<String>,
    pub(super) field: Vec<String>,
    /// Decimals.
    start: Vec<String>,
    end: String,
    pub(super) guard: Option<String>,
    /// The state after an event; without it the guard is a section that is crossed in both directions.
    pub(super) reset: Option<Vec<String>>,
    /// The number of events.
    pub(super) events: usize,
    /// The state at the end, or the time of the last event.
    answer: Vec<String>,
}

impl Scene {
    pub(super) fn start(&self) -> Result<Vec<f64>, Error> {
        self.start.iter().map(|text| number(text)).collect()
    }

    pub(super) fn end(&self) -> Result<f64, Error> {
        number(&self.end)
    }

    /// The largest distance of a component from the answer's, relative to the largest component. A run without an answer
    /// has none.
    pub(super) fn error(&self, found: &[f64]) -> Result<f64, Error> {
        let answer: Vec<f64> =
            self.answer.iter().map(|text| number(text)).collect::<Result<_, _>>()?;
        let largest = answer.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if found.len() < answer.len() {
            return Ok(f64::INFINITY);
        }
        let off = answer.iter().zip(found).map(|(x, y)| (x - y).abs());
        // NaN is no answer.
        Ok(off.fold(0.0, |most, off| if off <= most { most } else { off }) / largest)
    }
}

fn number(text: &str) -> Result<f64, Error> {
    let wrong = |error| Error::Reference { reason: format!("motions.jsonl: {text}: {error}") };
    text.parse().map_err(wrong)
}

/// All scenes.
pub(super) fn scenes() -> Result<Vec<Scene>, Error> {
    let wrong = |error| Error::Reference { reason: format!("motions.jsonl: {error}") };
    SCENES.lines().map(|line| serde_json::from_str(line).map_err(wrong)).collect()
}
