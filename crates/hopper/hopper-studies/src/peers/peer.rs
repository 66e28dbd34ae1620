//! Time and error of one of the compared programs.

/// Time and error of one program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Peer {
    pub(crate) name: String,
    /// True for a method of this repository.
    pub(crate) ours: bool,
    /// Seconds for a hop.
    pub(crate) seconds: f64,
    /// Hops compared with the reference.
    pub(crate) compared: usize,
    /// Hops that are grounded in the reference alone, or in this program alone.
    pub(crate) wrong: usize,
    /// Relative errors of α′, median and worst; `None` if the program gives no α′ at all.
    pub(crate) errors: Option<(f64, f64)>,
}
