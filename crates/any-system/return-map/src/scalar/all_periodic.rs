//! All periodic points or equilibria in a window of one variable, each with a proof.

use crate::checks::{check_period, check_window};
use crate::error::Error;
use crate::families::check_without_time;
use equations::{Enclosure, Formulas};
use std::ops::ControlFlow;

/// What a search of a window has found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AllPeriodicPoints {
    /// The points, from left to right.
    pub points: Vec<ProvedPoint>,
    /// Intervals in which it is not known whether there are points, from left to right: at tangencies, and where the formula has no
    /// value. Everywhere else there are none.
    pub undecided: Vec<(f64, f64)>,
}

/// A point that was proved to exist, and to be the only one in its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProvedPoint {
    /// The interval in which the point is.
    pub at: Enclosure,
    /// An interval about it that contains no other one.
    pub alone_in: Enclosure,
    /// The multiplier: the derivative of fⁿ. For an equilibrium the derivative of the field.
    pub multiplier: Enclosure,
    /// The least period; `None` if it is not proved. 0 for an equilibrium.
    pub least_period: Option<usize>,
}

/// What is searched: fⁿ(x) = x, or f(x) = 0 for the period 0.
struct Equation {
    formula: Formulas,
    derivative: Formulas,
    period: usize,
}

/// The narrowest interval that is halved, as a part of the window: points that are closer to each other stay undecided.
const NARROWEST: f64 = 1e-11;

/// The same where the formula has no value: outside of its domain no interval is ever decided.
const NARROWEST_OUTSIDE: f64 = 1e-4;

/// A point of a shorter period is looked for about the known one, so many roundings beside it.
const ROUNDING: f64 = 1e-13;

/// Most intervals that are looked at. Simple points need some tens each; a map that is the identity would need all numbers.
const MOST_INTERVALS: usize = 10_000_000;

/// A simple zero at the end of an interval is found in one that is wider by this part on both sides.
const WIDER: f64 = 0.125;

