//! The fractions of all basins at one parameter, each with the range in which it lies.

use crate::error::Error;
use crate::line::interval_basins::IntervalBasins;
use crate::shares::region_fractions::LabelCounts;
use crate::shares::sampling::EquallySpacedFraction;
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;
use crate::statistics::confidence_interval::{ConfidenceInterval, proportion_interval};
use std::collections::{BTreeMap, BTreeSet};

/// A basin fraction with its range: bounds, or a 95 % interval. The source of the fraction says which.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FractionRange {
    /// The fraction that was found. It need not be the middle of the range.
    pub value: f64,
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl FractionRange {
    /// Half the length of the range.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    /// The distance between two ranges; 0 if they have a number in common.
    pub fn gap(&self, other: &FractionRange) -> f64 {
        (self.lower - other.upper).max(other.lower - self.upper).max(0.0)
    }
}

impl From<ConfidenceInterval> for FractionRange {
    fn from(ConfidenceInterval { value, lower, upper }: ConfidenceInterval) -> Self {
        FractionRange { value, lower, upper }
    }
}

impl From<EquallySpacedFraction> for FractionRange {
    fn from(EquallySpacedFraction { value, bounds }: EquallySpacedFraction) -> Self {
        FractionRange { value, lower: bounds.lower, upper: bounds.upper }
    }
}

/// The fractions of all basins at one parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fractions {
    /// The fraction of each basin that was found.
    pub found: BTreeMap<Label, FractionRange>,
    /// The largest fraction that any other basin can have: what is undecided, or what so many points may have missed.
    pub unseen: f64,
    /// Some points of the attractor of each basin. They are needed if attractors are matched by their positions
    /// ([`Matching::Nearest`](crate::Matching)); else leave this empty.
    pub attractors: BTreeMap<Label, Vec<Vec<f64>>>,
    /// The labels of some points, the same at all parameters, if attractors are matched by the overlap of their basins; else empty.
    pub labels: Vec<Label>,
}

impl Fractions {
    /// The fraction of a basin. One that was not found has the value 0, and a range up to [`unseen`](Self::unseen).
    pub fn of(&self, label: Label) -> FractionRange {
        let none = FractionRange { value: 0.0, lower: 0.0, upper: self.unseen };
        self.found.get(&label).copied().unwrap_or(none)
    }

    /// The fractions of random points, with 95 % intervals.
    ///
    /// # Errors
    /// As [`LabelCounts::fraction`].
    pub fn from_counts(counts: &LabelCounts) -> Result<Fractions, Error> {
        let fraction = |label| Ok((label, counts.fraction(label)?.into()));
        let found = counts.basins().map(fraction).collect::<Result<_, Error>>()?;
        let unseen = proportion_interval(counts.undecided(), counts.inside())?.upper;
        Ok(Fractions { found, unseen, ..Fractions::default() })
    }

    /// The fractions of a window, with the bounds of [`IntervalBasins::basin_length`].
    ///
    /// # Errors
    /// [`Error::BadInterval`] for a window of length 0.
    pub fn from_intervals(basins: &IntervalBasins) -> Result<Fractions, Error> {
        let (window, length) = (basins.window(), basins.window().length());
        if length <= 0.0 {
            return Err(Error::BadInterval { left: window.left, right: window.right });
        }
        let fraction = |label| {
            let Bounds { lower, upper } = basins.basin_length(label);
            let value = basins.resolved_length(label) / length;
            (label, FractionRange { value, lower: lower / length, upper: upper / length })
        };
        let found = basins.labels().into_iter().map(fraction).collect();
        let unseen = basins.undecided() / length;
        Ok(Fractions { found, unseen, ..Fractions::default() })
    }

    /// The same fractions with the points of the attractors, for [`Matching::Nearest`](crate::Matching).
    #[must_use]
    pub fn with_attractors(self, attractors: BTreeMap<Label, Vec<Vec<f64>>>) -> Fractions {
        Fractions { attractors, ..self }
    }

    /// The labels of all attractors: an escape is the same fate at all parameters, and none.
    pub(crate) fn labels_of_attractors(&self) -> BTreeSet<Label> {
        let all = self.found.keys().chain(self.attractors.keys()).copied();
        all.filter(|label| label.basin_number().is_some()).collect()
    }

    /// The same fractions with the labels of some points, for [`Matching::Overlap`](crate::Matching).
    #[must_use]
    pub fn with_labels(self, labels: Vec<Label>) -> Fractions {
        Fractions { labels, ..self }
    }

    /// The fractions of groups of attractors: `group` has the new label of one, from its own label and its points. A range of a group reaches
    /// from the sum of the lower ends to that of the upper ends, and to 1 at most.
    #[must_use]
    pub fn aggregated(&self, group: impl Fn(Label, &[Vec<f64>]) -> Label) -> Fractions {
        let none: Vec<Vec<f64>> = Vec::new();
        let new = |own: Label| group(own, self.attractors.get(&own).unwrap_or(&none));
        let mut sums = Fractions { unseen: self.unseen, ..Fractions::default() };
        for (&own, range) in &self.found {
            let nothing = FractionRange { value: 0.0, lower: 0.0, upper: 0.0 };
            let sum = sums.found.entry(new(own)).or_insert(nothing);
            sum.value += range.value;
            sum.lower += range.lower;
            sum.upper = (sum.upper + range.upper).min(1.0);
        }
        for (&own, points) in &self.attractors {
            sums.attractors.entry(new(own)).or_default().extend_from_slice(points);
        }
        sums.labels =
            self.labels.iter().map(|&own| if own.is_decided() { new(own) } else { own }).collect();
        sums
    }
}
