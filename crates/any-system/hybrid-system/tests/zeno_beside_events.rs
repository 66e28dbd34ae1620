//! Zeno limits with other events shortly before them, and limits at which rounding hides the last bounces.

use hybrid_system::*;

type Ball = State<2>;

/// A ball over a floor at this height, gravity 1: the height and the velocity after a time.
fn flight(x: &Ball, t: f64) -> [f64; 2] {
    [x[0] + t * (x[1] - t / 2.0), x[1] - t]
}

/// Every bounce is a landing from above, at a floor whose height hides the last ones. A bounce that rounding hides is
/// no event at once.
#[test]
fn a_floor_at_any_height_is_landed_on_from_above() {
    for (floor, exactly) in
        [(0.0, true), (0.3, false), (1.0, true), (1.0, false), (-7.7, true), (1000.0, false)]
    {
        for (restitution, height) in
            [(0.02, 0.5), (0.1, 0.4), (0.3, 0.5), (0.5, 0.37), (0.5, 0.5), (0.8, 1.9)]
        {
            let ball = Model::closed_form(|(), x: &Ball, t| flight(x, t))
                .falling(
                    (),
                    move |x| x[0] - floor,
                    move |x| ((), [if exactly { floor } else { x[0] }, -restitution * x[1]]),
                )
                .contact()
                .sampled(0.02);
            let exact = (2.0_f64 * height).sqrt() * (1.0 + restitution) / (1.0 - restitution);
            let mut limit = None;
            for arc in ball.run((), [floor + height, 0.0], 60.0) {
                match arc.unwrap().end {
                    ArcEnd::Event(event) => assert!(event.before[1] < 0.0, "{floor} {event:?}"),
                    ArcEnd::Zeno { limit: found, .. } => limit = Some(found),
                    _ => {}
                }
            }
            let limit = limit.unwrap_or_else(|| panic!("{floor} {restitution} {height}"));
            let error = (limit.time - exact).abs();
            assert!(error <= limit.time_error && limit.time_error < 1e-5, "{floor} {limit:?}");
        }
    }
}

/// A clock at the time of the limit ticks once, whatever the order of the two.
#[test]
fn a_clock_at_a_limit_ticks_once() {
    for late in [-2, -1, 0, 1, 2] {
        let tick = f64::from_bits(3.0_f64.to_bits().wrapping_add_signed(late));
        let ball = Model::closed_form(|flies: bool, x: &Ball, t| match flies {
            true => flight(x, t),
            false => [0.0, 0.0],
        })
        .falling(true, |x| x[0], |x| (true, [x[0], -0.5 * x[1]]))
        .contact()
        .sampled(0.013)
        .rest(|_, _| Some((false, [0.0, 0.0])))
        .clock_everywhere(
            9,
            move |now| (now < tick).then_some(tick),
            |mode, x: &Ball| (mode, *x),
        );
        let arcs: Vec<_> = ball.run(true, [0.5, 0.0], 4.0).map(|arc| arc.unwrap()).collect();
        assert!(arcs.iter().any(|arc| matches!(arc.end, ArcEnd::Zeno { .. })), "{late}");
        let ticks: Vec<_> = arcs
            .iter()
            .filter_map(|arc| arc.event().map(|event| (event.surface, event.time)))
            .filter(|event| event.0 == 9)
            .collect();
        assert_eq!(ticks, [(9, tick)], "{late}");
    }
}

