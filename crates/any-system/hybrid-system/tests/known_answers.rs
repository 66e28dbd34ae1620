//! Systems with known solutions: balls, oscillators, polynomials. The names of tests give the source of a case.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use hybrid_system::*;
use nalgebra::{Vector1, Vector2};
use proptest::prelude::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Surface;

/// A ball over a floor at zero.
struct Ball {
    gravity: f64,
    restitution: f64,
}

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = Surface;
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - 0.5 * self.gravity * t), x[1] - self.gravity * t)
    }
    fn guards(&self, _: ()) -> &[Guard<Surface>] {
        const { &[Guard::falling(Surface)] }
    }
    fn guard_value(&self, _: Surface, x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: Surface, x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, -self.restitution * x[1]) }
    }
}

/// A flow ẋ = 1 with a function of x as guard. Events do not change the state.
struct Clock<F> {
    guard: F,
    guards: [Guard<Surface>; 1],
}

impl<F: Fn(f64) -> f64> HybridSystem for Clock<F> {
    type State = State<1>;
    type Mode = ();
    type Surface = Surface;
    fn flow(&self, _: (), x: &State<1>, t: f64) -> State<1> {
        Vector1::new(x[0] + t)
    }
    fn guards(&self, _: ()) -> &[Guard<Surface>] {
        &self.guards
    }
    fn guard_value(&self, _: Surface, x: &State<1>) -> f64 {
        (self.guard)(x[0])
    }
    fn reset(&self, _: (), _: Surface, x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: *x }
    }
}

fn crossings(
    guard: impl Fn(f64) -> f64,
    watch: Guard<Surface>,
    until: f64,
    interval: f64,
) -> Vec<f64> {
    // The events do not change the state: the guard is an observer.
    let clock = Clock { guard, guards: [watch.crossing()] };
    let limits = Limits::sampled(until, 100, interval);
    Execution::new(&clock, (), Vector1::new(0.0), limits)
        .filter_map(|arc| arc.unwrap().event().map(|event| event.before[0]))
        .collect()
}

fn impacts(ball: &Ball, height: f64, limits: Limits) -> Vec<Event<(), Surface, State<2>>> {
    Execution::new(ball, (), Vector2::new(height, 0.0), limits)
        .filter_map(|arc| arc.unwrap().event().copied())
        .collect()
}

#[test]
fn the_fmi_reference_ball_bounces_at_its_known_times() {
    let ball = Ball { gravity: 9.81, restitution: 0.7 };
    let exact = [
        0.451_523_640_985_730_9,
        1.083_656_738_365_754_2,
        1.526_149_906_531_770_5,
        1.835_895_124_247_981_9,
        2.052_716_776_649_329_8,
    ];
    let found = impacts(&ball, 1.0, Limits::sampled(2.1, 100, 1e-2));
    assert_eq!(found.len(), 5);
    for (event, time) in found.iter().zip(exact) {
        assert_relative_eq!(event.time, time, max_relative = 1e-13);
    }
}

#[test]
fn the_elastic_ball_of_drake_ends_in_its_known_state() {
    let ball = Ball { gravity: 9.81, restitution: 1.0 };
    let mut execution =
        Execution::new(&ball, (), Vector2::new(1.0, 0.0), Limits::sampled(10.0, 100, 1e-2));
    let arcs: Vec<_> = execution.by_ref().map(Result::unwrap).collect();
    assert_eq!(execution.stop(), Some(Stop::TimeLimit));
    assert_eq!(arcs.len(), 12);
    let last = arcs.last().unwrap();
    let end = last.state(&ball, last.duration).unwrap();
    assert_relative_eq!(end[0], 0.978_321_975_404_438, max_relative = 1e-12);
    assert_relative_eq!(end[1], -0.652_167_802_459_556_2, max_relative = 1e-11);
}

