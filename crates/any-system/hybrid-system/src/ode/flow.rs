//! The two calls that a model with an integrated mode needs: its flow, and its first crossing.

use super::integration::Integration;
use super::search::search;
use super::tolerances::Tolerances;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::state::StateVector;
use crate::system::HybridSystem;

/// The state after `time` along ẋ = f(x): the value that [`HybridSystem::flow`](crate::HybridSystem::flow) returns in a
/// mode without closed form.
///
/// If the integration fails before `time`, all components are NaN. [`Arc::state`](crate::Arc::state) and executions
/// return such a state as an error; [`integrated_states`] gives the reason.
pub fn integrated_flow<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    time: f64,
    tolerances: Tolerances,
) -> T::State {
    let mut after = None;
    let flow = visit_states(system, mode, start, &[time], tolerances, |state| after = Some(state));
    match (flow, after) {
        (Ok(()), Some(after)) => after,
        _ => start.filled(|_| f64::NAN),
    }
}

/// The states at many times along ẋ = f(x), in one integration: the value that
/// [`HybridSystem::flow_at`](crate::HybridSystem::flow_at) returns in a mode without closed form.
///
/// The times are in one order, from zero on: 0 ≤ t₀ ≤ t₁ ≤ …, or 0 ≥ t₀ ≥ t₁ ≥ … for the flow backward in time. The
/// last state is the end of a step, the others are values of interpolants, with errors like those of the steps.
///
/// # Errors
/// [`Error::BadLimit`] for times that are not finite or not in order, [`Error::NoVectorField`] for a mode without
/// field, and the errors of [`Integration`].
pub fn integrated_states<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    times: &[f64],
    tolerances: Tolerances,
) -> Result<Vec<T::State>, Error> {
    let mut states = Vec::with_capacity(times.len());
    visit_states(system, mode, start, times, tolerances, |state| states.push(state))?;
    Ok(states)
}

fn visit_states<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    times: &[f64],
    tolerances: Tolerances,
    mut visit: impl FnMut(T::State),
) -> Result<(), Error> {
    let Some(end) = last_time(times)? else { return Ok(()) };
    let mut times = times.iter().copied().peekable();
    while times.next_if_eq(&0.0).is_some() {
        visit(start.clone());
    }
    if times.peek().is_none() {
        return Ok(());
    }
    if system.vector_field(mode, start).is_none() {
        return Err(Error::NoVectorField { mode: format!("{mode:?}") });
    }
    let field = field_of(system, mode);
    let mut integration = Integration::new(&field, start, tolerances)?.autonomous().until(end)?;
    while !integration.ended() {
        integration.step()?;
        let (from, to) = integration.interval();
        while let Some(time) = times.next_if(|&time| between(from, time, to)) {
            visit(integration.at(time)?);
        }
    }
    Ok(())
}

/// The last of some times, none of none; an error unless they are in one order from zero on.
pub(crate) fn last_time(times: &[f64]) -> Result<Option<f64>, Error> {
    let Some(&end) = times.last() else { return Ok(None) };
    let mut before = 0.0;
    for &time in times {
        // Each time lies between the one before and the end.
        if !(time.is_finite() && between(before, time, end)) {
            return Err(Error::BadLimit { what: "a time that is not in order", value: time });
        }
        before = time;
    }
    Ok(Some(end))
}

/// True if `x` lies between `a` and `b`, in either order.
pub(super) fn between(a: f64, x: f64, b: f64) -> bool {
    (a <= x && x <= b) || (b <= x && x <= a)
}

