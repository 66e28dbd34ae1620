//! Tables of numbers: the contents of CSV files, NumPy arrays and PNG images.

use crate::error::Error;

/// An entry of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Cell {
    /// The bits of an `f64`. Two numbers are equal if all their bits are, so that −0 differs from 0, and NaN equals
    /// NaN.
    Number(u64),
    /// Red, green, blue and opacity of a pixel, 8 bits each.
    Pixel([u8; 4]),
    /// An entry of a CSV file that is no number, for example an empty one.
    Text(Box<str>),
}

impl std::fmt::Display for Cell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Cell::Number(bits) => write!(f, "{:?}", f64::from_bits(*bits)),
            Cell::Pixel([red, green, blue, opacity]) => {
                write!(f, "#{red:02x}{green:02x}{blue:02x}{opacity:02x}")
            }
            Cell::Text(text) => write!(f, "\"{text}\""),
        }
    }
}

/// A table: the entries of one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Table {
    /// The header of a CSV file; `None` for arrays and images, whose columns have numbers.
    pub(crate) header: Option<Vec<String>>,
    /// Number of columns.
    pub(crate) columns: usize,
    /// The entries, row after row.
    pub(crate) cells: Vec<Cell>,
}

impl Table {
    /// Reads a file; the ending of its name decides how.
    pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Self, Error> {
        match name.rsplit_once('.').map(|(_, ending)| ending) {
            Some("csv") => csv_table(bytes).map_err(|e| Error::unreadable(name, e)),
            Some("npy") => npy_table(bytes).map_err(|reason| Error::unreadable(name, reason)),
            Some("png") => png_table(bytes).map_err(|e| Error::unreadable(name, e)),
            _ => Err(Error::unreadable(name, "only CSV, NumPy and PNG files are tables")),
        }
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.cells.len() / self.columns.max(1)
    }

    /// The name of a column: its header, or its number from zero.
    pub(crate) fn column_name(&self, column: usize) -> String {
        let named = self.header.as_ref().and_then(|header| header.get(column));
        named.map_or_else(|| format!("column {column}"), |name| format!("column {name}"))
    }

    /// The first entry that differs, with the number of entries that do; `None` if the tables are equal.
    pub(crate) fn difference(&self, new: &Table) -> Option<String> {
        if self.header != new.header {
            let header = |table: &Table| table.header.clone().unwrap_or_default().join(",");
            return Some(format!("the header was {}, is {}", header(self), header(new)));
        }
        if (self.columns, self.rows()) != (new.columns, new.rows()) {
            let size = |table: &Table| format!("{} × {}", table.rows(), table.columns);
            return Some(format!("rows × columns were {}, are {}", size(self), size(new)));
        }
        let pairs = || self.cells.iter().zip(&new.cells).enumerate();
        let count = pairs().filter(|(_, (a, b))| a != b).count();
        let (at, (old, new)) = pairs().find(|(_, (a, b))| a != b)?;
        let (row, column) = (at / self.columns, self.column_name(at % self.columns));
        Some(format!(
            "row {row}, {column} was {old}, is {new}; {count} of {} differ",
            self.cells.len()
        ))
    }
}

fn csv_table(bytes: &[u8]) -> Result<Table, csv::Error> {
    let mut reader = csv::Reader::from_reader(bytes);
    let header: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    let mut cells = Vec::new();
    for record in reader.records() {
        // The reader refuses a record whose number of fields is not that of the header.
        cells.extend(record?.iter().map(|field| match field.parse::<f64>() {
            Ok(number) => Cell::Number(number.to_bits()),
            Err(_) => Cell::Text(field.into()),
        }));
    }
    Ok(Table { columns: header.len(), header: Some(header), cells })
}

/// Reads an array of 16-bit unsigned integers in two dimensions. Labels of basins are the only arrays of the figures.
fn npy_table(bytes: &[u8]) -> Result<Table, &'static str> {
    // Magic (6 bytes), version (2 bytes) and length (2 bytes), then a Python dictionary.
    const BEFORE_TEXT: usize = 10;
    let start = bytes.get(..BEFORE_TEXT).filter(|start| start.starts_with(b"\x93NUMPY\x01"));
    let start = start.ok_or("it is no NumPy file of version 1")?;
    let data = BEFORE_TEXT + usize::from(u16::from_le_bytes([start[8], start[9]]));
    let text = bytes.get(BEFORE_TEXT..data).and_then(|text| std::str::from_utf8(text).ok());
    let text = text.ok_or("its header is cut")?;
    let after = |key: &str| text.split_once(key).map(|(_, rest)| rest.trim_start());
    if !after("'descr':").is_some_and(|rest| rest.starts_with("'<u2'")) {
        return Err("its elements are no 16-bit unsigned integers");
    }
    let fortran = after("'fortran_order':").is_some_and(|rest| rest.starts_with("True"));
    let shape = after("'shape':").and_then(|rest| rest.strip_prefix('(')?.split_once(')'));
    let shape = shape.ok_or("its header has no shape")?.0;
    let sizes: Result<Vec<usize>, _> = shape.split(',').map(|size| size.trim().parse()).collect();
    let Ok([rows, columns]) = sizes.as_deref() else {
        return Err("it has no two dimensions");
    };
    let (rows, columns) = (*rows, *columns);
    let elements = &bytes[data..];
    if rows.checked_mul(columns).and_then(|n| n.checked_mul(2)) != Some(elements.len()) {
        return Err("it has another number of elements than its header says");
    }
    let cell = |row: usize, column: usize| {
        let at = 2 * if fortran { column * rows + row } else { row * columns + column };
        let value = u16::from_le_bytes([elements[at], elements[at + 1]]);
        Cell::Number(f64::from(value).to_bits())
    };
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| cell(row, column)));
    Ok(Table { header: None, columns, cells: cells.collect() })
}

