//! States and errors of times at the ends of arcs.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// The first bounces of a ball under unit gravity that keeps the part `restitution` of its speed.
fn sampled_bounces(restitution: f64, interval: f64, limit: f64) -> Vec<(f64, f64)> {
    let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], move |x| ((), [0.0, -restitution * x[1]]))
        .sampled(interval);
    ball.run((), [0.5, 0.0], limit)
        .filter_map(|arc| arc.unwrap().event().copied())
        .map(|event| (event.time, event.before[1]))
        .collect()
}

#[test]
fn a_flight_shorter_than_the_sampling_interval_ends_at_the_floor() {
    // Dropped from ½ the ball lands after 1, and each flight is half as long as the one before. Only the flight
    // that ends at the first sample of its arc is not shorter than the interval.
    for interval in [0.5, 0.7, 50.0] {
        let bounces = sampled_bounces(0.5, interval, 2.99);
        assert_eq!(bounces.len(), 8, "{interval}: {bounces:?}");
        let mut flight = 2.0;
        let mut exact = 1.0;
        for (time, speed) in bounces {
            assert!((time - exact).abs() < 1e-14 && speed < 0.0, "{interval}: {time} {speed}");
            flight /= 2.0;
            exact += flight;
        }
    }
}

#[test]
fn the_error_of_a_time_near_an_end_of_a_step_is_not_the_step() {
    let fall = Model::integrated(|(), _: &State<1>| [-1.0]).falling(
        (),
        |x| x[0],
        |_| Reset::<(), State<1>>::Stop,
    );
    // Close to the start of the arc, and at the limit on time.
    for height in [1e-16, 1e-12, 1e-9, 1.0] {
        let arc = fall.run((), [height], 1.0).next().unwrap().unwrap();
        let event = arc.event().unwrap();
        assert!((event.time - height).abs() <= event.time_error, "{event:?}");
        assert!(event.time_error < 1e-9, "{event:?}");
    }
}

#[test]
fn a_flow_without_a_value_at_the_limit_on_time_is_an_error() {
    let nowhere = Model::<(), usize, State<1>, _>::closed_form(|(), _: &State<1>, _| [f64::NAN]);
    let field = Model::<(), usize, State<1>, _>::integrated(|(), _: &State<1>| [f64::NAN]);
    let is_error = |arc: Option<Result<Arc<(), usize, State<1>>, Error>>| {
        matches!(arc, Some(Err(Error::StateNotFinite { .. })))
    };
    assert!(is_error(nowhere.run((), [1.0], 5.0).next()));
    assert!(is_error(field.run((), [1.0], 5.0).next()));
}

#[test]
fn a_flow_without_a_value_at_an_event_is_an_error() {
    let nowhere = Model::closed_form(|(), _: &State<1>, _| [f64::NAN])
        .falling((), |x| x[0], |_| ((), [1.0]))
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0], -1.0])));
    let first = nowhere.run((), [1.0], 5.0).next();
    assert!(matches!(first, Some(Err(Error::StateNotFinite { .. }))), "{first:?}");
}

#[test]
fn a_sampled_ball_of_any_time_scale_has_all_its_bounces() {
    // Unit gravity, with time in units from 10¹⁵ to 10⁻¹⁵ of its own.
    for scale in [1e-15, 1e-9, 1.0, 1e9, 1e15] {
        let ball = Model::closed_form(move |(), x: &State<2>, t| {
            let t = t / scale;
            [x[0] + t * (x[1] - t / 2.0), x[1] - t]
        })
        .falling((), |x| x[0], |x| ((), [0.0, -x[1]]))
        .sampled(0.3 * scale);
        let mut bounces = 0;
        for arc in ball.run((), [0.5, 0.0], 20.0 * scale) {
            let Some(event) = arc.unwrap().event().copied() else { continue };
            bounces += 1;
            let exact = f64::from(2 * bounces - 1) * scale;
            assert!((event.time - exact).abs() < 1e-13 * exact, "{scale}: {event:?}");
            assert!(event.before[1] < 0.0, "{scale}: {event:?}");
        }
        assert_eq!(bounces, 10, "{scale}");
    }
}

