//! The basins of a scalar map as labelled intervals, and the length left undecided.

use crate::error::Error;
use crate::line::probes::TrapGround;
use crate::line::refinement::StopReason;
use crate::shares::sampling::check_window;
use crate::space::interval::{Interval, IntervalSet};
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;
use std::collections::BTreeMap;

/// An interval whose points all have one fate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelledInterval {
    /// The interval.
    pub interval: Interval,
    /// The label of the trap that its orbits enter.
    pub label: Label,
    /// The number of steps after which the orbits enter the trap; `None` if it is not counted, or not the same for
    /// all of them.
    pub level: Option<usize>,
}

/// The basins in a window, as disjoint labelled intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalBasins {
    pub(crate) window: Interval,
    /// Disjoint, from left to right, inside the window.
    pub(crate) parts: Vec<LabelledInterval>,
    pub(crate) stop_reason: StopReason,
    /// What shows that each trap is one; empty if the caller knows it.
    pub(crate) grounds: Vec<TrapGround>,
}

/// The sum of the lengths.
pub(crate) fn total_length(parts: &[LabelledInterval]) -> f64 {
    parts.iter().map(|part| part.interval.length()).sum()
}

impl IntervalBasins {
    /// Intervals that are known from elsewhere, without levels: disjoint, from left to right. Their parts outside
    /// the window are left out, and so are intervals whose label is no basin. The reason tells why no more is
    /// known.
    ///
    /// ```
    /// use basin_of_attraction::{Interval, IntervalBasins, StopReason};
    /// let (low, high) = (Interval::new(0.0, 0.25)?, Interval::new(0.5, 1.0)?);
    /// let known = [(low, 1.into()), (high, 2.into())];
    /// let window = Interval::new(0.0, 1.0)?;
    /// let basins = IntervalBasins::from_known(window, &known, StopReason::AllFollowed)?;
    /// assert_eq!((basins.label(0.75), basins.undecided()), (Some(2.into()), 0.25));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadInterval`] for a window as for [`within`](Self::within), and for an interval that is reversed or
    /// not finite, or that begins before the end of the one before.
    pub fn from_known(
        window: Interval,
        known: &[(Interval, Label)],
        stop_reason: StopReason,
    ) -> Result<IntervalBasins, Error> {
        let part = |&(interval, label): &(Interval, Label)| LabelledInterval {
            interval,
            label,
            level: None,
        };
        let all = Self::from_parts(window, known.iter().map(part).collect(), stop_reason)?;
        Ok(all.within(window)?.without_undecided())
    }

    /// The intervals that [`intervals`](Self::intervals) gave, with their levels: to take up what was stored.
    ///
    /// # Errors
    /// [`Error::BadInterval`] unless they are disjoint and from left to right.
    pub fn from_parts(
        window: Interval,
        parts: Vec<LabelledInterval>,
        stop_reason: StopReason,
    ) -> Result<IntervalBasins, Error> {
        let mut end = f64::NEG_INFINITY;
        for LabelledInterval { interval: Interval { left, right }, .. } in &parts {
            Interval::new(*left, *right)?;
            Interval::new(end.max(f64::MIN), *left)?;
            end = *right;
        }
        Ok(IntervalBasins { window, parts, stop_reason, grounds: Vec::new() })
    }

    /// The window.
    pub fn window(&self) -> Interval {
        self.window
    }

    /// The same basins in a smaller window. A part of it outside this window is undecided.
    ///
    /// # Errors
    /// [`Error::BadInterval`] for a window that is reversed, or whose length is not finite.
    pub fn within(&self, window: Interval) -> Result<IntervalBasins, Error> {
        check_window(window)?;
        let cut = |part: &LabelledInterval| {
            part.interval
                .intersection(&window)
                .map(|interval| LabelledInterval { interval, ..*part })
        };
        let parts = self.parts.iter().filter_map(cut).collect();
        Ok(IntervalBasins {
            window,
            parts,
            stop_reason: self.stop_reason,
            grounds: self.grounds.clone(),
        })
    }

