//! The phases of a motion.

/// The phases between events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Phase {
    /// Both masses in the air (paper, Eq. 1).
    Flight,
    /// The lower mass on the ground, the upper one oscillating.
    Contact,
}
