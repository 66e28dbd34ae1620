//! The local fractions: the shares of the fates next to a fixed point, with bounds.

use basin_of_attraction::{Bounds, Label};

/// The share of every fate in a set of phases, with bounds.
///
/// On the whole circle these are the local fractions p_{n,k} = lim |basin_k ∩ (α*_n − ε, α*_n)|/ε as ε → 0. They
/// exist and do not depend on the scale (docs/theory.md, Theorem 87). They are also the shares next to every
/// preimage of α*_n, on a side that falls.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalFractions {
    /// Labels in increasing order.
    bounds: Vec<(Label, Bounds)>,
    undecided: f64,
}

impl LocalFractions {
    /// From certain shares by label, labels in increasing order, each with an error of at most `rounding`.
    pub(crate) fn new(certain: impl Iterator<Item = (Label, f64)>, rounding: f64) -> Self {
        let certain: Vec<(Label, f64)> = certain.filter(|&(_, share)| share > 0.0).collect();
        let sum: f64 = certain.iter().map(|(_, share)| share).sum();
        let undecided = (1.0 - sum).max(0.0);
        let bound = |share: f64| Bounds {
            lower: (share - rounding).max(0.0),
            upper: (share + undecided + rounding).min(1.0),
        };
        let bounds = certain.iter().map(|&(label, share)| (label, bound(share))).collect();
        LocalFractions { bounds, undecided }
    }

    /// The same shares, each known to within `error` less well.
    pub(crate) fn widened(mut self, error: f64) -> Self {
        for (_, bounds) in &mut self.bounds {
            bounds.lower = (bounds.lower - error).max(0.0);
            bounds.upper = (bounds.upper + error).min(1.0);
        }
        self.undecided = (self.undecided + error).min(1.0);
        self
    }

    /// `part` of these shares and 1 − `part` of `other`.
    pub(crate) fn mixed(&self, part: f64, other: &LocalFractions) -> Self {
        let mut labels: Vec<Label> = self.labels().chain(other.labels()).collect();
        labels.sort_unstable();
        labels.dedup();
        let mix = |own: f64, other: f64| part * own + (1.0 - part) * other;
        let bound = |label: Label| {
            let (own, other) = (self.of(label), other.of(label));
            let (lower, upper) = (mix(own.lower, other.lower), mix(own.upper, other.upper));
            (label, Bounds { lower, upper })
        };
        let undecided = mix(self.undecided, other.undecided);
        LocalFractions { bounds: labels.into_iter().map(bound).collect(), undecided }
    }

    /// The labels that occur, in increasing order.
    pub fn labels(&self) -> impl Iterator<Item = Label> + '_ {
        self.bounds.iter().map(|&(label, _)| label)
    }

    /// The share of `label`. The lower bound counts the phases that certainly have the label, the upper bound adds
    /// all that are undecided.
    pub fn of(&self, label: Label) -> Bounds {
        let found = self.bounds.iter().find(|(own, _)| *own == label);
        found.map_or(Bounds { lower: 0.0, upper: self.undecided }, |&(_, bounds)| bounds)
    }

    /// The certain share of `label`.
    pub(crate) fn certain(&self, label: Label) -> f64 {
        self.of(label).lower
    }

    /// The share without a label.
    pub fn undecided(&self) -> f64 {
        self.undecided
    }
}
