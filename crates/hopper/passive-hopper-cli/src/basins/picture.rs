//! A picture of a raster that may be larger: ⌊k · size / picture size⌋ of its columns and rows.

use basin_of_attraction::Grid;
use hopper_figures::PIXELS;

/// The largest number of pixels of the picture along each axis: as many as the paper's basin figures have, since both
/// are drawn in the same frame. The picture of a larger raster shows some of its columns and rows only; the array has
/// them all.
const LARGEST: usize = PIXELS;

/// The pixels of the picture, collected from tiles that come in order.
pub(crate) struct Picture<T> {
    /// The raster.
    raster: Grid,
    /// The columns of a tile.
    tile: usize,
    /// The grid of the picture.
    pub(crate) grid: Grid,
    /// Row after row, the lowest first.
    pub(crate) pixels: Vec<T>,
    /// The next column of the picture.
    next: usize,
}

impl<T: Copy> Picture<T> {
    /// A picture of `empty` pixels.
    pub(crate) fn new(raster: &Grid, tile: usize, empty: T) -> Self {
        let (columns, rows) = (raster.columns.min(LARGEST), raster.rows.min(LARGEST));
        let grid = Grid { columns, rows, ..*raster };
        Picture { raster: *raster, tile, grid, pixels: vec![empty; columns * rows], next: 0 }
    }

    /// Takes from the next tile the columns that the picture shows. `values` has the tile column by column, from below.
    pub(crate) fn add(&mut self, tile: usize, values: &[T]) {
        let Grid { columns, rows, .. } = self.grid;
        while self.next < columns {
            let from = self.next * self.raster.columns / columns;
            if from >= (tile + 1) * self.tile {
                return; // it is in a later tile
            }
            let base = (from - tile * self.tile) * self.raster.rows;
            for row in 0..rows {
                let at = base + row * self.raster.rows / rows;
                if let Some(&value) = values.get(at) {
                    self.pixels[row * columns + self.next] = value;
                }
            }
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::Interval;

    /// A picture of a larger raster shows its pixels at equal distances, whatever tile they are in.
    #[test]
    fn the_picture_shows_pixels_of_the_raster() {
        const TILE: usize = 16;
        let x = Interval::new(0.1, 0.9).unwrap();
        for (columns, rows) in [(1, 1), (40, 25), (1200, 3), (1201, 2), (2999, 1300)] {
            let grid = Grid { x, y: x, columns, rows };
            let value = |column: usize, row: usize| (7 * column + 3 * row) as u16;
            let mut picture = Picture::new(&grid, TILE, u16::MAX);
            for tile in 0..columns.div_ceil(TILE) {
                let within = tile * TILE..columns.min((tile + 1) * TILE);
                let values = within.flat_map(|c| (0..rows).map(move |r| value(c, r)));
                picture.add(tile, &values.collect::<Vec<_>>());
            }
            let shown = picture.grid;
            for column in 0..shown.columns {
                for row in 0..shown.rows {
                    let from = (column * columns / shown.columns, row * rows / shown.rows);
                    let found = picture.pixels[row * shown.columns + column];
                    assert_eq!(found, value(from.0, from.1));
                }
            }
        }
    }
}
