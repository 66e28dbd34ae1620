//! Derivatives of a whole execution in one direction: of states and times of events, to any order.

use super::label::Label;
use super::motion::TaylorMotion;
use super::programs::{GuardProgram, ModeProgram};
use crate::arc::{Arc, ArcEnd, Event};
use crate::clock::ClockTimes;
use crate::crossing::EventKind;
use crate::error::Error;
use crate::model::Model;
use crate::state::StateVector;
use equations::{Arithmetic, Coefficients, Jet, jet_horner};

/// Smallest rate of a guard at its event, relative to the sum of the sizes of its terms, ∂g/∂x ẋ: at this rate four digits of
/// a derivative are left. A slower one is a grazing.
const SMALLEST_RATE: f64 = 1e-12;

/// The change of a guard's rate within the error of the time of its event that is allowed, in parts of the rate and of the
/// tolerance. A derivative has no more digits than the rate; a larger change is that of a grazing.
const CHANGE_PER_TOLERANCE: f64 = 1e4;

/// It may always be this large: six digits of a derivative are left.
const SMALLEST_CHANGE_ALLOWED: f64 = 1e-6;

/// It may never be larger: one digit is left.
const LARGEST_CHANGE_ALLOWED: f64 = 0.1;

/// A crossing after this part of the present time is at the same instant as the event before.
const SAME_INSTANT: f64 = 4.0 * f64::EPSILON;

/// How start and parameters change with ε: along a straight line, or along a curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Along {
    /// For each component the coefficients of ε, ε², …
    start: Vec<Vec<f64>>,
    parameters: Vec<(String, Vec<f64>)>,
}

/// The coefficients of ε, ε², …
fn powers<const T: usize>(jet: &Jet<T>) -> Vec<f64> {
    jet.0.iter().skip(1).copied().collect()
}

impl Along {
    /// The start changes by ε times this vector.
    pub fn start(change: &[f64]) -> Along {
        Along { start: change.iter().map(|rate| vec![*rate]).collect(), parameters: Vec::new() }
    }

    /// The parameter with this name changes by ε.
    pub fn parameter(name: &str) -> Along {
        Along::default().and_parameter(name, 1.0)
    }

    /// The same, and the parameter with this name changes by ε times this number.
    #[must_use]
    pub fn and_parameter(mut self, name: &str, change: f64) -> Along {
        self.parameters.push((name.to_owned(), vec![change]));
        self
    }

    /// The start moves on a curve: as these components do, whose values do not count.
    pub fn curve<const T: usize>(start: &[Jet<T>]) -> Along {
        Along { start: start.iter().map(powers).collect(), parameters: Vec::new() }
    }

    /// The same, and the parameter with this name moves as this number does, whose value does not count.
    #[must_use]
    pub fn and_parameter_curve<const T: usize>(mut self, name: &str, value: Jet<T>) -> Along {
        self.parameters.push((name.to_owned(), powers(&value)));
        self
    }
}

/// Where some arcs end, with derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct ExecutionJet<const T: usize> {
    /// The state: after the event that ends the last arc, at its own time; or at a limit on time.
    pub state: Vec<Jet<T>>,
    /// The time since the start of the first arc, which does not move.
    pub time: Jet<T>,
    /// The largest coefficient of ε of a component on the way: at the start and at the end of each arc, before its event. Beside the one at
    /// the start it says how far neighbours part, and by how much the error of the motion may have grown.
    pub largest: f64,
}

