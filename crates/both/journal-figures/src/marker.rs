//! Symbols for points, which differ by shape as well as by colour.

use crate::path::Path;
use crate::svg::{Pen, Svg};

/// A symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A triangle on its side.
    Triangle,
    /// A triangle on its tip.
    Wedge,
    /// A square on its corner.
    Diamond,
    /// Two strokes.
    Cross,
    /// A circle, not filled.
    Ring,
    /// A square, not filled.
    OpenSquare,
}

impl Svg {
    /// A symbol about `size` wide.
    pub fn marker(&mut self, (x, y): (f64, f64), marker: Marker, size: f64, color: &'static str) {
        // The corners are chosen by eye, so that all symbols look about equally large.
        let r = 0.5 * size;
        let polygon = |corners: &[(f64, f64)]| {
            Path::polygon(corners.iter().map(|&(dx, dy)| (x + dx * r, y + dy * r)))
        };
        match marker {
            Marker::Disc => self.dot(x, y, r, color),
            Marker::Square => {
                self.fill_path(
                    polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
                    color,
                );
            }
            Marker::Triangle => {
                self.fill_path(polygon(&[(-1.1, 0.9), (1.1, 0.9), (0.0, -1.1)]), color)
            }
            Marker::Wedge => {
                self.fill_path(polygon(&[(-1.1, -0.9), (1.1, -0.9), (0.0, 1.1)]), color)
            }
            Marker::Diamond => {
                self.fill_path(polygon(&[(-1.2, 0.0), (0.0, -1.2), (1.2, 0.0), (0.0, 1.2)]), color);
            }
            Marker::Cross => {
                let pen = Pen::solid(color, 1.6);
                self.line((x - r, y - r), (x + r, y + r), pen);
                self.line((x - r, y + r), (x + r, y - r), pen);
            }
            Marker::OpenSquare => {
                let (pen, r) = (Pen::solid(color, 1.1), 0.8 * r);
                for (from, to) in
                    [((-r, -r), (r, -r)), ((r, -r), (r, r)), ((r, r), (-r, r)), ((-r, r), (-r, -r))]
                {
                    self.line((x + from.0, y + from.1), (x + to.0, y + to.1), pen);
                }
            }
            Marker::Ring => self.ring(x, y, 0.85 * r, Pen::solid(color, 1.1)),
        }
    }
}
