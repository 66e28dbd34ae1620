//! The Wada property by merging basins (Daza, Wagemakers, Sanjuán 2018).
//!
//! Basins have the Wada property if all of them share one boundary. Equivalently, the boundary between one basin
//! and the union of all others is the same for each basin.

use crate::boundaries::region_uncertainty::check_perturbation;
use crate::error::Error;
use crate::line::interval_basins::{IntervalBasins, LabelledInterval};
use crate::space::label::Label;
use crate::space::raster::LabelImage;

/// The largest distance between the boundaries of the basins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WadaTest {
    /// The distance tested, in steps along rows and columns.
    pub distance: usize,
    /// Pixels on the boundary of one basin that are farther than `distance` from the boundary of another basin,
    /// as a fraction of all pixels of the image: the largest over all pairs of basins. Zero means that the Wada
    /// property holds at this distance.
    pub far_image_fraction: f64,
    /// The same pixels as a fraction of the pixels on the first basin's boundary.
    pub far_boundary_fraction: f64,
    /// The undecided pixels, as a fraction of all pixels of the image. A boundary that passes through them is not seen.
    pub undecided_fraction: f64,
    /// A witness of what all basins share: a pixel, by its column and row, and the distance within which it has the boundaries of all basins. It is the
    /// smallest in the image. `None` if a basin has no boundary.
    pub shared: Option<(usize, usize, usize)>,
    /// A witness against it: the pixel on the boundary of the first basin that is farthest from the boundary of the second one, if it is farther than the
    /// distance tested.
    pub apart: Option<WadaGap>,
}

/// A pixel on the boundary of a basin that is far from that of another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WadaGap {
    /// Its column and row.
    pub pixel: (usize, usize),
    /// On the boundary of this basin.
    pub basin: Label,
    /// Far from the boundary of this one.
    pub other: Label,
    /// The distance, in steps along rows and columns; `None` if the other basin has no boundary.
    pub distance: Option<usize>,
}

impl LabelImage {
    /// Compares the boundaries of all pairs of basins. Each is a boundary against the union of all other basins.
    ///
    /// A border with undecided pixels, or with pixels outside the region of interest, is no boundary between
    /// basins. All fractions of the image are of its pixels inside the region of interest.
    ///
    /// # Errors
    /// [`Error::TooFewLabels`] for fewer than three basins; [`Error::BadImage`] as for [`check`](Self::check).
    pub fn wada(&self, distance: usize) -> Result<WadaTest, Error> {
        self.check()?;
        let counts = self.counts();
        let sum = |condition: fn(Label) -> bool| {
            let own = counts.iter().filter(|(label, _)| condition(*label));
            own.map(|(_, pixels)| pixels).sum::<usize>() as f64
        };
        let (inside, undecided) = (sum(|label| !label.is_outside()), sum(Label::is_undecided));
        let labels: Vec<Label> =
            counts.iter().map(|(label, _)| *label).filter(|label| label.is_decided()).collect();
        if labels.len() < 3 {
            return Err(Error::TooFewLabels { labels: labels.len() });
        }
        let boundaries: Vec<Vec<bool>> =
            labels.iter().map(|&label| self.boundary_of(label)).collect();
        let distances: Vec<Vec<usize>> =
            boundaries.iter().map(|boundary| self.distances(boundary)).collect();
        let pixel = |at: usize| (at % self.grid.columns, at / self.grid.columns);
        let widest = |at: &usize| distances.iter().map(|own| own[*at]).max().unwrap_or(usize::MAX);
        let shared = (0..self.labels.len()).map(|at| (widest(&at), at)).min();
        let shared = shared.filter(|(away, _)| *away < usize::MAX);
        let (mut of_image, mut of_boundary) = (0.0f64, 0.0f64);
        let mut farthest: Option<(usize, usize, usize, usize)> = None;
        for (one, boundary) in boundaries.iter().enumerate() {
            // A basin among undecided pixels has no boundary with other basins. The 1 guards the division below.
            let own = boundary.iter().filter(|&&on| on).count().max(1);
            for other in (0..labels.len()).filter(|&other| other != one) {
                let far = boundary
                    .iter()
                    .zip(&distances[other])
                    .filter(|&(&on, &away)| on && away > distance)
                    .count() as f64;
                let on = (0..boundary.len()).filter(|&at| boundary[at]);
                let last = on.map(|at| (distances[other][at], at, one, other)).max();
                if last.map(|last| last.0) > farthest.map(|known| known.0) {
                    farthest = last;
                }
                of_image = of_image.max(far / inside);
                of_boundary = of_boundary.max(far / own as f64);
            }
        }
        Ok(WadaTest {
            distance,
            far_image_fraction: of_image,
            far_boundary_fraction: of_boundary,
            undecided_fraction: undecided / inside,
            shared: shared.map(|(away, at)| (pixel(at).0, pixel(at).1, away)),
            apart: farthest.filter(|own| own.0 > distance).map(|(away, at, one, other)| WadaGap {
                pixel: pixel(at),
                basin: labels[one],
                other: labels[other],
                distance: (away < usize::MAX).then_some(away),
            }),
        })
    }

