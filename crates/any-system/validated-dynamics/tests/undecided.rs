//! What is not proved has a reason that names the surface, the time and the states.

use crate::models::oscillator;
use hybrid_system::Equations;
use std::ops::ControlFlow;
use validated_dynamics::{
    Enclosure, Error, Limits, Reason, Undecided, ValidatedRun, ValidatedSystem,
};

fn box_of(ends: &[(f64, f64)]) -> Vec<Enclosure> {
    ends.iter().map(|&(low, high)| Enclosure::new(low, high)).collect()
}

/// Why no event number `count` is proved from a box.
fn undecided(equations: &Equations, mode: &str, ends: &[(f64, f64)], limits: Limits) -> Undecided {
    let system = ValidatedSystem::new(equations).unwrap();
    let run = system.start_box(mode, &box_of(ends)).unwrap();
    first_undecided(run.within(limits))
}

fn first_undecided(mut run: ValidatedRun<'_>) -> Undecided {
    for _ in 0..2000 {
        match run.next_event() {
            Ok(_) => {}
            Err(error) => return error.undecided().expect("an undecided statement").clone(),
        }
    }
    panic!("2000 events were proved");
}

fn reason(equations: &Equations, ends: &[(f64, f64)]) -> Reason {
    undecided(equations, "flow", ends, Limits::default()).reason
}

fn names(reason: &Reason, surface: &str) -> bool {
    reason.to_string().contains(surface)
}

#[test]
fn sets_that_may_touch_are_grazing() {
    let stop = oscillator().rising_text("stop", "x - 1").resets_text(&["x", "-v"]);
    let found = reason(&stop, &[(0.0, 0.0), (0.999, 1.001)]);
    assert!(matches!(found, Reason::Grazing { .. }) && names(&found, "stop"), "{found}");
    // Faster ones hit, slower ones never do.
    assert!(matches!(
        reason(&stop, &[(0.0, 0.0), (0.9, 0.999)]),
        Reason::NoEvent { .. } | Reason::Steps { .. }
    ));
}

#[test]
fn sets_on_both_sides_of_a_surface_are_on_it() {
    let section = oscillator().rising_text("section", "x");
    let found = reason(&section, &[(-0.1, 0.1), (1.0, 1.0)]);
    assert!(matches!(found, Reason::OnSurface { .. }) && names(&found, "section"), "{found}");
}

#[test]
fn what_rests_or_starts_beyond_a_floor_is_beyond_it() {
    let floor = Equations::new(&["h", "v"], &[])
        .mode_text("flow", &["v", "-1"])
        .falling_text("floor", "h")
        .resets_text(&["h", "0"]);
    // The plastic landing leaves no speed, and weight leads beyond the floor.
    let found = reason(&floor, &[(1.0, 1.0), (0.0, 0.0)]);
    assert!(matches!(found, Reason::Beyond { .. } | Reason::OnSurface { .. }), "{found}");
    assert!(names(&found, "floor"));
    // On the floor, and into it.
    let system = ValidatedSystem::new(&floor).unwrap();
    let found = first_undecided(system.start("flow", &["0", "-1"]).unwrap()).reason;
    assert!(matches!(found, Reason::Beyond { .. }), "{found}");
    assert!(system.start("flow", &["0", "1"]).unwrap().next_event().is_ok());
    assert!(matches!(reason(&floor, &[(-1.0, -0.5), (0.0, 0.0)]), Reason::Beyond { .. }));
}

#[test]
fn two_surfaces_at_one_time_are_undecided() {
    let corner = Equations::new(&["x", "y"], &[])
        .mode_text("flow", &["1", "1"])
        .rising_text("wall", "x - 1")
        .resets_text(&["-1", "y"])
        .rising_text("roof", "y - 1")
        .resets_text(&["x", "-1"]);
    let found = reason(&corner, &[(0.0, 0.1), (0.0, 0.1)]);
    assert!(matches!(found, Reason::TwoSurfaces { .. }), "{found}");
    assert!(names(&found, "wall") && names(&found, "roof"));
}

#[test]
fn a_set_may_be_too_wide_to_cross_at_once() {
    let turning = oscillator().rising_text("section", "x").resets_text(&["x", "v + 0"]);
    let found = undecided(&turning, "flow", &[(-3.0, -0.2), (0.2, 0.21)], Limits::default());
    assert!(matches!(found.reason, Reason::TooWide { .. } | Reason::Grazing { .. }), "{found}");
    assert_eq!((found.states.len(), found.names.len()), (2, 2));
}

#[test]
fn a_condition_without_a_sign_is_undecided() {
    let table = Equations::new(&["x", "h", "v"], &[])
        .mode_text("flow", &["1", "v", "-1"])
        .falling_text("table", "h")
        .only_where_text("1.5 - x")
        .resets_text(&["x", "h", "-v"]);
    assert!(matches!(
        reason(&table, &[(0.4, 0.6), (0.5, 0.5), (0.0, 0.0)]),
        Reason::Condition { .. }
    ));
    // Nearer ones bounce, further ones fall past the table, for ever.
    let system = ValidatedSystem::new(&table).unwrap();
    let start =
        |x: f64| system.start_box("flow", &box_of(&[(x, x), (0.5, 0.5), (0.0, 0.0)])).unwrap();
    assert!(start(0.2).next_event().is_ok());
    let past = first_undecided(start(0.8).within(Limits { time: 5.0, ..Limits::default() }));
    assert!(matches!(past.reason, Reason::NoEvent { .. }), "{past}");
}

