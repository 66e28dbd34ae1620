//! The fates of many speeds, whose orbits hop together in the kernel's blocks.

use crate::error::Error;
use crate::fates::certain_fate::{PlainOrbit, Verdict};
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use passive_hopper::{HopWithin, LiftOffMap};

/// Orbits that hop together. The kernel's vectors are full with some hundred; more would leave the processor's cache.
const TOGETHER: usize = 1024;

impl Fates {
    /// The fate of each of `speeds`, and the number of hops until it was known, with a given budget of hops:
    /// the results of [`fate_within`](Self::fate_within), in about half the time.
    ///
    /// [`labels`](Self::labels) needs less time again, since it follows some of the orbits only, and gives no
    /// numbers of hops. An empty slice gives an empty vector.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// let found = fates.fates_within(&[4.55, 7.0], 1000)?;
    /// assert_eq!(found, [(HopperFate::Incessant { n: 1 }, 0), (HopperFate::Decaying, 3)]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`fate`](Self::fate), for any of the speeds.
    pub fn fates_within(
        &self,
        speeds: &[f64],
        budget: usize,
    ) -> Result<Vec<(HopperFate, usize)>, Error> {
        let mut found = Vec::with_capacity(speeds.len());
        for together in speeds.chunks(TOGETHER) {
            self.follow_together(together, budget, &mut found)?;
        }
        Ok(found)
    }

    fn follow_together(
        &self,
        speeds: &[f64],
        budget: usize,
        found: &mut Vec<(HopperFate, usize)>,
    ) -> Result<(), Error> {
        let certain = self.certain();
        let first = found.len();
        let mut orbits = Vec::with_capacity(speeds.len());
        for (at, &alpha) in speeds.iter().enumerate() {
            self.map().check_speed(alpha)?;
            orbits.push((at, PlainOrbit::new(alpha)));
            found.push((HopperFate::Decaying, 0));
        }
        let mut hops: Vec<(&LiftOffMap, HopWithin)> = Vec::with_capacity(speeds.len());
        while !orbits.is_empty() {
            // Only orbits that hop stay.
            let mut kept = 0;
            for k in 0..orbits.len() {
                let (at, mut orbit) = orbits[k];
                match certain.until_next_hop(&mut orbit, budget)? {
                    Some(_) if orbit.count_is_open() => {
                        found[first + at] = self.fate_within(speeds[at], budget)?;
                    }
                    Some(verdict) => {
                        let fate = self.fate_of(speeds[at], verdict, orbit.hops);
                        found[first + at] = (fate, orbit.hops);
                    }
                    None => {
                        orbits[kept] = (at, orbit);
                        kept += 1;
                    }
                }
            }
            orbits.truncate(kept);
            let next = |(_, orbit): &(usize, PlainOrbit)| {
                (self.map(), HopWithin::Next { speed: orbit.speed, error: orbit.error })
            };
            hops.clear();
            hops.extend(orbits.iter().map(next));
            LiftOffMap::hops_within(&mut hops);
            let mut kept = 0;
            for k in 0..orbits.len() {
                let (at, mut orbit) = orbits[k];
                match orbit.hop(hops[k].1) {
                    None => {
                        orbits[kept] = (at, orbit);
                        kept += 1;
                    }
                    // The other bound, or longer arithmetic, decides.
                    Some(Verdict::Inconclusive { .. }) => {
                        found[first + at] = self.fate_within(speeds[at], budget)?;
                    }
                    Some(verdict) => {
                        let fate = self.fate_of(speeds[at], verdict, orbit.hops);
                        found[first + at] = (fate, orbit.hops);
                    }
                }
            }
            orbits.truncate(kept);
        }
        Ok(())
    }
}
