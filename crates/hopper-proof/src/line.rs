//! The basins of a line of speeds, proved for all mass ratios of a strip.

use crate::error::Error;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::traps::proved_trap;
use basin_of_attraction::{Interval, Label};
use hopper_basin::{HopperFate, LapsSweep, Resolution};
use passive_hopper::{alpha_star, index_below};

/// Disjoint intervals of speeds, each with the fate that all its speeds have, at all mass ratios of a strip. Between them nothing is
/// proved.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedLine {
    intervals: Vec<(Interval, Label)>,
}

impl ProvedLine {
    /// The basins between the speeds of `edges`, which increase; `resolution` says how much of each part between two neighbours may stay
    /// open. A sweep goes upwards from 0, since images lie below their speeds.
    ///
    /// # Errors
    /// [`Error::Speeds`] unless the edges are from 0 to α*_n of the largest label, and increase.
    pub fn new(strip: Strip, edges: &[f64], resolution: Resolution) -> Result<Self, Error> {
        let largest = alpha_star(HopperFate::LARGEST_LABEL);
        let (low, high) = match *edges {
            [low, .., high] => (low, high),
            _ => (f64::NAN, f64::NAN),
        };
        let increase = edges.windows(2).all(|pair| pair[0] < pair[1]);
        if !(low >= 0.0 && high <= largest && increase) {
            return Err(Error::Speeds { low, high, largest });
        }
        let traps = traps_up_to(&strip, high)?;
        let mut sweep = LapsSweep::new(ProvedImages::new(strip, high)?, traps);
        for pair in edges.windows(2) {
            sweep.add_pixel(pair[0], pair[1], resolution);
        }
        Ok(ProvedLine { intervals: sweep.into_known() })
    }

    /// The intervals from the lowest up.
    pub fn intervals(&self) -> &[(Interval, Label)] {
        &self.intervals
    }
}

/// The traps that are proved, from α*_0 up to a speed.
fn traps_up_to(strip: &Strip, top: f64) -> Result<Vec<(Interval, Label)>, Error> {
    let mut traps = Vec::new();
    for n in 0..=index_below(top)? {
        // A trap that is not proved is left out; then more stays open.
        match proved_trap(n, strip) {
            Ok(trap) => traps.push((trap, HopperFate::label_of_fixed_point(n))),
            Err(Error::Open { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(traps)
}
