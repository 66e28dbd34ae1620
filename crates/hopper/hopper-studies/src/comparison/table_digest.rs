//! Digests of tables: they tell which part of a table differs from the committed one.
//!
//! Every entry is in one part of the columns and in one part of the rows. A changed entry changes one digest of each
//! kind, and the two name its place.

use super::table::{Cell, Table};
use resumable_job::digest;
use serde::{Deserialize, Serialize};

/// The rows, and the columns without header, are divided into at most this number of parts. More parts tell the place
/// of a difference more exactly, and make `digests.json` longer.
const PARTS: usize = 12;

/// The digest of one part of a table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct PartDigest {
    /// Name of the column, or the rows or columns from and to, counted from zero.
    part: String,
    digest: String,
}

/// The digests of a table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct TableDigest {
    /// Number of rows and of columns.
    size: (usize, usize),
    columns: Vec<PartDigest>,
    rows: Vec<PartDigest>,
}

impl TableDigest {
    /// The digests of a table.
    pub(crate) fn of(table: &Table) -> Self {
        let (rows, columns) = (table.rows(), table.columns);
        let named = table.header.is_some();
        let across = parts(columns, if named { columns } else { PARTS }).map(|(from, to)| {
            let part = if named {
                table.column_name(from)
            } else {
                format!("columns {from} to {}", to - 1)
            };
            let cells = (0..rows).flat_map(|row| &table.cells[row * columns..][from..to]);
            PartDigest { part, digest: cells_digest(cells) }
        });
        let down = parts(rows, PARTS).map(|(from, to)| {
            let part = format!("rows {from} to {}", to - 1);
            PartDigest { part, digest: cells_digest(&table.cells[from * columns..to * columns]) }
        });
        TableDigest { size: (rows, columns), columns: across.collect(), rows: down.collect() }
    }

    /// The parts that differ; `None` if none does.
    pub(crate) fn difference(&self, new: &TableDigest) -> Option<String> {
        if self == new {
            return None;
        }
        let names = |digests: &TableDigest| -> Vec<String> {
            digests.columns.iter().map(|part| part.part.clone()).collect()
        };
        if (self.size, names(self)) != (new.size, names(new)) {
            let text = |digests: &TableDigest| {
                let (rows, columns) = digests.size;
                format!("{rows} × {columns} ({})", names(digests).join(", "))
            };
            return Some(format!("rows × columns were {}, are {}", text(self), text(new)));
        }
        let differing = |old: &[PartDigest], new: &[PartDigest]| {
            let pairs = old.iter().zip(new).filter(|(a, b)| a != b);
            pairs.map(|(old, _)| old.part.clone()).collect::<Vec<_>>().join(", ")
        };
        let (columns, rows) =
            (differing(&self.columns, &new.columns), differing(&self.rows, &new.rows));
        Some(format!("differs in {columns}; {rows}"))
    }
}

/// At most `parts` parts of 0..`count`, each with at least one element, and equal up to one element.
fn parts(count: usize, parts: usize) -> impl Iterator<Item = (usize, usize)> {
    let parts = parts.min(count);
    (0..parts).map(move |k| (k * count / parts, (k + 1) * count / parts))
}

/// The digest of the values of some cells. The kind of a cell comes first, so that a text of digits is no number.
fn cells_digest<'a>(cells: impl IntoIterator<Item = &'a Cell>) -> String {
    let mut bytes = Vec::new();
    for cell in cells {
        match cell {
            Cell::Number(bits) => {
                bytes.push(b'n');
                bytes.extend(bits.to_le_bytes());
            }
            Cell::Pixel(channels) => {
                bytes.push(b'p');
                bytes.extend(channels);
            }
            Cell::Text(text) => {
                bytes.push(b't');
                bytes.extend((text.len() as u64).to_le_bytes());
                bytes.extend(text.as_bytes());
            }
        }
    }
    digest(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(header: Option<&[&str]>, columns: usize, cells: usize) -> Table {
        let header = header.map(|names| names.iter().map(|name| (*name).to_owned()).collect());
        let cells = (0..cells).map(|k| Cell::Number((k as f64).to_bits())).collect();
        Table { header, columns, cells }
    }

    /// Every entry is mutated in turn: a digest that left one out would miss it.
    #[test]
    fn one_changed_number_is_found_in_its_column_and_its_rows() {
        let old = table(Some(&["a", "b"]), 2, 2 * 30);
        for at in 0..60 {
            let mut new = old.clone();
            new.cells[at] = Cell::Number((at as f64).next_up().to_bits());
            let found = TableDigest::of(&old).difference(&TableDigest::of(&new)).unwrap();
            let rows =
                found.strip_prefix(&format!("differs in column {}; rows ", ["a", "b"][at % 2]));
            let (from, to) = rows.unwrap().split_once(" to ").unwrap();
            let within = from.parse::<usize>().unwrap()..=to.parse().unwrap();
            assert!(within.contains(&(at / 2)), "{found}");
        }
    }

    #[test]
    fn one_changed_label_is_found_in_its_rows_and_columns() {
        let old = table(None, 50, 50 * 40);
        let mut new = old.clone();
        new.cells[17 * 50 + 33] = Cell::Number(0);
        let found = TableDigest::of(&old).difference(&TableDigest::of(&new)).unwrap();
        assert_eq!(found, "differs in columns 33 to 36; rows 16 to 19");
        assert_eq!(TableDigest::of(&old).difference(&TableDigest::of(&old.clone())), None);
    }

    #[test]
    fn another_size_or_header_is_a_difference() {
        let digests = |header: &[&str], cells| TableDigest::of(&table(Some(header), 2, cells));
        let old = digests(&["a", "b"], 8);
        assert!(old.difference(&digests(&["a", "b"], 6)).unwrap().contains("are 3 × 2"));
        assert!(old.difference(&digests(&["a", "c"], 8)).unwrap().contains("column c"));
        // Rows that changed places keep the set of values.
        let mut swapped = table(Some(&["a", "b"]), 2, 8);
        swapped.cells.swap(0, 2);
        assert!(old.difference(&TableDigest::of(&swapped)).is_some());
    }

    #[test]
    fn a_text_is_no_number_and_parts_are_never_empty() {
        let text = Cell::Text("1".into());
        assert_ne!(cells_digest([&text]), cells_digest([&Cell::Number(1f64.to_bits())]));
        for count in 0..40 {
            let all: Vec<_> = parts(count, PARTS).collect();
            assert_eq!(all.iter().map(|(from, to)| to - from).sum::<usize>(), count);
            assert!(all.iter().all(|(from, to)| from < to));
        }
    }
}