#[test]
fn an_event_at_the_end_time_has_both_states_as_in_diffeqgpu_540() {
    let ball = Ball { gravity: 10.0, restitution: 1.0 };
    let found = impacts(&ball, 45.0, Limits::sampled(15.0, 100, 0.25));
    assert_eq!(found.len(), 3);
    for (event, exact) in found.iter().zip([3.0, 9.0, 15.0]) {
        assert_relative_eq!(event.time, exact, max_relative = 1e-14);
        assert_relative_eq!(event.before[1], -30.0, max_relative = 1e-13);
        assert_relative_eq!(event.after.unwrap().1[1], 30.0, max_relative = 1e-13);
    }
    assert_eq!(
        found.iter().map(|event| event.at_time_limit).collect::<Vec<_>>(),
        [false, false, true]
    );
}

#[test]
fn the_zeros_of_an_oscillator_are_found() {
    let zeros = crossings(|x| x.cos(), Guard::either(Surface), 12.0, 0.1);
    let exact = [0.5, 1.5, 2.5, 3.5].map(|k| k * std::f64::consts::PI);
    assert_eq!(zeros.len(), 4);
    for (zero, exact) in zeros.iter().zip(exact) {
        assert_relative_eq!(*zero, exact, max_relative = 4.0 * f64::EPSILON);
    }
    assert_eq!(crossings(|x| x.cos(), Guard::rising(Surface), 12.0, 0.1).len(), 2);
}

#[test]
fn all_three_zeros_of_scipy_9228_are_found() {
    // y = x³ + 6x² − 4x − 24 from −8, shifted by 8: zeros at −6, −2, 2.
    let y = |t: f64| {
        let x = t - 8.0;
        (x + 6.0) * (x + 2.0) * (x - 2.0)
    };
    let zeros = crossings(y, Guard::either(Surface), 12.0, 0.3);
    assert_eq!(zeros.len(), 3);
    for (zero, exact) in zeros.iter().zip([2.0, 6.0, 10.0]) {
        assert_relative_eq!(*zero, exact, max_relative = 1e-15);
    }
}

/// Roots at samples and between them are found once each, with every interval shorter than their distance.
#[test]
fn each_root_is_found_once_at_and_between_samples() {
    let three = |x: f64| (x - 0.1) * (x - 0.4) * (x - 0.8);
    for interval in [0.29, 0.2, 0.1, 0.05, 0.0625, 0.033] {
        let zeros = crossings(three, Guard::either(Surface), 1.0, interval);
        assert_eq!(zeros.len(), 3, "interval {interval}: {zeros:?}");
        for (zero, exact) in zeros.iter().zip([0.1, 0.4, 0.8]) {
            assert_relative_eq!(*zero, exact, max_relative = 1e-15);
        }
    }
    let product = |x: f64| (1..=9).map(|k| x - f64::from(k) / 10.0).product::<f64>();
    for interval in [0.05, 0.01, 0.033, 0.09, 1.0 / 128.0] {
        let zeros = crossings(product, Guard::either(Surface), 1.0, interval);
        assert_eq!(zeros.len(), 9, "interval {interval}: {zeros:?}");
        for (k, zero) in (1..=9).zip(&zeros) {
            assert_relative_eq!(*zero, f64::from(k) / 10.0, max_relative = 1e-14);
        }
    }
}

/// ẋ = 1, and x → x − 2 where x + y ≥ 0: after t = 2 the state is the start again.
#[test]
fn a_sampled_constant_flow_with_jumps_returns_to_its_start() {
    let saw = Model::closed_form(|(), x: &State<2>, t| [x[0] + t, x[1]])
        .rising((), |x| x[0] + x[1], |x| ((), [x[0] - 2.0, x[1]]))
        .sampled(0.3);
    for start in [[-0.3, 0.1], [-1.9, 0.0], [0.2, -0.7], [-0.1, -1.1]].map(State::from) {
        let arcs: Vec<_> = saw.run((), start, 2.0).collect::<Result<_, _>>().unwrap();
        assert_eq!(arcs.len(), 2);
        let end = arcs[1].state(&saw, arcs[1].duration).unwrap();
        assert!((end - start).amax() < 1e-14, "{end}");
    }
}

