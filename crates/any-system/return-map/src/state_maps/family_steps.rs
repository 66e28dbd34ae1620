//! A family of maps at a parameter as a map of states.

use crate::families::MapFamily;
use basin_of_attraction::StateMap;

/// A family of maps at one value of its parameter: a section of a model ([`EquationReturns`](crate::EquationReturns), [`returns`](crate::returns)),
/// formulas, closures.
///
/// A point without an image, such as one whose execution ends at a surface or does not return, has none here either.
/// [`orbit_fate`](crate::orbit_fate) tells these ends apart.
///
/// ```
/// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, RecurrenceLimits, StateGrid};
/// use return_map::{FamilySteps, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let map = FamilySteps::new(&logistic, 3.5);
/// let grid = StateGrid::uniform(Interval::new(0.0, 1.0)?.try_into()?, 100)?;
/// let found = Attractors::search(&map, grid, &[vec![0.3]], RecurrenceLimits::default())?;
/// assert_eq!(found.attractors()[0].period, Some(4));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct FamilySteps<'a, M: ?Sized> {
    family: &'a M,
    parameter: f64,
}

impl<'a, M: MapFamily + ?Sized> FamilySteps<'a, M> {
    /// The map of this family at a value of its parameter.
    pub fn new(family: &'a M, parameter: f64) -> Self {
        FamilySteps { family, parameter }
    }
}

impl<M: MapFamily + ?Sized> StateMap for FamilySteps<'_, M> {
    fn dimension(&self) -> Option<usize> {
        Some(self.family.dimension())
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        let found = self.family.image(state, self.parameter);
        found.is_ok_and(|found| {
            image.copy_from_slice(&found.point);
            true
        })
    }
}
