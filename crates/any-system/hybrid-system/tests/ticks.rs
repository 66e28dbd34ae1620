//! Clocks with lists of times, at the start and at the end of a run.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// ẋ = 1, set to 0 at each tick.
fn counter() -> Equations {
    Equations::new(&["x"], &[("late", "2.5")])
        .mode("m", |t, _, _| [t.number(1.0)])
        .ticks("list", |p| vec![p.number(0.5), p.number(1.25), p["late"]])
        .resets_text(&["0"])
}

fn times<T: HybridSystem>(run: Execution<'_, T>) -> Vec<f64> {
    run.filter_map(|arc| Some(arc.unwrap().event()?.time)).collect()
}

#[test]
fn a_list_of_times_follows_its_parameters_and_its_file() {
    let equations = counter();
    let again = Equations::from_json(&equations.to_json().unwrap()).unwrap();
    assert_eq!(again, equations);
    let model = again.model::<State<1>>().unwrap();
    assert_eq!(times(model.start("m", [0.0], 9.0).unwrap()), [0.5, 1.25, 2.5]);
    let later = equations.with_parameters(&[("late", "4")]).model::<State<1>>().unwrap();
    assert_eq!(times(later.start("m", [0.0], 9.0).unwrap()), [0.5, 1.25, 4.0]);
    // The state at 9 is 9 − late.
    let arcs: Vec<_> = later.start("m", [0.0], 9.0).unwrap().map(Result::unwrap).collect();
    let jet = later.jet::<2>(&arcs, &Along::parameter("late")).unwrap();
    assert!((jet.state[0].0[0] - 5.0).abs() < 1e-12 && (jet.state[0].0[1] + 1.0).abs() < 1e-12);
    for wrong in [&["2", "1"][..], &["1", "1"], &["x"], &["1/0"]] {
        let refused = Equations::new(&["x"], &[]).mode_text("m", &["1"]).ticks_text("l", wrong);
        assert!(refused.check().is_err(), "{wrong:?}");
    }
    let none = Equations::new(&["x"], &[]).mode_text("m", &["1"]).ticks_text("l", &[]);
    assert!(times(none.model::<State<1>>().unwrap().start("m", [0.0], 9.0).unwrap()).is_empty());
}

/// A first tick at the start, and a last one at the end, or not.
#[test]
fn ticks_at_both_ends() {
    let model = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .clock_text("tick", "0", "0.5")
        .model::<State<1>>()
        .unwrap();
    let label = Label::new("m").unwrap();
    for (at_start, at_end, expected) in [
        (false, true, &[0.5, 1.0][..]),
        (true, true, &[0.0, 0.5, 1.0]),
        (true, false, &[0.0, 0.5]),
        (false, false, &[0.5]),
    ] {
        let limits =
            Limits { ticks_at_start: at_start, ticks_at_end: at_end, ..Limits::new(1.0, 99) };
        let mut run = Execution::new(&model, label, State::from([0.0]), limits);
        let found: Vec<f64> =
            run.by_ref().filter_map(|arc| Some(arc.unwrap().event()?.time)).collect();
        assert_eq!(found, expected, "{at_start} {at_end}");
        // The tick that was left out is the first one of what goes on.
        let rest: Vec<f64> =
            run.run_until(1.75).filter_map(|arc| Some(arc.unwrap().event()?.time)).collect();
        assert_eq!(rest, if at_end { &[1.5][..] } else { &[1.0, 1.5] }, "{at_start} {at_end}");
    }
}

/// A tick at the start does not count, also if another event comes first there.
#[test]
fn an_event_at_the_start_brings_no_tick() {
    let model = Equations::new(&["x"], &[])
        .mode_text("m", &["1"])
        .rising_text("wall", "x")
        .to("n")
        .mode_text("n", &["1"])
        .clock_text("tick", "0", "0.5")
        .model::<State<1>>()
        .unwrap();
    for (at_start, expected) in [(false, &[0.0, 0.5, 1.0][..]), (true, &[0.0, 0.0, 0.5, 1.0])] {
        let limits = Limits { ticks_at_start: at_start, ..Limits::new(1.0, 99) };
        let run = Execution::new(&model, Label::new("m").unwrap(), State::from([0.0]), limits);
        let found: Vec<f64> = run.filter_map(|arc| Some(arc.unwrap().event()?.time)).collect();
        assert_eq!(found, expected, "{at_start}");
    }
}
