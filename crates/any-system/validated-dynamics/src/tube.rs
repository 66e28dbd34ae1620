//! One step of a motion: all solutions from a set, with their derivatives, at each time of it.

use crate::expansion::Expansion;
use crate::matrix::{Matrix, common, exact, is_bounded};
use crate::mode_series::{ModeSeries, Varied};
use crate::set::AffineSet;
use crate::undecided::Reason;
use equations::Coefficients;
use interval_arithmetic::{Enclosure, pow};
use pxfm::f_log as ln;

/// The smallest error of a step, as a part of the largest component: half of a rounding, which is made anyway.
const FINEST: f64 = 5e-17;

/// The error of a step as a part of the width of the set. The set's own width grows by this part in each step; larger steps pay for it.
const OF_WIDTH: f64 = 1e-4;

/// The largest error of a step as a part of the largest component: a coarser polynomial proves nothing in one step.
const COARSEST: f64 = 1e-3;

/// The least and the largest order of the polynomials. The best one grows with the number of digits (À. Jorba, M. Zou, 2005); a
/// small one pays in wide sets.
const ORDERS: (usize, usize) = (6, 24);

/// How often a step is shortened until it is proved. Each time it is [`SHORTER`] as long: the last step has 10⁻⁶ of the first one's length.
const TRIES: usize = 20;

/// The part of its length to which a step is shortened that is not proved.
const SHORTER: f64 = 0.5;

/// The longest part of its length to which a step is shortened whose remainder is too large.
const LONGEST: f64 = 0.9;

/// How much larger than wanted the remainder of a step may be.
const ACCEPTED: f64 = 10.0;

/// How much wider than the coefficient at the start the remainder is guessed to be. If it is not, the step is shortened.
const GUESS: f64 = 2.0;

/// All solutions from a set on the times [0, length], with their derivatives with respect to the start.
///
/// The solutions stay in a box W on these times: x + Σ_{k ≤ p} c_k(X) s^k + c_{p+1}(W) s^{p+1} is in the inside of W for all s of the
/// step. A solution that left W would be on its boundary at a first time, and up to this time Taylor's theorem holds with its remainder
/// in c_{p+1}(W), so that it would be inside (N. S. Nedialkov, K. R. Jackson, J. D. Pryce, 2001). The same holds for the derivatives.
#[derive(Debug)]
pub(crate) struct Tube<'s> {
    pub(crate) set: &'s AffineSet,
    series: &'s ModeSeries,
    /// The last time.
    pub(crate) length: f64,
    /// The order p.
    pub(crate) order: usize,
    /// From the centre.
    centre: Coefficients<Enclosure>,
    /// From all states of the set.
    varied: Varied,
    /// At all states that the solutions have on the step.
    beyond: Varied,
}

