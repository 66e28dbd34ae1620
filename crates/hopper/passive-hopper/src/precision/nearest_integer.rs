//! Rounding to an integer by one addition and one subtraction, so that loops over arrays have no branch.

/// 1.5 · 2⁵². The `f64` around this number are the integers. Adding it to x therefore rounds x to an integer, and the
/// last bits of the sum are those of the integer. With the factor 1.5 the sum stays between 2⁵² and 2⁵³ also for
/// negative x. From |x| = 2⁵¹ on the sum leaves that range, and the result is no longer an integer.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The integer nearest to `x` (ties to even), and an integer with the same last bits; for |x| < 2⁵⁰.
#[inline(always)]
pub(crate) fn nearest_integer(x: f64) -> (f64, u64) {
    let sum = x + ROUNDER;
    (sum - ROUNDER, sum.to_bits())
}
