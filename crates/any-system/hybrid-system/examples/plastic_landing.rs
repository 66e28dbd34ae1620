//! Two masses on a spring that land without a bounce, stay on the floor, and lift off. This is the model of issue
//! 647 of `DifferentialEquations.jl`, whose program crashed.
//!
//! Contact is a mode. It lasts as long as the force of the floor is positive, and ends where that force vanishes. At
//! that instant the lower mass has neither velocity nor acceleration. Therefore it leaves the floor like t³.
//!
//! Run with `cargo run -p hybrid-system --example plastic_landing`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)] // a program whose last bits may differ by machine

use hybrid_system::*;
use nalgebra::Vector4;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Flight,
    Contact,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    /// The lower mass reaches the floor.
    Landing,
    /// The force of the floor vanishes.
    LiftOff,
}

/// Masses on a spring over a floor at height 0. State: heights x₁ < x₂ and velocities v₁, v₂, in SI units.
struct Masses {
    gravity: f64,
    stiffness: f64,
    length: f64,
    lower: f64,
    upper: f64,
}

impl Masses {
    fn mass(&self) -> f64 {
        self.lower + self.upper
    }

    /// ω of the spring with both masses free.
    fn free_frequency(&self) -> f64 {
        (self.stiffness * self.mass() / (self.lower * self.upper)).sqrt()
    }

    /// ω of the spring with the lower mass on the floor.
    fn held_frequency(&self) -> f64 {
        (self.stiffness / self.upper).sqrt()
    }

    /// Height of the upper mass at rest, with the lower mass on the floor.
    fn balance(&self) -> f64 {
        self.length - self.upper * self.gravity / self.stiffness
    }

    /// Force of the floor on the lower mass while that mass is on it.
    fn force(&self, x: &State<4>) -> f64 {
        self.lower * self.gravity - self.stiffness * (x[1] - x[0] - self.length)
    }
}

impl HybridSystem for Masses {
    type State = State<4>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, x: &State<4>, t: f64) -> State<4> {
        match mode {
            Mode::Flight => {
                // The centre of mass falls freely, and the masses oscillate about it.
                let center = (x[0] * self.lower + x[1] * self.upper) / self.mass();
                let drift = (x[2] * self.lower + x[3] * self.upper) / self.mass();
                let (stretch, rate) = (x[1] - x[0] - self.length, x[3] - x[2]);
                let omega = self.free_frequency();
                let (sin, cos) = (omega * t).sin_cos();
                let height = center + t * (drift - 0.5 * self.gravity * t);
                let speed = drift - self.gravity * t;
                let length = self.length + stretch * cos + rate / omega * sin;
                let opening = rate * cos - stretch * omega * sin;
                let (below, above) = (self.upper / self.mass(), self.lower / self.mass());
                Vector4::new(
                    height - below * length,
                    height + above * length,
                    speed - below * opening,
                    speed + above * opening,
                )
            }
            Mode::Contact => {
                let omega = self.held_frequency();
                let (sin, cos) = (omega * t).sin_cos();
                let off = x[1] - self.balance();
                let upper = self.balance() + off * cos + x[3] / omega * sin;
                Vector4::new(0.0, upper, 0.0, x[3] * cos - off * omega * sin)
            }
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        match mode {
            Mode::Flight => const { &[Guard::falling(Surface::Landing)] },
            Mode::Contact => const { &[Guard::falling(Surface::LiftOff)] },
        }
    }

    fn guard_value(&self, surface: Surface, x: &State<4>) -> f64 {
        match surface {
            Surface::Landing => x[0],
            Surface::LiftOff => self.force(x),
        }
    }

    /// Both guards are quasi-polynomials: their crossings are certain.
    fn guard_quasi_polynomial(
        &self,
        _: Mode,
        surface: Surface,
        x: &State<4>,
    ) -> Option<QuasiPolynomial> {
        Some(match surface {
            Surface::Landing => {
                // x₁ = center − m₂/m · (length + stretch)
                let share = self.upper / self.mass();
                let (stretch, rate) = (x[1] - x[0] - self.length, x[3] - x[2]);
                let omega = self.free_frequency();
                let drift = x[2] + share * rate;
                QuasiPolynomial::polynomial(&[x[0] + share * stretch, drift, -0.5 * self.gravity])
                    - QuasiPolynomial::cosine(share * stretch, omega)
                    - QuasiPolynomial::sine(share * rate / omega, omega)
            }
            Surface::LiftOff => {
                let omega = self.held_frequency();
                let off = x[1] - self.balance();
                let weight = self.mass() * self.gravity;
                QuasiPolynomial::polynomial(&[weight])
                    - QuasiPolynomial::cosine(self.stiffness * off, omega)
                    - QuasiPolynomial::sine(self.stiffness * x[3] / omega, omega)
            }
        })
    }

    fn reset(&self, _: Mode, surface: Surface, x: &State<4>) -> Reset<Mode, State<4>> {
        let landed = Vector4::new(0.0, x[1], 0.0, x[3]);
        match surface {
            // The spring pulls harder than the weight: the mass lifts off again at once.
            Surface::Landing if self.force(&landed) <= 0.0 => {
                Reset::Jump { mode: Mode::Flight, state: landed }
            }
            Surface::Landing => Reset::Jump { mode: Mode::Contact, state: landed },
            Surface::LiftOff => {
                // The height at which the force is exactly zero.
                let upper = self.length + self.lower * self.gravity / self.stiffness;
                Reset::Jump { mode: Mode::Flight, state: Vector4::new(0.0, upper, 0.0, x[3]) }
            }
        }
    }
}

