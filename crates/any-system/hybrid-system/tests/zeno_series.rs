//! Limits of infinitely many bounces, against sums of 30 digits or more.
//!
//! The reference values were computed with mpmath in 30 to 50 digits: by summing all flights, and for restitutions that
//! tend to 1 by the sum of some thousand flights plus a series in the speed for the rest.

#![allow(clippy::excessive_precision)] // reference values, as they are printed

use hybrid_system::*;
use nalgebra::{Vector1, Vector2, Vector3, Vector4};

/// Flights whose durations the model knows: the state is the speed v at take-off, the flight lasts v, and `next` gives
/// the next speed.
struct Flights<F>(F);

impl<F: Fn(f64) -> f64> HybridSystem for Flights<F> {
    type State = State<1>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<1>, _: f64) -> State<1> {
        *x
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::rising(()).crossing()] }
    }
    fn guard_value(&self, _: (), _: &State<1>) -> f64 {
        -1.0
    }
    fn reset(&self, _: (), _: (), x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: Vector1::new((self.0)(x[0])) }
    }
    fn first_crossing(
        &self,
        _: (),
        start: &State<1>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<1>>, Error> {
        let flight = Some(Crossing::exact((), start[0], *start));
        Ok(flight.filter(|flight| flight.time <= search.horizon).into())
    }
}

/// The last arc from `speed`, and why the execution ended.
fn last(next: impl Fn(f64) -> f64, speed: f64, events: usize) -> (Arc<(), (), State<1>>, Stop) {
    let flights = Flights(next);
    let mut execution = Execution::new(&flights, (), Vector1::new(speed), Limits::new(1e6, events));
    let last = execution.by_ref().last().unwrap().unwrap();
    (last, execution.stop().unwrap())
}

fn limit<M: Copy, S: Copy, X: Clone>(arc: &Arc<M, S, X>) -> ZenoLimit<X> {
    let ArcEnd::Zeno { limit, .. } = &arc.end else { panic!("no Zeno limit at {}", arc.time) };
    limit.clone()
}

/// The restitution 1 − c v^s tends to 1: durations fall like k^(−1/s).
#[test]
fn elastic_accumulations_have_their_limits() {
    // The first has a million events: without optimization it takes as long as all other tests.
    let laws = [
        (0.5, 0.5, 3.683_752_391_494_673_235_063, 1e-8),
        (0.25, 1.0 / 3.0, 5.816_864_214_921_126_918_967, 1e-8),
        (0.3, 0.2, 4.054_547_422_552_422_471_832, 1e-9),
    ];
    for (c, s, exact, largest_error) in laws.into_iter().skip(cfg!(debug_assertions).into()) {
        let (arc, stop) = last(|v| v - c * v * v.powf(s), 1.0, 10_000_000);
        assert_eq!(stop, Stop::Zeno, "{s}");
        let limit = limit(&arc);
        let error = (limit.time - exact).abs();
        assert!(error <= limit.time_error, "{s}: {error:e} {limit:?}");
        assert!(limit.time_error < largest_error, "{s}: {error:e} {limit:?}");
        assert!(limit.state[0].abs() <= limit.state_error, "{limit:?}");
    }
}

/// The restitution 1 − v: durations fall like 1/k, whose sum is infinite. With 1 − v^0.95 the sum is finite, but no
/// finite number of durations shows it.
#[test]
fn slow_elastic_bounces_go_on_to_their_limit_on_events() {
    // Without optimization these are fewer events.
    let events = if cfg!(debug_assertions) { 50_000 } else { 300_000 };
    for s in [1.0, 0.95, 1.5] {
        let (_, stop) = last(|v| v - 0.5 * v * v.powf(s), 1.0, events);
        assert_eq!(stop, Stop::EventLimit, "{s}");
    }
}

/// The restitution e + κ v, of which κ v dies out.
#[test]
fn a_drifting_factor_is_in_the_bound() {
    for (e, drift, exact) in [
        (0.5, 0.2, 2.715_961_714_491_208_709_699),
        (0.5, -0.2, 1.554_975_202_487_424_072_713),
        (0.8, 0.1, 7.134_931_600_943_720_707_582),
        (0.9, -0.3, 4.283_417_605_605_102_922_657),
        (0.95, 0.04, 40.744_264_595_407_812_999_3),
    ] {
        let (arc, _) = last(|v| v * (e + drift * v), 1.0, 100_000);
        let limit = limit(&arc);
        let error = (limit.time - exact).abs();
        assert!(error <= limit.time_error, "{e} {drift}: {error:e} {limit:?}");
        assert!(limit.time_error < 1e-11 * exact, "{e} {drift}: {error:e} {limit:?}");
        assert!((limit.ratio - e).abs() < 1e-6, "{limit:?}");
    }
}

