//! Basin fractions over the mass ratio, with bounds where the branches of the map are proved, and 95 % intervals
//! elsewhere.

use crate::basins::branches::branches_are_proved;
use crate::basins::intervals::hopper_basins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::traps::crisis::{crisis, grounding};
use basin_of_attraction::{
    Bounds, CurveLimits, FractionRange, Fractions, FractionsAlong, Interval, Label, Refinement,
    fractions_along, proportion_interval, stratified_fractions, stratified_points,
};
use passive_hopper::{MassRatio, alpha_star};
use std::collections::BTreeMap;

/// How basin fractions at one mass ratio are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FractionLimits {
    /// When the search for intervals stops, where the branches of the map are proved.
    pub refinement: Refinement,
    /// Points elsewhere: one at random in each of as many equal parts of the window.
    pub points: usize,
    /// Seed of the random points.
    pub seed: u64,
}

impl Default for FractionLimits {
    /// Intervals down to 10⁻⁷, which leave some 10⁻⁴ of the window undecided; elsewhere 64 000 points, about as
    /// many as in the paper. Shorter intervals and more points narrow the ranges, and take longer.
    fn default() -> Self {
        let refinement = Refinement { shortest: 1e-7, ..Refinement::default() };
        FractionLimits { refinement, points: 64_000, seed: 2002 }
    }
}

/// What the ranges of basin fractions are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FractionGround {
    /// Bounds: the basins are intervals of the map, whose branches are proved.
    Bounds,
    /// 95 % intervals of random points of certain fates.
    Points,
}

/// Samples of each sudden window for its branches. Where they are used, one branch is proved, and samples find its
/// ends.
const SAMPLES: usize = 400;

/// The basin fractions on [α*_`from`, α*_`to`] at one mass ratio, with equal weights of the humps as in the paper
/// (Sec. VI).
///
/// The fractions of all fixed points n ≥ 1 together have the label [`HopperFate::INCESSANT`].
///
/// ```
/// use basin_of_attraction::Label;
/// use hopper_basin::{Fates, FractionGround, FractionLimits, HopperFate, hump_fractions};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let (fractions, ground) = hump_fractions(&fates, 1, 6, FractionLimits::default())?;
/// // The paper's 0.037.
/// let all = fractions.of(HopperFate::INCESSANT);
/// assert!(ground == FractionGround::Bounds && (all.value - 0.0371).abs() < 1e-4 && all.half_width() < 1e-4);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoPoints`] if `from` is not below `to`; as [`hopper_basins`] and [`Fates::labels`]; as
/// [`stratified_points`] for the number of points.
pub fn hump_fractions(
    fates: &Fates,
    from: u64,
    to: u64,
    limits: FractionLimits,
) -> Result<(Fractions, FractionGround), Error> {
    if from >= to {
        return Err(Error::NoPoints { from, to, points: limits.points });
    }
    if branches_are_proved(fates.map().mass_ratio(), to) {
        return Ok((by_intervals(fates, from, to, limits.refinement)?, FractionGround::Bounds));
    }
    Ok((by_points(fates, from, to, limits)?, FractionGround::Points))
}

/// The mean of the bounds over the humps.
fn by_intervals(
    fates: &Fates,
    from: u64,
    to: u64,
    refinement: Refinement,
) -> Result<Fractions, Error> {
    let basins = hopper_basins(fates, from, to, SAMPLES, refinement)?.basins;
    let mut all = Fractions::default();
    let mut labels = basins.labels();
    labels.push(HopperFate::INCESSANT);
    for n in from..to {
        let part = basins.within(Interval::new(alpha_star(n), alpha_star(n + 1))?)?;
        let scale = 1.0 / (part.window().length() * (to - from) as f64);
        all.unseen += scale * part.undecided();
        for &label in &labels {
            let own = |other: Label| is_of(other, label);
            let Bounds { lower, upper } = part.basin_length_of(own);
            let none = FractionRange { value: 0.0, lower: 0.0, upper: 0.0 };
            let sum = all.found.entry(label).or_insert(none);
            sum.value += scale * part.resolved_length_of(own);
            sum.lower += scale * lower;
            sum.upper += scale * upper;
        }
    }
    Ok(all)
}

/// Whether a fate belongs to a label, which may be that of all fixed points together.
fn is_of(fate: Label, label: Label) -> bool {
    fate == label || label == HopperFate::INCESSANT && HopperFate::is_incessant(fate)
}

