//! A small SVG writer.

use crate::label::tspans;
use std::fmt::Write;

/// A line's look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Colour, as CSS.
    pub color: &'static str,
    /// Width in points.
    pub width: f64,
    /// Dash pattern, or none.
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
    fn attributes(&self) -> String {
        let dash = if self.dash.is_empty() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", self.dash)
        };
        format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\" stroke-linejoin=\"round\"{dash}",
            self.color, self.width
        )
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

/// A drawing, in points, y downwards.
#[derive(Debug, Clone)]
pub struct Svg {
    width: f64,
    height: f64,
    body: String,
    clips: usize,
}

impl Svg {
    /// An empty white drawing.
    pub fn new(width: f64, height: f64) -> Self {
        let body = format!("<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n");
        Svg { width, height, body, clips: 0 }
    }

    /// A path given in SVG's own letters.
    pub fn path(&mut self, d: &str, pen: Pen) {
        if !d.is_empty() {
            let _ = writeln!(self.body, "<path d=\"{d}\" {}/>", pen.attributes());
        }
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), pen: Pen) {
        self.path(&format!("M{:.3} {:.3}L{:.3} {:.3}", from.0, from.1, to.0, to.1), pen);
    }

    /// A line with an arrow head at its end.
    pub fn arrow(&mut self, from: (f64, f64), to: (f64, f64), pen: Pen) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = pxfm::f_hypot(dx, dy).max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        let head = 3.0 + 2.5 * pen.width;
        let base = (to.0 - head * ux, to.1 - head * uy);
        self.line(from, base, pen);
        let side = 0.38 * head;
        let _ = writeln!(
            self.body,
            "<path d=\"M{:.3} {:.3}L{:.3} {:.3}L{:.3} {:.3}Z\" fill=\"{}\"/>",
            to.0,
            to.1,
            base.0 - side * uy,
            base.1 + side * ux,
            base.0 + side * uy,
            base.1 - side * ux,
            pen.color
        );
    }

    /// A rectangle, filled.
    pub fn fill_rect(&mut self, x: f64, y: f64, width: f64, height: f64, color: &str) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\" fill=\"{color}\"/>"
        );
    }

    /// A rectangle's outline.
    pub fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, pen: Pen) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\" {}/>",
            pen.attributes()
        );
    }

    /// A filled disc with a thin white rim.
    pub fn dot(&mut self, x: f64, y: f64, radius: f64, color: &str) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{radius}\" fill=\"{color}\" stroke=\"white\" stroke-width=\"0.6\"/>"
        );
    }

    /// A filled outline with a thin white rim.
    pub fn fill_path(&mut self, d: &str, color: &str) {
        let _ = writeln!(
            self.body,
            "<path d=\"{d}\" fill=\"{color}\" stroke=\"white\" stroke-width=\"0.5\"/>"
        );
    }

    /// A white disc with a rim.
    pub fn ring(&mut self, x: f64, y: f64, radius: f64, pen: Pen) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{radius:.2}\" fill=\"white\" stroke=\"{}\" stroke-width=\"{:.2}\"/>",
            pen.color, pen.width
        );
    }

    /// A label; see [`crate::label`] for its markup.
    pub fn text(&mut self, x: f64, y: f64, anchor: Anchor, size: f64, markup: &str) {
        self.rotated_text(x, y, 0.0, anchor, size, markup);
    }

    /// A label turned by `degrees` about its point.
    pub fn rotated_text(
        &mut self,
        x: f64,
        y: f64,
        degrees: f64,
        anchor: Anchor,
        size: f64,
        markup: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = if degrees == 0.0 {
            String::new()
        } else {
            format!(" transform=\"rotate({degrees} {x:.3} {y:.3})\"")
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.3}\" y=\"{y:.3}\" text-anchor=\"{anchor}\" font-family=\"STIX\"{turn}>{}</text>",
            tspans(markup, size)
        );
    }

    /// A PNG image, its pixels left as squares.
    pub fn image(&mut self, x: f64, y: f64, width: f64, height: f64, png: &[u8]) {
        let _ = writeln!(
            self.body,
            "<image x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:optimizeSpeed\" \
             xlink:href=\"data:image/png;base64,{}\"/>",
            base64(png)
        );
    }

    /// Draws what `draw` draws, cut off outside a rectangle.
    pub fn clipped(
        &mut self,
        x: f64,
        y: f64,
        width: f64,
        height: f64,
        draw: impl FnOnce(&mut Svg),
    ) {
        self.clips += 1;
        let id = format!("clip{}", self.clips);
        let _ = writeln!(
            self.body,
            "<clipPath id=\"{id}\"><rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\"/></clipPath>\n<g clip-path=\"url(#{id})\">"
        );
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// The document.
    pub fn finish(self) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
             width=\"{w}pt\" height=\"{h}pt\" viewBox=\"0 0 {w} {h}\">\n{}</svg>\n",
            self.body,
            w = self.width,
            h = self.height
        )
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
