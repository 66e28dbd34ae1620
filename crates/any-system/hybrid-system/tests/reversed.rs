//! Equations backward in time.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// Runs forward to a time and back to the start: the distance from it, and the numbers of events.
fn there_and_back<const N: usize>(
    equations: &Equations,
    (mode, start, time): (&str, [f64; N], f64),
) -> (f64, usize, usize) {
    let model = equations.model::<State<N>>().unwrap();
    let end = model.start(mode, start, time).unwrap().fate();
    assert_eq!(end.end, End::Stopped(Stop::TimeLimit));
    // A file has the inverses too.
    let read = Equations::from_json(&equations.to_json().unwrap()).unwrap();
    let back = read.reversed().unwrap().model::<State<N>>().unwrap();
    let first = back.start_at(end.mode.as_str(), end.state, (-time, 0.0)).unwrap().fate();
    assert_eq!(first.end, End::Stopped(Stop::TimeLimit), "{first:?}");
    assert_eq!(first.mode, mode);
    ((first.state - State::from(start)).norm(), end.events, first.events)
}

fn ball() -> Equations {
    Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"])
        .inverse_text(&["height", "-speed/restitution"])
}

#[test]
fn a_ball_falls_upwards() {
    let (off, forward, back) = there_and_back(&ball(), ("flight", [0.5, 0.0], 2.4));
    assert!(off < 1e-11, "{off}");
    assert_eq!((forward, back), (2, 2));
}

/// A thermostat: its modes change at surfaces from which the flow backward comes away on the other side.
#[test]
fn a_thermostat_goes_back_through_its_switches() {
    let room = Equations::new(&["room"], &[])
        .mode_text("on", &["30 - room"])
        .rising_text("warm", "room - 21")
        .to("off")
        .mode_text("off", &["10 - room"])
        .falling_text("cold", "room - 19")
        .to("on");
    let (off, forward, back) = there_and_back(&room, ("on", [19.5], 1.3));
    assert!(off < 1e-9, "{off}");
    assert!(forward > 5);
    assert_eq!(forward, back);
    // Below 19 the heater may have been on all the time. A switch at 19 counts where there may have been one.
    let back = room.reversed().unwrap().model::<State<1>>().unwrap();
    let event = back.start("on", [20.0], 1.0).unwrap().solution().unwrap().events().next().copied();
    assert_eq!(event.unwrap().surface, "cold");
}

/// A forced oscillator with a stop: the time is a component, and runs backward too.
#[test]
fn an_oscillator_with_a_stop_goes_back() {
    let oscillator = Equations::new(&["x", "v"], &[])
        .mode_text("free", &["v", "cos(1.3*t) - 0.1*v - x"])
        .rising_text("stop", "x - 0.5")
        .resets_text(&["x", "-0.8*v"])
        .inverse_text(&["x", "-v/0.8"]);
    let model = oscillator.model::<State<3>>().unwrap();
    let end = model.start("free", [0.0, 1.0, 0.0], 30.0).unwrap().fate();
    let back = oscillator.reversed().unwrap().model::<State<3>>().unwrap();
    let mut run = back.start_at("free", end.state, (-30.0, 0.0)).unwrap();
    let mut times = Vec::new();
    for arc in run.by_ref() {
        times.extend(arc.unwrap().event().map(|event| event.time));
    }
    assert_eq!(times.len(), end.events);
    assert!(times.len() > 4);
    assert!((run.state() - State::from([0.0, 1.0, 0.0])).norm() < 1e-8, "{}", run.state());
    // The impacts are those of the run forward, in the other order.
    let forward = model.start("free", [0.0, 1.0, 0.0], 30.0).unwrap().solution().unwrap();
    for (event, time) in forward.events().zip(times.iter().rev()) {
        assert!((event.time + time).abs() < 1e-9, "{} {time}", event.time);
    }
}

/// Integrate and fire: the state jumps from 1 to 0, and backward from 0 to 1. An observer keeps its points, and a rising
/// one falls backward.
#[test]
fn an_observer_has_the_same_points() {
    let neuron = Equations::new(&["x"], &[])
        .mode_text("m", &["1.5 - x"])
        .rising_text("fires", "x - 1")
        .resets_text(&["x - 1"])
        .inverse_text(&["x + 1"])
        .rising_text("half", "x - 0.5");
    let (off, forward, back) = there_and_back(&neuron, ("m", [0.25], 4.0));
    assert!(off < 1e-9, "{off}");
    assert_eq!(forward, back);
    let reversed = neuron.reversed().unwrap().model::<State<1>>().unwrap();
    let run = reversed.start("m", [0.75], 2.0).unwrap().solution().unwrap();
    let half = run.events().find(|event| event.surface == "half").unwrap();
    assert_eq!(half.direction, Some(Direction::Falling));
    // e^s from 0.75 to 1 below 1.5.
    assert!((half.time - (1.0f64 / 0.75).ln()).abs() < 1e-12);
}

/// Ticks of a list come back in the other order; conditions hold at the state before the event.
#[test]
fn lists_and_conditions_go_back() {
    let equations = Equations::new(&["x"], &[])
        .ticks_text("tick", &["0.5", "1.25", "3"])
        .resets_text(&["x + 1"])
        .inverse_text(&["x - 1"])
        .mode_text("m", &["1"])
        .rising_text("wall", "x - 2")
        .only_where_text("x - 1")
        .resets_text(&["x - 5"])
        .inverse_text(&["x + 5"]);
    let (off, forward, back) = there_and_back(&equations, ("m", [0.0], 3.7));
    assert!(off < 1e-11, "{off}");
    assert_eq!((forward, back), (4, 4));
}

