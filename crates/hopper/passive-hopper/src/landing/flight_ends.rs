//! The two ends of a flight from the ground.

use crate::model::mass_ratio::MassRatio;

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

/// Excess x′ and velocity V′ of the upper mass after a flight of the time 2(h + `rest`), to first order in `rest`.
///
/// x′ = x + 2h (V − h) on the parabola of the momentum coordinate, and V′ = V − 2h + κΓ. Inlined into the loops of the
/// kernel.
#[inline(always)]
pub(crate) fn state_after_flight(
    start: TakeOff,
    h: f64,
    rest: f64,
    kappa: f64,
    closing_speed: f64,
) -> (f64, f64) {
    let TakeOff { excess, velocity } = start;
    (
        excess + 2.0 * h * (velocity - h) + 2.0 * rest * (velocity - 2.0 * h),
        (velocity - 2.0 * h) - 2.0 * rest + kappa * closing_speed,
    )
}

impl TakeOff {
    /// The start of the flight after a sudden landing, with x ≥ 0; `None` if the flight is too short for an `f64`.
    ///
    /// x of a sudden landing may round to zero or below. For V ≤ 0 the flight is then too short to be represented, and
    /// loses no energy: h ≈ 3x/(2|V|). For V > 0 it is long, and tends to the flight from x = 0. (This occurs for M > 1
    /// with α a few ulps from nπ, docs/theory.md, Theorem 23.)
    pub(crate) fn resolved(self) -> Option<TakeOff> {
        (self.excess > 0.0 || self.velocity > 0.0)
            .then_some(TakeOff { excess: self.excess.max(0.0), ..self })
    }
}

impl Landing {
    /// The energy that the landing takes, ½κΓ² in units of m₁m₂g²/k.
    ///
    /// With Γ = −(1+M) ẏ₂ this is ½M(1+M) ẏ₂², the [`landing_loss`](crate::landing_loss).
    pub fn energy_loss(&self, mass_ratio: MassRatio) -> f64 {
        0.5 * mass_ratio.kappa() * self.closing_speed * self.closing_speed
    }

    /// The start of the flight that follows a sudden landing.
    pub(crate) fn take_off(&self) -> TakeOff {
        TakeOff { excess: self.excess, velocity: self.velocity }
    }
}

/// Whether a sudden lift-off follows a landing at stretch 1 + `excess` with `velocity`. At stretch 1 exactly, it
/// follows if the upper mass moves up, because the upper mass then stretches the spring further.
pub(crate) fn is_sudden(excess: f64, velocity: f64) -> bool {
    excess > 0.0 || (excess == 0.0 && velocity > 0.0)
}
