//! Basin fractions along a curve of parameters.
//!
//! The curve is divided at the parameters that the caller knows to be special, and each part into equal steps of a
//! largest length. A step whose ends have too different fractions is halved, the worst one first. Where halving does
//! not help, the reason is reported: at a jump of the fractions the step becomes as short as allowed, its ranges apart.

use crate::error::Error;
use crate::parameters::common_labels::with_common_labels;
use crate::parameters::matching::Matching;
use crate::shares::fractions::{FractionRange, Fractions};
use crate::space::interval::Interval;
use crate::space::label::Label;
use std::collections::BTreeSet;

/// How finely a curve of parameters is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveLimits {
    /// Equal steps into which the curve would be divided at first without known parameters; with them no first step is
    /// longer. A peak between two parameters with equal fractions is not seen: the first steps must be shorter than the
    /// narrowest peak.
    pub first_steps: usize,
    /// A step is fine enough if every fraction changes by at most this,
    pub difference: f64,
    /// or by at most this part of its larger value. 0 makes `difference` alone count.
    pub relative: f64,
    /// Steps of twice this length or shorter are not halved.
    pub shortest: f64,
    /// Most parameters at which fractions are computed.
    pub budget: usize,
}

impl Default for CurveLimits {
    /// Sixteen steps, halved until fractions change by at most 0.02, to 10⁻⁶; up to 1000 parameters.
    ///
    /// A curve is then drawn to a hundredth of its height. Smaller differences take more parameters, in proportion.
    fn default() -> Self {
        CurveLimits {
            first_steps: 16,
            difference: 0.02,
            relative: 0.0,
            shortest: 1e-6,
            budget: 1000,
        }
    }
}

/// Why a step with too different fractions was not halved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnresolvedReason {
    /// The step is the shortest allowed one, and the ranges exclude each other: the fractions jump, or have a kink.
    Jump,
    /// The ranges at both ends have numbers in common: better fractions would be needed to see a change.
    Uncertain,
    /// The budget of parameters was used up.
    Budget,
}

/// A step across which a fraction changes by more than is allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnresolvedStep {
    /// The parameter before.
    pub from: f64,
    /// The parameter after.
    pub to: f64,
    /// The basin whose fraction changes most, in units of what is allowed.
    pub label: Label,
    /// Its fraction before.
    pub before: FractionRange,
    /// Its fraction after.
    pub after: FractionRange,
    /// Why the step was not halved.
    pub reason: UnresolvedReason,
}

/// An attractor that matches none at the next parameter, or none at the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnmatchedAttractor {
    /// The parameter before.
    pub from: f64,
    /// The parameter after.
    pub to: f64,
    /// Its label.
    pub label: Label,
    /// Whether it appears; else it vanishes.
    pub appears: bool,
}

/// The basin fractions along a curve of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct FractionsAlong {
    points: Vec<(f64, Fractions)>,
    unresolved: Vec<UnresolvedStep>,
    unmatched: Vec<UnmatchedAttractor>,
}

impl FractionsAlong {
    /// The parameters in increasing order, with their fractions. The same label is the same attractor at all of them.
    pub fn points(&self) -> &[(f64, Fractions)] {
        &self.points
    }

    /// The steps across which a fraction changes by more than is allowed, in increasing order.
    pub fn unresolved(&self) -> &[UnresolvedStep] {
        &self.unresolved
    }

    /// The jumps among them: each is located between two parameters.
    pub fn jumps(&self) -> impl Iterator<Item = &UnresolvedStep> {
        self.unresolved.iter().filter(|step| step.reason == UnresolvedReason::Jump)
    }

    /// Attractors that appear or vanish, unless attractors are matched by their labels. One that comes back has its label again.
    pub fn unmatched(&self) -> &[UnmatchedAttractor] {
        &self.unmatched
    }

