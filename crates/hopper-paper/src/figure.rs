//! A figure with the texts that the reports print beside it.

use journal_figures::{DataFile, Svg};

/// A figure with everything the report says of it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// File name without its ending.
    pub name: &'static str,
    /// What the figure shows, as markup.
    pub title: String,
    /// What the paper says of it, in our words.
    pub paper: String,
    /// What was chosen where the paper's details are lost, and what the figure shows.
    pub notes: String,
    /// The drawing.
    pub svg: Svg,
    /// Its data.
    pub data: Vec<DataFile>,
}
