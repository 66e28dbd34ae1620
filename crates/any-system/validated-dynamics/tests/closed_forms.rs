//! Flows and events hold what closed forms say.

use crate::models::oscillator;
use hybrid_system::Equations;
use proptest::prelude::*;
use std::ops::ControlFlow;
use validated_dynamics::{
    EnclosedMap, Enclosure, Matrix, SectionMap, ValidatedSystem, fixed_point,
};

/// Closed forms are computed with some roundings.
fn holds(found: Enclosure, exact: f64) -> bool {
    found.widened(4e-15 * (1.0 + exact.abs())).contains(exact)
}

fn entry(matrix: &Matrix, row: usize, column: usize) -> Enclosure {
    matrix.get(row, column).unwrap()
}

#[test]
fn a_ball_bounces_at_the_times_of_its_series() {
    let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"]);
    let ball = ValidatedSystem::new(&ball).unwrap();
    let mut run = ball.start("flight", &["0.5", "0"]).unwrap();
    for exact in [1.0, 2.0, 2.5, 2.75, 2.875] {
        let event = run.next_event().unwrap();
        assert!(event.time.contains(exact) && event.time.width() < 1e-13, "{:?}", event.time);
        assert!(event.before[0].contains(0.0));
    }
}

#[test]
fn a_ball_bounces_at_an_interval_of_restitutions() {
    let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"]);
    let ball = ValidatedSystem::with_interval_parameters(&ball, &["restitution"]).unwrap();
    let chart = ball.chart("flight", &["r"], &["0.5", "0", "r"]).unwrap();
    let mut run = ball.start_on(&chart, &[Enclosure::new(0.49, 0.51)]).unwrap();
    run.next_event().unwrap();
    let second = run.next_event().unwrap();
    // The second flight takes 2e, and ends with the speed −e.
    assert!(second.time.contains(1.98) && second.time.contains(2.02));
    assert!(second.time.width() < 0.045);
    let slope = entry(&second.derivatives().unwrap(), 1, 0);
    // The speed after it is e², with the derivative 2e.
    assert!(slope.contains(0.98) && slope.contains(1.02) && slope.width() < 0.3, "{slope:?}");
}

