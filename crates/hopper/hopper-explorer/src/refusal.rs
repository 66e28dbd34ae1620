//! Why a question has no answer, in the words of the library that refused it.

use std::fmt;

/// A question without an answer: the page shows its text.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal(String);

impl Refusal {
    pub(crate) fn new(text: impl Into<String>) -> Self {
        Refusal(text.into())
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refusal {}

impl From<hopper_basin::Error> for Refusal {
    fn from(error: hopper_basin::Error) -> Self {
        Refusal(error.to_string())
    }
}

impl From<passive_hopper::Error> for Refusal {
    fn from(error: passive_hopper::Error) -> Self {
        Refusal(error.to_string())
    }
}

impl From<hopper_figures::Error> for Refusal {
    fn from(error: hopper_figures::Error) -> Self {
        Refusal(error.to_string())
    }
}

impl From<hopper_proof::Error> for Refusal {
    fn from(error: hopper_proof::Error) -> Self {
        Refusal(error.to_string())
    }
}

impl From<basin_of_attraction::Error> for Refusal {
    fn from(error: basin_of_attraction::Error) -> Self {
        Refusal(error.to_string())
    }
}