/// A guard that is zero on 1 < x < 2 and positive or negative beside it. From the middle of the band it stays zero
/// for half a unit of time. The start does not show when it leaves: that is an error, and no event at the start.
#[test]
fn a_guard_that_stays_zero_for_a_while_has_no_event_at_the_start() {
    let band = |x: &State<1>| (1.0 - x[0]).max(0.0) + (2.0 - x[0]).min(0.0);
    let sampled = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .falling((), band, |_| Reset::<(), State<1>>::Stop)
        .sampled(1e-3);
    let found = sampled.run((), [1.5], 5.0).next().unwrap();
    assert!(matches!(found, Err(Error::UndecidedStart { .. })), "{found:?}");
    let integrated = Model::integrated(|(), _: &State<1>| [1.0])
        .falling((), band, |_| Reset::<(), State<1>>::Stop);
    let found = integrated.run((), [1.5], 5.0).next().unwrap();
    assert!(matches!(found, Err(Error::UndecidedStart { .. })), "{found:?}");
}

/// The end of the first arc from x = `start`.
fn first_end<T>(system: &T, start: f64, limits: Limits) -> ArcEnd<(), T::Surface, State<1>>
where
    T: HybridSystem<State = State<1>, Mode = ()>,
{
    Execution::new(system, (), State::from([start]), limits).next().unwrap().unwrap().end
}

#[test]
fn arcs_without_an_event_carry_their_certainty() {
    let rise = || {
        let flow = Model::closed_form(|(), x: &State<1>, t| [x[0] + t]);
        flow.rising((), |x| x[0] - 10.0, |x| ((), *x))
    };
    let signal = rise().signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] - 10.0, 1.0])));
    let field = Model::integrated(|(), x: &State<1>| [1.0 - x[0]]).rising(
        (),
        |x| x[0] - 10.0,
        |x| ((), *x),
    );
    let certainty = |end| match end {
        ArcEnd::TimeLimit { certainty } => certainty,
        other => panic!("{other:?}"),
    };
    let limits = Limits::new(3.0, 10);
    assert_eq!(certainty(first_end(&signal, 0.0, limits)), Certainty::Certain);
    let sampled = Limits::sampled(3.0, 10, 0.5);
    let by_samples = certainty(first_end(&rise(), 0.0, sampled));
    assert_eq!(by_samples, Certainty::Sampled { interval: 0.5 });
    assert_eq!(certainty(first_end(&field, 0.0, limits)), Certainty::Interpolated);
    // Where the field is zero no event follows, up to any time.
    let never = first_end(&field, 1.0, Limits::new(f64::INFINITY, 10));
    assert!(matches!(never, ArcEnd::Never { certainty: Certainty::Interpolated }), "{never:?}");
}

#[test]
fn an_arc_whose_steps_end_is_unfinished_and_goes_on() {
    let swing = Model::integrated(|(), x: &State<2>| [x[1], -x[0]]).tolerance(1e-10).rising(
        (),
        |x| x[0] - 2.0,
        |x| ((), *x),
    );
    let limits = Limits { steps: 40, ..Limits::new(f64::INFINITY, 10) };
    let mut execution = Execution::new(&swing, (), State::from([1.0, 0.0]), limits);
    let mut time = 0.0;
    for _ in 0..3 {
        let arcs: Vec<_> = execution.go_on(limits).collect::<Result<_, _>>().unwrap();
        let [arc] = &arcs[..] else { panic!("{arcs:?}") };
        assert!(matches!(arc.end, ArcEnd::Unfinished { certainty: Certainty::Interpolated }));
        assert_eq!((execution.stop(), arc.time), (Some(Stop::Unfinished), time));
        assert!(arc.duration > 1.0);
        time = execution.time();
        let (sin, cos) = pxfm::f_sincos(time);
        assert!((execution.state() - State::from([cos, -sin])).amax() < 1e-8, "{time}");
    }
    // A quiet arc to a late time ends.
    let settling =
        Model::integrated(|(), x: &State<1>| [-x[0]]).rising((), |x| x[0] - 2.0, |x| ((), *x));
    let end = first_end(&settling, 1.0, Limits::new(1e6, 10));
    assert!(matches!(end, ArcEnd::TimeLimit { .. }), "{end:?}");
}
