//! The state of both masses.

/// Displacements and velocities of both masses, in units of m₂g/k and of m₂gω/k.
///
/// Displacements are measured upwards from the relaxed spring standing on the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HopperState {
    /// y₁, displacement of the upper mass.
    pub upper_position: f64,
    /// ẏ₁.
    pub upper_velocity: f64,
    /// y₂ ≥ 0, height of the lower mass.
    pub lower_position: f64,
    /// ẏ₂.
    pub lower_velocity: f64,
}

impl HopperState {
    /// A gradual lift-off with speed α: (1, α, 0, 0) (paper, Eq. 2).
    pub fn lift_off(alpha: f64) -> Self {
        HopperState { upper_position: 1.0, upper_velocity: alpha, ..Self::RELAXED }
    }

    /// Relaxed spring, standing still on the ground.
    pub const RELAXED: HopperState = HopperState {
        upper_position: 0.0,
        upper_velocity: 0.0,
        lower_position: 0.0,
        lower_velocity: 0.0,
    };

    /// s = y₁ − y₂, the stretch of the spring: s̈ = −s in flight.
    pub fn stretch(&self) -> f64 {
        self.upper_position - self.lower_position
    }

    /// ṡ, the rate of the stretch.
    pub fn stretch_rate(&self) -> f64 {
        self.upper_velocity - self.lower_velocity
    }

    /// P = y₁ + M y₂, the momentum coordinate: P̈ = −1 in flight.
    pub fn momentum_coordinate(&self, mass_ratio: f64) -> f64 {
        self.upper_position + mass_ratio * self.lower_position
    }

    /// Ṗ, the rate of the momentum coordinate.
    pub fn momentum_rate(&self, mass_ratio: f64) -> f64 {
        self.upper_velocity + mass_ratio * self.lower_velocity
    }
}