impl<'s> Tube<'s> {
    /// A step of at most this length.
    pub(crate) fn new(
        series: &'s ModeSeries,
        set: &'s AffineSet,
        longest: f64,
    ) -> Result<Tube<'s>, Reason> {
        let error = wanted_error(set);
        let order = (-0.5 * ln(error)).ceil() as usize + 2;
        let order = order.clamp(ORDERS.0, ORDERS.1);
        let centre = series.motion(&exact(set.centre()), order).map_err(Reason::Domain)?;
        let identity = Matrix::identity(series.dimension);
        let varied = series.varied(set.hull(), &identity, order + 1).map_err(Reason::Domain)?;
        let scale = scale(&centre, set);
        let mut length = step_length(&centre, order, error * scale).min(longest);
        let mut refused = Reason::NoSolution { step: length };
        for _ in 0..TRIES {
            let mut shorter = SHORTER;
            match bounded(series, &varied, order, length) {
                Ok(Some(beyond)) => {
                    let most = remainder(&beyond, series.dimension, length, order);
                    if most <= ACCEPTED * error * scale {
                        return Ok(Tube { set, series, length, order, centre, varied, beyond });
                    }
                    // The remainder falls with the power p + 1 of the length, at least.
                    shorter = pow(error * scale / most, 1.0 / (order + 1) as f64).clamp(SHORTER, LONGEST);
                    refused = Reason::NoSolution { step: length };
                }
                Ok(None) => refused = Reason::NoSolution { step: length },
                Err(error) => refused = Reason::Domain(error),
            }
            length *= shorter;
        }
        Err(refused)
    }

    fn of_centre<'t>(&self, coefficients: &'t [Enclosure], beyond: &[Enclosure]) -> Expansion<'t> {
        Expansion { coefficients, rest: last(beyond) }
    }

    fn of_set<'t>(&self, coefficients: &'t [Enclosure], beyond: &[Enclosure]) -> Expansion<'t> {
        Expansion { coefficients: &coefficients[..=self.order], rest: last(beyond) }
    }

    /// The states from the centre at the times of an interval of the step.
    pub(crate) fn centre_at(&self, time: Enclosure) -> Vec<Enclosure> {
        let component = |axis| self.of_centre(self.centre.state(axis), self.beyond.state(axis));
        (0..self.series.dimension).map(|axis| component(axis).at(time)).collect()
    }

    /// The derivatives of the states with respect to the start.
    pub(crate) fn derivatives_at(&self, time: Enclosure) -> Matrix {
        let size = self.series.dimension;
        Matrix::from_fn(size, size, |row, column| {
            let beyond = self.beyond.derivative(row, column);
            self.of_set(self.varied.derivative(row, column), beyond).at(time)
        })
    }

    /// The states of all solutions at the times of an interval.
    pub(crate) fn states_at(&self, time: Enclosure) -> Vec<Enclosure> {
        let plain = |axis| self.of_set(self.varied.state(axis), self.beyond.state(axis)).at(time);
        let plain: Vec<Enclosure> = (0..self.series.dimension).map(plain).collect();
        common(&plain, &self.set.values(&self.centre_at(time), &self.derivatives_at(time)))
    }

    /// The set at a time of the step.
    pub(crate) fn set_at(&self, time: Enclosure) -> AffineSet {
        let derivatives = self.derivatives_at(time);
        self.set.image(&self.centre_at(time), &derivatives, Some(&self.states_at(time)))
    }

    /// A guard on the solution from the centre.
    pub(crate) fn guard_of_centre(&self, guard: usize) -> Expansion<'_> {
        self.of_centre(self.centre.watched(guard), self.beyond.guard(guard))
    }

    /// A guard on all solutions.
    pub(crate) fn guard(&self, guard: usize) -> Expansion<'_> {
        self.of_set(self.varied.guard(guard), self.beyond.guard(guard))
    }

    /// The values of a guard on all solutions at the times of an interval.
    pub(crate) fn guard_at(&self, guard: usize, time: Enclosure) -> Enclosure {
        self.narrow(guard, |expansion| expansion.at(time))
    }

    /// Its rates.
    pub(crate) fn guard_rate_at(&self, guard: usize, time: Enclosure) -> Enclosure {
        self.narrow(guard, |expansion| expansion.rate(time))
    }

    /// What is computed of the expansion of a guard, by the mean value form from the centre and from all states at once: the common part.
    fn narrow(
        &self,
        guard: usize,
        of: impl Fn(Expansion<'_>) -> Enclosure,
    ) -> Enclosure {
        let plain = of(self.guard(guard));
        let (count, size) = (self.series.guards, self.series.dimension);
        let slopes = Matrix::from_fn(1, size, |_, axis| {
            let coefficients = self.varied.guard_derivative(count, guard, axis);
            let beyond = self.beyond.guard_derivative(count, guard, axis);
            of(self.of_set(coefficients, beyond))
        });
        let centre = of(self.guard_of_centre(guard));
        common(&[plain], &self.set.values(&[centre], &slopes))[0]
    }
}

