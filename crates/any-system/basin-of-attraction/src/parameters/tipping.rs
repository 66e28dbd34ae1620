//! Tipping between two parameters: the intersections of the basins at both.

use crate::error::Error;
use crate::line::interval_basins::IntervalBasins;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;
use crate::statistics::confidence_interval::{ConfidenceInterval, proportion_interval};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

/// The amounts of the window that have one label before and another one after; `None` is undecided.
///
/// The amount is a length or a number of points.
type Amounts<T> = BTreeMap<(Option<Label>, Option<Label>), T>;

/// The sums of amounts that bound a conditional probability from `from` to `to`.
struct Sums<T> {
    /// Both labels are known to be these.
    both: T,
    /// Both labels are these, or undecided.
    possible: T,
    /// Known to be `from` before, and known not to be `to` after.
    known_other: T,
    /// `from` or undecided before, and not known to be `to` after, or undecided before and `to` after left out.
    possible_other: T,
}

fn sums<T: Copy + Default + std::ops::AddAssign>(
    amounts: &Amounts<T>,
    from: Label,
    to: Label,
) -> Sums<T> {
    let mut sums = Sums {
        both: T::default(),
        possible: T::default(),
        known_other: T::default(),
        possible_other: T::default(),
    };
    for (&(before, after), &amount) in amounts {
        // A part that is surely of another basin before does not count at all.
        if before.is_some_and(|label| label != from) {
            continue;
        }
        let (certain, hits) = (before.is_some(), after == Some(to));
        if certain && hits {
            sums.both += amount;
        }
        if hits || after.is_none() {
            sums.possible += amount;
        }
        if certain && !hits && after.is_some() {
            sums.known_other += amount;
        }
        if !hits {
            sums.possible_other += amount;
        }
    }
    sums
}

/// How much of a window goes from which basin before to which basin after, with bounds from what is undecided.
#[derive(Debug, Clone, PartialEq)]
pub struct Tipping {
    lengths: Amounts<f64>,
    window: f64,
    /// The most by which rounding changes a length.
    rounding: f64,
}

impl IntervalBasins {
    /// The intersections of these basins with the basins `after`, at another parameter.
    ///
    /// A state is in basin a when the parameter changes at once. The new map takes it to the attractor of the basin
    /// b that contains it there. The probability of b, if a state is equally likely anywhere in a, is |a ∩ b| / |a|
    /// (B. Kaszás, U. Feudel, T. Tél, Sci. Rep. 9, 8654, 2019; `tipping_probabilities` of Attractors.jl).
    ///
    /// ```
    /// use basin_of_attraction::{Interval, Label, Refinement, interval_basins};
    /// // The basins of −1 and 1 under x → 3x/2 − x³/2 + c meet at x = 0 for c = 0, and at another point for another c.
    /// # let known = |at: f64| -> Result<_, basin_of_attraction::Error> {
    /// #     let (zero, one) = (Interval::new(-1.0, at)?, Interval::new(at.next_up(), 1.0)?);
    /// #     basin_of_attraction::interval_basins_from_known(&|x: f64| Some(x), &[(zero, 0.into()), (one, 1.into())], &[],
    /// #         Interval::new(-1.0, 1.0)?, Refinement::default())
    /// # };
    /// let (before, after) = (known(0.0)?, known(0.25)?);
    /// let tipping = before.tipping_to(&after)?;
    /// let [zero, one] = [0, 1].map(Label::from);
    /// assert!(tipping.probability(one, zero).is_some_and(|p| p.covers(0.25) && p.half_width() < 1e-12));
    /// assert!(tipping.probability(zero, one).is_some_and(|p| p.upper < 1e-12));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OtherWindow`] unless both have the same window, of a positive length.
    pub fn tipping_to(&self, after: &IntervalBasins) -> Result<Tipping, Error> {
        let (window, other) = (self.window(), after.window());
        if window != other || window.length() <= 0.0 {
            return Err(Error::OtherWindow {
                left: window.left,
                right: window.right,
                other_left: other.left,
                other_right: other.right,
            });
        }
        let (one, two) = (with_gaps(self), with_gaps(after));
        let mut lengths: Amounts<f64> = BTreeMap::new();
        let (mut i, mut k, mut at) = (0, 0, window.left);
        while let (Some(&(end, before)), Some(&(other_end, after))) = (one.get(i), two.get(k)) {
            let next = end.min(other_end);
            if next > at {
                *lengths.entry((before, after)).or_insert(0.0) += next - at;
                at = next;
            }
            i += usize::from(end <= next);
            k += usize::from(other_end <= next);
        }
        // For every part an ulp for each of its ends, and one for the rounding of the sum.
        let parts = self.intervals().len() + after.intervals().len();
        let ulp = f64::EPSILON * window.left.abs().max(window.right.abs());
        Ok(Tipping { lengths, window: window.length(), rounding: 3.0 * parts as f64 * ulp })
    }
}

