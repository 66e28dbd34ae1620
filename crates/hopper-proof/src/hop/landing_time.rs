//! The time of a landing, enclosed by two signs of the height.
//!
//! ```text
//!   V_x(h), the velocity of the start whose flight from the stretch x lasts 2h, rises on its branch:
//!
//!         G(2h) > 0: in the air         the landing         G(2h) < 0: below the ground
//!      ───────────●─────────────────────────┼───────────────────────●──────────► h
//!                low                                               high
//! ```
//!
//! The search for `low` and `high` is plain arithmetic and proves nothing. What proves is the sign of an enclosure of G at each of
//! them, on a bracket where theory allows one change of sign (docs/theory.md, Theorems 7 and 12).

use crate::fixed_points::fixed_point;
use crate::hop::time_functions::TimeFunctions;
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::{FixedPointSpeed, HalfFlight, LocalFlight, index_below};

/// Steps of Newton's method inside a bracket. A step that leaves the bracket is replaced by a halving, so that some sixty steps always
/// suffice. It affects the width of the enclosure only.
const STEPS: usize = 64;

/// Times the distance from the found time grows if a sign is not certain, and how often. From some ulps, 24 times 4 is 10¹⁴.
const GROWTH: f64 = 4.0;
const ATTEMPTS: usize = 24;

/// A landing: the branch of increasing start speeds on which it lies, and its time.
///
/// The branch is the only b for which half the time lies in (α*_{b−1}, α*_b).
#[derive(Debug, Clone, Copy)]
pub(crate) struct LandingTime {
    pub(crate) branch: u64,
    pub(crate) time: Enclosure,
}

/// Half the time of a flight as a root in a bracket, by Newton's method; plain arithmetic.
fn half_time(x: f64, v: f64, (mut low, mut high): (f64, f64), start: f64) -> f64 {
    let mut h = start;
    for _ in 0..STEPS {
        if !(low < h && h < high) {
            h = low.midpoint(high);
        }
        let half = HalfFlight::at(h);
        let excess = half.start_speed(x) - v;
        if excess < 0.0 {
            low = h
        } else {
            high = h
        }
        let step = excess / half.start_speed_slope(x);
        if step.abs() <= 2.0 * f64::EPSILON * h || !(low < high) {
            break;
        }
        h -= step;
    }
    h.clamp(low.min(high), high)
}

/// The landing time between two times that enclose it already, by signs of G beside `found`. Without a sign that end stays.
fn between_signs(x: f64, v: f64, bracket: Enclosure, found: f64) -> Enclosure {
    let (stretch, velocity) = (Enclosure::new(x, x), Enclosure::new(v, v));
    let at = TimeFunctions::at(found);
    let height = at.height(stretch, velocity);
    // G falls with the closing speed Γ, so that the error of G is overcome at this distance. Next to Γ = 0 more is needed.
    let closing = (found - v * at.r.high - (1.0 + x) * at.sin.high).abs();
    let first = (2.0 * height.magnitude().max(height.width()) / closing)
        .clamp(4.0 * f64::EPSILON * found, 1e-3 * found);
    let look = |direction: f64, wanted: f64, end: f64| {
        let mut distance = first;
        for _ in 0..ATTEMPTS {
            let time = found + direction * distance;
            if direction * (time - end) >= 0.0 || !time.is_finite() {
                return end;
            }
            let sign = TimeFunctions::at(time).height(stretch, velocity).sign();
            if sign == Some(wanted) {
                return time;
            }
            distance *= GROWTH;
        }
        end
    };
    Enclosure::new(look(-1.0, 1.0, bracket.low), look(1.0, -1.0, bracket.high))
}

/// The landing of the flight from (0, α), α > 0. It has one landing in all (docs/theory.md, Theorem 7).
pub(crate) fn first_landing_time(alpha: f64) -> Option<LandingTime> {
    let n = index_below(alpha).ok()?;
    let end = (PI * (n + 1) as f64).high;
    // In a window h < α, in a contact part h > α; both lie between (n+1)π and α*_n, or α*_{n+1} beyond (n+1)π.
    let sudden = alpha > end;
    let (low, high) = if sudden { (end, alpha) } else { (alpha, end) };
    let near = if n == 0 && !sudden {
        low.midpoint(high)
    } else {
        let star = FixedPointSpeed::new(if sudden { n + 1 } else { n });
        let flight = LocalFlight::new(if sudden { n + 1 } else { n });
        star.value() + 0.5 * flight.time_shift(star.offset_of(alpha))
    };
    let found = 2.0 * half_time(0.0, alpha, (low, high), near);
    // α and h lie between the same two neighbouring multiples of π (Theorem 7); half of π more on both sides covers the rounding of the quotient.
    let k = (alpha / std::f64::consts::PI).floor();
    let bracket = Enclosure::new((2.0 * k - 1.0).max(0.0) * PI.low, (2.0 * k + 3.0) * PI.high);
    Some(LandingTime { branch: n + 1, time: between_signs(0.0, alpha, bracket, found) })
}

/// The first landing of the flight from the stretch x > 0 with velocity `v` (docs/theory.md, Theorem 12); `None` next to a grazing,
/// and where the multiples of π do not tell the branch.
pub(crate) fn next_landing_time(x: f64, v: f64) -> Option<LandingTime> {
    let pi = std::f64::consts::PI;
    let m = if v > 0.0 { (v / pi).floor() } else { 0.0 };
    if !(m < 1e9) || (m > 0.0 && !((PI * m).high <= v)) || !(v < (PI * (m + 1.0)).low) {
        return None;
    }
    let speed = Enclosure::new(v, v);
    let mut same_branch = false;
    if m >= 1.0 {
        let test = speed * speed.cos() - (1.0 + Enclosure::new(x, x)) * speed.sin();
        let sign = test.sign()?;
        same_branch = if m % 2.0 == 0.0 { sign > 0.0 } else { sign < 0.0 };
    }
    let branch = m as u64 + u64::from(!same_branch);
    let half = if same_branch {
        Enclosure::new((PI * m).low, v)
    } else {
        let star = if m >= 1.0 { fixed_point(m as u64).low } else { 0.0 };
        Enclosure::new(star.max(v), (PI * (m + 1.0)).high)
    };
    // A short flight lasts 3x/|V| (docs/theory.md, Theorem 23).
    let start = if v < 0.0 { 1.5 * x / -v } else { half.middle() };
    let found = 2.0 * half_time(x, v, (half.low, half.high), start);
    let time = between_signs(x, v, 2.0 * half, found);
    Some(LandingTime { branch, time: Enclosure::new(time.low.max(0.0), time.high) })
}

/// The landing times of all flights from x in `stretches`, x ≥ 0, with V in `velocities`: on one branch the time rises with x and V, and
/// the branch does not fall with them (docs/theory.md, Theorem 12 and Lemma 14).
pub(crate) fn landing_times(stretches: Enclosure, velocities: Enclosure) -> Option<Enclosure> {
    let at = |x: f64, v: f64| {
        // Without a stretch a flight with V ≤ 0 ends at once (docs/theory.md, Lemma 22).
        let grounded = LandingTime { branch: 1, time: Enclosure::ZERO };
        match x > 0.0 {
            true => next_landing_time(x, v),
            false if v <= 0.0 => Some(grounded),
            false => first_landing_time(v),
        }
    };
    let first = at(stretches.low, velocities.low)?;
    let last = at(stretches.high, velocities.high)?;
    (first.branch == last.branch).then(|| first.time.hull(&last.time))
}
