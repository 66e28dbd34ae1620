//! A claim of the paper, its test, and the result.

use crate::error::Error;
use serde::Serialize;

/// The result of the check of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Verdict {
    /// The claim holds.
    Confirmed,
    /// The claim is wrong or incomplete in the paper, and the evidence confirms the known correction.
    Corrected,
    /// The claim is a theorem in this form. The computation shares its formula and can show only that the code agrees
    /// with the theorem.
    ByConstruction,
    /// The claim does not hold, or the evidence does not confirm its correction.
    Fails,
}

/// On what the verdict rests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub(crate) enum Ground {
    /// A test by something that does not contain the claim. If docs/theory.md proves the claim, `proof` names the
    /// statement there.
    Test {
        /// The source of the test.
        test: &'static str,
        /// Kind and number of the statement.
        proof: Option<&'static str>,
    },
    /// A statement of docs/theory.md alone: kind and number.
    Theorem {
        /// Kind and number of the statement.
        proof: &'static str,
    },
}

impl Ground {
    /// The statement of docs/theory.md.
    pub(crate) fn proof(&self) -> Option<&'static str> {
        match *self {
            Ground::Test { proof, .. } => proof,
            Ground::Theorem { proof } => Some(proof),
        }
    }

    /// The test.
    pub(crate) fn test(&self) -> Option<&'static str> {
        match *self {
            Ground::Test { test, .. } => Some(test),
            Ground::Theorem { .. } => None,
        }
    }
}

/// A claim that was checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Claim {
    /// Short name.
    pub name: &'static str,
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
    /// On what the verdict rests.
    pub ground: Ground,
    /// The result of the check.
    pub verdict: Verdict,
}

/// A claim with the function that checks it.
pub(super) struct Check {
    pub(super) name: &'static str,
    pub(super) place: &'static str,
    pub(super) ground: Ground,
    pub(super) evidence: fn() -> Result<Evidence, Error>,
}

impl Check {
    /// Checks the claim.
    pub(super) fn claim(&self) -> Result<Claim, Error> {
        let Evidence { paper, ours, error, how, holds, corrects } = (self.evidence)()?;
        let verdict = match (holds, self.ground) {
            (false, _) => Verdict::Fails,
            (true, Ground::Theorem { .. }) => Verdict::ByConstruction,
            (true, Ground::Test { .. }) if corrects => Verdict::Corrected,
            (true, Ground::Test { .. }) => Verdict::Confirmed,
        };
        // The texts are written for a claim that holds.
        let ours =
            if holds { ours } else { format!("not confirmed; the computation gave: {ours}") };
        let (name, place, ground) = (self.name, self.place, self.ground);
        Ok(Claim { name, place, paper, ours, error, how, ground, verdict })
    }
}

/// The result of a check, as numbers in texts, and whether the claim holds.
#[derive(Debug, Clone)]
pub(super) struct Evidence {
    paper: String,
    ours: String,
    error: String,
    how: String,
    /// Whether the computation agrees with the claim or with its correction.
    pub(super) holds: bool,
    corrects: bool,
}

impl Evidence {
    /// Evidence for or against the paper's statement.
    pub(super) fn about(paper: impl Into<String>) -> Self {
        Evidence {
            paper: paper.into(),
            ours: String::new(),
            error: "–".into(),
            how: String::new(),
            holds: false,
            corrects: false,
        }
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
    pub(super) fn holds(mut self, holds: bool) -> Self {
        self.holds = holds;
        self
    }
    /// For a claim that is wrong in the paper: `confirmed` is true if the computation confirms the known correction.
    pub(super) fn corrected(mut self, confirmed: bool) -> Self {
        self.corrects = true;
        self.holds(confirmed)
    }
}

/// The largest of some errors; NaN if one of them is NaN, so that no comparison with it succeeds.
pub(super) fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}
