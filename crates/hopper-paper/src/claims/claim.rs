//! A claim of the paper, with the result of its check.

use serde::Serialize;

/// The result of the check of a claim.
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
    /// The place of the claim in the paper.
    pub place: &'static str,
    /// The paper's statement in our words, as markup.
    pub paper: String,
    /// Our result, as markup.
    pub ours: String,
    /// The error, or the largest of many.
    pub error: String,
    /// The method of the computation.
    pub how: String,
    /// The result of the check.
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
    /// Sets the result for a claim that is wrong in the paper. `evidence` is true if the known correction is confirmed.
    pub(super) fn corrected(self, evidence: bool) -> Self {
        self.judged(if evidence { Verdict::Corrected } else { Verdict::Fails })
    }
    /// Sets the result. The texts are written for a claim that holds. For a failed claim a prefix states the failure.
    pub(super) fn judged(mut self, verdict: Verdict) -> Self {
        if verdict == Verdict::Fails {
            self.ours = format!("not found; expected was: {}", self.ours);
        }
        self.verdict = verdict;
        self
    }
}

/// The largest of some errors; NaN if one of them is NaN, so that no comparison with it succeeds.
pub(super) fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}
