//! Limits on the number of sudden lift-offs, and on the speed of hops in plain `f64`.

/// Sudden lift-offs that one hop may have. A hop with more is an error.
///
/// Their number is below ((α√M + √(α²M + 8αα*_1))/(2α*_1))² (docs/theory.md, Theorem 18). So the limit stops no hop
/// with α (2 + 10³√M) ≤ 4.49 · 10⁶ (docs/theory.md, Corollary 19). Scans find 1013 at M = 10⁴. A hop that reaches the
/// limit takes some tenths of a second.
pub const SUDDEN_LIFT_OFF_BUDGET: usize = 1_000_000;

/// Largest speed of hops in plain `f64`, 2²⁸. Faster hops are computed in longer arithmetic from the start.
///
/// At this speed an ulp of α is 6·10⁻⁸, and the phase at the landing has an error of this size. Above it, plain
/// decisions would be inconclusive so often that the attempt costs more than it saves. The computing time depends on
/// this limit, the result does not.
pub(crate) const LARGEST_PLAIN_SPEED: f64 = 268_435_456.0;
