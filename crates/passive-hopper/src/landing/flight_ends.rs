//! The two ends of a flight from the ground.

/// The start of a flight from the ground: y₁ = 1 + excess, ẏ₁ = velocity, y₂ = ẏ₂ = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TakeOff {
    /// Stretch of the spring minus one, x ≥ 0; zero at a gradual lift-off.
    pub excess: f64,
    /// Velocity of the upper mass, V.
    pub velocity: f64,
}

/// The end of a flight, just after the plastic collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// Time of flight τ.
    pub time: f64,
    /// Γ = −(1+M) ẏ₂ just before the collision; the landing takes μ Γ² from α².
    pub closing_speed: f64,
    /// Stretch minus one at the landing, x′. It keeps the digits that decide between a sudden lift-off and a
    /// contact; y₁ = 1 + x′ would lose them.
    pub excess: f64,
    /// Velocity of the upper mass, which the collision does not change.
    pub velocity: f64,
    /// Whether a sudden lift-off follows: the stretched spring pulls the lower mass off the ground at once.
    pub sudden: bool,
}

impl Landing {
    /// The start of the flight that follows a sudden landing.
    pub(crate) fn take_off(&self) -> TakeOff {
        TakeOff { excess: self.excess, velocity: self.velocity }
    }
}

/// Whether a sudden lift-off follows a landing at stretch 1 + `excess` with `velocity`. At stretch one itself the
/// upper mass decides: moving up, it stretches the spring further.
pub(crate) fn is_sudden(excess: f64, velocity: f64) -> bool {
    excess > 0.0 || (excess == 0.0 && velocity > 0.0)
}
