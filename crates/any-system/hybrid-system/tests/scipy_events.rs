//! The events of SciPy's own tests (`scipy/integrate/_ivp/tests/test_ivp.py`, `test_events`), forward and backward, as equations.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// y₀ = t/(t + 10), y₁ = 10 t/(t + 10)².
fn rational() -> Equations {
    Equations::new(&["x", "y"], &[])
        .mode("m", |t, x, _| [x[1] / t, x[1] * (x[0] + 2.0 * x[1] - 1.0) / (t * (x[0] - 1.0))])
        .either_text("first", "x - y^0.7")
        .either_text("second", "y^0.6 - x")
        .either_text("third", "t - 7.4")
}

/// The zeros along the exact motion (mpmath).
const FIRST: f64 = 5.550_575_766_240_776;
const SECOND: f64 = 7.548_776_662_466_928;

fn exact(t: f64) -> [f64; 2] {
    [t / (t + 10.0), 10.0 * t / ((t + 10.0) * (t + 10.0))]
}

fn found(run: Execution<'_, EquationsModel<State<3>>>) -> Vec<(String, f64, Option<Direction>)> {
    run.filter_map(|arc| {
        let event = *arc.unwrap().event()?;
        Some((event.surface.to_string(), event.time, event.direction))
    })
    .collect()
}

#[test]
fn events_of_the_rational_motion() {
    let model = rational().model::<State<3>>().unwrap();
    let events = found(model.start_at("m", exact(5.0), (5.0, 8.0)).unwrap());
    let expected = [("first", FIRST), ("third", 7.4), ("second", SECOND)];
    assert_eq!(events.len(), 3);
    for ((surface, time, direction), (name, exact)) in events.iter().zip(expected) {
        assert_eq!(surface, name);
        assert!((time - exact).abs() < 1e-10, "{name} {time}");
        // x rises over a power of y, and the power falls below x.
        let rises = if name == "second" { Direction::Falling } else { Direction::Rising };
        assert_eq!(*direction, Some(rises), "{name}");
    }
    // Backward from 8 to 5, at the same times.
    let back = rational().reversed().unwrap().model::<State<3>>().unwrap();
    let backward = found(back.start_at("m", exact(8.0), (-8.0, -5.0)).unwrap());
    for (event, (name, exact)) in backward.iter().rev().zip(expected) {
        assert_eq!(event.0, name);
        assert!((event.1 + exact).abs() < 1e-10, "{name} {}", event.1);
    }
    assert_eq!(backward.len(), 3);
}

/// With a direction half of them count, and the same ones backward.
#[test]
fn directions_choose_the_same_events_backward() {
    for (rising, expected) in [(true, vec!["first", "third"]), (false, vec!["second"])] {
        let guards = [("first", "x - y^0.7"), ("second", "y^0.6 - x"), ("third", "t - 7.4")];
        let empty = Equations::new(&["x", "y"], &[])
            .mode_text("m", &["y/t", "y*(x + 2*y - 1)/(t*(x - 1))"]);
        let equations = guards.into_iter().fold(empty, |equations, (name, guard)| match rising {
            true => equations.rising_text(name, guard),
            false => equations.falling_text(name, guard),
        });
        let names = |model: EquationsModel<State<3>>, from: f64, to: f64| {
            let run = model.start_at("m", exact(from.abs()), (from, to)).unwrap();
            found(run).into_iter().map(|event| event.0).collect::<Vec<_>>()
        };
        assert_eq!(names(equations.model().unwrap(), 5.0, 8.0), expected);
        let mut backward = names(equations.reversed().unwrap().model().unwrap(), -8.0, -5.0);
        backward.reverse();
        assert_eq!(backward, expected);
    }
}

/// A terminal event ends the run there; the dense output goes up to it, and no further.
#[test]
fn a_terminal_event_ends_the_solution() {
    let model = rational().rising_text("last", "t - 6").stops().model::<State<3>>().unwrap();
    let run = model.start_at("m", exact(5.0), (5.0, 8.0)).unwrap().solution().unwrap();
    let (start, end) = run.times();
    assert!(start == 5.0 && (end - 6.0).abs() < 1e-12);
    for time in [5.0, 5.3, FIRST, 5.9, end] {
        let [_, (_, state)] = run.at(time).unwrap();
        let [x, y] = exact(time);
        assert!((state[0] - x).abs() < 1e-12 && (state[1] - y).abs() < 1e-12, "{time}");
    }
    assert!(run.at(6.5).is_err());
}

/// A cannon, an example of its documentation: its apex at 20, and the ground at 40.
#[test]
fn a_cannon_has_its_apex_and_its_landing() {
    let cannon = Equations::new(&["height", "speed"], &[("gravity", "0.5")])
        .mode_text("flight", &["speed", "-gravity"])
        .falling_text("apex", "speed")
        .falling_text("ground", "height")
        .stops()
        .model::<State<2>>()
        .unwrap();
    let run = cannon.start("flight", [0.0, 10.0], 100.0).unwrap().solution().unwrap();
    let events: Vec<_> =
        run.events().map(|event| (event.surface.to_string(), event.time)).collect();
    assert_eq!(events, [("apex".to_owned(), 20.0), ("ground".to_owned(), 40.0)]);
    assert_eq!(run.at(20.0).unwrap()[0].1[0], 100.0);
}
