//! The operations on states that the integrator needs.

use super::schemes::ALL_STAGES;
use super::tolerances::Tolerances;
use crate::error::Error;
use crate::state::State;

/// States that can be integrated: the state of a system, or that state with its derivatives (`variation`).
pub(super) trait Vector: Copy {
    fn zero() -> Self;
    /// self + factor · other.
    fn add(&mut self, factor: f64, other: &Self);
    /// from + size · Σ aⱼ slopeⱼ, for terms (j, aⱼ) in pairs.
    ///
    /// The first and the second terms of the pairs are summed separately, so that the processor computes the two sums
    /// in parallel.
    fn combination(
        from: &Self,
        size: f64,
        terms: &[[(usize, f64); 2]],
        slopes: &[Self; ALL_STAGES],
    ) -> Self {
        let (mut even, mut odd) = (Self::zero(), Self::zero());
        for [a, b] in terms {
            even.add(a.1, &slopes[a.0]);
            odd.add(b.1, &slopes[b.0]);
        }
        let mut sum = *from;
        even.add(1.0, &odd);
        sum.add(size, &even);
        sum
    }
    /// All components.
    fn components(&self) -> impl Iterator<Item = f64>;

    /// The largest component of an error, each component in units of its tolerance; NaN if any component is NaN. A step
    /// is accepted if this is at most 1.
    fn in_tolerances(&self, before: &Self, after: &Self, tolerances: &Tolerances) -> f64 {
        let sizes = before.components().zip(after.components());
        let errors = self.components().zip(sizes).map(|(error, (a, b))| {
            let size = if a.abs() > b.abs() { a.abs() } else { b.abs() };
            (error / (tolerances.absolute + tolerances.relative * size)).abs()
        });
        // `f64::max` would drop NaN, and the step would be accepted.
        errors.fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
    }

    /// An error unless all components are finite.
    fn check_finite(&self, time: f64) -> Result<(), Error> {
        if self.components().all(f64::is_finite) {
            return Ok(());
        }
        Err(Error::StateNotFinite { time, jumps: 0, state: self.components().collect() })
    }
}

impl<const N: usize> Vector for State<N> {
    fn zero() -> Self {
        Self::zeros()
    }
    fn add(&mut self, factor: f64, other: &Self) {
        for axis in 0..N {
            self[axis] += factor * other[axis];
        }
    }
    /// Each component is summed separately, which keeps each sum in a register. Sums of whole vectors are moved through
    /// memory two words at a time, and a state of three components is loaded again before it has been stored.
    fn combination(
        from: &Self,
        size: f64,
        terms: &[[(usize, f64); 2]],
        slopes: &[Self; ALL_STAGES],
    ) -> Self {
        Self::from_fn(|axis, _| {
            let (mut even, mut odd) = (0.0, 0.0);
            for [a, b] in terms {
                even += a.1 * slopes[a.0][axis];
                odd += b.1 * slopes[b.0][axis];
            }
            from[axis] + size * (even + odd)
        })
    }
    fn components(&self) -> impl Iterator<Item = f64> {
        self.iter().copied()
    }
}
