//! Two integrated modes on both sides of a surface, for tests.

#![allow(dead_code)] // each test uses a part

use hybrid_system::*;

pub(crate) const TIGHT: Tolerances = Tolerances::both(1e-12);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Below,
    Above,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Surface {
    /// The surface between both sides.
    Switch,
    /// A plane that only watches.
    Section,
}

pub(crate) type Field<const N: usize> = fn(&State<N>) -> State<N>;

/// A system with a field on each side of a surface, all integrated.
pub(crate) struct TwoSided<const N: usize> {
    pub(crate) below: Field<N>,
    pub(crate) above: Field<N>,
    pub(crate) guard: fn(&State<N>) -> f64,
    /// The switch happens at guard = ±band: a hysteresis.
    pub(crate) band: f64,
    pub(crate) section: Option<fn(&State<N>) -> f64>,
}

impl<const N: usize> TwoSided<N> {
    pub(crate) fn new(below: Field<N>, above: Field<N>, guard: fn(&State<N>) -> f64) -> Self {
        TwoSided { below, above, guard, band: 0.0, section: None }
    }
}

impl<const N: usize> HybridSystem for TwoSided<N> {
    type State = State<N>;
    type Mode = Side;
    type Surface = Surface;
    fn flow(&self, side: Side, x: &State<N>, t: f64) -> State<N> {
        integrated_flow(self, side, x, t, TIGHT)
    }
    fn guards(&self, side: Side) -> &[Guard<Surface>] {
        use Surface::{Section, Switch};
        match (side, self.section.is_some()) {
            (Side::Below, false) => const { &[Guard::rising(Switch)] },
            (Side::Above, false) => const { &[Guard::falling(Switch)] },
            (Side::Below, true) => {
                const { &[Guard::rising(Switch), Guard::rising(Section).crossing()] }
            }
            (Side::Above, true) => {
                const { &[Guard::falling(Switch), Guard::rising(Section).crossing()] }
            }
        }
    }
    fn guard_value(&self, surface: Surface, x: &State<N>) -> f64 {
        match (surface, self.section) {
            (Surface::Section, Some(section)) => section(x),
            _ => (self.guard)(x),
        }
    }
    fn reset(&self, side: Side, surface: Surface, x: &State<N>) -> Reset<Side, State<N>> {
        let mode = match (surface, side) {
            (Surface::Section, side) => side,
            (Surface::Switch, Side::Below) => Side::Above,
            (Surface::Switch, Side::Above) => Side::Below,
        };
        Reset::Jump { mode, state: *x }
    }
    fn vector_field(&self, side: Side, x: &State<N>) -> Option<State<N>> {
        Some(if side == Side::Below { (self.below)(x) } else { (self.above)(x) })
    }
    fn first_crossing(
        &self,
        side: Side,
        x: &State<N>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<N>>, Error> {
        integrated_crossing(self, side, x, search, TIGHT)
    }
}

pub(crate) type ModelArc<T> =
    Arc<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>;

pub(crate) fn run<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    start: T::State,
    limits: Limits,
) -> Result<(Vec<ModelArc<T>>, Option<Stop>), Error> {
    let mut execution = Execution::new(system, mode, start, limits);
    let mut arcs = Vec::new();
    for arc in execution.by_ref() {
        arcs.push(arc?);
    }
    Ok((arcs, execution.stop()))
}

/// Arcs during which time passes: the events that lead into and out of sliding take none.
pub(crate) fn lasting<M: Copy, S: Copy, X: Clone>(arcs: &[Arc<M, S, X>]) -> Vec<&Arc<M, S, X>> {
    arcs.iter().filter(|arc| arc.duration > 0.0).collect()
}

pub(crate) const fn is_sliding<M, S>(mode: &FilippovMode<M, S>) -> bool {
    matches!(mode, FilippovMode::Sliding { .. })
}

pub(crate) const BELOW: FilippovMode<Side, Surface> = FilippovMode::Free(Side::Below);
pub(crate) const ABOVE: FilippovMode<Side, Surface> = FilippovMode::Free(Side::Above);
