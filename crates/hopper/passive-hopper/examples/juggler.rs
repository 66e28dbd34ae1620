//! A passive juggler (Chatterjee, Pratap, Reddy, Ruina 2002): a hand on a spring catches a ball without a bounce and
//! throws it again.
//!
//! The model has hand, ball, spring and gravity in SI units, two modes and two guards, and uses no formula of the
//! hopper. Nevertheless its map from one throw to the next is the map of the hopper: α′ = f(α; M) with M = m_h/m_b,
//! where α is the speed of the throw over g √(m_h/k).
//!
//! Run with `cargo run -p passive-hopper --example juggler`.
//!
//! Proof of the equivalence: docs/theory.md, Lemma 53.

#![allow(clippy::print_stdout, clippy::disallowed_methods)] // a program, and its last bits do not matter

use hybrid_system::*;
use nalgebra::{SVector, Vector1, Vector4};
use passive_hopper::{LiftOffMap, MassRatio};
use return_map::{ReturnMap, Section};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// The ball is in the air.
    Free,
    /// The ball lies in the hand.
    Held,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    /// The ball comes down on the hand.
    Catch,
    /// The hand's force on the ball vanishes.
    Throw,
}

/// Parameters in SI units. A state is (y, z, ẏ, ż): the height y of the hand above its rest without the ball, the
/// height z of the ball, and their velocities.
#[derive(Debug, Clone, Copy)]
struct Juggler {
    hand: f64,
    ball: f64,
    stiffness: f64,
    gravity: f64,
}

impl Juggler {
    fn free_frequency(&self) -> f64 {
        (self.stiffness / self.hand).sqrt()
    }

    fn held_frequency(&self) -> f64 {
        (self.stiffness / (self.hand + self.ball)).sqrt()
    }

    /// Height at which the hand rests with the ball in it.
    fn held_rest(&self) -> f64 {
        -self.ball * self.gravity / self.stiffness
    }

    /// Height at which the spring is relaxed. Hand and ball fall freely there, and the ball leaves the hand.
    fn throw_height(&self) -> f64 {
        self.hand * self.gravity / self.stiffness
    }

    /// The unit of speed, g √(m_h/k).
    fn speed(&self) -> f64 {
        self.gravity / self.free_frequency()
    }
}

impl HybridSystem for Juggler {
    type State = State<4>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, x: &State<4>, t: f64) -> State<4> {
        let swing = |omega: f64, offset: f64, rate: f64| {
            let (sin, cos) = (omega * t).sin_cos();
            (offset * cos + rate / omega * sin, rate * cos - offset * omega * sin)
        };
        match mode {
            Mode::Free => {
                let (y, v) = swing(self.free_frequency(), x[0], x[2]);
                let z = x[1] + t * (x[3] - 0.5 * self.gravity * t);
                Vector4::new(y, z, v, x[3] - self.gravity * t)
            }
            Mode::Held => {
                let (y, v) = swing(self.held_frequency(), x[0] - self.held_rest(), x[2]);
                let y = y + self.held_rest();
                Vector4::new(y, y, v, v)
            }
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        match mode {
            Mode::Free => const { &[Guard::falling(Surface::Catch)] },
            Mode::Held => const { &[Guard::rising(Surface::Throw)] },
        }
    }

    fn guard_value(&self, surface: Surface, x: &State<4>) -> f64 {
        match surface {
            Surface::Catch => x[1] - x[0],
            Surface::Throw => x[0] - self.throw_height(),
        }
    }

    fn guard_quasi_polynomial(
        &self,
        _: Mode,
        surface: Surface,
        x: &State<4>,
    ) -> Option<QuasiPolynomial> {
        Some(match surface {
            Surface::Catch => {
                let omega = self.free_frequency();
                QuasiPolynomial::polynomial(&[x[1], x[3], -0.5 * self.gravity])
                    - QuasiPolynomial::cosine(x[0], omega)
                    - QuasiPolynomial::sine(x[2] / omega, omega)
            }
            Surface::Throw => {
                let omega = self.held_frequency();
                QuasiPolynomial::polynomial(&[self.held_rest() - self.throw_height()])
                    + QuasiPolynomial::cosine(x[0] - self.held_rest(), omega)
                    + QuasiPolynomial::sine(x[2] / omega, omega)
            }
        })
    }

    fn reset(&self, _: Mode, surface: Surface, x: &State<4>) -> Reset<Mode, State<4>> {
        match surface {
            Surface::Catch => {
                let speed = (self.ball * x[3] + self.hand * x[2]) / (self.ball + self.hand);
                // Above the height of the throw the hand falls faster than the ball: the ball leaves at once.
                let mode = if x[0] < self.throw_height() { Mode::Held } else { Mode::Free };
                Reset::Jump { mode, state: Vector4::new(x[0], x[0], speed, speed) }
            }
            Surface::Throw => {
                let height = self.throw_height();
                let state = Vector4::new(height, height, x[2], x[2]);
                Reset::Jump { mode: Mode::Free, state }
            }
        }
    }
}