/// The coefficient of the highest order.
fn last(coefficients: &[Enclosure]) -> Enclosure {
    coefficients.last().copied().unwrap_or(Enclosure::WHOLE)
}

/// The error that a step may make, as a part of the [scale].
fn wanted_error(set: &AffineSet) -> f64 {
    let size = set.hull().iter().map(Enclosure::magnitude).fold(0.0, f64::max);
    let width = set.hull().iter().map(Enclosure::width).fold(0.0, f64::max);
    if size > 0.0 { (OF_WIDTH * width / size).clamp(FINEST, COARSEST) } else { FINEST }
}

/// The largest component, of those that are no straight lines in time: such as a time or a parameter, which have no error.
fn scale(centre: &Coefficients<Enclosure>, set: &AffineSet) -> f64 {
    let curved = |series: &[Enclosure]| series[2..].iter().any(|c| *c != Enclosure::ZERO);
    let sizes = centre.states().zip(set.hull()).filter(|(series, _)| curved(series));
    let largest = sizes.map(|(_, x)| x.magnitude()).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

/// The length of a step at which the last two terms are as large as the error; for motions that are polynomials of a lower degree, that at
/// which the start and the terms up to the second are equally large.
fn step_length(centre: &Coefficients<Enclosure>, order: usize, error: f64) -> f64 {
    let size = |k: usize| {
        let of_components = centre.states().map(|series| series[k].magnitude());
        of_components.fold(0.0, f64::max)
    };
    let of_term = |k: usize, size_of_term: f64, wanted: f64| match size_of_term {
        0.0 => f64::INFINITY,
        term => pow(wanted / term, 1.0 / k as f64),
    };
    let length = [order - 1, order].map(|k| of_term(k, size(k), error));
    let length = length[0].min(length[1]);
    if length.is_finite() {
        return length;
    }
    let start = if size(0) > 0.0 { size(0) } else { 1.0 };
    let natural = (1..=2).map(|k| of_term(k, size(k), start)).fold(f64::INFINITY, f64::min);
    if natural.is_finite() { natural } else { 1.0 }
}

/// The largest remainder of a component of the state.
fn remainder(beyond: &Varied, dimension: usize, length: f64, order: usize) -> f64 {
    let largest = (0..dimension).map(|axis| last(beyond.state(axis)).magnitude()).fold(0.0, f64::max);
    largest * pow(length, (order + 1) as f64)
}

/// The expansion at all states of a step of this length, if the box of these states is proved to hold the solutions.
fn bounded(
    series: &ModeSeries,
    varied: &Varied,
    order: usize,
    length: f64,
) -> Result<Option<Varied>, equations::Error> {
    let times = Enclosure::new(0.0, length);
    let known = |coefficients: &[Enclosure], rest| {
        Expansion { coefficients: &coefficients[..=order], rest }.at(times)
    };
    let guess = |coefficients: &[Enclosure]| {
        let size = GUESS * last(coefficients).magnitude();
        let found = known(coefficients, Enclosure::new(-size, size));
        // Strictly wider, also where nothing changes.
        let more = GUESS * f64::EPSILON * found.magnitude() + f64::MIN_POSITIVE;
        found.widened(more)
    };
    let box_of_step: Vec<Enclosure> = varied.all().map(guess).collect();
    if !is_bounded(&box_of_step) {
        return Ok(None);
    }
    let (states, derivatives) = box_of_step.split_at(series.dimension);
    let derivatives = Matrix::of_rows(series.dimension, series.dimension, derivatives);
    let beyond = series.varied(states, &derivatives, order + 1)?;
    let is_inside = |((coefficients, beyond), guessed): ((&[Enclosure], &[Enclosure]), &Enclosure)| {
        let found = known(coefficients, last(beyond));
        guessed.low < found.low && found.high < guessed.high
    };
    let proved = varied.all().zip(beyond.all()).zip(&box_of_step).all(is_inside);
    Ok(proved.then_some(beyond))
}
