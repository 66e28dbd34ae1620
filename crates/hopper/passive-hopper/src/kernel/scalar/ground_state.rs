//! The state of the hopper on the ground, with a bound on its error.

/// Stretch minus one, x, and velocity V of the upper mass, just after a landing.
///
/// For x > 0 the landing is sudden, and another flight starts from here.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GroundState {
    pub(crate) excess: f64,
    pub(crate) velocity: f64,
    /// Bound on the error of x and on that of V.
    pub(crate) error: f64,
}