    /// The pixels on either side of the border of a basin with other basins: of the pixel and a neighbour exactly
    /// one has the label, and both belong to basins.
    fn boundary_of(&self, label: Label) -> Vec<bool> {
        let inside = |at: usize| self.labels[at] == label;
        let basin = |at: usize| self.labels[at].is_decided();
        let differ = |at: usize, next: usize| basin(next) && inside(next) != inside(at);
        let borders = |at: usize| basin(at) && self.neighbours(at).any(|next| differ(at, next));
        (0..self.labels.len()).map(borders).collect()
    }

    /// The number of steps along rows and columns from every pixel to the nearest marked one, by a breadth-first
    /// search from all marked pixels; `usize::MAX` if none is marked.
    fn distances(&self, marked: &[bool]) -> Vec<usize> {
        let mut distances = vec![usize::MAX; marked.len()];
        let mut front: Vec<usize> = (0..marked.len()).filter(|&at| marked[at]).collect();
        front.iter().for_each(|&at| distances[at] = 0);
        let mut steps = 0;
        while !front.is_empty() {
            steps += 1;
            let mut next = Vec::new();
            for &at in &front {
                for neighbour in self.neighbours(at) {
                    if distances[neighbour] == usize::MAX {
                        distances[neighbour] = steps;
                        next.push(neighbour);
                    }
                }
            }
            front = next;
        }
        distances
    }

    /// The two to four pixels beside a pixel, by their index in `labels`.
    fn neighbours(&self, at: usize) -> impl Iterator<Item = usize> + use<> {
        let (columns, pixels) = (self.grid.columns, self.labels.len());
        let column = at % columns;
        [
            (column > 0).then(|| at - 1),
            (column + 1 < columns).then_some(at + 1),
            at.checked_sub(columns),
            (at + columns < pixels).then_some(at + columns),
        ]
        .into_iter()
        .flatten()
    }
}

/// The largest distance between the boundaries of basins on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineWadaTest {
    /// The distance tested.
    pub distance: f64,
    /// Boundary points of one basin that are farther than `distance` from every boundary point of another, as a
    /// fraction of the boundary points of the first: the largest over all pairs of basins. Zero means that the Wada
    /// property holds at this distance.
    pub far_fraction: f64,
    /// The undecided length over that of the window. A boundary that lies in an undecided gap is not seen.
    pub undecided_fraction: f64,
    /// A witness against it: a boundary point of the first basin that is farther than `distance` from every boundary point of the second one.
    pub apart: Option<(f64, Label, Label)>,
}

