//! Wada's property by merging (Daza, Wagemakers, Sanjuán 2018): do all basins share one boundary?

use crate::{Error, LabelImage};

/// How far apart the boundaries of the basins are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WadaTest {
    /// The distance tested, in pixels along rows and columns.
    pub distance: usize,
    /// The largest share of the window's pixels that belong to the boundary of one basin against all
    /// others, and lie farther from that of another basin. Zero: the Wada property at this distance.
    pub apart: f64,
    /// The same as a share of the boundary's own pixels.
    pub boundary_apart: f64,
}

impl LabelImage {
    /// Compares the boundaries of each basin against the union of the others.
    ///
    /// # Errors
    /// [`Error::TooFewLabels`] for fewer than three labels.
    pub fn wada(&self, distance: usize) -> Result<WadaTest, Error> {
        let labels: Vec<u16> = self.counts().into_iter().map(|(label, _)| label).collect();
        if labels.len() < 3 {
            return Err(Error::TooFewLabels { labels: labels.len() });
        }
        let boundaries: Vec<Vec<bool>> =
            labels.iter().map(|&label| self.boundary_of(label)).collect();
        let distances: Vec<Vec<usize>> =
            boundaries.iter().map(|boundary| self.distances(boundary)).collect();
        let (mut apart, mut boundary_apart) = (0.0f64, 0.0f64);
        for (one, boundary) in boundaries.iter().enumerate() {
            let own = boundary.iter().filter(|&&on| on).count().max(1);
            for other in (0..labels.len()).filter(|&other| other != one) {
                let far = boundary
                    .iter()
                    .zip(&distances[other])
                    .filter(|&(&on, &away)| on && away > distance)
                    .count() as f64;
                apart = apart.max(far / boundary.len() as f64);
                boundary_apart = boundary_apart.max(far / own as f64);
            }
        }
        Ok(WadaTest { distance, apart, boundary_apart })
    }

    /// The pixels with a neighbour across the border of a label, on both sides of it.
    fn boundary_of(&self, label: u16) -> Vec<bool> {
        let inside = |at: usize| self.labels[at] == label;
        let borders = |at: usize| self.neighbours(at).any(|next| inside(next) != inside(at));
        (0..self.labels.len()).map(borders).collect()
    }

    /// Steps along rows and columns from every pixel to the nearest marked one.
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
