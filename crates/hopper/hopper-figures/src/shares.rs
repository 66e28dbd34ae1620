//! The drawing of a raster of shares.

use crate::basins::legend;
use crate::error::Error;
use crate::fate_colors::mixed;
use hopper_basin::{HopperFate, ShareRaster, Upwards};
use journal_figures::palette::Color;
use journal_figures::{Anchor, Frame, Pen, Svg, rgb_png, ticks};

/// The drawing of a raster left of α*_n, or about a preimage of it, with axes and legend. Every pixel has the
/// colours of its fates, mixed by their shares.
///
/// # Errors
/// As [`share_png`].
pub fn draw_shares(n: u64, raster: &ShareRaster) -> Result<Svg, Error> {
    let grid = raster.grid();
    let mut svg = Svg::new(600.0, 560.0);
    let x = (grid.x.left, grid.x.right);
    let depths = (grid.y.left, grid.y.right);
    let star = format!("$α$^{{∗}}_{{{n}}}");
    let (y, y_ticks, y_label) = match raster.upwards() {
        Upwards::Depth => (depths, depth_ticks(depths), format!("distance below {star}")),
        Upwards::Phase => (depths, ticks(depths, 8), format!("phase $Ψ$ left of {star} (turns)")),
        // One unit of height for each side.
        Upwards::BothSides => {
            let label = format!("speed $α$ − $p$, with $p$ a preimage of {star}");
            ((-1.0, 1.0), ticks_of_both_sides(depths), label)
        }
        Upwards::LiftOffSpeed => (depths, ticks(depths, 8), "lift-off speed $α$".into()),
        Upwards::Speed => (depths, ticks(depths, 4), "speed $α$ − $p$ in half heights".into()),
    };
    let frame = Frame::linear(86.0, 44.0, 490.0, 460.0, x, y);
    let pixels = share_png(raster)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &pixels);
    let x_label = "mass ratio $M$ = $m$_{2}/$m$_{1}";
    frame.axes(&mut svg, &ticks(x, 6), &y_ticks, x_label, &y_label);
    let undecided = 1.0 - raster.means().iter().map(|(_, mean)| mean).sum::<f64>();
    // Less than a hundredth of a pixel's light is not seen.
    let yellow = (undecided > 1e-4).then_some(HopperFate::UNDECIDED);
    let end = legend(&mut svg, frame.left, raster.labels().iter().copied().chain(yellow));
    if (0..grid.columns).any(|column| raster.is_blank(column)) {
        svg.fill_rect(end, 18.0, 12.0, 12.0, BLANK.css);
        svg.rect(end, 18.0, 12.0, 12.0, Pen::solid("#000", 0.6));
        svg.text(end + 17.0, 28.5, Anchor::Start, 11.5, "no preimage");
    }
    let note = "colours mixed by shares";
    svg.text(frame.left + frame.width, 28.5, Anchor::End, 11.5, note);
    Ok(svg)
}

/// Columns without an edge: a light violet, which is no mixture of the colours of fates.
const BLANK: Color = Color { css: "#dcd6ee", rgb: [0xdc, 0xd6, 0xee] };

/// The edge, and powers of ten on both sides of it.
fn ticks_of_both_sides(depths: (f64, f64)) -> Vec<(f64, String)> {
    let place = |depth: f64| (depths.1 - depth) / (depths.1 - depths.0);
    let mut all = vec![(0.0, "$p$".to_owned())];
    for (depth, label) in depth_ticks(depths) {
        // Next to the edge there is room for one label only.
        if place(depth) > 0.05 {
            all.push((place(depth), label.clone()));
            all.push((-place(depth), format!("−{label}")));
        }
    }
    all
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

/// The pixels as a PNG.
///
/// # Errors
/// [`Error::Figure`] for a raster without pixels.
pub fn share_png(raster: &ShareRaster) -> Result<Vec<u8>, Error> {
    let grid = raster.grid();
    Ok(rgb_png("shares", grid.columns, grid.rows, &share_pixels(raster))?)
}

/// Red, green and blue of every pixel, the highest row first.
pub fn share_pixels(raster: &ShareRaster) -> Vec<u8> {
    let grid = raster.grid();
    let mut pixels = Vec::with_capacity(3 * grid.columns * grid.rows);
    for row in (0..grid.rows).rev() {
        for column in 0..grid.columns {
            if raster.is_blank(column) {
                pixels.extend(BLANK.rgb);
                continue;
            }
            let shares = raster.at(column, row).unwrap_or_default();
            let by_label = raster.labels().iter().zip(shares);
            pixels.extend(mixed(by_label.map(|(&label, &share)| (label, f64::from(share)))));
        }
    }
    pixels
}

/// The shares of the label at a place as 16-bit integers, 65535 for 1, row by row from the lowest, in bytes from
/// the lowest.
pub fn share_words(raster: &ShareRaster, at: usize) -> Vec<u8> {
    let grid = raster.grid();
    let mut bytes = Vec::with_capacity(2 * grid.rows * grid.columns);
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let share = raster.at(column, row).and_then(|all| all.get(at)).copied().unwrap_or(0.0);
            bytes.extend(((65535.0 * share).round() as u16).to_le_bytes());
        }
    }
    bytes
}
