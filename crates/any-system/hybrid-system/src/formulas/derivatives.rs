//! The derivatives of a model of equations: those of its formulas, and of their flow.

use super::jets::Along;
use super::label::Label;
use super::motion::TaylorMotion;
use crate::model::{Model, ModelPart, gradient_by_differences, reset_by_differences};
use crate::ode::Linearized;
use crate::sensitivity::Differentiable;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::SMatrix;

impl<P, const N: usize> Model<Label, Label, State<N>, TaylorMotion, P> {
    /// The derivative of the flow in a direction; NaN where it has none.
    pub(super) fn flow_derivative(
        &self,
        mode: Label,
        start: &State<N>,
        time: f64,
        direction: &Along,
    ) -> State<N> {
        let found = self.motion.mode(mode).and_then(|program| {
            let start = self.start_jet::<2>(start, direction)?;
            self.jet_flow(program, &start, time)
        });
        let Ok(end) = found else { return State::repeat(f64::NAN) };
        State::from_fn(|row, _| end[row].0[1])
    }
}

/// The direction of one component.
fn unit<const N: usize>(axis: usize) -> Along {
    let mut change = [0.0; N];
    change[axis] = 1.0;
    Along::start(&change)
}

/// A matrix by its columns.
fn columns<const N: usize>(column: impl Fn(usize) -> State<N>) -> SMatrix<f64, N, N> {
    let mut matrix = SMatrix::<f64, N, N>::zeros();
    (0..N).for_each(|axis| matrix.set_column(axis, &column(axis)));
    matrix
}

/// Exact, from the formulas.
impl<P, const N: usize> Linearized<N> for Model<Label, Label, State<N>, TaylorMotion, P>
where
    P: ModelPart<Label, Label, State<N>>,
{
    /// NaN where the field has no derivative.
    fn field_jacobian(&self, mode: Label, state: &State<N>) -> SMatrix<f64, N, N> {
        // The first coefficients of the motion are the field.
        columns(|axis| {
            let found = self.motion.mode(mode).and_then(|program| {
                let start = self.start_jet::<2>(state, &unit::<N>(axis))?;
                Ok(program.jets()?.coefficients(&start, 1)?)
            });
            let Ok(found) = found else { return State::repeat(f64::NAN) };
            State::from_fn(|row, _| found.state(row)[1].0[1])
        })
    }
}

/// Exact for the formulas; by differences for closures that were added to them.
impl<P, const N: usize> Differentiable<N> for Model<Label, Label, State<N>, TaylorMotion, P>
where
    P: ModelPart<Label, Label, State<N>>,
{
    /// All entries are NaN if the integration fails.
    fn flow_jacobian(&self, mode: Label, start: &State<N>, time: f64) -> SMatrix<f64, N, N> {
        columns(|axis| self.flow_derivative(mode, start, time, &unit::<N>(axis)))
    }

    fn guard_gradient(&self, surface: Label, state: &State<N>) -> State<N> {
        self.parts.gradient(surface, state).unwrap_or_else(|| {
            gradient_by_differences(state, |state| self.guard_value(surface, state))
        })
    }

    fn reset_jacobian(&self, mode: Label, surface: Label, before: &State<N>) -> SMatrix<f64, N, N> {
        match self.parts.reset_column(mode, surface, before, 0) {
            None => reset_by_differences(self, mode, surface, before),
            Some(_) => columns(|axis| {
                let column = self.parts.reset_column(mode, surface, before, axis);
                column.unwrap_or_else(|| State::repeat(f64::NAN))
            }),
        }
    }
}
