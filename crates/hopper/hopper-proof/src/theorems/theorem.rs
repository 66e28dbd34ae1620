//! A statement with the steps of its proof.

use crate::certificate::CertificateLine;

/// One step of a proof: a claim that an enclosure decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// What is claimed.
    pub claim: String,
    /// The enclosures that decide it.
    pub found: String,
    /// The claim is decided, and true.
    pub holds: bool,
}

/// A statement with the steps of its proof. The lemmas that connect them are named in the statement.
#[derive(Debug, Clone, PartialEq)]
pub struct Theorem {
    /// The name of the command's argument.
    pub name: &'static str,
    /// What is proved if all steps hold.
    pub statement: String,
    /// The steps.
    pub steps: Vec<Step>,
    /// The numbers with which another program can check the statement.
    pub evidence: Vec<CertificateLine>,
}

impl Theorem {
    /// A statement without steps.
    pub(crate) fn new(name: &'static str, statement: impl Into<String>) -> Self {
        Theorem { name, statement: statement.into(), steps: Vec::new(), evidence: Vec::new() }
    }

    /// Adds a step.
    pub(crate) fn step(&mut self, claim: impl Into<String>, found: impl Into<String>, holds: bool) {
        self.steps.push(Step { claim: claim.into(), found: found.into(), holds });
    }

    /// All steps hold, and there is one.
    pub fn is_proved(&self) -> bool {
        !self.steps.is_empty() && self.steps.iter().all(|step| step.holds)
    }
}
