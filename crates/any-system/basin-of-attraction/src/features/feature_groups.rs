//! Groups of similar feature vectors: dense ones that a radius connects, or those beside given templates.

use crate::error::Error;
use crate::features::metric::Metric;
use crate::space::label::{Label, label_of_attractor};
use crate::space::vectors::check_dimension;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Most feature vectors that are grouped: all their distances are computed, some 10⁸. More take minutes.
const MOST_FEATURES: usize = 20_000;

/// An error for more feature vectors than can be grouped.
pub(crate) fn check_feature_count(samples: usize) -> Result<(), Error> {
    if samples <= MOST_FEATURES {
        return Ok(());
    }
    let remedy = "take fewer starts, and label the others by the groups";
    Err(Error::TooManySamples { samples, most: MOST_FEATURES, remedy })
}

/// Feature vectors with labels. Any other vector has the label of those within a radius of it.
///
/// ```text
///   within the radius of vectors of one label        that label
///   within the radius of none, or of two labels      undecided
/// ```
///
/// Distances are Euclidean, so that a feature that varies less than others needs a factor; or any other [`Metric`].
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureGroups {
    metric: Metric,
    radius: f64,
    vectors: Vec<(Label, Vec<f64>)>,
}

impl FeatureGroups {
    /// Groups beside templates: feature vectors that the caller knows.
    ///
    /// ```
    /// use basin_of_attraction::{FeatureGroups, Label};
    /// let (rest, rotation) = (Label::from(1), Label::from(2));
    /// let mean_rate = FeatureGroups::from_templates(&[(rest, vec![0.0]), (rotation, vec![5.0])], 0.5)?;
    /// assert_eq!(mean_rate.label(&[4.8]), rotation);
    /// // The nearest template is that of the rest. It is too far away to be the answer.
    /// assert_eq!(mean_rate.label(&[1.0]), Label::UNDECIDED);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadSearch`] for a radius that is not positive and finite; [`Error::BadPoint`],
    /// [`Error::WrongDimension`] and [`Error::NoDimension`] for templates that are not finite, of different lengths,
    /// or empty; [`Error::NoBasin`] for a label that is no basin.
    pub fn from_templates(templates: &[(Label, Vec<f64>)], radius: f64) -> Result<Self, Error> {
        FeatureGroups::from_templates_by(Metric::euclidean(), templates, radius)
    }

    /// The same with any distance.
    ///
    /// # Errors
    /// As [`from_templates`](Self::from_templates).
    pub fn from_templates_by(
        metric: Metric,
        templates: &[(Label, Vec<f64>)],
        radius: f64,
    ) -> Result<Self, Error> {
        check(templates.iter().map(|(_, vector)| vector), radius)?;
        match templates.iter().find(|(label, _)| label.basin_number().is_none()) {
            Some(&(label, _)) => Err(Error::NoBasin { label }),
            None => Ok(FeatureGroups { metric, radius, vectors: templates.to_vec() }),
        }
    }

    /// Groups dense vectors, each of an orbit of its own: a vector is dense if `fewest` of them are within the radius of it, its own among
    /// them. Dense vectors within the radius of one another are of one group; the others are of none. Groups are numbered from 1 in the order of
    /// their first vectors. [`suggested_radius`](crate::suggested_radius) has a radius.
    ///
    /// ```
    /// use basin_of_attraction::{FeatureGroups, Label};
    /// let features: Vec<Vec<f64>> = [0.0, 0.1, 5.0, 5.1, 0.05, 9.0].map(|x| vec![x]).to_vec();
    /// let groups = FeatureGroups::dense(&features, 0.5, 2)?;
    /// assert_eq!(groups.label(&[0.2]), Label::from(1));
    /// assert_eq!(groups.label(&[9.0]), Label::UNDECIDED);
    /// assert_eq!(groups.nearest(&[9.0]), Some((Label::from(2), 3.9000000000000004)));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`from_templates`](Self::from_templates); [`Error::TooManySamples`] for more than 20 000 vectors.
    pub fn dense(vectors: &[Vec<f64>], radius: f64, fewest: usize) -> Result<Self, Error> {
        FeatureGroups::dense_by(Metric::euclidean(), vectors, radius, fewest)
    }

    /// The same with any distance.
    ///
    /// # Errors
    /// As [`dense`](Self::dense).
    pub fn dense_by(
        metric: Metric,
        vectors: &[Vec<f64>],
        radius: f64,
        fewest: usize,
    ) -> Result<Self, Error> {
        let numbered: Vec<(usize, Vec<f64>)> = vectors.iter().cloned().enumerate().collect();
        FeatureGroups::by_density(metric, &numbered, radius, fewest)
    }