/// Durations with a geometric part are no geometric series if another part remains.
#[test]
fn falling_durations_without_a_limit_are_not_replaced() {
    // A q^k + B: the durations tend to B = 1e-9.
    let (_, stop) = last(|v| 1e-9 + 0.5 * (v - 1e-9), 1.0, 10_000);
    assert_eq!(stop, Stop::EventLimit);
    // Three falls and a rise.
    let (_, stop) = last(|v| if v > 1e-3 { 0.1 * v } else { 900.0 * v }, 1.0, 10_000);
    assert_eq!(stop, Stop::EventLimit);
    // Equal durations.
    let (_, stop) = last(|v| v, 1e-3, 10_000);
    assert_eq!(stop, Stop::EventLimit);
}

/// Durations of zero are no series: a chain of events in no time is an error, also after durations that have fallen.
#[test]
fn a_thousand_durations_of_zero_are_a_timeless_chain() {
    for falls in [0, 3, 20, 300] {
        let shortest = 0.5f64.powi(falls);
        let flights = Flights(move |v: f64| if v > shortest { 0.9 * v } else { 0.0 });
        let limits = Limits::new(1e6, usize::MAX);
        let start = Vector1::new(if falls == 0 { 0.0 } else { 1.0 });
        let last = Execution::new(&flights, (), start, limits).last().unwrap();
        // 0.9^k reaches 2^-300 only behind its Zeno limit.
        match last {
            Ok(arc) => assert!(falls == 300 && matches!(arc.end, ArcEnd::Zeno { .. }), "{falls}"),
            Err(Error::TimelessChain { events: 1001, .. }) => assert!(falls < 300),
            Err(error) => panic!("{falls}: {error}"),
        }
    }
}

/// A ball over the floor A sin(ωt), gravity 1. The state is height, speed and time.
struct Moving {
    amplitude: f64,
    omega: f64,
    restitution: f64,
}

impl Moving {
    fn floor(&self, t: f64) -> (f64, f64) {
        let (sin, cos) = (self.omega * t).sin_cos();
        (self.amplitude * sin, self.amplitude * self.omega * cos)
    }
}

impl HybridSystem for Moving {
    type State = State<3>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<3>, t: f64) -> State<3> {
        Vector3::new(x[0] + t * (x[1] - 0.5 * t), x[1] - t, x[2] + t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<3>) -> f64 {
        x[0] - self.floor(x[2]).0
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<3>) -> Option<QuasiPolynomial> {
        let (height, speed) = self.floor(x[2]);
        Some(
            QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])
                + QuasiPolynomial::cosine(-height, self.omega)
                + QuasiPolynomial::sine(-speed / self.omega, self.omega),
        )
    }
    fn reset(&self, _: (), _: (), x: &State<3>) -> Reset<(), State<3>> {
        let (height, speed) = self.floor(x[2]);
        let state = Vector3::new(height, speed - self.restitution * (x[1] - speed), x[2]);
        Reset::Jump { mode: (), state }
    }
}

const MOVING: [(f64, f64, f64, f64); 3] = [
    (0.1, 2.0, 0.5, 3.699_943_792_432_524_483_897),
    (0.1, 2.0, 0.8, 11.797_645_761_594_738_414_33),
    (0.05, 3.0, 0.3, 2.401_429_090_177_482_604_697),
];

#[test]
fn bounces_on_a_moving_floor_have_their_limits() {
    for (amplitude, omega, restitution, exact) in MOVING {
        let ball = Moving { amplitude, omega, restitution };
        let start = Vector3::new(1.0, 0.0, 0.0);
        let last = Execution::new(&ball, (), start, Limits::new(100.0, 10_000)).last().unwrap();
        let limit = limit(&last.unwrap());
        let error = (limit.time - exact).abs();
        assert!(error <= limit.time_error, "{restitution}: {error:e} {limit:?}");
        assert!(limit.time_error < 1e-6, "{restitution}: {error:e} {limit:?}");
    }
}

/// A ball over the floor y = k x², gravity 1, restitution e along the normal. The state is (x, y, ẋ, ẏ).
struct Curved {
    curvature: f64,
    restitution: f64,
}

impl HybridSystem for Curved {
    type State = State<4>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<4>, t: f64) -> State<4> {
        Vector4::new(x[0] + x[2] * t, x[1] + t * (x[3] - 0.5 * t), x[2], x[3] - t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<4>) -> f64 {
        x[1] - self.curvature * x[0] * x[0]
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<4>) -> Option<QuasiPolynomial> {
        let k = self.curvature;
        Some(QuasiPolynomial::polynomial(&[
            self.guard_value((), x),
            x[3] - 2.0 * k * x[0] * x[2],
            -0.5 - k * x[2] * x[2],
        ]))
    }
    fn reset(&self, _: (), _: (), x: &State<4>) -> Reset<(), State<4>> {
        let slope = 2.0 * self.curvature * x[0];
        let normal = (x[3] - slope * x[2]) / (1.0 + slope * slope);
        let change = (1.0 + self.restitution) * normal;
        let height = self.curvature * x[0] * x[0];
        let state = Vector4::new(x[0], height, x[2] + change * slope, x[3] - change);
        Reset::Jump { mode: (), state }
    }
}

