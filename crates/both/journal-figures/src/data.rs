//! The data beside a drawing, as CSV.

use crate::error::Error;

/// A file that belongs to a figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataFile {
    /// File name with its ending.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// A CSV file of rows of `f64`, or of `Option<f64>`: `None` becomes an empty field.
///
/// Each number has the fewest digits that identify its `f64`.
pub fn csv_file<Row: IntoIterator<Item: Into<Option<f64>>>>(
    name: &str,
    header: &[impl AsRef<str>],
    rows: impl IntoIterator<Item = Row>,
) -> Result<DataFile, Error> {
    let field = |value: Row::Item| value.into().map_or(String::new(), |v| format!("{v:?}"));
    csv_text(name, header, rows.into_iter().map(|row| row.into_iter().map(field).collect()))
}

/// A CSV file of texts.
pub fn csv_text(
    name: &str,
    header: &[impl AsRef<str>],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<DataFile, Error> {
    let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header.iter().map(AsRef::as_ref)).map_err(|e| fail(e.to_string()))?;
    for row in rows {
        writer.write_record(row).map_err(|e| fail(e.to_string()))?;
    }
    let bytes = writer.into_inner().map_err(|e| fail(e.to_string()))?;
    Ok(DataFile { name: name.to_owned(), bytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_number_is_an_empty_field() {
        let file = csv_file("x.csv", &["a", "b"], [vec![Some(0.1), None]]).unwrap();
        assert_eq!(String::from_utf8(file.bytes).unwrap(), "a,b\n0.1,\n");
    }

    #[test]
    fn a_row_of_another_length_than_the_header_is_an_error_with_the_name_of_the_file() {
        let error = csv_file("x.csv", &["a", "b"], [vec![Some(0.1)]]).unwrap_err();
        assert!(error.to_string().contains("x.csv"), "{error}");
    }
}
