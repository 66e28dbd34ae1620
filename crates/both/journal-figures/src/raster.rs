//! A drawing as pixels.

use crate::path::{Path, Segment};
use crate::svg::{Element, Pen, Svg};
use tiny_skia::{
    Color, FillRule, FilterQuality, LineJoin, Mask, Paint, PathBuilder, Pattern, Pixmap, Rect,
    SpreadMode, Stroke, StrokeDash, Transform,
};

/// Draws `svg` at `scale` pixels a point. If this is not possible, the error is the reason.
pub(crate) fn rasterize(svg: &Svg, scale: f64) -> Result<Pixmap, String> {
    let (width, height) = ((svg.width * scale).ceil(), (svg.height * scale).ceil());
    let pixmap = Pixmap::new(width as u32, height as u32)
        .ok_or_else(|| format!("no image of {width} × {height} pixels"))?;
    let transform = Transform::from_scale(scale as f32, scale as f32);
    let mut canvas = Canvas { pixmap, transform };
    canvas.elements(&svg.elements, None)?;
    Ok(canvas.pixmap)
}

struct Canvas {
    pixmap: Pixmap,
    /// From points on the page to pixels.
    transform: Transform,
}

impl Canvas {
    /// Draws elements; `mask` is 0 where they must not show.
    fn elements(&mut self, elements: &[Element], mask: Option<&Mask>) -> Result<(), String> {
        for element in elements {
            match element {
                Element::Shape { path, fill, pen } => {
                    let path = skia_path(path)?;
                    fill.map_or(Ok(()), |color| self.fill(&path, color, mask))?;
                    pen.map_or(Ok(()), |pen| self.stroke(&path, pen, mask))?;
                }
                Element::Label { path, .. } => self.fill(&skia_path(path)?, "#000", mask)?,
                Element::Image { corner, size, png } => self.image(*corner, *size, png, mask)?,
                Element::Clipped { inside, elements } => {
                    let inside = skia_path(inside)?;
                    let mask = self.narrowed(mask, &inside)?;
                    self.elements(elements, Some(&mask))?;
                }
            }
        }
        Ok(())
    }

    fn fill(
        &mut self,
        path: &tiny_skia::Path,
        color: &str,
        mask: Option<&Mask>,
    ) -> Result<(), String> {
        self.pixmap.fill_path(path, &paint(color)?, FillRule::Winding, self.transform, mask);
        Ok(())
    }

    fn stroke(
        &mut self,
        path: &tiny_skia::Path,
        pen: Pen,
        mask: Option<&Mask>,
    ) -> Result<(), String> {
        let stroke = Stroke {
            width: pen.width as f32,
            line_join: LineJoin::Round,
            dash: dash(pen.dash)?,
            ..Stroke::default()
        };
        self.pixmap.stroke_path(path, &paint(pen.color)?, &stroke, self.transform, mask);
        Ok(())
    }

    fn image(
        &mut self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        png: &[u8],
        mask: Option<&Mask>,
    ) -> Result<(), String> {
        let image = Pixmap::decode_png(png).map_err(|e| e.to_string())?;
        let (x, y, width, height) = (x as f32, y as f32, width as f32, height as f32);
        let area = Rect::from_xywh(x, y, width, height)
            .ok_or_else(|| format!("no image of size {width} × {height} at ({x}, {y})"))?;
        let (columns, rows) = (image.width() as f32, image.height() as f32);
        let placed = Transform::from_row(width / columns, 0.0, 0.0, height / rows, x, y);
        // The nearest pixel: pixels are labels, which cannot be averaged.
        let (spread, quality) = (SpreadMode::Pad, FilterQuality::Nearest);
        let shader = Pattern::new(image.as_ref(), spread, quality, 1.0, placed);
        let paint = Paint { shader, ..Paint::default() };
        self.pixmap.fill_rect(area, &paint, self.transform, mask);
        Ok(())
    }

    /// The part of a mask that is inside a path.
    fn narrowed(&self, mask: Option<&Mask>, inside: &tiny_skia::Path) -> Result<Mask, String> {
        if let Some(outer) = mask {
            let mut mask = outer.clone();
            mask.intersect_path(inside, FillRule::Winding, true, self.transform);
            return Ok(mask);
        }
        let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height())
            .ok_or("no mask of the image's size")?;
        mask.fill_path(inside, FillRule::Winding, true, self.transform);
        Ok(mask)
    }
}

fn skia_path(path: &Path) -> Result<tiny_skia::Path, String> {
    let mut builder = PathBuilder::new();
    let pair = |(x, y): (f64, f64)| (x as f32, y as f32);
    for segment in path.segments() {
        match *segment {
            Segment::Move(p) => builder.move_to(pair(p).0, pair(p).1),
            Segment::Line(p) => builder.line_to(pair(p).0, pair(p).1),
            Segment::Cubic(a, b, p) => {
                let (a, b, p) = (pair(a), pair(b), pair(p));
                builder.cubic_to(a.0, a.1, b.0, b.1, p.0, p.1);
            }
            Segment::Close => builder.close(),
        }
    }
    builder
        .finish()
        .ok_or_else(|| format!("a path with a point that is not finite: {}", path.data()))
}

fn paint(css: &str) -> Result<Paint<'static>, String> {
    let [r, g, b] = rgb(css).ok_or_else(|| format!("no colour: {css}"))?;
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(r, g, b, u8::MAX));
    Ok(paint)
}

/// Red, green and blue of `#rgb` or `#rrggbb`.
fn rgb(css: &str) -> Option<[u8; 3]> {
    let digits = css.strip_prefix('#')?;
    // `from_str_radix` would accept a sign.
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let value = u32::from_str_radix(digits, 16).ok()?;
    let byte = |shift: u32| (value >> shift) as u8;
    match digits.len() {
        6 => Some([byte(16), byte(8), byte(0)]),
        // A digit stands for two equal digits: 17 = 0x11.
        3 => Some([8, 4, 0].map(|shift| (byte(shift) & 0xf) * 17)),
        _ => None,
    }
}

/// A dash pattern; `None` for a solid line.
fn dash(pattern: &str) -> Result<Option<StrokeDash>, String> {
    if pattern.is_empty() {
        return Ok(None);
    }
    let refuse = || format!("no dash pattern: {pattern}");
    let lengths: Vec<f32> = pattern
        .split_whitespace()
        .map(|length| length.parse().map_err(|_| refuse()))
        .collect::<Result<_, _>>()?;
    StrokeDash::new(lengths, 0.0).map(Some).ok_or_else(refuse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_as_css_reads_them() {
        assert_eq!(rgb("#22a672"), Some([0x22, 0xa6, 0x72]));
        assert_eq!(rgb("#0af"), Some([0x00, 0xaa, 0xff]));
        assert_eq!([rgb("white"), rgb("#1234"), rgb("#+12345")], [None; 3]);
    }
}
