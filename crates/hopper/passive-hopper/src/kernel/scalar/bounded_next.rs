//! α′² with a bound on its error, and its root.

/// More than the roundings of the quotient in [`BoundedSquare::next`].
pub(crate) const ROUND_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

/// α′² and a bound on its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundedSquare {
    /// α′², negative if the hopper is grounded; NaN if it is not known.
    pub(crate) square: f64,
    pub(crate) error: f64,
}

/// α′ and a bound on its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundedNext {
    /// α′ > 0, or [`GROUNDED`](Self::GROUNDED), [`INCONCLUSIVE`](Self::INCONCLUSIVE) or [`NONE`](Self::NONE).
    pub(crate) speed: f64,
    pub(crate) error: f64,
}

impl BoundedNext {
    /// The hopper is grounded from all speeds.
    pub(crate) const GROUNDED: f64 = -1.0;
    /// The sign of α′² may differ within the error.
    pub(crate) const INCONCLUSIVE: f64 = -2.0;
    /// The kernel has no α′.
    pub(crate) const NONE: f64 = 0.0;
}

impl BoundedSquare {
    /// α′, without a branch.
    ///
    /// |α̂′ − α′| = |F̂ − F|/(α̂′ + α′), with α′ ≥ √(F̂ − error), and an ulp for the root.
    #[inline(always)]
    pub(crate) fn next(self) -> BoundedNext {
        let BoundedSquare { square, error } = self;
        let hops_again = square > error;
        // Arguments of roots are selected, not roots: vectors compute both sides.
        let speed = if hops_again { square } else { 1.0 }.sqrt();
        let least = if hops_again { square - error } else { 1.0 }.sqrt();
        let bound = error / (speed + least) * ROUND_UP + f64::EPSILON * speed;
        let on_ground =
            if square < -error { BoundedNext::GROUNDED } else { BoundedNext::INCONCLUSIVE };
        let known = if hops_again { speed } else { on_ground };
        BoundedNext { speed: if square.is_nan() { BoundedNext::NONE } else { known }, error: bound }
    }
}
