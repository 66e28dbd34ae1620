//! A ball that bounces with any restitution, and rests after the Zeno limit of its bounces.
//!
//! Rest is a separate mode: the floor carries the ball as long as its force is positive. A fixed floor carries the ball
//! for ever. A table that shakes with more than the acceleration of gravity throws the ball.
//!
//! Run with `cargo run -p hybrid-system --example bouncing_ball`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)] // a program whose last bits may differ by machine

use hybrid_system::*;
use nalgebra::Vector3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Air,
    OnTable,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    /// The ball reaches the table.
    Impact,
    /// The force of the table vanishes.
    Release,
}

/// A ball over a table at height −A sin φ, φ̇ = ω. State: height, velocity, φ.
#[derive(Debug, Clone, Copy)]
struct Ball {
    gravity: f64,
    restitution: f64,
    /// A.
    amplitude: f64,
    /// ω.
    frequency: f64,
}

impl Ball {
    fn over_floor(gravity: f64, restitution: f64) -> Self {
        Ball { gravity, restitution, amplitude: 0.0, frequency: 1.0 }
    }

    /// Height and velocity of the table.
    fn table(&self, phase: f64) -> (f64, f64) {
        let (sin, cos) = phase.sin_cos();
        (-self.amplitude * sin, -self.amplitude * self.frequency * cos)
    }
}

impl HybridSystem for Ball {
    type State = State<3>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, x: &State<3>, t: f64) -> State<3> {
        let phase = x[2] + self.frequency * t;
        match mode {
            Mode::Air => {
                let height = x[0] + t * (x[1] - 0.5 * self.gravity * t);
                Vector3::new(height, x[1] - self.gravity * t, phase)
            }
            Mode::OnTable => {
                let (height, velocity) = self.table(phase);
                Vector3::new(height, velocity, phase)
            }
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        match mode {
            Mode::Air => const { &[Guard::falling(Surface::Impact)] },
            Mode::OnTable => const { &[Guard::falling(Surface::Release)] },
        }
    }

    fn guard_value(&self, surface: Surface, x: &State<3>) -> f64 {
        match surface {
            Surface::Impact => x[0] - self.table(x[2]).0,
            // Force over mass: gravity plus the acceleration of the table, Aω² sin φ.
            Surface::Release => self.gravity + self.amplitude * self.frequency.powi(2) * x[2].sin(),
        }
    }

    fn guard_quasi_polynomial(
        &self,
        _: Mode,
        surface: Surface,
        x: &State<3>,
    ) -> Option<QuasiPolynomial> {
        let (sin, cos) = x[2].sin_cos();
        // sin(φ₀ + ωt)
        let shake = QuasiPolynomial::sine(cos, self.frequency)
            + QuasiPolynomial::cosine(sin, self.frequency);
        Some(match surface {
            Surface::Impact => {
                QuasiPolynomial::polynomial(&[x[0], x[1], -0.5 * self.gravity])
                    + shake.scaled(self.amplitude)
            }
            Surface::Release => {
                QuasiPolynomial::polynomial(&[self.gravity])
                    + shake.scaled(self.amplitude * self.frequency.powi(2))
            }
        })
    }

    fn reset(&self, _: Mode, surface: Surface, x: &State<3>) -> Reset<Mode, State<3>> {
        let (height, velocity) = self.table(x[2]);
        let rebound = velocity - self.restitution * (x[1] - velocity);
        match surface {
            Surface::Impact if rebound > velocity => {
                Reset::Jump { mode: Mode::Air, state: Vector3::new(height, rebound, x[2]) }
            }
            Surface::Impact => {
                // Without a rebound the table carries the ball, unless the table itself falls faster than gravity.
                let carried = self.guard_value(Surface::Release, x) > 0.0;
                let mode = if carried { Mode::OnTable } else { Mode::Air };
                Reset::Jump { mode, state: Vector3::new(height, velocity, x[2]) }
            }
            Surface::Release => {
                Reset::Jump { mode: Mode::Air, state: Vector3::new(height, velocity, x[2]) }
            }
        }
    }

    fn rest(&self, _: Mode, limit: &State<3>) -> Option<(Mode, State<3>)> {
        let (height, velocity) = self.table(limit[2]);
        Some((Mode::OnTable, Vector3::new(height, velocity, limit[2])))
    }
}

