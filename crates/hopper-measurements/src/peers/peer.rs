//! How one of the compared programs did.

/// How one of them did.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Peer {
    pub(crate) name: String,
    /// One of ours.
    pub(crate) ours: bool,
    /// Seconds for a hop.
    pub(crate) seconds: f64,
    /// Hops compared with the reference.
    pub(crate) compared: usize,
    /// Grounded wrongly, or not.
    pub(crate) wrong: usize,
    /// Relative errors: median and worst; nothing where no speed is given.
    pub(crate) errors: Option<(f64, f64)>,
}
