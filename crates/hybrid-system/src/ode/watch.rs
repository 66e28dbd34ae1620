//! One guard along an integrated flow: its first crossing, by polynomials through its values.
//!
//! On an interval of a step the guard along the flow is represented by the polynomial Σ cₖ Tₖ(u) through its
//! values at 16 Chebyshev nodes. With ν a bound on what the last coefficients neglect, and on rounding,
//!
//! ```text
//!   |c₀| > Σ|cₖ| + ν         no zero on the interval
//!   |c₁| > Σ k²|cₖ| + ν′     monotone: a zero if and only if its sign changes      (k ≥ 2)
//!   else                     the interval is halved
//! ```
//!
//! A start at zero is left by the sign of (g(t) − g(0))/tᵏ, if that has no zero for some k.

use super::chebyshev::{CHEBYSHEV, NODES as VALUES};
use super::step::Step;
use crate::crossing::{beyond, rounding_at};
use crate::{Direction, Error, State, bracketed_root};

/// Halvings of one step.
const HALVINGS: usize = 64;

/// Intervals of one step that are looked at.
const INTERVALS: usize = 100_000;

/// How many times the last two coefficients bound what follows them.
const NEGLECTED: f64 = 8.0;

/// Roundings in the values and in their transformation.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON;

/// Σ k² for k < 16: how coefficients of size one show in a slope.
const SLOPE: f64 = 1240.0;

/// Ulps, of the largest value on a step, that its interpolant is rounded by: its weights are large, of both signs.
const INSIDE: f64 = 64.0;

/// Rounding on a step may exceed that of its start by this, before a shorter step is taken.
const LARGER: f64 = 4.0 * INSIDE;

/// What a shorter step is to the one before.
const SHORTER: f64 = 0.01;

/// How far, relative to the state, its rate is followed to see where a guard tends.
const REACH: f64 = 1e-8;

/// Multiple of a guard's bend that its change must exceed to be a rate.
const STRAIGHT: f64 = 1.0;

/// Multiples of its rounding up to which a guard that started at zero has not left it.
const LEFT: f64 = 1000.0;

/// A guard followed from step to step.
pub(super) struct Watch {
    direction: Direction,
    /// The side of the surface it is on; nothing as long as it has not left the zero it started at.
    side: Option<f64>,
    /// The sign of its rate at a start at zero, where rounding does not hide that.
    rate: Option<f64>,
    /// Its value at the start, and how much of that the rounding of the state may be.
    start: (f64, f64),
}

/// What a step holds.
pub(super) enum Ahead {
    /// A crossing here.
    At {
        /// When.
        time: f64,
    },
    /// It comes so close to zero here that rounding hides whether it crosses.
    Grazing {
        /// When.
        time: f64,
        /// Its value there.
        value: f64,
    },
    /// Rounding hides what it does by this time: it starts too close to zero for a step so long, or left a
    /// start at zero to one side and came back and through to the other.
    Hidden {
        /// The time.
        until: f64,
    },
    /// No crossing.
    Never,
}

/// What an interval holds.
enum Found {
    /// No zero, and this sign.
    Nothing(f64),
    /// It is monotone with a slope of this sign.
    Monotone(f64),
    /// All values are within rounding.
    Rounding,
    /// Not known.
    Unknown,
}

impl Watch {
    /// From a start; the guard there counts as zero if a rounding of the state makes up for it.
    pub(super) fn new<const N: usize>(
        direction: Direction,
        start: &State<N>,
        rate: &State<N>,
        guard: impl Fn(&State<N>) -> f64,
    ) -> Result<Self, Error> {
        let value = guard(start);
        if !value.is_finite() {
            return Err(Error::NotFinite { at: 0.0, value });
        }
        let rounding = rounding_at(start, &start.abs(), &guard);
        let side = (value.abs() > rounding).then(|| value.signum());
        let reach = REACH * (1.0 + start.amax()) / rate.amax();
        // On both sides, so that a bent guard does not mislead.
        let (ahead, behind) = (guard(&(start + rate * reach)), guard(&(start - rate * reach)));
        let (change, bend) = (ahead - behind, ahead + behind - 2.0 * value);
        let plain = change.abs() > rounding && change.abs() > STRAIGHT * bend.abs();
        let rate = plain.then(|| change.signum());
        Ok(Watch { direction, side, rate, start: (value, rounding) })
    }

