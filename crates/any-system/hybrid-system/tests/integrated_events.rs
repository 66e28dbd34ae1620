//! Events along integrated flows: each is found once, without a limit on the size of steps. The names of tests give the
//! source of a case.

#![cfg(feature = "ode")]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hybrid_system::*;
use nalgebra::{Vector1, Vector2, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

const TIGHT: Tolerances = Tolerances::both(1e-13);

/// A flow ẋ = f(x) with functions of the state as guards. Events do not change the state.
struct Watched<'a, F, G, const N: usize> {
    field: F,
    values: G,
    guards: &'a [Guard<usize>],
    tolerances: Tolerances,
}

impl<F, G, const N: usize> HybridSystem for Watched<'_, F, G, N>
where
    F: Fn(&State<N>) -> State<N>,
    G: Fn(usize, &State<N>) -> f64,
{
    type State = State<N>;
    type Mode = ();
    type Surface = usize;
    fn vector_field(&self, _: (), x: &State<N>) -> Option<State<N>> {
        Some((self.field)(x))
    }
    fn flow(&self, mode: (), x: &State<N>, t: f64) -> State<N> {
        integrated_flow(self, mode, x, t, self.tolerances)
    }
    fn guards(&self, _: ()) -> &[Guard<usize>] {
        self.guards
    }
    fn guard_value(&self, surface: usize, x: &State<N>) -> f64 {
        (self.values)(surface, x)
    }
    fn reset(&self, _: (), _: usize, x: &State<N>) -> Reset<(), State<N>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<N>,
        search: &Search<usize>,
    ) -> Result<NextEvent<usize, State<N>>, Error> {
        integrated_crossing(self, mode, x, search, self.tolerances)
    }
}

/// All events up to `time`.
fn events<T: HybridSystem<State = State<N>, Mode = (), Surface = usize>, const N: usize>(
    system: &T,
    start: State<N>,
    time: f64,
) -> Vec<Event<(), usize, State<N>>> {
    Execution::new(system, (), start, Limits::new(time, 1000))
        .filter_map(|arc| arc.unwrap().event().copied())
        .collect()
}

/// y₁ = t/(t+10), y₂ = 10t/(t+10)² from t = 5; two guards with powers of the state.
#[test]
fn both_events_of_the_test_suite_of_scipy_are_found() {
    let field = |x: &State<3>| {
        let [t, y1, y2] = [x[0], x[1], x[2]];
        Vector3::new(1.0, y2 / t, y2 * (y1 + 2.0 * y2 - 1.0) / (t * (y1 - 1.0)))
    };
    let values = |surface: usize, x: &State<3>| {
        if surface == 0 { x[1] - x[2].powf(0.7) } else { x[2].powf(0.6) - x[1] }
    };
    let guards = [Guard::rising(0).crossing(), Guard::falling(1).crossing()];
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    let start = Vector3::new(5.0, 1.0 / 3.0, 2.0 / 9.0);
    let found = events(&system, start, 3.0);
    let times: Vec<_> = found.iter().map(|event| (event.surface, 5.0 + event.time)).collect();
    assert_eq!(times.len(), 2, "{times:?}");
    assert_eq!((times[0].0, times[1].0), (0, 1));
    assert!((times[0].1 - 5.55057576624077608).abs() < 1e-12, "{times:?}");
    assert!((times[1].1 - 7.5487766624669276).abs() < 1e-12, "{times:?}");
    assert!(found.iter().all(|event| event.certainty == Certainty::Interpolated));
    // In the opposite direction of each guard there is no event.
    let guards = [Guard::falling(0).crossing(), Guard::rising(1).crossing()];
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    assert!(events(&system, start, 3.0).is_empty());
}

/// The next crossing of z = 27 from above by the Lorenz system, half of a symmetric orbit.
#[test]
fn the_lorenz_system_returns_to_its_section_at_the_known_time() {
    let field = |x: &State<3>| {
        Vector3::new(
            10.0 * (x[1] - x[0]),
            x[0] * (28.0 - x[2]) - x[1],
            x[0] * x[1] - 8.0 / 3.0 * x[2],
        )
    };
    let values = |_: usize, x: &State<3>| x[2] - 27.0;
    let guards = [Guard::falling(0).crossing()];
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    let start = Vector3::new(-2.1473674741633753, 2.0780481172873415, 27.0);
    let found = events(&system, start, 1.0);
    assert_eq!(found.len(), 1, "the start on the section is no return");
    assert!((found[0].time - 0.77932610853932338).abs() < 1e-12, "{}", found[0].time);
    let image = Vector3::new(2.1473675875613338, -2.0780482713004851, 27.0);
    assert!((found[0].before - image).amax() < 2e-12, "{}", found[0].before - image);
}