impl<X: StateVector, P> Model<Label, Label, X, TaylorMotion, P> {
    /// Where these arcs of an execution end, as the start and the parameters change in a direction: a polynomial in ε
    /// with T terms. The coefficient of ε^k of a state is its k-th derivative, over k!.
    ///
    /// The state after an event is that at the event's own time, which changes too. All mixed derivatives are sums of such
    /// directional ones: ∂²/∂x∂y in the directions e₁ + e₂, e₁ and e₂ is D² − D₁² − D₂², over 2.
    ///
    /// ```
    /// use hybrid_system::{Along, Equations, State};
    /// // A ball that falls from the height h under the gravity g lands after √(2h/g).
    /// let ball = Equations::new(&["height", "speed"], &[("gravity", "2")])
    ///     .mode("flight", |_, x, p| [x[1], -p["gravity"]])
    ///     .falling("floor", |_, x, _| x[0])
    ///     .resets(|_, x, _| [x[0], -0.5 * x[1]])
    ///     .model::<State<2>>()?;
    /// let arc = ball.start("flight", [1.0, 0.0], 9.0)?.next().expect("an arc")?;
    /// let landing = ball.jet::<3>(&[arc], &Along::start(&[1.0, 0.0]))?;
    /// // √h at h = 1 + ε: 1 + ε/2 − ε²/8. The speed after it is the same here.
    /// for (found, exact) in landing.time.0.iter().zip([1.0, 0.5, -0.125]) {
    ///     assert!((found - exact).abs() < 1e-14);
    /// }
    /// let by_gravity = ball.jet::<2>(&[arc], &Along::parameter("gravity"))?;
    /// assert!((by_gravity.time.0[1] + 0.25).abs() < 1e-14);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::GrazingSensitivity`] at a touch, and at a guard that is crossed too slowly; [`Error::CornerSensitivity`]
    /// for two events at one instant, and for an event at the instant of the limit; [`Error::NoSensitivity`] for an arc
    /// that does not end in an event of a formula or at a limit on time; [`Error::Formula`] for a parameter that there is
    /// none, and for a jump with a kink.
    pub fn jet<const T: usize>(
        &self,
        arcs: &[Arc<Label, Label, X>],
        direction: &Along,
    ) -> Result<ExecutionJet<T>, Error> {
        let Some(first) = arcs.first() else {
            return Ok(ExecutionJet { state: Vec::new(), time: Jet::zero(), largest: 0.0 });
        };
        let mut state = self.start_jet(&first.start, direction)?;
        let mut time = Jet::zero();
        let states = first.start.dimension();
        let mut largest = largest_change(&state[..states]);
        // The event before, if it changed the state.
        let mut last: Option<&Event<Label, Label, X>> = None;
        for arc in arcs {
            let program = self.motion.mode(arc.mode)?;
            // The derivative is that of this execution: the values are its own.
            put_values(&mut state, &arc.start);
            (state, time) = match &arc.end {
                ArcEnd::Event(event) => {
                    let Moved { before, after } =
                        self.after_event(program, (arc, event), &state, &time)?;
                    largest = largest.max(largest_change(&before[..states]));
                    after
                }
                ArcEnd::TimeLimit { .. } => {
                    let moves = time.0.iter().skip(1).any(|term| *term != 0.0);
                    let at_once = arc.duration <= SAME_INSTANT * (arc.time + arc.duration).abs();
                    if let Some(event) = last.filter(|_| moves && at_once) {
                        return Err(corner(event));
                    }
                    // The end is where it is, whenever the arc has begun.
                    let end = program
                        .jets()?
                        .coefficients(&self.jet_flow(program, &state, arc.duration)?, T)?;
                    let mut since = Jet::negative(&time);
                    put_value(&mut since, 0.0);
                    (at(&end, &since), Jet::number(time.value() + arc.duration))
                }
                _ => return Err(Error::NoSensitivity { time: arc.time }),
            };
            last = arc.event().filter(|event| changes(arc, event));
        }
        state.truncate(states);
        largest = largest.max(largest_change(&state));
        Ok(ExecutionJet { state, time, largest })
    }

    /// The state at the start of an execution, and the parameters behind it.
    pub(super) fn start_jet<const T: usize>(
        &self,
        start: &X,
        direction: &Along,
    ) -> Result<Vec<Jet<T>>, Error> {
        let names = self.equations().names();
        let (expected, found) = (start.dimension(), direction.start.len());
        if found != 0 && found != expected {
            return Err(Error::Dimension {
                what: "the direction of a derivative",
                expected,
                found,
            });
        }
        let moved = |jet: &mut Jet<T>, powers: &[f64]| {
            jet.0.iter_mut().skip(1).zip(powers).for_each(|(own, power)| *own += power);
        };
        let mut jets: Vec<Jet<T>> = start.components().iter().copied().map(Jet::number).collect();
        jets.iter_mut().zip(&direction.start).for_each(|(jet, powers)| moved(jet, powers));
        let first = jets.len();
        jets.extend(names.values.iter().map(|value| Jet::number(value.value())));
        for (name, powers) in &direction.parameters {
            let place = names.parameters.iter().position(|known| known == name);
            let reason = "no parameter of these equations";
            let place = place.ok_or(equations::Error::Name { name: name.clone(), reason })?;
            moved(&mut jets[first + place], powers);
        }
        Ok(jets)
    }

