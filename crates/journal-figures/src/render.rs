//! From a drawing to files: SVG with outlines instead of fonts, and PNG.

use crate::error::Error;
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

/// It has the mathematical italics too.
const FONT: &[u8] = include_bytes!("../assets/STIX-Regular.otf");

/// A drawing in both forms.
#[derive(Debug, Clone)]
pub struct Rendered {
    /// The SVG, its labels turned into outlines: it looks the same wherever it is opened.
    pub svg: String,
    /// The PNG.
    pub png: Vec<u8>,
}

/// Renders `svg` with the font that is shipped, the PNG at `pixels_per_point`.
pub fn render(name: &str, svg: &str, pixels_per_point: f32) -> Result<Rendered, Error> {
    let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
    let options = usvg::Options { fontdb: fonts(), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| fail(e.to_string()))?;
    let outlined =
        tree.to_string(&usvg::WriteOptions { preserve_text: false, ..Default::default() });
    let size = tree.size();
    let (width, height) = (size.width() * pixels_per_point, size.height() * pixels_per_point);
    let mut pixmap = tiny_skia::Pixmap::new(width.ceil() as u32, height.ceil() as u32)
        .ok_or_else(|| fail(format!("no image of {width} × {height} pixels")))?;
    let transform = tiny_skia::Transform::from_scale(pixels_per_point, pixels_per_point);
    resvg::render(&tree, transform, &mut pixmap.as_mut());
    let png = pixmap.encode_png().map_err(|e| fail(e.to_string()))?;
    Ok(Rendered { svg: outlined, png })
}

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(FONT.to_vec());
        fonts.set_serif_family("STIX");
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}

/// A PNG with a palette: one byte a pixel, rows from above.
pub fn indexed_png(
    name: &str,
    width: usize,
    height: usize,
    palette: &[[u8; 3]],
    pixels: &[u8],
) -> Result<Vec<u8>, Error> {
    let fail =
        |e: png::EncodingError| Error::Render { what: name.to_owned(), reason: e.to_string() };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(fail)?;
    writer.write_image_data(pixels).map_err(fail)?;
    writer.finish().map_err(fail)?;
    Ok(bytes)
}
