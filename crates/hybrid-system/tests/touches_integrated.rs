//! Touches, jumps, narrow bumps and regions without values along integrated flows.

#![cfg(feature = "ode")]
#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::*;
use nalgebra::Vector2;

/// A turning pointer: x₀ = sin(t + a), x₁ = cos(t + a), sin a = 0.6.
struct Watched<G> {
    guards: [Guard<usize>; 1],
    guard: G,
    tolerances: Tolerances,
    /// An event ends the execution.
    terminal: bool,
}

impl<G: Fn(&State<2>) -> f64> HybridSystem for Watched<G> {
    type State = State<2>;
    type Mode = ();
    type Surface = usize;
    fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, self.tolerances)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -x[0]))
    }
    fn guards(&self, (): ()) -> &[Guard<usize>] {
        &self.guards
    }
    fn guard_value(&self, _: usize, x: &State<2>) -> f64 {
        (self.guard)(x)
    }
    fn reset(&self, (): (), _: usize, x: &State<2>) -> Reset<(), State<2>> {
        if self.terminal { Reset::Stop } else { Reset::Jump { mode: (), state: *x } }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<usize>,
    ) -> Result<NextEvent<usize, State<2>>, Error> {
        integrated_crossing(self, mode, x, search, self.tolerances)
    }
}

fn watched<G: Fn(&State<2>) -> f64>(guard: G, touch: Touch) -> Watched<G> {
    Watched {
        guards: [Guard::either(0).observer().touch(touch)],
        guard,
        tolerances: Tolerances::both(1e-12),
        terminal: false,
    }
}

/// Times and kinds of the events from (0.6, 0.8), where sin t = 0.6 at the start, up to `end`.
fn events<G: Fn(&State<2>) -> f64>(
    system: &Watched<G>,
    end: f64,
) -> Result<Vec<(f64, f64, EventKind)>, Error> {
    let start = Vector2::new(0.6, 0.8);
    Execution::new(system, (), start, Limits::new(end, 1000))
        .filter_map(|arc| match arc.map(|arc| arc.event().cloned()) {
            Ok(Some(event)) => Some(Ok((event.time, event.time_error, event.kind))),
            Ok(None) => None,
            Err(error) => Some(Err(error)),
        })
        .collect()
}

/// x₀ = sin(t + a) reaches 1 at π/2 − a + 2πk: three times up to 15.
#[test]
fn the_execution_goes_on_behind_touches() {
    let top = |k: f64| std::f64::consts::FRAC_PI_2 - 0.6f64.asin() + k * std::f64::consts::TAU;
    // The square of the distance of the speed from zero, and one crossing after the touches.
    let guard = |x: &State<2>| x[1] * x[1];
    let found = events(&watched(guard, Touch::Event), 15.0).unwrap();
    // The speed is zero twice in each turn.
    assert_eq!(found.len(), 5, "{found:?}");
    for (k, (time, error, kind)) in found.into_iter().enumerate() {
        assert_eq!(kind, EventKind::Touch);
        assert!((time - top(0.5 * k as f64)).abs() <= error && error < 1e-4, "{k}: {time} {error}");
    }
    assert_eq!(events(&watched(guard, Touch::Ignore), 15.0), Ok(Vec::new()));
    let failed = events(&watched(guard, Touch::Error), 15.0);
    assert!(matches!(failed, Err(Error::Grazing { .. })), "{failed:?}");
    // Crossings behind ignored touches are found: (v²)(x + ½).
    let product = |x: &State<2>| x[1] * x[1] * (x[0] + 0.5);
    let found = events(&watched(product, Touch::Ignore), 5.0).unwrap();
    let first = std::f64::consts::PI + 0.5f64.asin() - 0.6f64.asin();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].0 - first).abs() <= found[0].1.max(1e-11), "{found:?} {first}");
}

/// The cube of the speed.
#[test]
fn triple_roots_are_crossings() {
    let found = events(&watched(|x| x[1] * x[1] * x[1], Touch::Error), 15.0).unwrap();
    assert_eq!(found.len(), 5, "{found:?}");
    for (k, (time, error, kind)) in found.into_iter().enumerate() {
        let exact = std::f64::consts::FRAC_PI_2 - 0.6f64.asin() + k as f64 * std::f64::consts::PI;
        assert_eq!(kind, EventKind::Crossing);
        assert!((time - exact).abs() <= error, "{k}: {time} {exact} {error}");
    }
}