/// The right ends and labels of all intervals and gaps of a window, from left to right.
fn with_gaps(basins: &IntervalBasins) -> Vec<(f64, Option<Label>)> {
    let mut all = Vec::with_capacity(2 * basins.intervals().len() + 1);
    for part in basins.intervals() {
        all.push((part.interval.left, None));
        all.push((part.interval.right, Some(part.label)));
    }
    all.push((basins.window().right, None));
    all
}

impl Tipping {
    /// The same with other labels, such as one for the union of several basins. A label that is no basin is undecided.
    #[must_use]
    pub fn relabelled(self, label: impl Fn(Label) -> Label) -> Self {
        Tipping { lengths: relabelled(&self.lengths, label), ..self }
    }

    /// The labels that occur before, or after.
    pub fn labels(&self) -> Vec<Label> {
        labels(&self.lengths)
    }

    /// The fraction of the window that goes from basin `from` to basin `to`.
    pub fn fraction(&self, from: Label, to: Label) -> Bounds {
        let Sums { both, .. } = sums(&self.lengths, from, to);
        let possible: f64 = self
            .lengths
            .iter()
            .filter(|((before, after), _)| {
                before.is_none_or(|label| label == from) && after.is_none_or(|label| label == to)
            })
            .map(|(_, length)| length)
            .sum();
        Bounds {
            lower: ((both - self.rounding) / self.window).max(0.0),
            upper: ((possible + self.rounding) / self.window).min(1.0),
        }
    }

    /// The probability that a state of basin `from` goes to basin `to`; `None` if no interval of `from` is known.
    ///
    /// The bounds hold as those of [`IntervalBasins::basin_length`] do: everything that is undecided before or
    /// after may belong to any basin.
    pub fn probability(&self, from: Label, to: Label) -> Option<Bounds> {
        let known = self.lengths.keys().any(|&(before, _)| before == Some(from));
        let Sums { both, possible, known_other, possible_other } = sums(&self.lengths, from, to);
        let low = (both - self.rounding).max(0.0);
        let high = possible + self.rounding;
        let fewest = (known_other - self.rounding).max(0.0);
        known.then(|| Bounds {
            lower: low / (low + possible_other + self.rounding),
            upper: high / (high + fewest),
        })
    }
}

fn labels<T>(amounts: &Amounts<T>) -> Vec<Label> {
    let all = amounts.keys().flat_map(|&(before, after)| [before, after]).flatten();
    all.collect::<BTreeSet<Label>>().into_iter().collect()
}

/// The amounts with other labels; a label that is no basin is undecided.
fn relabelled<T: Copy + Default + std::ops::AddAssign>(
    amounts: &Amounts<T>,
    label: impl Fn(Label) -> Label,
) -> Amounts<T> {
    let renamed = |own: Option<Label>| own.map(&label).filter(|label| label.is_decided());
    let mut all: Amounts<T> = BTreeMap::new();
    for (&(before, after), &amount) in amounts {
        *all.entry((renamed(before), renamed(after))).or_default() += amount;
    }
    all
}

/// Random points, counted by their labels before and after.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TippingCounts {
    counts: Amounts<usize>,
    inside: usize,
}

impl TippingCounts {
    /// The same with other labels, such as one for the union of several basins. A label that is no basin is undecided.
    #[must_use]
    pub fn relabelled(self, label: impl Fn(Label) -> Label) -> Self {
        TippingCounts { counts: relabelled(&self.counts, label), ..self }
    }

    /// Counts pairs of labels, before and after. A point that is outside before or after is not counted.
    ///
    /// # Errors
    /// [`Error::NothingInside`] if no point is counted.
    pub fn new(pairs: impl IntoIterator<Item = (Label, Label)>) -> Result<Self, Error> {
        let (mut counts, mut points): (Amounts<usize>, usize) = (BTreeMap::new(), 0);
        let decided = |label: Label| label.is_decided().then_some(label);
        for (before, after) in pairs {
            points += 1;
            if !before.is_outside() && !after.is_outside() {
                *counts.entry((decided(before), decided(after))).or_insert(0) += 1;
            }
        }
        let inside = counts.values().sum();
        if inside == 0 {
            return Err(Error::NothingInside { points });
        }
        Ok(TippingCounts { counts, inside })
    }

