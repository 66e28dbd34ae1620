//! A claim of the paper with its verdict.

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
    pub(super) fn new(place: &'static str, name: &str) -> Self {
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
    pub(super) fn paper(mut self, text: impl Into<String>) -> Self {
        self.paper = text.into();
        self
    }
    pub(super) fn ours(mut self, text: impl Into<String>) -> Self {
        self.ours = text.into();
        self
    }
    pub(super) fn error(mut self, text: impl Into<String>) -> Self {
        self.error = text.into();
        self
    }
    pub(super) fn how(mut self, text: impl Into<String>) -> Self {
        self.how = text.into();
        self
    }
    pub(super) fn holds(self, holds: bool) -> Self {
        self.judged(if holds { Verdict::Confirmed } else { Verdict::Fails })
    }
    /// The paper's word differs from what holds; `evidence` says whether it does so as expected.
    pub(super) fn corrected(self, evidence: bool) -> Self {
        self.judged(if evidence { Verdict::Corrected } else { Verdict::Fails })
    }
    /// A finding that was not found is not told as one.
    pub(super) fn judged(mut self, verdict: Verdict) -> Self {
        if verdict == Verdict::Fails {
            self.ours = format!("not found; expected was: {}", self.ours);
        }
        self.verdict = verdict;
        self
    }
}

/// The largest of some errors; not a number if one of them is not.
pub(super) fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}
