//! The fates of many lift-off speeds, hop by hop together.

use crate::{Error, Fates, HopperFate, strip};

/// Fewer speeds go one by one.
const FEW: usize = 32;

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, those that [`fate`](Self::fate) gives one
    /// by one.
    ///
    /// The orbits hop together, as [`LiftOffMap::images`](passive_hopper::LiftOffMap::images) does, and not all are
    /// followed: what lies between two orbits that visit the same arcs of the map, on which it is proved to be
    /// monotone, ends as they do. No speeds have no labels.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60])?, [1, HopperFate::Decaying.label()]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`fate`](Self::fate), for any of the speeds.
    pub fn labels(&self, speeds: &[f64]) -> Result<Vec<u16>, Error> {
        Ok(labels_of_all(&[self], speeds)?.pop().unwrap_or_default())
    }
}

/// The labels of `speeds` at every mass ratio.
pub(crate) fn labels_of_all(all: &[&Fates], speeds: &[f64]) -> Result<Vec<Vec<u16>>, Error> {
    if speeds.len() < FEW {
        let one_by_one = |fates: &&Fates| {
            speeds.iter().map(|&speed| fates.fate(speed).map(HopperFate::label)).collect()
        };
        return all.iter().map(one_by_one).collect();
    }
    if let Some(fates) = all.first() {
        for &speed in speeds {
            fates.map().landings(speed)?; // checks it
        }
    }
    if speeds.is_sorted() {
        return strip::labels(all, speeds);
    }
    let mut order: Vec<usize> = (0..speeds.len()).collect();
    order.sort_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
    let sorted: Vec<f64> = order.iter().map(|&at| speeds[at]).collect();
    let in_order = |labels: Vec<u16>| {
        let mut all = vec![HopperFate::UNDECIDED; speeds.len()];
        for (&at, label) in order.iter().zip(labels) {
            all[at] = label;
        }
        all
    };
    Ok(strip::labels(all, &sorted)?.into_iter().map(in_order).collect())
}
