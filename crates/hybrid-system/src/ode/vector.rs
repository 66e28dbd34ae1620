//! What the integrator needs of a state.

use super::Tolerances;
use super::scheme::ALL_STAGES;
use crate::{Error, State};

/// States that can be integrated.
pub(super) trait Vector: Copy {
    fn zero() -> Self;
    /// self + factor · other.
    fn add(&mut self, factor: f64, other: &Self);
    /// from + size · Σ aⱼ slopeⱼ; the terms (j, aⱼ) come in pairs.
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

    /// The largest component, each in units of its tolerance.
    fn relative_to(&self, before: &Self, after: &Self, tolerances: &Tolerances) -> f64 {
        let sizes = before.components().zip(after.components());
        let shares = self.components().zip(sizes).map(|(error, (a, b))| {
            let size = if a.abs() > b.abs() { a.abs() } else { b.abs() };
            (error / (tolerances.absolute + tolerances.relative * size)).abs()
        });
        // What is not a number stays.
        shares.fold(0.0, |worst, share| if share > worst || share.is_nan() { share } else { worst })
    }

    /// An error unless all components are finite.
    fn finite(&self, time: f64) -> Result<(), Error> {
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
    /// Axis by axis: whole vectors would be loaded before they are stored, three words by two.
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
