//! The drawing of a raster of shares.

use super::basin_plot::legend;
use crate::error::Error;
use crate::fate_colors::mixed;
use hopper_basin::{HopperFate, ShareRaster, Upwards};
use journal_figures::{Anchor, Frame, Svg, rgb_png, ticks};

/// The drawing of a raster left of α*_n with axes and legend. Every pixel has the colours of its fates, mixed by their shares.
pub(crate) fn draw_shares(n: u64, raster: &ShareRaster) -> Result<Svg, Error> {
    let grid = raster.grid();
    let mut svg = Svg::new(600.0, 560.0);
    let (x, y) = ((grid.x.left, grid.x.right), (grid.y.left, grid.y.right));
    let frame = Frame::linear(86.0, 44.0, 490.0, 460.0, x, y);
    let pixels = png(raster)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &pixels);
    let (y_ticks, y_label) = match raster.upwards() {
        Upwards::Depth => (depth_ticks(y), format!("distance below $α$^{{∗}}_{{{n}}}")),
        Upwards::Phase => (ticks(y, 8), format!("phase $Ψ$ left of $α$^{{∗}}_{{{n}}} (turns)")),
    };
    let x_label = "mass ratio $M$ = $m$_{2}/$m$_{1}";
    frame.axes(&mut svg, &ticks(x, 6), &y_ticks, x_label, &y_label);
    let undecided = 1.0 - raster.means().iter().map(|(_, mean)| mean).sum::<f64>();
    // Less than a hundredth of a pixel's light is not seen.
    let yellow = (undecided > 1e-4).then_some(HopperFate::UNDECIDED);
    legend(&mut svg, frame.left, raster.labels().iter().copied().chain(yellow));
    let note = "colours mixed by shares";
    svg.text(frame.left + frame.width, 28.5, Anchor::End, 11.5, note);
    Ok(svg)
}

/// Powers of ten at round depths.
fn depth_ticks(depths: (f64, f64)) -> Vec<(f64, String)> {
    let whole = |(depth, _): &(f64, String)| depth.fract() == 0.0;
    let label = |(depth, _): (f64, String)| (depth, format!("10^{{{}}}", minus(-depth)));
    ticks(depths, 8).into_iter().filter(whole).map(label).collect()
}

fn minus(value: f64) -> String {
    format!("{value:.0}").replace('-', "−")
}

/// The pixels, the highest row first.
pub(crate) fn png(raster: &ShareRaster) -> Result<Vec<u8>, Error> {
    let grid = raster.grid();
    let mut pixels = Vec::with_capacity(3 * grid.columns * grid.rows);
    for row in (0..grid.rows).rev() {
        for column in 0..grid.columns {
            let shares = raster.at(column, row).unwrap_or_default();
            let by_label = raster.labels().iter().zip(shares);
            pixels.extend(mixed(by_label.map(|(&label, &share)| (label, f64::from(share)))));
        }
    }
    Ok(rgb_png("shares", grid.columns, grid.rows, &pixels)?)
}
