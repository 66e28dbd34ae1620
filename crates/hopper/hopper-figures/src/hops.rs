//! The picture of a raster of numbers of hops.

use crate::basins::BasinWindow;
use crate::error::Error;
use basin_of_attraction::Grid;
use journal_figures::{Anchor, Frame, Pen, Svg, rgb_png, ticks};

/// The colours of no hops and of the largest number, with those between in equal steps of log(1 + hops): the
/// lightness falls, so that the order is visible in grey print.
const COLORS: [[f64; 3]; 4] =
    [[255.0, 247.0, 188.0], [254.0, 153.0, 41.0], [153.0, 52.0, 142.0], [23.0, 9.0, 58.0]];

/// Steps of the scale above the picture: narrower ones are not told apart.
const STEPS: usize = 64;

/// The drawing of numbers of hops with axes and scale. `hops` has the pixels of `grid` row after row, the lowest first.
///
/// # Errors
/// [`Error::Figure`] if the numbers are not one for each pixel, or there are none.
pub(crate) fn draw_hops(window: &BasinWindow, grid: &Grid, hops: &[u64]) -> Result<Svg, Error> {
    let largest = hops.iter().copied().max().unwrap_or(0);
    let rows = hops.chunks(grid.columns.max(1)).rev();
    let pixels: Vec<u8> = rows.flatten().flat_map(|&count| hop_color(count, largest)).collect();
    let image = rgb_png(window.name, grid.columns, grid.rows, &pixels)?;
    let mut svg = Svg::new(580.0, 560.0);
    let frame = Frame::linear(66.0, 44.0, 490.0, 460.0, window.mass_ratio, window.alpha);
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    frame.axes(
        &mut svg,
        &ticks(window.mass_ratio, window.tick_counts.0),
        &ticks(window.alpha, window.tick_counts.1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "lift-off speed $α$ (dimensionless)",
    );
    scale(&mut svg, (frame.left + 190.0, 12.0), 300.0, largest)?;
    svg.text(frame.left, 22.0, Anchor::Start, 11.5, "hops until the fate is known");
    Ok(svg)
}

/// The scale: colours, with the powers of ten below them.
fn scale(svg: &mut Svg, (left, top): (f64, f64), width: f64, largest: u64) -> Result<(), Error> {
    const HEIGHT: f64 = 10.0;
    let steps = (0..STEPS).flat_map(|at| color((at as f64 + 0.5) / STEPS as f64));
    let image = rgb_png("scale", STEPS, 1, &steps.collect::<Vec<_>>())?;
    svg.image(left, top, width, HEIGHT, &image);
    svg.rect(left, top, width, HEIGHT, Pen::solid("#000", 0.6));
    // 0, and the powers of ten up to the largest number: at most 20 digits.
    let powers = (0..=19).map(|exponent| 10u64.pow(exponent));
    let mut last = f64::NEG_INFINITY;
    for count in [0].into_iter().chain(powers).take_while(|&count| count <= largest) {
        let x = left + width * place(count, largest);
        // A label takes some room.
        if x - last > 24.0 {
            svg.text(x, top + 22.0, Anchor::Middle, 10.0, &count.to_string());
            last = x;
        }
    }
    Ok(())
}

/// The colour of a number of hops, on the scale from no hops to `largest`.
pub(crate) fn hop_color(count: u64, largest: u64) -> [u8; 3] {
    color(place(count, largest))
}

/// The place of a number on the scale, from 0 to 1.
fn place(count: u64, largest: u64) -> f64 {
    let size = |count: u64| pxfm::f_log(1.0 + count as f64);
    if largest == 0 { 0.0 } else { size(count) / size(largest) }
}

/// The colour of a place on the scale.
fn color(place: f64) -> [u8; 3] {
    let at = place.clamp(0.0, 1.0) * (COLORS.len() - 1) as f64;
    let below = (at as usize).min(COLORS.len() - 2);
    let part = at - below as f64;
    let (low, high) = (COLORS[below], COLORS[below + 1]);
    [0, 1, 2].map(|k| (low[k] + part * (high[k] - low[k])).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::Interval;

    #[test]
    fn the_scale_goes_from_light_to_dark() {
        assert_eq!(hop_color(0, 1000), [255, 247, 188]);
        assert_eq!(hop_color(1000, 1000), [23, 9, 58]);
    }

    #[test]
    fn more_hops_are_darker() {
        let light = |count: u64| {
            color(place(count, 1_000_000)).iter().map(|&byte| u32::from(byte)).sum::<u32>()
        };
        assert_eq!(color(place(0, 1_000_000)), [255, 247, 188]);
        assert_eq!(color(place(1_000_000, 1_000_000)), [23, 9, 58]);
        let counts = [0, 1, 10, 100, 1000, 10_000, 100_000, 1_000_000];
        assert!(counts.map(light).is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn rasters_with_one_number_or_the_largest_are_drawn_and_others_are_errors() {
        let x = Interval::new(0.1, 1.0).unwrap_or_else(|error| panic!("{error}"));
        let grid = Grid { x, y: x, columns: 2, rows: 2 };
        let range = (x.left, x.right);
        let window = BasinWindow {
            name: "hops",
            mass_ratio: range,
            alpha: range,
            inset: None,
            tick_counts: (4, 4),
        };
        for hops in [[0; 4], [7; 4], [0, 1, 2, u64::MAX]] {
            assert!(draw_hops(&window, &grid, &hops).is_ok());
        }
        assert!(draw_hops(&window, &grid, &[1, 2]).is_err());
        assert!(draw_hops(&window, &grid, &[]).is_err());
    }
}