/// The section of throws, with α as its coordinate.
struct Throws(Juggler);

impl Section<Juggler, 4, 1> for Throws {
    fn point(&self, alpha: &SVector<f64, 1>) -> (Mode, State<4>) {
        let (height, speed) = (self.0.throw_height(), alpha[0] * self.0.speed());
        (Mode::Free, Vector4::new(height, height, speed, speed))
    }
    fn coordinates(&self, event: &Event<Mode, Surface, State<4>>) -> Option<SVector<f64, 1>> {
        let (_, state) = event.after.filter(|_| event.surface == Surface::Throw)?;
        Some(Vector1::new(state[2] / self.0.speed()))
    }
}

/// The α of the throw after a throw with `alpha`; `None` if the ball stays in the hand.
fn next_throw(juggler: Juggler, alpha: f64) -> Result<Option<f64>, return_map::Error> {
    let section = Throws(juggler);
    // A flight takes about 2α units of time. The ball stays in the hand for less than a swing of both, 2π √(1 +
    // m_b/m_h) units. The limit is far above these times.
    let unit = 1.0 / juggler.free_frequency();
    let limits = Limits::new((10.0 * alpha + 1000.0) * unit, 10_000);
    let map = ReturnMap::new(&juggler, &section, limits);
    match map.image(alpha) {
        Err(return_map::Error::NoReturn { stop: Stop::TimeLimit, .. }) => Ok(None),
        image => image,
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let juggler = Juggler { hand: 0.3, ball: 0.5, stiffness: 80.0, gravity: 9.81 };
    let map = LiftOffMap::new(MassRatio::new(juggler.hand / juggler.ball)?);
    println!("{:>6} {:>20} {:>20}", "α", "juggler", "hopper");
    for alpha in [0.7, 2.0, 4.0, 4.6, 6.0, 8.0, 12.0] {
        let shown = |image: Option<f64>| {
            image.map_or("stays in the hand".into(), |alpha| format!("{alpha:.14}"))
        };
        let (own, hopper) = (shown(next_throw(juggler, alpha)?), shown(map.image(alpha)?));
        println!("{alpha:>6} {own:>20} {hopper:>20}");
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The map is the same in any units, also for throws at once after a catch and for balls that stay in the hand.
    #[test]
    fn the_map_from_throw_to_throw_is_that_of_the_hopper() {
        let mut stays = 0;
        for (hand, ball, stiffness, gravity) in [
            (0.3, 0.5, 80.0, 9.81),
            (2.0, 0.7, 15.0, 1.62),
            (1.0, 10.0, 300.0, 9.8),
            (5.0, 0.5, 1.0, 1.0),
        ] {
            let juggler = Juggler { hand, ball, stiffness, gravity };
            let map = LiftOffMap::new(MassRatio::new(hand / ball).unwrap());
            for k in 1..200 {
                let alpha = 0.1 * f64::from(k);
                match (next_throw(juggler, alpha).unwrap(), map.image(alpha).unwrap()) {
                    (Some(own), Some(hopper)) => {
                        // Near α*_n a catch is close to a triple root; the search finds its time to fewer digits.
                        assert!((own - hopper).abs() < 1e-9, "{alpha}: {own} {hopper}");
                    }
                    (own, hopper) => {
                        assert_eq!(own, hopper, "{alpha}");
                        stays += 1;
                    }
                }
            }
        }
        assert!(stays > 0);
    }
}
