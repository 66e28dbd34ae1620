//! Systems whose guards have bounds and are not sampled. The names of tests give the source of a case.

use hybrid_system::*;
use nalgebra::Vector2;

/// ẋ = 1, and x → x − 2 where x + y ≥ 0. After t = 2 the state is the start again.
#[test]
fn a_constant_flow_with_jumps_returns_to_its_start() {
    struct Saw;
    impl HybridSystem for Saw {
        type State = State<2>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
            Vector2::new(x[0] + t, x[1])
        }
        fn guards(&self, (): ()) -> &[Guard<()>] {
            const { &[Guard::rising(())] }
        }
        fn guard_value(&self, (): (), x: &State<2>) -> f64 {
            x[0] + x[1]
        }
        fn guard_quasi_polynomial(&self, (): (), (): (), x: &State<2>) -> Option<QuasiPolynomial> {
            Some(QuasiPolynomial::polynomial(&[x[0] + x[1], 1.0]))
        }
        fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
            Reset::Jump { mode: (), state: Vector2::new(x[0] - 2.0, x[1]) }
        }
    }
    for (x, y) in [(-0.3, 0.1), (-1.9, 0.0), (0.2, -0.7), (-0.1, -1.1)] {
        let start = Vector2::new(x, y);
        let arcs: Vec<_> = Execution::new(&Saw, (), start, Limits::new(2.0, 10))
            .collect::<Result<_, _>>()
            .unwrap();
        assert_eq!(arcs.len(), 2);
        let end = arcs[1].state(&Saw, arcs[1].duration).unwrap();
        assert!((end - start).amax() < 1e-14, "{end}");
    }
}

/// The last event is exactly at the end time: it has both one-sided states.
#[test]
fn an_event_at_the_end_time_has_both_states_as_in_diffeqgpu_540() {
    struct Elastic;
    impl HybridSystem for Elastic {
        type State = State<2>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
            Vector2::new(x[0] + t * (x[1] - 5.0 * t), x[1] - 10.0 * t)
        }
        fn guards(&self, (): ()) -> &[Guard<()>] {
            const { &[Guard::falling(())] }
        }
        fn guard_value(&self, (): (), x: &State<2>) -> f64 {
            x[0]
        }
        fn guard_quasi_polynomial(&self, (): (), (): (), x: &State<2>) -> Option<QuasiPolynomial> {
            Some(QuasiPolynomial::polynomial(&[x[0], x[1], -5.0]))
        }
        fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
            Reset::Jump { mode: (), state: Vector2::new(0.0, -x[1]) }
        }
    }
    let arcs: Vec<_> = Execution::new(&Elastic, (), Vector2::new(45.0, 0.0), Limits::new(15.0, 10))
        .collect::<Result<_, _>>()
        .unwrap();
    let events: Vec<_> = arcs.iter().filter_map(|arc| arc.event()).collect();
    assert_eq!(events.len(), 3);
    for (event, time) in events.iter().zip([3.0, 9.0, 15.0]) {
        assert_eq!(event.time, time);
        assert_eq!((event.before[1], event.after.unwrap().1[1]), (-30.0, 30.0));
    }
    assert!(matches!(arcs.last().unwrap().end, ArcEnd::TimeLimit { .. }));
}

/// A guard e^(−t) − 1/10 with enclosures, alone, and together with a guard that must be sampled: the weaker
/// certainty counts.
#[test]
fn the_certainty_is_that_of_the_weakest_guard() {
    struct Decay {
        sampled: bool,
    }
    impl HybridSystem for Decay {
        type State = State<1>;
        type Mode = ();
        type Surface = bool;
        fn flow(&self, (): (), x: &State<1>, t: f64) -> State<1> {
            x * (-t).exp()
        }
        fn guards(&self, (): ()) -> &[Guard<bool>] {
            const ALL: &[Guard<bool>] = &[Guard::falling(true), Guard::falling(false)];
            if self.sampled { ALL } else { &ALL[..1] }
        }
        fn guard_value(&self, first: bool, x: &State<1>) -> f64 {
            x[0] - if first { 0.1 } else { 0.2 }
        }
        fn guard_enclosure(
            &self,
            (): (),
            first: bool,
            x: &State<1>,
            order: u32,
            (from, to): (f64, f64),
        ) -> Option<Enclosure> {
            let (high, low) = (x[0] * (-from).exp(), x[0] * (-to).exp());
            let error = 1e-15;
            match (first, order) {
                (false, _) => None,
                (true, 0) => Some(Enclosure::new(low - 0.1 - error, high - 0.1 + error)),
                (true, 1) => Some(Enclosure::new(-high - error, -low + error)),
                (true, _) => None,
            }
        }
        fn reset(&self, (): (), _: bool, _: &State<1>) -> Reset<(), State<1>> {
            Reset::Stop
        }
    }
    let start = nalgebra::Vector1::new(1.0);
    let only = Decay { sampled: false };
    let found = only.first_crossing((), &start, &Search::up_to(10.0)).unwrap().crossing().unwrap();
    assert!((found.time - 10f64.ln()).abs() < 1e-14);
    assert_eq!(found.certainty, Certainty::Certain);
    // With a guard that must be sampled no crossing is certain, and an interval is needed.
    let both = Decay { sampled: true };
    assert!(matches!(
        both.first_crossing((), &start, &Search::up_to(10.0)),
        Err(Error::NoSamplingInterval { .. })
    ));
    let found = both
        .first_crossing((), &start, &Search::up_to(10.0).sampled(0.1))
        .unwrap()
        .crossing()
        .unwrap();
    assert!(!found.surface && (found.time - 5f64.ln()).abs() < 1e-14);
    assert_eq!(found.certainty, Certainty::Sampled { interval: 0.1 });
}

