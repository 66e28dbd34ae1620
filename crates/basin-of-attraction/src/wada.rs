//! The Wada property by merging basins (Daza, Wagemakers, Sanjuán 2018).
//!
//! Basins have the Wada property if all of them share one boundary. Equivalently, the boundary between one basin
//! and the union of all others is the same for each basin.

use crate::error::Error;
use crate::label::Label;
use crate::raster::LabelImage;

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
}

impl LabelImage {
    /// Compares the boundaries of all pairs of basins. Each is a boundary against the union of all other basins.
    ///
    /// # Errors
    /// [`Error::TooFewLabels`] for fewer than three labels.
    pub fn wada(&self, distance: usize) -> Result<WadaTest, Error> {
        let labels: Vec<Label> = self.counts().into_iter().map(|(label, _)| label).collect();
        if labels.len() < 3 {
            return Err(Error::TooFewLabels { labels: labels.len() });
        }
        let boundaries: Vec<Vec<bool>> =
            labels.iter().map(|&label| self.boundary_of(label)).collect();
        let distances: Vec<Vec<usize>> =
            boundaries.iter().map(|boundary| self.distances(boundary)).collect();
        let (mut of_image, mut of_boundary) = (0.0f64, 0.0f64);
        for (one, boundary) in boundaries.iter().enumerate() {
            // With three labels every label has a boundary. The 1 only guards the division below.
            let own = boundary.iter().filter(|&&on| on).count().max(1);
            for other in (0..labels.len()).filter(|&other| other != one) {
                let far = boundary
                    .iter()
                    .zip(&distances[other])
                    .filter(|&(&on, &away)| on && away > distance)
                    .count() as f64;
                of_image = of_image.max(far / boundary.len() as f64);
                of_boundary = of_boundary.max(far / own as f64);
            }
        }
        Ok(WadaTest { distance, far_image_fraction: of_image, far_boundary_fraction: of_boundary })
    }

    /// The pixels on either side of the border of a label: of the pixel and a neighbour exactly one has the label.
    fn boundary_of(&self, label: Label) -> Vec<bool> {
        let inside = |at: usize| self.labels[at] == label;
        let borders = |at: usize| self.neighbours(at).any(|next| inside(next) != inside(at));
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