    /// The state after a time.
    pub(super) fn jet_flow<const T: usize>(
        &self,
        program: &ModeProgram,
        start: &[Jet<T>],
        duration: f64,
    ) -> Result<Vec<Jet<T>>, Error> {
        let tolerances = &self.motion.tolerances;
        let absolute = (0..start.len()).map(|axis| tolerances.of(axis, 0.0));
        let absolute = absolute.fold(tolerances.absolute, f64::min);
        let relative = tolerances.relative.clamp(1e-17, 0.1);
        Ok(program.jets()?.flow(start, duration, (relative, absolute))?)
    }

    /// State and time after the event that ends an arc.
    fn after_event<const T: usize>(
        &self,
        program: &ModeProgram,
        (arc, event): (&Arc<Label, Label, X>, &Event<Label, Label, X>),
        start: &[Jet<T>],
        time: &Jet<T>,
    ) -> Result<Moved<T>, Error> {
        if event.kind == EventKind::Clock {
            return self.after_tick(program, (arc, event), start, time);
        }
        let place = program.guards.iter().position(|guard| guard.surface == event.surface);
        let at_once = event.kind == EventKind::AtStart
            || event.kind == EventKind::Crossing && arc.duration <= SAME_INSTANT * event.time.abs();
        match (event.kind, place) {
            _ if at_once && !changes(arc, event) => {
                return Ok(Moved { before: start.to_vec(), after: (start.to_vec(), *time) });
            }
            _ if at_once && arc.jump > 0 => return Err(corner(event)),
            (EventKind::Touch, _) => {
                return Err(Error::GrazingSensitivity { time: event.time, rate: 0.0 });
            }
            (EventKind::Crossing, Some(_)) => {}
            _ => return Err(Error::NoSensitivity { time: arc.time }),
        }
        let place = place.unwrap_or(0);
        let mut state = self.jet_flow(program, start, arc.duration)?;
        put_values(&mut state, &event.before);
        // The time of the event is that of the execution and T − 1 powers of ε: no more terms of the motion count.
        let motion = program.jets()?.coefficients(&state, T)?;
        let guard = motion.watched(place);
        let size = rate_size(&program.guards[place], &state, motion.states())?;
        let rate = guard.get(1).map_or(0.0, Jet::value);
        let change = change_of_rate(guard, event.time_error) / rate.abs();
        let known = (CHANGE_PER_TOLERANCE * self.motion.tolerances.relative)
            .clamp(SMALLEST_CHANGE_ALLOWED, LARGEST_CHANGE_ALLOWED);
        if !(rate.abs() > SMALLEST_RATE * size && change <= known) {
            return Err(Error::GrazingSensitivity { time: event.time, rate });
        }
        let ended = Jet::sum(time, &Jet::number(arc.duration));
        let after = after_jump(&program.guards[place], &motion, (&ended, &zero(guard)))?;
        Ok(Moved { before: state, after })
    }

    /// State and time after a tick of a clock.
    fn after_tick<const T: usize>(
        &self,
        program: &ModeProgram,
        (arc, event): (&Arc<Label, Label, X>, &Event<Label, Label, X>),
        start: &[Jet<T>],
        time: &Jet<T>,
    ) -> Result<Moved<T>, Error> {
        let clock = program.clocks.iter().find(|(clock, _)| clock.surface == event.surface);
        let Some((clock, times)) = clock else {
            return Err(Error::NoSensitivity { time: arc.time });
        };
        if arc.jump > 0 && arc.duration <= SAME_INSTANT * event.time.abs() {
            return Err(corner(event));
        }
        let tick = tick(&clock.value_jets()?.values(start)?, times, event.time);
        let flown = self.jet_flow(program, start, arc.duration)?;
        let motion = program.jets()?.coefficients(&flown, T)?;
        let mut since = Jet::difference(&tick, time);
        put_value(&mut since, 0.0);
        let ended = Jet::sum(time, &Jet::number(arc.duration));
        let after = after_jump(clock, &motion, (&ended, &since))?;
        Ok(Moved { before: flown, after })
    }
}

/// The state at the end of an arc, before its event, and state and time after it.
struct Moved<const T: usize> {
    before: Vec<Jet<T>>,
    after: (Vec<Jet<T>>, Jet<T>),
}

/// The largest first derivative of some components.
fn largest_change<const T: usize>(state: &[Jet<T>]) -> f64 {
    let change = |jet: &Jet<T>| jet.0.get(1).map_or(0.0, |term| term.abs());
    state.iter().map(change).fold(0.0, f64::max)
}

