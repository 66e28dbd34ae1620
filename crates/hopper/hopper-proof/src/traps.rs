//! Traps and crises, enclosed.
//!
//! On the contact part of hump n let q(α) = (α² − α*_n²)/Γ². It falls to its minimum μ_c(n), and rises beyond it;
//! the sign of T = Γ² − 4W (α² − α*_n²) is negative before the minimum and positive beyond it. While q > μ the map
//! stays above α*_n. So two signs at one speed prove a trap, for this μ and all smaller ones (docs/theory.md,
//! Theorems 29 and 31; α*_0 = 0).

use crate::error::Error;
use crate::fixed_points::{fixed_point, offset_from_fixed_point};
use crate::hop::first_landing::FirstLanding;
use crate::hop::hop_enclosure::w_over;
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use basin_of_attraction::Interval;
use hopper_basin::{Trap, TrapEdge, rising_window};
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::{HalfFlight, MassRatio};

/// Halvings of the bracket of a touch: from a length of 3 to neighbouring `f64`.
const HALVINGS: usize = 60;

/// Steps to the left of a computed edge of a trap until its signs are certain, each four times as long as the one
/// before. The first one is an ulp, so that the last one is longer than the trap.
const STEPS: usize = 30;

/// Halvings of the last step: the end that is proved is then within a sixteenth of it.
const LAST_HALVINGS: usize = 4;

/// q and T at one speed of a contact part.
struct AtSpeed {
    q: Enclosure,
    t: Enclosure,
}

impl AtSpeed {
    fn new(n: u64, alpha: f64) -> Option<Self> {
        let speed = Enclosure::from(alpha);
        let first = FirstLanding::over(speed, SpeedPart::Contact(n))?;
        let square = first.closing_speed().squared();
        let star = fixed_point(n);
        let rise = offset_from_fixed_point(alpha, n) * (speed + star);
        let [low, high] = first.w_at_ends();
        let w = low.hull(&high);
        Some(AtSpeed { q: rise / square, t: square - 4.0 * w * rise })
    }
}

/// The place where the minimum of the map on hump n touches α*_n, and the mass parameter at which it does: a
/// crisis; for n = 0 it touches 0, and the hopper is grounded beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProvedCrisis {
    /// The hump.
    pub n: u64,
    /// The speed.
    pub speed: Enclosure,
    /// μ_c = M_c/(1+M_c)².
    pub mu: Enclosure,
}

impl ProvedCrisis {
    /// The touch of hump n.
    ///
    /// # Errors
    /// [`Error::Open`] if no sign is certain, for humps so far up that α*_n has no digits left.
    ///
    /// ```
    /// // The crisis of hump 1.
    /// let touch = hopper_proof::ProvedCrisis::new(1)?;
    /// let crisis = touch.mass_ratio();
    /// assert!(crisis.contains(0.10345775533613707) && crisis.width() < 1e-13);
    /// # Ok::<(), hopper_proof::Error>(())
    /// ```
    pub fn new(n: u64) -> Result<Self, Error> {
        let open = Error::Open { what: "the touch", n, mass_ratio: f64::NAN };
        // W is largest at h = ½α*_{2n+1}, left of the touch; T is positive at the end.
        let mut low = HalfFlight::at(0.5 * fixed_point(2 * n + 1).middle()).start_speed(0.0);
        let mut high = (PI * (n + 1) as f64).low();
        let sign = |alpha: f64| AtSpeed::new(n, alpha).and_then(|at| at.t.sign());
        for _ in 0..HALVINGS {
            let middle = low.midpoint(high);
            match sign(middle) {
                Some(sign) if sign < 0.0 => low = middle,
                Some(_) => high = middle,
                // Within the error of T: from both sides up to here.
                None => {
                    let side = |end: f64, wanted: f64| {
                        let near = |k: i32| middle + (end - middle) * 2f64.powi(-k);
                        (1..HALVINGS as i32).rev().map(near).find(|&at| sign(at) == Some(wanted))
                    };
                    low = side(low, -1.0).unwrap_or(low);
                    high = side(high, 1.0).unwrap_or(high);
                    break;
                }
            }
        }
        let (Some(left), Some(right)) = (AtSpeed::new(n, low), AtSpeed::new(n, high)) else {
            return Err(open);
        };
        if !(left.t.is_negative() && right.t.is_positive()) {
            return Err(open);
        }
        // The minimum of q lies between. There 4μW = 1 as well, and q is at most its value at both ends.
        let speed = Enclosure::new(low, high);
        let Some(first) = FirstLanding::over(speed, SpeedPart::Contact(n)) else {
            return Err(open);
        };
        let by_w = Enclosure::ONE / (4.0 * w_over(&first, n));
        let mu = Enclosure::new(by_w.low(), by_w.high().min(left.q.high()).min(right.q.high()));
        Ok(ProvedCrisis { n, speed, mu })
    }