/// The first crossing of a guard of `mode` along ẋ = f(x): the value that
/// [`HybridSystem::first_crossing`](crate::HybridSystem::first_crossing) returns in a mode without closed form.
///
/// On each step the integrator's interpolant makes every guard a function of time. A step is skipped if the guard stays
/// far from zero at the stages and at eighths of the step. Otherwise the guard is represented by the polynomial through
/// 16 of its values. An interval on which the last coefficients of that polynomial are not small is halved. No zero of
/// these polynomials is missed: [`Certainty::Interpolated`](crate::Certainty::Interpolated). For a guard that starts at
/// zero, within rounding, the side to which it leaves counts as its side. With up to eight guards no memory is
/// allocated.
///
/// A system with one integrated mode, a ball with air drag:
///
/// ```
/// use hybrid_system::*;
/// use nalgebra::Vector2;
///
/// struct Ball { drag: f64 }
/// const TOLERANCES: Tolerances = Tolerances::both(1e-12);
///
/// impl HybridSystem for Ball {
///     type State = State<2>;
///     type Mode = ();
///     type Surface = ();
///     fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
///         Some(Vector2::new(x[1], -1.0 - self.drag * x[1] * x[1].abs()))
///     }
///     fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
///         integrated_flow(self, mode, x, t, TOLERANCES)
///     }
///     fn guards(&self, _: ()) -> &[Guard<()>] {
///         const { &[Guard::falling(())] }
///     }
///     fn guard_value(&self, _: (), x: &State<2>) -> f64 {
///         x[0]
///     }
///     fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
///         Reset::Jump { mode: (), state: Vector2::new(0.0, -0.8 * x[1]) }
///     }
///     fn first_crossing(
///         &self, mode: (), x: &State<2>, search: &Search<()>,
///     ) -> Result<NextEvent<(), State<2>>, Error> {
///         integrated_crossing(self, mode, x, search, TOLERANCES)
///     }
/// }
///
/// let start = Vector2::new(2.0, 0.0);
/// let landing = Ball { drag: 0.5 }.first_crossing((), &start, &Search::up_to(9.0))?.crossing().expect("it falls");
/// // From height h the ball lands with v² = (1 − e^(−2kh))/k.
/// assert!((landing.state[1].powi(2) - 2.0 * (1.0 - (-2f64).exp())).abs() < 1e-11);
/// # Ok::<(), Error>(())
/// ```
///
/// If the steps of the [`Search`] or of the [`Tolerances`] end, or the intervals of the search, the result is
/// [`NextEvent::Unfinished`](crate::NextEvent::Unfinished) with the time and the state up to which there is no
/// event. This is no error: a search from there goes on.
///
/// # Errors
/// * [`Error::Grazing`] for a touch of a guard whose [`Touch`](crate::Touch) is an error: the guard comes within
///   rounding of its surface, and its sign is the same before and behind.
/// * [`Error::UndecidedStart`], [`Error::UndecidedSign`] if rounding hides how a guard leaves a start on its surface.
/// * [`Error::NotFinite`] where a guard is infinite or NaN and no event comes before; [`Error::FieldNotFinite`]
///   where the field is, also in a mode for which the model gives no field; [`Error::StateNotFinite`] for such a
///   start.
/// * [`Error::Integration`] if no step is short enough for the tolerances; [`Error::BadTolerance`],
///   [`Error::BadLimit`], [`Error::Dimension`] for tolerances, a horizon or a field that are not valid, as in
///   [`Integration`].
pub fn integrated_crossing<T>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    request: &Search<T::Surface>,
    tolerances: Tolerances,
) -> Result<NextEvent<T::Surface, T::State>, Error>
where
    T: HybridSystem + ?Sized,
{
    let field = field_of(system, mode);
    let integration = |longest_first: f64| {
        let integration = Integration::new(&field, start, tolerances)?.autonomous();
        Ok(integration.until(request.horizon)?.starting_with(longest_first))
    };
    search(system, mode, (start, &field(0.0, start)), request, integration, tolerances)
}

/// f of a mode. Its components are NaN where the model gives no field.
fn field_of<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
) -> impl Fn(f64, &T::State) -> T::State + '_ {
    move |_, state| {
        let outside = || state.filled(|_| f64::NAN);
        system.vector_field(mode, state).unwrap_or_else(outside)
    }
}
