//! The time of a landing, enclosed by two signs of the height.
//!
//! ```text
//!         V − V_x(h) > 0: in the air     the landing      V − V_x(h) < 0: below the ground
//!      ───────────●─────────────────────────┼───────────────────────●──────────► h
//!                low                                               high
//! ```
//!
//! The search for `low` and `high` is plain arithmetic and proves nothing. What proves is the sign of the enclosed
//! difference at each of them, on a bracket where theory allows one change of sign (docs/theory.md, Theorems 7 and
//! 12).

use crate::fixed_points::fixed_point;
use crate::hop::half_time::AtHalfTime;
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::{HalfFlight, TakeOff, index_below};

/// The first distance from the found h at which a sign is looked for, in units of its rounding error. With less,
/// more signs are looked for twice; with more, the landing is less sharp.
const FIRST_DISTANCE: f64 = 4.0;

/// Times the distance from the found time grows if a sign is not certain, and how often. From some ulps, 24 times 4
/// is 10¹⁴.
const GROWTH: f64 = 4.0;
const ATTEMPTS: usize = 24;

/// A landing: the branch of increasing start speeds on which it lies, and where to look for the signs beside it.
///
/// The branch is the only b for which half the time lies in (α*_{b−1}, α*_b).
#[derive(Debug, Clone, Copy)]
pub(crate) struct LandingTime {
    pub(crate) branch: u64,
    start: TakeOff,
    /// It holds h for certain.
    bracket: Enclosure,
    /// h as it was found, and the first distance from it at which a sign is looked for.
    found: f64,
    first_distance: f64,
}

impl LandingTime {
    /// A landing whose h lies in `bracket`, found by a search.
    fn search(branch: u64, start: TakeOff, bracket: Enclosure) -> Option<Self> {
        let TakeOff { excess: x, velocity: v } = start;
        let flight = HalfFlight::of(start)?;
        let (h, slope) = (flight.half_time(), flight.start_speed_slope(x));
        let rest = (v - flight.start_speed(x)) / slope;
        let found = if rest.abs() < 0.5 * h { h + rest } else { h };
        // The rounding error of V − V_x(h), over its slope: larger next to Γ = 0.
        let sin = flight.sin();
        let scale = (v - h).abs() + (sin * flight.rho()).abs() + x * sin * sin / flight.d();
        let first_distance = (FIRST_DISTANCE * f64::EPSILON * scale / slope)
            .clamp(2.0 * f64::EPSILON * found, 1e-3 * found);
        Some(LandingTime { branch, start, bracket, found, first_distance })
    }

    /// The functions at a time before the landing.
    pub(crate) fn before(&self) -> AtHalfTime {
        let end = self.bracket.low();
        self.with_sign(-1.0, end).unwrap_or_else(|| AtHalfTime::new(end))
    }

    /// The functions at a time after it.
    pub(crate) fn after(&self) -> AtHalfTime {
        let end = self.bracket.high();
        self.with_sign(1.0, end).unwrap_or_else(|| AtHalfTime::new(end))
    }

    /// The functions at the nearest of some times on one side of the found one, up to `end`, that a sign shows to
    /// be on this side of the landing.
    fn with_sign(&self, direction: f64, end: f64) -> Option<AtHalfTime> {
        let TakeOff { excess: x, velocity: v } = self.start;
        let mut distance = self.first_distance;
        for _ in 0..ATTEMPTS {
            let h = self.found + direction * distance;
            let is_short = direction * (h - end) < 0.0;
            if !is_short {
                return None;
            }
            // Outside of the bracket there may be other changes of sign.
            if self.bracket.contains(h) {
                let at = AtHalfTime::new(h);
                if at.speed_to_spare(x, v).sign() == Some(-direction) {
                    return Some(at);
                }
            }
            distance *= GROWTH;
        }
        None
    }
}

/// The landing of the flight from (0, α), α > 0. It has one landing in all (docs/theory.md, Theorem 7).
pub(crate) fn first_landing_time(alpha: f64) -> Option<LandingTime> {
    let n = index_below(alpha).ok()?;
    // α and h lie between the same two neighbouring multiples of π (Theorem 7); half of π more on both sides covers
    // the rounding of the quotient.
    let k = (alpha / std::f64::consts::PI).floor();
    let bracket = Enclosure::new((k - 0.5).max(0.0) * PI.low(), (k + 1.5) * PI.high());
    LandingTime::search(n + 1, TakeOff { excess: 0.0, velocity: alpha }, bracket)
}

/// The first landing of the flight from the stretch x > 0 with velocity `v` (docs/theory.md, Theorem 12); `None`
/// next to a grazing, and where the multiples of π do not tell the branch.
pub(crate) fn next_landing_time(x: f64, v: f64) -> Option<LandingTime> {
    let pi = std::f64::consts::PI;
    let m = if v > 0.0 { (v / pi).floor() } else { 0.0 };
    if !(m < 1e9) || (m > 0.0 && !((PI * m).high() <= v)) || !(v < (PI * (m + 1.0)).low()) {
        return None;
    }
    let speed = Enclosure::from(v);
    let mut same_branch = false;
    if m >= 1.0 {
        let test = speed * speed.cos() - (1.0 + Enclosure::from(x)) * speed.sin();
        let sign = test.sign()?;
        same_branch = if m % 2.0 == 0.0 { sign > 0.0 } else { sign < 0.0 };
    }
    let branch = m as u64 + u64::from(!same_branch);
    let half = if same_branch {
        Enclosure::new((PI * m).low(), v)
    } else {
        let star = if m >= 1.0 { fixed_point(m as u64).low() } else { 0.0 };
        Enclosure::new(star.max(v), (PI * (m + 1.0)).high())
    };
    LandingTime::search(branch, TakeOff { excess: x, velocity: v }, half)
}

/// The landings of all flights from x in `stretches`, x ≥ 0, with V in `velocities`, lie between the two ends: on
/// one branch the time rises with x and V, and the branch does not fall with them (docs/theory.md, Theorem 12 and
/// Lemma 14).
pub(crate) fn landings_between(
    stretches: Enclosure,
    velocities: Enclosure,
) -> Option<[AtHalfTime; 2]> {
    let at = |x: f64, v: f64| match x > 0.0 {
        true => next_landing_time(x, v),
        false if v > 0.0 => first_landing_time(v),
        // Without a stretch a flight with V ≤ 0 ends at once (docs/theory.md, Lemma 22).
        false => {
            let start = TakeOff { excess: 0.0, velocity: v };
            let bracket = Enclosure::ZERO;
            Some(LandingTime { branch: 1, start, bracket, found: 0.0, first_distance: 0.0 })
        }
    };
    let first = at(stretches.low(), velocities.low())?;
    let last = at(stretches.high(), velocities.high())?;
    (first.branch == last.branch).then(|| [first.before(), last.after()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A found time beyond the bracket, as a correction of first order may give next to a grazing: no sign is taken
    /// there.
    #[test]
    fn signs_are_taken_inside_the_bracket_alone() {
        let start = TakeOff { excess: 1.0, velocity: 2.0 };
        let whole = next_landing_time(1.0, 2.0).unwrap();
        let (before, after) = (whole.before().h, whole.after().h);
        assert!(before < 3.2 && after - before < 1e-12, "{whole:?}");
        for bracket in [Enclosure::new(0.5, 1.5), Enclosure::new(3.1, 3.13)] {
            let found = LandingTime::search(1, start, bracket).unwrap();
            assert_eq!((found.before().h, found.after().h), (bracket.low(), bracket.high()));
        }
    }
}
