//! The picture of a layer, with its legend.

use crate::basins::{BasinWindow, draw_basins, draw_pixels};
use crate::error::Error;
use crate::layers::{FLAG, Layer, Meaning, Values, WITHOUT_FLAG, label_of};
use crate::scales::{Scale, draw_numbers};
use basin_of_attraction::{Grid, Label, LabelImage};
use journal_figures::{Anchor, Pen, Svg, rgb_png};

/// The drawing of the pixels of a layer, row after row, the lowest first.
///
/// # Errors
/// [`Error::Figure`] if the pixels are not those of the grid, or there are none.
pub fn draw_layer(
    (layer, values): (&Layer, &Values),
    window: &BasinWindow,
    grid: &Grid,
    pixels: &[u64],
) -> Result<Svg, Error> {
    match values.meaning {
        Meaning::Numbers { .. } => {
            // One picture alone has a scale of its own.
            let largest = pixels.iter().copied().max().unwrap_or(0);
            let numbers: Vec<f64> = pixels.iter().map(|&value| values.number(value)).collect();
            draw_numbers(window, grid, &numbers, (Scale::Counts { largest }, layer.legend))
        }
        Meaning::Reals(scale) => {
            let numbers: Vec<f64> = pixels.iter().map(|&value| values.number(value)).collect();
            draw_numbers(window, grid, &numbers, (scale, layer.legend))
        }
        Meaning::Fates { flag: None } => {
            let labels = pixels.iter().map(|&value| label_of(value)).collect();
            draw_basins(window, &LabelImage { grid: *grid, labels })
        }
        Meaning::Fates { flag: Some(_) } => {
            let rows = pixels.chunks(grid.columns.max(1)).rev();
            let colors: Vec<u8> = rows.flatten().flat_map(|&value| values.color(value)).collect();
            let image = rgb_png(window.name, grid.columns, grid.rows, &colors)?;
            let with_flag = pixels.iter().filter(|&&value| value & FLAG != 0);
            let mut labels: Vec<Label> = with_flag.map(|&value| label_of(value)).collect();
            labels.sort_unstable();
            labels.dedup();
            let mut svg = draw_pixels(window, &image, labels.into_iter());
            // Below the picture, where no label of an axis is.
            svg.fill_rect(8.0, 540.0, 12.0, 12.0, WITHOUT_FLAG.css);
            svg.rect(8.0, 540.0, 12.0, 12.0, Pen::solid("#000", 0.6));
            svg.text(25.0, 550.5, Anchor::Start, 11.5, layer.legend);
            Ok(svg)
        }
    }
}
