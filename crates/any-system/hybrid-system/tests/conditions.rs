//! Guards whose events count only where another function is positive.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// A ball rolls off a table that ends at 1, and falls to the floor, a unit below it.
fn table() -> Equations {
    Equations::new(&["x", "y", "u", "v"], &[("end", "1")])
        .mode_text("flight", &["u", "v", "0", "-1"])
        .falling_text("table", "y")
        .only_where_text("end - x")
        .resets_text(&["x", "y", "u", "-v"])
        .falling_text("floor", "y + 1")
        .stops()
}

/// Thrown up from the table it lands at 2, beyond the end or not. From there it falls a unit.
#[test]
fn an_event_without_its_condition_is_none() {
    let model = table().model::<State<4>>().unwrap();
    let start = |speed: f64| State::from([0.0, 0.0, speed, 1.0]);
    let near: Vec<_> = model
        .start("flight", start(0.3), 5.0)
        .unwrap()
        .map(|arc| arc.unwrap().event().map(|event| (event.surface.to_string(), event.time)))
        .collect();
    // It lands on the table at 2, at x = 0.6, and comes down beside it at 4, at x = 1.2.
    assert_eq!(near.len(), 2);
    assert_eq!(near[0].as_ref().unwrap().0, "table");
    assert!((near[0].as_ref().unwrap().1 - 2.0).abs() < 1e-14);
    let fall = 4.0 + 3f64.sqrt() - 1.0;
    assert!((near[1].as_ref().unwrap().1 - fall).abs() < 1e-12, "{near:?}");

    // One arc leads over the level of the table.
    let mut run = model.start("flight", start(0.6), 9.0).unwrap();
    let arcs: Vec<_> = run.by_ref().map(Result::unwrap).collect();
    let [arc] = &arcs[..] else { panic!("{arcs:?}") };
    let event = arc.event().unwrap();
    assert_eq!((event.surface.to_string(), event.jump), ("floor".to_owned(), 0));
    assert_eq!(event.certainty, Certainty::Certain);
    assert!((event.time - (1.0 + 3f64.sqrt())).abs() < 1e-14);
    assert!((arc.duration - event.time).abs() < 1e-15);
    for time in [0.5, 1.9, 2.0, 2.1, 2.7] {
        let height = arc.state(&model, time).unwrap()[1];
        assert!((height - time * (1.0 - time / 2.0)).abs() < 1e-14, "{time} {height}");
    }
}

/// A landing exactly at the end of the table: no rounding decides it.
#[test]
fn a_condition_lost_in_rounding_is_an_error() {
    let model = table().model::<State<4>>().unwrap();
    for off in [0.0, 1e-17, -1e-17] {
        let mut run = model.start("flight", [0.0, 0.0, 0.5 + off, 1.0], 9.0).unwrap();
        let error = run.next().unwrap().unwrap_err();
        assert!(matches!(error, Error::Condition(ConditionError::Undecided { .. })), "{error}");
        assert!(error.to_string().contains("table"), "{error}");
    }
    for (off, expected) in [(1e-12, "floor"), (-1e-12, "table")] {
        let mut run = model.start("flight", [0.0, 0.0, 0.5 + off, 1.0], 9.0).unwrap();
        assert_eq!(run.next().unwrap().unwrap().event().unwrap().surface, expected);
    }
    // Without a value, nothing is decided.
    let broken = table()
        .rising_text("side", "x - 0.1")
        .only_where_text("ln(-x)")
        .model::<State<4>>()
        .unwrap();
    let mut run = broken.start("flight", State::from([0.0, 0.0, 0.5, 1.0]), 9.0).unwrap();
    assert!(matches!(run.next(), Some(Err(Error::Condition(ConditionError::Undecided { .. })))));
}

