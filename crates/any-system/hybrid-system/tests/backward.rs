//! Models of closures backward in time.

#![cfg(feature = "ode")]

use hybrid_system::*;

const TIGHT: Tolerances = Tolerances::both(1e-12);

/// A thermostat by closures: both switches are undone without a change of the state.
#[test]
fn a_thermostat_goes_back_through_its_switches() {
    let room = Model::integrated(|on: bool, x: &State<1>| [if on { 30.0 } else { 10.0 } - x[0]])
        .tolerance(1e-12)
        .guard(true, Guard::rising("warm"), |x| x[0] - 21.0, |x| (false, *x))
        .guard(false, Guard::falling("cold"), |x| x[0] - 19.0, |x| (true, *x));
    let end = room.run(true, [20.0], 1.0).fate();
    assert!(end.events > 2);
    let back = Backward::new(&room, TIGHT).inverse("warm", false, |x| (true, *x)).inverse(
        "cold",
        true,
        |x| (false, *x),
    );
    let first = back.run(end.mode, end.state, (1.0, 0.0)).fate();
    assert_eq!((first.mode, first.events, first.time), (true, end.events, 0.0));
    assert!((first.state[0] - 20.0).abs() < 1e-10, "{first:?}");
    // The events are at the times of those forward.
    let forward = room.run(true, [20.0], 1.0).filter_map(|arc| Some(arc.unwrap().event()?.time));
    let backward = back
        .run(end.mode, end.state, (1.0, 0.0))
        .filter_map(|arc| Some(-arc.unwrap().event()?.time));
    let (forward, mut backward): (Vec<_>, Vec<_>) = (forward.collect(), backward.collect());
    backward.reverse();
    for (forward, backward) in forward.iter().zip(&backward) {
        assert!((forward - backward).abs() < 1e-10, "{forward} {backward}");
    }
}

/// No inverse is needed where no jump is on the way; an observer has its points, and a rising one falls.
#[test]
fn a_limit_before_the_start_without_jumps() {
    let swing = Model::integrated(|(), x: &State<2>| [x[1], -pxfm::f_sin(x[0])])
        .tolerance(1e-12)
        .observer(Guard::rising("right"), |x| x[0]);
    let end = swing.run((), [0.0, 1.0], 20.0).fate();
    let back = Backward::new(&swing, TIGHT);
    let mut run = back.run((), end.state, (20.0, 0.0));
    let events: Vec<_> = run.by_ref().filter_map(|arc| arc.unwrap().event().copied()).collect();
    assert!((run.state() - State::from([0.0, 1.0])).norm() < 1e-9);
    // Forward it starts on the surface, which is no event.
    assert!(events.iter().filter(|event| event.time < -1.0).count() == end.events);
    assert!(events.iter().all(|event| event.direction == Some(Direction::Falling)));
    // The same limit without `Backward` is an error that names it.
    let error = swing.run((), end.state, -1.0).next().unwrap().unwrap_err();
    assert!(error.to_string().contains("Backward"), "{error}");
}

/// With the time as an argument, and a table that moves: through every bounce.
#[test]
fn a_ball_on_a_table_goes_back() {
    let height = |t: f64| 0.1 * pxfm::f_sin(3.0 * t);
    let speed = |t: f64| 0.3 * pxfm::f_cos(3.0 * t);
    let ball =
        Model::integrated_in_time(|(), _, x: &State<3>| [x[1], -1.0]).tolerance(1e-12).falling(
            (),
            move |t, x| x[0] - height(t),
            move |t, x| ((), [x[0], 1.8 * speed(t) - 0.8 * x[1]]),
        );
    let end = ball.run((), [1.0, 0.0], 8.0).fate();
    assert!(end.events > 2, "{end:?}");
    let back = Backward::new(&ball, TIGHT)
        .inverse(0, (), move |x| ((), [x[0], (1.8 * speed(x[2]) - x[1]) / 0.8, x[2]].into()));
    let first = back.run((), end.state, (8.0, 0.0)).fate();
    assert_eq!(first.events, end.events);
    assert!((first.state - State::from([1.0, 0.0, 0.0])).norm() < 1e-8, "{first:?}");
}

