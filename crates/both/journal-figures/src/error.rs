//! Errors of figures.

use thiserror::Error;

/// Why a figure or its data could not be encoded.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A drawing could not be rendered, or a file of it could not be encoded.
    #[error("cannot render {what}: {reason}")]
    Render {
        /// Name of the drawing or file.
        what: String,
        /// The message of the library.
        reason: String,
    },
}
