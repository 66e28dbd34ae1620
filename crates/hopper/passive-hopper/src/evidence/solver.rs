//! The ways to compute a hop.

/// A way to compute a hop.
///
/// [`LiftOffMap::hop`](crate::LiftOffMap::hop) takes the first of them whose decisions are all larger than their error
/// bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Solver {
    /// Tables and a fixed number of steps, in `f64`.
    Kernel,
    /// A root search for each landing, in `f64`.
    General,
    /// Landing by landing in double-double arithmetic, 106 bits.
    Bits106,
    /// Landing by landing in 256 bits.
    Bits256,
    /// Landing by landing in 512 bits.
    Bits512,
    /// Landing by landing in 1024 bits.
    Bits1024,
}

impl Solver {
    /// The next longer arithmetic, or `None` after 1024 bits. From both ways in `f64` it is 106 bits.
    pub fn longer(self) -> Option<Solver> {
        match self {
            Solver::Kernel | Solver::General => Some(Solver::Bits106),
            Solver::Bits106 => Some(Solver::Bits256),
            Solver::Bits256 => Some(Solver::Bits512),
            Solver::Bits512 => Some(Solver::Bits1024),
            Solver::Bits1024 => None,
        }
    }
}
