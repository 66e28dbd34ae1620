//! Columns of shares as bytes, for pieces on disk.
//!
//! ```text
//!   number of labels (2) │ labels (2 each) │ shares (4 each)        a blank column has no bytes
//! ```

use crate::error::Error;
use basin_of_attraction::Label;
use hopper_basin::ShareColumn;

/// A column as bytes; `None` is a blank column.
pub(crate) fn bytes(column: Option<&ShareColumn>) -> Vec<u8> {
    let Some(ShareColumn { labels, shares }) = column else { return Vec::new() };
    let mut bytes = Vec::with_capacity(2 + 2 * labels.len() + 4 * shares.len());
    bytes.extend((labels.len() as u16).to_le_bytes());
    bytes.extend(labels.iter().flat_map(|label| label.code().to_le_bytes()));
    bytes.extend(shares.iter().flat_map(|share| share.to_le_bytes()));
    bytes
}

/// The inverse of [`bytes`].
///
/// # Errors
/// [`Error::Unreadable`] for bytes of another length; the digest of a piece refuses all other damage before.
pub(crate) fn column(bytes: &[u8]) -> Result<Option<ShareColumn>, Error> {
    let Some((count, rest)) = bytes.split_first_chunk::<2>() else { return Ok(None) };
    let count = 2 * usize::from(u16::from_le_bytes(*count));
    let short =
        || Error::Unreadable("the bytes of a finished column of shares end too early".into());
    let (labels, shares) = rest.split_at_checked(count).ok_or_else(short)?;
    let labels = labels
        .as_chunks::<2>()
        .0
        .iter()
        .map(|pair| Label::from_code(u16::from_le_bytes(*pair)))
        .collect();
    let shares = shares.as_chunks::<4>().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
    Ok(Some(ShareColumn { labels, shares }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_come_back_and_a_blank_one_too() {
        let own = ShareColumn {
            labels: [0, 7, 60_000].map(Label::from_code).to_vec(),
            shares: vec![0.25, 0.5, 0.125, 1.0, 0.0, 0.0],
        };
        assert_eq!(column(&bytes(Some(&own))).unwrap(), Some(own.clone()));
        assert_eq!(column(&bytes(None)).unwrap(), None);
        assert!(column(&bytes(Some(&own))[..5]).is_err());
    }
}
