//! How the start of a guard was looked at, and what helps if that shows no side.

/// How a guard was looked at that starts at zero: it says what helps if its side stays undecided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Looked {
    /// At samples.
    Sampled,
    /// At short times of a flow, without bounds.
    ByFlow,
    /// On the steps of an integrated flow.
    OnSteps,
}

impl Looked {
    pub(crate) fn advice(self) -> &'static str {
        match self {
            Looked::Sampled => "sample more often, or give the guard bounds",
            Looked::ByFlow => "give the guard bounds, or the mode a field",
            Looked::OnSteps => {
                "if it rests on its surface, give the rest a mode of its own, or `rest` after a Zeno limit; if its \
                 bounces \
                 fade, a smaller tolerance shows their limit; if its far side is allowed, declare it a `crossing`"
            }
        }
    }
}
