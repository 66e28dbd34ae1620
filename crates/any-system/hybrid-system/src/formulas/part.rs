//! The guards and resets of a model's equations.

use super::equations::Jump;
use super::label::Label;
use super::programs::{GuardProgram, Programs};
use crate::backward::{is_back, wrong_inverse};
use crate::crossing::QuasiPolynomial;
use crate::error::Error;
use crate::model::ModelPart;
use crate::state::StateVector;
use crate::system::Reset;
use equations::{Formulas, Jet, JetSeries};
use interval_arithmetic::Enclosure;
use smallvec::SmallVec;
use std::sync::Arc;

/// The error of states in equations backward, relative and absolute: a start is often the end of a run forward, which is known to its
/// tolerances. By rounding alone it would be beside the surface on which it is. It is that of the usual tolerance.
const START_ERROR: f64 = 1e-12;

/// How far beside a state a guard that may jump is looked at, relative to the state: far beyond the rounding of the guard's
/// arithmetic, and near enough for the same error.
const BESIDE: f64 = 1e-8;

/// The part of a model that its equations give: all guards, with what their events do.
#[derive(Debug, Clone)]
pub struct FormulaPart(pub(super) Arc<Programs>);

impl FormulaPart {
    /// The guard of a surface, in any mode.
    fn guard(&self, surface: Label) -> Option<&GuardProgram> {
        let mut guards = self.0.modes.iter().flat_map(|mode| &mode.guards);
        guards.find(|guard| guard.surface == surface)
    }

    /// The derivatives of some values by one component of the state.
    fn derivatives<X: StateVector>(
        &self,
        jets: &JetSeries,
        state: &X,
        axis: usize,
    ) -> Option<Vec<f64>> {
        let component =
            |(at, value): (usize, &f64)| Jet::<2>::moving(*value, f64::from(at == axis));
        let parameters = self.0.equations.names().values.iter();
        let parameters = parameters.map(|value| Jet::number(value.value()));
        let start = state.components().iter().enumerate().map(component).chain(parameters);
        let values = jets.values(&start.collect::<Vec<_>>()).ok()?;
        Some(values.iter().map(|value| value.0[1]).collect())
    }
}

/// The vector of some formulas; NaN where they have no value.
pub(super) fn vector<X: StateVector>(formulas: &Formulas, state: &X) -> X {
    let mut vector = state.zeros_like();
    match formulas.write_values(0.0, state.components(), vector.components_mut()) {
        Ok(()) => vector,
        Err(_) => state.filled(|_| f64::NAN),
    }
}

/// Mode and state after a jump.
fn after<X: StateVector>(jump: &Jump, mode: Label, state: &X) -> (Label, X) {
    let next = jump.state.as_ref().map_or_else(|| state.clone(), |next| vector(next, state));
    (jump.mode.unwrap_or(mode), next)
}

impl<X: StateVector> ModelPart<Label, Label, X> for FormulaPart {
    fn value(&self, surface: Label, state: &X) -> Option<f64> {
        // Without a value it is NaN, which the search reports.
        Some(self.guard(surface)?.function.first_value(0.0, state.components()))
    }

    /// The width of the enclosure of the value: that of its own arithmetic, and of decimals that are no doubles. Where the guard
    /// may jump, it is that beside the state: the height of a jump is no error.
    fn guard_error(&self, surface: Label, state: &X) -> Option<f64> {
        let guard = self.guard(surface)?;
        let width = |factor: f64| {
            let state: SmallVec<[Enclosure; 8]> = state
                .components()
                .iter()
                .map(|component| Enclosure::from(factor * component))
                .collect();
            Some(guard.function.enclosures(Enclosure::ZERO, &state).ok()?.first()?.width())
        };
        match guard.may_jump {
            false => width(1.0),
            true => {
                [1.0, 1.0 - BESIDE, 1.0 + BESIDE].into_iter().filter_map(width).reduce(f64::min)
            }
        }
    }

    /// Where the motion and all guards of the mode have a closed form.
    fn quasi_polynomial(&self, mode: Label, surface: Label, start: &X) -> Option<QuasiPolynomial> {
        let program = self.0.mode(mode)?;
        let place = program.guards.iter().position(|guard| guard.surface == surface)?;
        program.closed_form(start.components())?.guards.get(place).cloned()
    }

