//! The tables that `hopper basins` prints.

use crate::basins::pieces::Finished;
use crate::basins::status::STATUS;
use crate::output::{Cell, Column, Table, TableKind};
use hopper_figures::{Content, LAYERS, Layer, Meaning, Values};
use resumable_job::Part;
use serde_json::Value;

pub(crate) static FILES: TableKind = TableKind {
    name: "files",
    about: "one row for each result",
    long: false,
    columns: &[Column::new("path", "", "the file"), Column::new("content", "", "what it has")],
};

const LABELS: TableKind = TableKind {
    name: "labels",
    about: "one row for each fate that occurs",
    long: false,
    columns: &[
        Column::new("label", "", "number in the array"),
        Column::new("fate", "", "its meaning"),
        Column::new("pixels", "", "number of pixels"),
        Column::new("fraction", "", "fraction of all pixels").measured(),
    ],
};

const PROOFS: TableKind = TableKind {
    name: "proofs",
    about: "one row for each fate that occurs, proved or only computed, with --layer proof",
    long: false,
    columns: &[
        Column::new("label", "", "number of the fate"),
        Column::new("fate", "", "its meaning"),
        Column::new("proved", "", "whether it is proved: then the array has 65536 more"),
        Column::new("pixels", "", "number of pixels"),
        Column::new("fraction", "", "fraction of all pixels").measured(),
    ],
};

/// The columns of the tables of whole numbers.
const NUMBERS: &[Column] = &[
    Column::new("pixels", "", "number of pixels"),
    Column::new("smallest", "", "smallest number"),
    Column::new("largest", "", "largest number"),
    Column::new("mean", "", "mean over all pixels").measured(),
];

/// The columns of the tables of real numbers.
const REALS: &[Column] = &[
    Column::new("pixels", "", "number of pixels"),
    Column::new(
        "without",
        "",
        "pixels that have no number, such as those of a hopper that is grounded",
    ),
    Column::new("smallest", "", "smallest number").measured(),
    Column::new("largest", "", "largest number").measured(),
    Column::new("mean", "", "mean over all pixels that have one").measured(),
];

/// The table of a layer. Those of fates have names of their own, and that of shares belongs to `coverage`.
const fn table_of(layer: &'static Layer) -> TableKind {
    let columns = match &layer.content {
        Content::Shares(_) => return SHARES,
        Content::Values(values) => match values.meaning {
            Meaning::Fates { flag: None } => return LABELS,
            Meaning::Fates { flag: Some(_) } => return PROOFS,
            Meaning::Numbers { .. } => NUMBERS,
            Meaning::Reals(_) => REALS,
        },
    };
    TableKind { name: layer.key, about: layer.about, long: false, columns }
}

/// The tables of the layers, in their order.
static OF_LAYERS: [TableKind; LAYERS.len()] = {
    let mut all = [SHARES; LAYERS.len()];
    let mut at = 0;
    while at < all.len() {
        all[at] = table_of(&LAYERS[at]);
        at += 1;
    }
    all
};

pub(crate) const SHARES: TableKind = TableKind {
    name: "shares",
    about: "one row for each fate that occurs, of `coverage` and `scales`",
    long: false,
    columns: &[
        Column::new("label", "", "number of the fate"),
        Column::new("fate", "", "its meaning"),
        Column::new("mean_share", "", "mean of its shares over all pixels").measured(),
        Column::new("file", "", "array of its shares, 65535 for 1"),
    ],
};

pub(crate) static EDGE: TableKind = TableKind {
    name: "edge",
    about: "the edge of a basin in the middle of all frames, of `zoom`",
    long: false,
    columns: &[
        Column::new("speed", "m₂gω/k", "the edge p as the nearest number").measured(),
        Column::new("rest", "m₂gω/k", "p minus this number").with_error("error"),
        Column::new("error", "m₂gω/k", "bound on the error of their sum").error(),
        Column::new("fixed_point", "", "n of the α*_n that the orbit of p comes to"),
        Column::new("hops", "hops", "number of hops to it"),
        Column::new("slope", "m₂gω/k", "dp/dM").measured(),
        Column::new("frames", "", "number of frames"),
    ],
};

pub(crate) static PARTS: TableKind = TableKind {
    name: "parts",
    about: "what this call did of a part, with --part",
    long: false,
    columns: &[
        Column::new("part", "", "the part"),
        Column::new("pieces", "", "folder of its pieces"),
        Column::new("finished", "", "number of its pieces, all finished"),
        Column::new("found", "", "number of those that an earlier call had finished"),
    ],
};

/// The table of a layer; `None` for other words.
pub(crate) fn of_layer(key: &str) -> Option<&'static TableKind> {
    LAYERS.iter().zip(&OF_LAYERS).find(|(layer, _)| layer.key == key).map(|(_, table)| table)
}

/// The other tables.
const OTHERS: [&TableKind; 4] = [&EDGE, &PARTS, &FILES, &STATUS];

