//! Results as files, with their meaning: arrays for NumPy, tables as CSV.

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

impl LabelImage {
    /// The labels as an array for NumPy, and a table that says what its axes and numbers are. `name` is that of both files, without an ending.
    ///
    /// # Errors
    /// That of the table.
    pub fn files(&self, name: &str) -> Result<[DataFile; 2], Error> {
        let mut bytes = npy_header(Order::C, Element::U16, self.grid.rows, self.grid.columns);
        bytes.extend(self.labels.iter().flat_map(|label| label.code().to_le_bytes()));
        let codes: Vec<Label> = self.counts().into_iter().map(|(label, _)| label).collect();
        let table = meaning(&format!("{name}.csv"), self.grid, "codes of labels", &codes)?;
        Ok([DataFile { name: format!("{name}.npy"), bytes }, table])
    }
}

impl ValueImage<f64> {
    /// The numbers as an array for NumPy, and a table that says what its axes are and, by `of`, what its numbers are. `name` is that of both files,
    /// without an ending.
    ///
    /// # Errors
    /// That of the table.
    pub fn files(&self, name: &str, of: &str) -> Result<[DataFile; 2], Error> {
        let mut bytes = npy_header(Order::C, Element::F64, self.grid.rows, self.grid.columns);
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        let table = meaning(&format!("{name}.csv"), self.grid, of, &[])?;
        Ok([DataFile { name: format!("{name}.npy"), bytes }, table])
    }
}

impl FractionsAlong {
    /// A line for each parameter and basin: its fraction, with the lower and the upper end of its range.
    ///
    /// # Errors
    /// That of the table.
    pub fn csv(&self, name: &str) -> Result<DataFile, Error> {
        let labels = self.labels();
        let row = |parameter: f64, label: &Label, own: FractionRange| {
            vec![
                digits(parameter),
                label.to_string(),
                digits(own.value),
                digits(own.lower),
                digits(own.upper),
            ]
        };
        let rows = self.points().iter().flat_map(|(parameter, fractions)| {
            labels.iter().map(move |label| row(*parameter, label, fractions.of(*label)))
        });
        csv_text(
            name,
            &["parameter", "label", "fraction", "lower", "upper"],
            rows.collect::<Vec<_>>(),
        )
    }
}

impl Attractors {
    /// A line for each point of each attractor: its label, its period (empty if there is none), the number of the point, and the coordinates.
    ///
    /// # Errors
    /// That of the table.
    pub fn csv(&self, name: &str) -> Result<DataFile, Error> {
        let dimension =
            self.attractors().first().and_then(|own| own.points.first()).map_or(0, Vec::len);
        let mut header = vec!["label".to_owned(), "period".to_owned(), "point".to_owned()];
        header.extend((0..dimension).map(|k| format!("x{k}")));
        let mut rows = Vec::new();
        for own in self.attractors() {
            let period = own.period.map_or(String::new(), |period| period.to_string());
            for (number, point) in own.points.iter().enumerate() {
                let mut row = vec![own.label.to_string(), period.clone(), number.to_string()];
                row.extend(point.iter().map(|x| digits(*x)));
                rows.push(row);
            }
        }
        csv_text(name, &header, rows)
    }
}
