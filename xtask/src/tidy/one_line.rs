//! The text of a file as one line, so that a rule reads over the lines of a comment.

/// A text whose lines are joined by spaces, without the marks of comments.
pub(super) struct OneLine {
    pub(super) text: String,
    /// Where each line begins in `text`.
    starts: Vec<usize>,
}

impl OneLine {
    /// Joins the lines of a file.
    pub(super) fn new(text: &str) -> Self {
        let (mut joined, mut starts) = (String::new(), Vec::new());
        for line in text.lines() {
            starts.push(joined.len());
            let line = line.trim();
            let comment = ["///", "//!", "//"].iter().find_map(|mark| line.strip_prefix(mark));
            joined.push_str(comment.unwrap_or(line).trim());
            joined.push(' ');
        }
        OneLine { text: joined, starts }
    }

    /// The line, from one, of a place in the joined text.
    pub(super) fn line_of(&self, at: usize) -> usize {
        self.starts.partition_point(|start| *start <= at)
    }
}
