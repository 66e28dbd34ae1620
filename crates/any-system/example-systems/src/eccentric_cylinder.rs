//! A cylinder whose centre of mass is off its axis, bouncing on a floor.
//!
//! The floor has no friction, so that the horizontal velocity is constant, and zero in the frame of the observer. The
//! radius, the mass and gravity are 1. The centre of mass G has the distance ε from the axis C, and the radius of
//! gyration about G is κ. Chatterjee and others (2002) name this system beside their juggling model.
//!
//! ```text
//!        ╭───────╮        y  height of G            gap  g = y + ε cos φ − 1
//!      ╭╯    C    ╰╮      φ  angle of G about C,         the height of the lowest point of the cylinder
//!      │     ╲     │         0 if G is below C      rate ġ = v − ε sin φ ω
//!      ╰╮   φ G   ╭╯
//!  ───────╰───────╯───
//! ```

use hybrid_system::{
    Error, Guard, HybridSystem, NextEvent, QuasiPolynomial, Reset, Search, State, Tolerances,
    default_search, integrated_crossing, integrated_flow,
};
use nalgebra::Vector4;
use pxfm::{f_cos, f_sin, f_sincos};
use std::f64::consts::TAU;

/// Tolerances of the motion in contact. The motion in flight has a closed form. A smaller number costs time, a larger
/// one would show in the energy of the cylinder that rocks without loss.
const TOLERANCES: Tolerances = Tolerances::both(1e-12);

/// The two modes of the cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// G falls freely, and the cylinder turns uniformly: v̇ = −1, ω̇ = 0. This flow has a closed form.
    Flight,
    /// The lowest point stays on the floor: y = 1 − ε cos φ. This flow is integrated.
    Contact,
}

/// The events that end an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// g = 0, falling: the cylinder hits the floor.
    Floor,
    /// 1 + ε ω² cos φ = 0, falling: the force of the floor vanishes, by (2).
    Release,
}

/// The cylinder. State: y, v = ẏ, φ, ω = φ̇.
///
/// **Impact.** The floor acts on the lowest point. The velocity of this point is ġ = n·(v, ω) with n = (1, −ε sin φ).
/// An impulse J changes v by J and ω by −ε sin φ J/κ², so that ġ changes by w J with
///
/// ```text
///   w = 1 + (ε sin φ)²/κ²        J = −(1 + e) ġ⁻/w        ġ⁺ = −e ġ⁻                (1)
/// ```
///
/// 1/w is the effective mass. The energy E = (v² + κ²ω²)/2 + y changes by −(1 − e²) (ġ⁻)²/(2w).
///
/// **Contact.** The force N of the floor has the lever ε sin φ about G, and a rolling resistance adds the moment
/// −μ N ω: κ² ω̇ = −N (ε sin φ + μ ω). From y = 1 − ε cos φ follows N = 1 + ÿ = 1 + ε cos φ ω² + ε sin φ ω̇. Together
///
/// ```text
///   N = (1 + ε cos φ ω²)/(1 + ε sin φ (ε sin φ + μ ω)/κ²)                           (2)
/// ```
///
/// The force vanishes where 1 + ε cos φ ω² does. In flight g̈ = −(1 + ε cos φ ω²): the cylinder leaves the floor
/// there, and not before. The denominator of (2) is positive if |μ ω| < 2κ, because s² + sμω ≥ −(μω)²/4.
///
/// Without rolling resistance contact keeps the energy. A cylinder with e < 1 loses energy in impacts until they end,
/// and then rocks for ever. With μ > 0 it comes to rest with G below C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EccentricCylinder {
    /// ε, between 0 and 1.
    pub eccentricity: f64,
    /// κ.
    pub radius_of_gyration: f64,
    /// e, between 0 and 1: ġ⁺ = −e ġ⁻.
    pub restitution: f64,
    /// μ ≥ 0, a moment for each unit of force and of ω.
    pub rolling_resistance: f64,
}

impl EccentricCylinder {
    /// The gap below the cylinder, g.
    pub fn gap(&self, x: &State<4>) -> f64 {
        x[0] + self.eccentricity * f_cos(x[2]) - 1.0
    }

    /// The energy E = (v² + κ²ω²)/2 + y. At rest it has its minimum, 1 − ε.
    pub fn energy(&self, x: &State<4>) -> f64 {
        let spin = self.radius_of_gyration * x[3];
        0.5 * (x[1] * x[1] + spin * spin) + x[0]
    }

    /// 1 + ε cos φ ω²: minus the acceleration of the gap in flight. The force of the floor has its sign.
    pub fn pressing(&self, x: &State<4>) -> f64 {
        1.0 + self.eccentricity * f_cos(x[2]) * x[3] * x[3]
    }

