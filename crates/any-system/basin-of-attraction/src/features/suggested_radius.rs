//! Which radius groups feature vectors: the widest gap between the distances inside groups and those between them.

use crate::error::Error;
use crate::features::feature_groups::{check, check_feature_count};
use crate::features::metric::Metric;
use rayon::prelude::*;

/// A radius that groups feature vectors, and how much the groups depend on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuggestedRadius {
    /// The radius: the geometric mean of both ends of the gap.
    pub radius: f64,
    /// From this radius on the groups are the same.
    pub from: f64,
    /// Below this radius they are; `None` if they stay the same at every larger one: one group, of all vectors that have a distance from it.
    pub below: Option<f64>,
}

/// Distances as small as this part of the largest feature are rounding: orbits on one fixed point have the same features to that.
const ROUNDING: f64 = 1e-12;

/// A gap counts if its ends differ by this factor. Random vectors of one group have gaps of up to some 1.7 between the sorted distances of their
/// neighbours; groups that are closer than twice the distances inside them are not told apart by any radius.
const WIDE: f64 = 2.0;

/// At most this part of the vectors may be left out as lone ones: the distances of the others decide.
const LONE: f64 = 0.5;

/// A radius for [`FeatureGroups::dense`](crate::FeatureGroups::dense) with the same `fewest`.
///
/// As the radius grows, groups join at the lengths of a shortest tree of mutual reachability: the distance of two vectors, or that at which one
/// of them is not dense yet, if it is larger (R. J. G. B. Campello, D. Moulavi, J. Sander, 2013). Between two neighbouring lengths nothing
/// changes, until a vector becomes dense by itself. The widest gap, as a ratio, before two groups join is suggested; without one of a factor of two there
/// is one group, and the widest gap leaves out the lone vectors.
///
/// ```
/// use basin_of_attraction::{FeatureGroups, suggested_radius};
/// // The features of orbits at two rests, and of some that rotate with a rate of about 5.
/// let mut features: Vec<Vec<f64>> = (0..20).map(|k| vec![if k < 10 { -1.0 } else { 1.0 }, 0.0]).collect();
/// features.extend((0..10).map(|k| vec![0.0, 5.0 + 0.01 * f64::from(k)]));
/// let found = suggested_radius(&features, 3)?;
/// assert!(found.from < 0.03 && found.below == Some(2.0));
/// assert_eq!(FeatureGroups::dense(&features, found.radius, 3)?.labels().len(), 3);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadSearch`] for fewer vectors than `fewest`, and for a `fewest` of 0; [`Error::BadPoint`], [`Error::WrongDimension`] and
/// [`Error::NoDimension`] for vectors that are not finite, of different lengths, or empty, and if no two have a finite distance;
/// [`Error::TooManySamples`].
pub fn suggested_radius(vectors: &[Vec<f64>], fewest: usize) -> Result<SuggestedRadius, Error> {
    suggested_radius_by(&Metric::euclidean(), vectors, fewest)
}

