//! One label for an attractor at all parameters.

use crate::error::Error;
use crate::parameters::fractions_along::UnmatchedAttractor;
use crate::parameters::matching::Matching;
use crate::shares::fractions::Fractions;
use crate::space::label::Label;
use std::collections::{BTreeMap, BTreeSet};

/// Gives each attractor one label at all parameters, and reports those that appear or vanish.
///
/// One that vanished is remembered: if one appears that matches it, it has come back, and has its label.
pub(crate) fn with_common_labels(
    points: &mut [(f64, Fractions)],
    matching: &Matching<'_>,
) -> Result<Vec<UnmatchedAttractor>, Error> {
    let mut unmatched = Vec::new();
    let first = match points.first() {
        Some(first) if !matches!(matching, Matching::ByLabel) => first,
        _ => return Ok(unmatched),
    };
    // Labels that are taken. What was known at the last parameter has common labels already.
    let mut taken: BTreeSet<Label> = first.1.labels_of_attractors();
    let mut last = first.clone();
    let mut vanished = Fractions::default();
    for (parameter, fractions) in points.iter_mut().skip(1) {
        let (from, to) = (last.0, *parameter);
        let mut after = (to, std::mem::take(fractions));
        let found = matching.partners(&last, &after);
        let mut common: BTreeMap<Label, Label> =
            found.pairs.iter().map(|&(before, after, _)| (after, before)).collect();
        for label in found.vanished {
            unmatched.push(UnmatchedAttractor { from, to, label, appears: false });
            remember(&mut vanished, &last.1, label);
        }
        // Those that come back.
        let only = restricted(&after.1, &found.appeared);
        let back = matching.partners(&(from, vanished.clone()), &(to, only));
        common.extend(back.pairs.iter().map(|&(before, after, _)| (after, before)));
        for own in found.appeared {
            let label = match common.get(&own) {
                Some(label) => *label,
                None => free_label(own, &taken)?,
            };
            forget(&mut vanished, label);
            taken.insert(label);
            common.insert(own, label);
            unmatched.push(UnmatchedAttractor { from, to, label, appears: true });
        }
        after.1 = renamed(after.1, &common);
        fractions.clone_from(&after.1);
        last = after;
    }
    Ok(unmatched)
}

/// What is known of some attractors alone.
fn restricted(of: &Fractions, to: &[Label]) -> Fractions {
    let mut own = of.clone();
    own.found.retain(|label, _| to.contains(label));
    own.attractors.retain(|label, _| to.contains(label));
    own
}

/// Keeps what was known of an attractor that vanishes; of the points that belonged to it the labels.
fn remember(vanished: &mut Fractions, last: &Fractions, label: Label) {
    vanished.found.extend(last.found.get(&label).map(|range| (label, *range)));
    vanished.attractors.extend(last.attractors.get(&label).map(|points| (label, points.clone())));
    vanished.labels.resize(last.labels.len().max(vanished.labels.len()), Label::OUTSIDE);
    for (kept, _) in vanished.labels.iter_mut().zip(&last.labels).filter(|(_, own)| **own == label)
    {
        *kept = label;
    }
}

fn forget(vanished: &mut Fractions, label: Label) {
    vanished.found.remove(&label);
    vanished.attractors.remove(&label);
    vanished.labels.iter_mut().filter(|own| **own == label).for_each(|own| *own = Label::OUTSIDE);
}

fn renamed(of: Fractions, common: &BTreeMap<Label, Label>) -> Fractions {
    let new = |label: Label| common.get(&label).copied().unwrap_or(label);
    Fractions {
        found: of.found.into_iter().map(|(own, range)| (new(own), range)).collect(),
        attractors: of.attractors.into_iter().map(|(own, points)| (new(own), points)).collect(),
        labels: of.labels.into_iter().map(new).collect(),
        ..of
    }
}

/// `wanted`, or the first basin that is not taken.
fn free_label(wanted: Label, taken: &BTreeSet<Label>) -> Result<Label, Error> {
    let free = |label: &Label| !taken.contains(label);
    let others = (1..=u16::MAX).filter_map(Label::basin);
    let found = std::iter::once(wanted).chain(others).find(free);
    found.ok_or(Error::TooManyAttractors { most: taken.len() })
}
