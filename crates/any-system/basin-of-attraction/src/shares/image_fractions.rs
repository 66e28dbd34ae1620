//! The fractions of the basins in a label image, by two models of what lies between the middles of the pixels.

use crate::error::Error;
use crate::space::label::Label;
use crate::space::raster::LabelImage;
use crate::statistics::bounds::Bounds;
use crate::statistics::confidence_interval::{ConfidenceInterval, open_proportion};
use std::collections::BTreeMap;

impl LabelImage {
    /// The fraction of each basin, with a 95 % interval, as if the middles of the pixels were independent random
    /// points.
    ///
    /// The fractions are of the pixels inside the region of interest. An undecided pixel may belong to any basin:
    /// the interval begins at the lower end of [`proportion_interval`](crate::proportion_interval) without the undecided pixels, and ends at
    /// the upper end with all of them. Pixels on a grid have smaller errors than random points where the basins are
    /// wider than pixels; the interval is then wider than it need be. A basin that repeats with the period of the
    /// grid breaks the model.
    ///
    /// # Errors
    /// [`Error::BadImage`] as for [`check`](Self::check); [`Error::NothingInside`] if all pixels are outside the
    /// region of interest.
    pub fn fractions_as_random_points(&self) -> Result<BTreeMap<Label, ConfidenceInterval>, Error> {
        let (counts, all, undecided) = self.inside()?;
        let fraction =
            |(label, found): (Label, usize)| Ok((label, open_proportion(found, undecided, all)?));
        counts.into_iter().map(fraction).collect()
    }

    /// Bounds on the fraction of each basin, which hold if a square between the middles of four neighbouring pixels
    /// belongs to one basin whenever these four do.
    ///
    /// So the bounds are certain but for parts of basins that are thinner than a pixel. A square whose corners
    /// differ, or are undecided, may belong to any basin, and so may the half pixels at the border of the image.
    /// The fractions are of the area whose pixels are inside the region of interest; beside its border all is open.
    /// An image of one row or column has pairs of neighbours in place of squares.
    ///
    /// ```
    /// use basin_of_attraction::{Grid, Interval, Label, raster};
    /// use std::ops::ControlFlow::Continue;
    /// let unit = Interval::new(-1.0, 1.0)?;
    /// let grid = Grid { x: unit, y: unit, columns: 400, rows: 400 };
    /// let disc = raster(grid, |x| x, |&x, y| Label::from(x * x + y * y < 0.5), |_| Continue(()))?;
    /// let area = disc.fractions_between_pixels()?[&Label::from(1)];
    /// assert!(area.covers(std::f64::consts::PI / 8.0) && area.half_width() < 0.01);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`fractions_as_random_points`](Self::fractions_as_random_points).
    pub fn fractions_between_pixels(&self) -> Result<BTreeMap<Label, Bounds>, Error> {
        let (counts, all, _) = self.inside()?;
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        // On an axis of one pixel there is no neighbour, and the square is a pair.
        let (right, up) = (usize::from(columns > 1), usize::from(rows > 1));
        let mut certain: BTreeMap<Label, usize> = BTreeMap::new();
        for row in 0..rows - up {
            for column in 0..columns - right {
                let at = row * columns + column;
                let label = self.labels[at];
                let others = [at + right, at + up * columns, at + right + up * columns];
                if label.is_decided() && others.into_iter().all(|at| self.labels[at] == label) {
                    *certain.entry(label).or_insert(0) += 1;
                }
            }
        }
        // A single pixel has no neighbours at all: nothing is certain.
        if columns * rows == 1 {
            certain.clear();
        }
        let open = all.saturating_sub(certain.values().sum());
        let fraction = |label: Label| {
            let own = certain.get(&label).copied().unwrap_or(0);
            let part = |squares: usize| (squares as f64 / all as f64).min(1.0);
            (label, Bounds { lower: part(own), upper: part(own + open) })
        };
        Ok(counts.into_keys().map(fraction).collect())
    }