/// The condition of a clock is that at the state before its tick, too: 0.5 + 1 is above 1, and no tick counts there.
#[test]
fn conditions_of_clocks_go_back() {
    let equations = Equations::new(&["x"], &[])
        .ticks_text("tick", &["0.5", "1.25"])
        .only_where_text("1 - x")
        .resets_text(&["x + 1"])
        .inverse_text(&["x - 1"])
        .mode_text("m", &["1"]);
    let (off, forward, back) = there_and_back(&equations, ("m", [0.0], 1.0));
    assert!(off < 1e-12, "{off}");
    assert_eq!((forward, back), (1, 1));
}

/// Where no run forward comes from, the run backward ends.
#[test]
fn a_run_without_a_past_ends() {
    let room = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .rising_text("door", "x - 1")
        .to("n")
        .mode_text("n", &["1"]);
    let back = room.reversed().unwrap().model::<State<1>>().unwrap();
    // In m beyond the door: no run forward comes there.
    let fate = back.start("m", [1.5], 3.0).unwrap().fate();
    assert!(matches!(fate.end, End::Failed(Error::StartsBeyond { .. })), "{fate:?}");
}

/// A floor at which the ball stays: a run backward falls onto it from above, and has no past below. A surface that is only crossed
/// is passed in that direction.
#[test]
fn a_run_does_not_come_from_below_the_floor() {
    let ball = |crossing: bool| {
        let floor = Equations::new(&["height", "speed"], &[])
            .mode_text("flight", &["speed", "-1"])
            .falling_text("floor", "height")
            .to("rest");
        let floor = if crossing { floor.crossing() } else { floor };
        let back = floor.mode_text("rest", &["0", "0"]).reversed().unwrap();
        let model = back.model::<State<2>>().unwrap();
        model.start("flight", [0.5, 0.0], 9.0).unwrap().fate()
    };
    assert_eq!(ball(false).end, End::Terminal(Label::new("floor ends").unwrap()));
    assert!((ball(false).time - 1.0).abs() < 1e-12);
    assert_eq!(ball(true).end, End::Stopped(Stop::TimeLimit));
}

#[test]
fn what_has_no_inverse_is_refused() {
    let without = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .rising_text("wall", "x - 2")
        .resets_text(&["x - 1.5"]);
    let error = without.reversed().unwrap_err().to_string();
    assert!(error.contains("wall") && error.contains("inverse"), "{error}");
    let clock = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .clock_text("tick", "1", "1")
        .resets_text(&["x"])
        .inverse_text(&["x"]);
    let error = clock.reversed().unwrap_err().to_string();
    assert!(error.contains("tick"), "{error}");
    let wrong = without.clone().inverse_text(&["x", "x"]).check();
    assert!(matches!(wrong, Err(Error::Dimension { .. })));
    // Twice backward is forward.
    let twice = ball().reversed().unwrap().reversed().unwrap();
    let model = twice.model::<State<2>>().unwrap();
    let fate = model.start("flight", [0.5, 0.0], 2.4).unwrap().fate();
    let exact =
        ball().model::<State<2>>().unwrap().start("flight", [0.5, 0.0], 2.4).unwrap().fate();
    assert!((fate.state - exact.state).norm() < 1e-12);
}

/// A ball that stops at the floor: backward from there, and from its flight.
#[test]
fn a_stop_has_a_past() {
    let ball = Equations::new(&["height", "speed"], &[])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .stops();
    let model = ball.model::<State<2>>().unwrap();
    let landing = model.start("flight", [0.5, 0.0], 9.0).unwrap().fate();
    assert_eq!(landing.end, End::Terminal(Label::new("floor").unwrap()));
    let back = ball.reversed().unwrap().model::<State<2>>().unwrap();
    for (state, time) in [(landing.state, landing.time), (State::from([0.42, -0.4]), 0.4)] {
        let first = back.start_at("flight", state, (-time, 0.0)).unwrap().fate();
        assert_eq!(first.end, End::Stopped(Stop::TimeLimit), "{first:?}");
        assert!((first.state - State::from([0.5, 0.0])).norm() < 1e-12, "{first:?}");
    }
}

/// Two jumps of one name into one mode cannot be told apart backward.
#[test]
fn two_jumps_of_one_name_are_refused() {
    let two = Equations::new(&["x"], &[])
        .mode_text("a", &["1"])
        .rising_text("hit", "x - 1")
        .to("c")
        .mode_text("b", &["1"])
        .rising_text("hit", "x - 1")
        .to("c")
        .mode_text("c", &["1"]);
    let error = two.reversed().unwrap_err().to_string();
    assert!(error.contains("hit") && error.contains("names of their own"), "{error}");
}

/// From the state after a landing the run backward goes through the landing; from the state before it, up the flight. A jump is
/// undone only where the guard went in its direction: a ball that rises through the height of a net has not been thrown by it.
#[test]
fn a_start_where_a_jump_ends_has_come_by_the_jump() {
    let back = ball().reversed().unwrap().model::<State<2>>().unwrap();
    for (speed, events) in [(0.5, 1), (-1.0, 0)] {
        let first = back.start_at("flight", [0.0, speed], (-1.0, 0.0)).unwrap().fate();
        assert!((first.state - State::from([0.5, 0.0])).norm() < 1e-12, "{first:?}");
        assert_eq!(first.events, events);
    }
    let net = Equations::new(&["height", "speed"], &[])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("net", "height - 1")
        .crossing()
        .resets_text(&["height", "speed/2"])
        .inverse_text(&["height", "2*speed"]);
    let (off, forward, back) = there_and_back(&net, ("flight", [0.0, 2.0], 3.6));
    assert!(off < 1e-11, "{off}");
    assert_eq!((forward, back), (1, 1));
}
