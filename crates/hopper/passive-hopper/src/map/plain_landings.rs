//! The landings of a hop in plain `f64`, one after the other, without any bound on their errors.
//!
//! `lift_off_map.rs` adds the bounds, and computes the hop again in longer arithmetic if a decision is
//! inconclusive. The landings here are no result for users: their decisions may be wrong.

use crate::error::Error;
use crate::landing::first_landing::first_landing;
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::next_landing::next_landing;
use crate::map::limits::SUDDEN_LIFT_OFF_BUDGET;

/// The landings between two gradual lift-offs. The iterator gives [`Error::SuddenLiftOffBudget`] after too many.
pub(crate) struct PlainLandings {
    kappa: f64,
    start: Option<TakeOff>,
    flights: usize,
}

impl PlainLandings {
    /// The landings of the hop from a valid speed `alpha`.
    pub(crate) fn new(alpha: f64, kappa: f64) -> Self {
        PlainLandings { kappa, start: Some(TakeOff { excess: 0.0, velocity: alpha }), flights: 0 }
    }
}

impl Iterator for PlainLandings {
    type Item = Result<Landing, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.start?;
        if self.flights > SUDDEN_LIFT_OFF_BUDGET {
            self.start = None;
            let TakeOff { excess, velocity } = start;
            let sudden = self.flights - 1;
            return Some(Err(Error::SuddenLiftOffBudget { sudden, excess, velocity }));
        }
        let landing = if self.flights == 0 {
            first_landing(start.velocity, self.kappa)
        } else if let Some(start) = start.resolved() {
            next_landing(start, self.kappa)
        } else {
            // A flight of no length. Its x′ = 0 is not larger than any error, so that the hop is computed in longer
            // arithmetic, in which x > 0.
            let TakeOff { velocity, .. } = start;
            Landing { time: 0.0, closing_speed: 0.0, excess: 0.0, velocity, sudden: false }
        };
        self.flights += 1;
        self.start = landing.sudden.then(|| landing.take_off());
        Some(Ok(landing))
    }
}