    /// The same curve over another parameter, given as an increasing function of this one.
    ///
    /// ```
    /// use basin_of_attraction::{CurveLimits, Error, Fractions, Interval, fractions_along};
    /// // Steps of a constant factor, from 10⁻³ to 1.
    /// let logarithms = Interval::new(1e-3f64.ln(), 0.0)?;
    /// let at = |t: f64| Ok::<_, Error>(Fractions { unseen: t.exp(), ..Fractions::default() });
    /// let found = fractions_along(logarithms, &[], CurveLimits::default(), at)?.with_parameters(f64::exp);
    /// assert!(found.points().iter().all(|(parameter, fractions)| *parameter == fractions.unseen));
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn with_parameters(mut self, parameter: impl Fn(f64) -> f64) -> FractionsAlong {
        self.points.iter_mut().for_each(|point| point.0 = parameter(point.0));
        for step in &mut self.unresolved {
            (step.from, step.to) = (parameter(step.from), parameter(step.to));
        }
        for step in &mut self.unmatched {
            (step.from, step.to) = (parameter(step.from), parameter(step.to));
        }
        self
    }

    /// The fractions of groups of attractors, as [`Fractions::aggregated`] gives them at each parameter; `group` also gets the parameter.
    /// Which steps are unresolved is that of the attractors.
    #[must_use]
    pub fn aggregated(
        &self,
        group: impl Fn(f64, Label, &[Vec<f64>]) -> Label,
    ) -> Vec<(f64, Fractions)> {
        let own = |(parameter, fractions): &(f64, Fractions)| {
            (*parameter, fractions.aggregated(|label, points| group(*parameter, label, points)))
        };
        self.points.iter().map(own).collect()
    }

    /// All labels, in increasing order.
    pub fn labels(&self) -> Vec<Label> {
        let all = self.points.iter().flat_map(|(_, fractions)| fractions.found.keys().copied());
        all.collect::<BTreeSet<Label>>().into_iter().collect()
    }

    /// The fraction of one basin over the parameter.
    pub fn of(&self, label: Label) -> impl Iterator<Item = (f64, FractionRange)> + '_ {
        self.points.iter().map(move |(parameter, fractions)| (*parameter, fractions.of(label)))
    }
}

/// The basin fractions at the parameters of a curve, so close together that neighbours agree as `limits` say.
///
/// `fractions` gives them at a parameter of `range`. For a curve in a space of several parameters it is a function of
/// the curve's own parameter. `known` are parameters where the fractions have a jump or a kink, such as crises: they
/// are among the parameters, so that no step crosses one. `fractions` is called for one parameter after the other, in
/// an order that depends on the fractions only.
///
/// ```
/// use basin_of_attraction::{CurveLimits, Fractions, Interval, Label, fractions_along, region_fractions};
/// // x → x + c: the basin of the right half. It jumps when c passes 1/3.
/// let line = Interval::new(0.0, 1.0)?.try_into()?;
/// let label = |c: f64, x: f64| Label::from(c > 1.0 / 3.0 && x > 0.5 + 0.1 * c);
/// let at = |c: f64| Fractions::from_counts(&region_fractions(&line, 4000, 1, |x| label(c, x[0]))?);
/// let limits = CurveLimits { shortest: 1e-4, difference: 0.05, ..CurveLimits::default() };
/// let found = fractions_along(Interval::new(0.0, 1.0)?, &[], limits, at)?;
/// let jump = found.jumps().next().expect("a jump");
/// assert!(jump.from <= 1.0 / 3.0 && 1.0 / 3.0 <= jump.to && jump.to - jump.from < 2e-4);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// The same label is the same attractor; for labels without a meaning see [`fractions_along_matched`].
///
/// # Errors
/// [`Error::BadInterval`] for a range that is reversed, of length 0, or not finite; [`Error::BadCurveLimits`] for no first step, a
/// difference or a shortest step that is not positive, or a budget below the number of the first parameters;
/// [`Error::TooManySamples`] for more than ten million of these; [`Error::BadPoint`] for a known parameter that is not finite; errors of
/// `fractions`.
pub fn fractions_along<E: From<Error>>(
    range: Interval,
    known: &[f64],
    limits: CurveLimits,
    mut fractions: impl FnMut(f64) -> Result<Fractions, E>,
) -> Result<FractionsAlong, E> {
    fractions_along_matched(range, known, limits, Matching::ByLabel, |parameter, _| {
        fractions(parameter)
    })
}