/// Without an inverse a run ends where a jump has been. From the state after a landing the landing is undone at once, from the state
/// before it the flight goes on.
#[test]
fn a_floor_has_no_past_below() {
    let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).tolerance(1e-12).falling(
        (),
        |x| x[0],
        |x| ((), [x[0], -0.5 * x[1]]),
    );
    let alone = Backward::new(&ball, TIGHT);
    let fate = alone.run((), [0.5, 0.0], (0.0, -9.0)).fate();
    assert_eq!(fate.end, End::Terminal(BackwardSurface::Model(0)));
    assert!((fate.time - 1.0).abs() < 1e-12);
    let back = Backward::new(&ball, TIGHT).inverse(0, (), |x| ((), [x[0], -2.0 * x[1]].into()));
    for (speed, events) in [(0.5, 1), (-1.0, 0)] {
        let first = back.run((), [0.0, speed], (1.0, 0.0)).fate();
        assert!((first.state - State::from([0.5, 0.0])).norm() < 1e-9, "{first:?}");
        assert_eq!(first.events, events);
    }
}

/// A condition is asked at the state before the event, and a flow in closed form has its field.
#[test]
fn conditions_and_closed_forms() {
    let line = Model::closed_form(|(), x: &State<2>, t| [x[0] + t, x[1]])
        .field(|(), _| [1.0, 0.0])
        .guard((), Guard::rising("wall"), |x| x[0] - 1.0, |x| ((), [x[0] - 1.0, x[1] + 1.0]))
        .only_where("wall", |x| 1.5 - x[1])
        .sampled(0.01);
    let end = line.run((), [0.2, 0.0], 3.5).fate();
    // Two walls count, the third one does not.
    assert_eq!((end.events, end.state[1]), (2, 2.0));
    let back =
        Backward::new(&line, TIGHT).inverse("wall", (), |x| ((), [x[0] + 1.0, x[1] - 1.0].into()));
    let first = back.run((), end.state, (3.5, 0.0)).fate();
    assert!((first.state - State::from([0.2, 0.0])).norm() < 1e-9, "{first:?}");
}

#[test]
fn what_has_no_motion_backward_is_an_error() {
    let message = |run: Execution<'_, _>| match run.fate().end {
        End::Failed(error) => error.to_string(),
        end => panic!("{end:?}"),
    };
    let field = |(), _: &State<1>| [1.0];
    let clock = Model::integrated(field).clock((), "tick", |t| Some(t + 1.0), |(), x| ((), *x));
    let back = Backward::new(&clock, TIGHT);
    assert!(message(back.run((), [0.0], (2.0, 0.0))).contains("last tick"));
    let wall = || Model::integrated(field).guard((), Guard::rising("w"), |x| x[0], |x| ((), *x));
    let wall = wall();
    let twice =
        Backward::new(&wall, TIGHT).inverse("w", (), |x| ((), *x)).inverse("w", (), |x| ((), *x));
    match twice.run((), [3.0], (2.0, 0.0)).fate().end {
        End::Failed(error) => assert!(error.to_string().contains("two inverses"), "{error}"),
        end => panic!("{end:?}"),
    }
    // Without a field there is nothing to integrate.
    let closed = Model::closed_form(|(), x: &State<1>, t| [x[0] + t]).guard(
        (),
        Guard::rising("w"),
        |x| x[0],
        |x| ((), *x),
    );
    match Backward::new(&closed, TIGHT).run((), [3.0], (2.0, 0.0)).fate().end {
        End::Failed(error) => assert!(matches!(error, Error::NoVectorField { .. }), "{error}"),
        end => panic!("{end:?}"),
    }
    // Forward in time is not backward.
    let forward = Backward::new(&wall, TIGHT).run((), [3.0], (0.0, 2.0)).fate();
    assert!(matches!(forward.end, End::Failed(Error::BadLimit { .. })), "{forward:?}");
}