/// The time of a tick: first + k·period, or one of a list.
fn tick<const T: usize>(formulas: &[Jet<T>], times: &ClockTimes, time: f64) -> Jet<T> {
    let of = |k: usize| formulas.get(k).copied().unwrap_or(Jet::zero());
    match times {
        ClockTimes::Periodic(_) => {
            let ticks = ((time - of(0).value()) / of(1).value()).round();
            Jet::sum(&of(0), &Jet::times(&of(1), ticks))
        }
        ClockTimes::Preset(times) => of(times.times().partition_point(|tick| *tick < time)),
    }
}

/// True unless an event leads to its own mode and state.
fn changes<X: StateVector>(arc: &Arc<Label, Label, X>, event: &Event<Label, Label, X>) -> bool {
    event.after.as_ref().is_none_or(|(mode, state)| *mode != arc.mode || *state != event.before)
}

fn corner<X>(event: &Event<Label, Label, X>) -> Error {
    Error::CornerSensitivity { time: event.time, surface: format!("{:?}", event.surface) }
}

/// State and time after the jump of a guard or a clock, a small time behind the end of an arc.
fn after_jump<const T: usize>(
    guard: &GuardProgram,
    motion: &Coefficients<Jet<T>>,
    (ended, since): (&Jet<T>, &Jet<T>),
) -> Result<(Vec<Jet<T>>, Jet<T>), Error> {
    let mut state = at(motion, since);
    if let Some(jump) = guard.reset_jets()? {
        let after = jump.values(&state)?;
        state[..after.len()].copy_from_slice(&after);
    }
    Ok((state, Jet::sum(ended, since)))
}

/// The values are those of an execution.
fn put_values<const T: usize, X: StateVector>(jets: &mut [Jet<T>], values: &X) {
    for (jet, value) in jets.iter_mut().zip(values.components()) {
        put_value(jet, *value);
    }
}

/// The derivatives stay.
fn put_value<const T: usize>(jet: &mut Jet<T>, value: f64) {
    jet.0.iter_mut().take(1).for_each(|first| *first = value);
}

/// The state at a small time of a motion.
fn at<const T: usize>(motion: &Coefficients<Jet<T>>, since: &Jet<T>) -> Vec<Jet<T>> {
    motion.states().map(|series| jet_horner(series, since)).collect()
}

/// Σ |∂g/∂xₖ| |ẋₖ|: the size of a guard's rate if its terms did not cancel.
fn rate_size<'c, const T: usize>(
    guard: &GuardProgram,
    state: &[Jet<T>],
    motion: impl Iterator<Item = &'c [Jet<T>]>,
) -> Result<f64, Error> {
    let mut size = 0.0;
    for (axis, series) in motion.enumerate() {
        let rate = series.get(1).map_or(0.0, Jet::value).abs();
        if rate > 0.0 {
            let along =
                |(k, jet): (usize, &Jet<T>)| Jet::<2>::moving(jet.value(), f64::from(k == axis));
            let along: Vec<_> = state.iter().enumerate().map(along).collect();
            let change = guard.value_jets()?.values(&along)?;
            size += rate * change.first().map_or(0.0, |change| change.0[1].abs());
        }
    }
    Ok(size)
}

/// How much the rate of a guard changes within the error of the time of its event.
fn change_of_rate<const T: usize>(guard: &[Jet<T>], time_error: f64) -> f64 {
    let terms = guard.iter().enumerate().skip(2);
    terms.map(|(k, c)| k as f64 * c.value().abs() * time_error.powi(k as i32 - 1)).sum()
}

/// The rate of a guard.
fn slope<const T: usize>(guard: &[Jet<T>], time: &Jet<T>) -> Jet<T> {
    let terms = guard.iter().enumerate().skip(1);
    let rates: Vec<Jet<T>> = terms.map(|(k, c)| Jet::times(c, k as f64)).collect();
    jet_horner(&rates, time)
}

/// The time near zero at which a guard is zero, which has the value zero.
///
/// Newton's method doubles the number of right terms: as many rounds as there are terms are more than enough.
fn zero<const T: usize>(guard: &[Jet<T>]) -> Jet<T> {
    let mut found = Jet::zero();
    for _ in 0..T {
        let mut value = jet_horner(guard, &found);
        // The execution has found the time: what is left of the value is rounding.
        put_value(&mut value, 0.0);
        found = Jet::difference(&found, &Jet::quotient(&value, &slope(guard, &found)));
    }
    found
}