#[test]
fn an_oscillator_comes_back_after_a_turn_whatever_its_speed() {
    let system = ValidatedSystem::new(&oscillator().rising_text("section", "x")).unwrap();
    let chart = system.chart("flow", &["v"], &["0", "v"]).unwrap();
    for radius in [0.0, 1e-6, 1e-3, 0.1] {
        let mut run = system.start_on(&chart, &[Enclosure::around(1.0, radius)]).unwrap();
        let event = run.next_event().unwrap();
        assert!(event.time.contains(2.0 * std::f64::consts::PI), "{:?}", event.time);
        assert!(event.before[1].contains(1.0) && event.before[1].width() < 2.1 * radius + 1e-13);
        let slope = entry(&event.derivatives().unwrap(), 1, 0);
        assert!(slope.contains(1.0), "{slope:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    /// ẋ = x(1 − x) has x = 1/(1 + (1/x₀ − 1) e^−t), and ∂x/∂x₀ = e^−t x²/x₀².
    #[test]
    fn growth_follows_the_logistic_curve(start in 0.05..0.95f64, radius in 0.0..0.02f64, time in 0.1..6.0f64) {
        let growth = Equations::new(&["x"], &[]).mode_text("flow", &["x*(1 - x)"]);
        let system = ValidatedSystem::new(&growth).unwrap();
        let domain = Enclosure::new(start - radius, start + radius);
        let mut run = system.start_box("flow", &[domain]).unwrap();
        run.advance(Enclosure::from(time)).unwrap();
        let decay = interval_arithmetic::exp(-time);
        for x in [domain.low(), start, domain.high()] {
            let exact = 1.0 / (1.0 + (1.0 / x - 1.0) * decay);
            prop_assert!(holds(run.set().hull()[0], exact));
            let slope = decay * (exact / x) * (exact / x);
            prop_assert!(holds(entry(&run.derivatives().unwrap(), 0, 0), slope));
        }
    }

    /// A damped oscillator with a force, against its solution: x = e^−dt (…) for ẍ + 2dẋ + (d² + w²) x = 0.
    #[test]
    fn a_damped_oscillator_spirals(w in 0.5..3.0f64, d in -0.2..0.5f64, x in -1.0..1.0f64, v in -1.0..1.0f64, time in 0.1..5.0f64) {
        let numbers = [("a", format!("{}", 2.0 * d)), ("b", format!("{}", d * d + w * w))];
        let numbers: Vec<(&str, &str)> = numbers.iter().map(|(k, v)| (*k, v.as_str())).collect();
        let damped = Equations::new(&["x", "v"], &numbers).mode_text("flow", &["v", "-a*v - b*x"]);
        let system = ValidatedSystem::new(&damped).unwrap();
        let mut run = system.start_box("flow", &[Enclosure::from(x), Enclosure::from(v)]).unwrap();
        run.advance(Enclosure::from(time)).unwrap();
        let (sine, cosine) = (pxfm_sin(w * time), pxfm_sin(w * time + std::f64::consts::FRAC_PI_2));
        let decay = interval_arithmetic::exp(-d * time);
        let exact = decay * (x * cosine + (v + d * x) / w * sine);
        prop_assert!(run.set().hull()[0].widened(1e-13).contains(exact), "{:?} {}", run.set().hull()[0], exact);
        prop_assert!(run.set().hull()[0].width() < 1e-12);
    }

    /// Each step holds the states at its inner times.
    #[test]
    fn steps_hold_the_states_between_their_ends(x in 0.2..2.0f64, part in 0.0..1.0f64) {
        let system = ValidatedSystem::new(&oscillator().falling_text("turn", "v + 100")).unwrap();
        let mut run = system.start_box("flow", &[Enclosure::from(x), Enclosure::ZERO]).unwrap();
        let mut steps = 0;
        let ended = run.next_event_watched(&mut |piece| {
            let inside = part * piece.length();
            let states = piece.states_at(Enclosure::from(inside)).unwrap();
            let exact = x * pxfm_sin(piece.time().low() + inside + std::f64::consts::FRAC_PI_2);
            assert!(states[0].widened(1e-12).contains(exact));
            assert!(piece.states_at(Enclosure::new(0.0, piece.length())).unwrap()[0].contains(exact));
            assert!(piece.states_at(Enclosure::from(2.0 * piece.length())).is_none());
            steps += 1;
            if steps == 12 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        prop_assert!(ended.is_err());
        prop_assert_eq!(steps, 12);
    }
}

fn pxfm_sin(x: f64) -> f64 {
    Enclosure::from(x).sin().middle()
}

/// At rest no term of the solution tells a length of steps.
#[test]
fn a_state_of_rest_stays_and_its_neighbours_are_linear() {
    let damped = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "-x - v"])
        .rising_text("later", "t - 5");
    let system = ValidatedSystem::new(&damped).unwrap();
    let chart = system.chart("flow", &["x", "v"], &["x", "v", "0"]).unwrap();
    let map = SectionMap::new(&system, chart, "later", 1, &["x", "v"]).unwrap();
    let image = map.image(&[Enclosure::ZERO, Enclosure::ZERO]).unwrap();
    assert!(image.values.iter().all(|x| x.magnitude() < 1e-200), "{:?}", image.values);
    let rest = fixed_point(&map, &[0.0, 0.0], &[]).unwrap();
    assert!(rest.is_attracting() && rest.point[0].contains(0.0));
    // e^(-5/2) at an angle of 5 √3/2.
    let multiplier = &rest.multipliers[0];
    let size = pxfm::f_hypot(multiplier.real, multiplier.imaginary);
    assert!(
        multiplier.radius < 1e-6 && (size - 0.082_084_998_623_898_8).abs() <= multiplier.radius
    );
}