/// The same with attractors that are matched from parameter to parameter, whatever their labels are. `fractions` also gets what was found at the next
/// smaller parameter so far: the points of its attractors are good starts.
///
/// ```
/// use basin_of_attraction::{CurveLimits, Fractions, Interval, Label, Matching, fractions_along_matched};
/// // One attractor that moves as c, and changes its number.
/// let at = |c: f64, _: Option<&(f64, Fractions)>| {
///     let own = Label::from(c > 0.5);
///     Ok::<_, basin_of_attraction::Error>(Fractions::default().with_attractors([(own, vec![vec![c]])].into()))
/// };
/// let range = Interval::new(0.0, 1.0)?;
/// let nearest = Matching::Nearest { within: 0.1 };
/// let found = fractions_along_matched(range, &[], CurveLimits::default(), nearest, at)?;
/// assert!(found.unmatched().is_empty());
/// assert!(found.points().iter().all(|(_, own)| own.attractors.keys().eq([&Label::from(0)])));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// As [`fractions_along`]; [`Error::TooManyAttractors`] if attractors that appear and vanish use up all labels.
pub fn fractions_along_matched<E: From<Error>>(
    range: Interval,
    known: &[f64],
    limits: CurveLimits,
    matching: Matching<'_>,
    mut fractions: impl FnMut(f64, Option<&(f64, Fractions)>) -> Result<Fractions, E>,
) -> Result<FractionsAlong, E> {
    let parameters = first_parameters(range, known, &limits)?;
    let mut points: Vec<(f64, Fractions)> = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let found = fractions(parameter, points.last())?;
        points.push((parameter, found));
    }
    let between = |one: &_, other: &_| too_large(one, other, &limits, &matching);
    let mut steps: Vec<Option<UnresolvedStep>> =
        points.windows(2).map(|pair| between(&pair[0], &pair[1])).collect();
    // The worst step that can be halved; of equally bad ones the first.
    let worst = |steps: &[Option<UnresolvedStep>]| {
        let halved = steps.iter().enumerate().filter_map(|(at, step)| {
            let step = step.as_ref().filter(|step| step.reason == UnresolvedReason::Budget)?;
            Some((at, excess(step.before, step.after, &limits)))
        });
        halved.fold(None, |best: Option<(usize, f64)>, next| match best {
            Some(best) if best.1 >= next.1 => Some(best),
            _ => Some(next),
        })
    };
    while points.len() < limits.budget {
        let Some((at, _)) = worst(&steps) else { break };
        let middle = 0.5 * points[at].0 + 0.5 * points[at + 1].0;
        let found = fractions(middle, points.get(at))?;
        points.insert(at + 1, (middle, found));
        steps[at] = between(&points[at], &points[at + 1]);
        steps.insert(at + 1, between(&points[at + 1], &points[at + 2]));
    }
    let mut found = FractionsAlong { points, unresolved: Vec::new(), unmatched: Vec::new() };
    found.unmatched = with_common_labels(&mut found.points, &matching)?;
    // The labels of the steps are the common ones as well.
    let steps = found.points.windows(2);
    let again = |pair: &[_]| too_large(&pair[0], &pair[1], &limits, &Matching::ByLabel);
    found.unresolved = steps.filter_map(again).collect();
    Ok(found)
}

/// Most of these. Each takes a measurement of all fractions.
const MOST_FIRST_PARAMETERS: usize = 10_000_000;

