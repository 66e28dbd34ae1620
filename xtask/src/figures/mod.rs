//! The figures of the paper, one file each, from first principles.

mod basin_plot;
mod fig_01_model;
mod fig_02_map;
mod fig_03_segments;
mod fig_04_local_map;
mod fig_05_construction;
mod fig_06_to_09_basins;
mod invariance;
mod peers;
mod printed_against_stable;
mod work_precision;

/// The construction of Fig. 5, for the claims about it.
pub(crate) mod construction {
    pub(crate) use super::fig_05_construction::{DEPTH, M, levels};
}

pub(crate) use basin_plot::{Window, draw_basins};
pub(crate) use peers::peers_figure;
pub(crate) use work_precision::work_precision_figure;

use crate::Error;
use crate::plot::Svg;
use crate::progress::Progress;

/// A figure with everything the report says of it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// File name without ending.
    pub name: &'static str,
    /// What it shows, as markup.
    pub title: String,
    /// What the paper says of it, in our words.
    pub paper: String,
    /// What we chose where the paper's details are lost, and what is to be seen.
    pub notes: String,
    /// The drawing.
    pub svg: Svg,
    /// Its data.
    pub data: Vec<DataFile>,
}

/// A file of data.
#[derive(Debug, Clone)]
pub struct DataFile {
    /// File name.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// How a figure is made.
pub type Build = fn(&Progress) -> Result<Figure, Error>;

/// All figures, by the name that `--only` takes.
pub const ALL: &[(&str, Build)] = &[
    ("fig1", fig_01_model::build),
    ("fig2", fig_02_map::build),
    ("fig3", fig_03_segments::build),
    ("fig4", fig_04_local_map::build),
    ("fig5", fig_05_construction::build),
    ("fig6", fig_06_to_09_basins::figure_6),
    ("fig7", fig_06_to_09_basins::figure_7),
    ("fig8", fig_06_to_09_basins::figure_8),
    ("fig9", fig_06_to_09_basins::figure_9),
    ("invariance", invariance::build),
    ("printed", printed_against_stable::build),
];

/// The figures with these names; all of them if none is named.
pub fn named(names: &[String]) -> Result<Vec<(&'static str, Build)>, Error> {
    if names.is_empty() {
        return Ok(ALL.to_vec());
    }
    let find = |name: &String| {
        ALL.iter().find(|(known, _)| known == name).copied().ok_or_else(|| Error::UnknownName {
            kind: "figure",
            name: name.clone(),
            known: ALL.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
        })
    };
    names.iter().map(find).collect()
}

/// A CSV file; missing values are left empty.
pub(crate) fn csv_file(
    name: &str,
    header: &[&str],
    rows: impl IntoIterator<Item = Vec<Option<f64>>>,
) -> Result<DataFile, Error> {
    let fail = |e: csv::Error| Error::Render { what: name.to_owned(), reason: e.to_string() };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header).map_err(fail)?;
    for row in rows {
        let fields = row.iter().map(|value| value.map_or(String::new(), |v| format!("{v:?}")));
        writer.write_record(fields).map_err(fail)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|e| Error::Render { what: name.to_owned(), reason: e.to_string() })?;
    Ok(DataFile { name: name.to_owned(), bytes })
}