/// A guard that jumps from −1 to 2 where the speed changes its sign.
#[test]
fn jumps_are_located() {
    let found = events(&watched(|x| if x[1] > 0.0 { -1.0 } else { 2.0 }, Touch::Error), 8.0);
    let found = found.unwrap();
    assert_eq!(found.len(), 3, "{found:?}");
    for (k, (time, _, kind)) in found.into_iter().enumerate() {
        let exact = std::f64::consts::FRAC_PI_2 - 0.6f64.asin() + k as f64 * std::f64::consts::PI;
        assert!(kind == EventKind::Crossing && (time - exact).abs() < 1e-10, "{time} {exact}");
    }
}

/// A guard that has no value behind the terminal event.
#[test]
fn a_guard_without_values_behind_a_terminal_event_is_found() {
    // √(x + ½ + 0.001) − √0.001 is zero at x = −½, and has no value a little later.
    let guard = |x: &State<2>| (x[0] + 0.501).sqrt() - 0.001f64.sqrt();
    let mut system = watched(guard, Touch::Error);
    system.terminal = true;
    system.guards = [Guard::falling(0)];
    let found = events(&system, 50.0).unwrap();
    let exact = std::f64::consts::PI + 0.5f64.asin() - 0.6f64.asin();
    assert_eq!(found.len(), 1);
    assert!((found[0].0 - exact).abs() <= found[0].1.max(1e-11), "{found:?} {exact}");
}

/// A clock, ẋ = 1, whose steps grow without limit, and a bump of width 0.1 at 37.3.
#[test]
fn a_check_interval_finds_a_narrow_bump_between_long_steps() {
    struct Bump(Tolerances);
    impl HybridSystem for Bump {
        type State = State<2>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
            integrated_flow(self, mode, x, t, self.0)
        }
        fn vector_field(&self, (): (), _: &State<2>) -> Option<State<2>> {
            Some(Vector2::new(1.0, 0.0))
        }
        fn guards(&self, (): ()) -> &[Guard<()>] {
            const { &[Guard::rising(())] }
        }
        fn guard_value(&self, (): (), x: &State<2>) -> f64 {
            // Positive on (37.25, 37.35).
            (0.05 - (x[0] - 37.3).abs()).max(-1.0)
        }
        fn reset(&self, (): (), (): (), _: &State<2>) -> Reset<(), State<2>> {
            Reset::Stop
        }
        fn first_crossing(
            &self,
            mode: (),
            x: &State<2>,
            search: &Search<()>,
        ) -> Result<NextEvent<(), State<2>>, Error> {
            integrated_crossing(self, mode, x, search, self.0)
        }
    }
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let system = Bump(Tolerances::both(tolerance).check_interval(0.05));
        let mut execution = Execution::new(&system, (), Vector2::zeros(), Limits::new(100.0, 10));
        let last = execution.by_ref().last().unwrap().unwrap();
        let event = last.event().unwrap();
        assert!((event.time - 37.25).abs() <= event.time_error.max(1e-12), "{event:?}");
    }
}

/// x₀ = 0.6 cos t + 0.8 sin t is zero at π − arctan ¾. The limit on time lies within the error of the event, or on it.
#[test]
fn an_event_within_its_error_of_the_limit_is_flagged_at_all_tolerances() {
    for exponent in 6..=13 {
        let mut system = watched(|x| x[0], Touch::Error);
        system.guards = [Guard::falling(0)];
        system.terminal = true;
        system.tolerances = Tolerances::both(10f64.powi(-exponent));
        let (time, error, _) = events(&system, 10.0).unwrap()[0];
        for part in [-0.5, 0.0, 0.5] {
            let limits = Limits::new(time + part * error, 10);
            let start = Vector2::new(0.6, 0.8);
            let last = Execution::new(&system, (), start, limits).last().unwrap().unwrap();
            let flagged = last.event().is_some_and(|event| event.at_time_limit);
            assert!(flagged, "{exponent} {part}: {last:?}");
        }
    }
}