/// y′ = 3x² + 12x − 4 on (−8, 4): `SciPy` finds one zero of three (issue 9228).
#[test]
fn all_three_zeros_of_scipy_9228_are_found() {
    let field = |x: &State<2>| Vector2::new(1.0, (3.0 * x[0] + 12.0) * x[0] - 4.0);
    let values = |_: usize, x: &State<2>| x[1];
    let guards = [Guard::either(0)];
    for tolerance in [1e-3, 1e-6, 1e-13] {
        let tolerances = Tolerances::both(tolerance);
        let system = Watched { field, values, guards: &guards, tolerances };
        let found = events(&system, Vector2::new(-8.0, -120.0), 12.0);
        assert_eq!(found.len(), 3);
        for (event, zero) in found.iter().zip([-6.0, -2.0, 2.0]) {
            assert!((event.before[0] - zero).abs() < tolerance.max(1e-12), "{event:?}");
        }
    }
}

#[test]
fn the_zeros_of_an_oscillator_are_found() {
    let field = |x: &State<2>| Vector2::new(x[1], -x[0]);
    let values = |_: usize, x: &State<2>| x[0];
    let guards = [Guard::either(0)];
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    let found = events(&system, Vector2::new(1.0, 0.0), 12.0);
    assert_eq!(found.len(), 4);
    for (k, event) in found.iter().enumerate() {
        assert!((event.time - (k as f64 + 0.5) * PI).abs() < 1e-12, "{k}: {}", event.time);
    }
}

/// Roots on and within steps are found once each, whatever the steps and the tolerance.
#[test]
fn each_root_is_found_once_for_every_step_and_tolerance() {
    let field = |_: &State<1>| Vector1::new(1.0);
    let three = |_: usize, x: &State<1>| (x[0] - 0.1) * (x[0] - 0.4) * (x[0] - 0.8);
    let nine =
        |_: usize, x: &State<1>| (1..10).map(|k| x[0] - f64::from(k) / 10.0).product::<f64>();
    let guards = [Guard::either(0)];
    for longest_step in [0.01, 0.1, 0.2, 0.05 + 1e-9, f64::INFINITY] {
        for tolerance in [1e-3, 1e-6, 1e-9, 1e-13] {
            let tolerances = Tolerances { longest_step, ..Tolerances::both(tolerance) };
            let system = Watched { field, values: three, guards: &guards, tolerances };
            let found = events(&system, Vector1::new(0.0), 1.0);
            let at: Vec<_> = found.iter().map(|event| event.before[0]).collect();
            assert_eq!(at.len(), 3, "{longest_step} {tolerance}: {at:?}");
            assert!(at.iter().zip([0.1, 0.4, 0.8]).all(|(x, root)| (x - root).abs() < 1e-14));
            let system = Watched { field, values: nine, guards: &guards, tolerances };
            let found = events(&system, Vector1::new(0.0), 1.0);
            assert_eq!(found.len(), 9, "{longest_step} {tolerance}: {found:?}");
            for (k, event) in (1..).zip(&found) {
                assert!((event.before[0] - f64::from(k) / 10.0).abs() < 1e-12);
            }
        }
    }
}

/// ẋ = 1, and x → x − 2 where x + y ≥ 0: after t = 2 the state is the start again.
#[test]
fn an_integrated_constant_flow_with_jumps_returns_to_its_start() {
    let saw = Model::integrated(|(), _: &State<2>| [1.0, 0.0]).tolerance(1e-13).rising(
        (),
        |x| x[0] + x[1],
        |x| ((), [x[0] - 2.0, x[1]]),
    );
    for start in [[-0.3, 0.1], [-1.9, 0.0], [0.2, -0.7], [-0.1, -1.1]].map(State::from) {
        let arcs: Vec<_> = saw.run((), start, 2.0).collect::<Result<_, _>>().unwrap();
        assert_eq!(arcs.len(), 2);
        let end = arcs[1].state(&saw, arcs[1].duration).unwrap();
        assert!((end - start).amax() < 1e-14, "{end}");
    }
}

