//! Borders of return maps: what they are, where they are, and their curves in two parameters.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use example_systems::impact_oscillator::grazing_forcing;
use hybrid_system::Equations;
use return_map::{
    Border, Branch, BranchEnd, BranchSteps, CurveEnd, EquationReturns, Error, border_curve,
    follow_behind, follow_branch, map_pieces, scalar_family,
};
use std::ops::ControlFlow::Continue;

fn followed(map: &EquationReturns, start: (&[f64], f64), window: (f64, f64)) -> Branch {
    let steps = BranchSteps { first: 0.1, longest: 0.4, ..BranchSteps::default() };
    follow_branch(map, 1, start, window, steps, |_| Continue(())).unwrap()
}

/// The border at an end, its parameter and the error of that.
fn border(end: &BranchEnd) -> (Border, f64) {
    let BranchEnd::Border { border, at, .. } = end else { panic!("{end:?}") };
    (border.clone(), at.parameter)
}

fn grazing(surface: &str) -> Border {
    Border::Grazing { surface: surface.to_owned() }
}

/// The oscillator with a stop over its frequency: the steady motion of this forcing touches the stop at two frequencies beside the
/// resonance, so near to each other that both are within one step.
fn resonance() -> EquationReturns {
    let oscillator = example_systems::impact_oscillator::impact_oscillator("0.05015").clock_text(
        "strobe",
        "2*pi/frequency",
        "2*pi/frequency",
    );
    EquationReturns::new(&oscillator, "frequency", ("free", "strobe"), &["x", "v"]).unwrap()
}

#[test]
fn two_touches_within_a_step() {
    let map = resonance();
    let steady = |w: f64| {
        let (a, b) = (1.0 - w * w, 0.1 * w);
        let square = a * a + b * b;
        [0.05015 * a / square, 0.05015 * b * w / square]
    };
    // The amplitude F/√((1 − ω²)² + ω²/100) is ½.
    let square = (0.05015f64 / 0.5).powi(2);
    let touches = [-1.0f64, 1.0].map(|side| {
        let half = 1.0 - 0.5 * 0.01;
        (half + side * (half * half - 1.0 + square).sqrt()).sqrt()
    });
    assert!(touches[1] - touches[0] < 0.02);
    for (start, end, touch) in [(0.8, 1, touches[0]), (1.2, 0, touches[1])] {
        let branch = followed(&map, (&steady(start), start), (0.7, 1.3));
        let (kind, at) = border(&branch.ends[end]);
        assert_eq!(kind, grazing("free: stop"));
        assert!((at - touch).abs() < 1e-12, "{at} {touch}");
        assert_eq!(branch.ends[1 - end], BranchEnd::Window);
    }
}

/// A throw that passes a ceiling, or does not: the next speed is p + c/10. The ceiling is at 1.
fn throw() -> EquationReturns {
    let ball = Equations::new(&["height", "speed"], &[("p", "1")])
        .mode_text("flight", &["speed", "-1"])
        .rising_text("ceiling", "height - 1")
        .falling_text("floor", "height")
        .resets_text(&["0", "p - speed/10"]);
    EquationReturns::new(&ball, "p", ("flight", "floor"), &["speed"]).unwrap()
}

#[test]
fn a_grazing_is_found_from_both_sides() {
    let touch = 0.9 * 2f64.sqrt();
    for (start, end) in [(1.0, 1), (1.7, 0)] {
        let branch = followed(&throw(), (&[start / 0.9], start), (0.5, 2.0));
        let (kind, at) = border(&branch.ends[end]);
        assert_eq!(kind, grazing("flight: ceiling"));
        assert!((at - touch).abs() < 1e-14, "{at} {touch}");
    }
}

/// On a section of one coordinate the borders of the pieces have their kinds.
#[test]
fn borders_between_pieces() {
    let map = throw();
    let found = map_pieces(&map, 1.2, (0.5, 2.5), 40).unwrap();
    assert_eq!(found.pieces.len(), 2, "{found:?}");
    assert!((found.pieces[0].ends.1 - 2f64.sqrt()).abs() < 1e-12);
    assert_eq!(found.border(&map, 0), Some(grazing("flight: ceiling")));
    assert_eq!(found.border(&map, 1), None);
}

