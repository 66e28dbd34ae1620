//! Tipping: the fate of a hopper whose mass ratio changes, at once or slowly.

use crate::basins::intervals::{BranchGround, hopper_basins};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{
    Hyperrectangle, Interval, Label, Refinement, SplitMix64, Tipping, TippingCounts,
    label_after_drift,
};
use passive_hopper::{LiftOffMap, MassRatio};
use std::ops::ControlFlow;

/// Tipping at a sudden change of the mass ratio, from basins as intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct HopperTipping {
    /// The intersections of the basins.
    pub tipping: Tipping,
    /// What the basins before and after stand on. The bounds hold if both are [`BranchGround::Proved`].
    pub grounds: [BranchGround; 2],
}

impl HopperTipping {
    /// Whether the branches of the map are proved at both mass ratios, so that the bounds hold.
    pub fn is_proved(&self) -> bool {
        self.grounds.iter().all(|ground| *ground == BranchGround::Proved)
    }
}

/// Tipping between two mass ratios, for a lift-off speed of [α*_`from`, α*_`to`].
///
/// The fixed points do not depend on M, but the basins do. A speed in the basin of α*_n at one mass ratio goes to
/// the fate that it has at the other.
///
/// ```
/// use basin_of_attraction::{Label, Refinement};
/// use hopper_basin::{Fates, tipping};
/// use passive_hopper::MassRatio;
/// let fates = |m| -> Result<Fates, hopper_basin::Error> { Fates::new(MassRatio::new(m)?) };
/// let refinement = Refinement { shortest: 1e-6, ..Refinement::default() };
/// let found = tipping(&fates(0.1)?, &fates(0.2)?, 1, 2, refinement)?;
/// // At M = 0.1 the basin of α*_1 is the whole first hump, of which 4.6 % remain at M = 0.2.
/// let stays = found.tipping.probability(Label::from(1), Label::from(1)).expect("α*_1 attracts");
/// assert!(found.is_proved() && stays.lower > 0.0462 && stays.upper < 0.0464);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`hopper_basins`].
pub fn tipping(
    before: &Fates,
    after: &Fates,
    from: u64,
    to: u64,
    refinement: Refinement,
) -> Result<HopperTipping, Error> {
    /// Samples of each sudden window. Where the branches are proved each window has one branch, and samples find
    /// its ends.
    const SAMPLES: usize = 400;
    let [one, other] = [
        hopper_basins(before, from, to, SAMPLES, refinement)?,
        hopper_basins(after, from, to, SAMPLES, refinement)?,
    ];
    let tipping = one.basins.tipping_to(&other.basins)?;
    Ok(HopperTipping { tipping, grounds: [one.ground, other.ground] })
}

/// Tipping of `count` independent random speeds of a window, by their fates at both mass ratios, with 95 %
/// intervals. It needs no branches of the map, and holds at all mass ratios as the fates do.
///
/// ```
/// use basin_of_attraction::{Interval, Label};
/// use hopper_basin::{Fates, first_humps, random_tipping};
/// use passive_hopper::MassRatio;
/// let [before, after] = [0.1, 1.0].map(|m| MassRatio::new(m).map(Fates::new));
/// let found = random_tipping(&before??, &after??, first_humps(1), 10_000, 1)?;
/// let stays = found.probability(Label::from(1), Label::from(1))?.expect("α*_1 attracts");
/// assert!(stays.upper < 0.01);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`Fates::labels`]; [`basin_of_attraction::Error::BadInterval`] for a window that is reversed or not finite;
/// [`basin_of_attraction::Error::TooManySamples`] for more than 10⁹ speeds;
/// [`basin_of_attraction::Error::NothingInside`] for none.
pub fn random_tipping(
    before: &Fates,
    after: &Fates,
    window: Interval,
    count: usize,
    seed: u64,
) -> Result<TippingCounts, Error> {
    let speeds = random_speeds(window, count, seed)?;
    Ok(TippingCounts::new(before.labels(&speeds)?.into_iter().zip(after.labels(&speeds)?))?)
}

/// Tipping of random speeds along a slow change of the mass ratio: hop k has the mass ratio `drift[k]`, and the
/// fate is that of the last speed at `after`.
///
/// The orbits of the drift are computed in `f64`, without a bound on their errors: a start that is close to a
/// boundary may have the fate of its neighbour. The interval of a fraction does not contain this error, which is of
/// the size of the rounding.
///
/// # Errors
/// As [`random_tipping`].
pub fn tipping_along_drift(
    before: &Fates,
    drift: &[MassRatio],
    after: &Fates,
    window: Interval,
    count: usize,
    seed: u64,
) -> Result<TippingCounts, Error> {
    let maps: Vec<LiftOffMap> = drift.iter().map(|&m| LiftOffMap::new(m)).collect();
    let speeds = random_speeds(window, count, seed)?;
    // The fates of all last speeds are found together, so that the labels of orbits that end before are kept apart.
    let mut last: Vec<f64> = Vec::with_capacity(speeds.len());
    let ended: Vec<Option<Label>> = speeds
        .iter()
        .map(|&speed| {
            let step = |k: usize, speed: f64| match maps.get(k).map(|map| map.image(speed)) {
                Some(Ok(Some(next))) => ControlFlow::Continue(next),
                Some(Ok(None)) => ControlFlow::Break(HopperFate::GROUNDED),
                _ => ControlFlow::Break(HopperFate::UNDECIDED_HOP),
            };
            let mut end = None;
            let label = label_after_drift(speed, maps.len(), step, |speed| {
                end = Some(speed);
                Label::UNDECIDED
            });
            last.extend(end);
            end.is_none().then_some(label)
        })
        .collect();
    let mut labels = after.labels(&last)?.into_iter();
    let after = ended.into_iter().map(|ended| ended.or_else(|| labels.next()));
    let pairs = before.labels(&speeds)?.into_iter().zip(after);
    Ok(TippingCounts::new(pairs.map(|(one, other)| (one, other.unwrap_or(Label::UNDECIDED))))?)
}

/// Most speeds: their fates take a quarter of an hour. More are a mistake, and would seem never to end.
const MOST_SPEEDS: usize = 1_000_000_000;

/// Independent random speeds of a window.
fn random_speeds(window: Interval, count: usize, seed: u64) -> Result<Vec<f64>, Error> {
    if count > MOST_SPEEDS {
        let remedy = "take fewer speeds: the error of a fraction falls like one over the root of their number";
        let error = basin_of_attraction::Error::TooManySamples {
            samples: count,
            most: MOST_SPEEDS,
            remedy,
        };
        return Err(error.into());
    }
    let region = Hyperrectangle::try_from(window)?;
    let random = SplitMix64::from_seed(seed);
    Ok((0..count as u64).flat_map(|k| region.random_point(&random, k)).collect())
}
