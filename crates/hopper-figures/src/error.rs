//! Errors of the drawings.

use thiserror::Error;

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// An image could not be encoded.
    #[error(transparent)]
    Figure(#[from] journal_figures::Error),
}
