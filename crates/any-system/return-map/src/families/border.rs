//! Borders between the pieces of a map.

use equations::Jet;

/// What lies between two pieces of a map: why the sequences of events on its sides differ.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Border {
    /// The map does not say more than that it has another piece: a border of a map of numbers.
    Piece,
    /// The orbit touches this surface: on one side it meets it, on the other one it passes beside it.
    Grazing {
        /// The mode and the surface.
        surface: String,
    },
    /// The orbit meets two surfaces at one instant: a corner.
    Corner {
        /// The modes and the surfaces.
        surfaces: [String; 2],
    },
    /// On one side the orbit stays on this surface, on the other one it leaves it: the onset of sliding, or of sticking.
    Sliding {
        /// The mode and the surface.
        surface: String,
    },
    /// On one side infinitely many events end in a Zeno limit, on the other one finitely many do not: chattering becomes complete.
    Chattering {
        /// The mode.
        mode: String,
    },
}

/// How near an orbit comes to a surface that it does not meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    /// The number of events before.
    pub place: usize,
    /// The mode and the surface.
    pub surface: String,
    /// The side of the surface on which the orbit is: 1 where the guard is positive, else −1.
    pub side: f64,
    /// The smallest distance from zero of the guard where it turns, with its derivative along the curve of starts. It is positive.
    pub value: Jet<2>,
}

/// A border beside a point of a map, with what it takes to follow it.
#[derive(Debug, Clone, PartialEq)]
pub struct BorderSite {
    /// What it is.
    pub border: Border,
    /// The sequence of events with which the map goes on smoothly beyond the border.
    pub itinerary: Vec<String>,
    /// The place in this sequence at which the border is met.
    pub place: usize,
    /// The side of the surface of a grazing on which the orbit is: 1 where the guard is positive, else −1.
    pub side: f64,
}