    /// Whether it stays on its side all along a step: its values at the stages, and at eighths of the step, are
    /// farther from zero than half of what they vary by. What dips to zero and back shows in them if it takes an
    /// eighth of the step.
    pub(super) fn stays(&self, values: impl Iterator<Item = f64>) -> bool {
        let Some(side) = self.side else { return false };
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0);
        for value in values {
            let distance = side * value;
            if !(distance > 0.0) {
                return false;
            }
            nearest = if distance < nearest { distance } else { nearest };
            farthest = if distance > farthest { distance } else { farthest };
        }
        2.0 * nearest > farthest - nearest
    }

    /// The first crossing on a step, no later than `until`.
    pub(super) fn crossing<const N: usize>(
        &mut self,
        step: &Step<N>,
        until: f64,
        guard: impl Fn(&State<N>) -> f64,
    ) -> Result<Ahead, Error> {
        let along = |time: f64| guard(&step.state(time));
        let mut left = step.from;
        let size = step.size() * INSIDE;
        let rounding_near = |time: f64| rounding_at(&step.state(time), &size, &guard);
        let (value, own) = self.start;
        let faces = self.side.is_some_and(|side| self.direction.admits(side, -side));
        let rounding = rounding_near(left);
        // Whether a shorter first step would show more.
        let coarse = step.from == 0.0 && rounding > LARGER * own;
        if coarse && faces && value.abs() <= LEFT * rounding {
            return Ok(Ahead::Hidden { until: SHORTER * step.to });
        }
        let mut ends = [until; HALVINGS];
        let mut open = 1;
        for _ in 0..INTERVALS {
            if open == 0 {
                return Ok(Ahead::Never);
            }
            let right = ends[open - 1];
            if left >= right {
                open -= 1;
                continue;
            }
            let rounding = rounding_near(left).max(rounding_near(right));
            let found = match self.side {
                None => leave(along, left, right, rounding)?,
                Some(_) => look(along, left, right, rounding)?,
            };
            let sign = match found {
                Found::Nothing(sign) => Some(sign),
                Found::Monotone(slope) => self.behind(along(right), slope),
                Found::Rounding if self.side.is_none() => None,
                Found::Rounding | Found::Unknown => {
                    let middle = left + 0.5 * (right - left);
                    let narrow = middle <= left || middle >= right || open == HALVINGS;
                    if !narrow && !matches!(found, Found::Rounding) {
                        ends[open] = middle;
                        open += 1;
                        continue;
                    }
                    if coarse {
                        return Ok(Ahead::Hidden { until: SHORTER * step.to });
                    }
                    return Ok(Ahead::Grazing { time: middle, value: along(middle) });
                }
            };
            if let (Some(before), Some(after)) = (self.side, sign)
                && self.direction.admits(before, after)
            {
                let time = root(along, left, right, before)?;
                return Ok(Ahead::At { time });
            }
            if let (None, Some(after), Some(rate)) = (self.side, sign, self.rate)
                && rate != after
                && self.direction.leads_to(after)
            {
                return Ok(Ahead::Hidden { until: right });
            }
            self.side = sign.or(self.side);
            left = right;
        }
        Err(Error::NoConvergence { left, right: step.to, iterations: INTERVALS })
    }

    /// The side it is on behind a monotone stretch that ends with `value`.
    fn behind(&self, value: f64, slope: f64) -> Option<f64> {
        match self.side {
            None => Some(slope),
            Some(side) if slope * side < 0.0 && value * side < 0.0 => Some(-side),
            same => same,
        }
    }
}

