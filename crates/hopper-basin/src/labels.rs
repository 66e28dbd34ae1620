//! The fates of many lift-off speeds, hop by hop together.

use crate::{Fates, HopperFate, strip};

/// Fewer speeds go one by one.
const FEW: usize = 32;

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, those that [`fate`](Self::fate) gives one
    /// by one; a speed that it refuses has the label of an undecided hop.
    ///
    /// The orbits hop together, as [`LiftOffMap::images`](passive_hopper::LiftOffMap::images) does, and not all are
    /// followed: what lies between two orbits that visit the same arcs of the map, on which it is proved to be
    /// monotone, ends as they do.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60]), [1, HopperFate::Decaying.label()]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    pub fn labels(&self, speeds: &[f64]) -> Vec<u16> {
        labels_of_all(&[self], speeds).pop().unwrap_or_default()
    }

    /// The label of one fate.
    pub(crate) fn label_of(&self, alpha: f64) -> u16 {
        self.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
    }
}

/// The labels of `speeds` at every mass ratio.
pub(crate) fn labels_of_all(all: &[&Fates], speeds: &[f64]) -> Vec<Vec<u16>> {
    let one_by_one = |fates: &&Fates| speeds.iter().map(|&speed| fates.label_of(speed)).collect();
    let mut order: Vec<usize> = (0..speeds.len()).filter(|&at| speeds[at] > 0.0).collect();
    if order.len() < FEW {
        return all.iter().map(one_by_one).collect();
    }
    order.sort_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
    let sorted: Vec<f64> = order.iter().map(|&at| speeds[at]).collect();
    let Ok(found) = strip::labels(all, &sorted) else {
        return all.iter().map(one_by_one).collect();
    };
    let in_order = |labels: Vec<u16>| {
        let mut all = vec![HopperFate::UNDECIDED_HOP; speeds.len()];
        for (&at, label) in order.iter().zip(labels) {
            all[at] = label;
        }
        all
    };
    found.into_iter().map(in_order).collect()
}
