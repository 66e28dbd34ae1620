//! The first landing of a flight that starts in any state.
//!
//! In exact arithmetic no root is missed. Here the signs are computed in `f64` without bounds on their errors: next
//! to a touch without speed, where G is as small as its rounding error, the result may be the landing before or
//! after it.
//!
//! G'' = s − 1 changes its sign only where s = 1: at τ = φ ± γ + 2πk with R e^{iφ} = s₀ + iṡ₀ and γ = acos(1/R).
//! Between two neighbouring times of this lattice G is convex (s > 1) or concave (s < 1). Therefore the signs of G at
//! the two ends of a piece, and at the minimum of a convex piece, decide whether G has a root in the piece. No samples
//! are needed. Where P > R, G is positive, and such pieces are skipped.
//!
//! Proof: docs/theory.md, Lemma 15.

use crate::model::motion::Flight;
use interval_arithmetic::{Error, bracketed_root};
use std::f64::consts::TAU;

/// Time of the first landing: the first zero of G with G falling, after a start with G ≥ 0.
///
/// If the lower mass is on the ground at the start and does not leave it, the time is 0.
pub(crate) fn landing_time(flight: &Flight) -> Result<f64, Error> {
    let (g, g_rate) = flight.height;
    let (s, s_rate) = flight.stretch;
    // A start on the ground: the sign of the first non-zero derivative of G decides whether the lower mass leaves. The
    // derivatives are Ġ, G̈ = s − 1, G⃛ = ṡ and, for s = 1 and ṡ = 0, the fourth, −s = −1.
    let leaving = [g_rate, s - 1.0, s_rate, -1.0].into_iter().find(|&d| d != 0.0);
    if g == 0.0 && leaving.is_none_or(|derivative| derivative < 0.0) {
        return Ok(0.0);
    }
    let lattice = Lattice::new(s, s_rate);
    let clear = clear_interval(flight, lattice.radius);
    let mut left = 0.0;
    // Each pass of the loop treats one piece. Pieces with P > R are skipped. All other pieces begin while P is within
    // ±R of zero. That time is finite, so that the loop ends.
    loop {
        if left >= clear.0 && left < clear.1 {
            left = lattice.last_before(clear.1).max(left);
        }
        let right = lattice.next_after(left).unwrap_or_else(|| end_of_fall(flight, lattice.radius));
        if let Some(time) = root_in_piece(flight, left, right)? {
            return Ok(time);
        }
        left = right;
    }
}

/// The first root of G in a piece without inflection; G(left) ≥ 0.
fn root_in_piece(flight: &Flight, left: f64, right: f64) -> Result<Option<f64>, Error> {
    let g = |t: f64| flight.height(t).0;
    let slope = |t: f64| flight.height(t).1;
    let convex = flight.stretch(0.5 * (left + right)).0 > 1.0;
    let at_right = g(right);
    if convex && at_right > 0.0 {
        // G is positive at both ends and convex: it has two roots if its minimum is negative, else none.
        if !(slope(left) < 0.0 && slope(right) > 0.0) {
            return Ok(None);
        }
        let lowest = bracketed_root(slope, left, right)?;
        if !(g(lowest) < 0.0) {
            return Ok(None);
        }
        return bracketed_root(g, left, lowest).map(Some);
    }
    if at_right > 0.0 {
        return Ok(None);
    }
    // The piece has one root after `left`. At a start on the ground `left` is a root as well: the search then begins at
    // the maximum of G that follows.
    let from = if g(left) <= 0.0 && slope(left) >= 0.0 && slope(right) < 0.0 {
        bracketed_root(slope, left, right)?
    } else {
        left
    };
    if !(g(from) > 0.0) || at_right == 0.0 {
        return Ok(Some(if at_right == 0.0 { right } else { from }));
    }
    bracketed_root(g, from, right).map(Some)
}

/// The interval of times at which P > R, so that G = P − s > 0. If P never exceeds R, both ends are infinite, and the
/// interval is empty.
fn clear_interval(flight: &Flight, radius: f64) -> (f64, f64) {
    let (p, rate) = flight.momentum;
    let discriminant = rate * rate + 2.0 * (p - radius);
    if discriminant <= 0.0 {
        return (f64::INFINITY, f64::INFINITY);
    }
    let root = discriminant.sqrt();
    (rate - root, rate + root)
}

/// A time at which P < −R, so that the height is negative: the time at which P falls to −R − 1, plus one.
fn end_of_fall(flight: &Flight, radius: f64) -> f64 {
    let (p, rate) = flight.momentum;
    let depth = radius + 1.0;
    rate + (rate * rate + 2.0 * (p + depth).max(0.0)).sqrt() + 1.0
}

