//! The shares of the basins in the pixels of a line, from intervals.

use crate::error::Error;
use crate::line::interval_basins::IntervalBasins;
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;

/// The share of every basin in each pixel of a line, with bounds.
///
/// A window of the line is divided into pixels of equal length. The share of a basin in a pixel is the length of
/// the basin there over the length of the pixel. So a basin thinner than a pixel is seen as what it is, and a pixel
/// is no sample of one point.
///
/// A point that lies in none of the given intervals is undecided. The lower bound of a share counts the intervals
/// of the basin; the upper bound adds all that is undecided in the pixel. The bounds hold as the intervals do.
///
/// ```
/// use basin_of_attraction::{Interval, Label, PixelShares};
/// // A needle of a tenth of a pixel, and an undecided part of a tenth.
/// let part = |left, right, label: u8| Ok((Interval::new(left, right)?, Label::from(label)));
/// let parts = [part(0.0, 0.5, 0)?, part(0.5, 0.6, 1)?, part(0.7, 2.0, 0)?];
/// let shares = PixelShares::of_intervals(&parts, Interval::new(0.0, 2.0)?, 2)?;
/// let needle = shares.of(Label::from(1), 0);
/// assert!((needle.lower - 0.1).abs() < 1e-15 && (needle.upper - 0.2).abs() < 1e-15);
/// assert_eq!(shares.of(Label::from(0), 1).lower, 1.0);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PixelShares {
    /// In increasing order.
    labels: Vec<Label>,
    /// Pixel by pixel, one share for every label.
    certain: Vec<f64>,
    /// One for every pixel.
    undecided: Vec<f64>,
}

impl PixelShares {
    /// The shares in `pixels` equal parts of `window`, from disjoint intervals in increasing order. What lies
    /// outside the window does not count; an interval whose label is no basin is undecided.
    ///
    /// # Errors
    /// [`Error::BadPixels`] as for [`edges`](Self::edges); [`Error::UnsortedIntervals`] for intervals that overlap,
    /// or are not in increasing order; [`Error::BadInterval`] for an interval that is reversed or not finite.
    pub fn of_intervals(
        parts: &[(Interval, Label)],
        window: Interval,
        pixels: usize,
    ) -> Result<Self, Error> {
        for (part, _) in parts {
            Interval::new(part.left, part.right)?;
        }
        for pair in parts.windows(2) {
            let (first_right, second_left) = (pair[0].0.right, pair[1].0.left);
            if first_right > second_left {
                return Err(Error::UnsortedIntervals { first_right, second_left });
            }
        }
        let edges = Self::edges(window, pixels)?;
        let mut labels: Vec<Label> =
            parts.iter().map(|&(_, label)| label).filter(|label| label.is_decided()).collect();
        labels.sort_unstable();
        labels.dedup();
        let mut certain = vec![0.0; pixels * labels.len()];
        for (part, label) in parts {
            let Ok(place) = labels.binary_search(label) else { continue };
            // The first pixel that ends above the left end of the part.
            let first = edges[1..].partition_point(|&edge| edge <= part.left);
            for pixel in first..pixels {
                let (low, high) = (edges[pixel], edges[pixel + 1]);
                if low >= part.right {
                    break;
                }
                let length = part.right.min(high) - part.left.max(low);
                certain[pixel * labels.len() + place] += length / (high - low);
            }
        }
        let rest = |pixel: usize| {
            let own = &certain[pixel * labels.len()..(pixel + 1) * labels.len()];
            // All shares together may exceed 1 by rounding.
            (1.0 - own.iter().sum::<f64>()).max(0.0)
        };
        let undecided = (0..pixels).map(rest).collect();
        Ok(PixelShares { labels, certain, undecided })
    }

    /// The ends of the pixels: one number more than pixels, increasing. The first and the last are the ends of the
    /// window.
    ///
    /// # Errors
    /// [`Error::BadPixels`] for no pixels, for more than 2²⁶, and for a window so narrow that two ends are the same
    /// `f64`; [`Error::BadInterval`] for a window that is reversed or not finite.
    pub fn edges(window: Interval, pixels: usize) -> Result<Vec<f64>, Error> {
        let Interval { left, right } = Interval::new(window.left, window.right)?;
        let bad = Error::BadPixels { pixels, left, right };
        if !(1..=MOST_PIXELS).contains(&pixels) {
            return Err(bad);
        }
        let mut edges: Vec<f64> =
            (0..pixels).map(|k| left + window.length() * (k as f64 / pixels as f64)).collect();
        edges.push(right);
        if edges.windows(2).all(|pair| pair[0] < pair[1]) { Ok(edges) } else { Err(bad) }
    }

    /// The labels that occur, in increasing order.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The number of pixels.
    pub fn pixels(&self) -> usize {
        self.undecided.len()
    }

    /// Bounds on the share of a basin in a pixel, counted from the left end of the window. Beyond the last pixel
    /// nothing is known: the bounds are 0 and 1.
    pub fn of(&self, label: Label, pixel: usize) -> Bounds {
        let lower = match (self.certain(pixel), self.labels.binary_search(&label)) {
            (Some(shares), Ok(place)) => shares[place],
            _ => 0.0,
        };
        let undecided = self.undecided.get(pixel).copied().unwrap_or(1.0);
        Bounds { lower, upper: (lower + undecided).min(1.0) }
    }

