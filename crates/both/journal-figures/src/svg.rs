//! A drawing: paths, images and labels in the order in which they are drawn.

use crate::font::FontError;
use crate::label::outline;
use crate::path::{Path, Point};

/// The style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Colour, as CSS: `#rgb` or `#rrggbb`.
    pub color: &'static str,
    /// Width in points.
    pub width: f64,
    /// Lengths of dashes and gaps, alternating and separated by spaces; empty for a solid line.
    pub dash: &'static str,
}

impl Pen {
    /// A solid line.
    pub const fn solid(color: &'static str, width: f64) -> Self {
        Pen { color, width, dash: "" }
    }
    /// A dashed line.
    pub const fn dashed(color: &'static str, width: f64, dash: &'static str) -> Self {
        Pen { color, width, dash }
    }
}

/// Which end of a label is at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// An element of a drawing. Later elements cover earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Element {
    /// A path, filled first, then stroked.
    Shape { path: Path, fill: Option<&'static str>, pen: Option<Pen> },
    /// The outlines of a label, and its text for readers that cannot see them.
    Label { path: Path, text: String },
    /// A PNG image stretched to a rectangle.
    Image { corner: Point, size: (f64, f64), png: Vec<u8> },
    /// Elements of which only the parts inside a rectangle are drawn.
    Clipped { inside: Path, elements: Vec<Element> },
}

/// White rim that separates symbols where they touch.
const WHITE_RIM: Pen = Pen::solid("#fff", 0.6);

/// A drawing, in points, y downwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Svg {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) elements: Vec<Element>,
    /// The first label that could not be set, and the reason. The drawing methods have no return value;
    /// [`crate::render::render`] returns this error.
    pub(crate) failure: Option<(String, FontError)>,
}

impl Svg {
    /// An empty white drawing.
    pub fn new(width: f64, height: f64) -> Self {
        let mut svg = Svg { width, height, elements: Vec::new(), failure: None };
        svg.fill_rect(0.0, 0.0, width, height, "#fff");
        svg
    }

    fn shape(&mut self, path: Path, fill: Option<&'static str>, pen: Option<Pen>) {
        // A curve through one point has no extent.
        if path.segments().len() > 1 {
            self.elements.push(Element::Shape { path, fill, pen });
        }
    }

    /// A line along a path.
    pub fn path(&mut self, path: Path, pen: Pen) {
        self.shape(path, None, Some(pen));
    }

    /// A straight line.
    pub fn line(&mut self, from: Point, to: Point, pen: Pen) {
        self.path(Path::polyline([from, to]), pen);
    }

    /// A line with an arrow head at its end.
    pub fn arrow(&mut self, from: Point, to: Point, pen: Pen) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = pxfm::f_hypot(dx, dy).max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        // Length and half width of the head, chosen by eye. Both grow with the pen, so that thick arrows still look
        // like arrows.
        let head = 3.0 + 2.5 * pen.width;
        let base = (to.0 - head * ux, to.1 - head * uy);
        self.line(from, base, pen);
        let side = 0.38 * head;
        let corners = [
            to,
            (base.0 - side * uy, base.1 + side * ux),
            (base.0 + side * uy, base.1 - side * ux),
        ];
        self.shape(Path::polygon(corners), Some(pen.color), None);
    }

    /// A rectangle, filled.
    pub fn fill_rect(&mut self, x: f64, y: f64, width: f64, height: f64, color: &'static str) {
        self.shape(Path::rectangle(x, y, width, height), Some(color), None);
    }

    /// A rectangle's outline.
    pub fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, pen: Pen) {
        self.shape(Path::rectangle(x, y, width, height), None, Some(pen));
    }

    /// A filled disc with a thin white rim.
    pub fn dot(&mut self, x: f64, y: f64, radius: f64, color: &'static str) {
        self.shape(Path::circle((x, y), radius), Some(color), Some(WHITE_RIM));
    }

    /// A filled outline with a thin white rim.
    pub fn fill_path(&mut self, path: Path, color: &'static str) {
        self.shape(path, Some(color), Some(Pen { width: 0.5, ..WHITE_RIM }));
    }

    /// A white disc with a rim.
    pub fn ring(&mut self, x: f64, y: f64, radius: f64, pen: Pen) {
        self.shape(Path::circle((x, y), radius), Some("#fff"), Some(pen));
    }

    /// A label; see [`crate::label`] for its markup.
    pub fn text(&mut self, x: f64, y: f64, anchor: Anchor, size: f64, markup: &str) {
        self.rotated_text(x, y, 0.0, anchor, size, markup);
    }

    /// A label turned by `degrees` about its point, clockwise.
    pub fn rotated_text(
        &mut self,
        x: f64,
        y: f64,
        degrees: f64,
        anchor: Anchor,
        size: f64,
        markup: &str,
    ) {
        let (path, width) = match outline(markup, size) {
            Ok(set) => set,
            Err(error) => {
                self.failure.get_or_insert_with(|| (markup.into(), error));
                return;
            }
        };
        if path.is_empty() {
            return;
        }
        let start = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * width,
            Anchor::End => -width,
        };
        let (sin, cos) = pxfm::f_sincos(degrees.to_radians());
        let path = path.map(|(right, down)| {
            let right = right + start;
            (x + cos * right - sin * down, y + sin * right + cos * down)
        });
        self.elements.push(Element::Label { path, text: markup.replace('$', "") });
    }

    /// A PNG image, its pixels left as squares.
    pub fn image(&mut self, x: f64, y: f64, width: f64, height: f64, png: &[u8]) {
        let png = png.to_vec();
        self.elements.push(Element::Image { corner: (x, y), size: (width, height), png });
    }

    /// Draws the elements that `draw` draws, cut off outside a rectangle.
    pub fn clipped(
        &mut self,
        x: f64,
        y: f64,
        width: f64,
        height: f64,
        draw: impl FnOnce(&mut Svg),
    ) {
        let before = std::mem::take(&mut self.elements);
        draw(self);
        let elements = std::mem::replace(&mut self.elements, before);
        let inside = Path::rectangle(x, y, width, height);
        self.elements.push(Element::Clipped { inside, elements });
    }
}

/// Base64, for images inside a document.
pub fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().fold(0u32, |word, &byte| word << 8 | u32::from(byte))
            << (8 * (3 - chunk.len()));
        for place in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * place)) as usize & 63];
            out.push(if place <= chunk.len() { digit as char } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_as_in_rfc_4648() {
        for (plain, coded) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
