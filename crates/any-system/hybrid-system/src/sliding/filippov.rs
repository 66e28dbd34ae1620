//! A system that slides along its surfaces, by Filippov's convention.

use super::detection::rounding;
use super::directional::slope_along;
use super::filippov_modes::{FilippovMode, FilippovSurface};
use super::projection::onto_surface;
use super::sliding_field::sliding_field;
use crate::crossing::guard_rounding;
use crate::guard_table::GuardTable;
use crate::ode::Tolerances;
use crate::state::StateVector;
use crate::system::HybridSystem;

/// ∇g of a surface of the model, at a state.
type Gradient<T> =
    fn(&T, <T as HybridSystem>::Surface, &<T as HybridSystem>::State) -> <T as HybridSystem>::State;

/// A system that goes on along a surface at which the fields of both sides point, by Filippov's convention: with
/// the mean of both fields that is tangent to the surface.
///
/// The modes are [`FilippovMode::Free`](crate::FilippovMode::Free), the modes of the model, and
/// [`FilippovMode::Sliding`](crate::FilippovMode::Sliding). A sliding mode ends where the field of one side turns
/// tangent, a [`FilippovSurface::Tangent`](crate::FilippovSurface::Tangent), and at the other surfaces of both
/// sides. [Filippov's convention](crate::sliding_motion) has the mathematics.
///
/// Where the model has a [mode of its own](HybridSystem::slide) for a surface, the execution goes on in that one.
///
/// The model must give its [fields](HybridSystem::vector_field). Its free modes may be integrated or in closed
/// form. The sliding motion is integrated with the tolerances of this type.
///
/// Dry friction: a mass on a spring, on a belt of speed 1, which pulls with a force of at most 2.
///
/// ```
/// use hybrid_system::*;
///
/// #[derive(Debug, Clone, Copy, PartialEq, Eq)]
/// enum Mass { Slower, Faster }
///
/// let belt = Model::integrated(|mass, x: &State<2>| match mass {
///     Mass::Slower => [x[1], -x[0] + 2.0],
///     Mass::Faster => [x[1], -x[0] - 2.0],
/// })
/// .rising(Mass::Slower, |x| x[1] - 1.0, |x| (Mass::Faster, *x))
/// .falling(Mass::Faster, |x| x[1] - 1.0, |x| (Mass::Slower, *x));
/// let belt = Filippov::new(belt, Tolerances::both(1e-12));
///
/// let start = (FilippovMode::Free(Mass::Slower), State::<2>::new(-1.0, 0.0));
/// let arcs: Vec<_> =
///     Execution::new(&belt, start.0, start.1, Limits::new(9.0, 20)).collect::<Result<_, _>>()?;
/// let stick = arcs
///     .iter()
///     .find(|arc| matches!(arc.mode, FilippovMode::Sliding { .. }))
///     .expect("the mass sticks to the belt");
/// // The spring lets the mass go where its force is 2.
/// let release = stick.event().expect("a release");
/// assert!((release.before[0] - 2.0).abs() < 1e-12);
/// assert!((stick.duration - (2.0 - stick.start[0])).abs() < 1e-12);
/// # Ok::<(), Error>(())
/// ```
///
/// # Accuracy
/// The states that `flow` and events return are on the surface, within the rounding of its guard. Inside an
/// integration they may be off it by some errors of the steps: the integrated field leads back to the surface. At
/// an exit the free mode starts on the surface, with a rate that is zero within the errors; the next derivative
/// decides that it leaves.
///
/// # Degenerate cases
/// Where two sliding surfaces meet the convention gives no unique field: the execution ends there, in
/// [`ArcEnd::Sliding`](crate::ArcEnd::Sliding) with `after: None`. Where both fields turn tangent together, or the
/// resets of both sides disagree, the search returns [`Error::SlidingNotUnique`](crate::Error::SlidingNotUnique). A
/// model whose fields point away from the surface on both sides flows in the mode in which it starts.
pub struct Filippov<T: HybridSystem> {
    pub(super) system: T,
    pub(super) tolerances: Tolerances,
    gradient: Option<Gradient<T>>,
    pub(super) follows: bool,
    pub(super) guards: FilippovGuards<T::Mode, T::Surface>,
}

/// The guards of the modes.
type FilippovGuards<M, S> = GuardTable<FilippovMode<M, S>, FilippovSurface<M, S>>;

/// The surface along which a state slides, and the modes on both sides.
pub(super) struct Sides<M, S> {
    pub(super) surface: S,
    pub(super) below: M,
    pub(super) above: M,
}

/// The distance of a state from a surface: the value of the guard, and the largest one that counts as zero.
pub(super) struct OffSurface {
    pub(super) value: f64,
    pub(super) largest: f64,
}

/// A state is on a surface if the guard is zero within the change of the state by this multiple of the
/// tolerances of the flow: nearer to the surface than the flow itself is known. Resets and sums of the model add errors
/// to those of one step. A larger number would project starts that are visibly beside the surface.
const START_TOLERANCES: f64 = 100.0;

