//! Probe.
use hybrid_system::Equations;
use std::ops::ControlFlow;
use validated_dynamics::*;
fn main() -> Result<(), Error> {
    let rossler = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("section", "x");
    let system = ValidatedSystem::new(&rossler)?;
    let chart = system.chart("flow", &["y", "z"], &["0", "y", "z"])?;
    let mut run = system.start_on(&chart, &[Enclosure::from(-8.3809417428298), Enclosure::from(0.029590060630665)])?;
    let begin = std::time::Instant::now();
    let event = run.next_event_watched(&mut |piece| {
        let w: Vec<f64> = piece.states_at(Enclosure::from(0.0)).unwrap().iter().map(|x| x.width()).collect();
        println!("{:.4} h {:.4} p {} {:?}", piece.time().low, piece.length(), piece.order(), w);
        ControlFlow::Continue(())
    })?;
    println!("{:?} {}", begin.elapsed(), run.steps());
    println!("{:?} {:?}", event.time, event.before);
    let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"]);
    let ball = ValidatedSystem::new(&ball)?;
    let mut run = ball.start("flight", &["0.5", "0"])?;
    for _ in 0..5 {
        println!("{:?}", run.next_event()?);
    }
    Ok(())
}
