//! Models of equations slide along surfaces, with exits and derivatives, and without rates by hand.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// A relay: both fields point at the line x = 0.
fn relay() -> Equations {
    Equations::new(&["x", "y"], &[("up", "1.3"), ("down", "0.7")])
        .mode("below", |t, _, p| [p["up"], t.number(1.0)])
        .rising("line", |_, x, _| x[0])
        .to("above")
        .mode("above", |t, _, p| [-p["down"], t.number(-3.0)])
        .falling("line", |_, x, _| x[0])
        .to("below")
}

/// It comes to the line at 1, at y = −3. There the mean of both fields along it is 1·0.35 − 3·0.65 = −1.6.
#[test]
fn a_relay_of_equations_slides() {
    let model = relay().model::<State<2>>().unwrap();
    let above = Label::new("above").unwrap();
    let start = State::from([0.7, 0.0]);
    // Without a mode for it the run ends there, with the sliding field.
    let fate = model.start("above", [0.7, 0.0], 3.0).unwrap().fate();
    assert_eq!(fate.end, End::Stopped(Stop::Sliding));
    assert!((fate.time - 1.0).abs() < 1e-12);
    let filippov = Filippov::new(model, Tolerances::both(1e-12));
    let mut run = Execution::new(&filippov, FilippovMode::Free(above), start, Limits::new(3.0, 10));
    for arc in run.by_ref() {
        arc.unwrap();
    }
    let end = run.state();
    assert!(end[0].abs() < 1e-12 && (end[1] + 3.0 + 2.0 * 1.6).abs() < 1e-10, "{end}");
}

/// A mass on a belt of speed 1 with Coulomb friction 1, which a spring pulls: it sticks up to x = 1, and slips then.
#[test]
fn a_mass_of_equations_sticks_and_leaves() {
    let model = Equations::new(&["x", "v"], &[("friction", "1"), ("belt", "1")])
        .mode("slower", |_, x, p| [x[1], p["friction"] - x[0]])
        .rising("belt", |_, x, p| x[1] - p["belt"])
        .touch(Touch::Ignore)
        .to("faster")
        .mode("faster", |_, x, p| [x[1], -p["friction"] - x[0]])
        .falling("belt", |_, x, p| x[1] - p["belt"])
        .to("slower")
        .model::<State<2>>()
        .unwrap();
    let slower = FilippovMode::Free(Label::new("slower").unwrap());
    let filippov = Filippov::new(model, Tolerances::both(1e-12));
    let limits = Limits::new(40.0, 50);
    let run = Execution::new(&filippov, slower, State::from([0.0, 0.5]), limits);
    let arcs: Vec<_> = run.map(Result::unwrap).collect();
    // About x = 1 the energy of the slip is ⅝ throughout: the speed is 1 at x = ½. It leaves at x = 1, after ½, and then
    // oscillates about 1, with the speed of the belt as its largest: it only touches the belt.
    let is_sliding = |mode| matches!(mode, FilippovMode::Sliding { .. });
    let sliding: Vec<_> = arcs.iter().filter(|arc| is_sliding(arc.mode)).collect();
    let [stick] = sliding[..] else { panic!("{arcs:?}") };
    assert!((stick.start[0] - 0.5).abs() < 1e-11 && (stick.duration - 0.5).abs() < 1e-9);
    let last = &arcs[arcs.len() - 1];
    assert_eq!(last.mode, slower);
    assert!((last.time + last.duration - 40.0).abs() < 1e-12);
}

/// A guard with a condition has it while the state slides, too.
#[test]
fn conditions_hold_while_the_state_slides() {
    for (condition, expected) in [("-1", 3.0), ("1", 1.0 + 1.0 / 1.6)] {
        let model = Equations::new(&["x", "y"], &[])
            .falling_text("mark", "y + 4")
            .only_where_text(condition)
            .stops()
            .mode_text("below", &["1.3", "1"])
            .rising_text("line", "x")
            .to("above")
            .mode_text("above", &["-0.7", "-3"])
            .falling_text("line", "x")
            .to("below")
            .model::<State<2>>()
            .unwrap();
        let above = FilippovMode::Free(Label::new("above").unwrap());
        let filippov = Filippov::new(model, Tolerances::both(1e-12));
        let limits = Limits::new(3.0, 10);
        let fate = Execution::new(&filippov, above, State::from([0.7, 0.0]), limits).fate();
        assert!((fate.time - expected).abs() < 1e-9, "{condition}: {fate:?}");
    }
}
