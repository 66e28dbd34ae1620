//! The first landing after a lift-off from an exactly known state on the ground, with decisions larger than their
//! errors.
//!
//! The decisions of a flight are on which branch it lands, and whether a sudden lift-off follows. They are made in
//! `f64`, and if they are inconclusive there, in 106, 256, 512 and 1024 bits.

use crate::error::Error;
use crate::landing::error_bound::ErrorBound;
use crate::landing::extended_landing::ExtendedLanding;
use crate::landing::first_landing::first_landing;
use crate::landing::flight_ends::{Landing, TakeOff, is_sudden};
use crate::landing::next_landing::{maximum_test, next_landing, next_root};
use crate::model::mass_ratio::MassRatio;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;
use std::f64::consts::PI;

/// The first landing after `start`, with x > 0, or x = 0 and V > 0.
///
/// From x = 0 both decisions depend on α alone and are made on 100 bits of α*_n (docs/theory.md, Theorem 7).
pub(crate) fn decided_landing(start: TakeOff, mass_ratio: MassRatio) -> Result<Landing, Error> {
    let kappa = mass_ratio.kappa();
    let TakeOff { excess, velocity } = start;
    if !(excess > 0.0) {
        return Ok(first_landing(velocity, kappa));
    }
    let plain = next_landing(start, kappa);
    let mut bound = ErrorBound::of_f64(velocity).starting_at(start);
    bound.add_flight(&plain, kappa);
    if !bound.landing_inconclusive() {
        return Ok(plain);
    }
    let longer = [
        decided_in::<DoubleDouble>,
        decided_in::<Long<4>>,
        decided_in::<Long<8>>,
        decided_in::<Long<16>>,
    ];
    let found = longer.into_iter().find_map(|decided| decided(start, mass_ratio));
    found.ok_or(Error::UndecidedLanding { excess, velocity })
}

/// The landing in the arithmetic `R`; `None` if a decision is inconclusive.
fn decided_in<R: Extended>(start: TakeOff, mass_ratio: MassRatio) -> Option<Landing> {
    let (x, v) = (R::from(start.excess), R::from(start.velocity));
    let m = R::from(mass_ratio.value());
    let test = if start.velocity >= PI { maximum_test(x, v) } else { f64::INFINITY };
    let root = next_root(start, start.velocity >= PI && test >= 0.0);
    let found = ExtendedLanding::near(&root, x, v, m / (m + 1.0));
    let mut landing = found.rounded(false);
    landing.sudden = is_sudden(landing.excess, landing.velocity);
    let mut bound = ErrorBound::of_extended(start.velocity, R::EPSILON).starting_at(start);
    bound.add_flight_on_branch(&landing, mass_ratio.kappa(), test);
    (found.settled && !bound.landing_inconclusive()).then_some(landing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flights that touch the ground without speed at τ = 2V, tan V = V/Y, to a few ulps of Y. The sign of the
    /// maximum test in 1024 bits says whether the touch is a landing.
    #[test]
    fn nearly_grazing_flights_land_on_the_branch_of_the_exact_start() {
        let ratio = MassRatio::new(3.0).unwrap();
        let (mut compared, mut plain_is_wrong) = (0, 0);
        for k in 0..300u32 {
            let part = 0.05 + 0.4 * (f64::from(k) * 0.618_033_988_749_895).fract();
            let v = (f64::from(k % 8 + 1) + part) * PI;
            let y = v * pxfm::f_cos(v) / pxfm::f_sin(v);
            for ulps in -3..=3i64 {
                let excess = f64::from_bits(y.to_bits().wrapping_add_signed(ulps)) - 1.0;
                if !(excess > 0.0) {
                    continue;
                }
                let start = TakeOff { excess, velocity: v };
                let test = maximum_test(Long::<16>::from(excess), Long::<16>::from(v));
                let Ok(landing) = decided_landing(start, ratio) else { continue };
                assert_eq!(landing.time <= 2.0 * v, test >= 0.0, "{start:?}");
                compared += 1;
                plain_is_wrong += usize::from(
                    (next_landing(start, ratio.kappa()).time <= 2.0 * v) != (test >= 0.0),
                );
            }
        }
        assert!(compared > 1500 && plain_is_wrong > 10, "{compared} {plain_is_wrong}");
    }
}