/// The fields on both sides of a surface, and the rates of the guard along them.
pub(super) struct Fields<X> {
    pub(super) below: X,
    pub(super) above: X,
    pub(super) rates: (f64, f64),
}

impl<T: HybridSystem> Filippov<T> {
    /// The system with sliding modes, integrated to these tolerances.
    ///
    /// The rates ∇g·f are computed by differences of order eight: exact to rounding for linear and quadratic
    /// guards, and to about 10⁻¹⁴ for guards that change over distances of the size of the state.
    pub const fn new(system: T, tolerances: Tolerances) -> Self {
        Filippov { system, tolerances, gradient: None, follows: true, guards: GuardTable::new() }
    }

    /// Whether executions go on along surfaces, as they do unless this is false. A program whose users choose has
    /// one type for both: without it an execution ends where it would slide, as an execution of the model does.
    #[must_use]
    pub const fn following(mut self, follows: bool) -> Self {
        self.follows = follows;
        self
    }

    /// The same with ∇g from a function, for guards that the differences do not resolve, and faster.
    #[must_use]
    pub fn with_gradient(mut self, gradient: Gradient<T>) -> Self {
        self.gradient = Some(gradient);
        self
    }

    /// The model.
    pub fn system(&self) -> &T {
        &self.system
    }

    /// The tolerances of the sliding motion.
    pub(crate) const fn tolerances(&self) -> Tolerances {
        self.tolerances
    }

    /// The field of a mode, as a formula of the state. The field that is integrated along a surface leads back to it.
    pub(crate) fn field_without_projection(
        &self,
        mode: FilippovMode<T::Mode, T::Surface>,
        state: &T::State,
    ) -> Option<T::State> {
        match mode {
            FilippovMode::Free(mode) => self.system.vector_field(mode, state),
            FilippovMode::Sliding { surface, below, above, .. } => {
                self.field_at(&Sides { surface, below, above }, state)
            }
        }
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
                slope_along(&guard, state, field, self.rounding(surface, state)).value
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
        rounding(&self.system, surface, state)
    }

    /// An error unless the state is on the surface, as far as the tolerances of the flow tell.
    pub(super) fn check_on_surface(
        &self,
        surface: T::Surface,
        state: &T::State,
    ) -> Result<(), OffSurface> {
        let guard = |state: &T::State| self.system.guard_value(surface, state);
        let largest = self.error_of_flow(surface, state, START_TOLERANCES);
        let value = guard(state);
        if value.abs() <= largest { Ok(()) } else { Err(OffSurface { value, largest }) }
    }

    /// The change of a guard of the model if the state changes by this multiple of the tolerances of the flow.
    pub(super) fn error_of_flow(
        &self,
        surface: T::Surface,
        state: &T::State,
        multiple: f64,
    ) -> f64 {
        // In units of the roundings that `guard_rounding` applies to components.
        let size = state.filled(|axis| {
            let component = state.components()[axis].abs();
            multiple * self.tolerances.of(axis, component) / f64::EPSILON
        });
        guard_rounding(state, &size, &|state| self.system.guard_value(surface, state))
    }

    /// The point of the surface next to `state` along f⁺ − f⁻, as far as the rounding of the guard allows.
    pub(super) fn on_surface(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: T::State,
    ) -> T::State {
        let guard = |state: &T::State| self.system.guard_value(sides.surface, state);
        if guard(&state) == 0.0 {
            return state;
        }
        match self.fields(sides, &state) {
            Some(Fields { below, above, rates }) => {
                onto_surface(state, (&below, &above), rates, guard)
            }
            None => state,
        }
    }

    /// The field that is integrated: the sliding field at the point P(x) of the surface next to x, and a return to it,
    ///
    /// ```text
    ///   f_s(P(x)) + κ (P(x) − x)      κ = |f_s|/(1 + |x|)
    /// ```
    ///
    /// Off the surface the convention defines no field. Without the second term the distance δ from the surface
    /// would grow with the errors of the steps. On a curved surface it would change the speed along the surface by
    /// a part δ. With it the distance stays at a few errors of a step. κ is the inverse of the time in which the
    /// state changes by its own size: a larger one would make the field stiff, a smaller one would return more
    /// slowly than the state moves.
    pub(super) fn integrated_field(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: &T::State,
    ) -> Option<T::State> {
        let value = self.system.guard_value(sides.surface, state);
        if value.abs() <= self.rounding(sides.surface, state) {
            return self.field_at(sides, state);
        }
        let on = self.on_surface(sides, state.clone());
        let mut field = self.field_at(sides, &on)?;
        let rate = field.largest() / (1.0 + state.largest());
        field.add_scaled(rate, &on);
        field.add_scaled(-rate, state);
        Some(field)
    }

    /// The sliding field at a point of the surface.
    pub(super) fn field_at(
        &self,
        sides: &Sides<T::Mode, T::Surface>,
        state: &T::State,
    ) -> Option<T::State> {
        let Fields { below, above, rates } = self.fields(sides, state)?;
        Some(sliding_field((&below, &above), rates))
    }
}
