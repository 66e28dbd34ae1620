//! A system that slides along its surfaces, by Filippov's convention.

use super::directional::slope_along;
use super::filippov_modes::GuardTable;
use super::rates::sizes;
use super::sliding_field::{onto_surface, sliding_field};
use crate::crossing::guard_rounding;
use crate::ode::Tolerances;
use crate::state::StateVector;
use crate::system::HybridSystem;

/// ∇g of a surface of the model.
type Gradient<T> =
    fn(&T, <T as HybridSystem>::Surface, &<T as HybridSystem>::State) -> <T as HybridSystem>::State;

pub struct Filippov<T: HybridSystem> {
    pub(super) system: T,
    pub(super) tolerances: Tolerances,
    gradient: Option<Gradient<T>>,
    pub(super) guards: GuardTable<T::Mode, T::Surface>,
}

/// The surface along which a state slides, and the modes on both sides.
pub(super) struct Sides<M, S> {
    pub(super) surface: S,
    pub(super) below: M,
    pub(super) above: M,
}

/// The fields on both sides of a surface, and the rates of the guard along them.
pub(super) struct Fields<X> {
    pub(super) below: X,
    pub(super) above: X,
    pub(super) rates: (f64, f64),
}

impl<T: HybridSystem> Filippov<T> {
    pub const fn new(system: T, tolerances: Tolerances) -> Self {
        Filippov { system, tolerances, gradient: None, guards: GuardTable::new() }
    }

    #[must_use]
    pub fn with_gradient(mut self, gradient: Gradient<T>) -> Self {
        self.gradient = Some(gradient);
        self
    }

    pub fn system(&self) -> &T {
        &self.system
    }

    /// ∇g·f.
    pub(super) fn rate(&self, surface: T::Surface, state: &T::State, field: &T::State) -> f64 {
        match self.gradient {
            Some(gradient) => {
                let gradient = gradient(&self.system, surface, state);
                let products = gradient.components().iter().zip(field.components());
                products.map(|(g, f)| g * f).sum()
            }
            None => {
                let guard = |state: &T::State| self.system.guard_value(surface, state);
                slope_along(guard, state, field, 0.0).value
            }
        }
    }

    /// The fields and rates on both sides; `None` if the model gives no field.
    pub(super) fn fields(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: &T::State,
    ) -> Option<Fields<T::State>> {
        let below = self.system.vector_field(sides.below, state)?;
        let above = self.system.vector_field(sides.above, state)?;
        let rate = |field| self.rate(sides.surface, state, field);
        let rates = (rate(&below), rate(&above));
        Some(Fields { below, above, rates })
    }

    /// The rounding error of a guard of the model at a state.
    pub(super) fn rounding(&self, surface: T::Surface, state: &T::State) -> f64 {
        let guard = |state: &T::State| self.system.guard_value(surface, state);
        guard_rounding(state, &sizes(state), guard)
            + self.system.guard_error(surface, state).unwrap_or_default()
    }

    /// The state on the surface, along f⁺ − f⁻. A state within rounding of the surface keeps its bits.
    pub(super) fn on_surface(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: T::State,
    ) -> T::State {
        let guard = |state: &T::State| self.system.guard_value(sides.surface, state);
        if guard(&state).abs() <= self.rounding(sides.surface, &state) {
            return state;
        }
        match self.fields(sides, &state) {
            Some(Fields { below, above, rates }) => {
                onto_surface(state, (&below, &above), rates, guard).0
            }
            None => state,
        }
    }

    /// The sliding field at the point of the surface next to `state`.
    ///
    /// Off the surface the convention defines no field. With this one the errors of an integration across the surface
    /// change nothing: they are neither fed back nor amplified.
    pub(super) fn field_on_surface(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: &T::State,
    ) -> Option<T::State> {
        let on = self.on_surface(sides, state.clone());
        let Fields { below, above, rates } = self.fields(sides, &on)?;
        Some(sliding_field((&below, &above), rates))
    }
}
