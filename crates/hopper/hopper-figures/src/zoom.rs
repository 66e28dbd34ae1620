//! The frames of a zoom into the edge of a basin.

use crate::basins::legend;
use crate::error::Error;
use crate::fate_colors::mixed;
use crate::shares::share_pixels;
use basin_of_attraction::Label;
use hopper_basin::{EdgeChart, FollowedEdge, LocalFractions, ShareRaster, frame_slant};
use journal_figures::{Anchor, Frame, Svg, rgb_png, ticks};

/// A frame of a zoom in colours: red, green and blue of every pixel, the highest row first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ZoomPixels {
    /// The labels that occur, in increasing order.
    pub labels: Vec<Label>,
    /// One column, at the mass ratio of the middle.
    pub strip: Vec<u8>,
    /// The window of mass ratio and speed.
    pub window: Vec<u8>,
}

impl ZoomPixels {
    /// The colours of a frame: of its middle column, from the lowest row up, and of its window.
    pub fn new(strip: &[LocalFractions], window: &ShareRaster) -> Self {
        let mut labels: Vec<Label> = strip.iter().flat_map(LocalFractions::labels).collect();
        labels.extend(window.labels());
        labels.sort_unstable();
        labels.dedup();
        let mix = |pixel: &LocalFractions| mixed(pixel.labels().map(|l| (l, pixel.of(l).lower)));
        let strip = strip.iter().rev().flat_map(mix).collect();
        ZoomPixels { labels, strip, window: share_pixels(window) }
    }
}

/// One frame of half height 10^−`depth`, with `columns` and `rows` of pixels, and the scale written in.
///
/// # Errors
/// [`Error::Figure`] unless the window has as many pixels.
pub fn draw_zoom_frame(
    chart: &EdgeChart,
    edge: &FollowedEdge,
    depth: f64,
    (columns, rows): (usize, usize),
    drawn: &ZoomPixels,
) -> Result<Svg, Error> {
    let mut svg = Svg::new(440.0, 500.0);
    let frame = Frame::linear(70.0, 64.0, 350.0, 380.0, (-1.0, 1.0), (-1.0, 1.0));
    let image = rgb_png("zoom", columns, rows, &drawn.window)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    let (m, slant) = (chart.mass_ratio().value(), frame_slant(edge));
    let x_label = format!("mass ratio $M$ − {m},   $w$ = {slant:.3} $h$");
    frame.axes(&mut svg, &half_heights("$w$"), &half_heights("$h$"), &x_label, "speed $α$ − $p$");
    legend(&mut svg, frame.left, drawn.labels.iter().copied());
    let scale = format!("$h$ = 10^{{{}}}", exponent(depth));
    svg.text(frame.left, 54.0, Anchor::Start, 16.0, &scale);
    let point = format!("$p$ ≈ {:?}", chart.point().0);
    svg.text(frame.left + frame.width, 54.0, Anchor::End, 11.5, &point);
    Ok(svg)
}

/// The strips of all frames side by side, from half height 1 on, with `step` decades between two of them, and
/// `rows` of pixels.
///
/// # Errors
/// [`Error::Figure`] without frames, or unless each strip has as many pixels.
pub fn draw_zoom(
    chart: &EdgeChart,
    step: f64,
    rows: usize,
    all: &[ZoomPixels],
) -> Result<Svg, Error> {
    let mut svg = Svg::new(860.0, 480.0);
    let last = step * all.len() as f64;
    let x = (-0.5 * step, last - 0.5 * step);
    let frame = Frame::linear(70.0, 54.0, 760.0, 370.0, x, (-1.0, 1.0));
    let row = |row: usize| {
        all.iter().flat_map(move |drawn| drawn.strip.get(3 * row..3 * row + 3).unwrap_or_default())
    };
    let pixels: Vec<u8> = (0..rows).flat_map(row).copied().collect();
    let image = rgb_png("zoom", all.len(), rows, &pixels)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    let label = |(depth, _): (f64, String)| (depth, format!("10^{{{}}}", exponent(depth)));
    let scales: Vec<(f64, String)> = ticks((0.0, last - step), 8).into_iter().map(label).collect();
    frame.axes(&mut svg, &scales, &half_heights("$h$"), "half height $h$", "speed $α$ − $p$");
    let mut labels: Vec<Label> = all.iter().flat_map(|drawn| drawn.labels.clone()).collect();
    labels.sort_unstable();
    labels.dedup();
    legend(&mut svg, frame.left, labels.into_iter());
    let point = format!("$M$ = {}, $p$ ≈ {:?}", chart.mass_ratio().value(), chart.point().0);
    svg.text(frame.left + frame.width, 28.5, Anchor::End, 11.5, &point);
    Ok(svg)
}

/// The middle and both ends of an axis.
fn half_heights(half: &str) -> Vec<(f64, String)> {
    vec![(-1.0, format!("−{half}")), (0.0, "0".into()), (1.0, half.into())]
}

/// −`depth` as text.
fn exponent(depth: f64) -> String {
    if depth == 0.0 { "0".into() } else { format!("−{depth}") }
}
