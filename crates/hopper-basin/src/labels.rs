//! The fates of many lift-off speeds at one mass ratio, hop by hop together.

use crate::arcs::Arcs;
use crate::column::{Column, from_zero};
use crate::ladder::Ladder;
use crate::orbits::{OPEN, Orbits};
use crate::{Fates, HopperFate};

/// Fewer speeds are all followed: there is little between them that has a common itinerary.
const MANY: usize = 64;

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, those that [`fate`](Self::fate) gives one
    /// by one; a speed that it refuses has the label of an undecided hop.
    ///
    /// The orbits hop together, as [`LiftOffMap::images`](passive_hopper::LiftOffMap::images) does. Of speeds in
    /// increasing order not all are followed: what lies between two orbits that visit the same arcs of the map, on
    /// which it is proved to be monotone, ends as they do.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60]), [1, HopperFate::Decaying.label()]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    pub fn labels(&self, speeds: &[f64]) -> Vec<u16> {
        let mut labels = vec![OPEN; speeds.len()];
        let largest = speeds.iter().fold(0.0, |a: f64, &b| if b > a { b } else { a });
        let Ok(ladder) = Ladder::below(self, largest) else {
            return speeds.iter().map(|&speed| self.label_of(speed)).collect();
        };
        let many = speeds.len() >= MANY && speeds.is_sorted();
        match many.then(|| Arcs::below(self.map().mass_ratio(), largest)) {
            Some(Ok(Some(arcs))) => {
                let (all, first) = from_zero(speeds);
                let mut all_labels = vec![OPEN; all.len()];
                Column::new(self, &ladder, &arcs, (&all, first)).label(&mut all_labels);
                labels.copy_from_slice(&all_labels[first..]);
            }
            _ => {
                let mut orbits = Orbits::new(self, &ladder, speeds, ());
                orbits.add(0..speeds.len() as u32, &mut labels, &mut []);
                while !orbits.is_empty() {
                    orbits.hop(&(), &mut labels, &mut []);
                }
            }
        }
        labels
    }

    /// The label of one fate.
    pub(crate) fn label_of(&self, alpha: f64) -> u16 {
        self.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
    }
}