    /// The mass ratio M_c ≤ 1 of the touch. 1/M_c is the other one.
    pub fn mass_ratio(&self) -> Enclosure {
        // μ = M/(1+M)², so M = (1 − 2μ − √(1 − 4μ))/(2μ) = 2μ/(1 − 2μ + √(1 − 4μ)).
        let root = (Enclosure::ONE - 4.0 * self.mu).sqrt().unwrap_or(Enclosure::WHOLE);
        2.0 * self.mu / (Enclosure::ONE - 2.0 * self.mu + root)
    }
}

/// The speeds from α*_n up that are proved to converge to α*_n, at all mass ratios of a strip; for n = 0 those
/// whose hops become ever lower.
///
/// # Errors
/// [`Error::Open`] if no trap is proved, [`Error::Basin`] for a hump that the library does not have.
pub fn proved_trap(n: u64, strip: &Strip) -> Result<Interval, Error> {
    let left = fixed_point(n).high();
    let open = Error::Open { what: "the trap", n, mass_ratio: strip.mass_ratios.low() };
    let touch = ProvedCrisis::new(n)?;
    let end = (PI * (n + 1) as f64).low();
    let heaviest = strip.mass_ratios.high();
    if strip.mu.high() < touch.mu.low() {
        // f stays above α*_n on the contact part. Where it rises over the window beyond, the trap reaches to the
        // next fixed point (docs/theory.md, Corollary 94).
        let rises = heaviest < 1.0
            && rising_window(n + 1).is_some_and(|window| heaviest <= window.largest_mass_ratio);
        return Ok(Interval { left, right: if rises { fixed_point(n + 1).low() } else { end } });
    }
    // The edge is at the largest μ of the strip: that of an end, or M = 1.
    let steepest = if strip.mass_ratios.contains(1.0) {
        1.0
    } else if heaviest < 1.0 {
        heaviest
    } else {
        strip.mass_ratios.low()
    };
    let trap = Trap::new(n, MassRatio::new(steepest)?)?;
    let computed = match trap.edge {
        TrapEdge::Crossing => fixed_point(n).middle() + trap.delta,
        TrapEdge::ContactEnd | TrapEdge::NextFixedPoint => touch.speed.low(),
    };
    let is_inside = |right: f64| {
        AtSpeed::new(n, right).is_some_and(|at| at.q.low() > strip.mu.high() && at.t.is_negative())
    };
    let first = computed.min(touch.speed.low());
    let steps = (0..STEPS as i32).map(|k| first - first * f64::EPSILON * 4f64.powi(k));
    let proved = steps.take_while(|&right| right > left).find(|&right| is_inside(right));
    let Some(mut right) = proved else { return Err(open) };
    // The last step was up to four times too long.
    let mut beyond = first - 0.25 * (first - right);
    for _ in 0..LAST_HALVINGS {
        let middle = right.midpoint(beyond);
        if is_inside(middle) { right = middle } else { beyond = middle }
    }
    Ok(Interval { left, right })
}

/// The map is certainly below α*_n at a speed of the contact part of hump n, at all mass ratios of a strip.
pub(crate) fn falls_below(n: u64, speed: f64, strip: &Strip) -> bool {
    AtSpeed::new(n, speed).is_some_and(|at| at.q.high() < strip.mu.low())
}
