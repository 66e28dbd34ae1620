//! The two calls that a model with an integrated mode needs: its flow, and its first crossing.

use super::integration::Integration;
use super::search::search;
use super::tolerances::Tolerances;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::state::State;
use crate::system::HybridSystem;

/// The state after `time` along ẋ = f(x): the value that [`HybridSystem::flow`](crate::HybridSystem::flow) returns in a
/// mode without closed form.
///
/// If the integration fails before `time`, all components are NaN. [`Arc::state`](crate::Arc::state) and executions
/// return such a state as an error; [`Integration`] gives the reason.
pub fn integrated_flow<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    time: f64,
    tolerances: Tolerances,
) -> State<N>
where
    T: HybridSystem<State = State<N>> + ?Sized,
{
    let state = || {
        if !(time >= 0.0) {
            return Err(Error::BadLimit { what: "the time of a flow", value: time });
        }
        if time == 0.0 {
            return Ok(*start);
        }
        let field = field_of(system, mode);
        let mut integration = Integration::new(field, start, tolerances)?;
        while integration.interval().1 < time {
            integration.step()?;
        }
        integration.directly_at(time)
    };
    state().unwrap_or_else(|_: Error| State::repeat(f64::NAN))
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
/// # Errors
/// [`Error::Grazing`] where a guard comes within rounding of its surface; [`Error::UndecidedStart`] if rounding
/// hides how a guard leaves a start on its surface; the errors of [`Integration`].
pub fn integrated_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    request: &Search<T::Surface>,
    tolerances: Tolerances,
) -> Result<NextEvent<T::Surface, State<N>>, Error>
where
    T: HybridSystem<State = State<N>> + ?Sized,
{
    let field = field_of(system, mode);
    search(system, mode, start, request, field, tolerances)
}

/// f of a mode. Its components are NaN where the model gives no field.
fn field_of<T, const N: usize>(
    system: &T,
    mode: T::Mode,
) -> impl Fn(f64, &State<N>) -> State<N> + '_
where
    T: HybridSystem<State = State<N>> + ?Sized,
{
    move |_, state| system.vector_field(mode, state).unwrap_or_else(|| State::repeat(f64::NAN))
}
