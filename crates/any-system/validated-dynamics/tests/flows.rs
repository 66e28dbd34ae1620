//! Flows and events against closed forms.

use hybrid_system::Equations;
use validated_dynamics::{Enclosure, ValidatedSystem};

fn ball() -> Equations {
    Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"])
}

#[test]
fn a_ball_bounces_at_the_times_of_its_series() {
    let ball = ValidatedSystem::new(&ball()).unwrap();
    let mut run = ball.start("flight", &["0.5", "0"]).unwrap();
    for exact in [1.0, 2.0, 2.5, 2.75, 2.875] {
        let event = run.next_event().unwrap();
        assert!(event.time.contains(exact) && event.time.width() < 1e-13, "{:?}", event.time);
        assert!(event.before[0].contains(0.0));
    }
}

#[test]
fn an_oscillator_comes_back_after_a_turn() {
    let oscillator = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "-x"])
        .rising_text("section", "x");
    let system = ValidatedSystem::new(&oscillator).unwrap();
    let chart = system.chart("flow", &["v"], &["0", "v"]).unwrap();
    let mut run = system.start_on(&chart, &[Enclosure::new(0.9, 1.1)]).unwrap();
    let event = run.next_event().unwrap();
    assert!(event.time.contains(2.0 * std::f64::consts::PI), "{:?}", event.time);
    println!("{event:?} {}", run.steps());
    assert!(event.time.width() < 1e-10);
    assert!((event.before[1].width() - 0.2).abs() < 1e-6);
}