    /// The same intervals with other labels, such as their levels or the union of several basins. An interval whose
    /// new label is no basin is undecided.
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, Label, Refinement, interval_basins};
    /// let halve = |x: f64| Some(0.5 * x);
    /// let branch = Branch { domain: Interval::new(0.0, 1.0)?, at_left: 0.0, at_right: 0.5 };
    /// let (trap, window) = (Interval::new(0.0, 0.125)?, Interval::new(0.0, 1.0)?);
    /// let limits = Refinement::default();
    /// let basin = interval_basins(&halve, &[(trap, Label::from(1))], &[branch], window, limits)?;
    /// let steps = basin.relabelled(|part| Label::from(part.level.unwrap_or(0) as u8));
    /// assert_eq!(steps.label(0.2), Some(Label::from(1)));
    /// assert_eq!(steps.label(0.8), Some(Label::from(3)));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    #[must_use]
    pub fn relabelled(mut self, label: impl Fn(&LabelledInterval) -> Label) -> IntervalBasins {
        for part in &mut self.parts {
            part.label = label(part);
        }
        self.without_undecided()
    }

    /// The result of the same search with these intervals, for a caller who knows more about them: narrower ones,
    /// some left out, or with other levels.
    ///
    /// # Errors
    /// [`Error::BadInterval`] for an interval that is reversed, not finite, outside the window, or not above the one
    /// before.
    pub fn with_intervals(self, parts: Vec<LabelledInterval>) -> Result<IntervalBasins, Error> {
        let mut end = self.window.left;
        for LabelledInterval { interval: Interval { left, right }, .. } in &parts {
            Interval::new(end, *left)?;
            Interval::new(*left, *right)?;
            end = *right;
        }
        Interval::new(end, self.window.right)?;
        Ok(IntervalBasins { parts, ..self })
    }

    /// Makes gaps of the intervals whose label is no basin. With such intervals a search is not resolved.
    pub(crate) fn without_undecided(mut self) -> IntervalBasins {
        let all = self.parts.len();
        self.parts.retain(|part| part.label.is_decided());
        if self.parts.len() < all && self.stop_reason == StopReason::Resolved {
            self.stop_reason = StopReason::AllFollowed;
        }
        self
    }

    /// The same basins with another reason, for a caller who knows more about the branches than the search did.
    ///
    /// A search over sampled branches that is [`Resolved`](StopReason::Resolved) is
    /// [`SampledBranches`](StopReason::SampledBranches) in truth; if points have other fates than their intervals,
    /// it is a [`Contradiction`](StopReason::Contradiction).
    #[must_use]
    pub fn with_stop_reason(self, stop_reason: StopReason) -> IntervalBasins {
        IntervalBasins { stop_reason, ..self }
    }

    /// What shows that each trap is one, in the order in which they were given; empty if the caller knew it.
    pub fn trap_grounds(&self) -> &[TrapGround] {
        &self.grounds
    }

    /// Which limit stopped the search.
    pub fn stop_reason(&self) -> StopReason {
        self.stop_reason
    }

    /// All intervals, disjoint and from left to right.
    pub fn intervals(&self) -> &[LabelledInterval] {
        &self.parts
    }

    /// The labels that occur.
    pub fn labels(&self) -> Vec<Label> {
        let mut labels: Vec<Label> = self.parts.iter().map(|part| part.label).collect();
        labels.sort_unstable();
        labels.dedup();
        labels
    }

    /// The basin with a label, as a set of intervals.
    pub fn set(&self, label: Label) -> IntervalSet {
        let own = self.parts.iter().filter(|part| part.label == label);
        IntervalSet::union(own.map(|part| part.interval).collect())
    }

    /// The label of a point; `None` if it is undecided or outside the window.
    pub fn label(&self, x: f64) -> Option<Label> {
        let at = self.parts.partition_point(|part| part.interval.right < x);
        self.parts.get(at).filter(|part| part.interval.contains(x)).map(|part| part.label)
    }

    /// The undecided length of the window.
    pub fn undecided(&self) -> f64 {
        let rest = self.window.length() - total_length(&self.parts);
        // All parts together may be longer than the window by rounding.
        rest.max(0.0)
    }

    /// The length of the intervals found so far with this label.
    pub fn resolved_length(&self, label: Label) -> f64 {
        self.resolved_length_of(|other| other == label)
    }

    /// The length of the intervals found so far whose label fulfils a condition.
    pub fn resolved_length_of(&self, condition: impl Fn(Label) -> bool) -> f64 {
        let own = self.parts.iter().filter(|part| condition(part.label));
        own.map(|part| part.interval.length()).sum()
    }

    /// Bounds on the length of the basin with this label inside the window.
    ///
    /// The lower bound is the [resolved length](Self::resolved_length), less the rounding of the ends. The upper
    /// bound adds all of the undecided length. The bounds hold if the branches are complete and each end is
    /// right to an ulp of the window's larger end. (Where the map is flat, its rounding moves ends by more.)
    pub fn basin_length(&self, label: Label) -> Bounds {
        self.basin_length_of(|other| other == label)
    }

    /// Bounds on the total length of the basins whose label fulfils a condition.
    pub fn basin_length_of(&self, condition: impl Fn(Label) -> bool) -> Bounds {
        let resolved = self.resolved_length_of(condition);
        let rounding = self.rounding();
        let upper = (resolved + self.undecided() + rounding).min(self.window.length());
        Bounds { lower: (resolved - rounding).max(0.0), upper }
    }

    /// Bound on the rounding of a length of intervals: one ulp of the window's larger end for each of the two ends
    /// of every interval, and one for the sum.
    pub fn rounding(&self) -> f64 {
        let ulp = f64::EPSILON * self.window.left.abs().max(self.window.right.abs());
        3.0 * self.parts.len().max(1) as f64 * ulp
    }

    /// The number and the total length of the intervals with a label, by level; those without a level are left out.
    pub fn levels(&self, label: Label) -> BTreeMap<usize, (usize, f64)> {
        let mut levels = BTreeMap::new();
        for part in self.parts.iter().filter(|part| part.label == label) {
            let Some(level) = part.level else { continue };
            let (count, length) = levels.entry(level).or_insert((0, 0.0));
            *count += 1;
            *length += part.interval.length();
        }
        levels
    }

    /// The points at which basins end, from left to right.
    ///
    /// Between neighbouring intervals with different labels this is their common end. Beside an undecided gap
    /// longer than `resolution` both ends of the gap are given. A gap at an end of the window gives none.
    pub fn boundary(&self, resolution: f64) -> Vec<f64> {
        let mut points = Vec::new();
        for pair in self.parts.windows(2) {
            let (before, after) = (pair[0].interval.right, pair[1].interval.left);
            if after - before > resolution {
                points.extend([before, after]);
            } else if pair[0].label != pair[1].label {
                points.push(after);
            }
        }
        points
    }
}