/// All points x of a window with fⁿ(x) = x, for the formula of a map of one variable with its parameters: each is proved to exist and to be
/// alone in an interval, and there are no others outside of the intervals that are named as undecided.
///
/// `progress` receives the part of the window that is finished, from 0 to 1, after each interval. If it breaks, the rest is undecided.
///
/// Interval Newton method with the chain rule: R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*
/// (2009).
///
/// ```
/// use equations::{Formulas, Names};
/// use return_map::all_periodic_points;
/// let logistic = Formulas::from_text(Names::new(&["x"], &[("r", "3.9")])?, &["r*x*(1 - x)"])?;
/// let found = all_periodic_points(&logistic, 3, (-0.5, 1.5), |_| std::ops::ControlFlow::Continue(()))?;
/// // Two fixed points and two cycles of period three. There are no others.
/// assert_eq!((found.points.len(), found.undecided.len()), (8, 0));
/// assert_eq!(found.points.iter().filter(|point| point.least_period == Some(3)).count(), 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::BadArgument`] for a window that is empty or not finite; [`Error::Formula`] for more than one formula, for the time t, and for a
/// function without a derivative; [`Error::BadPeriod`]; [`Error::ManyPieces`] for a search without an end, as that of a map with a
/// line of fixed points.
pub fn all_periodic_points(
    map: &Formulas,
    period: usize,
    window: (f64, f64),
    progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<AllPeriodicPoints, Error> {
    check_period(period)?;
    search(map, period, window, progress)
}

/// All equilibria of a field of one variable in a window: as [`all_periodic_points`].
///
/// # Errors
/// As [`all_periodic_points`].
pub fn all_equilibria(
    field: &Formulas,
    window: (f64, f64),
    progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<AllPeriodicPoints, Error> {
    search(field, 0, window, progress)
}

fn search(
    formula: &Formulas,
    period: usize,
    (left, right): (f64, f64),
    mut progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<AllPeriodicPoints, Error> {
    check_window((left, right))?;
    let (needed, given) = (1, formula.count().max(formula.names().states.len()));
    if needed != given {
        return Err(
            equations::Error::Length { what: "formulas of a scalar map", needed, given }.into()
        );
    }
    check_without_time(formula)?;
    let equation = Equation { formula: formula.clone(), derivative: formula.jacobian()?, period };
    let mut found = AllPeriodicPoints::default();
    let mut todo = vec![Enclosure::new(left, right)];
    let mut looked_at = 0;
    while let Some(interval) = todo.pop() {
        looked_at += 1;
        if looked_at > MOST_INTERVALS {
            return Err(Error::ManyPieces { left, at: interval.low(), most: MOST_INTERVALS });
        }
        match equation.look(interval) {
            Look::None => {}
            Look::One(point) => {
                // The same point: it is within an interval that has one alone.
                let is_known = |known: &ProvedPoint| {
                    point.at.is_inside(&known.alone_in) || known.at.is_inside(&point.alone_in)
                };
                let is_outside = point.at.high() < left || point.at.low() > right;
                if !is_outside && !found.points.iter().any(is_known) {
                    found.points.push(point);
                }
            }
            unknown @ (Look::Unknown | Look::NoValue) => {
                let part = match unknown {
                    Look::NoValue => NARROWEST_OUTSIDE,
                    _ => NARROWEST,
                };
                let middle = interval.middle();
                let is_narrow = interval.width() <= part * (right - left)
                    || middle <= interval.low()
                    || middle >= interval.high();
                match (is_narrow, found.undecided.last_mut()) {
                    (true, Some(last)) if last.1 == interval.low() => last.1 = interval.high(),
                    (true, _) => found.undecided.push((interval.low(), interval.high())),
                    (false, _) => {
                        // The left half comes first.
                        todo.push(Enclosure::new(middle, interval.high()));
                        todo.push(Enclosure::new(interval.low(), middle));
                    }
                }
            }
        }
        let rest = todo.last().map_or(right, |next| next.low());
        if progress((rest - left) / (right - left)).is_break() {
            if rest < right {
                found.undecided.push((rest, right));
            }
            break;
        }
    }
    found.points.sort_by(|a, b| a.at.low().total_cmp(&b.at.low()));
    // Beside a proved point nothing is undecided.
    let points = &found.points;
    found.undecided.retain(|&(low, high)| {
        !points.iter().any(|point| Enclosure::new(low, high).is_inside(&point.alone_in))
    });
    for point in &mut found.points {
        point.least_period = equation.least_period(point);
    }
    Ok(found)
}

/// What an interval has.
enum Look {
    None,
    One(ProvedPoint),
    Unknown,
    NoValue,
}

impl Equation {
    /// F = fⁿ − x, or f, with the multiplier, on an interval; `None` if it has no value there.
    fn value(&self, x: Enclosure, period: usize) -> Option<(Enclosure, Enclosure)> {
        let (mut at, mut slope) = (x, Enclosure::ONE);
        for _ in 0..period.max(1) {
            let by = *self.derivative.enclosures(Enclosure::ZERO, &[at]).ok()?.first()?;
            at = *self.formula.enclosures(Enclosure::ZERO, &[at]).ok()?.first()?;
            slope = slope * by;
        }
        let off = if period == 0 { at } else { at - x };
        Some((off, slope))
    }

    /// F′ from the multiplier.
    fn derivative(&self, multiplier: Enclosure, period: usize) -> Enclosure {
        if period == 0 { multiplier } else { multiplier - 1.0 }
    }

    fn look(&self, interval: Enclosure) -> Look {
        let Some((off, multiplier)) = self.value(interval, self.period) else {
            return Look::NoValue;
        };
        if off.sign().is_some() {
            return Look::None;
        }
        let slope = self.derivative(multiplier, self.period);
        let middle = Enclosure::from(interval.middle());
        let at_middle = self.value(middle, self.period);
        // The mean value form.
        if let Some((off, _)) = at_middle
            && (off + slope * (interval - middle)).sign().is_some()
        {
            return Look::None;
        }
        if slope.sign().is_none() {
            return Look::Unknown;
        }
        let wider = interval.widened(WIDER * interval.width());
        match self.newton(wider, self.period) {
            Some(point) => Look::One(point),
            None => Look::Unknown,
        }
    }

    /// The proof that an interval has one zero: Newton's step leads into it.
    fn newton(&self, alone_in: Enclosure, period: usize) -> Option<ProvedPoint> {
        const MOST_STEPS: usize = 60;
        let mut at = alone_in;
        let mut proved = false;
        let mut multiplier = Enclosure::WHOLE;
        for _ in 0..MOST_STEPS {
            let (_, slope) = self.value(at, period)?;
            multiplier = slope;
            let derivative = self.derivative(slope, period);
            derivative.sign()?;
            let middle = Enclosure::from(at.middle());
            let (off, _) = self.value(middle, period)?;
            let next = middle - off / derivative;
            if at.low() < next.low() && next.high() < at.high() {
                proved = true;
            } else if !proved {
                // The first step decides: without a proof on the whole interval there may be none.
                return None;
            }
            let kept = next.intersection(&at)?;
            if kept.width() > 0.9 * at.width() {
                break;
            }
            at = kept;
        }
        proved.then_some(ProvedPoint { at, alone_in, multiplier, least_period: None })
    }

    /// The least period of a point, if it is proved.
    fn least_period(&self, point: &ProvedPoint) -> Option<usize> {
        if self.period == 0 {
            return Some(0);
        }
        for divisor in 1..self.period {
            if !self.period.is_multiple_of(divisor) {
                continue;
            }
            let (off, _) = self.value(point.at, divisor)?;
            if off.sign().is_some() {
                continue;
            }
            // A point of this period within the interval in which there is one of the longer period alone is this one.
            let wider = point.at.widened(ROUNDING * point.at.magnitude() + f64::MIN_POSITIVE);
            let shorter = self.newton(wider, divisor)?;
            return shorter.at.is_inside(&point.alone_in).then_some(divisor);
        }
        Some(self.period)
    }
}
