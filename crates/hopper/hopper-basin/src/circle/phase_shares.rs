//! Labelled intervals of the circle with the sums of their lengths: labels and shares by binary search.

use basin_of_attraction::Label;

/// An interval of phases that all have one label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhasePart {
    /// Lowest phase, in [0, 1).
    pub from: f64,
    /// Highest phase, in (0, 1].
    pub to: f64,
    /// The [label](crate::HopperFate::label).
    pub label: Label,
}

/// Disjoint parts in increasing order, with sums.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PhaseShares {
    parts: Vec<PhasePart>,
    /// In increasing order.
    labels: Vec<Label>,
    /// Row k has the length of every label in the first k parts.
    sums: Vec<f64>,
}

impl PhaseShares {
    pub(crate) fn new(parts: Vec<PhasePart>) -> Self {
        let mut labels: Vec<Label> = parts.iter().map(|part| part.label).collect();
        labels.sort_unstable();
        labels.dedup();
        let mut sums = vec![0.0; labels.len()];
        let mut row = sums.clone();
        for part in &parts {
            if let Ok(at) = labels.binary_search(&part.label) {
                row[at] += part.to - part.from;
            }
            sums.extend_from_slice(&row);
        }
        PhaseShares { parts, labels, sums }
    }

    pub(crate) fn parts(&self) -> &[PhasePart] {
        &self.parts
    }

    /// The label of all phases within `error` of `phase`; `None` if they have none, or several.
    pub(crate) fn label(&self, phase: f64, error: f64) -> Option<Label> {
        if !(phase.is_finite() && error >= 0.0) {
            return None;
        }
        let phase = phase - phase.floor();
        let at = self.parts.partition_point(|part| part.to < phase);
        let part = self.parts.get(at).filter(|part| part.from <= phase)?;
        let (first, last) = (self.parts.first()?, self.parts.last()?);
        // Phases 0 and 1 are one point of the circle.
        let joined = first.from == 0.0 && last.to == 1.0 && first.label == last.label;
        let (mut from, mut to) = (part.from, part.to);
        if joined && from == 0.0 {
            from = last.from - 1.0;
        }
        if joined && to == 1.0 {
            to = 1.0 + first.to;
        }
        let whole = self.parts.len() == 1 && to - from >= 1.0;
        (whole || (from <= phase - error && phase + error <= to)).then_some(part.label)
    }

    /// The length of every label in a number of turns from `from` on.
    pub(crate) fn lengths(&self, from: f64, turns: f64) -> impl Iterator<Item = (Label, f64)> + '_ {
        let start = from - from.floor();
        let whole = turns.floor();
        let end = start + (turns - whole);
        // The rest ends in this turn or in the next one.
        let (end, next) = if end > 1.0 { (end - 1.0, 1.0) } else { (end, 0.0) };
        (0..self.labels.len()).map(move |at| {
            let all = self.row(self.parts.len(), at);
            let rest = self.below(end, at) - self.below(start, at);
            (self.labels[at], (whole + next) * all + rest)
        })
    }

    fn row(&self, parts: usize, label: usize) -> f64 {
        self.sums[parts * self.labels.len() + label]
    }

    /// The length of a label in [0, phase].
    fn below(&self, phase: f64, label: usize) -> f64 {
        let at = self.parts.partition_point(|part| part.to <= phase);
        let rest = self.parts.get(at).filter(|part| part.label == self.labels[label]);
        self.row(at, label) + rest.map_or(0.0, |part| (phase - part.from).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle() -> PhaseShares {
        let part = |from, to, label: u8| PhasePart { from, to, label: label.into() };
        PhaseShares::new(vec![part(0.0, 0.25, 0), part(0.25, 0.5, 1), part(0.625, 1.0, 0)])
    }

    #[test]
    fn labels_hold_for_all_phases_within_the_error() {
        let circle = circle();
        assert_eq!(circle.label(0.125, 0.0625), Some(Label::from(0)));
        assert_eq!(circle.label(0.125, 0.126), None);
        assert_eq!(circle.label(0.55, 0.0), None);
        // Through phase 0, and from another turn.
        assert_eq!(circle.label(0.0, 0.25), Some(Label::from(0)));
        assert_eq!(circle.label(-7.0 + 0.9, 0.2), Some(Label::from(0)));
        assert_eq!(circle.label(0.9, 0.3), None);
        assert_eq!(circle.label(f64::NAN, 0.0), None);
        assert_eq!(circle.label(0.1, f64::NAN), None);
    }

    #[test]
    fn lengths_add_whole_turns_and_the_rest() {
        let circle = circle();
        let lengths = |from, turns| circle.lengths(from, turns).map(|(_, l)| l).collect::<Vec<_>>();
        assert_eq!(lengths(0.0, 1.0), [0.625, 0.25]);
        assert_eq!(lengths(0.875, 0.5), [0.375, 0.125]);
        assert_eq!(lengths(0.875, 3.5), [3.0 * 0.625 + 0.375, 3.0 * 0.25 + 0.125]);
        assert_eq!(lengths(-1.125, 0.5), lengths(0.875, 0.5));
        assert_eq!(lengths(0.3, 0.0), [0.0, 0.0]);
    }
}
