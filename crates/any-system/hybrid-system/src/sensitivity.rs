//! How a small change of the start propagates through arcs and events: state transition and saltation matrices.
//!
//! Along an arc δx(t) = Φ(t) δx₀. An orbit with another start reaches the surface of an event earlier or later.
//! Compared at the same time after the event,
//!
//! ```text
//!   δx⁺ = Ξ δx⁻      Ξ = DR + (f⁺ − DR f⁻) ∇gᵀ/(∇g·f⁻)
//! ```
//!
//! with the reset R, the vector fields f⁻ and f⁺ on both sides, and the guard g: statement (10) of
//! [mathematics](crate::mathematics). If the orbit only grazes the surface, ∇g·f⁻ = 0, and there is no such matrix.

use crate::arc::{Arc, ArcEnd};
use crate::delay::{Delay, delay_of_event};
use crate::error::Error;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::{RowSVector, SMatrix};

/// The derivatives of a hybrid system that sensitivities need.
pub trait Differentiable<const N: usize>: HybridSystem<State = State<N>> {
    /// ∂φ(t; x₀)/∂x₀.
    fn flow_jacobian(&self, mode: Self::Mode, start: &State<N>, time: f64) -> SMatrix<f64, N, N>;

    /// ∇g.
    fn guard_gradient(&self, surface: Self::Surface, state: &State<N>) -> State<N>;

    /// ∂x⁺/∂x⁻ of the reset, at fixed time.
    fn reset_jacobian(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &State<N>,
    ) -> SMatrix<f64, N, N>;
}

/// Smallest rate ∇g·f⁻, relative to |∇g||f⁻|, at which a guard may be crossed. The scalar product is wrong by about
/// 1e-16 |∇g||f⁻|: at this rate four digits of the quotient are left. Slower crossings are
/// [`Error::GrazingSensitivity`].
const SMALLEST_RATE: f64 = 1e-12;

/// The matrix from a small change of the start of `arc` to the change after the event that ends the arc, compared at
/// the same time. If no event ends the arc, it is the matrix to the change at the end of the arc.
///
/// ```
/// use hybrid_system::*;
/// use nalgebra::{Matrix2, SMatrix, Vector2};
///
/// #[derive(Debug, Clone, Copy, PartialEq, Eq)]
/// struct Floor;
/// /// A ball under unit gravity that keeps half of its speed.
/// struct Ball;
/// impl HybridSystem for Ball {
///     type State = State<2>;
///     type Mode = ();
///     type Surface = Floor;
///     fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
///         Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
///     }
///     fn guards(&self, _: ()) -> &[Guard<Floor>] {
///         const { &[Guard::falling(Floor)] }
///     }
///     fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
///         x[0]
///     }
///     fn guard_quasi_polynomial(&self, _: (), _: Floor, x: &State<2>) -> Option<QuasiPolynomial> {
///         Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5]))
///     }
///     fn reset(&self, _: (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
///         Reset::Jump { mode: (), state: Vector2::new(0.0, -0.5 * x[1]) }
///     }
///     fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
///         Some(Vector2::new(x[1], -1.0))
///     }
/// }
/// impl Differentiable<2> for Ball {
///     fn flow_jacobian(&self, _: (), _: &State<2>, t: f64) -> SMatrix<f64, 2, 2> {
///         Matrix2::new(1.0, t, 0.0, 1.0)
///     }
///     fn guard_gradient(&self, _: Floor, _: &State<2>) -> State<2> {
///         Vector2::new(1.0, 0.0)
///     }
///     fn reset_jacobian(&self, _: (), _: Floor, _: &State<2>) -> SMatrix<f64, 2, 2> {
///         Matrix2::new(0.0, 0.0, 0.0, -0.5)
///     }
/// }
/// // From the floor upwards with speed v the ball lands after 2v and leaves with v/2. A start that is faster by
/// // δ leaves faster by δ/2 and later by 2δ. Compared at the same time it is faster by δ/2 + 2δ.
/// let start = Vector2::new(0.0, 3.0);
/// let arc = Execution::new(&Ball, (), start, Limits::new(100.0, 1)).next().expect("an arc")?;
/// let change = arc_sensitivity(&Ball, &arc)? * Vector2::new(0.0, 1.0);
/// assert!((change[1] - 2.5).abs() < 1e-13);
/// # Ok::<(), Error>(())
/// ```
///
/// The time of a [clock](crate::Role::Clock) does not change with the start.
///
/// # Errors
/// [`Error::GrazingSensitivity`] if the guard is crossed so slowly that there is no derivative, or only touches;
/// [`Error::NoSensitivity`] for an arc that never ends or ends in a Zeno limit, and for a flow without a derivative.
pub fn arc_sensitivity<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, State<N>>,
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Differentiable<N>,
{
    Ok(after_arc(system, arc, &SMatrix::identity(), None)?.0)
}