/// The same with any distance, for [`FeatureGroups::dense_by`](crate::FeatureGroups::dense_by).
///
/// # Errors
/// As [`suggested_radius`].
pub fn suggested_radius_by(
    metric: &Metric,
    vectors: &[Vec<f64>],
    fewest: usize,
) -> Result<SuggestedRadius, Error> {
    check(vectors.iter(), 1.0)?;
    check_feature_count(vectors.len())?;
    if fewest == 0 || vectors.len() < fewest.max(2) {
        let (name, remedy) = ("a number of feature vectors", " and not below `fewest`");
        return Err(Error::BadSearch { name, value: vectors.len() as f64, remedy });
    }
    let largest = vectors.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let floor = (ROUNDING * largest).max(f64::MIN_POSITIVE);
    let (joins, dense_from) = joins(metric, vectors, fewest);
    let lengths: Vec<f64> = joins.iter().map(|join| join.length.max(floor)).collect();
    // To the next join, or to a vector that becomes a group of its own.
    let gap = |k: usize| {
        let later = dense_from.iter().copied().filter(|from| *from > lengths[k - 1]);
        [lengths[k - 1], later.fold(lengths[k], f64::min)]
    };
    let widest = |places: &mut dyn Iterator<Item = usize>| {
        let gaps = places
            .filter(|k| *k > 0)
            .map(gap)
            .filter(|[from, below]| *below > WIDE * from && below.is_finite());
        gaps.max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])))
    };
    if lengths.iter().all(|length| !length.is_finite()) {
        let (name, remedy) = ("a distance of features", ", for two of them at least");
        return Err(Error::BadSearch { name, value: f64::INFINITY, remedy });
    }
    // Gaps before two groups join; else before lone vectors come to the only group.
    let last = ((1.0 - LONE) * lengths.len() as f64) as usize;
    let groups = joined_groups(&joins, vectors.len(), fewest);
    let found = widest(&mut groups.into_iter()).or_else(|| widest(&mut (last..lengths.len())));
    Ok(match found {
        Some([from, below]) => {
            // No product or quotient of both: one may be 10³⁰⁸ and the other 10⁻³⁰⁸.
            let radius = from.sqrt() * below.sqrt();
            SuggestedRadius { radius, from, below: Some(below) }
        }
        None => {
            // Vectors that are infinitely far from all dense ones may become dense by themselves.
            let all = lengths.iter().chain(&dense_from).copied();
            let from = all.filter(|x| x.is_finite()).fold(floor, f64::max);
            SuggestedRadius { radius: (WIDE * from).min(f64::MAX), from, below: None }
        }
    })
}

/// An edge of a shortest tree.
struct Join {
    length: f64,
    vectors: [usize; 2],
}

/// The joins, by their numbers, at which two groups of at least `fewest` vectors become one.
fn joined_groups(joins: &[Join], count: usize, fewest: usize) -> Vec<usize> {
    let mut root: Vec<usize> = (0..count).collect();
    let mut size = vec![1; count];
    let mut found = Vec::new();
    for (number, join) in joins.iter().enumerate() {
        let [a, b] = join.vectors.map(|mut k| {
            while root[k] != k {
                root[k] = root[root[k]];
                k = root[k];
            }
            k
        });
        if size[a].min(size[b]) >= fewest {
            found.push(number);
        }
        let (small, large) = if size[a] < size[b] { (a, b) } else { (b, a) };
        root[small] = large;
        size[large] += size[small];
    }
    found
}