/// Two masses on a spring, k = 500, g = 9.8, dropped from heights 5 and 6: the contact lasts 0.146, and the lower mass
/// leaves the floor like t³. The issue reports a crash.
#[test]
fn sciml_647_two_masses_on_a_spring() {
    const STIFFNESS: f64 = 500.0;
    const GRAVITY: f64 = 9.8;
    let masses = Model::integrated(|contact, x: &State<4>| {
        let pull = STIFFNESS * (x[1] - x[0] - 1.0);
        [x[2], x[3], if contact { 0.0 } else { pull - GRAVITY }, -pull - GRAVITY]
    })
    .tolerance(1e-13)
    .guard(false, Guard::falling("landing"), |x| x[0], |x| (true, [0.0, x[1], 0.0, x[3]]))
    .guard(
        true,
        Guard::falling("lift-off").contact(),
        |x| GRAVITY - STIFFNESS * (x[1] - x[0] - 1.0),
        |x| (false, *x),
    )
    .observer(Guard::rising("shortest spring"), |x| x[3] - x[2]);
    let events: Vec<_> = masses
        .run(false, [5.0, 6.0, 0.0, 0.0], 2.2)
        .filter_map(|arc| arc.unwrap().event().copied())
        .collect();
    let named = |name| events.iter().filter(move |event| event.surface == name);
    let landings: Vec<_> = named("landing").collect();
    let lift_offs: Vec<_> = named("lift-off").collect();
    assert_eq!((landings.len(), lift_offs.len()), (2, 2));
    // At the second landing the spring pulls harder than the weight: the lower mass lifts off at once.
    assert_eq!(lift_offs[1].time, landings[1].time);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-10, "{a} {b}");
    close(landings[0].time, 1.01015254455221075);
    close(landings[0].before[2], -9.89949493661166534);
    close(lift_offs[0].time - landings[0].time, 0.146436001872528801);
    close(lift_offs[0].time, 1.15658854642473955);
    close(lift_offs[0].before[1], 1.0196);
    close(lift_offs[0].before[3], 9.8703475116127497);
    close(landings[1].time, 2.15693455833089148);
    close(landings[1].before[2], -9.61984490010233);
    let shortest: Vec<_> =
        named("shortest spring").filter(|event| event.before[0] == 0.0).collect();
    assert_eq!(shortest.len(), 1);
    close(shortest[0].before[1], 0.537247475466967);
    let (_, at_lift_off) = lift_offs[0].after.unwrap();
    let later = masses.flow(false, &at_lift_off, 1e-4);
    assert!((later[0] / 8.22488e-10 - 1.0).abs() < 1e-5, "{:e}", later[0]);
}

/// Without loss: eleven bounces in ten time units, and their last height and velocity.
#[test]
fn the_integrated_elastic_ball_of_drake_ends_in_its_known_state() {
    let ball = Model::integrated(|(), x: &State<2>| [x[1], -9.81]).tolerance(1e-13).falling(
        (),
        |x| x[0],
        |x| ((), [0.0, -x[1]]),
    );
    let arcs: Vec<_> = ball.run((), [1.0, 0.0], 10.0).collect::<Result<_, _>>().unwrap();
    assert_eq!(arcs.len(), 12);
    let end = arcs[11].state(&ball, arcs[11].duration).unwrap();
    let exact = Vector2::new(0.978_321_975_404_438, -0.652_167_802_459_556_2);
    assert!((end - exact).amax() < 1e-11, "{}", end - exact);
}

/// Nine roots, and a parabola that misses, touches or crosses, on ẋ = 1, where each step is ten times as long as the
/// one before.
#[test]
fn roots_and_touches_within_long_steps_are_found() {
    let field = |_: &State<1>| Vector1::new(1.0);
    let product =
        |_: usize, x: &State<1>| (1..10).map(|k| x[0] - f64::from(k) / 10.0).product::<f64>();
    let guards = [Guard::either(0)];
    let system = Watched { field, values: product, guards: &guards, tolerances: TIGHT };
    let found = events(&system, Vector1::new(0.0), 50.0);
    assert_eq!(found.len(), 9);
    for (k, event) in (1..).zip(&found) {
        assert!((event.before[0] - f64::from(k) / 10.0).abs() < 1e-12);
    }
    let touching = |y0: f64| {
        let values = move |_: usize, x: &State<1>| y0 - x[0] * x[0];
        let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
        Execution::new(&system, (), Vector1::new(-1.0), Limits::new(2.0, 1)).next().unwrap()
    };
    assert!(touching(-1e-9).unwrap().event().is_none());
    let Err(Error::Grazing { time, value, .. }) = touching(0.0) else { panic!() };
    assert!((time - 1.0).abs() < 1e-6 && value.abs() < 1e-12);
    let at = touching(1e-12).unwrap().event().unwrap().time;
    assert!((at - 1.0 + 1e-6).abs() < 1e-9, "{at}");
}

/// The guard starts at a zero of order 1 to 4, leaves it, and has one crossing later.
#[test]
fn a_guard_that_starts_at_zero_has_one_later_crossing() {
    let field = |_: &State<1>| Vector1::new(1.0);
    for order in 1..=4 {
        for sign in [1.0, -1.0] {
            let values = |_: usize, x: &State<1>| sign * x[0].powi(order) * (3.0 - x[0]);
            let guards = [Guard::either(0)];
            let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
            let found = events(&system, Vector1::new(0.0), 10.0);
            assert_eq!(found.len(), 1, "{order} {sign}: {found:?}");
            assert!((found[0].time - 3.0).abs() < 1e-13);
        }
    }
}