/// The zeros of an oscillator that count only after a time, and a clock that counts only on one side of it.
#[test]
fn conditions_of_time_and_of_clocks() {
    let equations = Equations::new(&["x", "v"], &[])
        .mode("m", |_, x, _| [x[1], -x[0]])
        .rising("zero", |_, x, _| x[0])
        .only_where(|t, _, _| t - 9.0)
        .clock("tick", |p| [p.number(1.0), p.number(1.0)])
        .only_where(|_, x, _| x[0]);
    let again = Equations::from_json(&equations.to_json().unwrap()).unwrap();
    assert_eq!(again, equations);
    // The time is the last component.
    let model = again.model::<State<3>>().unwrap();
    let mut zeros = Vec::new();
    let mut ticks = Vec::new();
    for arc in model.start("m", [0.0, 1.0, 0.0], 16.0).unwrap() {
        let arc = arc.unwrap();
        let Some(event) = arc.event() else { continue };
        match event.surface == "zero" {
            true => zeros.push(event.time),
            false => ticks.push(event.time),
        }
    }
    // sin t rises at 2π and 4π, and is positive at these whole numbers.
    assert_eq!(zeros.len(), 1);
    assert!((zeros[0] - 4.0 * std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(ticks, [1.0, 2.0, 3.0, 7.0, 8.0, 9.0, 13.0, 14.0, 15.0]);
}

/// A condition that never holds leaves one arc, whatever the number of crossings, for closures, bounds and formulas.
#[test]
fn a_thousand_crossings_that_do_not_count() {
    let end = 3000.0;
    let turn = |x: &State<2>, t: f64| {
        let (sine, cosine) = t.sin_cos();
        [x[0] * cosine + x[1] * sine, x[1] * cosine - x[0] * sine]
    };
    let sampled = Model::closed_form(|(), x: &State<2>, t| turn(x, t))
        .either((), |x| x[0], |_| ((), [f64::NAN; 2]))
        .only_where(0, |x| x[0] - 2.0)
        .sampled(0.5);
    let integrated = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .either((), |x| x[0], |_| ((), [f64::NAN; 2]))
        .only_where(0, |x| x[0] - 2.0);
    fn check<T: HybridSystem<State = State<2>>>(run: Execution<'_, T>, end: f64) {
        let arcs: Vec<_> = run.map(Result::unwrap).collect();
        assert_eq!(arcs.len(), 1);
        assert!((arcs[0].duration - end).abs() < 1e-9 && arcs[0].event().is_none());
    }
    check(sampled.run((), [1.0, 0.0], end), end);
    check(integrated.run((), [1.0, 0.0], end), end);
    let formulas = Equations::new(&["x", "v"], &[])
        .mode("m", |_, x, _| [x[1], -x[0]])
        .either("zero", |_, x, _| x[0])
        .only_where(|_, x, _| x[0] - 2.0)
        .stops()
        .model::<State<2>>()
        .unwrap();
    check(formulas.start("m", [1.0, 0.0], end).unwrap(), end);
}

/// A surface that no guard has, and an entry of a file that this version does not know.
#[test]
fn wrong_conditions_are_refused() {
    let model = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .either((), |x| x[0], |x| ((), *x))
        .only_where(7, |x| x[1]);
    let error = model.run((), [1.0, 0.0], 9.0).next().unwrap().unwrap_err();
    assert!(matches!(error, Error::NoSuchGuard { .. }), "{error}");
    let model = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .either((), |x| x[0], |x| ((), *x))
        .only_where(0, |x| x[1])
        .contact();
    let error = model.run((), [1.0, 0.0], 9.0).next().unwrap().unwrap_err();
    assert!(matches!(error, Error::Condition(ConditionError::OfBound { .. })), "{error}");
    let bound = table().rising_text("side", "x").only_where_text("y").contact().check();
    let bound = bound.unwrap_err().to_string();
    assert!(bound.contains("side") && bound.contains("crossing"), "{bound}");
    let file = table().to_json().unwrap().replace("\"condition\"", "\"conditions\"");
    let error = Equations::from_json(&file).unwrap_err().to_string();
    assert!(error.contains("guard table"), "{error}");
    let early = Equations::new(&["x"], &[]).mode_text("m", &["1"]).only_where_text("x").check();
    assert!(early.is_err());
}

/// The jets of an execution pass an event that does not count.
#[test]
fn derivatives_pass_an_event_that_does_not_count() {
    let model = table().model::<State<4>>().unwrap();
    let arc = model.start("flight", [0.0, 0.0, 0.6, 1.0], 9.0).unwrap().next().unwrap().unwrap();
    let jet = model.jet::<2>(&[arc], &Along::start(&[0.0, 0.0, 0.0, 1.0])).unwrap();
    // v + √(v² + 2), at v = 1.
    assert!((jet.time.0[1] - (1.0 + 1.0 / 3f64.sqrt())).abs() < 1e-12);
}

/// Crossings that do not count leave their errors: the event behind them has an error that holds its distance from the exact
/// time, and the arc's end is that of the event.
#[test]
fn events_behind_many_that_do_not_count_know_their_error() {
    let model = Equations::new(&["x", "y", "w"], &[])
        .mode_text("m", &["7*y", "-7*x", "1"])
        .falling_text("o", "x")
        .only_where_text("-1")
        .rising_text("g", "w - 3000.5")
        .model::<State<3>>()
        .unwrap();
    let arc = model.start("m", [1.0, 0.0, 0.0], 7000.3).unwrap().next().unwrap().unwrap();
    let event = arc.event().unwrap();
    let off = (event.time - 3000.5).abs();
    assert!(off <= event.time_error && event.time_error < 1e-7, "{off:e} {event:?}");
    assert!((arc.duration - event.time).abs() < 1e-12);
    // As a condition it is not decided where the error hides it.
    let hidden = Equations::new(&["x", "y", "w"], &[])
        .mode_text("m", &["y", "-sin(x)", "1"])
        .rising_text("o", "w - 47.338")
        .only_where_text("-1")
        .falling_text("g", "x")
        .only_where_text("w - 47.338251")
        .model::<State<3>>()
        .unwrap()
        .tolerance(1e-6);
    let end = hidden.start("m", [3.1, 0.0, 0.0], 50.0).unwrap().fate().end;
    assert!(
        matches!(end, End::Failed(Error::Condition(ConditionError::Undecided { .. }))),
        "{end:?}"
    );
    // The run goes on up to its limit as a function.
    let run = model.start("m", [1.0, 0.0, 0.0], 7000.3).unwrap().solution().unwrap();
    assert!(run.at(7000.3).is_ok());
}

/// An arc whose events never count ends at a budget, also without a limit on time.
#[test]
fn events_that_do_not_count_have_a_budget() {
    let model = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .clock_text("tick", "1", "1")
        .only_where_text("-1")
        .model::<State<1>>()
        .unwrap();
    let limits = Limits { steps: 100, ..Limits::new(f64::INFINITY, 5) };
    let label = Label::new("m").unwrap();
    let mut run = Execution::new(&model, label, State::from([0.0]), limits);
    let arc = run.next().unwrap().unwrap();
    assert!(matches!(arc.end, ArcEnd::Unfinished { .. }) && arc.duration == 100.0, "{arc:?}");
    assert_eq!(run.stop(), Some(Stop::Unfinished));
    // It goes on from there.
    let arc = run.go_on(limits).next().unwrap().unwrap();
    assert_eq!((arc.time, arc.duration), (100.0, 100.0));
}

/// Of several conditions all must hold, for closures and for equations.
#[test]
fn all_conditions_must_hold() {
    let times = |run: Vec<f64>| run;
    let closures = Model::integrated_in_time(|(), _, x: &State<2>| [0.0 * x[0]])
        .observer(Guard::rising("zero"), |t, _| pxfm::f_sin(t))
        .only_where("zero", |t, _| t - 7.0)
        .only_where("zero", |t, _| 20.0 - t);
    let found = closures.run((), [1.0], 40.0).filter_map(|arc| Some(arc.unwrap().event()?.time));
    let found = times(found.collect());
    let equations = Equations::new(&["x"], &[])
        .mode_text("m", &["0*x"])
        .rising_text("zero", "sin(t)")
        .only_where_text("t - 7")
        .only_where_text("20 - t")
        .model::<State<2>>()
        .unwrap();
    let run = equations.start("m", [1.0], 40.0).unwrap();
    let exact = times(run.filter_map(|arc| Some(arc.unwrap().event()?.time)).collect());
    assert_eq!((found.len(), exact.len()), (2, 2));
    for k in 0..2 {
        let time = (4 + 2 * k) as f64 * std::f64::consts::PI;
        assert!((found[k] - time).abs() < 1e-9 && (exact[k] - time).abs() < 1e-12);
    }
}

/// A reset that depends on the direction: two crossings of one surface, each with its own.
#[test]
fn a_reset_of_its_own_for_each_direction() {
    let model = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .rising((), |x| x[0], |x| ((), [x[0], 0.5 * x[1]]))
        .crossing()
        .falling((), |x| x[0], |x| ((), [x[0], 3.0 * x[1]]))
        .crossing();
    let arcs: Vec<_> = model.run((), [1.0, 0.0], 8.0).map(Result::unwrap).collect();
    let events: Vec<_> = arcs.iter().filter_map(Arc::event).collect();
    assert_eq!(events.iter().map(|event| event.surface).collect::<Vec<_>>(), [1, 0, 1]);
    let directions = events.iter().map(|event| event.direction.unwrap());
    assert_eq!(
        directions.collect::<Vec<_>>(),
        [Direction::Falling, Direction::Rising, Direction::Falling]
    );
    let speeds = events.iter().map(|event| event.after.unwrap().1[1]);
    for (speed, exact) in speeds.zip([-3.0, 1.5, -4.5]) {
        assert!((speed - exact).abs() < 1e-8);
    }
}

/// A tick a fixed time after the last event: a component that falls at the rate 1 and is set by the event.
#[test]
fn a_time_after_the_last_event() {
    // Each impact is followed by a flash 0.3 later, unless another one comes before.
    let model = Equations::new(&["height", "speed", "left"], &[])
        .mode_text("m", &["speed", "-1", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-0.5*speed", "0.3"])
        .falling_text("flash", "left")
        .model::<State<3>>()
        .unwrap();
    let run = model.start("m", [0.5, 0.0, 9.0], 2.4).unwrap();
    let events = run.filter_map(|arc| {
        let event = *arc.unwrap().event()?;
        Some((event.surface.to_string(), event.time))
    });
    let expected = [("floor", 1.0), ("flash", 1.3), ("floor", 2.0), ("flash", 2.3)];
    for ((surface, time), (name, exact)) in events.zip(expected) {
        assert!(surface == name && (time - exact).abs() < 1e-13, "{surface} {time}");
    }
}
