//! The labels of many lift-off speeds at once.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::common_circles::CommonCircles;
use crate::raster::strip;
use basin_of_attraction::Label;

/// Fewer speeds than this are classified one by one.
///
/// A strip first computes the traps and laps of every column, some microseconds each, and a vector of hops needs many
/// orbits to be full. The value was set when strips were written; it affects the time only.
const FEWEST_SPEEDS: usize = 32;

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, in any order. They are the labels that
    /// [`fate`](Self::fate) gives one by one, in less time. A speed whose fate is undecided alone may get the label
    /// that the orbits around it prove.
    ///
    /// The orbits hop together, as in [`LiftOffMap::images`](passive_hopper::LiftOffMap::images), and not all are
    /// followed: if two orbits visit the same laps of the map and end in the same way, every orbit between them has
    /// their fate. An empty slice gives an empty vector.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60])?, [1, 0].map(HopperFate::label_of_fixed_point));
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`fate`](Self::fate), for any of the speeds; [`Error::TooManySpeeds`] for more than 10⁹ speeds.
    pub fn labels(&self, speeds: &[f64]) -> Result<Vec<Label>, Error> {
        Ok(labels_of_columns(&[self], speeds, None)?.pop().unwrap_or_default())
    }
}

/// The labels of `speeds` at every mass ratio, with circles that they share.
pub(crate) fn labels_of_columns(
    columns: &[&Fates],
    speeds: &[f64],
    common: Option<&CommonCircles>,
) -> Result<Vec<Vec<Label>>, Error> {
    if speeds.len() < FEWEST_SPEEDS {
        let one_by_one = |fates: &&Fates| {
            speeds.iter().map(|&speed| fates.fate(speed).map(HopperFate::label)).collect()
        };
        return columns.iter().map(one_by_one).collect();
    }
    if let Some(fates) = columns.first() {
        // The strip requires valid speeds.
        for &speed in speeds {
            fates.map().check_speed(speed)?;
        }
    }
    if speeds.is_sorted() {
        return strip::labels(columns, speeds, common);
    }
    let mut order: Vec<usize> = (0..speeds.len()).collect();
    order.sort_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
    let sorted: Vec<f64> = order.iter().map(|&at| speeds[at]).collect();
    let in_given_order = |labels: Vec<Label>| {
        let mut all = vec![HopperFate::UNDECIDED; speeds.len()];
        for (&at, label) in order.iter().zip(labels) {
            all[at] = label;
        }
        all
    };
    Ok(strip::labels(columns, &sorted, common)?.into_iter().map(in_given_order).collect())
}