    /// The cells of a histogram, of these widths and counted from 0: vectors in one cell are a group if there are `fewest` at least.
    ///
    /// ```
    /// use basin_of_attraction::{FeatureGroups, Label};
    /// let features = [0.1, 0.7, 2.3, 2.5, 9.0].map(|x| vec![x]);
    /// let groups = FeatureGroups::histogram(&features, &[1.0], 2)?;
    /// assert_eq!(groups.label(&[2.9]), Label::from(2));
    /// assert!(groups.label(&[3.0]).is_undecided() && groups.label(&[9.0]).is_undecided());
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`dense`](Self::dense); [`Error::BadSearch`] for a width that is not positive and finite; [`Error::WrongDimension`] for another number of
    /// widths than coordinates.
    pub fn histogram(vectors: &[Vec<f64>], widths: &[f64], fewest: usize) -> Result<Self, Error> {
        if let Some(&value) = widths.iter().find(|width| !(**width > 0.0 && width.is_finite())) {
            return Err(Error::BadSearch { name: "a width of a cell", value, remedy: "" });
        }
        check_dimension(widths.len(), vectors.first().map_or(widths.len(), Vec::len))?;
        FeatureGroups::dense_by(Metric::cells(widths), vectors, SAME_CELL, fewest)
    }

    /// Groups dense vectors. Vector k comes from `orbits[k].0`.
    ///
    /// A vector is dense if vectors of `fewest` orbits are within the radius of it, its own among them. Dense
    /// vectors within the radius of one another are of one group. (DBSCAN of M. Ester et al., KDD 1996, without its
    /// other vectors, whose group may depend on their order.) Groups are numbered from 1 in the order of their
    /// first orbits.
    pub(crate) fn by_density(
        metric: Metric,
        vectors: &[(usize, Vec<f64>)],
        radius: f64,
        fewest: usize,
    ) -> Result<Self, Error> {
        check(vectors.iter().map(|(_, vector)| vector), radius)?;
        check_feature_count(vectors.len())?;
        let near = |a: &[f64]| -> Vec<usize> {
            (0..vectors.len()).filter(|&k| metric.distance(a, &vectors[k].1) <= radius).collect()
        };
        let dense = |own: &[usize]| {
            own.iter().map(|&k| vectors[k].0).collect::<BTreeSet<_>>().len() >= fewest
        };
        let is_dense: Vec<bool> =
            vectors.par_iter().map(|(_, vector)| dense(&near(vector))).collect();
        let mut group: Vec<Option<usize>> = vec![None; vectors.len()];
        let mut groups = 0;
        for first in 0..vectors.len() {
            if !is_dense[first] || group[first].is_some() {
                continue;
            }
            groups += 1;
            group[first] = Some(groups);
            let mut next = vec![first];
            while let Some(k) = next.pop() {
                for other in near(&vectors[k].1) {
                    if is_dense[other] && group[other].is_none() {
                        group[other] = Some(groups);
                        next.push(other);
                    }
                }
            }
        }
        let labelled = group.iter().zip(vectors).filter_map(|(group, (_, vector))| {
            group.map(|number| Ok((label_of_attractor(number)?, vector.clone())))
        });
        let vectors = labelled.collect::<Result<_, Error>>()?;
        Ok(FeatureGroups { metric, radius, vectors })
    }

    /// The groups that are `kept`, numbered again from 1.
    pub(crate) fn only(self, kept: &BTreeSet<Label>) -> Self {
        let new: BTreeMap<Label, Label> =
            kept.iter().zip(1..).filter_map(|(&old, n)| Some((old, Label::basin(n)?))).collect();
        let again =
            |(label, vector): (Label, Vec<f64>)| new.get(&label).map(|&label| (label, vector));
        FeatureGroups { vectors: self.vectors.into_iter().filter_map(again).collect(), ..self }
    }

    /// The label of a feature vector. One that is not finite, or of another length, is undecided.
    pub fn label(&self, feature: &[f64]) -> Label {
        let near = self
            .vectors
            .iter()
            .filter(|(_, vector)| self.metric.distance(vector, feature) <= self.radius);
        let mut found = near.map(|(label, _)| *label);
        match found.next() {
            Some(label) if found.all(|other| other == label) => label,
            _ => Label::UNDECIDED,
        }
    }

    /// The label of the nearest vector, however far it is, and its distance; `None` without vectors, and for a feature that is not finite or of
    /// another length. Of several ones at the same distance the first counts.
    pub fn nearest(&self, feature: &[f64]) -> Option<(Label, f64)> {
        let all = self
            .vectors
            .iter()
            .map(|(label, vector)| (*label, self.metric.distance(vector, feature)));
        all.filter(|(_, off)| off.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The labels of the groups.
    pub fn labels(&self) -> BTreeSet<Label> {
        self.vectors.iter().map(|(label, _)| *label).collect()
    }

    /// The feature vectors that make a group.
    pub fn vectors(&self, label: Label) -> impl Iterator<Item = &[f64]> {
        self.vectors.iter().filter(move |own| own.0 == label).map(|(_, vector)| vector.as_slice())
    }

    /// The smallest distance of two vectors of different groups; `None` for fewer than two groups.
    ///
    /// With groups by density it is larger than the radius. If it is less than twice the radius, there are features
    /// that are undecided because they lie beside two groups; far more than that says that the radius is not what
    /// decides the groups.
    pub fn separation(&self) -> Option<f64> {
        let from = |(k, (label, vector)): (usize, &(Label, Vec<f64>))| {
            let others = self.vectors[k..].iter().filter(|other| other.0 != *label);
            let distances = others.map(|(_, other)| self.metric.distance(vector, other));
            distances.filter(|distance| !distance.is_nan()).min_by(f64::total_cmp)
        };
        self.vectors.iter().enumerate().filter_map(from).min_by(f64::total_cmp)
    }

    /// For each group the mean silhouette of its vectors: (b − a)/max(a, b), where a is the mean distance from the others of the group, and b the
    /// smallest mean distance from those of another group (P. J. Rousseeuw, J. Comput. Appl. Math. 20, 53, 1987). Near 1 the groups are apart, near 0
    /// they meet. A group of one vector has 0; without a second group there is none. Pairs without a distance do not count.
    pub fn silhouettes(&self) -> BTreeMap<Label, f64> {
        let mut groups: BTreeMap<Label, Vec<&[f64]>> = BTreeMap::new();
        for (label, vector) in &self.vectors {
            groups.entry(*label).or_default().push(vector);
        }
        if groups.len() < 2 {
            return BTreeMap::new();
        }
        // Without some of the distances, which are 0.
        let mean = |from: &[f64], of: &[&[f64]], without: usize| {
            let all = of.iter().map(|other| self.metric.distance(from, other));
            let all: Vec<f64> = all.filter(|distance| !distance.is_nan()).collect();
            let count = all.len().saturating_sub(without);
            (count > 0).then(|| all.iter().sum::<f64>() / count as f64)
        };
        let own = |(label, vector): &(Label, Vec<f64>)| {
            let others = groups.iter().filter(|(other, _)| *other != label);
            let between = others.filter_map(|(_, of)| mean(vector, of, 0)).min_by(f64::total_cmp);
            match (mean(vector, &groups[label], 1), between) {
                // Both may be too large for a number: then neither is the larger one.
                (Some(inside), Some(between)) if inside < between => 1.0 - inside / between,
                (Some(inside), Some(between)) if between < inside => between / inside - 1.0,
                _ => 0.0,
            }
        };
        let all: Vec<(Label, f64)> =
            self.vectors.par_iter().map(|vector| (vector.0, own(vector))).collect();
        let mut means = BTreeMap::new();
        for (label, silhouette) in all {
            *means.entry(label).or_insert(0.0) += silhouette / groups[&label].len() as f64;
        }
        means
    }
}

/// Cells have whole distances: below 1 is the same one.
const SAME_CELL: f64 = 0.5;

/// Tests the radius, and that all vectors are finite and of one length.
pub(crate) fn check<'a>(
    vectors: impl Iterator<Item = &'a Vec<f64>>,
    radius: f64,
) -> Result<(), Error> {
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(Error::BadSearch { name: "a radius", value: radius, remedy: "" });
    }
    let mut expected = None;
    for vector in vectors {
        let (dimension, expected) = (vector.len(), *expected.get_or_insert(vector.len()));
        if dimension == 0 {
            return Err(Error::NoDimension);
        }
        check_dimension(dimension, expected)?;
        if let Some(coordinate) = vector.iter().position(|x| !x.is_finite()) {
            return Err(Error::BadPoint { coordinate, value: vector[coordinate] });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::split_mix::SplitMix64;

    /// `count` vectors around a point, each of an orbit of its own.
    fn around(centre: [f64; 2], count: u64, seed: u64) -> Vec<Vec<f64>> {
        let random = SplitMix64::from_seed(seed);
        let at = |k: u64| (0..2).map(move |i| centre[i as usize] + random.uniform(2 * k + i) - 0.5);
        (0..count).map(|k| at(k).collect()).collect()
    }

    fn numbered(vectors: Vec<Vec<f64>>) -> Vec<(usize, Vec<f64>)> {
        vectors.into_iter().enumerate().collect()
    }

    #[test]
    fn dense_vectors_are_grouped_in_any_order_and_lone_ones_are_not() {
        let mut vectors = around([0.0, 0.0], 100, 1);
        vectors.extend(around([3.0, 0.0], 100, 2));
        vectors.push(vec![1.5, 0.0]);
        let found =
            FeatureGroups::by_density(Metric::euclidean(), &numbered(vectors.clone()), 0.4, 4)
                .unwrap();
        assert_eq!(found.labels().len(), 2);
        assert_eq!(found.label(&[0.1, 0.1]), Label::from(1));
        assert_eq!(found.label(&[3.0, 0.1]), Label::from(2));
        for lone in [&[1.5, 0.0][..], &[f64::NAN, 0.0], &[0.0], &[]] {
            assert_eq!(found.label(lone), Label::UNDECIDED);
        }
        assert!(found.separation().is_some_and(|gap| (1.8..3.0).contains(&gap)));
        vectors.reverse();
        let back =
            FeatureGroups::by_density(Metric::euclidean(), &numbered(vectors), 0.4, 4).unwrap();
        for probe in around([1.5, 0.0], 300, 3) {
            let wide = [3.0 * probe[0] - 3.0, probe[1]];
            let other = [Label::UNDECIDED, Label::from(2), Label::from(1)];
            let label = found.label(&wide).basin_number().map_or(0, usize::from);
            assert_eq!(back.label(&wide), other[label]);
        }
    }

    /// Two features of one orbit are no evidence for a second orbit.
    #[test]
    fn one_orbit_is_no_group_of_two() {
        let twice = [(0, vec![0.0]), (0, vec![0.1]), (0, vec![0.2])];
        assert!(
            FeatureGroups::by_density(Metric::euclidean(), &twice, 1.0, 2)
                .unwrap()
                .labels()
                .is_empty()
        );
        let two = [(0, vec![0.0]), (1, vec![0.1])];
        assert_eq!(
            FeatureGroups::by_density(Metric::euclidean(), &two, 1.0, 2).unwrap().labels().len(),
            1
        );
    }

    #[test]
    fn vectors_between_two_groups_are_undecided() {
        let templates = [(Label::from(1), vec![0.0]), (Label::from(2), vec![1.5])];
        let found = FeatureGroups::from_templates(&templates, 1.0).unwrap();
        let labels = [0.2, 0.75, 1.3, 2.6].map(|x| found.label(&[x]));
        assert_eq!(labels, [templates[0].0, Label::UNDECIDED, templates[1].0, Label::UNDECIDED]);
        assert_eq!(found.separation(), Some(1.5));
    }

    #[test]
    fn vectors_without_a_distance_are_refused() {
        let found = |vectors: &[(Label, Vec<f64>)], radius| {
            FeatureGroups::from_templates(vectors, radius).map(|_| ())
        };
        let a = Label::from(1);
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(found(&[(a, vec![0.0])], radius), Err(Error::BadSearch { .. })));
        }
        let unlike = found(&[(a, vec![0.0]), (a, vec![0.0, 1.0])], 1.0);
        assert_eq!(unlike, Err(Error::WrongDimension { dimension: 2, expected: 1 }));
        assert_eq!(found(&[(a, vec![])], 1.0), Err(Error::NoDimension));
        assert!(matches!(found(&[(a, vec![f64::NAN])], 1.0), Err(Error::BadPoint { .. })));
        let open = Label::UNDECIDED;
        assert_eq!(found(&[(open, vec![0.0])], 1.0), Err(Error::NoBasin { label: open }));
        let many = vec![(0, vec![0.0]); MOST_FEATURES + 1];
        let many = FeatureGroups::by_density(Metric::euclidean(), &many, 1.0, 1);
        assert!(matches!(many, Err(Error::TooManySamples { .. })));
    }
}
