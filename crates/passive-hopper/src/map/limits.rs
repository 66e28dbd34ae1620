//! Limits of the hops that are computed, and of those that are computed in plain `f64`.

/// Sudden lift-offs that one hop may have. A hop with more is an error.
///
/// Theory bounds their number by ((α√M + √(α²M + 8αα*_1))/(2α*_1))²; scans find 1013 at M = 10⁴. The limit thus
/// stops only hops with M far above 10⁶. A hop that uses it up takes some tenths of a second.
pub const SUDDEN_LIFT_OFF_BUDGET: usize = 1_000_000;

/// Largest speed of hops in plain `f64`, 2²⁸: above it hops are computed in longer arithmetic at once.
///
/// An ulp of α, and so of the phase at the landing, is 6·10⁻⁸ there. Above, plain verdicts would be inconclusive so
/// often that the attempt costs more than it saves. Only the speed of a hop depends on this limit, not its value.
pub(crate) const LARGEST_PLAIN_SPEED: f64 = 268_435_456.0;