/// A guard that is reached together with one of the last bounces has its event before the limit takes its place.
#[test]
fn a_guard_reached_with_a_bounce_is_not_lost_at_the_limit() {
    for k in 30..50 {
        let tick = 3.0 - 0.5_f64.powi(k);
        let ball = Model::closed_form(|flies: bool, x: &State<3>, t| match flies {
            true => [x[0] + t * (x[1] - t / 2.0), x[1] - t, x[2] + t],
            false => [0.0, 0.0, x[2] + t],
        })
        .guard(
            true,
            Guard::falling("floor").contact(),
            |x| x[0],
            |x| (true, [0.0, -0.5 * x[1], x[2]]),
        )
        .observer(Guard::rising("tick"), move |x| x[2] - tick)
        .sampled(0.02)
        .rest(|_, x| Some((false, [0.0, 0.0, x[2]])));
        let arcs = ball.run(true, [0.5, 0.0, 0.0], 4.0).map(|arc| arc.unwrap());
        let ticks = arcs.filter(|arc| arc.event().is_some_and(|event| event.surface == "tick"));
        assert_eq!(ticks.count(), 1, "{k}");
    }
}

/// Two contacts of one floor: the second is reached with each bounce, and the first one's reset turns it back.
#[test]
fn two_contacts_of_one_floor_have_one_limit() {
    let ball = Model::closed_form(|flies: bool, x: &Ball, t| match flies {
        true => flight(x, t),
        false => [0.0, 0.0],
    })
    .falling(true, |x| x[0], |x| (true, [0.0, -0.5 * x[1]]))
    .contact()
    .falling(true, |x| 2.0 * x[0], |x| (true, [0.0, -0.5 * x[1]]))
    .contact()
    .sampled(0.013)
    .rest(|_, _| Some((false, [0.0, 0.0])));
    let arcs: Vec<_> = ball.run(true, [0.5, 0.0], 4.0).map(|arc| arc.unwrap()).collect();
    let ArcEnd::Zeno { limit, .. } = &arcs[arcs.len() - 2].end else { panic!("{arcs:?}") };
    assert!((limit.time - 3.0).abs() <= limit.time_error, "{limit:?}");
}

/// A ball that rests at its limit, and an observer of the clock x₂.
macro_rules! ticking_ball {
    ($flow:expr, $floor:expr, $restitution:expr, $tick:expr) => {{
        let (floor, restitution, tick) = ($floor, $restitution, $tick);
        $flow
            .guard(
                true,
                Guard::falling("floor").contact(),
                move |x: &State<3>| x[0] - floor,
                move |x| (true, [x[0], -restitution * x[1], x[2]]),
            )
            .observer(Guard::rising("tick"), move |x| x[2] - tick)
            .rest(move |_, x| Some((false, [floor, 0.0, x[2]])))
    }};
}

fn by_formula(flies: bool, x: &State<3>, t: f64) -> [f64; 3] {
    match flies {
        true => [x[0] + t * (x[1] - t / 2.0), x[1] - t, x[2] + t],
        false => [x[0], 0.0, x[2] + t],
    }
}

/// Stops and observers among bounces that rounding hides are no landings from below, and lose nothing.
#[test]
fn stops_among_hidden_bounces_change_nothing() {
    for (floor, restitution, height) in [
        (1.0, 0.27, 1.87),
        (-3.7, 0.65, 1.96),
        (25.0, 0.2, 1.53),
        (1.0, 0.9, 0.6),
        (0.0, 0.95, 1.9),
    ] {
        let limit = (2.0_f64 * height).sqrt() * (1.0 + restitution) / (1.0 - restitution);
        for k in 0..24 {
            let (stop, tick) = (limit - 1e-5 * 0.5_f64.powi(k), limit - 1.3e-5 * 0.45_f64.powi(k));
            let flow = Model::closed_form(by_formula).sampled(0.02);
            let ball = ticking_ball!(flow, floor, restitution, tick);
            let mut run = ball.run(true, [floor + height, 0.0, 0.0], 0.0);
            let (mut ticks, mut limits) = (0, 0);
            for until in [stop, limit + 1.0] {
                for arc in run.run_until(until) {
                    match arc.unwrap().end {
                        ArcEnd::Event(event) if event.surface == "tick" => ticks += 1,
                        ArcEnd::Event(event) => assert!(event.before[1] < 0.0, "{floor} {event:?}"),
                        ArcEnd::Zeno { .. } => limits += 1,
                        _ => {}
                    }
                }
            }
            assert_eq!((ticks, limits), (1, 1), "{floor} {restitution} {height} {k}");
        }
    }
}