fn main() -> Result<(), Error> {
    println!("dropped from 1 under gravity 9.81");
    println!("{:>11} {:>8} {:>20} {:>20}", "restitution", "bounces", "at rest after", "exactly");
    for restitution in [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99] {
        let ball = Ball::over_floor(9.81, restitution);
        let start = Vector3::new(1.0, 0.0, 0.0);
        let mut bounces = 0;
        for arc in Execution::new(&ball, Mode::Air, start, Limits::new(1000.0, 100_000)) {
            let arc = arc?;
            bounces += usize::from(arc.event().is_some());
            if arc.mode == Mode::OnTable {
                let exact = (2.0f64 / 9.81).sqrt() * (1.0 + restitution) / (1.0 - restitution);
                println!("{restitution:>11} {bounces:>8} {:>20.15} {exact:>20.15}", arc.time);
            }
        }
    }
    println!("on a table that shakes with 1.2 times gravity");
    let ball = Ball { gravity: 1.0, restitution: 0.0, amplitude: 1.2, frequency: 1.0 };
    for arc in Execution::new(&ball, Mode::OnTable, Vector3::zeros(), Limits::new(20.0, 100)) {
        let arc = arc?;
        println!("{:>8?} from {:.6} to {:.6}", arc.mode, arc.time, arc.time + arc.duration);
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::*;

    fn arcs(
        ball: &Ball,
        mode: Mode,
        start: State<3>,
        time: f64,
    ) -> Vec<Arc<Mode, Surface, State<3>>> {
        Execution::new(ball, mode, start, Limits::new(time, 100_000))
            .collect::<Result<_, _>>()
            .unwrap()
    }

    #[test]
    fn a_ball_of_any_restitution_comes_to_rest_at_its_time() {
        for restitution in [0.0, 0.05, 0.3, 0.5, 0.7, 0.9, 0.99] {
            let ball = Ball::over_floor(2.0, restitution);
            let arcs = arcs(&ball, Mode::Air, Vector3::new(1.0, 0.0, 0.0), 1e6);
            let last = arcs.last().unwrap();
            assert!(matches!(last.end, ArcEnd::TimeLimit { .. }));
            assert_eq!(last.mode, Mode::OnTable);
            let exact = (1.0 + restitution) / (1.0 - restitution);
            assert!((last.time / exact - 1.0).abs() < 1e-12, "{restitution}: {}", last.time);
            let end = last.state(&ball, last.duration).unwrap();
            assert_eq!((end[0], end[1].abs()), (0.0, 0.0));
        }
        let ball = Ball::over_floor(2.0, 1.0);
        let arcs = arcs(&ball, Mode::Air, Vector3::new(1.0, 0.0, 0.0), 1000.0);
        assert_eq!(arcs.len(), 501);
    }

    /// The table carries the ball up to sin φ = −g/Aω², throws it, and catches it again.
    #[test]
    fn a_shaking_table_throws_the_ball() {
        let ball = Ball { gravity: 1.0, restitution: 0.0, amplitude: 1.2, frequency: 1.0 };
        let arcs = arcs(&ball, Mode::OnTable, Vector3::zeros(), 40.0);
        let release = std::f64::consts::PI + (1.0f64 / 1.2).asin();
        assert!((arcs[0].duration - release).abs() < 1e-14);
        for pair in arcs.windows(2) {
            assert_ne!(pair[0].mode, pair[1].mode);
        }
        // In the air the ball is never below the table.
        for arc in arcs.iter().filter(|arc| arc.mode == Mode::Air) {
            for k in 0..=100 {
                let state = arc.state(&ball, arc.duration * f64::from(k) / 100.0).unwrap();
                assert!(ball.guard_value(Surface::Impact, &state) > -1e-14);
            }
        }
        // A table that shakes with less than gravity never throws it.
        let ball = Ball { amplitude: 0.999, ..ball };
        let arcs = self::arcs(&ball, Mode::OnTable, Vector3::zeros(), 1000.0);
        assert_eq!(arcs.len(), 1);
    }
}