/// An observer, which changes nothing, is touched all the same: a ball that reaches the height 1 where v²/2 = 1.
#[test]
fn an_observer_is_grazed() {
    let ball = Equations::new(&["height", "speed"], &[("p", "1")])
        .mode_text("flight", &["speed", "-1"])
        .rising_text("mark", "height - 1")
        .crossing()
        .falling_text("floor", "height")
        .resets_text(&["0", "p - speed/10"]);
    let map = EquationReturns::new(&ball, "p", ("flight", "floor"), &["speed"]).unwrap();
    let branch = followed(&map, (&[1.0 / 0.9], 1.0), (0.5, 2.0));
    let (kind, at) = border(&branch.ends[1]);
    assert_eq!(kind, grazing("flight: mark"));
    assert!((at - 0.9 * 2f64.sqrt()).abs() < 1e-12, "{at}");
}

/// From one side of a border to the other, and back to it.
#[test]
fn behind_a_border() {
    let touch = 0.9 * 2f64.sqrt();
    let steps = BranchSteps { first: 0.1, longest: 0.4, ..BranchSteps::default() };
    let window = (0.5, 2.0);
    let map = throw();
    let free = followed(&map, (&[1.0 / 0.9], 1.0), window);
    let hits = follow_behind(&map, 1, &free.ends[1], window, steps, |_| Continue(())).unwrap();
    assert!((border(&hits.ends[0]).1 - touch).abs() < 1e-12 && hits.ends[1] == BranchEnd::Window);
    assert!(hits.points.iter().all(|at| at.itinerary.len() == 2));
    let again = follow_behind(&map, 1, &hits.ends[0], window, steps, |_| Continue(())).unwrap();
    assert!((border(&again.ends[1]).1 - touch).abs() < 1e-12 && again.ends[0] == BranchEnd::Window);
    let none = follow_behind(&map, 1, &BranchEnd::Window, window, steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::OtherStart { .. })), "{none:?}");
    // An orbit that ends at its border, without another one: x ↦ p + x/2 for x < 1, and x + 1 behind.
    let ends = return_map::pieces(1, |x: &[f64], p| match x[0] < 1.0 {
        true => Ok((vec![p + 0.5 * x[0]], "left")),
        false => Ok((vec![x[0] + 1.0], "right")),
    });
    let left =
        follow_branch(&ends, 1, (&[0.5], 0.25), (0.0, 1.0), steps, |_| Continue(())).unwrap();
    let none = follow_behind(&ends, 1, &left.ends[1], (0.0, 1.0), steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::NothingBehind { .. })), "{none:?}");
}

/// A path from (c, 1) with the slope −p ends at the floor or at a wall. The next c is the part a of the place.
fn path(a: f64) -> EquationReturns {
    let path = Equations::new(&["x", "y"], &[("p", "1"), ("a", &format!("{a:?}"))])
        .mode_text("falls", &["1", "-p"])
        .falling_text("floor", "y")
        .resets_text(&["x", "1"])
        .to("back")
        .rising_text("wall", "x - 1")
        .resets_text(&["1", "1"])
        .to("back")
        .mode_text("back", &["0", "-1"])
        .falling_text("start", "y - 1/2")
        .resets_text(&["a*x", "1"])
        .to("falls");
    EquationReturns::new(&path, "p", ("falls", "start"), &["c"])
        .unwrap()
        .starting_text(&["c", "1"])
        .unwrap()
        .coordinates_text(&["x"])
        .unwrap()
}

#[test]
fn a_corner_and_its_curve() {
    let map = path(0.25);
    let corner = Border::Corner { surfaces: ["falls: floor", "falls: wall"].map(String::from) };
    let branch = followed(&map, (&[1.0 / 6.0], 2.0), (1.0, 3.0));
    let (kind, at) = border(&branch.ends[0]);
    assert_eq!(kind, corner);
    assert!((at - 4.0 / 3.0).abs() < 1e-14, "{at}");
    // In two parameters: p = 1/(1 − a).
    let steps = BranchSteps { first: 0.1, longest: 0.3, ..BranchSteps::default() };
    let windows = ((1.0, 3.0), (0.1, 0.6));
    let end = (&branch.ends[0], 0.25);
    let curve = border_curve(&path, 1, end, windows, steps, |_| Continue(())).unwrap();
    assert!(curve.points.len() > 3);
    assert_eq!(curve.ends, [CurveEnd::Window, CurveEnd::Window]);
    for found in &curve.points {
        let [p, a] = found.parameters;
        assert!((p - 1.0 / (1.0 - a)).abs() < 1e-12, "{found:?}");
    }
    // On the other side the wall comes first.
    let branch = followed(&map, (&[0.25], 1.1), (1.0, 3.0));
    assert!((border(&branch.ends[1]).1 - 4.0 / 3.0).abs() < 1e-14);
}

