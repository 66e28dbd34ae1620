//! Limits on the number of sudden lift-offs, and on the speed of hops in plain `f64`.

/// Sudden lift-offs that one hop may have. A hop with more is an error.
///
/// Theory bounds their number by ((α√M + √(α²M + 8αα*_1))/(2α*_1))²; scans find 1013 at M = 10⁴. The limit thus stops
/// only hops with M far above 10⁶. A hop that reaches the limit takes some tenths of a second.
pub const SUDDEN_LIFT_OFF_BUDGET: usize = 1_000_000;

/// Largest speed of hops in plain `f64`, 2²⁸. Faster hops are computed in longer arithmetic from the start.
///
/// At this speed an ulp of α is 6·10⁻⁸, and the phase at the landing has an error of this size. Above it, plain
/// decisions would be inconclusive so often that the attempt costs more than it saves. The computing time depends on
/// this limit, the result does not.
pub(crate) const LARGEST_PLAIN_SPEED: f64 = 268_435_456.0;
