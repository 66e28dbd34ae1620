//! The header of a NumPy file.

/// The order in which a file lists the elements of a two-dimensional array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Row after row.
    C,
    /// Column after column.
    Fortran,
}

/// The elements of an array, little-endian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// Unsigned integers of 16 bits.
    U16,
    /// Of 32 bits.
    U32,
    /// Of 64 bits.
    U64,
    /// Floating-point numbers of 32 bits.
    F32,
    /// Of 64 bits.
    F64,
}

/// The header of a NumPy file (version 1.0; NumPy Enhancement Proposal 1) for a two-dimensional array.
///
/// The file is this header, followed by `rows` × `columns` elements in the given order.
///
/// ```
/// use journal_figures::{Element, Order, npy_header};
/// let header = npy_header(Order::C, Element::U16, 2, 3);
/// assert_eq!(header.len(), 128);
/// assert!(header.starts_with(b"\x93NUMPY\x01\x00"));
/// ```
pub fn npy_header(order: Order, element: Element, rows: usize, columns: usize) -> Vec<u8> {
    // The format asks that the elements start at a multiple of 64 bytes, for readers that map the file to memory.
    const ALIGNMENT: usize = 64;
    // Magic (6 bytes), version (2 bytes), and the length of the text (2 bytes).
    const BEFORE_TEXT: usize = 10;
    // The text is a Python dictionary. A comma after its last entry is optional, and readers accept both forms. Each
    // order keeps the form of its first files, so that their digests stay comparable.
    let (fortran, end) = match order {
        Order::C => ("False", "}"),
        Order::Fortran => ("True", ", }"),
    };
    let descr = match element {
        Element::U16 => "<u2",
        Element::U32 => "<u4",
        Element::U64 => "<u8",
        Element::F32 => "<f4",
        Element::F64 => "<f8",
    };
    let mut text = format!(
        "{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': ({rows}, {columns}){end}"
    );
    let unpadded = BEFORE_TEXT + text.len() + 1; // the text ends with a line feed
    text.push_str(&" ".repeat(unpadded.next_multiple_of(ALIGNMENT) - unpadded));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // Two numbers of at most 20 digits: the length stays below 128, far from the limit of 16 bits.
    bytes.extend_from_slice(&(text.len() as u16).to_le_bytes());
    bytes.extend_from_slice(text.as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;
    use ndarray_npy::{ReadNpyExt, WriteNpyExt};

    #[test]
    fn an_independent_reader_finds_every_element() {
        for (order, at_0_1, at_1_0) in [(Order::C, 1, 4), (Order::Fortran, 3, 1)] {
            let mut bytes = npy_header(order, Element::U16, 3, 4);
            bytes.extend((0u16..12).flat_map(u16::to_le_bytes));
            let array: Array2<u16> = Array2::read_npy(std::io::Cursor::new(bytes)).unwrap();
            assert_eq!(array.dim(), (3, 4));
            assert_eq!((array[(0, 0)], array[(0, 1)], array[(1, 0)]), (0, at_0_1, at_1_0));
        }
    }

    #[test]
    fn an_independent_writer_writes_the_same_header() {
        for (rows, columns) in [(1, 1), (3, 4), (600, 600), (1024, 9999), (1, 1_048_576)] {
            let mut bytes = Vec::new();
            Array2::<u16>::zeros((rows, columns)).write_npy(&mut bytes).unwrap();
            let header = npy_header(Order::C, Element::U16, rows, columns);
            assert_eq!(&bytes[..header.len()], header, "{rows} × {columns}");
            assert_eq!(bytes.len(), header.len() + 2 * rows * columns);
        }
    }

    #[test]
    fn long_elements_come_back() {
        let mut bytes = npy_header(Order::Fortran, Element::U64, 2, 2);
        bytes.extend([1, 1 << 40, u64::MAX, 0].iter().flat_map(|n: &u64| n.to_le_bytes()));
        let array: Array2<u64> = Array2::read_npy(std::io::Cursor::new(bytes)).unwrap();
        assert_eq!((array[(1, 0)], array[(0, 1)]), (1 << 40, u64::MAX));
    }

    #[test]
    fn elements_start_at_a_multiple_of_64_bytes() {
        for columns in [1, 10, 1000, 100_000, usize::MAX] {
            assert_eq!(npy_header(Order::C, Element::U16, 7, columns).len() % 64, 0);
        }
    }

    #[test]
    fn numbers_come_back() {
        let mut bytes = npy_header(Order::C, Element::F64, 1, 2);
        bytes.extend([0.1f64, f64::NAN].iter().flat_map(|x| x.to_le_bytes()));
        let array: Array2<f64> = Array2::read_npy(std::io::Cursor::new(bytes)).unwrap();
        assert!(array[(0, 0)] == 0.1 && array[(0, 1)].is_nan());
    }
}