/// The parameters at which every curve is computed.
fn first_parameters(
    range: Interval,
    known: &[f64],
    limits: &CurveLimits,
) -> Result<Vec<f64>, Error> {
    let Interval { left, right } = Interval::new(range.left, range.right)?;
    if left == right || !(right - left).is_finite() {
        return Err(Error::BadInterval { left, right });
    }
    if let Some((coordinate, &value)) = known.iter().enumerate().find(|(_, x)| !x.is_finite()) {
        return Err(Error::BadPoint { coordinate, value });
    }
    let mut ends: Vec<f64> = known.iter().copied().filter(|&x| left < x && x < right).collect();
    ends.extend([left, right]);
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let CurveLimits { first_steps, difference, relative, shortest, budget, .. } = *limits;
    // Up to rounding: a part of k steps does not get a further one.
    let part = |pair: &[f64]| (pair[1] - pair[0]) / (right - left);
    let steps = |pair: &[f64]| (part(pair) * first_steps as f64 - 1e-9).ceil().max(1.0);
    let counts = ends.windows(2).map(|pair| steps(pair) as usize);
    let fewest = counts.fold(1usize, usize::saturating_add);
    let positive = difference > 0.0 && relative >= 0.0 && shortest > 0.0;
    if first_steps == 0 || budget < fewest || !positive || !shortest.is_finite() {
        let error =
            Error::BadCurveLimits { first_steps, difference, relative, shortest, budget, fewest };
        return Err(error);
    }
    if fewest > MOST_FIRST_PARAMETERS {
        let (most, remedy) = (MOST_FIRST_PARAMETERS, "take fewer first steps");
        return Err(Error::TooManySamples { samples: fewest, most, remedy });
    }
    let mut parameters = Vec::new();
    for pair in ends.windows(2) {
        let count = steps(pair);
        let at = |k: usize| pair[0] + (pair[1] - pair[0]) * (k as f64 / count);
        parameters.extend((0..count as usize).map(at));
    }
    parameters.push(right);
    // A part as short as an ulp has several equal parameters.
    parameters.dedup();
    Ok(parameters)
}

/// The change of a fraction, in units of what is allowed.
fn excess(before: FractionRange, after: FractionRange, limits: &CurveLimits) -> f64 {
    let allowed = limits.difference.max(limits.relative * before.value.max(after.value));
    (after.value - before.value).abs() / allowed
}

/// The step between two parameters, if a fraction changes by more than is allowed. A step that may be halved has the
/// reason [`UnresolvedReason::Budget`]: it is what remains if the budget ends.
fn too_large(
    one: &(f64, Fractions),
    other: &(f64, Fractions),
    limits: &CurveLimits,
    matching: &Matching<'_>,
) -> Option<UnresolvedStep> {
    let step = |(before, after): (Option<Label>, Option<Label>)| {
        // An attractor without a partner has no basin at the other parameter.
        let none = FractionRange { value: 0.0, lower: 0.0, upper: 0.0 };
        let left = before.map_or(none, |label| one.1.of(label));
        let right = after.map_or(none, |label| other.1.of(label));
        Some((before.or(after)?, left, right))
    };
    let found = matching.partners(one, other);
    let pairs = found.pairs.iter().map(|&(before, after, _)| (Some(before), Some(after)));
    let vanished = found.vanished.iter().map(|&label| (Some(label), None));
    let appeared = found.appeared.iter().map(|&label| (None, Some(label)));
    let steps = pairs.chain(vanished).chain(appeared).filter_map(step);
    let large = steps.filter(|&(_, before, after)| excess(before, after, limits) > 1.0);
    // A change that the ranges show counts more than one that they do not.
    let rank = |&(_, before, after): &(Label, FractionRange, FractionRange)| {
        (before.gap(&after) > 0.0, excess(before, after, limits))
    };
    let (label, before, after) =
        large.max_by(|a, b| rank(a).0.cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)))?;
    let (from, to) = (one.0, other.0);
    let middle = 0.5 * from + 0.5 * to;
    let reason = if before.gap(&after) == 0.0 {
        UnresolvedReason::Uncertain
    } else if to - from <= 2.0 * limits.shortest || middle <= from || middle >= to {
        UnresolvedReason::Jump
    } else {
        UnresolvedReason::Budget
    };
    Some(UnresolvedStep { from, to, label, before, after, reason })
}
