//! Stick and slip: a mass on a spring, on a moving belt with dry friction.
//!
//! ```text
//!   wall ──/\/\/──[ mass ]          x″ = −x + F(v − x′)
//!              ═══════════════ →    the belt moves with the speed v
//! ```
//!
//! The friction pulls the mass towards the speed of the belt with the force 1/(1 + 3|v − x′|). At equal speeds the
//! fields of both sides point at the surface x′ = v while |x| < 1: the mass sticks, and moves with the belt. The
//! spring lets it go at x = 1. This is the stick-slip system of Leine (2024), with v = 0.2.
//!
//! Run with `cargo run -p hybrid-system --features ode --example dry_friction`.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::*;

/// The mass compared with the belt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mass {
    Slower,
    Faster,
}

/// The mass on a belt of this speed. State: position and speed of the mass.
fn belt(speed: f64) -> Filippov<impl System<State<2>, Mass, usize>> {
    let friction = |slip: f64| 1.0 / (1.0 + 3.0 * slip);
    let model = Model::integrated(move |mass, x: &State<2>| match mass {
        Mass::Slower => [x[1], -x[0] + friction(speed - x[1])],
        Mass::Faster => [x[1], -x[0] - friction(x[1] - speed)],
    })
    .tolerance(1e-12)
    .rising(Mass::Slower, move |x| x[1] - speed, |x| (Mass::Faster, *x))
    .falling(Mass::Faster, move |x| x[1] - speed, |x| (Mass::Slower, *x));
    Filippov::new(model, Tolerances::both(1e-12))
}

fn main() -> Result<(), Error> {
    let belt = belt(0.2);
    let start = State::<2>::new(0.0, 0.0);
    let limits = Limits::new(40.0, 100);
    for arc in Execution::new(&belt, FilippovMode::Free(Mass::Slower), start, limits) {
        let arc = arc?;
        // The events that lead into and out of sticking take no time.
        if arc.duration == 0.0 {
            continue;
        }
        let phase = match arc.mode {
            FilippovMode::Free(_) => "slips",
            FilippovMode::Sliding { .. } => "sticks",
        };
        let end = arc.state(&belt, arc.duration)?;
        println!(
            "t = {:7.4}: the mass {phase:6} for {:.10}, from x = {:+.10} to {:+.10}",
            arc.time, arc.duration, arc.start[0], end[0]
        );
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The mass sticks from x₁ to 1 for (1 − x₁)/v. The period is from a program that shares no code with this one:
    /// classical Runge–Kutta steps of 5·10⁻⁴ for the slip.
    #[test]
    fn the_mass_is_released_at_one_and_the_cycle_has_its_period() {
        const PERIOD: f64 = 12.001_031_294_83;
        let belt = belt(0.2);
        let start = State::<2>::new(0.0, 0.0);
        let arcs: Vec<_> =
            Execution::new(&belt, FilippovMode::Free(Mass::Slower), start, Limits::new(60.0, 100))
                .collect::<Result<_, _>>()
                .unwrap();
        let sticks: Vec<_> =
            arcs.iter().filter(|arc| matches!(arc.mode, FilippovMode::Sliding { .. })).collect();
        assert!(sticks.len() >= 4);
        for stick in &sticks[..3] {
            let release = stick.event().unwrap();
            assert!((release.before[0] - 1.0).abs() < 1e-12, "{}", release.before);
            assert!((stick.duration - (1.0 - stick.start[0]) / 0.2).abs() < 1e-11);
        }
        let period = sticks[3].time - sticks[2].time;
        assert!((period - PERIOD).abs() < 2e-11, "{period}");
    }

    /// On a belt at rest the mass comes to rest: each half swing moves the turning point inwards, and the mass
    /// stops for ever where the spring is too weak.
    #[test]
    fn on_a_belt_at_rest_the_mass_stops() {
        let belt = belt(0.0);
        let start = State::<2>::new(3.0, 0.0);
        let mut execution = Execution::new(
            &belt,
            FilippovMode::Free(Mass::Slower),
            start,
            Limits::new(1000.0, 100),
        );
        let last = (&mut execution).map(|arc| arc.unwrap()).last().unwrap();
        assert_eq!(execution.stop(), Some(Stop::TimeLimit));
        assert!(matches!(last.mode, FilippovMode::Sliding { .. }));
        assert!(last.start[0].abs() < 1.0);
        assert_eq!(last.state(&belt, last.duration).unwrap()[0], last.start[0]);
    }
}
