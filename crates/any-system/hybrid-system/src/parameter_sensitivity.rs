//! How a small change of the parameters of a system propagates through arcs and events.
//!
//! Along an arc δx⁻ = Φ δx⁺ + Π δp, with Π = ∂φ/∂p at fixed time. The state lies on the surface g(x, p) = 0 at the
//! event. So the event comes later by
//!
//! ```text
//!   δτ = −(∇g·δx⁻ + ∂g/∂p δp)/(∇g·f⁻)
//! ```
//!
//! and the states after it, compared at the same time, differ by
//!
//! ```text
//!   δx⁺ = DR δx⁻ + ∂R/∂p δp − (f⁺ − DR f⁻) δτ = Ξ δx⁻ + (∂R/∂p + (f⁺ − DR f⁻)(∂g/∂p)/(∇g·f⁻)) δp
//! ```
//!
//! with the saltation Ξ of `sensitivity`. A component p of the state with ṗ = 0 gives the same numbers: ∂x/∂p is then a
//! block of Φ, Ξ and their products. The functions here need no such state.

use crate::arc::{Arc, ArcEnd};
use crate::crossing::EventKind;
use crate::delay::{Delay, delay_of_event};
use crate::error::Error;
use crate::sensitivity::{Differentiable, arrival, field, transition};
use crate::state::State;
use nalgebra::{RowSVector, SMatrix};

/// The derivatives of a hybrid system with respect to P parameters. Each has one column for each parameter.
///
/// [`Family`](crate::Family) gives them for every model by closures. A model by the trait gives them itself.
pub trait Parametric<const N: usize, const P: usize> {
    /// The system.
    type System: Differentiable<N>;

    /// The system at the parameters p.
    fn system(&self) -> &Self::System;

    /// ∂φ(t; x₀, p)/∂p, at fixed start and time. In an integrated mode `integrated_parameter_jacobian` computes it.
    fn flow_by_parameters(
        &self,
        mode: ModeOf<Self, N, P>,
        start: &State<N>,
        time: f64,
    ) -> SMatrix<f64, N, P>;

    /// ∂g/∂p.
    fn guard_by_parameters(
        &self,
        surface: SurfaceOf<Self, N, P>,
        state: &State<N>,
    ) -> RowSVector<f64, P>;

    /// ∂x⁺/∂p of the reset, at fixed x⁻.
    fn reset_by_parameters(
        &self,
        mode: ModeOf<Self, N, P>,
        surface: SurfaceOf<Self, N, P>,
        before: &State<N>,
    ) -> SMatrix<f64, N, P>;
}

type ModeOf<F, const N: usize, const P: usize> =
    <<F as Parametric<N, P>>::System as crate::system::HybridSystem>::Mode;
type SurfaceOf<F, const N: usize, const P: usize> =
    <<F as Parametric<N, P>>::System as crate::system::HybridSystem>::Surface;
type ArcOf<F, const N: usize, const P: usize> = Arc<ModeOf<F, N, P>, SurfaceOf<F, N, P>, State<N>>;

