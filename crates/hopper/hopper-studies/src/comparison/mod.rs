//! Are the figures made now the committed ones?
//!
//! Numbers and pixels are compared, not the bytes of files. A new version of a compressor, another order of attributes
//! or another number format changes no result, and gives no difference here. Numbers must be equal in all bits.
//!
//! | file | compared |
//! |---|---|
//! | [`table`] | CSV, NumPy arrays and PNG as tables of numbers |
//! | [`table_digest`] | tables of which only digests are committed |
//! | [`drawing`] | SVG as elements, attributes and numbers |

pub(crate) mod drawing;
pub(crate) mod table;
pub(crate) mod table_digest;

use crate::error::Error;
use drawing::Drawing;
use table::Table;

/// The first difference between a committed file and the same file made now; `None` if they are equal.
///
/// The ending of the name decides how both are read: `.svg`, or one of the tables.
pub(crate) fn difference(name: &str, old: &[u8], new: &[u8]) -> Result<Option<String>, Error> {
    if name.ends_with(".svg") {
        let read = |bytes| Drawing::read(name, bytes);
        return Ok(read(old)?.difference(&read(new)?));
    }
    let read = |bytes| Table::read(name, bytes);
    Ok(read(old)?.difference(&read(new)?))
}
