//! Executions with integrated modes allocate no memory, with and without events.

#![cfg(feature = "ode")]
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use hybrid_system::*;
use nalgebra::Vector2;

/// A ball with air drag.
struct Ball;

const TOLERANCES: Tolerances = Tolerances::both(1e-10);

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, TOLERANCES)
    }
    fn guards(&self, (): ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, (): (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, 1.0 - x[1]) }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        integrated_crossing(self, mode, x, search, TOLERANCES)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -1.0 - 0.1 * x[1] * x[1].abs()))
    }
}

#[test]
fn an_integrated_execution_allocates_nothing() {
    let bounces = || {
        Execution::new(&Ball, (), Vector2::new(1.0, 0.0), Limits::new(1000.0, 20))
            .filter(|arc| arc.as_ref().unwrap().event().is_some())
            .count()
    };
    // The first run builds the tables of the schemes, which allocates.
    assert_eq!(bounces(), 20);
    let info = allocation_counter::measure(|| assert_eq!(bounces(), 20));
    assert_eq!(info.count_total, 0, "{info:?}");
}

#[test]
fn a_model_of_closures_allocates_only_when_it_is_built() {
    let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0 - 0.1 * x[1] * x[1].abs()])
        .falling((), |x| x[0], |x| ((), [0.0, 1.0 - x[1]]));
    let sampled = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], |x| ((), [0.0, -x[1]]));
    let start = Vector2::new(1.0, 0.0);
    let bounces = || {
        Execution::new(&ball, (), start, Limits::new(1000.0, 20))
            .filter(|arc| arc.as_ref().unwrap().event().is_some())
            .count()
    };
    // The first run builds the tables of the schemes, which allocates.
    assert_eq!(bounces(), 20);
    let info = allocation_counter::measure(|| assert_eq!(bounces(), 20));
    assert_eq!(info.count_total, 0, "{info:?}");
    // A sampled search allocates its list of guards, for every model alike.
    let limits = Limits::sampled(1000.0, 20, 0.1);
    let by_trait = allocation_counter::measure(|| {
        assert_eq!(Execution::new(&Sampled, (), start, limits).count(), 20);
    });
    let by_closures = allocation_counter::measure(|| {
        assert_eq!(Execution::new(&sampled, (), start, limits).count(), 20);
    });
    assert_eq!(by_closures.count_total, by_trait.count_total);
}

/// The same ball by the trait.
struct Sampled;

impl HybridSystem for Sampled {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
    }
    fn guards(&self, (): ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, (): (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, -x[1]) }
    }
}