    /// The labels that occur before, or after.
    pub fn labels(&self) -> Vec<Label> {
        labels(&self.counts)
    }

    /// The number of points inside the region of interest.
    pub fn inside(&self) -> usize {
        self.inside
    }

    /// The number of points that go from one basin to another, or stay.
    pub fn count(&self, from: Label, to: Label) -> usize {
        self.counts.get(&(Some(from), Some(to))).copied().unwrap_or(0)
    }

    /// The probability that a state of basin `from` goes to basin `to`, with a 95 % interval; `None` if no point
    /// was in `from`.
    ///
    /// The value counts decided points only. The ends of the interval count undecided points in the worst way.
    ///
    /// # Errors
    /// None for counts that [`new`](Self::new) made.
    pub fn probability(&self, from: Label, to: Label) -> Result<Option<ConfidenceInterval>, Error> {
        let Sums { both, possible, known_other, possible_other } = sums(&self.counts, from, to);
        if both + known_other == 0 {
            return Ok(None);
        }
        let value = both as f64 / (both + known_other) as f64;
        let lower = proportion_interval(both, both + possible_other)?.lower;
        let upper = proportion_interval(possible, possible + known_other)?.upper;
        Ok(Some(ConfidenceInterval { value, lower, upper }))
    }
}

/// The labels of `count` independent random points of a region before and after a change.
///
/// `before` and `after` label the same point: by the map before, and by the map after, or by the orbit along a
/// drift of the parameters ([`label_after_drift`]). The same seed gives the same points, with any number of
/// threads.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, Label, random_tipping};
/// let line = Interval::new(0.0, 1.0)?.try_into()?;
/// let right_of = |c: f64| move |x: &[f64]| Label::from(x[0] > c);
/// let found = random_tipping(&line, 10_000, 1, right_of(0.5), right_of(0.6))?;
/// let tips = found.probability(Label::from(1), Label::from(0))?.expect("points on the right");
/// assert!(tips.covers(0.2) && tips.half_width() < 0.02);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooManySamples`] for more than a billion points; [`Error::NothingInside`] if no point is counted, also
/// for a `count` of 0.
pub fn random_tipping(
    region: &Hyperrectangle,
    count: usize,
    seed: u64,
    before: impl Fn(&[f64]) -> Label + Sync,
    after: impl Fn(&[f64]) -> Label + Sync,
) -> Result<TippingCounts, Error> {
    check_count(count)?;
    let random = SplitMix64::from_seed(seed);
    let one = |k: usize| {
        let point = region.random_point(&random, k as u64);
        (before(&point), after(&point))
    };
    TippingCounts::new((0..count).into_par_iter().map(one).collect::<Vec<_>>())
}

/// The label of a state after `steps` steps of a map that changes from step to step.
///
/// `step` gives the state after step k = 0, 1, …, or the label of an orbit that ends there. `label` gives the label
/// of the last state at the last parameters. So a slow change of a parameter is followed by the orbit, and not by
/// its attractor.
///
/// ```
/// use basin_of_attraction::{Label, label_after_drift};
/// use std::ops::ControlFlow::Continue;
/// // 0 attracts x → x/2 for |x| < c, and c shrinks from 1 to 0.1: a fast change leaves the state outside, a slow one does not.
/// let label = |x: f64| Label::from(x.abs() >= 0.1);
/// let after = |steps: usize| {
///     let edge = |k: usize| 1.0 - 0.9 * (k + 1) as f64 / steps as f64;
///     label_after_drift(0.9, steps, |k, x| Continue(if x < edge(k) { 0.5 * x } else { 2.0 * x }), label)
/// };
/// assert_eq!((after(1), after(20)), (Label::from(1), Label::from(0)));
/// ```
pub fn label_after_drift<S>(
    start: S,
    steps: usize,
    mut step: impl FnMut(usize, S) -> ControlFlow<Label, S>,
    label: impl FnOnce(S) -> Label,
) -> Label {
    match (0..steps).try_fold(start, |state, k| step(k, state)) {
        ControlFlow::Continue(state) => label(state),
        ControlFlow::Break(label) => label,
    }
}