/// The times of a clock are known: a series of them has no limit.
#[test]
fn clocks_alone_have_no_limit() {
    let mut times: Vec<f64> = (1..=45).map(|k| 1.0 - 0.5_f64.powi(k)).collect();
    times.extend([2.0, 3.0]);
    let clock = PresetTimes::new(times.clone()).unwrap();
    let counter = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .clock((), 9, move |now| clock.next_after(now), |(), x| ((), [x[0] + 1.0]))
        .sampled(0.1);
    let mut run = counter.run((), [0.0], 4.0);
    let seen: Vec<_> =
        run.by_ref().filter_map(|arc| arc.unwrap().event().map(|event| event.time)).collect();
    assert_eq!(seen, times);
    assert_eq!(run.stop(), Some(Stop::TimeLimit));
}

/// The field of a ball whose third component is the time.
#[cfg(feature = "ode")]
fn field_of_time(flies: bool, x: &State<3>) -> [f64; 3] {
    match flies {
        true => [x[1], -1.0, 1.0],
        false => [0.0, 0.0, 1.0],
    }
}

/// A ball whose third component is the time, with a limit at 3.
#[cfg(feature = "ode")]
macro_rules! timed_ball {
    () => {
        Model::integrated(field_of_time)
            .guard(
                true,
                Guard::falling("floor").contact(),
                |x| x[0],
                |x| (true, [x[0], -0.5 * x[1], x[2]]),
            )
            .rest(|_, x| Some((false, [0.0, 0.0, x[2]])))
    };
}

/// An observer before the limit has its one event within its stated error, also where the bounces are lost in the
/// errors of an integration.
#[cfg(feature = "ode")]
#[test]
fn an_observer_before_a_limit_is_not_lost() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        for k in 0..60 {
            let before = 1e-3 * 0.7_f64.powi(k);
            let tick = 3.0 - before;
            let ball = timed_ball!()
                .tolerance(tolerance)
                .observer(Guard::rising("time"), move |x| x[2] - tick);
            let arcs = ball.run(true, [0.5, 0.0, 0.0], 4.0).map(|arc| arc.unwrap());
            let events = arcs.filter_map(|arc| arc.event().cloned());
            let ticks: Vec<_> = events.filter(|event| event.surface == "time").collect();
            let [event] = &ticks[..] else { panic!("{tolerance} {before} {ticks:?}") };
            let error = (event.time - tick).abs();
            let bound = event.time_error + 4.0 * f64::EPSILON;
            assert!(
                error <= bound && bound < 2e-5 + 1e4 * tolerance,
                "{tolerance} {before} {event:?}"
            );
        }
    }
}

/// The same for guards that end the run, of all roles.
#[cfg(feature = "ode")]
#[test]
fn a_terminal_guard_before_a_limit_ends_the_run() {
    for before in [1e-4, 1.4e-5, 3e-6] {
        for role in 0..3 {
            let tick = 3.0 - before;
            let guard = Guard::rising("time");
            let guard = [guard.contact(), guard, guard.crossing()][role];
            let ball = timed_ball!().terminal(true, guard, move |x| x[2] - tick).terminal(
                false,
                guard,
                move |x| x[2] - tick,
            );
            let mut run = ball.run(true, [0.5, 0.0, 0.0], 4.0);
            let last = run.by_ref().last().unwrap().unwrap();
            let event = last.event().unwrap();
            assert_eq!((event.surface, run.stop()), ("time", Some(Stop::Terminal)), "{before}");
            assert!((event.time - tick).abs() <= event.time_error, "{before} {role} {event:?}");
        }
    }
}

