//! A figure with the texts that the reports print beside it.

use crate::error::Error;
use journal_figures::{DataFile, Svg};

/// The texts of all figures.
const TEXTS: &str = include_str!("texts.md");

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

impl Figure {
    /// The figure with the texts of its section in texts.md, in which each `[[place]]` has its value.
    pub(crate) fn new(
        name: &'static str,
        svg: Svg,
        data: Vec<DataFile>,
        values: &[(&str, String)],
    ) -> Result<Self, Error> {
        let failed = |what: String| Error::Text { name, what };
        let [title, paper, mut notes] =
            texts(name).ok_or_else(|| failed("has no section of three paragraphs".into()))?;
        for (place, value) in values {
            let mark = format!("[[{place}]]");
            if !notes.contains(&mark) {
                return Err(failed(format!("has no place {mark}")));
            }
            notes = notes.replace(&mark, value);
        }
        match notes.split_once("[[") {
            Some((_, open)) => {
                let place = open.split("]]").next().unwrap_or(open);
                Err(failed(format!("has no value for [[{place}]]")))
            }
            None => Ok(Figure { name, title, paper, notes, svg, data }),
        }
    }
}

/// The title and the two paragraphs of a section.
fn texts(name: &str) -> Option<[String; 3]> {
    let of_section = |section: &str| {
        let text = section.strip_prefix(name)?.strip_prefix(": ")?;
        let paragraphs = text.trim().split("\n\n").map(|paragraph| paragraph.replace('\n', " "));
        paragraphs.collect::<Vec<_>>().try_into().ok()
    };
    TEXTS.split("\n## ").find_map(of_section)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_section_has_a_title_and_two_paragraphs_and_every_place_wants_its_value() {
        let names = TEXTS.split("\n## ").skip(1).map(|section| section.split_once(": ").unwrap().0);
        assert!(names.clone().count() > 30);
        assert!(names.clone().is_sorted_by(|a, b| a < b));
        for name in names {
            let [title, paper, _] = texts(name).unwrap();
            assert!(!title.contains("[[") && !paper.contains("[["), "{name}");
        }
        let figure = |values: &[(&str, String)]| {
            Figure::new("fig_02_map", Svg::new(1.0, 1.0), Vec::new(), values)
        };
        let top = ("top", "20.371".to_owned());
        assert!(figure(&[]).is_err());
        assert!(figure(&[top.clone(), ("bottom", String::new())]).is_err());
        assert!(figure(&[top]).unwrap().notes.contains("= 20.371. At"));
    }
}