    /// The lower bounds of a pixel, one for every [label](Self::labels); `None` beyond the last pixel.
    pub fn certain(&self, pixel: usize) -> Option<&[f64]> {
        let count = self.labels.len();
        let inside = pixel < self.pixels();
        inside.then(|| self.certain.get(pixel * count..(pixel + 1) * count))?
    }

    /// The undecided share of a pixel; `None` beyond the last pixel.
    pub fn undecided(&self, pixel: usize) -> Option<f64> {
        self.undecided.get(pixel).copied()
    }

    /// The largest undecided share of a pixel.
    pub fn most_undecided(&self) -> f64 {
        self.undecided.iter().copied().fold(0.0, f64::max)
    }
}

/// The largest number of pixels of a line: half a gigabyte for their ends alone.
const MOST_PIXELS: usize = 1 << 26;

impl IntervalBasins {
    /// The share of every basin in each of `pixels` equal parts of the window: a column of a picture whose pixels
    /// are areas, and no points. The bounds hold as the intervals do.
    ///
    /// ```
    /// use basin_of_attraction::{Interval, Label, Refinement, interval_basins_from_known, monotone_branches};
    /// // The tent map of slope 3 has holes in [0, 1] from which orbits escape.
    /// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    /// let (unit, outside) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 / 3.0, 2.0 / 3.0)?);
    /// let branches = monotone_branches(&tent, unit, 101)?;
    /// let known = [(outside, Label::from(1))];
    /// let limits = Refinement { shortest: 1e-9, ..Refinement::default() };
    /// let escape = interval_basins_from_known(&tent, &known, &branches, unit, limits)?;
    /// // Three pixels are [0, 1/3], the hole, and [2/3, 1]; in the first the holes of later steps have nearly all of the length.
    /// let shares = escape.pixel_shares(3)?;
    /// assert!(shares.of(Label::from(1), 0).lower > 0.99);
    /// assert!(shares.of(Label::from(1), 1).lower > 1.0 - 1e-9);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadPixels`] as for [`PixelShares::edges`].
    pub fn pixel_shares(&self, pixels: usize) -> Result<PixelShares, Error> {
        let parts: Vec<_> =
            self.intervals().iter().map(|part| (part.interval, part.label)).collect();
        PixelShares::of_intervals(&parts, self.window(), pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(left: f64, right: f64, label: u8) -> (Interval, Label) {
        (Interval { left, right }, label.into())
    }

    #[test]
    fn parts_are_cut_at_pixels_and_at_the_window() {
        let parts = [part(-5.0, 0.25, 3), part(0.25, 1.75, 1), part(1.75, 9.0, 3)];
        let shares =
            PixelShares::of_intervals(&parts, Interval { left: 0.0, right: 2.0 }, 4).unwrap();
        assert_eq!(shares.labels(), [Label::from(1), Label::from(3)]);
        let rows: Vec<&[f64]> = (0..4).filter_map(|pixel| shares.certain(pixel)).collect();
        assert_eq!(rows, [[0.5, 0.5], [1.0, 0.0], [1.0, 0.0], [0.5, 0.5]]);
        assert_eq!(shares.most_undecided(), 0.0);
        assert_eq!((shares.certain(4), shares.undecided(4)), (None, None));
        assert_eq!(shares.of(Label::from(1), 4), Bounds { lower: 0.0, upper: 1.0 });
    }

    #[test]
    fn what_has_no_basin_is_undecided() {
        let window = Interval { left: 0.0, right: 2.0 };
        let open = (Interval { left: 0.5, right: 0.75 }, Label::UNDECIDED);
        let shares = PixelShares::of_intervals(&[part(0.0, 0.5, 1), open], window, 2).unwrap();
        assert_eq!((shares.undecided(0), shares.undecided(1)), (Some(0.5), Some(1.0)));
        assert_eq!(shares.of(Label::from(1), 0), Bounds { lower: 0.5, upper: 1.0 });
        assert_eq!(shares.of(Label::from(2), 0), Bounds { lower: 0.0, upper: 0.5 });
        let nothing = PixelShares::of_intervals(&[], window, 2).unwrap();
        assert_eq!(
            (nothing.pixels(), nothing.certain(1), nothing.most_undecided()),
            (2, Some(&[][..]), 1.0)
        );
    }

    #[test]
    fn bad_pixels_and_intervals_are_refused() {
        let window = Interval { left: 1.0, right: 2.0 };
        let shares = |parts: &[_], window, pixels| PixelShares::of_intervals(parts, window, pixels);
        for pixels in [0, usize::MAX] {
            assert!(matches!(shares(&[], window, pixels), Err(Error::BadPixels { .. })));
        }
        let narrow = Interval { left: 1.0, right: 1.0 + 4.0 * f64::EPSILON };
        assert!(shares(&[], narrow, 4).is_ok());
        assert!(matches!(shares(&[], narrow, 5), Err(Error::BadPixels { .. })));
        for bad in [Interval { left: 2.0, right: 1.0 }, Interval { left: f64::NAN, right: 1.0 }] {
            assert!(matches!(shares(&[], bad, 4), Err(Error::BadInterval { .. })));
            assert!(shares(&[(bad, Label::from(1))], window, 4).is_err());
        }
        let overlapping = [part(1.0, 1.5, 1), part(1.4, 1.6, 2)];
        assert!(matches!(shares(&overlapping, window, 4), Err(Error::UnsortedIntervals { .. })));
        let reversed = [part(1.5, 1.6, 1), part(1.0, 1.2, 2)];
        assert!(matches!(shares(&reversed, window, 4), Err(Error::UnsortedIntervals { .. })));
    }
}
