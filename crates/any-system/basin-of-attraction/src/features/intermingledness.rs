//! How intermingled labelled points are.

use crate::error::Error;
use crate::features::feature_groups::{check, check_feature_count};
use crate::features::metric::Metric;
use crate::space::label::Label;
use crate::space::vectors::check_dimension;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The intermingledness of each basin among labelled points: the mean distance of its points from each other, over their mean distance from those of another
/// basin, averaged over the other basins (`intermingledness` of Attractors.jl). 1 says that the points are as far from those of their
/// own basin as from others, and so do points that are all equal. A point counts as a pair with itself. Points of no basin, and pairs without a distance, do not
/// count; with one basin there is no value.
///
/// It is a number of these points: others give another one.
///
/// ```
/// use basin_of_attraction::{Label, Metric, intermingledness};
/// let points: Vec<Vec<f64>> = (0..100).map(|k| vec![f64::from(k)]).collect();
/// let stripes: Vec<Label> = (0..100u8).map(|k| Label::from(k % 2)).collect();
/// let halves: Vec<Label> = (0..100u8).map(|k| Label::from(k / 50)).collect();
/// let mixed = intermingledness(&points, &stripes, &Metric::euclidean())?;
/// assert!((mixed[&Label::from(0)] - 1.0).abs() < 0.01);
/// let apart = intermingledness(&points, &halves, &Metric::euclidean())?;
/// assert!(apart[&Label::from(0)] < 0.4);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongDimension`] for another number of labels than points, and for points of different lengths; [`Error::BadPoint`] and [`Error::NoDimension`] for
/// points that are not finite or empty; [`Error::TooManySamples`] for more than 20 000 points.
pub fn intermingledness(
    points: &[Vec<f64>],
    labels: &[Label],
    metric: &Metric,
) -> Result<BTreeMap<Label, f64>, Error> {
    check_dimension(labels.len(), points.len())?;
    check_feature_count(points.len())?;
    check(points.iter(), 1.0)?;
    let mut groups: BTreeMap<Label, Vec<&[f64]>> = BTreeMap::new();
    for (point, label) in
        points.iter().zip(labels).filter(|(_, label)| label.basin_number().is_some())
    {
        groups.entry(*label).or_default().push(point);
    }
    let mean = |one: &[&[f64]], other: &[&[f64]]| {
        let from = |a: &&[f64]| {
            let all = other.iter().map(|b| metric.distance(a, b)).filter(|own| !own.is_nan());
            all.fold((0.0, 0usize), |(sum, count), own| (sum + own, count + 1))
        };
        let sums: Vec<(f64, usize)> = one.par_iter().map(from).collect();
        let count: usize = sums.iter().map(|(_, count)| count).sum();
        (count > 0).then(|| sums.iter().map(|(sum, _)| sum).sum::<f64>() / count as f64)
    };
    let value = |(label, own): (&Label, &Vec<&[f64]>)| {
        let inside = mean(own, own)?;
        let others = groups.iter().filter(|(other, _)| *other != label);
        let ratio = |between: f64| if between == inside { 1.0 } else { inside / between };
        let ratios: Vec<f64> =
            others.filter_map(|(_, other)| mean(own, other)).map(ratio).collect();
        let average = ratios.iter().sum::<f64>() / ratios.len() as f64;
        (!ratios.is_empty()).then_some((*label, average))
    };
    Ok(groups.iter().filter_map(value).collect())
}