/// The edges of a shortest tree of mutual reachability, from the shortest to the longest one (R. C. Prim's algorithm), and the radii at which vectors become
/// dense.
fn joins(metric: &Metric, vectors: &[Vec<f64>], fewest: usize) -> (Vec<Join>, Vec<f64>) {
    // What has no distance is infinitely far.
    let distance = |a: &[f64], b: &[f64]| {
        let distance = metric.distance(a, b);
        if distance.is_nan() { f64::INFINITY } else { distance }
    };
    // The radius from which on a vector is dense: within it are `fewest` vectors, its own among them.
    let dense_from: Vec<f64> = vectors
        .par_iter()
        .map(|own| {
            let mut all: Vec<f64> = vectors.iter().map(|other| distance(own, other)).collect();
            *all.select_nth_unstable_by(fewest - 1, f64::total_cmp).1
        })
        .collect();
    // For each vector the shortest way to the tree, and where it leads.
    let mut nearest = vec![(f64::INFINITY, 0); vectors.len()];
    let mut is_in = vec![false; vectors.len()];
    let (mut last, mut joins) = (0, Vec::with_capacity(vectors.len() - 1));
    is_in[0] = true;
    for _ in 1..vectors.len() {
        let mut next: Option<usize> = None;
        for k in (0..vectors.len()).filter(|&k| !is_in[k]) {
            let own = distance(&vectors[last], &vectors[k]);
            let reached = own.max(dense_from[last]).max(dense_from[k]);
            if reached < nearest[k].0 {
                nearest[k] = (reached, last);
            }
            if next.is_none_or(|next| nearest[k].0 < nearest[next].0) {
                next = Some(k);
            }
        }
        let Some(next) = next else { break };
        joins.push(Join { length: nearest[next].0, vectors: [nearest[next].1, next] });
        (is_in[next], last) = (true, next);
    }
    joins.sort_by(|a, b| a.length.total_cmp(&b.length));
    (joins, dense_from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::feature_groups::FeatureGroups;
    use crate::statistics::split_mix::SplitMix64;
    use proptest::prelude::*;

    /// `count` vectors in a square of this width about each centre.
    fn around(centres: &[[f64; 2]], width: f64, count: u64, seed: u64) -> Vec<Vec<f64>> {
        let random = SplitMix64::from_seed(seed);
        let mut vectors = Vec::new();
        for (k, centre) in centres.iter().enumerate() {
            for n in 0..count {
                let part = |i: u64| random.uniform(2 * (count * k as u64 + n) + i) - 0.5;
                vectors.push(vec![centre[0] + width * part(0), centre[1] + width * part(1)]);
            }
        }
        vectors
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Planted groups are found at any scale, with some lone vectors: as many as there are, each with its own.
        #[test]
        fn planted_groups_are_found(count in 1usize..6, seed in 0u64..1000, scale in -8.0..8.0f64) {
            let unit = pxfm::f_pow(10.0, scale);
            let centres: Vec<[f64; 2]> =
                (0..count).map(|k| [unit * 4.0 * k as f64, unit * (k % 2) as f64]).collect();
            let mut vectors = around(&centres, unit, 80, seed);
            vectors.extend((0..3).map(|k| vec![unit * (2.0 + 4.0 * f64::from(k)), 40.0 * unit]));
            let found = suggested_radius(&vectors, 4).unwrap();
            let groups = FeatureGroups::dense(&vectors, found.radius, 4).unwrap();
            prop_assert_eq!(groups.labels().len(), count, "{:?}", found);
            for (k, centre) in centres.iter().enumerate() {
                prop_assert_eq!(groups.label(centre).basin_number().map(usize::from), Some(k + 1));
            }
            // The groups are the same at both ends of the gap.
            prop_assert_eq!(FeatureGroups::dense(&vectors, found.from, 4).unwrap().labels().len(), count);
            if let Some(below) = found.below {
                let just = FeatureGroups::dense(&vectors, below * (1.0 - 1e-9), 4).unwrap();
                prop_assert_eq!(just.labels().len(), count);
            }
        }
    }

    /// −1 is dense from 1 on, without a dense neighbour: the gap ends there.
    #[test]
    fn a_vector_that_becomes_dense_alone_ends_the_gap() {
        let features = [-1.0, -10.25, 0.0, -7.0, -1.93, -10.28, -9.83, -11.0].map(|x| vec![x]);
        let found = suggested_radius(&features, 3).unwrap();
        let groups = |radius| {
            let all = FeatureGroups::dense(&features, radius, 3).unwrap();
            let vectors = |label| all.vectors(label).map(<[f64]>::to_vec).collect::<Vec<_>>();
            all.labels().into_iter().map(vectors).collect::<Vec<_>>()
        };
        let end = found.below.unwrap_or(2.0 * found.radius) * (1.0 - 1e-9);
        assert_eq!(groups(found.from), groups(found.radius), "{found:?}");
        assert_eq!(groups(found.from), groups(end), "{found:?}");
    }

    #[test]
    fn equal_features_and_bad_input() {
        let same = vec![vec![3.0]; 10];
        let found = suggested_radius(&same, 3).unwrap();
        assert!(found.below.is_none() && found.radius > 0.0);
        assert_eq!(FeatureGroups::dense(&same, found.radius, 3).unwrap().labels().len(), 1);
        let two: Vec<Vec<f64>> = (0..10).map(|k| vec![f64::from(k % 2)]).collect();
        assert_eq!(suggested_radius(&two, 3).unwrap().below, Some(1.0));
        assert!(matches!(suggested_radius(&same, 11), Err(Error::BadSearch { .. })));
        assert!(matches!(suggested_radius(&same, 0), Err(Error::BadSearch { .. })));
        assert!(matches!(suggested_radius(&[], 1), Err(Error::BadSearch { .. })));
        assert!(suggested_radius(&[vec![1.0], vec![f64::NAN]], 1).is_err());
        assert!(suggested_radius(&[vec![1.0], vec![1.0, 2.0]], 1).is_err());
    }
}
