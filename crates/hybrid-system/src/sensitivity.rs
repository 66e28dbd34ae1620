//! How a small change of the start is carried through arcs and events: state transition and saltation.
//!
//! Along an arc δx(t) = Φ(t) δx₀. At an event an orbit that starts elsewhere arrives earlier or later, so
//! that
//!
//! ```text
//!   δx⁺ = Ξ δx⁻      Ξ = DR + (f⁺ − DR f⁻) ∇gᵀ/(∇g·f⁻)
//! ```
//!
//! with the reset R, the vector fields f⁻, f⁺ on both sides and the guard g (Müller 1995; Leine and
//! Nijmeijer 2004). Where the orbit only grazes, ∇g·f⁻ = 0 and there is no such matrix.

use crate::{Arc, ArcEnd, Error, Event, State, VectorField};
use nalgebra::{RowSVector, SMatrix};

/// The derivatives of a hybrid system that sensitivities need.
pub trait Differentiable<const N: usize>: VectorField<N> {
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

/// Below this share of |∇g| |f⁻| the rate ∇g·f⁻ at which a guard is crossed is no number to divide by.
const SLOWEST: f64 = 1e-12;

/// How a small change at the start of `arc` shows after the event that ends it, compared at the same time;
/// along the whole arc if none does.
///
/// ```
/// use hybrid_system::*;
/// use nalgebra::{Matrix2, SMatrix, Vector2};
///
/// #[derive(Debug, Clone, Copy, PartialEq, Eq)]
/// struct Floor;
/// /// A ball under unit gravity that keeps half of its speed.
/// struct Ball;
/// impl HybridSystem<2> for Ball {
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
///     fn reset(&self, _: (), _: Floor, x: &State<2>) -> Reset<(), 2> {
///         Reset::Jump { mode: (), state: Vector2::new(0.0, -0.5 * x[1]) }
///     }
/// }
/// impl VectorField<2> for Ball {
///     fn vector_field(&self, _: (), x: &State<2>) -> State<2> {
///         Vector2::new(x[1], -1.0)
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
/// // From the floor upwards with speed v it lands after 2v and leaves with v/2. A start that is faster by
/// // δ leaves faster by δ/2, but later by 2δ: compared at the same time, by δ/2 + 2δ.
/// let start = Vector2::new(0.0, 3.0);
/// let arc = Execution::new(&Ball, (), start, Limits::new(100.0, 1)).next().expect("an arc")?;
/// let change = arc_sensitivity(&Ball, &arc)? * Vector2::new(0.0, 1.0);
/// assert!((change[1] - 2.5).abs() < 1e-13);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`Error::GrazingSensitivity`] if the guard is crossed so slowly that there is no derivative;
/// [`Error::NoSensitivity`] for an arc that never ends, or ends in an accumulation, or along which the flow
/// has no derivative.
pub fn arc_sensitivity<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, N>,
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Differentiable<N>,
{
    let along = transition(system, arc)?;
    let Some(event) = arc.event() else { return Ok(along) };
    let Some((mode, after)) = event.after else { return Ok(along) };
    let (before, arrival) = arrival(system, arc.mode, event)?;
    let reset = system.reset_jacobian(arc.mode, event.surface, &event.before);
    let jump = system.vector_field(mode, &after) - reset * before;
    Ok((reset - jump * arrival) * along)
}

/// How a small change at the start of `arc` shows right after the event that ends it, and in the time of that
/// event: (∂x⁺/∂x₀, ∂τ/∂x₀). Compared at the event, whenever it is, not at the same time.
///
/// # Errors
/// As [`arc_sensitivity`], and [`Error::NoSensitivity`] if no event ends the arc, or the execution.
pub fn event_sensitivity<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, N>,
) -> Result<(SMatrix<f64, N, N>, RowSVector<f64, N>), Error>
where
    T: Differentiable<N>,
{
    let none = Error::NoSensitivity { time: arc.time };
    let event = arc.event().filter(|event| event.after.is_some()).ok_or(none)?;
    let along = transition(system, arc)?;
    let (before, arrival) = arrival(system, arc.mode, event)?;
    let reset = system.reset_jacobian(arc.mode, event.surface, &event.before);
    // The state on the surface moves by Φδx₀ + f⁻δτ.
    let on_surface = along + before * (arrival * along);
    Ok((reset * on_surface, arrival * along))
}

/// Φ along the whole arc.
fn transition<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, N>,
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

/// f⁻, and how the time of the event changes with the state before it: −∇gᵀ/(∇g·f⁻).
fn arrival<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    event: &Event<T::Mode, T::Surface, N>,
) -> Result<(State<N>, RowSVector<f64, N>), Error>
where
    T: Differentiable<N>,
{
    let gradient = system.guard_gradient(event.surface, &event.before);
    let before = system.vector_field(mode, &event.before);
    let rate = gradient.dot(&before);
    if !(rate.abs() > SLOWEST * gradient.norm() * before.norm()) {
        return Err(Error::GrazingSensitivity { time: event.time, rate });
    }
    Ok((before, -gradient.transpose() / rate))
}

/// How a small change at the start of the first of `arcs` shows at the end of the last.
///
/// # Errors
/// As [`arc_sensitivity`].
pub fn sensitivity<T, const N: usize>(
    system: &T,
    arcs: &[Arc<T::Mode, T::Surface, N>],
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Differentiable<N>,
{
    let mut product = SMatrix::identity();
    for arc in arcs {
        product = arc_sensitivity(system, arc)? * product;
    }
    Ok(product)
}