    /// The number of pixels of each basin, of all pixels inside the region of interest, and of the undecided ones.
    fn inside(&self) -> Result<(BTreeMap<Label, usize>, usize, usize), Error> {
        self.check()?;
        let counts = self.counts();
        let sum = |condition: fn(Label) -> bool| {
            let own = counts.iter().filter(|(label, _)| condition(*label));
            own.map(|(_, count)| count).sum::<usize>()
        };
        let all = sum(|label| !label.is_outside());
        if all == 0 {
            return Err(Error::NothingInside { points: self.labels.len() });
        }
        let undecided = sum(Label::is_undecided);
        Ok((counts.into_iter().filter(|(label, _)| label.is_decided()).collect(), all, undecided))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;
    use crate::space::raster::{Grid, raster};
    use std::ops::ControlFlow::Continue;

    fn image(columns: usize, rows: usize, label: impl Fn(f64, f64) -> Label + Sync) -> LabelImage {
        let (x, y) = (Interval { left: 0.0, right: 1.0 }, Interval { left: 0.0, right: 1.0 });
        raster(Grid { x, y, columns, rows }, |x| x, |&x, y| label(x, y), |_| Continue(())).unwrap()
    }

    #[test]
    fn undecided_pixels_widen_the_fractions_of_every_basin_and_are_none_themselves() {
        let label = |x: f64, _| if x < 0.2 { Label::UNDECIDED } else { Label::from(x > 0.5) };
        let image = image(100, 100, label);
        let random = image.fractions_as_random_points().unwrap();
        let between = image.fractions_between_pixels().unwrap();
        assert_eq!(random.keys().collect::<Vec<_>>(), [&Label::from(0), &Label::from(1)]);
        assert_eq!(random.len(), between.len());
        for (label, truth) in [(Label::from(0), 0.3), (Label::from(1), 0.5)] {
            for (lower, upper) in [
                (random[&label].lower, random[&label].upper),
                (between[&label].lower, between[&label].upper),
            ] {
                assert!(lower < truth && truth - 0.03 < lower, "{lower}");
                assert!(upper > truth + 0.2 && upper < truth + 0.24, "{upper}");
            }
        }
    }

    #[test]
    fn fractions_are_of_the_region_of_interest() {
        let image = image(100, 100, |x, _| Label::from(x > 0.5)).masked(|_, y| y < 0.25).unwrap();
        let bounds = image.fractions_between_pixels().unwrap()[&Label::from(1)];
        assert!(bounds.covers(0.5) && bounds.half_width() < 0.05, "{bounds:?}");
        let nothing = image.masked(|_, _| false).unwrap();
        assert_eq!(
            nothing.fractions_as_random_points(),
            Err(Error::NothingInside { points: 10_000 })
        );
    }

    /// A disc and a line of intervals, at many sizes of pixels: the bounds contain the true fraction.
    #[test]
    fn bounds_between_pixels_contain_the_fraction_of_wide_basins() {
        for pixels in 20..120 {
            let truth = std::f64::consts::PI * 0.3 * 0.3;
            let disc = image(pixels, pixels + 7, |x, y| {
                Label::from((x - 0.47) * (x - 0.47) + (y - 0.52) * (y - 0.52) < 0.09)
            });
            let bounds = disc.fractions_between_pixels().unwrap()[&Label::from(1)];
            assert!(bounds.covers(truth), "{pixels} {bounds:?}");
            let line = image(pixels, 1, |x, _| Label::from(x > 0.37));
            let bounds = line.fractions_between_pixels().unwrap()[&Label::from(1)];
            assert!(bounds.covers(0.63) && bounds.half_width() < 1.1 / pixels as f64, "{bounds:?}");
        }
        let bounds = image(1, 1, |_, _| Label::from(0)).fractions_between_pixels().unwrap();
        assert_eq!(bounds[&Label::from(0)], Bounds { lower: 0.0, upper: 1.0 });
    }
}
