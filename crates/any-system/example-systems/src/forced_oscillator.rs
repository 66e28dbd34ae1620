//! The forced oscillator of Sommerer and Ott (1993): a particle in a plane, whose fate is qualitatively uncertain.
//!
//! ```text
//!   ẍ = −γ ẋ − ∂V/∂x + f₀ sin ωt                V(x, y) = (1 − x²)² + (x + x̄) y²
//!   ÿ = −γ ẏ − ∂V/∂y
//! ```
//!
//! The line y = ẏ = 0 is invariant, because the force in y is −2 (x + x̄) y. On it the particle is a chaotic Duffing
//! oscillator, whose attractor attracts almost every nearby orbit with y ≠ 0 as well. To the left of x = −x̄ the
//! potential falls in the direction of y. Some orbits reach this region, and y grows without bound. The basin of the
//! attractor is riddled: every neighbourhood of its points has points of both fates.
//!
//! Once in a forcing period T = 2π/ω the state is observed: the stroboscopic map. Friction is constant, so that the map
//! contracts every volume of (x, ẋ, y, ẏ) by the same factor, e^(−2γT).

use hybrid_system::{
    Error, Guard, HybridSystem, Linearized, NextEvent, Reset, Search, State, Tolerances, Touch,
    integrated_crossing, integrated_flow, integrated_jacobian,
};
use nalgebra::{Matrix4, SMatrix, Vector4, Vector5};
use pxfm::{f_cos, f_sin};
use std::f64::consts::TAU;

/// Tolerances of the integration. Two orbits in the chaotic sea that differ by 10⁻¹² differ by 1 after some 50 periods.
/// A single orbit is therefore typical, not exact; a fate found after a longer time is the fate of a nearby point.
const TOLERANCES: Tolerances = Tolerances::both(1e-12);

/// The particle. State: x, ẋ, y, ẏ and s, the time since the start of the forcing period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForcedOscillator {
    /// γ.
    pub friction: f64,
    /// x̄.
    pub shift: f64,
    /// f₀.
    pub amplitude: f64,
    /// ω.
    pub frequency: f64,
}

impl ForcedOscillator {
    /// The parameters of Sommerer and Ott (1993).
    pub const PUBLISHED: Self =
        ForcedOscillator { friction: 0.05, shift: 1.9, amplitude: 2.3, frequency: 3.5 };

    /// T = 2π/ω.
    pub fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

impl ForcedOscillator {
    /// The state (x, ẋ, y, ẏ) one period later, from the start of a forcing period.
    ///
    /// All components are NaN if the particle is at infinity before: where the potential falls, it gets there in
    /// finite time.
    pub fn stroboscopic_map(&self, point: &Vector4<f64>) -> Vector4<f64> {
        let start = Vector5::new(point[0], point[1], point[2], point[3], 0.0);
        integrated_flow(self, (), &start, self.period(), TOLERANCES).fixed_rows::<4>(0).into()
    }

    /// The derivative of the [map](Self::stroboscopic_map). Its determinant is e^(−2γT).
    ///
    /// # Errors
    /// The errors of [`integrated_jacobian`].
    pub fn stroboscopic_jacobian(&self, point: &Vector4<f64>) -> Result<Matrix4<f64>, Error> {
        let start = Vector5::new(point[0], point[1], point[2], point[3], 0.0);
        let jacobian = integrated_jacobian(self, (), &start, self.period(), TOLERANCES)?;
        Ok(jacobian.fixed_view::<4, 4>(0, 0).into())
    }
}

impl Linearized<5> for ForcedOscillator {
    fn field_jacobian(&self, _: (), z: &State<5>) -> SMatrix<f64, 5, 5> {
        let (x, y) = (z[0], z[2]);
        let forcing = self.amplitude * self.frequency * f_cos(self.frequency * z[4]);
        let mut matrix = SMatrix::zeros();
        matrix[(0, 1)] = 1.0;
        matrix[(1, 0)] = 4.0 - 12.0 * x * x;
        matrix[(1, 1)] = -self.friction;
        matrix[(1, 2)] = -2.0 * y;
        matrix[(1, 4)] = forcing;
        matrix[(2, 3)] = 1.0;
        matrix[(3, 0)] = -2.0 * y;
        matrix[(3, 2)] = -2.0 * (x + self.shift);
        matrix[(3, 3)] = -self.friction;
        matrix
    }
}

/// The events of the particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// A forcing period ends. The event sets s to 0: the state after it is a point of the stroboscopic map.
    Stroboscope,
    /// |y| = 20, rising: the particle has escaped, and the execution ends.
    Escape,
}

/// |y| at which the particle counts as escaped. The orbits of the chaotic sea stay below |y| = 5. A smaller number
/// could meet them; a larger one costs steps, because the particle reaches infinity in finite time.
const FAR: f64 = 20.0;

impl HybridSystem for ForcedOscillator {
    type State = State<5>;
    type Mode = ();
    type Surface = Surface;

    fn flow(&self, _: (), z: &State<5>, t: f64) -> State<5> {
        integrated_flow(self, (), z, t, TOLERANCES)
    }

    fn guards(&self, _: ()) -> &[Guard<Surface>] {
        const {
            &[
                Guard::clock(Surface::Stroboscope),
                Guard::rising(Surface::Escape).touch(Touch::Ignore),
            ]
        }
    }

    fn guard_value(&self, _: Surface, z: &State<5>) -> f64 {
        z[2] * z[2] - FAR * FAR
    }

    fn next_time(&self, _: (), _: Surface, after: f64) -> Option<f64> {
        let period = self.period();
        let next = (after / period).floor() + 1.0;
        // The quotient is rounded: the product may be the time `after` itself, or the one after the next.
        [next - 1.0, next, next + 1.0].map(|k| k * period).into_iter().find(|&time| time > after)
    }

    fn reset(&self, _: (), surface: Surface, z: &State<5>) -> Reset<(), State<5>> {
        match surface {
            Surface::Stroboscope => {
                Reset::Jump { mode: (), state: Vector5::new(z[0], z[1], z[2], z[3], 0.0) }
            }
            Surface::Escape => Reset::Stop,
        }
    }

    fn vector_field(&self, _: (), z: &State<5>) -> Option<State<5>> {
        let (x, u, y, v) = (z[0], z[1], z[2], z[3]);
        Some(Vector5::new(
            u,
            -self.friction * u + 4.0 * x * (1.0 - x * x) - y * y
                + self.amplitude * f_sin(self.frequency * z[4]),
            v,
            -self.friction * v - 2.0 * (x + self.shift) * y,
            1.0,
        ))
    }

    fn first_crossing(
        &self,
        mode: (),
        z: &State<5>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<5>>, Error> {
        integrated_crossing(self, mode, z, search, TOLERANCES)
    }
}
