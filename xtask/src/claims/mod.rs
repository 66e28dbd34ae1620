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
    fn holds(mut self, holds: bool) -> Self {
        self.verdict = if holds { Verdict::Confirmed } else { Verdict::Fails };
        self
    }
    /// The paper's word differs from what holds; `evidence` says whether it does so as expected.
    fn corrected(mut self, evidence: bool) -> Self {
        self.verdict = if evidence { Verdict::Corrected } else { Verdict::Fails };
        self
    }
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