const ISSUE_647: Masses =
    Masses { gravity: 9.8, stiffness: 500.0, length: 1.0, lower: 1.0, upper: 1.0 };

fn main() -> Result<(), Error> {
    let start = Vector4::new(5.0, 6.0, 0.0, 0.0);
    for arc in Execution::new(&ISSUE_647, Mode::Flight, start, Limits::new(5.0, 100)) {
        let arc = arc?;
        let end = arc.state(&ISSUE_647, arc.duration)?;
        println!(
            "{:>8?} from {:.9} for {:.9} s, ends at heights {:.6}, {:.6} m",
            arc.mode, arc.time, arc.duration, end[0], end[1]
        );
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::excessive_precision)]
mod tests {
    use super::*;

    /// The published answers have thirty digits; here they are rounded.
    #[test]
    fn times_and_states_are_those_of_sciml_647() {
        let start = Vector4::new(5.0, 6.0, 0.0, 0.0);
        let arcs: Vec<_> = Execution::new(&ISSUE_647, Mode::Flight, start, Limits::new(5.0, 4))
            .collect::<Result<_, _>>()
            .unwrap();
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
        let [fall, contact, hop, _] = arcs[..] else { unreachable!() };
        close(fall.duration, 1.01015254455221075);
        close(fall.event().unwrap().before[2], -9.89949493661166534);
        assert_eq!(contact.mode, Mode::Contact);
        close(contact.duration, 0.146436001872528801);
        close(hop.time, 1.15658854642473955);
        close(hop.start[1], 1.0196);
        close(hop.start[3], 9.8703475116127497);
        close(hop.time + hop.duration, 2.15693455833089148);
        close(hop.event().unwrap().before[2], -9.61984490010233);
        // The lower mass leaves the floor like t³.
        let just_after = hop.state(&ISSUE_647, 1e-4).unwrap()[0];
        assert!((just_after / 8.22488e-10 - 1.0).abs() < 1e-5, "{just_after:e}");
        let shortest = (0..=1000)
            .map(|k| {
                contact.state(&ISSUE_647, contact.duration * f64::from(k) / 1000.0).unwrap()[1]
            })
            .fold(f64::INFINITY, f64::min);
        assert!((shortest - 0.537247475466967).abs() < 1e-5);
    }

    /// At rest on the floor the masses stay there for ever.
    #[test]
    fn masses_at_rest_stay_in_contact() {
        let rest = Vector4::new(0.0, ISSUE_647.balance(), 0.0, 0.0);
        let mut execution = Execution::new(&ISSUE_647, Mode::Contact, rest, Limits::new(1e4, 100));
        let arc = execution.next().unwrap().unwrap();
        assert!(matches!(arc.end, ArcEnd::TimeLimit { .. }));
        assert_eq!(arc.mode, Mode::Contact);
        assert!(execution.next().is_none());
    }

    /// Energy is lost at landings only.
    #[test]
    fn energy_is_lost_at_landings_only() {
        let energy = |x: &State<4>| {
            let h = &ISSUE_647;
            let stretch = x[1] - x[0] - h.length;
            0.5 * (h.lower * x[2] * x[2] + h.upper * x[3] * x[3] + h.stiffness * stretch * stretch)
                + h.gravity * (h.lower * x[0] + h.upper * x[1])
        };
        let start = Vector4::new(0.3, 1.5, 1.0, -2.0);
        for arc in Execution::new(&ISSUE_647, Mode::Flight, start, Limits::new(20.0, 200)) {
            let arc = arc.unwrap();
            let end = arc.state(&ISSUE_647, arc.duration).unwrap();
            assert!((energy(&end) / energy(&arc.start) - 1.0).abs() < 1e-12);
            if let Some((_, after)) = arc.event().and_then(|event| event.after) {
                assert!(energy(&after) <= energy(&end) * (1.0 + 1e-12));
            }
        }
    }
}
