//! Images of speeds, and of intervals of speeds, with rounding outwards.

use passive_hopper::HopWithin;

/// The relative width that is added to an image, beyond its bound: for the rounding of sums, and for a hump whose maximum and minimum
/// coincide within rounding, where the map deviates from a monotone one by some ulps.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The image of a speed or of an interval.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Reached {
    /// All images are in this interval.
    Within(f64, f64),
    /// The hopper is grounded from all speeds.
    Grounded,
    /// `f64` does not decide the hop, or some speeds are grounded and others are not.
    Unknown,
}

impl Reached {
    /// The images of an interval from those of two parts of its ends and extrema.
    pub(crate) fn with(self, other: Self) -> Self {
        match (self, other) {
            (Reached::Within(low, high), Reached::Within(other_low, other_high)) => {
                Reached::Within(low.min(other_low), high.max(other_high))
            }
            (Reached::Grounded, Reached::Grounded) => Reached::Grounded,
            _ => Reached::Unknown,
        }
    }

    pub(crate) fn kind(self) -> std::mem::Discriminant<Self> {
        std::mem::discriminant(&self)
    }

    pub(crate) fn middle(self) -> Option<f64> {
        match self {
            Reached::Within(low, high) => Some(low.midpoint(high)),
            _ => None,
        }
    }

    pub(crate) fn of(hop: HopWithin) -> Self {
        match hop {
            HopWithin::Next { speed, error } => {
                let error = error + ROUNDING * speed;
                Reached::Within(speed - error, speed + error)
            }
            HopWithin::Grounded => Reached::Grounded,
            HopWithin::Inconclusive => Reached::Unknown,
        }
    }
}

/// A speed with its image.
#[derive(Debug, Clone, Copy)]
pub(crate) struct End {
    pub(crate) speed: f64,
    pub(crate) reached: Reached,
}