/// All tables, the main one first.
pub(crate) static ALL: [&TableKind; LAYERS.len() + OTHERS.len()] = {
    let mut all = [OTHERS[0]; LAYERS.len() + OTHERS.len()];
    let mut at = 0;
    while at < all.len() {
        all[at] = if at < LAYERS.len() { &OF_LAYERS[at] } else { OTHERS[at - LAYERS.len()] };
        at += 1;
    }
    all
};

/// The tables of a call: those that have no meaning for it are absent.
#[derive(Debug, Default)]
pub(crate) struct Tables {
    files: Option<Table>,
    /// Those of layers.
    layers: Vec<Table>,
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

    /// Adds the table of a layer, from its summary.
    pub(crate) fn push_layer(&mut self, key: &str, values: &Values, summary: &Value) {
        let Some(kind) = of_layer(key) else { return };
        self.layers.extend(match values.meaning {
            Meaning::Fates { flag } => labels(kind, flag, summary),
            Meaning::Numbers { .. } => numbers(kind, summary),
            Meaning::Reals(_) => Some(real_numbers(kind, summary)),
        });
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
        let Tables { files, mut layers, shares, edge, parts } = self;
        layers.sort_by_key(|table| ALL.iter().position(|kind| std::ptr::eq(*kind, table.kind)));
        layers.into_iter().chain([shares, edge, parts, files].into_iter().flatten()).collect()
    }
}

/// A quotient of two counts: of whole numbers up to 2⁵³, or rounded to `f64`.
fn rounded_once(quotient: f64) -> Cell {
    Cell::measured(quotient, 1.51 * f64::EPSILON * quotient)
}

/// The table of a legend of labels; `None` if this is none.
fn labels(kind: &'static TableKind, flag: Option<&str>, legend: &Value) -> Option<Table> {
    let entries = legend.as_array()?;
    let pixels = |entry: &Value| entry["pixels"].as_u64();
    let all: u64 = entries.iter().filter_map(pixels).sum();
    let mut table = Table::new(kind);
    for entry in entries {
        let fraction = pixels(entry).map(|pixels| rounded_once(pixels as f64 / all as f64));
        let (label, name) = (entry["label"].as_u64(), entry["name"].as_str().map(str::to_owned));
        match flag {
            None => table.push([label.into(), name.into(), pixels(entry).into(), fraction.into()]),
            Some(flag) => {
                let flag = entry[flag].as_bool();
                let pixels = pixels(entry);
                table.push([
                    label.into(),
                    name.into(),
                    flag.into(),
                    pixels.into(),
                    fraction.into(),
                ]);
            }
        }
    }
    Some(table)
}

/// The table of a summary of numbers.
fn numbers(kind: &'static TableKind, summary: &Value) -> Option<Table> {
    let mut table = Table::new(kind);
    table.push([
        summary["pixels"].as_u64().into(),
        summary["smallest"].as_u64().into(),
        summary["largest"].as_u64().into(),
        summary["mean"].as_f64().map(rounded_once).into(),
    ]);
    Some(table)
}

/// The table of a summary of real numbers, which are those of `f32`.
fn real_numbers(kind: &'static TableKind, summary: &Value) -> Table {
    let mut table = Table::new(kind);
    let number = |name: &str| {
        let rounded = |number: f64| Cell::measured(number, f64::from(f32::EPSILON) * number.abs());
        summary[name].as_f64().map(rounded)
    };
    table.push([
        summary["pixels"].as_u64().into(),
        summary["without"].as_u64().into(),
        number("smallest").into(),
        number("largest").into(),
        number("mean").into(),
    ]);
    table
}

/// The table of a legend of shares. An entry without a label is not a share.
pub(crate) fn shares(legend: &Value) -> Option<Table> {
    let mut table = Table::new(&SHARES);
    let entries = legend.as_array()?;
    let shares = || entries.iter().filter(|entry| entry["label"].is_u64());
    // What is undecided may belong to any fate. The shares of pixels have 24 bits.
    let decided: f64 = shares().filter_map(|entry| entry["mean_share"].as_f64()).sum();
    let error = (1.0 - decided).max(0.0) + f64::from(f32::EPSILON);
    for entry in shares() {
        table.push([
            entry["label"].as_u64().into(),
            entry["name"].as_str().map(str::to_owned).into(),
            entry["mean_share"].as_f64().map(|share| Cell::measured(share, error)).into(),
            entry["file"].as_str().map(str::to_owned).into(),
        ]);
    }
    Some(table)
}

/// The table of a summary of a zoom.
pub(crate) fn edge(summary: &Value) -> Option<Table> {
    let number = |name: &str| summary[name].as_f64();
    let error = number("error").unwrap_or(f64::INFINITY);
    let with = |value: Option<f64>, error: f64| value.map(|value| Cell::measured(value, error));
    let rest = number("rest");
    let mut table = Table::new(&EDGE);
    table.push([
        with(number("speed"), rest.unwrap_or(0.0).abs() + error).into(),
        with(rest, error).into(),
        Cell::Error(error),
        summary["fixed_point"].as_u64().into(),
        summary["hops"].as_u64().into(),
        // A folder of an earlier version does not have it.
        with(number("slope"), number("slope_error").unwrap_or(f64::INFINITY)).into(),
        summary["frames"].as_u64().into(),
    ]);
    Some(table)
}