#[test]
fn bounces_on_a_curved_floor_have_their_limits() {
    for (curvature, restitution, exact) in [
        (0.5, 0.5, 3.555_021_748_012_027_389_402),
        (1.0, 0.85, 10.628_362_330_045_563_210_75),
        (2.0, 0.3, 1.511_518_796_400_212_938_748),
    ] {
        let ball = Curved { curvature, restitution };
        let start = Vector4::new(0.3, 1.0, 0.1, 0.0);
        let last = Execution::new(&ball, (), start, Limits::new(100.0, 10_000)).last().unwrap();
        let limit = limit(&last.unwrap());
        let error = (limit.time - exact).abs();
        assert!(error <= limit.time_error, "{restitution}: {error:e} {limit:?}");
        assert!(limit.time_error < 1e-6, "{restitution}: {error:e} {limit:?}");
    }
}

/// Restitutions that alternate: the durations have period 2, 3 or 4, and the sum is that of the first period over
/// 1 − the product of all restitutions.
#[test]
fn periods_of_up_to_four_events_are_recognised() {
    struct Alternating(&'static [f64]);
    impl HybridSystem for Alternating {
        type State = State<2>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, _: (), x: &State<2>, _: f64) -> State<2> {
            *x
        }
        fn guards(&self, _: ()) -> &[Guard<()>] {
            const { &[Guard::rising(()).crossing()] }
        }
        fn guard_value(&self, _: (), _: &State<2>) -> f64 {
            -1.0
        }
        fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
            let factor = self.0[x[1] as usize % self.0.len()];
            Reset::Jump { mode: (), state: Vector2::new(factor * x[0], x[1] + 1.0) }
        }
        fn first_crossing(
            &self,
            _: (),
            start: &State<2>,
            search: &Search<()>,
        ) -> Result<NextEvent<(), State<2>>, Error> {
            let flight = Some(Crossing::exact((), start[0], *start));
            Ok(flight.filter(|flight| flight.time <= search.horizon).into())
        }
    }
    for factors in [&[0.9, 0.5][..], &[0.3, 1.5, 0.7], &[0.9, 0.2, 3.0, 0.8], &[0.99, 0.95]] {
        let mut sum = 1.0;
        let mut product = 1.0;
        for factor in factors {
            product *= factor;
            sum += product;
        }
        let exact = (sum - product) / (1.0 - product);
        let system = Alternating(Box::leak(factors.to_vec().into_boxed_slice()));
        let start = Vector2::new(1.0, 0.0);
        let last = Execution::new(&system, (), start, Limits::new(1e6, 100_000)).last().unwrap();
        let limit = limit(&last.unwrap());
        assert_eq!(limit.period, factors.len());
        assert!((limit.time - exact).abs() <= limit.time_error, "{limit:?} {exact}");
        assert!(limit.time_error < 1e-11 * exact, "{limit:?}");
        assert!((limit.ratio - product).abs() < 1e-6, "{limit:?}");
    }
}

/// A ball on a floor that moves up at 1/4, e = 1/2: the limit is at 3. A stop among the last bounces rounds a height of
/// the size of 1, although the ball is 10⁻¹⁶ above the floor.
#[test]
fn a_stop_in_a_late_flight_is_in_the_bound_of_the_limit() {
    let ball =
        Model::closed_form(|(), x: &State<3>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t, x[2] + t])
            .falling((), |x| x[0] - 0.25 * x[2], |x| ((), [x[0], 0.25 - 0.5 * (x[1] - 0.25), x[2]]))
            .contact()
            .signal(0, |(), x| {
                Some(QuasiPolynomial::polynomial(&[x[0] - 0.25 * x[2], x[1] - 0.25, -0.5]))
            });
    for k in 4..100 {
        let stop = 3.0 - 1.37f64.powi(-k);
        let mut execution = ball.run((), [0.5, 0.25, 0.0], stop);
        execution.run_until(stop).for_each(|arc| assert!(arc.is_ok()));
        let last = execution.run_until(5.0).last();
        let Some(Ok(Arc { end: ArcEnd::Zeno { limit, .. }, .. })) = last else {
            panic!("{k}: {last:?} {:?}", execution.stop())
        };
        let error = (limit.time - 3.0).abs();
        assert!(error <= limit.time_error, "{k}: {error:e} {limit:?}");
        assert!(limit.time_error < 1e-5, "{k}: {limit:?}");
    }
}

/// The time as a component does not hide the last bounces, and nor does a component that is larger.
#[test]
fn a_large_component_hides_no_bounces() {
    for large in [0.0, 3.0, 1e3, 1e6] {
        let ball = Model::closed_form(|flies, x: &State<3>, t| match flies {
            true => [x[0] + t * (x[1] - t / 2.0), x[1] - t, x[2] + t],
            false => [0.0, 0.0, x[2] + t],
        })
        .falling(true, |x| x[0], |x| (true, [x[0], -0.5 * x[1], x[2]]))
        .contact()
        .sampled(0.02)
        .rest(|_, x| Some((false, [0.0, 0.0, x[2]])));
        for arc in ball.run(true, [0.5, 0.0, large], 5.0) {
            if let ArcEnd::Zeno { limit, .. } = arc.unwrap().end {
                assert!((limit.time - 3.0).abs() <= limit.time_error, "{large}: {limit:?}");
            }
        }
    }
}
