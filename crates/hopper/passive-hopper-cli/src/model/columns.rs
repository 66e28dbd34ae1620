//! Tables whose columns are the states of a model.

use crate::output::{Column, TableKind};

/// A text for as long as the program runs: a call has some names of states.
fn kept(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

/// The same table, which plain text has only with --table.
pub(crate) fn long(table: &TableKind) -> &'static TableKind {
    Box::leak(Box::new(TableKind { long: true, ..*table }))
}

/// A table with these columns and, at `at`, one for each name. It is kept as long as the program runs, as all tables are.
pub(crate) fn table(
    (name, about): (&'static str, &'static str),
    before: &[Column],
    names: impl Iterator<Item = (String, &'static str)>,
    after: &[Column],
) -> &'static TableKind {
    let fixed: Vec<&str> = before.iter().chain(after).map(|column| column.name).collect();
    // A state may have the name of another column.
    let column =
        |name: String| if fixed.contains(&name.as_str()) { format!("state_{name}") } else { name };
    let own = names.map(|(name, meaning)| Column::new(kept(column(name)), "", meaning));
    let columns: Vec<Column> =
        before.iter().copied().chain(own).chain(after.iter().copied()).collect();
    Box::leak(Box::new(TableKind {
        name,
        about,
        long: false,
        columns: Box::leak(columns.into_boxed_slice()),
    }))
}