/// The forcing at which the stop is touched is in proportion to the place of the stop.
#[test]
fn the_curve_of_a_grazing() {
    let strobe = |stop: f64| {
        let oscillator = example_systems::impact_oscillator::impact_oscillator("0.3")
            .with_parameters(&[("stop", &format!("{stop:?}"))])
            .clock_text("strobe", "2*pi/frequency", "2*pi/frequency");
        EquationReturns::new(&oscillator, "forcing", ("free", "strobe"), &["x", "v"]).unwrap()
    };
    let [x, v, _] = example_systems::impact_oscillator::steady_start(0.3);
    let branch = followed(&strobe(0.5), (&[x, v], 0.3), (0.2, 0.9));
    let steps = BranchSteps { first: 0.1, longest: 0.4, ..BranchSteps::default() };
    let windows = ((0.1, 0.9), (0.2, 0.8));
    let curve =
        border_curve(&strobe, 1, (&branch.ends[1], 0.5), windows, steps, |_| Continue(())).unwrap();
    assert!(curve.points.len() > 3, "{curve:?}");
    for found in &curve.points {
        let [forcing, stop] = found.parameters;
        assert!((forcing - 2.0 * stop * grazing_forcing()).abs() < 1e-12, "{found:?}");
    }
}

/// Behind f = 1 a block does not come to rest any more. The next f is f/2 + p.
#[test]
fn the_onset_of_sticking() {
    let block = Equations::new(&["v", "f", "rested"], &[("p", "0.2")])
        .mode_text("slides", &["-1", "0", "0"])
        .falling_text("turns", "v")
        .only_where_text("f - 1")
        .to("back")
        .falling_text("sticks", "v")
        .only_where_text("1 - f")
        .to("rests")
        .mode_text("back", &["-1", "0", "0"])
        .falling_text("turned", "v + 1")
        .resets_text(&["0", "f", "0"])
        .to("rests")
        .mode_text("rests", &["0", "0", "1"])
        .rising_text("push", "rested - 1")
        .resets_text(&["1", "f/2 + p", "0"])
        .to("slides");
    let map = EquationReturns::new(&block, "p", ("slides", "push"), &["f"])
        .unwrap()
        .starting_text(&["1", "f", "0"])
        .unwrap();
    let sticks = Border::Sliding { surface: String::from("slides: sticks") };
    for (start, end) in [(0.3, 1), (0.8, 0)] {
        let branch = followed(&map, (&[2.0 * start], start), (0.1, 1.0));
        let (kind, at) = border(&branch.ends[end]);
        assert_eq!(kind, sticks);
        assert!((at - 0.5).abs() < 1e-12, "{at}");
        // It has no formula that goes on beyond.
        let BranchEnd::Border { at, .. } = &branch.ends[end] else { panic!() };
        let windows = ((0.1, 1.0), (0.0, 1.0));
        let none = border_curve(
            &|_| &map,
            1,
            (&branch.ends[end], 0.5),
            windows,
            BranchSteps::default(),
            |_| Continue(()),
        );
        assert!(matches!(none, Err(Error::BorderNotFollowed { .. })), "{none:?} {at:?}");
    }
}

/// A ball is dropped once in three time units: its bounces end before if 1 + 2r/(1 − r) < 3.
#[test]
fn complete_chattering() {
    let ball = Equations::new(&["height", "speed"], &[("r", "0.3")])
        .clock_text("drop", "3", "3")
        .resets_text(&["1/2", "0"])
        .to("flight")
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-r*speed"])
        .rests("rest")
        .mode_text("rest", &["0", "0"]);
    let map = EquationReturns::new(&ball, "r", ("flight", "drop"), &["height"]).unwrap();
    let branch = followed(&map, (&[0.5], 0.3), (0.1, 0.9));
    let (kind, at) = border(&branch.ends[1]);
    assert_eq!(kind, Border::Chattering { mode: String::from("flight") });
    assert!((at - 0.5).abs() < 1e-6, "{at}");
}

#[test]
fn ends_that_are_no_borders_are_refused() {
    let map = scalar_family(|x, r| r * x * (1.0 - x));
    let windows = ((0.0, 4.0), (0.0, 1.0));
    let steps = BranchSteps::default();
    let none =
        border_curve(&|_| &map, 1, (&BranchEnd::Window, 0.5), windows, steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::OtherStart { .. })));
}