#[test]
fn each_of_many_guards_with_kinks_or_tiny_values_is_crossed_once() {
    let field = |_: &State<1>| Vector1::new(1.0);
    // |x − 1| − ½ is not smooth at x = 1; the values of 1e-166 (x − 0.37) are tiny.
    let values = |surface: usize, x: &State<1>| match surface {
        0 => (x[0] - 1.0).abs() - 0.5,
        1 => 1e-166 * (x[0] - 0.37),
        k => x[0] - 2.0 - k as f64,
    };
    let guards: Vec<_> = (0..12).map(Guard::either).collect();
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    let found = events(&system, Vector1::new(0.0), 20.0);
    let exact = [0.37, 0.5, 1.5].into_iter().chain((2..12).map(|k| 2.0 + f64::from(k)));
    assert_eq!(found.len(), 13, "{found:?}");
    for (event, exact) in found.iter().zip(exact) {
        assert!((event.time - exact).abs() < 1e-13, "{} {exact}", event.time);
    }
}

#[test]
fn a_flow_that_ends_in_finite_time_is_an_error() {
    let field = |x: &State<1>| Vector1::new(x[0] * x[0]);
    let values = |_: usize, x: &State<1>| x[0] - 1e300;
    let guards = [Guard::rising(0)];
    let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
    let first = Execution::new(&system, (), Vector1::new(1.0), Limits::new(2.0, 1)).next().unwrap();
    assert!(matches!(first, Err(Error::Integration { .. } | Error::StateNotFinite { .. })));
    let arc = Arc {
        mode: (),
        time: 0.0,
        jump: 0,
        start: Vector1::new(1.0),
        duration: 2.0,
        end: ArcEnd::<(), usize, State<1>>::TimeLimit { certainty: Certainty::Exact },
    };
    assert!(matches!(arc.state(&system, 2.0), Err(Error::StateNotFinite { .. })));
    assert!((arc.state(&system, 0.5).unwrap()[0] - 2.0).abs() < 1e-11);
    let nan = |_: usize, _: &State<1>| f64::NAN;
    let system = Watched { field, values: nan, guards: &guards, tolerances: TIGHT };
    let first = Execution::new(&system, (), Vector1::new(1.0), Limits::new(0.5, 1)).next().unwrap();
    assert!(matches!(first, Err(Error::NotFinite { .. })));
}

proptest! {
    /// Random roots, also close together and close to the start: each is found once, in order. Roots that rounding
    /// hides are reported as errors.
    #[test]
    fn planted_roots_are_found_in_order(mut roots in proptest::collection::vec(1e-3..5.0f64, 1..7), twin in -7.5..-3.0f64) {
        let twin = 10f64.powf(twin);
        roots.push(roots[0] + twin);
        roots.push(twin);
        roots.sort_by(f64::total_cmp);
        let field = |_: &State<1>| Vector1::new(1.0);
        let values = |_: usize, x: &State<1>| roots.iter().map(|root| x[0] - root).product::<f64>();
        let guards = [Guard::either(0)];
        let system = Watched { field, values, guards: &guards, tolerances: TIGHT };
        let mut ahead = roots.iter().copied().peekable();
        let mut last = f64::NEG_INFINITY;
        for arc in Execution::new(&system, (), Vector1::new(0.0), Limits::new(6.0, 100)) {
            match arc {
                Ok(arc) => match arc.event() {
                    Some(event) => {
                        let at = event.before[0];
                        // A root next to one that has been found may be within the rounding of the new start.
                        while ahead.next_if(|root| (at - root).abs() > 1e-10 && root - last < 1e-6).is_some() {}
                        last = ahead.next().unwrap();
                        prop_assert!((at - last).abs() < 1e-10, "{} {}", at, last);
                    }
                    None => prop_assert!(ahead.all(|root| root - last < 1e-6)),
                },
                Err(Error::Grazing { value, .. }) => {
                    // Between the closest two roots the guard is this small.
                    prop_assert!(value.abs() < 1e-9, "{}", value);
                    prop_assert!(roots.windows(2).any(|pair| pair[1] - pair[0] < 1e-3) || roots[0] < 1e-3);
                    break;
                }
                Err(Error::UndecidedStart { .. }) => {
                    let next = ahead.next().unwrap();
                    prop_assert!(next - last.max(0.0) < 1e-5, "{} {}", last, next);
                    break;
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
}