/// An inverse that does not fit is an error, and so is one of a jump to another mode.
#[test]
fn a_wrong_inverse_is_an_error() {
    let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).falling(
        (),
        |x| x[0],
        |x| ((), [x[0], -0.5 * x[1]]),
    );
    let wrong = Backward::new(&ball, TIGHT).inverse(0, (), |x| ((), [x[0], -1.9 * x[1]].into()));
    let fate = wrong.run((), [0.1, 0.3], (1.5, 0.0)).fate();
    let End::Failed(error) = fate.end else { panic!("{fate:?}") };
    assert!(error.to_string().contains("correct the inverse"), "{error}");
    let equations = Equations::new(&["height", "speed"], &[])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-0.5*speed"])
        .inverse_text(&["height", "-1.9*speed"]);
    for (equations, time) in [(equations.clone(), 9.0), (equations.reversed().unwrap(), 9.0)] {
        let model = equations.model::<State<2>>().unwrap();
        let fate = model.start("flight", [0.5, 0.3], time).unwrap().fate();
        let End::Failed(error) = fate.end else { panic!("{fate:?}") };
        assert!(error.to_string().contains("correct the inverse"), "{error}");
    }
}

/// Three equal balls on a line, the second and the third in touch: two jumps at one instant, which are undone at one instant.
#[test]
fn jumps_at_one_instant_are_undone_together() {
    let exchange = |a: usize, b: usize| {
        move |x: &State<6>| {
            let mut after = *x;
            after.swap_rows(3 + a, 3 + b);
            ((), after)
        }
    };
    let balls = Model::integrated(|(), x: &State<6>| [x[3], x[4], x[5], 0.0, 0.0, 0.0])
        .guard((), Guard::falling(0).contact(), |x| x[1] - x[0], exchange(0, 1))
        .guard((), Guard::falling(1).contact(), |x| x[2] - x[1], exchange(1, 2));
    let start = [1.0, 2.0, 2.0, 1.0, 0.0, 0.0];
    let end = balls.run((), start, 3.0).fate();
    assert_eq!((end.events, end.state[5]), (2, 1.0), "{end:?}");
    let back =
        Backward::new(&balls, TIGHT).inverse(0, (), exchange(0, 1)).inverse(1, (), exchange(1, 2));
    let first = back.run((), end.state, (3.0, 0.0)).fate();
    assert_eq!(first.events, 2, "{first:?}");
    assert!((first.state - State::from(start)).norm() < 1e-10, "{first:?}");
}

/// A jump into a mode is known by its inverse alone: without it the room has always been cooling.
#[test]
fn a_jump_from_another_mode_is_known_by_its_inverse() {
    let room = Model::integrated(|on: bool, x: &State<1>| [if on { 30.0 } else { 10.0 } - x[0]])
        .guard(true, Guard::rising("warm"), |x| x[0] - 21.0, |x| (false, *x))
        .guard(false, Guard::falling("cold"), |x| x[0] - 19.0, |x| (true, *x));
    let alone = Backward::new(&room, TIGHT).run(false, [20.5], (0.0, -1.0)).fate();
    assert_eq!((alone.mode, alone.events), (false, 0));
    assert!((alone.state[0] - (10.0 + 10.5 * 1f64.exp())).abs() < 1e-9);
    let known = Backward::new(&room, TIGHT).inverse("warm", false, |x| (true, *x));
    let fate = known.run(false, [20.5], (0.0, -0.1)).fate();
    assert_eq!((fate.mode, fate.events), (true, 1));
}

