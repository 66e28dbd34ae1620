//! Attractors at two parameters, matched by their positions.

use crate::space::label::Label;
use std::collections::{BTreeMap, BTreeSet};

/// Which attractors at two parameters are the same.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AttractorMatch {
    /// Matched attractors: the label before, the label after, and their distance, or how unlike they are.
    pub pairs: Vec<(Label, Label, f64)>,
    /// Attractors before that match none after.
    pub vanished: Vec<Label>,
    /// Attractors after that match none before.
    pub appeared: Vec<Label>,
}

/// Matches attractors, given by some of their points, one to one.
///
/// The distance of two attractors is that of Hausdorff: the largest distance from a point of either one to the
/// nearest point of the other. The closest two attractors are matched first, then the closest two of the others,
/// and so on, as far as they are not farther apart than `within`. The rest is reported. (`MatchBySSSetDistance` of
/// Attractors.jl does the same; G. Datseris, K. Luiz Rossi, A. Wagemakers, Chaos 33, 073151, 2023.)
///
/// Attractors without points, of different dimensions, or with points that are not finite match none. For any other measure see
/// [`match_by`].
///
/// ```
/// use basin_of_attraction::{Label, match_attractors};
/// let [a, b, c] = [1, 2, 3].map(Label::from);
/// let before = [(a, vec![vec![0.0]]), (b, vec![vec![1.0]])].into();
/// let after = [(a, vec![vec![1.1]]), (b, vec![vec![0.2]]), (c, vec![vec![5.0]])].into();
/// let found = match_attractors(&before, &after, 0.5);
/// assert_eq!(found.pairs.iter().map(|pair| (pair.0, pair.1)).collect::<Vec<_>>(), [(b, a), (a, b)]);
/// assert_eq!((found.vanished, found.appeared), (vec![], vec![c]));
/// ```
pub fn match_attractors(
    before: &BTreeMap<Label, Vec<Vec<f64>>>,
    after: &BTreeMap<Label, Vec<Vec<f64>>>,
    within: f64,
) -> AttractorMatch {
    let distance = |one: &Label, other: &Label| {
        hausdorff(before.get(one)?, after.get(other)?).filter(|distance| *distance <= within)
    };
    match_by(before.keys().copied().collect(), after.keys().copied().collect(), distance)
}

/// Matches attractors one to one by how unlike they are: the most alike first. Two for which `unlike` is `None` do not match.
///
/// ```
/// use basin_of_attraction::{Label, match_by};
/// let [a, b] = [1, 2].map(Label::from);
/// // Mean speeds before and after.
/// let (before, after) = ([(a, 0.0), (b, 5.0)], [(a, 4.8), (b, 9.0)]);
/// let speed = |of: &[(Label, f64)], label: &Label| of.iter().find(|own| own.0 == *label).map(|own| own.1);
/// let unlike = |one: &Label, other: &Label| {
///     let off = (speed(&before, one)? - speed(&after, other)?).abs();
///     (off < 1.0).then_some(off)
/// };
/// let found = match_by([a, b].into(), [a, b].into(), unlike);
/// assert_eq!((found.pairs.len(), found.pairs[0].0, found.pairs[0].1), (1, b, a));
/// assert_eq!((found.vanished, found.appeared), (vec![a], vec![b]));
/// ```
pub fn match_by(
    mut before: BTreeSet<Label>,
    mut after: BTreeSet<Label>,
    unlike: impl Fn(&Label, &Label) -> Option<f64>,
) -> AttractorMatch {
    let mut all: Vec<(f64, Label, Label)> = Vec::new();
    for one in &before {
        let to = |other: &Label| Some((unlike(one, other)?, *one, *other));
        all.extend(after.iter().filter_map(to));
    }
    // Equal ones are taken in the order of the labels: the sort is stable.
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pairs = Vec::new();
    for (distance, one, other) in all {
        if before.contains(&one) && after.contains(&other) {
            before.remove(&one);
            after.remove(&other);
            pairs.push((one, other, distance));
        }
    }
    let (vanished, appeared) = (before.into_iter().collect(), after.into_iter().collect());
    AttractorMatch { pairs, vanished, appeared }
}

/// Hausdorff's distance of two sets of points; `None` if there is none.
pub(crate) fn hausdorff(one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<f64> {
    let dimension = one.first()?.len();
    let usable = |point: &Vec<f64>| point.len() == dimension && point.iter().all(|x| x.is_finite());
    if other.is_empty() || !one.iter().chain(other).all(usable) {
        return None;
    }
    let square =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum() };
    let farthest = |from: &[Vec<f64>], to: &[Vec<f64>]| {
        let nearest = |a: &Vec<f64>| to.iter().map(|b| square(a, b)).fold(f64::INFINITY, f64::min);
        from.iter().map(nearest).fold(0.0, f64::max)
    };
    Some(farthest(one, other).max(farthest(other, one)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attractors_are_matched_one_to_one_and_the_rest_is_reported() {
        let [a, b] = [1, 2].map(Label::from);
        let set = |label: Label, points: &[[f64; 2]]| {
            (label, points.iter().map(|point| point.to_vec()).collect::<Vec<_>>())
        };
        // Both are nearest to a: only the closer one is matched.
        let before = [set(a, &[[0.0, 0.0], [1.0, 0.0]])].into();
        let after = [set(a, &[[0.0, 0.3], [1.0, 0.0]]), set(b, &[[0.0, 0.0], [1.0, 0.1]])].into();
        let found = match_attractors(&before, &after, 1.0);
        assert_eq!((found.pairs.len(), found.appeared.clone()), (1, vec![a]));
        assert!(found.pairs[0].1 == b && (found.pairs[0].2 - 0.1).abs() < 1e-15);
        // A part is as far from the whole as its farthest point.
        let part = [set(a, &[[1.0, 0.0]])].into();
        assert_eq!(match_attractors(&before, &part, 0.9).vanished, [a]);
        assert_eq!(match_attractors(&before, &part, 1.0).pairs, [(a, a, 1.0)]);
        for bad in [vec![], vec![vec![f64::NAN, 0.0]], vec![vec![0.0]]] {
            assert!(match_attractors(&before, &[(a, bad)].into(), f64::INFINITY).pairs.is_empty());
        }
    }
}
