//! Keys: a sample of a line or a symbol, with its name beside it.

use crate::marker::Marker;
use crate::svg::{Anchor, Pen, Svg};

/// Size of a name, in points.
const NAME_SIZE: f64 = 11.5;
/// Half the length of a line's sample, in points.
const HALF_SAMPLE: f64 = 14.0;
/// Width of a symbol, in points.
const SYMBOL_SIZE: f64 = 6.5;
/// From a sample to its name, and from the middle of small letters to their base line, in points.
const GAP: f64 = 7.0;
const BASE: f64 = 4.0;

impl Svg {
    /// A sample of a line with its middle at a point, and its name to the right.
    pub fn line_key(&mut self, (x, y): (f64, f64), pen: Pen, name: &str) {
        self.line((x - HALF_SAMPLE, y), (x + HALF_SAMPLE, y), pen);
        self.text(x + HALF_SAMPLE + GAP, y + BASE, Anchor::Start, NAME_SIZE, name);
    }

    /// A symbol at a point, and its name to the right.
    pub fn marker_key(&mut self, at: (f64, f64), marker: Marker, color: &'static str, name: &str) {
        self.marker(at, marker, SYMBOL_SIZE, color);
        let x = at.0 + 0.5 * SYMBOL_SIZE + GAP;
        self.text(x, at.1 + BASE, Anchor::Start, NAME_SIZE, name);
    }
}