/// An observer that has had an event between the last bounces has its next one, behind the last of them.
#[cfg(feature = "ode")]
#[test]
fn an_observer_crossed_again_before_a_limit_is_not_lost() {
    for part in [0.05, 0.2, 0.4] {
        for k in 0..20 {
            let before = 1e-3 * 0.84_f64.powi(k);
            let (first, second) = (3.0 - before, 3.0 - part * before);
            let ball = timed_ball!()
                .tolerance(1e-6)
                .observer(Guard::either("twice"), move |x| 1e6 * (x[2] - first) * (x[2] - second));
            let arcs = ball.run(true, [0.5, 0.0, 0.0], 4.0).map(|arc| arc.unwrap());
            let events =
                arcs.filter(|arc| arc.event().is_some_and(|event| event.surface == "twice"));
            assert_eq!(events.count(), 2, "{first} {second}");
        }
    }
}

/// Near a limit the height as rounded is a large part of a bounce, and a weak bounce lasts longer by what is left of
/// its height: whatever divides the last flights, the limit is within its error.
#[test]
fn a_limit_is_within_its_error_whatever_divides_the_last_flights() {
    for floor in [0.0, 1.0, 25.0] {
        for restitution in [0.0024, 0.0194, 0.18, 0.42, 0.5] {
            let height = 0.947;
            let limit = (2.0_f64 * height).sqrt() * (1.0 + restitution) / (1.0 - restitution);
            for k in 0..40 {
                let tick = limit - 3e-3 * 0.45_f64.powi(k);
                let stops = [limit - 1e-3 * 0.37_f64.powi(k), limit + 1.0];
                let start = State::from([floor + height, 0.0, 0.0]);
                let plain = Model::closed_form(by_formula).sampled(0.0213);
                let ball = ticking_ball!(plain, floor, restitution, tick);
                is_within_its_error(&ball, start, stops, limit);
                let signal = move |flies: bool, x: &State<3>| {
                    flies.then(|| QuasiPolynomial::polynomial(&[x[0] - floor, x[1], -0.5]))
                };
                let ball = ball.signal("floor", signal);
                is_within_its_error(&ball, start, stops, limit);
            }
        }
    }
}

/// A bounce that a stop hides is an error with its remedy, and no wrong answer.
fn is_within_its_error<T>(ball: &T, start: State<3>, stops: [f64; 2], exact: f64)
where
    T: HybridSystem<Mode = bool, State = State<3>>,
    T::Surface: Copy + PartialEq + std::fmt::Debug,
{
    let limits = Limits::sampled(0.0, 10_000, 0.0213);
    let mut execution = Execution::new(ball, true, start, limits);
    for stop in stops {
        for arc in execution.run_until(stop) {
            if let Ok(Arc { end: ArcEnd::Zeno { limit, .. }, .. }) = arc {
                assert!((limit.time - exact).abs() <= limit.time_error, "{exact} {limit:?}");
            }
        }
    }
}

/// The durations may show a limit that the flow has passed, within its error: the limit is now, and the clock goes on
/// from the present state.
#[cfg(feature = "ode")]
#[test]
fn a_limit_before_the_present_does_not_turn_the_clock_back() {
    let (floor, restitution, height, tolerance) =
        (25.0, 0.641_721_114_024_630_5, 0.812_340_951_002_269_3, 1e-6);
    let limit = (2.0_f64 * height).sqrt() * (1.0 + restitution) / (1.0 - restitution);
    let tick = limit + 1.159_872_198_286_393_5e-11;
    let flow = Model::integrated(field_of_time).tolerance(tolerance);
    let ball = ticking_ball!(flow, floor, restitution, tick);
    let mut execution = ball.run(true, [floor + height, 0.0, 0.0], 0.0);
    let mut ticks = 0;
    for stop in [limit - 9.654_005_026_504_82e-7, limit - 2.195_831_161_344_585_8e-8, limit + 1.0] {
        for arc in execution.run_until(stop) {
            let arc = arc.unwrap();
            ticks += usize::from(arc.event().is_some_and(|event| event.surface == "tick"));
            assert!((arc.start[2] - arc.time).abs() <= 4.0 * f64::EPSILON * arc.time, "{arc:?}");
        }
    }
    assert_eq!(ticks, 1);
}
