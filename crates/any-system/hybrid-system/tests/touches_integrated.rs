//! Touches, jumps, narrow bumps and regions without values along integrated flows.

#![cfg(feature = "ode")]

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
        guards: [Guard::either(0).crossing().touch(touch)],
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

/// x₀ = 0.6 cos t + 0.8 sin t is zero at π − arctan ¾. The limit on time lies within the error of the event, or on
/// it: the computed event up to the limit is flagged, and one after it is none.
#[test]
fn an_event_up_to_the_limit_is_flagged_at_all_tolerances() {
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
            let flagged = last.event().map(|event| event.at_time_limit);
            let expected = (part >= 0.0).then_some(true);
            assert_eq!(flagged, expected, "{exponent} {part}: {last:?}");
        }
    }
}

/// A ball rests on the floor, or is held, until t = 2. Then something presses it downwards. State: height,
/// velocity, time.
#[test]
fn a_guard_that_rests_on_its_surface_and_is_pushed_beyond_it_later_is_not_lost() {
    let pressed = |(), x: &State<3>| [x[1], -(x[2] - 2.0).max(0.0), 1.0];
    for start in [[0.0, 0.0, 0.0], [0.0, 0.0, 1.5]] {
        let ball = Model::integrated(pressed).falling((), |x| x[0], |x| ((), [x[0], -x[1], x[2]]));
        let end = ball.run((), start, 5.0).collect::<Result<Vec<_>, _>>();
        let error = end.unwrap_err();
        assert!(matches!(error, Error::UndecidedStart { .. }), "{error}");
        let sampled = Model::closed_form(|(), x: &State<3>, t| {
            let late = (x[2] + t - 2.0).max(0.0);
            [x[0] - late * late * late / 6.0, x[1], x[2] + t]
        })
        .falling((), |x| x[0], |x| ((), [x[0], -x[1], x[2]]))
        .sampled(0.01);
        let error = sampled.run((), start, 5.0).collect::<Result<Vec<_>, _>>().unwrap_err();
        assert!(matches!(error, Error::UndecidedStart { .. }), "{error}");
    }
}

/// A guard that falls to zero at t = 1, stays there, and falls on later: each time in between may be the crossing.
/// The event is where it leaves, because a start on the stretch of zeros would be no event.
#[test]
fn a_stretch_of_zeros_is_crossed_at_its_end() {
    for width in [0.1, 0.5, 1.0, 2.0] {
        let guard = move |x: &State<1>| (1.0 - x[0]).max(0.0) + (1.0 + width - x[0]).min(0.0);
        let falling = Guard::falling(());
        let integrated = Model::integrated(|(), _: &State<1>| [1.0]).terminal((), falling, guard);
        let sampled = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
            .terminal((), falling, guard)
            .sampled(0.03);
        let events = [
            integrated.run((), [0.0], 50.0).next().unwrap().unwrap(),
            sampled.run((), [0.0], 50.0).next().unwrap().unwrap(),
        ];
        for arc in events {
            let event = arc.event().unwrap();
            assert!((event.time - (1.0 + width)).abs() < 1e-7, "{width}: {event:?}");
            // Up to the start of the stretch. Where a step begins on it, the error is a step of the integration.
            assert!(event.time - event.time_error <= 1.0, "{width}: {event:?}");
            assert!(event.time_error < 5.0, "{width}: {event:?}");
        }
    }
}