fn by_points(
    fates: &Fates,
    from: u64,
    to: u64,
    limits: FractionLimits,
) -> Result<Fractions, Error> {
    // Place k of the window is α*_{from + k}: each hump has length one.
    let places = Interval::new(0.0, (to - from) as f64)?;
    let speed = |place: &f64| {
        let whole = (place.floor() as u64).min(to - from - 1);
        let (left, right) = (alpha_star(from + whole), alpha_star(from + whole + 1));
        left + (right - left) * (place - whole as f64)
    };
    let speeds: Vec<f64> =
        stratified_points(places, limits.points, limits.seed)?.iter().map(speed).collect();
    let labels = fates.labels(&speeds)?;
    let together: Vec<Label> = labels
        .iter()
        .map(|&label| if HopperFate::is_incessant(label) { HopperFate::INCESSANT } else { label })
        .collect();
    let mut found = stratified_fractions(&labels)?;
    found.extend(stratified_fractions(&together)?.remove_entry(&HopperFate::INCESSANT));
    let undecided = labels.iter().filter(|label| label.is_undecided()).count();
    let found: BTreeMap<Label, FractionRange> = found
        .into_iter()
        .filter(|(label, _)| label.is_decided())
        .map(|(label, fraction)| (label, fraction.into()))
        .collect();
    let unseen = proportion_interval(undecided, limits.points)?.upper;
    Ok(Fractions { found, unseen, ..Fractions::default() })
}

/// The mass ratios at which fractions of [α*_`from`, α*_`to`] have kinks, in increasing order: the [`crisis`] of
/// each hump, its [`grounding`], and their inverses.
///
/// Above a crisis the fraction that falls through grows like a square root (docs/theory.md, Theorems 87 and 88), so
/// that its slope is infinite there. Other kinks belong to single critical orbits, and are not listed:
/// [`minima_on_fixed_points`] finds them in a short range.
///
/// [`minima_on_fixed_points`]: crate::minima_on_fixed_points
///
/// # Errors
/// As [`crisis`].
pub fn known_kinks(from: u64, to: u64) -> Result<Vec<f64>, Error> {
    let mut all = Vec::new();
    // Orbits fall below the window: the humps below it count as well.
    for n in 0..to.max(from) {
        all.push(grounding(n)?.mass_ratio);
        if n > 0 {
            all.push(crisis(n)?.mass_ratio);
        }
    }
    all.extend(all.clone().iter().map(|m| 1.0 / m));
    all.sort_by(f64::total_cmp);
    Ok(all)
}

/// Distance of a mass ratio from its kink, in ln M. At the kink itself rounding decides whether the hump falls
/// through. From here to the kink fractions change by less than 10⁻³.
const ASIDE: f64 = 1e-9;

/// The basin fractions on [α*_`from`, α*_`to`] over a range of mass ratios: [`hump_fractions`] at mass ratios so
/// close together that neighbours agree as `curve` says. Steps are those of ln M. Each of [`known_kinks`] has a
/// mass ratio 10⁻⁹ of its value beside it, on the side on which its hump does not fall through.
///
/// `fractions` is called for every mass ratio: [`hump_fractions`], or stored results of it.
///
/// ```
/// use basin_of_attraction::{CurveLimits, Interval};
/// use hopper_basin::{Fates, FractionLimits, HopperFate, fractions_over_mass_ratio, hump_fractions};
/// use passive_hopper::MassRatio;
/// let at = |m: f64| {
///     let fates = Fates::new(MassRatio::new(m)?)?;
///     Ok::<_, hopper_basin::Error>(hump_fractions(&fates, 1, 2, FractionLimits::default())?.0)
/// };
/// let curve = CurveLimits { first_steps: 2, difference: 0.25, ..CurveLimits::default() };
/// let found = fractions_over_mass_ratio(Interval::new(0.08, 0.13)?, 1, 2, curve, at)?;
/// // All of hump 1 goes to α*_1 up to the crisis.
/// let crisis = hopper_basin::crisis(1)?.mass_ratio;
/// let mut below = found.of(HopperFate::INCESSANT).filter(|(m, _)| *m <= crisis * (1.0 - 1e-12));
/// assert!(below.all(|(_, fraction)| fraction.lower > 0.9999));
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::Hopper`] for a mass ratio that is not positive; as [`fractions_along`]; errors of `fractions`.
pub fn fractions_over_mass_ratio<E: From<Error> + From<basin_of_attraction::Error>>(
    range: Interval,
    from: u64,
    to: u64,
    curve: CurveLimits,
    mut fractions: impl FnMut(f64) -> Result<Fractions, E>,
) -> Result<FractionsAlong, E> {
    for end in [range.left, range.right] {
        MassRatio::new(end).map_err(Error::from)?;
    }
    let logarithms = Interval::new(pxfm::f_log(range.left), pxfm::f_log(range.right))?;
    // The side of a kink on which its hump does not fall through: below M_c, and above 1/M_c.
    let beside = |m: f64| pxfm::f_log(m) + if m < 1.0 { -ASIDE } else { ASIDE };
    let kinks: Vec<f64> = known_kinks(from, to)?.into_iter().map(beside).collect();
    let found = fractions_along(logarithms, &kinks, curve, |t| fractions(pxfm::f_exp(t)))?;
    Ok(found.with_parameters(pxfm::f_exp))
}
