//! Distances of feature vectors.

use crate::space::vectors::distance;
use std::fmt;
use std::sync::Arc;

/// How far two feature vectors are apart. Vectors of different lengths have no distance.
///
/// A matrix is a vector of its entries, row by row; its Euclidean distance is that of Frobenius.
///
/// ```
/// use basin_of_attraction::{FeatureGroups, Label, Metric};
/// // Angles: 0.1 and 6.2 are close.
/// let angle = Metric::by(|a, b| {
///     let off = (a[0] - b[0]).abs() % std::f64::consts::TAU;
///     off.min(std::f64::consts::TAU - off)
/// });
/// let features = [0.1, 6.2, 3.0, 3.1].map(|x| vec![x]);
/// let groups = FeatureGroups::dense_by(angle, &features, 0.3, 2)?;
/// assert_eq!(groups.labels().len(), 2);
/// assert_eq!(groups.label(&[0.0]), Label::from(1));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Metric(Kind);

#[derive(Clone, Default)]
enum Kind {
    #[default]
    Euclidean,
    Largest,
    Sum,
    Cells(Vec<f64>),
    By(Arc<Distance>),
}

type Distance = dyn Fn(&[f64], &[f64]) -> f64 + Send + Sync;

impl Metric {
    /// The root of the sum of squares.
    pub fn euclidean() -> Metric {
        Metric(Kind::Euclidean)
    }

    /// The largest difference of a coordinate.
    pub fn largest() -> Metric {
        Metric(Kind::Largest)
    }

    /// The sum of the differences of the coordinates.
    pub fn sum() -> Metric {
        Metric(Kind::Sum)
    }

    /// Cells of these widths, one for each coordinate, counted from 0: the largest difference of the numbers of two cells, 0 in the same one. With a
    /// radius below 1 the groups are the cells of a histogram. Numbers of cells beyond the largest `f64` have no distance.
    pub fn cells(widths: &[f64]) -> Metric {
        Metric(Kind::Cells(widths.to_vec()))
    }

    /// Any other one: symmetric, not negative, 0 for equal vectors. NaN stands for no distance.
    pub fn by(distance: impl Fn(&[f64], &[f64]) -> f64 + Send + Sync + 'static) -> Metric {
        Metric(Kind::By(Arc::new(distance)))
    }

    /// The distance of two vectors; NaN if there is none.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let differences = || a.iter().zip(b).map(|(a, b)| (a - b).abs());
        match &self.0 {
            _ if a.len() != b.len() => f64::NAN,
            Kind::Euclidean => distance(a, b),
            Kind::Largest => differences().fold(0.0, larger),
            Kind::Sum => differences().sum(),
            Kind::Cells(widths) if widths.len() != a.len() => f64::NAN,
            Kind::Cells(widths) => {
                let cell = |x: f64, width: &f64| (x / width).floor();
                // NaN for infinite numbers.
                let apart = |(a, b): (f64, f64)| (a - b).abs();
                let all = a.iter().zip(b).zip(widths);
                let cells = all.map(|((a, b), width)| (cell(*a, width), cell(*b, width)));
                cells.map(apart).fold(0.0, larger)
            }
            Kind::By(distance) => distance(a, b),
        }
    }
}

/// The larger of two numbers; NaN if the second one is.
fn larger(most: f64, other: f64) -> f64 {
    if other > most || other.is_nan() { other } else { most }
}

impl fmt::Debug for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Euclidean => f.write_str("euclidean"),
            Kind::Largest => f.write_str("largest"),
            Kind::Sum => f.write_str("sum"),
            Kind::Cells(widths) => write!(f, "cells of {widths:?}"),
            Kind::By(_) => f.write_str("by a function"),
        }
    }
}

/// Functions are equal if they are the same one.
impl PartialEq for Metric {
    fn eq(&self, other: &Metric) -> bool {
        match (&self.0, &other.0) {
            (Kind::Euclidean, Kind::Euclidean)
            | (Kind::Largest, Kind::Largest)
            | (Kind::Sum, Kind::Sum) => true,
            (Kind::Cells(own), Kind::Cells(other)) => own == other,
            (Kind::By(own), Kind::By(other)) => Arc::ptr_eq(own, other),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_their_names() {
        let (a, b) = ([0.0, 1.0], [3.0, -3.0]);
        let all =
            [Metric::euclidean(), Metric::largest(), Metric::sum(), Metric::cells(&[2.0, 0.5])];
        assert_eq!(all.each_ref().map(|metric| metric.distance(&a, &b)), [5.0, 4.0, 7.0, 8.0]);
        for metric in &all {
            assert!(
                metric.distance(&a, &b[..1]).is_nan()
                    && metric.distance(&a, &[f64::NAN, 0.0]).is_nan()
            );
            assert_eq!((metric.distance(&a, &a), metric.clone()), (0.0, metric.clone()));
        }
        assert!(all[0] != all[1] && Metric::cells(&[1.0]).distance(&a, &b).is_nan());
        let own = Metric::by(|a, _| a[0]);
        assert!(
            own == own.clone()
                && own != Metric::by(|a, _| a[0])
                && format!("{own:?}") == "by a function"
        );
    }
}
