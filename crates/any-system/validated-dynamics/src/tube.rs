//! One step of a motion: all solutions from a set, with their derivatives, at each time of it.

use crate::expansion::Expansion;
use crate::matrix::{Matrix, common, exact};
use crate::mode_series::{ModeSeries, Varied};
use crate::set::AffineSet;
use crate::undecided::Reason;
use equations::{Arithmetic, Coefficients};
use interval_arithmetic::{Enclosure, pow};
use pxfm::f_log as ln;

/// The smallest error of a step, as a part of the largest component: half of a rounding, which is made anyway.
const FINEST: f64 = 5e-17;

/// The part of the length of the finest steps that steps of certificates have. Another program, with bounds of its own for complex times, needs half
/// as many coefficients for half the length, and the time for them falls by more than twice.
const FOR_OTHERS: f64 = 0.4;

/// The error of a step as a part of the width of the set. The set's own width grows by this part in each step; larger steps pay for it.
const OF_WIDTH: f64 = 1e-4;

/// The largest error of a step as a part of the largest component: a coarser polynomial proves nothing in one step.
const COARSEST: f64 = 1e-3;

/// The least and the largest order of the polynomials. The best one grows with the number of digits (À. Jorba, M. Zou, 2005); a
/// small one pays in wide sets.
const ORDERS: (usize, usize) = (6, 24);

/// A coefficient of this size or less is 0 but for the rounding of small numbers.
const NOTHING: f64 = 1e-290;

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

/// All solutions from a set on the times [0, length], and, where they are wanted, their derivatives with respect to the start.
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
    /// That of the guesses of the step.
    coupling: f64,
    /// From the centre.
    centre: Coefficients<Enclosure>,
    /// From all states of the set.
    varied: Varied,
    /// At all states that the solutions have on the step.
    beyond: Coefficients<Enclosure>,
    /// The same with the derivatives.
    varied_beyond: Option<Varied>,
}