/// The times at which s = 1.
struct Lattice {
    radius: f64,
    /// φ − γ and φ + γ; `None` if s never reaches one.
    phases: Option<[f64; 2]>,
}

impl Lattice {
    fn new(s: f64, s_rate: f64) -> Self {
        let radius = pxfm::f_hypot(s, s_rate);
        let phase = pxfm::f_atan2(s_rate, s);
        let phases = (radius > 1.0).then(|| {
            let gamma = pxfm::f_acos(1.0 / radius);
            [phase - gamma, phase + gamma]
        });
        Lattice { radius, phases }
    }

    fn next_after(&self, time: f64) -> Option<f64> {
        let after = |phase: f64| {
            let mut periods = ((time - phase) / TAU).floor() + 1.0;
            // A rounded quotient may give `time` itself, on which the loop over pieces would not advance.
            while phase + periods * TAU <= time {
                periods += 1.0;
            }
            phase + periods * TAU
        };
        self.phases.map(|[a, b]| after(a).min(after(b)))
    }

    fn last_before(&self, time: f64) -> f64 {
        let before = |phase: f64| phase + ((time - phase) / TAU).floor() * TAU;
        self.phases.map_or(0.0, |[a, b]| before(a).max(before(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::first_landing::first_landing;
    use crate::landing::flight_ends::TakeOff;
    use crate::landing::next_landing::next_landing;
    use crate::model::mass_ratio::MassRatio;
    use crate::model::state::HopperState;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Against the half-time solver, from the ground.
        #[test]
        fn agrees_with_the_landing_from_the_ground(alpha in 1e-2..60f64, m in 0.05..20f64) {
            let ratio = MassRatio::new(m).unwrap();
            let flight = Flight::new(ratio, &HopperState::lift_off(alpha));
            let time = landing_time(&flight).unwrap();
            let landing = first_landing(alpha, ratio.kappa());
            // The condition number of the time grows like 1/Γ.
            let tolerance = 1e-13 * (1.0 + time) * (1.0 + alpha / landing.closing_speed.max(1e-9));
            prop_assert!((time - landing.time).abs() < tolerance, "{time} {}", landing.time);
        }

        /// Against dense sampling, from the air.
        #[test]
        fn no_earlier_landing_is_missed(
            y1 in -20.0..20f64, v1 in -20.0..20f64, y2 in 0.0..10f64, v2 in -20.0..20f64, m in 0.05..20f64,
        ) {
            let state = HopperState {
                upper_position: y1, upper_velocity: v1, lower_position: y2, lower_velocity: v2,
            };
            let flight = Flight::new(MassRatio::new(m).unwrap(), &state);
            let time = landing_time(&flight).unwrap();
            let scale = (1.0 + m) * 1000.0;
            prop_assert!(flight.height(time).0.abs() < 1e-11 * scale);
            for k in 1..2000 {
                let earlier = time * f64::from(k) / 2000.0;
                prop_assert!(flight.height(earlier).0 > -1e-11 * scale, "below ground at {earlier} of {time}");
            }
        }
    }

    proptest! {
        /// Flights from the ground that touch it at τ = 2V (tan V = V/Y), to a few ulps. The touch loses no energy.
        /// Each solver may count it as a landing or not. The times of both are landings, and no earlier landing exists.
        #[test]
        fn grazing_flights(m in 1u32..8, part in 0.05..0.95f64, ulps in -4..5i64, ratio in 0.05..20f64) {
            let v = (f64::from(m) + 0.5 * part) * std::f64::consts::PI;
            let y = v * pxfm::f_cos(v) / pxfm::f_sin(v);
            prop_assume!(y > 1.0);
            let y = f64::from_bits(y.to_bits().wrapping_add_signed(ulps));
            let ratio = MassRatio::new(ratio).unwrap();
            let state = HopperState { upper_position: y, upper_velocity: v, ..HopperState::RELAXED };
            let flight = Flight::new(ratio, &state);
            let start = TakeOff { excess: y - 1.0, velocity: v };
            let solved = next_landing(start, ratio.kappa()).time;
            for time in [landing_time(&flight).unwrap(), solved] {
                let touch = (time - 2.0 * v).abs() < 1e-6 * v;
                let (height, rate) = flight.height(time);
                prop_assert!(height.abs() < 1e-12 * (1.0 + v * v));
                prop_assert!(!touch || rate.abs() < 1e-5 * (1.0 + v), "{rate}");
                for k in 1..500 {
                    let earlier = time * f64::from(k) / 500.0;
                    prop_assert!(flight.height(earlier).0 > -1e-12 * (1.0 + v * v));
                }
            }
        }
    }

    #[test]
    fn standing_still_lands_at_once() {
        let flight = Flight::new(MassRatio::ONE, &HopperState::RELAXED);
        assert_eq!(landing_time(&flight), Ok(0.0));
    }
}