/// The change after the event that ends an arc, from the `change` at its start, and the delay of that event.
/// `before` is the delay of the event before the arc.
fn after_arc<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, State<N>>,
    change: &SMatrix<f64, N, N>,
    before: Option<&Delay<N>>,
) -> Result<(SMatrix<f64, N, N>, Option<Delay<N>>), Error>
where
    T: Differentiable<N>,
{
    let along = transition(system, arc)? * change;
    if let ArcEnd::Sliding { sliding, after: Some((mode, after)) } = &arc.end {
        // The sliding motion starts where the state is: DR = I.
        let at = (sliding.surface, &sliding.state, sliding.time);
        let (field_before, arrival) = arrival(system, arc.mode, at)?;
        let delay = arrival * along;
        let kink = field(system, *mode, after)? - field_before;
        return Ok((along - kink * delay, None));
    }
    let Some(event) = arc.event() else { return Ok((along, None)) };
    // An event that ends the execution has no state after it.
    let Some((mode, after)) = event.after else { return Ok((along, None)) };
    let by_guard = || {
        let at = (event.surface, &event.before, event.time);
        Ok(arrival(system, arc.mode, at)?.1 * along)
    };
    let Some(delay) = delay_of_event(system, arc, by_guard, before)? else {
        return Ok((along, before.copied()));
    };
    let reset = system.reset_jacobian(arc.mode, event.surface, &event.before);
    // Ξ = DR − (f⁺ − DR f⁻) ∂τ/∂x⁻: if the orbit arrives later by δτ, it moves longer by δτ before the event and
    // shorter by δτ after it.
    let jump = field(system, mode, &after)? - reset * field(system, arc.mode, &event.before)?;
    let change = reset * along - jump * delay;
    Ok((change, Some(Delay { delay, time_rounding: event.time_rounding })))
}

/// The matrices from a small change of the start of `arc` to the change of the state right after the event that
/// ends the arc, and to the change of the time τ of that event: (∂x⁺/∂x₀, ∂τ/∂x₀). States are compared at the
/// event, not at the same time.
///
/// # Errors
/// The errors of [`arc_sensitivity`], and [`Error::NoSensitivity`] if no event ends the arc, or the event ends the
/// execution.
pub fn event_sensitivity<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, State<N>>,
) -> Result<(SMatrix<f64, N, N>, RowSVector<f64, N>), Error>
where
    T: Differentiable<N>,
{
    let none = Error::NoSensitivity { time: arc.time };
    let event = arc.event().filter(|event| event.after.is_some()).ok_or(none)?;
    let along = transition(system, arc)?;
    let by_guard = || {
        let at = (event.surface, &event.before, event.time);
        Ok(arrival(system, arc.mode, at)?.1 * along)
    };
    let delay = delay_of_event(system, arc, by_guard, None)?
        .ok_or(Error::NoSensitivity { time: arc.time })?;
    let reset = system.reset_jacobian(arc.mode, event.surface, &event.before);
    // The state on the surface changes by Φδx₀ + f⁻δτ.
    let on_surface = along + field(system, arc.mode, &event.before)? * delay;
    Ok((reset * on_surface, delay))
}

/// Φ along the whole arc.
pub(crate) fn transition<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, State<N>>,
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Differentiable<N>,
{
    if !arc.duration.is_finite() || matches!(arc.end, ArcEnd::Zeno { .. }) {
        return Err(Error::NoSensitivity { time: arc.time });
    }
    let along = system.flow_jacobian(arc.mode, &arc.start, arc.duration);
    if along.iter().all(|entry| entry.is_finite()) {
        return Ok(along);
    }
    Err(Error::NoSensitivity { time: arc.time })
}

/// f(x) in `mode`.
pub(crate) fn field<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    state: &State<N>,
) -> Result<State<N>, Error>
where
    T: HybridSystem<State = State<N>>,
{
    let none = || Error::NoVectorField { mode: format!("{mode:?}") };
    system.vector_field(mode, state).ok_or_else(none)
}

/// f⁻, and the derivative of the time of the event with respect to the state before it, −∇gᵀ/(∇g·f⁻).
pub(crate) fn arrival<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    (surface, before, time): (T::Surface, &State<N>, f64),
) -> Result<(State<N>, RowSVector<f64, N>), Error>
where
    T: Differentiable<N>,
{
    let gradient = system.guard_gradient(surface, before);
    let field_before = field(system, mode, before)?;
    let rate = gradient.dot(&field_before);
    if !(rate.abs() > SMALLEST_RATE * gradient.norm() * field_before.norm()) {
        return Err(Error::GrazingSensitivity { time, rate });
    }
    Ok((field_before, -gradient.transpose() / rate))
}

/// The matrix from a small change of the start of the first of `arcs` to the change at the end of the last one.
///
/// An event at once after another one happens at the time of that event, however the start changes.
///
/// # Errors
/// The errors of [`arc_sensitivity`], and [`Error::CornerSensitivity`] where two surfaces are reached at one
/// instant: nearby orbits reach them one after the other, in either order.
pub fn sensitivity<T, const N: usize>(
    system: &T,
    arcs: &[Arc<T::Mode, T::Surface, State<N>>],
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Differentiable<N>,
{
    let (mut product, mut delay) = (SMatrix::identity(), None);
    for arc in arcs {
        (product, delay) = after_arc(system, arc, &product, delay.as_ref())?;
    }
    Ok(product)
}
