//! A breach of a rule.

/// A place where a rule does not hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Breach {
    /// The file, relative to the root, with `/` between folders.
    pub(super) file: String,
    /// The line, from one; zero for the whole file.
    pub(super) line: usize,
    /// The defect, and its remedy.
    pub(super) rule: String,
}

impl Breach {
    /// A breach; `line` 0 stands for the whole file.
    pub(super) fn new(file: &str, line: usize, rule: impl Into<String>) -> Self {
        Breach { file: file.to_owned(), line, rule: rule.into() }
    }
}
