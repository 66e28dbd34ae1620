//! A claim of the paper with its verdict.

use serde::Serialize;

/// The verdict on a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The claim holds.
    Confirmed,
    /// The claim is wrong in the paper, and the evidence confirms the known correction.
    Corrected,
    /// The claim does not hold, or the evidence does not confirm its correction.
    Fails,
}

/// A claim.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// Short name.
    pub name: String,
    /// Where the paper makes it.
    pub place: &'static str,
    /// The paper's statement in our words, as markup.
    pub paper: String,
    /// Our result, as markup.
    pub ours: String,
    /// The error, or the largest of many.
    pub error: String,
    /// How it was computed.
    pub how: String,
    /// The verdict.
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
    /// Judges a claim that the paper has wrong: `evidence` is whether the known correction is confirmed.
    pub(super) fn corrected(self, evidence: bool) -> Self {
        self.judged(if evidence { Verdict::Corrected } else { Verdict::Fails })
    }
    /// Sets the verdict. The texts were written for a claim that holds: a failed one says so first.
    pub(super) fn judged(mut self, verdict: Verdict) -> Self {
        if verdict == Verdict::Fails {
            self.ours = format!("not found; expected was: {}", self.ours);
        }
        self.verdict = verdict;
        self
    }
}

/// The largest of some errors; NaN if one of them is NaN, so that no comparison passes on it.
pub(super) fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}