#[test]
fn formulas_without_a_value_and_solutions_that_end_are_named() {
    let root = Equations::new(&["x"], &[]).mode_text("flow", &["-sqrt(x)"]);
    assert!(matches!(reason(&root, &[(-0.1, 1.0)]), Reason::Domain(_)));
    let explodes = Equations::new(&["x"], &[]).mode_text("flow", &["x^2"]);
    let found =
        undecided(&explodes, "flow", &[(1.0, 1.0)], Limits { steps: 400, ..Limits::default() });
    assert!(matches!(found.reason, Reason::NoSolution { .. } | Reason::Steps { .. }), "{found}");
    // 1/(1 − t).
    assert!(found.time.high() <= 1.0, "{found}");
}

#[test]
fn limits_are_named() {
    let ball = Equations::new(&["h", "v"], &[])
        .mode_text("flow", &["v", "-1"])
        .falling_text("floor", "h")
        .resets_text(&["h", "-0.5*v"]);
    let start = [(0.5, 0.5), (0.0, 0.0)];
    // Infinitely many bounces have the limit 3.
    let zeno = undecided(&ball, "flow", &start, Limits { events: 20, ..Limits::default() });
    assert!(matches!(zeno.reason, Reason::Events { events: 20, .. }), "{zeno}");
    assert!(names(&zeno.reason, "floor") && zeno.time.high() < 3.0);
    let steps = undecided(&oscillator(), "flow", &start, Limits { steps: 5, ..Limits::default() });
    assert!(matches!(steps.reason, Reason::Steps { steps: 5 }));
    let time = undecided(&oscillator(), "flow", &start, Limits { time: 7.0, ..Limits::default() });
    assert!(matches!(time.reason, Reason::NoEvent { .. }) && time.time.low() > 7.0);
    let wide = undecided(
        &oscillator(),
        "flow",
        &[(0.0, 0.5), (0.0, 0.0)],
        Limits { width: 0.4, ..Limits::default() },
    );
    assert!(matches!(wide.reason, Reason::Wide { .. }));
}

#[test]
fn an_execution_that_ends_does_not_go_on() {
    let stop = oscillator().rising_text("stop", "x - 0.5").stops();
    let system = ValidatedSystem::new(&stop).unwrap();
    let mut run = system.start_box("flow", &box_of(&[(0.0, 0.0), (1.0, 1.0)])).unwrap();
    assert_eq!(run.next_event().unwrap().next, None);
    let found = first_undecided(run);
    assert!(matches!(found.reason, Reason::Stopped { .. }) && names(&found.reason, "stop"));
}

#[test]
fn a_time_beside_an_event_is_undecided() {
    let stop = oscillator().rising_text("stop", "x - 0.5").resets_text(&["x", "-v"]);
    let system = ValidatedSystem::new(&stop).unwrap();
    let start = || system.start_box("flow", &box_of(&[(0.0, 0.0), (1.0, 1.0)])).unwrap();
    // The event is at asin ½ = π/6.
    let at = Enclosure::from(std::f64::consts::FRAC_PI_6);
    let error = start().advance(at).unwrap_err();
    assert!(matches!(error.undecided().unwrap().reason, Reason::EventAtEnd { .. }));
    assert_eq!(start().advance(Enclosure::from(0.5)).unwrap().len(), 0);
    assert_eq!(start().advance(Enclosure::from(0.6)).unwrap().len(), 1);
    assert!(matches!(start().advance(Enclosure::from(f64::NAN)), Err(Error::Argument { .. })));
    assert!(matches!(start().advance(Enclosure::from(-1.0)), Err(Error::Argument { .. })));
}

#[test]
fn a_run_is_interrupted() {
    let system = ValidatedSystem::new(&oscillator().rising_text("section", "x - 5")).unwrap();
    let mut run = system.start_box("flow", &box_of(&[(0.0, 0.0), (1.0, 1.0)])).unwrap();
    let error = run.next_event_watched(&mut |_| ControlFlow::Break(())).unwrap_err();
    assert_eq!(error.undecided().unwrap().reason, Reason::Interrupted);
}

#[test]
fn wrong_arguments_are_refused() {
    let system = ValidatedSystem::new(&oscillator()).unwrap();
    assert!(system.start_box("flight", &box_of(&[(0.0, 0.0), (1.0, 1.0)])).is_err());
    assert!(system.start_box("flow", &box_of(&[(0.0, 0.0)])).is_err());
    assert!(system.start_box("flow", &box_of(&[(1.0, 0.0), (1.0, 1.0)])).is_err());
    assert!(system.start("flow", &["1", "1/0"]).is_err());
    assert!(system.chart("flow", &["x"], &["x"]).is_err());
    let clock = oscillator().clock_text("tick", "1", "1");
    assert!(ValidatedSystem::new(&clock).is_err());
}
