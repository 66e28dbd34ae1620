//! Results as files, each with a table that says what it means: arrays for NumPy, tables as CSV.

use crate::attractors::recurrences::Attractors;
use crate::parameters::fractions_along::FractionsAlong;
use crate::shares::fractions::FractionRange;
use crate::space::label::Label;
use crate::space::raster::{Grid, LabelImage};
use crate::space::value_image::ValueImage;
use journal_figures::{DataFile, Element, Error, Order, csv_text, npy_header};

/// The shortest digits that give a number back.
fn digits(x: f64) -> String {
    format!("{x:?}")
}

/// What an array on a grid means, as a table of names and values.
fn meaning(name: &str, grid: Grid, of: &str, codes: &[Label]) -> Result<DataFile, Error> {
    let ends = |at: &dyn Fn(usize) -> f64, count: usize| {
        format!("{} {}", digits(at(0)), digits(at(count.saturating_sub(1))))
    };
    let mut rows = vec![
        vec!["values".to_owned(), of.to_owned()],
        vec!["first axis".to_owned(), "rows, from the smallest y".to_owned()],
        vec!["second axis".to_owned(), "columns, from the smallest x".to_owned()],
        vec![
            "x of the first and the last column".to_owned(),
            ends(&|k| grid.x_at(k), grid.columns),
        ],
        vec!["y of the first and the last row".to_owned(), ends(&|k| grid.y_at(k), grid.rows)],
    ];
    rows.extend(codes.iter().map(|label| vec![label.code().to_string(), label.to_string()]));
    csv_text(name, &["name", "meaning"], rows)
}

/// An error unless there are as many values as the grid has pixels, and at least one.
fn check_count(name: &str, grid: Grid, count: usize) -> Result<(), Error> {
    let Grid { columns, rows, .. } = grid;
    if count > 0 && columns.checked_mul(rows) == Some(count) {
        return Ok(());
    }
    let reason = format!("it has {count} values for {columns} columns and {rows} rows");
    Err(Error::Render { what: name.to_owned(), reason })
}

impl LabelImage {
    /// The labels as an array for NumPy, and a table that says what its axes and numbers are. `name` is that of both files, without an ending.
    ///
    /// # Errors
    /// [`Error::Render`] for another number of labels than pixels; that of the table.
    pub fn files(&self, name: &str) -> Result<[DataFile; 2], Error> {
        check_count(name, self.grid, self.labels.len())?;
        let mut bytes = npy_header(Order::C, Element::U16, self.grid.rows, self.grid.columns);
        bytes.extend(self.labels.iter().flat_map(|label| label.code().to_le_bytes()));
        let codes: Vec<Label> = self.counts().into_iter().map(|(label, _)| label).collect();
        let table = meaning(&format!("{name}-meaning.csv"), self.grid, "codes of labels", &codes)?;
        Ok([DataFile { name: format!("{name}.npy"), bytes }, table])
    }
}

impl ValueImage<f64> {
    /// The numbers as an array for NumPy, and a table that says what its axes are and, by `of`, what its numbers are. `name` is that of both files,
    /// without an ending.
    ///
    /// # Errors
    /// [`Error::Render`] for another number of values than pixels; that of the table.
    pub fn files(&self, name: &str, of: &str) -> Result<[DataFile; 2], Error> {
        check_count(name, self.grid, self.values.len())?;
        let mut bytes = npy_header(Order::C, Element::F64, self.grid.rows, self.grid.columns);
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        let table = meaning(&format!("{name}-meaning.csv"), self.grid, of, &[])?;
        Ok([DataFile { name: format!("{name}.npy"), bytes }, table])
    }
}

/// A table, and one that says what its columns are.
fn table(
    name: &str,
    columns: &[(String, &str)],
    rows: Vec<Vec<String>>,
) -> Result<[DataFile; 2], Error> {
    let header: Vec<&str> = columns.iter().map(|(column, _)| column.as_str()).collect();
    let meaning = columns.iter().map(|(column, of)| vec![column.clone(), (*of).to_owned()]);
    let meaning: Vec<Vec<String>> = meaning.collect();
    let about = csv_text(&format!("{name}-meaning.csv"), &["name", "meaning"], meaning)?;
    Ok([csv_text(&format!("{name}.csv"), &header, rows)?, about])
}

impl FractionsAlong {
    /// A table with a line for each parameter and basin: its fraction, with the lower and the upper end of its range; and a table that says what its columns
    /// are: `parameter` is the meaning of the parameter, `range` that of the ranges, such as "95 % interval". `name` is that of both files, without an ending.
    ///
    /// # Errors
    /// That of the tables.
    pub fn files(&self, name: &str, parameter: &str, range: &str) -> Result<[DataFile; 2], Error> {
        let labels = self.labels();
        let row = |parameter: f64, label: &Label, own: FractionRange| {
            let numbers = [own.value, own.lower, own.upper].map(digits);
            [digits(parameter), label.to_string()].into_iter().chain(numbers).collect()
        };
        let rows = self.points().iter().flat_map(|(parameter, fractions)| {
            labels.iter().map(move |label| row(*parameter, label, fractions.of(*label)))
        });
        let (lower, upper) = (format!("lower end: {range}"), format!("upper end: {range}"));
        let columns = [
            ("parameter", parameter),
            ("label", "the basin, with one label at all parameters"),
            ("fraction", "its fraction of the region"),
            ("lower", &lower),
            ("upper", &upper),
        ];
        table(name, &columns.map(|(column, of)| (column.to_owned(), of)), rows.collect())
    }
}

impl Attractors {
    /// A table with a line for each point of each attractor: its label, its period (empty if there is none), the number of the point, and the coordinates; and a
    /// table that says so. `name` is that of both files, without an ending.
    ///
    /// # Errors
    /// That of the tables.
    pub fn files(&self, name: &str) -> Result<[DataFile; 2], Error> {
        let dimension =
            self.attractors().first().and_then(|own| own.points.first()).map_or(0, Vec::len);
        let mut columns = vec![
            ("label".to_owned(), "the attractor"),
            ("period".to_owned(), "steps until it repeats itself; empty if there is no period"),
            ("point".to_owned(), "the number of the point: points follow each other under the map"),
        ];
        columns.extend((0..dimension).map(|k| (format!("x{k}"), "coordinate of the state")));
        let mut rows = Vec::new();
        for own in self.attractors() {
            let period = own.period.map_or(String::new(), |period| period.to_string());
            for (number, point) in own.points.iter().enumerate() {
                let mut row = vec![own.label.to_string(), period.clone(), number.to_string()];
                row.extend(point.iter().map(|x| digits(*x)));
                rows.push(row);
            }
        }
        table(name, &columns, rows)
    }
}
