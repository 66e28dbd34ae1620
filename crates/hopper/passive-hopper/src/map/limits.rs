//! Limits on the number of sudden lift-offs, on the speed of hops in plain `f64`, and on the time of a short second
//! flight.

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

/// A second flight that is shorter than this, after a first flight from an offset from α*_n, is *short*. Near α*_n
/// it lasts 3|t| (docs/theory.md, Theorem 36).
///
/// A short flight is not followed by a sudden lift-off, whatever the rounding of its landing (Lemma 75, which needs
/// τ < α*_1 = 4.49). It keeps the small relative error of the first flight: Theorem 74 derives the error of δ′ for
/// flights shorter than 1, to first order in the rounding (Section 12 lists what is measured beyond it). A larger
/// value has no derivation; a smaller one sends more local hops to the longer arithmetic.
pub(crate) const SHORT_FLIGHT: f64 = 1.0;