impl<'s> Tube<'s> {
    /// A step of at most this length, with derivatives if they are wanted. For another program it is [short](FOR_OTHERS).
    pub(crate) fn new(
        series: &'s ModeSeries,
        set: &'s AffineSet,
        longest: f64,
        for_others: bool,
        with_derivatives: bool,
    ) -> Result<Tube<'s>, Reason> {
        let (error, part) =
            if for_others { (FINEST, FOR_OTHERS) } else { (wanted_error(set), 1.0) };
        let order = (-0.5 * ln(error)).ceil() as usize + 2;
        let order = order.clamp(ORDERS.0, ORDERS.1);
        let centre = series.motion(&exact(set.centre()), order).map_err(Reason::Domain)?;
        let identity = Matrix::identity(series.dimension);
        let varied = series.varied(set.hull(), &identity, order + 1).map_err(Reason::Domain)?;
        let scale = scale(&centre, set);
        let mut step = Step { series, varied: &varied, order, length: 0.0, coupling: 0.0 };
        let own = |k: usize| largest(centre.states(), k);
        // A state of rest says nothing of times: those near it do.
        let near = |k: usize| largest(varied.derivatives(), k);
        let length = step_length(own, order, error * scale)
            .or_else(|| step_length(near, order, error))
            .unwrap_or_else(|| natural_length(own));
        let first = (part * length).min(longest);
        step.length = first;
        let mut refused = Reason::NoSolution { step: step.length };
        // Where a component is 0 beside others the guesses are tried again with what they feel of each other.
        let again = if has_small_component(&varied) { TRIES } else { 0 };
        for at in 0..TRIES + again {
            if at == TRIES {
                (step.length, step.coupling) = (first, f64::EPSILON);
            }
            let mut shorter = SHORTER;
            match step.bounded(with_derivatives) {
                Ok(Some((beyond, varied_beyond))) => {
                    let most = step.remainder(&beyond);
                    if most <= ACCEPTED * error * scale {
                        let (length, coupling) = (step.length, step.coupling);
                        return Ok(Tube {
                            set,
                            series,
                            length,
                            order,
                            coupling,
                            centre,
                            varied,
                            beyond,
                            varied_beyond,
                        });
                    }
                    // The remainder falls with the power p + 1 of the length, at least.
                    let wanted = pow(error * scale / most, 1.0 / (order + 1) as f64);
                    shorter = wanted.clamp(SHORTER, LONGEST);
                    refused = Reason::NoSolution { step: step.length };
                }
                Ok(None) => refused = Reason::NoSolution { step: step.length },
                Err(error) => refused = Reason::Domain(error),
            }
            step.length *= shorter;
        }
        Err(refused)
    }

    fn expansion<'t>(&self, coefficients: &'t [Enclosure], beyond: Enclosure) -> Expansion<'t> {
        Expansion { coefficients: &coefficients[..=self.order], rest: beyond }
    }

    /// Proves the derivatives of a step, if it has none; false if they are not proved for its length.
    pub(crate) fn add_derivatives(&mut self) -> bool {
        if self.varied_beyond.is_some() {
            return true;
        }
        let (series, order, length) = (self.series, self.order, self.length);
        // The states are those that are proved: by the same guesses.
        let coupling = self.coupling;
        let step = Step { series, varied: &self.varied, order, length, coupling };
        self.varied_beyond = step.with_derivatives(&step.guesses()).ok().flatten();
        self.varied_beyond.is_some()
    }

    /// The states from the centre at the times of an interval of the step.
    pub(crate) fn centre_at(&self, time: Enclosure) -> Vec<Enclosure> {
        let component =
            |axis| self.expansion(self.centre.state(axis), last(self.beyond.state(axis))).at(time);
        (0..self.series.dimension).map(component).collect()
    }

    /// The derivatives of the polynomials with respect to the start.
    fn slopes_at(&self, time: Enclosure) -> Matrix {
        let size = self.series.dimension;
        Matrix::from_fn(size, size, |row, column| {
            self.expansion(self.varied.derivative(row, column), Enclosure::ZERO).at(time)
        })
    }

    /// The derivatives of the states with respect to the start, of a step with derivatives.
    pub(crate) fn derivatives_at(&self, time: Enclosure) -> Option<Matrix> {
        let beyond = self.varied_beyond.as_ref()?;
        let size = self.series.dimension;
        Some(Matrix::from_fn(size, size, |row, column| {
            let rest = last(beyond.derivative(row, column));
            self.expansion(self.varied.derivative(row, column), rest).at(time)
        }))
    }

    /// The states of all solutions at the times of an interval, from all states of the set at once.
    fn plain_states_at(&self, time: Enclosure) -> Vec<Enclosure> {
        let component =
            |axis| self.expansion(self.varied.state(axis), last(self.beyond.state(axis))).at(time);
        (0..self.series.dimension).map(component).collect()
    }

    /// The states of all solutions at the times of an interval.
    pub(crate) fn states_at(&self, time: Enclosure) -> Vec<Enclosure> {
        let by_slopes = self.set.values(&self.centre_at(time), &self.slopes_at(time));
        common(&self.plain_states_at(time), &by_slopes)
    }

    /// The set at a time of the step.
    pub(crate) fn set_at(&self, time: Enclosure) -> AffineSet {
        let bounds = self.plain_states_at(time);
        self.set.image(&self.centre_at(time), &self.slopes_at(time), Some(&bounds))
    }

    /// A guard on the solution from the centre.
    pub(crate) fn guard_of_centre(&self, guard: usize) -> Expansion<'_> {
        self.expansion(self.centre.watched(guard), last(self.beyond.watched(guard)))
    }

    /// A guard on all solutions.
    pub(crate) fn guard(&self, guard: usize) -> Expansion<'_> {
        self.expansion(self.varied.guard(guard), last(self.beyond.watched(guard)))
    }

    /// The values of a guard on all solutions at the times of an interval.
    pub(crate) fn guard_at(&self, guard: usize, time: Enclosure) -> Enclosure {
        self.narrow(guard, |expansion| expansion.at(time))
    }

    /// Its rates.
    pub(crate) fn guard_rate_at(&self, guard: usize, time: Enclosure) -> Enclosure {
        self.narrow(guard, |expansion| expansion.rate(time))
    }

    /// What is computed of the expansion of a guard: from all states at once, and from the centre with the slopes of the coefficients. The
    /// common part.
    fn narrow(&self, guard: usize, of: impl Fn(Expansion<'_>) -> Enclosure) -> Enclosure {
        let plain = of(self.guard(guard));
        if plain.sign().is_some() {
            return plain;
        }
        let (count, size) = (self.series.guards, self.series.dimension);
        let slopes = Matrix::from_fn(1, size, |_, axis| {
            let coefficients = self.varied.guard_derivative(count, guard, axis);
            of(self.expansion(coefficients, Enclosure::ZERO))
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
    if largest > NOTHING { largest } else { 1.0 }
}

/// The largest coefficient k of some components.
fn largest<'c>(components: impl Iterator<Item = &'c [Enclosure]>, k: usize) -> f64 {
    components.map(|series| series[k].magnitude()).fold(0.0, f64::max)
}

/// Whether a component is 0 beside the largest one, to the rounding of that.
fn has_small_component(varied: &Varied) -> bool {
    let least = f64::EPSILON * largest(varied.states(), 0);
    varied.states().any(|series| series[0].magnitude() < least)
}

/// The time at which a coefficient k of this size is a term as large as wanted; infinite for one that is 0 but for rounding.
fn time_of(wanted: f64, size: f64, k: usize) -> f64 {
    if size > NOTHING { pow(wanted / size, 1.0 / k as f64) } else { f64::INFINITY }
}

/// The length of a step at which the last two terms are as large as the error, by the sizes of coefficients. `None` if they are 0.
fn step_length(size: impl Fn(usize) -> f64, order: usize, error: f64) -> Option<f64> {
    let length = time_of(error, size(order - 1), order - 1).min(time_of(error, size(order), order));
    length.is_finite().then_some(length)
}

/// For motions that are polynomials of a low degree: the length at which the start and the terms up to the second are equally large.
fn natural_length(size: impl Fn(usize) -> f64) -> f64 {
    let start = if size(0) > 0.0 { size(0) } else { 1.0 };
    let natural = time_of(start, size(1), 1).min(time_of(start, size(2), 2));
    // Not as long as a straight way to 0 takes: a step should not end on a surface there.
    if natural.is_finite() { 1.5 * natural } else { 1.0 }
}

/// A step that is tried.
struct Step<'t> {
    series: &'t ModeSeries,
    varied: &'t Varied,
    order: usize,
    length: f64,
    /// How much wider the guess of a component is at least, as a part of the largest one.
    coupling: f64,
}

/// The expansion at all states of a step, and the same with derivatives if they are wanted.
type Beyond = (Coefficients<Enclosure>, Option<Varied>);

impl Step<'_> {
    /// The largest remainder of a component of the state.
    fn remainder(&self, beyond: &Coefficients<Enclosure>) -> f64 {
        let sizes = beyond.states().map(|series| last(series).magnitude());
        sizes.fold(0.0, f64::max) * pow(self.length, (self.order + 1) as f64)
    }

    /// The expansion at all states of the step, if the box of these states is proved to hold the solutions.
    fn bounded(&self, with_derivatives: bool) -> Result<Option<Beyond>, equations::Error> {
        let states = self.guesses();
        if !states.iter().all(Enclosure::is_valid) {
            return Ok(None);
        }
        let beyond = self.series.motion(&states, self.order + 1)?;
        if !self.are_inside(self.varied.states(), beyond.states(), &states) {
            return Ok(None);
        }
        if !with_derivatives {
            return Ok(Some((beyond, None)));
        }
        let varied = self.with_derivatives(&states)?;
        Ok(varied.map(|varied| (beyond, Some(varied))))
    }

    /// What the states are guessed to be on the step.
    fn guesses(&self) -> Vec<Enclosure> {
        let largest = largest(self.varied.states(), 0);
        self.varied.states().map(|series| self.guess(series, largest)).collect()
    }

    /// The expansion with derivatives at all of these states, which are proved to be those of the step, if the box of the derivatives is proved too.
    fn with_derivatives(&self, states: &[Enclosure]) -> Result<Option<Varied>, equations::Error> {
        let size = self.series.dimension;
        let largest = largest(self.varied.derivatives(), 0);
        let entries: Vec<Enclosure> =
            self.varied.derivatives().map(|series| self.guess(series, largest)).collect();
        if !entries.iter().all(Enclosure::is_valid) {
            return Ok(None);
        }
        let derivatives = Matrix::of_rows(size, size, &entries);
        let varied = self.series.varied(states, &derivatives, self.order + 1)?;
        let proved = self.are_inside(self.varied.derivatives(), varied.derivatives(), &entries);
        Ok(proved.then_some(varied))
    }

    fn at_all_times(&self, coefficients: &[Enclosure], rest: Enclosure) -> Enclosure {
        let times = Enclosure::new(0.0, self.length);
        Expansion { coefficients: &coefficients[..=self.order], rest }.at(times)
    }

    /// What a component is guessed to be on the step. `largest` is the size of the largest one.
    fn guess(&self, coefficients: &[Enclosure], largest: f64) -> Enclosure {
        let size = GUESS * last(coefficients).magnitude();
        let found = self.at_all_times(coefficients, Enclosure::new(-size, size));
        // Strictly wider, also where nothing changes. A component that is 0 at rest feels how much wider the others are: in a
        // remainder, where that is small.
        let size = found.magnitude().max(self.coupling * largest);
        found.widened(GUESS * f64::EPSILON * size + f64::MIN_POSITIVE)
    }

    /// True if each component is inside of its guess, with the remainder that follows from the guess.
    fn are_inside<'c>(
        &self,
        coefficients: impl Iterator<Item = &'c [Enclosure]>,
        beyond: impl Iterator<Item = &'c [Enclosure]>,
        guesses: &[Enclosure],
    ) -> bool {
        coefficients.zip(beyond).zip(guesses).all(|((coefficients, beyond), guess)| {
            let found = self.at_all_times(coefficients, last(beyond));
            guess.low() < found.low() && found.high() < guess.high()
        })
    }
}