/// A small oscillation about a large constant has no zero in millions of periods.
#[test]
fn a_small_oscillation_never_crosses() {
    let force = QuasiPolynomial::polynomial(&[19.6]) - QuasiPolynomial::cosine(5.0, 22.4);
    assert_eq!(force.first_crossing(Direction::Falling, 1e6).unwrap(), FirstCrossing::Never);
}

/// An elastic ball whose guard is a quasi-polynomial, without a sampling interval.
#[test]
fn the_elastic_ball_of_drake_needs_no_sampling() {
    struct Elastic;
    impl HybridSystem for Elastic {
        type State = State<2>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
            Vector2::new(x[0] + t * (x[1] - 0.5 * 9.81 * t), x[1] - 9.81 * t)
        }
        fn guards(&self, (): ()) -> &[Guard<()>] {
            const { &[Guard::falling(())] }
        }
        fn guard_value(&self, (): (), x: &State<2>) -> f64 {
            x[0]
        }
        fn guard_quasi_polynomial(&self, (): (), (): (), x: &State<2>) -> Option<QuasiPolynomial> {
            Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5 * 9.81]))
        }
        fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
            Reset::Jump { mode: (), state: Vector2::new(0.0, -x[1]) }
        }
    }
    let arcs: Vec<_> = Execution::new(&Elastic, (), Vector2::new(1.0, 0.0), Limits::new(10.0, 100))
        .collect::<Result<_, _>>()
        .unwrap();
    assert_eq!(arcs.len(), 12);
    let end = arcs[11].state(&Elastic, arcs[11].duration).unwrap();
    assert!((end - Vector2::new(0.978_321_975_404_437_9, -0.652_167_802_459_556_2)).amax() < 1e-12);
}

/// x falls from 1 at the rate 1 over a guard at 0. The bounds given are those of another function.
#[test]
fn bounds_of_another_function_are_an_error_at_the_start() {
    let falling = || {
        Model::closed_form(|(), x: &State<1>, t| [x[0] - t])
            .terminal((), Guard::falling(0), |x| x[0])
    };
    let shifted = |(), x: &State<1>| Some(QuasiPolynomial::polynomial(&[x[0] + 7.0, -1.0]));
    let error = falling().signal(0, shifted).run((), [1.0], 20.0).next().unwrap().unwrap_err();
    assert!(matches!(error, Error::WrongBounds { .. }), "{error}");
    let far = |(), _: &State<1>, _, _| Some(Enclosure::new(5.0, 6.0));
    let error = falling().enclosure(0, far).run((), [1.0], 20.0).next().unwrap().unwrap_err();
    assert!(matches!(error, Error::WrongBounds { value: 1.0, low: 5.0, high: 6.0, .. }), "{error}");
    // A signal that has lost digits next to its zero is right: 10 cos(t + φ) with x = 10 cos φ near 0.
    let phase = std::f64::consts::FRAC_PI_2 - 1e-14;
    let swing = Model::closed_form(|(), x: &State<2>, t: f64| {
        [x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin()]
    })
    .terminal((), Guard::falling(0), |x| x[0])
    .signal(0, move |(), _| {
        let (sine, cosine) = phase.sin_cos();
        Some(QuasiPolynomial::cosine(10.0 * cosine, 1.0) - QuasiPolynomial::sine(10.0 * sine, 1.0))
    });
    let arc = swing.run((), [1e-13, -10.0], 20.0).next().unwrap().unwrap();
    assert!(arc.event().unwrap().time < 1e-13);
}
