//! From a drawing to files: SVG and PNG.

use crate::document::document;
use crate::error::Error;
use crate::raster::rasterize;
use crate::svg::Svg;

/// Points to a CSS pixel, the unit in which browsers measure: 1/72 and 1/96 of an inch.
const POINTS_PER_PIXEL: f64 = 0.75;

/// A drawing in both forms.
#[derive(Debug, Clone)]
pub struct Rendered {
    /// The SVG. Its labels are outlines, so that it looks the same on every computer.
    pub svg: String,
    /// The PNG.
    pub png: Vec<u8>,
}

/// Renders a drawing; the PNG has `scale` pixels for each CSS pixel of the SVG.
///
/// The error has the first label that cannot be set, for example one with a character that the font lacks.
pub fn render(name: &str, svg: &Svg, scale: f64) -> Result<Rendered, Error> {
    let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
    if let Some((label, error)) = &svg.failure {
        return Err(fail(format!("label '{label}': {error}")));
    }
    let pixmap = rasterize(svg, scale / POINTS_PER_PIXEL).map_err(fail)?;
    let png = pixmap.encode_png().map_err(|e| fail(e.to_string()))?;
    Ok(Rendered { svg: document(svg), png })
}

/// A PNG with a palette: one byte a pixel, rows from above.
pub fn indexed_png(
    name: &str,
    width: usize,
    height: usize,
    palette: &[[u8; 3]],
    pixels: &[u8],
) -> Result<Vec<u8>, Error> {
    encoded(name, width, height, pixels, |encoder| {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette.concat());
    })
}

/// A PNG with the bytes red, green and blue of every pixel, rows from above.
pub fn rgb_png(name: &str, width: usize, height: usize, pixels: &[u8]) -> Result<Vec<u8>, Error> {
    encoded(name, width, height, pixels, |encoder| encoder.set_color(png::ColorType::Rgb))
}

fn encoded<'a>(
    name: &str,
    width: usize,
    height: usize,
    pixels: &[u8],
    set_colors: impl FnOnce(&mut png::Encoder<'a, &mut Vec<u8>>),
) -> Result<Vec<u8>, Error> {
    let fail =
        |e: png::EncodingError| Error::Render { what: name.to_owned(), reason: e.to_string() };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    set_colors(&mut encoder);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(fail)?;
    writer.write_image_data(pixels).map_err(fail)?;
    writer.finish().map_err(fail)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::{Anchor, Pen};

    /// Pixels at 1 pixel a point.
    fn pixel(svg: &Svg, x: u32, y: u32) -> [u8; 3] {
        let color = rasterize(svg, 1.0).unwrap().pixel(x, y).unwrap();
        [color.red(), color.green(), color.blue()]
    }

    #[test]
    fn labels_are_outlines_with_their_text_beside_them() {
        let mut svg = Svg::new(100.0, 50.0);
        svg.text(50.0, 25.0, Anchor::Middle, 12.0, "$α$_{n} < 5");
        svg.rotated_text(10.0, 25.0, -90.0, Anchor::Middle, 12.0, "speed");
        let rendered = render("labels", &svg, 2.0).unwrap();
        assert!(!rendered.svg.contains("<text") && !rendered.svg.contains("font"));
        assert!(rendered.svg.contains("aria-label=\"α_{n} &lt; 5\""), "{}", rendered.svg);
        assert!(rendered.svg.contains("aria-label=\"speed\""));
    }

    #[test]
    fn a_label_without_glyphs_is_an_error_that_names_label_and_character() {
        let mut svg = Svg::new(100.0, 50.0);
        svg.clipped(0.0, 0.0, 100.0, 50.0, |svg| {
            svg.text(0.0, 0.0, Anchor::Start, 12.0, "speed 漢");
        });
        let error = render("figure", &svg, 2.0).unwrap_err().to_string();
        assert_eq!(
            error,
            "cannot render figure: label 'speed 漢': the font has no glyph for '漢' (U+6F22)"
        );
    }

    #[test]
    fn a_point_that_is_not_finite_is_an_error() {
        let mut svg = Svg::new(100.0, 50.0);
        svg.line((0.0, 0.0), (f64::NAN, 1.0), Pen::solid("#000", 1.0));
        assert!(render("figure", &svg, 2.0).is_err());
    }

    #[test]
    fn clipped_drawings_end_at_the_rectangle() {
        let mut svg = Svg::new(20.0, 20.0);
        svg.clipped(0.0, 0.0, 10.0, 20.0, |svg| {
            svg.clipped(0.0, 0.0, 20.0, 10.0, |svg| svg.fill_rect(0.0, 0.0, 20.0, 20.0, "#f00"));
        });
        assert_eq!(pixel(&svg, 5, 5), [255, 0, 0]);
        assert_eq!([pixel(&svg, 15, 5), pixel(&svg, 5, 15), pixel(&svg, 15, 15)], [[255; 3]; 3]);
    }

    #[test]
    fn pixels_of_images_stay_squares() {
        let palette = [[255, 0, 0], [0, 0, 255]];
        let png = indexed_png("image", 2, 1, &palette, &[0, 1]).unwrap();
        let mut svg = Svg::new(20.0, 20.0);
        svg.image(0.0, 0.0, 20.0, 10.0, &png);
        assert_eq!([pixel(&svg, 9, 5), pixel(&svg, 10, 5)], palette);
        assert_eq!(pixel(&svg, 5, 15), [255; 3]);
    }

    #[test]
    fn an_image_with_three_bytes_a_pixel_has_its_colours() {
        let png = rgb_png("image", 2, 1, &[1, 2, 3, 250, 128, 0]).unwrap();
        let mut svg = Svg::new(20.0, 10.0);
        svg.image(0.0, 0.0, 20.0, 10.0, &png);
        assert_eq!([pixel(&svg, 5, 5), pixel(&svg, 15, 5)], [[1, 2, 3], [250, 128, 0]]);
        assert!(rgb_png("image", 2, 1, &[1, 2, 3]).is_err());
    }

    #[test]
    fn a_label_turned_to_the_left_reads_upwards() {
        let mut svg = Svg::new(100.0, 100.0);
        // The minus is 0.557 em wide and lies a quarter em above its line.
        svg.rotated_text(50.0, 100.0, -90.0, Anchor::Start, 100.0, "−");
        assert_eq!(pixel(&svg, 25, 65), [0; 3]);
        assert_eq!(pixel(&svg, 75, 65), [255; 3]);
    }
}