#[test]
fn samples_report_no_crossing_at_a_touch() {
    let touch = |x: f64| (x - 0.5) * (x - 0.5);
    let ignored = Guard::either(Surface).touch(Touch::Ignore);
    assert!(crossings(touch, ignored, 1.0, 0.25).is_empty());
    // A sample that is exactly zero shows the touch.
    let clock = Clock { guard: touch, guards: [Guard::either(Surface).crossing()] };
    let limits = Limits::sampled(1.0, 100, 0.25);
    let first = Execution::new(&clock, (), Vector1::new(0.0), limits).next().unwrap();
    assert!(matches!(first, Err(Error::Grazing { time: 0.5, .. })), "{first:?}");
}

/// The product of two such values underflows to zero.
#[test]
fn tiny_values_cross_as_in_sundials_57() {
    for (sign, direction, opposite) in [
        (1.0, Guard::rising(Surface), Guard::falling(Surface)),
        (-1.0, Guard::falling(Surface), Guard::rising(Surface)),
    ] {
        let line = |x: f64| sign * 1e-166 * (x - 0.37);
        let jump = |x: f64| if x < 0.37 { -sign * 1e-166 } else { sign * 1e-166 };
        for guard in [direction, Guard::either(Surface)] {
            for zeros in [crossings(line, guard, 1.0, 0.1), crossings(jump, guard, 1.0, 0.1)] {
                assert_eq!(zeros.len(), 1);
                assert_relative_eq!(zeros[0], 0.37, max_relative = 1e-15);
            }
        }
        assert!(crossings(line, opposite, 1.0, 0.1).is_empty());
    }
}

#[test]
fn a_guard_without_bounds_needs_an_interval() {
    let ball = Ball { gravity: 1.0, restitution: 0.5 };
    let first = |limits| Execution::new(&ball, (), Vector2::new(1.0, 0.0), limits).next().unwrap();
    assert!(matches!(first(Limits::new(1.0, 1)), Err(Error::NoSamplingInterval { .. })));
    for (time, interval) in [(f64::INFINITY, 0.1), (1.0, 0.0), (1.0, -1.0), (1.0, f64::NAN)] {
        assert!(matches!(
            first(Limits::sampled(time, 1, interval)),
            Err(Error::BadSamplingInterval { .. })
        ));
    }
    assert!(matches!(first(Limits::sampled(f64::NAN, 1, 0.1)), Err(Error::BadLimit { .. })));
    // At rest on the floor gravity presses the ball through it: an impact at once, after which it is at rest again.
    let resting = Execution::new(&ball, (), Vector2::zeros(), Limits::sampled(1.0, 10_000, 0.1));
    assert!(matches!(resting.last(), Some(Err(Error::TimelessChain { events: 1001, .. }))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Simple roots farther apart than the interval are found once each.
    #[test]
    fn planted_roots_are_found_once(mut gaps in proptest::collection::vec(0.021..0.3f64, 1..8), interval in 0.003..0.02f64) {
        for k in 1..gaps.len() {
            gaps[k] += gaps[k - 1];
        }
        let roots = gaps;
        let end = roots.last().unwrap() + 0.05;
        let product = |x: f64| roots.iter().map(|root| x - root).product::<f64>();
        let found = crossings(product, Guard::either(Surface), end, interval);
        prop_assert_eq!(found.len(), roots.len());
        for (found, root) in found.iter().zip(&roots) {
            prop_assert!((found - root).abs() < 1e-12);
        }
    }

    /// Each event of a ball against the closed form.
    #[test]
    fn bouncing_ball(restitution in 0.3..1f64, height in 0.1..10f64) {
        let ball = Ball { gravity: 9.8, restitution };
        let drop = (2.0 * height / 9.8).sqrt();
        let found = impacts(&ball, height, Limits::sampled(10.0, 4, 1e-3));
        let mut time = drop;
        for (k, event) in found.iter().enumerate() {
            prop_assert!((event.time - time).abs() < 1e-12 * time, "bounce {k}");
            prop_assert_eq!(event.jump, k);
            time += 2.0 * drop * restitution.powi(k as i32 + 1);
        }
    }
}