/// From the very end of a run forward, on a surface within rounding: through its landing, or up the flight that a stop has ended.
#[test]
fn a_run_back_begins_where_a_run_forward_ends() {
    let floor = |x: &State<2>| x[0];
    let bounce = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).tolerance(1e-12).guard(
        (),
        Guard::falling("floor"),
        floor,
        |x| ((), [x[0], -0.5 * x[1]]),
    );
    let stop = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).tolerance(1e-12).terminal(
        (),
        Guard::falling("floor"),
        floor,
    );
    let equations = |stops: bool| {
        let floor = Equations::new(&["height", "speed"], &[])
            .mode_text("flight", &["speed", "-1"])
            .falling_text("floor", "height");
        match stops {
            true => floor.stops(),
            false => {
                floor.resets_text(&["height", "-0.5*speed"]).inverse_text(&["height", "-2*speed"])
            }
        }
    };
    let models = [false, true].map(|stops| equations(stops).model::<State<2>>().unwrap());
    let backs = [false, true]
        .map(|stops| equations(stops).reversed().unwrap().model::<State<2>>().unwrap());
    for k in 0..100 {
        let start = State::from([0.3 + 0.618 * f64::from(k) % 1.0, 0.1 * f64::from(k % 7)]);
        let landing = stop.run((), start, 9.0).fate();
        let time = landing.time;
        let back = Backward::new(&stop, TIGHT).run((), landing.state, (time, 0.0)).fate();
        assert!((back.state - start).norm() < 1e-9 && back.events == 0, "{k} {back:?}");
        let end = bounce.run((), start, time).fate();
        let back = Backward::new(&bounce, TIGHT)
            .inverse("floor", (), |x| ((), [x[0], -2.0 * x[1]].into()))
            .run((), end.state, (time, 0.0))
            .fate();
        assert!((back.state - start).norm() < 1e-9, "{k} {back:?}");
        assert_eq!(back.events, end.events, "{k}");
        for (model, back) in models.iter().zip(&backs) {
            let end = model.start("flight", start, time).unwrap().fate();
            let first = back.start_at("flight", end.state, (-end.time, 0.0)).unwrap().fate();
            assert!((first.state - start).norm() < 1e-9, "{k} {end:?} {first:?}");
        }
    }
}

/// No past beyond a floor: a start there is an error, and from its surface downward the run ends at once.
#[test]
fn there_is_no_past_beyond_a_bound() {
    let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).falling(
        (),
        |x| x[0],
        |x| ((), [x[0], -0.5 * x[1]]),
    );
    let alone = Backward::new(&ball, TIGHT);
    let beyond = alone.run((), [-1.0, 0.0], (5.0, 0.0)).fate();
    assert!(matches!(beyond.end, End::Failed(Error::StartsBeyond { .. })), "{beyond:?}");
    let down = alone.run((), [0.0, 0.5], (1.0, 0.0)).fate();
    assert_eq!((down.end, down.time), (End::Terminal(BackwardSurface::Model(0)), -1.0));
    // From −1 the state goes to 1, and jumps back to −1: none comes from between 1 and 1.5.
    let saw = Model::integrated(|(), _: &State<1>| [1.0]).rising(
        (),
        |x| x[0] - 1.0,
        |x| ((), [x[0] - 2.0]),
    );
    let back = Backward::new(&saw, TIGHT).inverse(0, (), |x| ((), [x[0] + 2.0].into()));
    let beyond = back.run((), [1.5], (1.0, 0.0)).fate();
    assert!(matches!(beyond.end, End::Failed(Error::StartsBeyond { .. })), "{beyond:?}");
    let crossing = Model::integrated(|(), _: &State<1>| [1.0])
        .rising((), |x| x[0] - 1.0, |x| ((), [x[0] - 2.0]))
        .crossing();
    let back = Backward::new(&crossing, TIGHT).inverse(0, (), |x| ((), [x[0] + 2.0].into()));
    let ends = back.run((), [1.5], (1.0, 0.0)).fate();
    assert_eq!(ends.end, End::Terminal(BackwardSurface::Model(0)));
    // A reset that changes nothing here is no observer.
    let flag = Model::integrated(|(), _: &State<2>| [1.0, 0.0])
        .rising((), |x| x[0] - 1.0, |x| ((), [x[0], 1.0]))
        .crossing();
    let ends = Backward::new(&flag, TIGHT).run((), [1.5, 1.0], (1.0, 0.0)).fate();
    assert_eq!(ends.end, End::Terminal(BackwardSurface::Model(0)));
}