    /// The state in contact with angle φ and angular velocity ω.
    pub fn on_floor(&self, phi: f64, omega: f64) -> State<4> {
        let (sin, cos) = f_sincos(phi);
        let lever = self.eccentricity * sin;
        Vector4::new(1.0 - self.eccentricity * cos, lever * omega, phi, omega)
    }

    /// Velocity and angular velocity after an impact with restitution e, by (1). The height is set to the floor: after
    /// the reset the gap is zero within rounding. The angle is reduced to half a turn, so that its rounding does
    /// not grow with the number of turns.
    fn after_impact(&self, x: &State<4>) -> State<4> {
        let phi = x[2] - TAU * (x[2] / TAU).round();
        let (sin, cos) = f_sincos(phi);
        let lever = self.eccentricity * sin;
        let inertia = self.radius_of_gyration * self.radius_of_gyration;
        let impulse =
            -(1.0 + self.restitution) * (x[1] - lever * x[3]) / (1.0 + lever * lever / inertia);
        Vector4::new(
            1.0 - self.eccentricity * cos,
            x[1] + impulse,
            phi,
            x[3] - lever * impulse / inertia,
        )
    }
}

impl HybridSystem for EccentricCylinder {
    type State = State<4>;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, x: &State<4>, t: f64) -> State<4> {
        match mode {
            Mode::Flight => {
                Vector4::new(x[0] + t * (x[1] - 0.5 * t), x[1] - t, x[2] + x[3] * t, x[3])
            }
            // Height and velocity follow from the angle. The integrated ones drift by the tolerance.
            Mode::Contact => {
                let end = integrated_flow(self, mode, x, t, TOLERANCES);
                self.on_floor(end[2], end[3])
            }
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        match mode {
            Mode::Flight => const { &[Guard::falling(Surface::Floor)] },
            Mode::Contact => const { &[Guard::falling(Surface::Release)] },
        }
    }

    fn guard_value(&self, surface: Surface, x: &State<4>) -> f64 {
        match surface {
            Surface::Floor => self.gap(x),
            Surface::Release => self.pressing(x),
        }
    }

    /// In flight: g = y − 1 + v t − t²/2 + ε cos φ cos ωt − ε sin φ sin ωt.
    fn guard_quasi_polynomial(
        &self,
        mode: Mode,
        _: Surface,
        x: &State<4>,
    ) -> Option<QuasiPolynomial> {
        if mode == Mode::Contact {
            return None;
        }
        let (sin, cos) = f_sincos(x[2]);
        Some(
            QuasiPolynomial::polynomial(&[x[0] - 1.0, x[1], -0.5])
                + QuasiPolynomial::cosine(self.eccentricity * cos, x[3])
                - QuasiPolynomial::sine(self.eccentricity * sin, x[3]),
        )
    }

    fn reset(&self, _: Mode, surface: Surface, x: &State<4>) -> Reset<Mode, State<4>> {
        let after = self.after_impact(x);
        match surface {
            // Without a rebound the floor carries the cylinder, unless its lowest point is accelerated upwards.
            Surface::Floor if self.restitution == 0.0 && self.pressing(&after) > 0.0 => {
                Reset::Jump { mode: Mode::Contact, state: self.on_floor(after[2], after[3]) }
            }
            Surface::Floor => Reset::Jump { mode: Mode::Flight, state: after },
            // Height and velocity follow from the angle: the integration may have left the floor by its tolerance.
            Surface::Release => {
                Reset::Jump { mode: Mode::Flight, state: self.on_floor(x[2], x[3]) }
            }
        }
    }

    /// After the Zeno limit of its bounces the cylinder stays in contact.
    fn rest(&self, _: Mode, limit: &State<4>) -> Option<(Mode, State<4>)> {
        Some((Mode::Contact, self.on_floor(limit[2], limit[3])))
    }

    fn vector_field(&self, mode: Mode, x: &State<4>) -> Option<State<4>> {
        Some(match mode {
            Mode::Flight => Vector4::new(x[1], -1.0, x[3], 0.0),
            Mode::Contact => {
                let lever = self.eccentricity * f_sin(x[2]);
                let inertia = self.radius_of_gyration * self.radius_of_gyration;
                let moment = lever + self.rolling_resistance * x[3];
                let force = self.pressing(x) / (1.0 + lever * moment / inertia);
                Vector4::new(x[1], force - 1.0, x[3], -force * moment / inertia)
            }
        })
    }

    fn first_crossing(
        &self,
        mode: Mode,
        x: &State<4>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<4>>, Error> {
        match mode {
            Mode::Flight => default_search(self, mode, x, search),
            Mode::Contact => integrated_crossing(self, mode, x, search, TOLERANCES),
        }
    }
}
