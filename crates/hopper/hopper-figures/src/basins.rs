//! The picture of a raster: axes, legend, and the frame of an inset.

use crate::error::Error;
use crate::fate_colors;
use basin_of_attraction::{Label, LabelImage};
use hopper_basin::HopperFate;
use journal_figures::{Anchor, Frame, Pen, Svg, indexed_png, ticks};

/// (M, α) ranges of the figure that enlarges a part, and its number.
pub type Inset = ((f64, f64), (f64, f64), &'static str);

/// A window of (M, α), with the name and the layout of its figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasinWindow {
    /// The name of the figure in error messages, and of its file.
    pub name: &'static str,
    /// Mass ratios from and to.
    pub mass_ratio: (f64, f64),
    /// Lift-off speeds from and to, in m₂gω/k.
    pub alpha: (f64, f64),
    /// A part that is framed.
    pub inset: Option<Inset>,
    /// About how many ticks each axis has.
    pub tick_counts: (usize, usize),
}

/// Pixels across and up: 2.4 for each point of the frame, about what a print resolves.
pub const PIXELS: usize = 1200;

/// The drawing of an image with axes and legend.
///
/// # Errors
/// As [`label_png`].
pub fn draw_basins(window: &BasinWindow, image: &LabelImage) -> Result<Svg, Error> {
    let pixels = label_png(window.name, image)?;
    Ok(draw_pixels(window, &pixels, image.counts().into_iter().map(|(label, _)| label)))
}

/// The drawing of the pixels of a window, a PNG, with axes and a legend.
pub fn draw_pixels(
    window: &BasinWindow,
    pixels: &[u8],
    labels: impl Iterator<Item = Label>,
) -> Svg {
    let (x, y) = (window.mass_ratio, window.alpha);
    let mut svg = Svg::new(580.0, 560.0);
    let frame = Frame::linear(66.0, 44.0, 490.0, 460.0, x, y);
    svg.image(frame.left, frame.top, frame.width, frame.height, pixels);
    frame.axes(
        &mut svg,
        &ticks(x, window.tick_counts.0),
        &ticks(y, window.tick_counts.1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "lift-off speed $α$ (dimensionless)",
    );
    if let Some((m, alpha, name)) = window.inset {
        let (x0, y1) = frame.at((m.0, alpha.0));
        let (x1, y0) = frame.at((m.1, alpha.1));
        svg.rect(x0, y0, x1 - x0, y1 - y0, Pen::solid("#ffffff", 3.0));
        svg.rect(x0, y0, x1 - x0, y1 - y0, Pen::solid("#000000", 1.4));
        svg.fill_rect(x1 + 3.0, y1 - 16.0, 37.0, 15.0, "#ffffff");
        svg.text(x1 + 5.0, y1 - 5.0, Anchor::Start, 11.5, name);
    }
    legend(&mut svg, frame.left, labels);
    svg
}

/// The right end of a legend, and the width of its last entry.
const LEGEND_END: f64 = 576.0;
const LAST_ENTRY: f64 = 74.0;

/// The legend, with one entry for each colour: fixed points beyond the last colour share it. Many entries move
/// together. Returns where the next entry begins.
pub fn legend(svg: &mut Svg, left: f64, labels: impl Iterator<Item = Label>) -> f64 {
    let mut entries: Vec<Label> = labels.collect();
    entries.dedup_by_key(|label| fate_colors::css(*label));
    let step = |label: &Label| if HopperFate::is_incessant(*label) { 58.0 } else { 84.0 };
    let before_last = &entries[..entries.len().saturating_sub(1)];
    let width = before_last.iter().map(step).sum::<f64>() + LAST_ENTRY;
    let narrower = ((LEGEND_END - left) / width).min(1.0);
    let mut x = left;
    for label in &entries {
        svg.fill_rect(x, 18.0, 12.0, 12.0, fate_colors::css(*label));
        svg.rect(x, 18.0, 12.0, 12.0, Pen::solid("#000", 0.6));
        svg.text(x + 17.0, 28.5, Anchor::Start, 11.5, &fate_colors::name(*label));
        x += narrower * step(label);
    }
    x
}

/// A PNG with one byte a pixel, the highest row first; its palette is in the order of the labels that occur.
///
/// # Errors
/// [`Error::Figure`] for an image without pixels.
pub fn label_png(name: &str, image: &LabelImage) -> Result<Vec<u8>, Error> {
    let mut colors: Vec<[u8; 3]> = Vec::new();
    let mut places = std::collections::BTreeMap::new();
    for (label, _) in image.counts() {
        let color = fate_colors::rgb(label);
        let known = colors.iter().position(|other| *other == color);
        places.insert(label, known.unwrap_or(colors.len()) as u8);
        if known.is_none() {
            colors.push(color);
        }
    }
    let rows = image.labels.chunks(image.grid.columns).rev();
    let pixels: Vec<u8> =
        rows.flatten().map(|label| places.get(label).copied().unwrap_or(0)).collect();
    Ok(indexed_png(name, image.grid.columns, image.grid.rows, &colors, &pixels)?)
}
