//! A family of maps at a parameter as a map of states.

use super::EndLabels;
use crate::families::MapFamily;
use crate::orbits::{OrbitEnd, end_of};
use basin_of_attraction::{Label, StateMap};
use std::sync::Arc;

/// A family of maps at one value of its parameter: a section of a model ([`EquationReturns`](crate::EquationReturns), [`returns`](crate::returns)),
/// formulas, closures.
///
/// An orbit that ends at a surface which ends the run has a fate that is known: [`Label::ESCAPED`], or what [`label_ends`](Self::label_ends) says.
/// Other points without an image are [`Label::UNDECIDED_MAP`].
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
#[derive(Debug, Clone)]
pub struct FamilySteps<'a, M: ?Sized> {
    family: &'a M,
    parameter: f64,
    labels: EndLabels,
}

impl<'a, M: MapFamily + ?Sized> FamilySteps<'a, M> {
    /// The map of this family at a value of its parameter.
    pub fn new(family: &'a M, parameter: f64) -> Self {
        FamilySteps { family, parameter, labels: EndLabels::default() }
    }

    /// The same with other labels of the ends of orbits. `label` gets [`OrbitEnd::Terminal`] with the name of the surface, [`OrbitEnd::Zeno`],
    /// [`OrbitEnd::NoFurtherEvent`] or [`OrbitEnd::Failed`]. Numbers from 65 001 on are those of no attractor.
    ///
    /// ```
    /// use basin_of_attraction::{Attractors, Interval, Label, RecurrenceLimits, StateGrid};
    /// use hybrid_system::Equations;
    /// use return_map::{EquationReturns, FamilySteps, OrbitEnd};
    /// // A ball that is kept bouncing, by its speed at the floor: one that flies too high is lost.
    /// let ball = Equations::new(&["height", "speed"], &[("r", "0.8")])
    ///     .mode_text("flight", &["speed", "-1"])
    ///     .falling_text("floor", "height")
    ///     .resets_text(&["0", "-r*speed + 1/(1 + speed^2)"])
    ///     .rising_text("ceiling", "height - 8")
    ///     .stops();
    /// let returns = EquationReturns::new(&ball, "r", ("flight", "floor"), &["v"])?
    ///     .starting_text(&["0", "v"])?
    ///     .coordinates_text(&["speed"])?;
    /// let bounces = FamilySteps::new(&returns, 0.8).label_ends(|end| match end {
    ///     OrbitEnd::Terminal(surface) if surface == "ceiling" => Label::numbered::<65_001>(),
    ///     _ => Label::UNDECIDED_MAP,
    /// });
    /// let grid = StateGrid::uniform(Interval::new(0.0, 5.0)?.try_into()?, 100)?;
    /// let found = Attractors::search(&bounces, grid, &[vec![1.0]], RecurrenceLimits::default())?;
    /// assert_eq!(found.label(&bounces, &[3.9]), Label::from(1));
    /// assert_eq!(found.label(&bounces, &[4.1]), Label::numbered::<65_001>());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn label_ends(self, label: impl Fn(&OrbitEnd) -> Label + Send + Sync + 'static) -> Self {
        FamilySteps { labels: EndLabels(Arc::new(label)), ..self }
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

    fn label_of_end(&self, state: &[f64]) -> Label {
        match self.family.image(state, self.parameter) {
            Ok(_) => Label::UNDECIDED_MAP,
            Err(error) => (self.labels.0)(&end_of(error)),
        }
    }
}
