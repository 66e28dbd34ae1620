//! Every claim of the paper, with its value and ours.

mod basins;
mod construction;
mod fixed_points;
mod invariance;
mod local_map;

use crate::Error;
use crate::progress::Progress;
use serde::Serialize;

/// What became of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It holds.
    Confirmed,
    /// The paper is wrong here, in the way we know; the evidence is as expected.
    Corrected,
    /// It does not hold, or the evidence is not as expected.
    Fails,
}

/// A claim.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// Short name.
    pub name: String,
    /// Where the paper makes it.
    pub place: &'static str,
    /// What the paper says, in our words, as markup.
    pub paper: String,
    /// What we find, as markup.
    pub ours: String,
    /// The error, or the largest of many.
    pub error: String,
    /// How it was computed.
    pub how: String,
    /// What became of it.
    pub verdict: Verdict,
}

impl Claim {
    fn new(place: &'static str, name: &str) -> Self {
        Claim {
            name: name.into(),
            place,
            paper: String::new(),
            ours: String::new(),
            error: String::new(),
            how: String::new(),
            verdict: Verdict::Fails,
        }
    }
    fn paper(mut self, text: impl Into<String>) -> Self {
        self.paper = text.into();
        self
    }
    fn ours(mut self, text: impl Into<String>) -> Self {
        self.ours = text.into();
        self
    }
    fn error(mut self, text: impl Into<String>) -> Self {
        self.error = text.into();
        self
    }
    fn how(mut self, text: impl Into<String>) -> Self {
        self.how = text.into();
        self
    }
    fn holds(self, holds: bool) -> Self {
        self.judged(if holds { Verdict::Confirmed } else { Verdict::Fails })
    }
    /// The paper's word differs from what holds; `evidence` says whether it does so as expected.
    fn corrected(self, evidence: bool) -> Self {
        self.judged(if evidence { Verdict::Corrected } else { Verdict::Fails })
    }
    /// A finding that was not found is not told as one.
    fn judged(mut self, verdict: Verdict) -> Self {
        if verdict == Verdict::Fails {
            self.ours = format!("not found; expected was: {}", self.ours);
        }
        self.verdict = verdict;
        self
    }
}

/// The largest of some errors; not a number if one of them is not.
fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}

/// A group of claims.
type Group = fn(&Progress) -> Result<Vec<Claim>, Error>;

/// Checks every claim.
pub fn all(progress: &Progress) -> Result<Vec<Claim>, Error> {
    let groups: [Group; 5] = [
        invariance::check,
        fixed_points::check,
        local_map::check,
        basins::check,
        construction::check,
    ];
    let mut claims = Vec::new();
    for group in groups {
        claims.extend(group(progress)?);
    }
    Ok(claims)
}

/// Checks the invariance alone.
pub fn invariance(progress: &Progress) -> Result<Vec<Claim>, Error> {
    invariance::check(progress)
}