/// ∂x/∂p at the end of the last of `arcs`, after its event, at fixed time. `start` is ∂x₀/∂p at the start of the first
/// one: zero if the start does not depend on the parameters.
///
/// The times of the events depend on the parameters, and the state changes with them. At fixed time the derivative of
/// the state contains both.
///
/// ```
/// use hybrid_system::*;
/// use nalgebra::Matrix2;
///
/// // A ball that falls from height 1, by gravity g and restitution e.
/// let ball = |[g, e]: [f64; 2]| {
///     Model::closed_form(move |(), x: &State<2>, t| [x[0] + t * (x[1] - g * t / 2.0), x[1] - g * t])
///         .field(move |(), x| [x[1], -g])
///         .falling((), |x| x[0], move |x| ((), [0.0, -e * x[1]]))
///         .signal(0, move |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -g / 2.0])))
/// };
/// let family = Family::new([2.0, 0.5], ball);
/// let arcs = Execution::new(family.system(), (), [1.0, 0.0].into(), Limits::new(9.0, 1));
/// let arcs = arcs.collect::<Result<Vec<_>, _>>()?;
/// let (state, time) = event_parameter_sensitivity(&family, &arcs[..1], &Matrix2::zeros())?;
/// // It lands after √(2/g), and leaves with e√(2g).
/// assert!((time[0] + 0.25).abs() < 1e-9 && time[1].abs() < 1e-9);
/// assert!((state[(1, 0)] - 0.25).abs() < 1e-9 && (state[(1, 1)] - 2.0).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// The errors of [`sensitivity`](crate::sensitivity), and [`Error::ClockSensitivity`] for a preset time, which may
/// depend on the parameters.
pub fn parameter_sensitivity<F, const N: usize, const P: usize>(
    family: &F,
    arcs: &[ArcOf<F, N, P>],
    start: &SMatrix<f64, N, P>,
) -> Result<SMatrix<f64, N, P>, Error>
where
    F: Parametric<N, P>,
{
    Ok(after_arcs(family, arcs, start)?.0)
}

/// ∂x⁺/∂p and ∂τ/∂p: the derivatives of the state right after the event that ends the last of `arcs`, and of the
/// time of that event. The states of different parameters are compared at their events, not at the same time.
/// `start` is ∂x₀/∂p at the start of the first arc, whose time does not depend on the parameters.
///
/// # Errors
/// Those of [`parameter_sensitivity`], and [`Error::NoSensitivity`] if no event ends the last arc, or the event
/// ends the execution.
pub fn event_parameter_sensitivity<F, const N: usize, const P: usize>(
    family: &F,
    arcs: &[ArcOf<F, N, P>],
    start: &SMatrix<f64, N, P>,
) -> Result<(SMatrix<f64, N, P>, RowSVector<f64, P>), Error>
where
    F: Parametric<N, P>,
{
    let Some((last, before)) = arcs.split_last() else {
        return Err(Error::NoSensitivity { time: 0.0 });
    };
    let none = Error::NoSensitivity { time: last.time };
    let event = last.event().filter(|event| event.after.is_some()).ok_or(none)?;
    let (change, before) = after_arcs(family, before, start)?;
    let change = along_arc(family, last, &change)?;
    let delay = delay_at(family, last, &change, before.as_ref())?
        .ok_or(Error::NoSensitivity { time: last.time })?;
    let field_before = field(family.system(), last.mode, &event.before)?;
    let reset = family.system().reset_jacobian(last.mode, event.surface, &event.before);
    let by_parameters = family.reset_by_parameters(last.mode, event.surface, &event.before);
    finite(reset * (change + field_before * delay) + by_parameters, last.time)
        .map(|state| (state, delay))
}

/// ∂x/∂p after the last of `arcs`, and the delay of its event.
fn after_arcs<F, const N: usize, const P: usize>(
    family: &F,
    arcs: &[ArcOf<F, N, P>],
    start: &SMatrix<f64, N, P>,
) -> Result<(SMatrix<f64, N, P>, Option<Delay<P>>), Error>
where
    F: Parametric<N, P>,
{
    let (mut change, mut delay) = (*start, None);
    for arc in arcs {
        (change, delay) = after_arc(family, arc, &change, delay.as_ref())?;
    }
    Ok((change, delay))
}