/// Of two jumps at one instant the last one is undone first; a tick at the instant of a jump is an error.
#[test]
fn the_order_of_jumps_at_one_instant() {
    let pair = Model::integrated(|(), _: &State<3>| [1.0, 1.0, 0.0])
        .guard((), Guard::rising("a"), |x| x[0] - 1.0, |x| ((), [x[0] - 1.0, x[1], 2.0 * x[2]]))
        .guard((), Guard::rising("b"), |x| x[1] - 1.0, |x| ((), [x[0], x[1] - 1.0, x[2] + 1.0]));
    let end = pair.run((), [0.5, 0.5, 3.0], 1.0).fate();
    assert_eq!(end.state[2], 7.0);
    let back = Backward::new(&pair, TIGHT)
        .inverse("a", (), |x| ((), [x[0] + 1.0, x[1], x[2] / 2.0].into()))
        .inverse("b", (), |x| ((), [x[0], x[1] + 1.0, x[2] - 1.0].into()));
    let first = back.run((), end.state, (1.0, 0.0)).fate();
    assert!((first.state - State::from([0.5, 0.5, 3.0])).norm() < 1e-9, "{first:?}");
    let equations = Equations::new(&["x", "y", "z"], &[])
        .mode_text("m", &["1", "1", "0"])
        .rising_text("a", "x - 1")
        .resets_text(&["x - 1", "y", "2*z"])
        .inverse_text(&["x + 1", "y", "z/2"])
        .rising_text("b", "y - 1")
        .resets_text(&["x", "y - 1", "z + 1"])
        .inverse_text(&["x", "y + 1", "z - 1"]);
    let back = equations.reversed().unwrap().model::<State<3>>().unwrap();
    let first = back.start_at("m", end.state, (-1.0, 0.0)).unwrap().fate();
    assert!((first.state - State::from([0.5, 0.5, 3.0])).norm() < 1e-9, "{first:?}");
    let ticks = equations
        .ticks_text("tick", &["0.5"])
        .resets_text(&["x", "y", "z*3"])
        .inverse_text(&["x", "y", "z/3"]);
    let back = ticks.reversed().unwrap().model::<State<3>>().unwrap();
    let fate = back.start_at("m", end.state, (-1.0, 0.0)).unwrap().fate();
    let End::Failed(error) = fate.end else { panic!("{fate:?}") };
    assert!(error.to_string().contains("at one instant"), "{error}");
}

/// Ticks at both ends, there and back.
#[test]
fn ticks_at_the_ends_go_back() {
    let equations = Equations::new(&["x"], &[])
        .ticks_text("tick", &["0", "0.5", "1"])
        .resets_text(&["2*x + 1"])
        .inverse_text(&["(x - 1)/2"])
        .mode_text("m", &["x/10"]);
    let end = equations.model::<State<1>>().unwrap().start("m", [1.0], 1.0).unwrap().fate();
    let back = equations.reversed().unwrap().model::<State<1>>().unwrap();
    let first = back.start_at("m", end.state, (-1.0, 0.0)).unwrap().fate();
    assert!((first.state[0] - 1.0).abs() < 1e-12 && first.events == end.events, "{first:?}");
}

/// Two modes whose jumps move their own guards.
#[test]
fn jumps_between_modes_that_move_their_guards() {
    let equations = Equations::new(&["x"], &[])
        .mode_text("a", &["1"])
        .rising_text("fires", "x - 1")
        .resets_text(&["x - 1"])
        .inverse_text(&["x + 1"])
        .to("b")
        .mode_text("b", &["1"])
        .rising_text("back", "x - 1")
        .resets_text(&["x - 1"])
        .inverse_text(&["x + 1"])
        .to("a");
    let end = equations.model::<State<1>>().unwrap().start("a", [0.3], 4.5).unwrap().fate();
    let back = equations.reversed().unwrap().model::<State<1>>().unwrap();
    let first = back.start_at("a", end.state, (-4.5, 0.0)).unwrap().fate();
    assert_eq!((end.events, end.mode.as_str(), first.events), (4, "a", 4));
    assert!((first.state[0] - 0.3).abs() < 1e-11, "{first:?}");
}

/// A condition without a value decides nothing, backward too.
#[test]
fn a_condition_without_a_value_is_an_error() {
    let line = Model::integrated(|(), _: &State<2>| [1.0, 0.0])
        .rising((), |x| x[0] - 1.0, |x| ((), [x[0] - 1.0, x[1] + 1.0]))
        .only_where(0, |x| if x[1] < 1.0 { f64::NAN } else { 1.0 });
    let back =
        Backward::new(&line, TIGHT).inverse(0, (), |x| ((), [x[0] + 1.0, x[1] - 1.0].into()));
    let fate = back.run((), [0.5, 1.0], (1.0, 0.0)).fate();
    let End::Failed(error) = fate.end else { panic!("{fate:?}") };
    assert!(matches!(error, Error::Condition(_)), "{error}");
}
