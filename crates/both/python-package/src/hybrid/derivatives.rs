//! Derivatives through arcs and events: state transition and saltation matrices.
//!
//! The library has them for states whose dimension is known when it is compiled. Arcs of a user are converted to
//! one of these.

use super::arcs::{HybridArc, OwnArc};
use super::callables::Callables;
use super::model::Model;
use super::names::{ExecutionMode, ExecutionSurface, Mode, Surface};
use super::vectors::State;
use crate::arrays::shaped;
use crate::errors::InputError;
use hybrid_system::{
    Arc as LibraryArc, ArcEnd, Differentiable, Error, Filippov, Guard, HybridSystem, Linearized,
    Reset, StateVector, gradient_by_differences, integrated_jacobian, jacobian_by_differences,
    reset_by_differences,
};
use nalgebra::{DVector, SMatrix, SVector};
use pyo3::prelude::*;
use std::sync::Arc;

/// Most components of a state with derivatives. Each number is compiled.
const MOST: usize = 8;

/// The functions of a user for states of N components.
struct OfDimension<'py, 'a, const N: usize>(Callables<'py, 'a>);

type Fixed<const N: usize> = SVector<f64, N>;

fn dynamic<const N: usize>(state: &Fixed<N>) -> State {
    DVector::from_column_slice(state.as_slice())
}

fn fixed<const N: usize>(state: &State) -> Fixed<N> {
    Fixed::from_column_slice(state.components())
}

impl<const N: usize> HybridSystem for OfDimension<'_, '_, N> {
    type State = Fixed<N>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, start: &Fixed<N>, time: f64) -> Fixed<N> {
        fixed(&self.0.flow(mode, &dynamic(start), time))
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        self.0.guards(mode)
    }

    fn guard_value(&self, surface: Surface, state: &Fixed<N>) -> f64 {
        self.0.guard_value(surface, &dynamic(state))
    }

    fn reset(&self, mode: Mode, surface: Surface, before: &Fixed<N>) -> Reset<Mode, Fixed<N>> {
        match self.0.reset(mode, surface, &dynamic(before)) {
            Reset::Jump { mode, state } | Reset::Resize { mode, state } => {
                Reset::Jump { mode, state: fixed(&state) }
            }
            Reset::Stop => Reset::Stop,
        }
    }

    fn vector_field(&self, mode: Mode, state: &Fixed<N>) -> Option<Fixed<N>> {
        self.0.vector_field(mode, &dynamic(state)).map(|field| fixed(&field))
    }
}

impl<const N: usize> Linearized<N> for OfDimension<'_, '_, N> {
    fn field_jacobian(&self, mode: Mode, state: &Fixed<N>) -> SMatrix<f64, N, N> {
        let none = || Fixed::repeat(f64::NAN);
        jacobian_by_differences(state, |x| self.vector_field(mode, x).unwrap_or_else(none))
    }
}

impl<const N: usize> Differentiable<N> for OfDimension<'_, '_, N> {
    fn flow_jacobian(&self, mode: Mode, start: &Fixed<N>, time: f64) -> SMatrix<f64, N, N> {
        if self.0.model.functions.flow.is_some() {
            return jacobian_by_differences(start, |start| self.flow(mode, start, time));
        }
        integrated_jacobian(self, mode, start, time, self.0.model.tolerances)
            .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
    }

    fn guard_gradient(&self, surface: Surface, state: &Fixed<N>) -> Fixed<N> {
        gradient_by_differences(state, |state| self.guard_value(surface, state))
    }

    fn reset_jacobian(
        &self,
        mode: Mode,
        surface: Surface,
        before: &Fixed<N>,
    ) -> SMatrix<f64, N, N> {
        reset_by_differences(self, mode, surface, before)
    }
}

/// A function of arcs for every dimension.
trait Derivative {
    type Found;

    fn of<const N: usize>(
        &self,
        system: &Filippov<OfDimension<'_, '_, N>>,
        arcs: &[LibraryArc<ExecutionMode, ExecutionSurface, Fixed<N>>],
    ) -> Result<Self::Found, Error>;
}

/// The function for the dimension of the arcs. An exception of a function of the user comes out unchanged.
fn derivative<D: Derivative>(
    py: Python<'_>,
    model: &Model,
    arcs: &[&OwnArc],
    of: &D,
) -> PyResult<D::Found> {
    let dimension = arcs.first().map_or(0, |arc| arc.start.dimension());
    match dimension {
        1 => fixed_derivative::<D, 1>(py, model, arcs, of),
        2 => fixed_derivative::<D, 2>(py, model, arcs, of),
        3 => fixed_derivative::<D, 3>(py, model, arcs, of),
        4 => fixed_derivative::<D, 4>(py, model, arcs, of),
        5 => fixed_derivative::<D, 5>(py, model, arcs, of),
        6 => fixed_derivative::<D, 6>(py, model, arcs, of),
        7 => fixed_derivative::<D, 7>(py, model, arcs, of),
        MOST => fixed_derivative::<D, MOST>(py, model, arcs, of),
        more => Err(InputError::new_err(format!(
            "derivatives are for states of 1 to {MOST} numbers, not {more}"
        ))),
    }
}