/// ∂x/∂p after the event of an arc, at fixed time, from that at its start, and the delay of the event. `before` is
/// the delay of the event before the arc.
fn after_arc<F, const N: usize, const P: usize>(
    family: &F,
    arc: &ArcOf<F, N, P>,
    start: &SMatrix<f64, N, P>,
    before: Option<&Delay<P>>,
) -> Result<(SMatrix<f64, N, P>, Option<Delay<P>>), Error>
where
    F: Parametric<N, P>,
{
    let system = family.system();
    let change = along_arc(family, arc, start)?;
    if let ArcEnd::Sliding { sliding, after: Some((mode, after)) } = &arc.end {
        // The sliding motion starts where the state is: DR = I, ∂R/∂p = 0.
        let at = (sliding.surface, &sliding.state, sliding.time);
        let (field_before, delay) = delay_by_guard(family, arc.mode, at, &change)?;
        let kink = field(system, *mode, after)? - field_before;
        return Ok((finite(change - kink * delay, arc.time)?, None));
    }
    // An event that ends the execution has no state after it.
    let Some((event, (mode, after))) =
        arc.event().and_then(|event| event.after.map(|after| (event, after)))
    else {
        return Ok((change, None));
    };
    let Some(delay) = delay_at(family, arc, &change, before)? else {
        return Ok((change, before.copied()));
    };
    let reset = system.reset_jacobian(arc.mode, event.surface, &event.before);
    let by_parameters = family.reset_by_parameters(arc.mode, event.surface, &event.before);
    let jump = field(system, mode, &after)? - reset * field(system, arc.mode, &event.before)?;
    let change = finite(reset * change + by_parameters - jump * delay, arc.time)?;
    Ok((change, Some(Delay { delay, time_rounding: event.time_rounding })))
}

/// ∂τ/∂p of an event; `None` if it changes nothing, and needs none.
fn delay_at<F, const N: usize, const P: usize>(
    family: &F,
    arc: &ArcOf<F, N, P>,
    change: &SMatrix<f64, N, P>,
    before: Option<&Delay<P>>,
) -> Result<Option<RowSVector<f64, P>>, Error>
where
    F: Parametric<N, P>,
{
    let event = arc.event().ok_or(Error::NoSensitivity { time: arc.time })?;
    if event.kind == EventKind::Clock {
        return Err(Error::ClockSensitivity { time: event.time });
    }
    let at = (event.surface, &event.before, event.time);
    let by_guard = || delay_by_guard(family, arc.mode, at, change).map(|(_, delay)| delay);
    delay_of_event(family.system(), arc, by_guard, before)
}

/// ∂x⁻/∂p at the end of an arc: Φ ∂x₀/∂p + Π.
fn along_arc<F, const N: usize, const P: usize>(
    family: &F,
    arc: &ArcOf<F, N, P>,
    start: &SMatrix<f64, N, P>,
) -> Result<SMatrix<f64, N, P>, Error>
where
    F: Parametric<N, P>,
{
    let along = transition(family.system(), arc)? * start;
    finite(along + family.flow_by_parameters(arc.mode, &arc.start, arc.duration), arc.time)
}

/// f⁻, and ∂τ/∂p of a crossing.
fn delay_by_guard<F, const N: usize, const P: usize>(
    family: &F,
    mode: ModeOf<F, N, P>,
    (surface, before, time): (SurfaceOf<F, N, P>, &State<N>, f64),
    change: &SMatrix<f64, N, P>,
) -> Result<(State<N>, RowSVector<f64, P>), Error>
where
    F: Parametric<N, P>,
{
    let system = family.system();
    // `arrival` is −∇gᵀ/(∇g·f⁻).
    let (field_before, arrival) = arrival(system, mode, (surface, before, time))?;
    let rate = system.guard_gradient(surface, before).dot(&field_before);
    let delay = arrival * change - family.guard_by_parameters(surface, before) / rate;
    Ok((field_before, delay))
}

/// A derivative with an entry that is not finite is none.
fn finite<const N: usize, const P: usize>(
    change: SMatrix<f64, N, P>,
    time: f64,
) -> Result<SMatrix<f64, N, P>, Error> {
    let is_finite = change.iter().all(|entry| entry.is_finite());
    if is_finite { Ok(change) } else { Err(Error::NoSensitivity { time }) }
}