/// Reads a PNG as pixels of 8 bits a channel, whether its file has a palette or colours.
fn png_table(bytes: &[u8]) -> Result<Table, png::DecodingError> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let image = reader.next_frame(&mut pixels)?;
    pixels.truncate(image.buffer_size());
    let cell = |channels: &[u8]| match *channels {
        [gray] => Cell::Pixel([gray, gray, gray, u8::MAX]),
        [gray, opacity] => Cell::Pixel([gray, gray, gray, opacity]),
        [red, green, blue] => Cell::Pixel([red, green, blue, u8::MAX]),
        [red, green, blue, opacity, ..] => Cell::Pixel([red, green, blue, opacity]),
        [] => Cell::Pixel([0; 4]),
    };
    let cells = pixels.chunks(image.color_type.samples()).map(cell).collect();
    Ok(Table { header: None, columns: image.width as usize, cells })
}

#[cfg(test)]
mod tests {
    use super::*;
    use journal_figures::{Element, Order, npy_header};
    use journal_figures::{csv_file, indexed_png};

    fn csv(values: [f64; 4]) -> Table {
        let rows = values.chunks(2).map(|row| row.iter().copied());
        Table::read("x.csv", &csv_file("x.csv", &["a", "b"], rows).unwrap().bytes).unwrap()
    }

    fn array(order: Order, elements: [u16; 6]) -> Table {
        let mut bytes = npy_header(order, Element::U16, 2, 3);
        bytes.extend(elements.iter().flat_map(|element| element.to_le_bytes()));
        Table::read("x.npy", &bytes).unwrap()
    }

    #[test]
    fn one_changed_number_is_found_with_its_place() {
        let old = csv([0.1, 0.2, 0.3, 0.4]);
        assert_eq!(old.difference(&csv([0.1, 0.2, 0.3, 0.4])), None);
        let changed = csv([0.1, 0.2, 0.3, 0.4f64.next_up()]);
        let expected = "row 1, column b was 0.4, is 0.4000000000000001; 1 of 4 differ";
        assert_eq!(old.difference(&changed).as_deref(), Some(expected));
        assert!(csv([0.0; 4]).difference(&csv([0.0, 0.0, -0.0, 0.0])).is_some());
    }

    /// The value decides, not its digits.
    #[test]
    fn another_number_format_is_no_difference() {
        let read = |text: &str| Table::read("x.csv", text.as_bytes()).unwrap();
        let old = read("a,b\n1000,0.5\n2.5e-1,\n");
        assert_eq!(old.difference(&read("a,b\r\n1e3,0.50\r\n0.25,\r\n")), None);
        assert!(old.difference(&read("a,c\n1000,0.5\n2.5e-1,\n")).is_some());
        assert!(old.difference(&read("a,b\n1000,0.5\n")).unwrap().contains("2 × 2"));
        assert!(old.difference(&read("a,b\n1000,0.5\n0.25,0\n")).unwrap().contains("was \"\""));
        assert!(Table::read("x.csv", b"a,b\n1\n").is_err());
    }

    /// The order of the elements in the file is not part of the array.
    #[test]
    fn one_changed_label_is_found_in_either_order_of_the_file() {
        let old = array(Order::C, [1, 2, 3, 4, 5, 6]);
        assert_eq!(old.difference(&array(Order::Fortran, [1, 4, 2, 5, 3, 6])), None);
        let changed = old.difference(&array(Order::C, [1, 2, 3, 4, 7, 6]));
        let expected = "row 1, column 1 was 5.0, is 7.0; 1 of 6 differ";
        assert_eq!(changed.as_deref(), Some(expected));
        assert!(Table::read("x.npy", &npy_header(Order::C, Element::U16, 2, 3)).is_err());
        assert!(Table::read("x.npy", b"\x93NUMPY\x01\x00\x10").is_err());
    }

    #[test]
    fn one_changed_pixel_is_found_whatever_the_compressor() {
        let (red, blue) = ([255, 0, 0], [0, 0, 255]);
        let indexed = |pixels: &[u8]| indexed_png("x", 3, 2, &[red, blue], pixels).unwrap();
        let read = |bytes: &[u8]| Table::read("x.png", bytes).unwrap();
        let old = read(&indexed(&[0, 1, 0, 1, 0, 1]));
        // The same pixels in colours without a palette, uncompressed.
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::NoCompression);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[red, blue, red, blue, red, blue].concat()).unwrap();
        writer.finish().unwrap();
        assert_eq!(old.difference(&read(&bytes)), None);
        let changed = old.difference(&read(&indexed(&[0, 1, 0, 1, 1, 1])));
        let expected = "row 1, column 1 was #ff0000ff, is #0000ffff; 1 of 6 differ";
        assert_eq!(changed.as_deref(), Some(expected));
        assert!(Table::read("x.png", &bytes[..30]).is_err());
    }
}
