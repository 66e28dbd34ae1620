//! The phase with which an orbit comes to its fixed point.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::Label;
use hopper_asymptotics::{FatouCoordinate, Side};
use passive_hopper::alpha_star;
use std::collections::BTreeMap;

/// The largest error of a phase that is returned: a sixteenth of a percent of a turn is more than a picture shows.
const LARGEST_ERROR: f64 = 1e-3;

/// Hops after which an orbit in a trap has come near enough to its fixed point for a phase: at most 30 are needed for M
/// from 0.02 to 1.
const MOST_HOPS: usize = 10_000;

impl Fates {
    /// The fraction of the Fatou coordinate Ψ, on the right of the fixed point to which each orbit converges: the same for
    /// all points of an orbit, so that its level sets are what the map leads into themselves. `None` for orbits that
    /// converge to no fixed point, and where rounding leaves more than 10⁻³ of a turn open, as within some 10⁻¹¹ above α*.
    ///
    /// ```
    /// use hopper_basin::Fates;
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.08)?)?;
    /// let next = fates.map().image(6.0)?.expect("hops again");
    /// let phases = fates.phases(&[6.0, next])?;
    /// assert!((phases[0].unwrap() - phases[1].unwrap()).abs() < 1e-9);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`labels`](Self::labels), for any of the speeds.
    pub fn phases(&self, speeds: &[f64]) -> Result<Vec<Option<f64>>, Error> {
        let labels = self.labels(speeds)?;
        let mut coordinates = BTreeMap::new();
        let phase = |(&speed, label): (&f64, Label)| {
            let n = label.basin_number().filter(|_| HopperFate::is_incessant(label));
            let Some(n) = n.map(u64::from) else { return Ok(None) };
            let ratio = self.map().mass_ratio();
            let known = coordinates
                .entry(n)
                .or_insert_with(|| FatouCoordinate::new(n, ratio, Side::Right).ok());
            // An extreme mass ratio has no series.
            known.as_ref().map_or(Ok(None), |coordinate| self.phase_of(coordinate, (speed, n)))
        };
        speeds.iter().zip(labels).map(phase).collect()
    }

    fn phase_of(
        &self,
        coordinate: &FatouCoordinate,
        (mut speed, n): (f64, u64),
    ) -> Result<Option<f64>, Error> {
        let star = alpha_star(n);
        for _ in 0..MOST_HOPS {
            // The speed and the fixed point are known to half an ulp each.
            if let Ok(turns) = coordinate.count_within(speed - star, f64::EPSILON * star) {
                // A hop is a whole turn.
                let is_known = turns.error <= LARGEST_ERROR;
                return Ok(is_known.then(|| turns.hops - turns.hops.floor()));
            }
            match self.map().image(speed)? {
                Some(next) => speed = next,
                None => return Ok(None),
            }
        }
        Ok(None)
    }
}