/// What the polynomial through 16 values says.
fn look(along: impl Fn(f64) -> f64, left: f64, right: f64, rounding: f64) -> Result<Found, Error> {
    let values = values(along, left, right)?;
    Ok(judge(&values, rounding))
}

fn judge(values: &[f64; VALUES], rounding: f64) -> Found {
    let size = largest(values);
    let noise = ROUNDINGS * size + rounding;
    // Twice: what exceeds that is told apart from what does not.
    if size <= 2.0 * rounding {
        return Found::Rounding;
    }
    let c: [f64; VALUES] = CHEBYSHEV.coefficients(values);
    let tail = tail(&c);
    let others: f64 = c[1..].iter().map(|c| c.abs()).sum();
    if c[0].abs() > others + tail + noise {
        return Found::Nothing(c[0].signum());
    }
    let bends: f64 = (2..VALUES).map(|k| (k * k) as f64 * c[k].abs()).sum();
    let last = (VALUES * VALUES) as f64;
    if c[1].abs() > bends + last * tail + SLOPE * noise {
        return Found::Monotone(c[1].signum());
    }
    Found::Unknown
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, value| size.max(value.abs()))
}

/// What the coefficients neglect.
fn tail(c: &[f64]) -> f64 {
    NEGLECTED * c.iter().rev().take(2).map(|c| c.abs()).sum::<f64>()
}

/// Whether the polynomial through the values is zero at the left end, but for `noise`.
fn starts_at_zero(values: &[f64; VALUES], noise: f64) -> bool {
    let c: [f64; VALUES] = CHEBYSHEV.coefficients(values);
    let start: f64 = c.iter().enumerate().map(|(k, c)| if k % 2 == 0 { *c } else { -c }).sum();
    start.abs() <= tail(&c) + ROUNDINGS * largest(values) + noise
}

/// How a guard that starts at zero leaves it: as (g(t) − g(0))/τᵏ, if that has no zero and its predecessors
/// start at zero.
fn leave(along: impl Fn(f64) -> f64, left: f64, right: f64, rounding: f64) -> Result<Found, Error> {
    let start = along(left);
    let values = values(along, left, right)?;
    let size = largest(&values);
    if size <= LEFT * rounding {
        return Ok(Found::Rounding);
    }
    let plain = judge(&values, rounding);
    if !matches!(plain, Found::Unknown) {
        return Ok(plain);
    }
    // τ ∈ (0, 1), largest first.
    let tau = CHEBYSHEV.nodes.map(|u| 0.5 * (1.0 + u));
    let mut divided = values.map(|value| value - start);
    let mut noise = ROUNDINGS * size + rounding + start.abs();
    for _order in 1..=4 {
        if !starts_at_zero(&divided, noise) {
            break;
        }
        for (value, tau) in divided.iter_mut().zip(tau) {
            *value /= tau;
        }
        noise /= tau[VALUES - 1];
        if let found @ Found::Nothing(_) = judge(&divided, noise) {
            return Ok(found);
        }
    }
    Ok(Found::Unknown)
}

fn values(along: impl Fn(f64) -> f64, left: f64, right: f64) -> Result<[f64; VALUES], Error> {
    let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
    let mut values = [0.0; VALUES];
    for (value, node) in values.iter_mut().zip(CHEBYSHEV.nodes) {
        let at = (middle + radius * node).clamp(left, right);
        *value = along(at);
        if !value.is_finite() {
            return Err(Error::NotFinite { at, value: *value });
        }
    }
    Ok(values)
}

/// The zero of a stretch that starts on side `before` and ends on the other, or rounds to.
fn root(along: impl Fn(f64) -> f64, left: f64, right: f64, before: f64) -> Result<f64, Error> {
    if along(left) * before <= 0.0 {
        return Ok(left);
    }
    let at_right = along(right);
    if at_right * before >= 0.0 {
        return Ok(right);
    }
    let time = bracketed_root(&along, left, right)?;
    Ok(beyond(along, time, right, at_right))
}