impl IntervalBasins {
    /// Compares the boundaries of all pairs of basins, as [`LabelImage::wada`] does for images. A boundary point of
    /// a basin is an end that it shares with another basin, or a gap of at most `distance` between the two: the
    /// middle of the gap.
    ///
    /// ```
    /// use basin_of_attraction::{Error, Interval, Label, Refinement, interval_basins};
    /// // Three intervals in a row: the first and the third share no boundary.
    /// let part = |left: f64, right: f64, n: u8| Ok((Interval::new(left, right)?, Label::from(n)));
    /// let known = [part(0.0, 1.0, 1)?, part(1.0 + 1e-12, 2.0, 2)?, part(2.0 + 1e-12, 3.0, 3)?];
    /// let (no_map, window) = (|_: f64| None, Interval::new(0.0, 3.0)?);
    /// let row = interval_basins(&no_map, &known, &[], window, Refinement::default())?;
    /// assert!(row.wada(0.5)?.far_fraction > 0.0 && row.wada(1.5)?.far_fraction == 0.0);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::TooFewLabels`] for fewer than three basins; [`Error::BadPerturbation`] unless `distance` is positive
    /// and finite.
    pub fn wada(&self, distance: f64) -> Result<LineWadaTest, Error> {
        check_perturbation(distance)?;
        let labels: Vec<Label> =
            self.labels().into_iter().filter(|label| label.is_decided()).collect();
        if labels.len() < 3 {
            return Err(Error::TooFewLabels { labels: labels.len() });
        }
        let decided = || self.intervals().iter().filter(|part| part.label.is_decided());
        let between = |(one, next): (&LabelledInterval, &LabelledInterval)| {
            let (before, after) = (one.interval.right, next.interval.left);
            let seen = one.label != next.label && after - before <= distance;
            seen.then_some((before + 0.5 * (after - before), [one.label, next.label]))
        };
        // From left to right, each with the two basins that it separates.
        let boundary: Vec<(f64, [Label; 2])> =
            decided().zip(decided().skip(1)).filter_map(between).collect();
        let own = |label: Label| -> Vec<f64> {
            boundary
                .iter()
                .filter(|(_, sides)| sides.contains(&label))
                .map(|point| point.0)
                .collect()
        };
        let of_basins: Vec<Vec<f64>> = labels.iter().copied().map(own).collect();
        let (mut far_fraction, mut apart) = (0.0f64, None);
        for (one, points) in of_basins.iter().enumerate() {
            for (other, others) in of_basins.iter().enumerate().filter(|(other, _)| *other != one) {
                let is_far = |x: &&f64| {
                    let next = others.partition_point(|other| other < *x);
                    let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
                    !near
                        .filter_map(|at| others.get(at))
                        .any(|other| (other - **x).abs() <= distance)
                };
                // A basin among undecided gaps has no boundary with other basins. The 1 guards the division.
                let far = points.iter().filter(is_far).count() as f64 / points.len().max(1) as f64;
                far_fraction = far_fraction.max(far);
                let witness = points.iter().find(|x| is_far(x));
                apart = apart.or(witness.map(|x| (*x, labels[one], labels[other])));
            }
        }
        let undecided_fraction = self.undecided() / self.window().length();
        Ok(LineWadaTest { distance, far_fraction, undecided_fraction, apart })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;
    use crate::space::raster::{Grid, raster};
    use std::ops::ControlFlow::Continue;

    /// Three stripes of four rows. The pixels of the last column have another label.
    fn stripes(last_column: Option<Label>) -> LabelImage {
        let window = Interval { left: 0.0, right: 12.0 };
        let grid = Grid { x: window, y: window, columns: 12, rows: 12 };
        let label = |&x: &f64, y: f64| {
            last_column.filter(|_| x > 11.0).unwrap_or(Label::from((y / 4.0) as u8))
        };
        raster(grid, |x| x, label, |_| Continue(())).unwrap()
    }

    #[test]
    fn undecided_pixels_are_no_basin_in_the_wada_test() {
        let known = stripes(None).wada(1).unwrap();
        let open = stripes(Some(Label::UNDECIDED)).wada(1).unwrap();
        let masked = stripes(Some(Label::OUTSIDE)).wada(1).unwrap();
        assert_eq!(open.far_boundary_fraction, known.far_boundary_fraction);
        assert_eq!((known.undecided_fraction, masked.undecided_fraction), (0.0, 0.0));
        assert!((open.undecided_fraction - 1.0 / 12.0).abs() < 1e-15);
        // Two rows of each border are far from the other border: 2 × 11 pixels of 12 × 12, or of 11 × 12.
        assert!((open.far_image_fraction - 22.0 / 144.0).abs() < 1e-15, "{open:?}");
        assert!((masked.far_image_fraction - 22.0 / 132.0).abs() < 1e-15, "{masked:?}");
        // The middle stripe has four rows: its two borders are three steps apart, and no pixel is nearer to both.
        let apart = known.apart.unwrap();
        assert!((apart.basin, apart.other) == (Label::from(0), Label::from(2)), "{apart:?}");
        assert_eq!((apart.pixel.1, apart.distance), (3, Some(4)));
        assert_eq!(known.shared.unwrap().2, 2);
        assert_eq!(stripes(None).wada(4).unwrap().apart, None);
        let mut two = stripes(None);
        two.labels
            .iter_mut()
            .filter(|label| **label == Label::from(0))
            .for_each(|label| *label = Label::UNDECIDED);
        assert_eq!(two.wada(1), Err(Error::TooFewLabels { labels: 2 }));
        two.labels.push(Label::from(0));
        assert!(matches!(two.wada(1), Err(Error::BadImage { .. })));
    }
}