fn fixed_derivative<D: Derivative, const N: usize>(
    py: Python<'_>,
    model: &Model,
    arcs: &[&OwnArc],
    of: &D,
) -> PyResult<D::Found> {
    let arcs: Vec<_> = arcs.iter().map(|arc| arc.with_states(fixed::<N>)).collect();
    let system = Filippov::new(OfDimension(Callables::new(py, model)), model.tolerances)
        .following(model.follows);
    let found = of.of(&system, &arcs);
    match system.system().0.exception() {
        Some(exception) => Err(exception),
        None => found.map_err(|error| system.system().0.raised(&error)),
    }
}

/// Φ and the saltations of all arcs, row by row.
struct AtOneTime;

impl Derivative for AtOneTime {
    type Found = Vec<f64>;

    fn of<const N: usize>(
        &self,
        system: &Filippov<OfDimension<'_, '_, N>>,
        arcs: &[LibraryArc<ExecutionMode, ExecutionSurface, Fixed<N>>],
    ) -> Result<Vec<f64>, Error> {
        let matrix = hybrid_system::sensitivity(system, arcs)?;
        Ok(matrix.transpose().as_slice().to_vec())
    }
}

/// (∂x⁺/∂x₀, ∂τ/∂x₀) of one arc, row by row.
struct AtTheEvent;

impl Derivative for AtTheEvent {
    type Found = (Vec<f64>, Vec<f64>);

    fn of<const N: usize>(
        &self,
        system: &Filippov<OfDimension<'_, '_, N>>,
        arcs: &[LibraryArc<ExecutionMode, ExecutionSurface, Fixed<N>>],
    ) -> Result<(Vec<f64>, Vec<f64>), Error> {
        let [arc] = arcs else { return Err(Error::NoSensitivity { time: 0.0 }) };
        let (matrix, row) = hybrid_system::event_sensitivity(system, arc)?;
        Ok((matrix.transpose().as_slice().to_vec(), row.as_slice().to_vec()))
    }
}

/// The derivative of the state at the end of the last arc, after its event, by the start of the first one: a matrix.
///
/// arcs are consecutive ones of one execution. Orbits with other starts are compared at the same time: an event
/// that comes later by δτ changes the state after it (saltation). The derivatives of the functions are central
/// differences, with about ten digits; a field has its variational equation. The model needs field=, also beside a
/// flow in closed form. A parameter is a component of the state that never changes.
///
/// >>> from nonsmooth.hybrid import Guard, HybridSystem, sensitivity
/// >>> ball = HybridSystem(
/// ...     field=lambda mode, x: [x[1], -1.0],
/// ...     guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0.0, -x[1] / 2]))],
/// ... )
/// >>> arcs = [arc for arc in ball.run([0.0, 3.0], time=7)]
/// >>> round(float(sensitivity(arcs[:1])[1, 1]), 6)    # faster by δ: it leaves faster by δ/2, and 2δ later
/// 2.5
///
/// ValueError where there is no derivative: an event that only touches its surface, two surfaces reached at one
/// instant, a Zeno limit.
#[pyfunction]
pub(crate) fn sensitivity<'py>(
    py: Python<'py>,
    arcs: Vec<Py<HybridArc>>,
) -> PyResult<Bound<'py, PyAny>> {
    let all: Vec<&HybridArc> = arcs.iter().map(Py::get).collect();
    let Some(first) = all.first() else {
        return Err(InputError::new_err("sensitivity needs at least one arc"));
    };
    for (k, pair) in all.windows(2).enumerate() {
        if !Arc::ptr_eq(pair[0].model(), pair[1].model()) || !follows(pair[0].own(), pair[1].own())
        {
            let text = format!("arc {} does not begin where arc {k} ends", k + 1);
            return Err(InputError::new_err(text));
        }
    }
    let own: Vec<&OwnArc> = all.iter().map(|arc| arc.own()).collect();
    let matrix = derivative(py, first.model(), &own, &AtOneTime)?;
    let dimension = first.own().start.dimension();
    shaped(py, matrix, &[dimension, dimension])
}

/// The derivatives of the event that ends an arc by the start of the arc: the matrix ∂x⁺/∂x₀ of the state right
/// after the event, and the row ∂τ/∂x₀ of its time. States of different orbits are compared at their events, and
/// sensitivity() compares them at one time.
///
/// ValueError as for sensitivity(), and if no event ends the arc, or the event ends the execution.
#[pyfunction]
pub(crate) fn event_sensitivity<'py>(
    py: Python<'py>,
    arc: &HybridArc,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let (matrix, row) = derivative(py, arc.model(), &[arc.own()], &AtTheEvent)?;
    let dimension = row.len();
    Ok((shaped(py, matrix, &[dimension, dimension])?, shaped(py, row, &[dimension])?))
}

/// Whether an execution goes on with `next` after `arc`.
fn follows(arc: &OwnArc, next: &OwnArc) -> bool {
    let at = |after: &Option<(ExecutionMode, State)>| {
        after.as_ref().is_some_and(|(mode, state)| *mode == next.mode && *state == next.start)
    };
    match &arc.end {
        ArcEnd::Event(event) => at(&event.after),
        ArcEnd::Zeno { after, .. } | ArcEnd::Sliding { after, .. } => at(after),
        // A limit on time that was set later.
        ArcEnd::TimeLimit { .. } | ArcEnd::Unfinished { .. } => {
            (arc.mode, arc.jump) == (next.mode, next.jump)
        }
        ArcEnd::Never { .. } => false,
    }
}
