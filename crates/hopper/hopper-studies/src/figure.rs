//! A figure with the texts that the reports print beside it.

use journal_figures::{DataFile, Svg};

/// A figure with all its texts for the report.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    /// File name without its ending.
    pub name: &'static str,
    /// The title of the figure, as markup.
    pub title: String,
    /// The statement of the paper about it, in our words.
    pub paper: String,
    /// The choices made where the paper's details are illegible in our copy, and the content of the figure.
    pub notes: String,
    /// The drawing.
    pub svg: Svg,
    /// Its data.
    pub data: Vec<DataFile>,
}
