//! The tables that `hopper basins` prints.

use crate::basins::pieces::Finished;
use crate::output::{Column, Table, TableKind};
use resumable_job::Part;
use serde_json::Value;

pub(crate) static FILES: TableKind = TableKind {
    name: "files",
    about: "one row for each result",
    long: false,
    columns: &[
        Column { name: "path", unit: "", meaning: "the file" },
        Column { name: "content", unit: "", meaning: "what it has" },
    ],
};

pub(crate) static LABELS: TableKind = TableKind {
    name: "labels",
    about: "one row for each fate that occurs",
    long: false,
    columns: &[
        Column { name: "label", unit: "", meaning: "number in the array" },
        Column { name: "fate", unit: "", meaning: "its meaning" },
        Column { name: "pixels", unit: "", meaning: "number of pixels" },
        Column { name: "fraction", unit: "", meaning: "fraction of all pixels" },
    ],
};

pub(crate) static HOPS: TableKind = TableKind {
    name: "hops",
    about: "the numbers of hops until the fate is known",
    long: false,
    columns: &[
        Column { name: "pixels", unit: "", meaning: "number of pixels" },
        Column { name: "smallest", unit: "hops", meaning: "smallest number" },
        Column { name: "largest", unit: "hops", meaning: "largest number" },
        Column { name: "mean", unit: "hops", meaning: "mean over all pixels" },
    ],
};

pub(crate) static SHARES: TableKind = TableKind {
    name: "shares",
    about: "one row for each fate that occurs, with --about or --coverage",
    long: false,
    columns: &[
        Column { name: "label", unit: "", meaning: "number of the fate" },
        Column { name: "fate", unit: "", meaning: "its meaning" },
        Column { name: "mean_share", unit: "", meaning: "mean of its shares over all pixels" },
        Column { name: "file", unit: "", meaning: "array of its shares, 65535 for 1" },
    ],
};

pub(crate) static EDGE: TableKind = TableKind {
    name: "edge",
    about: "the edge of a basin in the middle of all frames, with --zoom",
    long: false,
    columns: &[
        Column { name: "speed", unit: "m₂gω/k", meaning: "the edge p as the nearest number" },
        Column { name: "rest", unit: "m₂gω/k", meaning: "p minus this number" },
        Column { name: "error", unit: "m₂gω/k", meaning: "bound on the error of their sum" },
        Column {
            name: "fixed_point",
            unit: "",
            meaning: "n of the α*_n that the orbit of p comes to",
        },
        Column { name: "hops", unit: "hops", meaning: "number of hops to it" },
        Column { name: "slope", unit: "m₂gω/k", meaning: "dp/dM" },
        Column { name: "frames", unit: "", meaning: "number of frames" },
    ],
};

pub(crate) static PARTS: TableKind = TableKind {
    name: "parts",
    about: "what this call did of a part, with --part",
    long: false,
    columns: &[
        Column { name: "part", unit: "", meaning: "the part" },
        Column { name: "pieces", unit: "", meaning: "folder of its pieces" },
        Column { name: "finished", unit: "", meaning: "number of its pieces, all finished" },
        Column {
            name: "found",
            unit: "",
            meaning: "number of those that an earlier call had finished",
        },
    ],
};

/// All tables, the main one first.
pub(crate) const ALL: &[&TableKind] = &[&LABELS, &HOPS, &SHARES, &EDGE, &PARTS, &FILES];

/// The tables of a call: those that have no meaning for it are absent.
#[derive(Debug, Default)]
pub(crate) struct Tables {
    files: Option<Table>,
    pub(crate) labels: Option<Table>,
    pub(crate) hops: Option<Table>,
    pub(crate) shares: Option<Table>,
    pub(crate) edge: Option<Table>,
    parts: Option<Table>,
}

impl Tables {
    /// Adds a result.
    pub(crate) fn push_file(&mut self, path: String, content: &str) {
        self.files
            .get_or_insert_with(|| Table::new(&FILES))
            .push([path.into(), content.to_owned().into()]);
    }

    /// Adds what was done of a part.
    pub(crate) fn push_part(&mut self, part: Part, pieces: &str, finished: &Finished) {
        let table = self.parts.get_or_insert_with(|| Table::new(&PARTS));
        table.push([
            part.to_string().into(),
            pieces.to_owned().into(),
            finished.wanted.into(),
            finished.found.into(),
        ]);
    }

    /// All tables that there are.
    pub(crate) fn into_all(self) -> Vec<Table> {
        let Tables { files, labels, hops, shares, edge, parts } = self;
        [labels, hops, shares, edge, parts, files].into_iter().flatten().collect()
    }
}

/// The table of a legend of labels; `None` if this is none.
pub(crate) fn labels(legend: &Value) -> Option<Table> {
    let entries = legend.as_array()?;
    let pixels = |entry: &Value| entry["pixels"].as_u64();
    let all: u64 = entries.iter().filter_map(pixels).sum();
    let mut table = Table::new(&LABELS);
    for entry in entries {
        let fraction = pixels(entry).map(|pixels| pixels as f64 / all as f64);
        table.push([
            entry["label"].as_u64().into(),
            entry["name"].as_str().map(str::to_owned).into(),
            pixels(entry).into(),
            fraction.into(),
        ]);
    }
    Some(table)
}

/// The table of a summary of hops.
pub(crate) fn hops(summary: &Value) -> Option<Table> {
    let mut table = Table::new(&HOPS);
    table.push([
        summary["pixels"].as_u64().into(),
        summary["smallest"].as_u64().into(),
        summary["largest"].as_u64().into(),
        summary["mean"].as_f64().into(),
    ]);
    Some(table)
}

/// The table of a legend of shares. An entry without a label is not a share.
pub(crate) fn shares(legend: &Value) -> Option<Table> {
    let mut table = Table::new(&SHARES);
    for entry in legend.as_array()?.iter().filter(|entry| entry["label"].is_u64()) {
        table.push([
            entry["label"].as_u64().into(),
            entry["name"].as_str().map(str::to_owned).into(),
            entry["mean_share"].as_f64().into(),
            entry["file"].as_str().map(str::to_owned).into(),
        ]);
    }
    Some(table)
}

/// The table of a summary of a zoom.
pub(crate) fn edge(summary: &Value) -> Option<Table> {
    let mut table = Table::new(&EDGE);
    table.push([
        summary["speed"].as_f64().into(),
        summary["rest"].as_f64().into(),
        summary["error"].as_f64().into(),
        summary["fixed_point"].as_u64().into(),
        summary["hops"].as_u64().into(),
        summary["slope"].as_f64().into(),
        summary["frames"].as_u64().into(),
    ]);
    Some(table)
}
