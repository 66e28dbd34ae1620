//! How attractors at neighbouring parameters are recognised as the same.

use crate::parameters::attractor_match::{AttractorMatch, hausdorff, match_by};
use crate::shares::fractions::Fractions;
use crate::space::label::Label;
use std::collections::BTreeMap;

/// How attractors at neighbouring parameters are recognised as the same.
#[derive(Clone, Copy, Default)]
pub enum Matching<'a> {
    /// The same label is the same attractor.
    #[default]
    ByLabel,
    /// By Hausdorff's distance of their points, if it is at most this ([`match_attractors`](crate::match_attractors)).
    Nearest {
        /// The largest distance of two attractors that are the same.
        within: f64,
    },
    /// By how unlike their points are; `None` for two that are not the same.
    By(&'a Unlike<'a>),
    /// By the overlap of their basins: the points that belong to both, as a part of those that belong to one of them, is at least `least`. The same
    /// points must have been labelled at both parameters ([`Fractions::with_labels`]).
    Overlap {
        /// The smallest overlap.
        least: f64,
    },
    /// By the flow: the label that a point of the attractor before has at the parameter after. If several come to one attractor, the nearest one
    /// is the same, by Hausdorff's distance.
    Flow(&'a LabelAt<'a>),
}

/// How unlike two sets of points are; `None` for different attractors.
pub type Unlike<'a> = dyn Fn(&[Vec<f64>], &[Vec<f64>]) -> Option<f64> + Sync + 'a;

/// The label of a point at a parameter.
pub type LabelAt<'a> = dyn Fn(f64, &[f64]) -> Label + Sync + 'a;

impl Matching<'_> {
    /// Which attractors at two parameters are the same. One without points is its label.
    pub(crate) fn partners(
        &self,
        (_, before): &(f64, Fractions),
        (parameter, after): &(f64, Fractions),
    ) -> AttractorMatch {
        let (one, other) = (before.labels_of_attractors(), after.labels_of_attractors());
        let between = |of: &Unlike<'_>, a: &Label, b: &Label| {
            match (before.attractors.get(a), after.attractors.get(b)) {
                (Some(a), Some(b)) => of(a, b),
                // Without points the label is all that there is.
                (None, None) => (a == b).then_some(0.0),
                _ => None,
            }
        };
        let mut found = match self {
            Matching::ByLabel => match_by(one, other, |a, b| (a == b).then_some(0.0)),
            Matching::Nearest { within } => {
                let near = |a: &[Vec<f64>], b: &[Vec<f64>]| {
                    hausdorff(a, b).filter(|distance| distance <= within)
                };
                match_by(one, other, |a, b| between(&near, a, b))
            }
            Matching::By(unlike) => match_by(one, other, |a, b| between(unlike, a, b)),
            Matching::Overlap { least } => {
                let shared = shared(&before.labels, &after.labels);
                match_by(one, other, |a, b| {
                    let overlap = overlap(&shared, *a, *b);
                    (overlap > 0.0 && overlap >= *least).then_some(1.0 - overlap)
                })
            }
            Matching::Flow(label) => {
                let first = |own: &Label| before.attractors.get(own)?.first();
                let comes: BTreeMap<Label, Label> =
                    one.iter().filter_map(|a| Some((*a, label(*parameter, first(a)?)))).collect();
                match_by(one, other, |a, b| {
                    let same = comes
                        .get(a)
                        .map_or(a == b && !after.attractors.contains_key(b), |to| to == b);
                    let distance =
                        || between(&|a: &[Vec<f64>], b: &[Vec<f64>]| hausdorff(a, b), a, b);
                    same.then(|| distance().unwrap_or(0.0))
                })
            }
        };
        let escapes = |own: &Fractions| own.found.contains_key(&Label::ESCAPED);
        if escapes(before) || escapes(after) {
            found.pairs.push((Label::ESCAPED, Label::ESCAPED, 0.0));
        }
        found
    }
}

/// How many of the points that were labelled twice have each pair of labels.
fn shared(before: &[Label], after: &[Label]) -> BTreeMap<(Label, Label), usize> {
    let mut found = BTreeMap::new();
    for pair in before.iter().copied().zip(after.iter().copied()) {
        *found.entry(pair).or_insert(0) += 1;
    }
    found
}

/// The points in both basins as a part of those in one of them; 0 without any.
fn overlap(shared: &BTreeMap<(Label, Label), usize>, a: Label, b: Label) -> f64 {
    let both = shared.get(&(a, b)).copied().unwrap_or(0);
    let either: usize =
        shared.iter().filter(|((one, other), _)| *one == a || *other == b).map(|(_, n)| n).sum();
    if either == 0 { 0.0 } else { both as f64 / either as f64 }
}