    fn gradient(&self, surface: Label, state: &X) -> Option<X> {
        let jets = self.guard(surface)?.value_jets().ok()?;
        let derivative = |axis| self.derivatives(jets, state, axis)?.first().copied();
        let gradient: Option<Vec<f64>> = (0..state.dimension()).map(derivative).collect();
        let gradient = gradient?;
        Some(state.filled(|axis| gradient[axis]))
    }

    fn reset_column(&self, mode: Label, surface: Label, before: &X, column: usize) -> Option<X> {
        let guard = self.0.mode(mode)?.of_surface(surface)?;
        guard.jump.as_ref()?;
        match guard.reset_jets().ok()? {
            Some(jets) => {
                let derivatives = self.derivatives(jets, before, column)?;
                Some(before.filled(|axis| derivatives[axis]))
            }
            None => Some(before.filled(|axis| f64::from(axis == column))),
        }
    }

    fn reset(&self, mode: Label, surface: Label, before: &X) -> Option<Reset<Label, X>> {
        let guard = self.0.mode(mode)?.of_surface(surface)?;
        Some(guard.jump.as_ref().map_or(Reset::Stop, |jump| {
            let (mode, state) = after(jump, mode, before);
            // Without a finite state the run ends in `reset_error`.
            match jump
                .inverse
                .as_ref()
                .is_none_or(|inverse| is_back(&vector(inverse, &state), before))
            {
                // Backward the sides of the guards after the jump say nothing about those before it.
                true if self.0.equations.backward => Reset::Resize { mode, state },
                true => Reset::Jump { mode, state },
                false => Reset::Jump { mode, state: before.filled(|_| f64::NAN) },
            }
        }))
    }

    /// Backward a start is often the end of a run forward.
    fn start_error(&self, surface: Label, start: &X) -> Option<f64> {
        if !self.0.equations.backward {
            return None;
        }
        let guard = self.guard(surface)?;
        let around = |x: &f64| {
            let error = START_ERROR * (1.0 + x.abs());
            Enclosure::new(x - error, x + error)
        };
        let state: SmallVec<[Enclosure; 8]> = start.components().iter().map(around).collect();
        Some(guard.function.enclosures(Enclosure::ZERO, &state).ok()?.first()?.width())
    }

    fn observes(&self, surface: Label) -> Option<bool> {
        Some(self.guard(surface)?.jump.as_ref().is_some_and(|jump| *jump == Jump::default()))
    }

    /// Without a value it is NaN, which the execution reports.
    fn condition(&self, mode: Label, surface: Label, before: &X) -> Option<f64> {
        let condition = self.0.mode(mode)?.of_surface(surface)?.condition.as_ref()?;
        Some(condition.first_value(0.0, before.components()))
    }

    fn reset_error(
        &self,
        mode: Label,
        surface: Option<Label>,
        before: &X,
        time: f64,
    ) -> Option<Error> {
        let mode = self.0.mode(mode)?;
        let jump = match surface {
            Some(surface) => mode.of_surface(surface)?.jump.as_ref()?,
            None => mode.after_limit.as_ref()?,
        };
        let state = jump.state.as_ref()?;
        if let Err(error) = state.values(0.0, before.components()) {
            return Some(error.later(time).into());
        }
        let (after, inverse) = (vector(state, before), jump.inverse.as_ref()?);
        let back = vector(inverse, &after);
        let reason = wrong_inverse(surface, time, [before, &after, &back]);
        (!is_back(&back, before)).then_some(Error::Model { reason })
    }

    fn next_time(&self, mode: Label, surface: Label, after: f64) -> Option<Option<f64>> {
        let clocks = &self.0.mode(mode)?.clocks;
        let (_, times) = clocks.iter().find(|(clock, _)| clock.surface == surface)?;
        Some(times.next_after(after))
    }

    fn rest(&self, mode: Label, limit: &X) -> Option<(Label, X)> {
        let jump = self.0.mode(mode)?.after_limit.as_ref()?;
        Some(after(jump, mode, limit))
    }

    fn other_value(&self, surface: Label, state: &X, value: f64) -> Option<f64> {
        let guards = self.0.modes.iter().flat_map(|mode| &mode.guards);
        let mut values = guards
            .filter(|guard| guard.surface == surface)
            .map(|guard| guard.function.first_value(0.0, state.components()));
        values.find(|own: &f64| *own != value && !(own.is_nan() && value.is_nan()))
    }
}
