//! A map by formulas as a map of states.

use crate::error::Error;
use crate::families::check_without_time;
use basin_of_attraction::{StateMap, step_by_step};
use equations::Formulas;

/// The map of some formulas, one for each component, at the values of their parameters. Many states are computed 32 at a time.
///
/// ```
/// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid};
/// use equations::{Formulas, Names};
/// use return_map::FormulaSteps;
/// let names = Names::new(&["x", "y"], &[("a", "1.4"), ("b", "0.3")])?;
/// let henon = FormulaSteps::new(&Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"])?)?;
/// let grid = StateGrid::uniform(Hyperrectangle::new(vec![Interval::new(-2.0, 2.0)?; 2])?, 100)?;
/// let limits = RecurrenceLimits { escape: Some(100.0), ..RecurrenceLimits::default() };
/// let found = Attractors::search(&henon, grid, &[vec![0.1, 0.1]], limits)?;
/// // A thousand starts on the diagonal.
/// let on_diagonal = |k: usize, state: &mut [f64]| state.fill(0.004 * k as f64 - 2.0);
/// let all = found.convergences(&henon, 1000, on_diagonal)?;
/// assert_eq!(all.iter().filter(|(label, _)| *label == Label::from(1)).count(), 610);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct FormulaSteps(Formulas);

impl FormulaSteps {
    /// The map of these formulas.
    ///
    /// # Errors
    /// Those of [`equations`]: another number of formulas than components, formulas that use the time.
    pub fn new(formulas: &Formulas) -> Result<FormulaSteps, Error> {
        let (needed, given) = (formulas.names().states.len(), formulas.count());
        if needed != given {
            return Err(
                equations::Error::Length { what: "formulas of a map", needed, given }.into()
            );
        }
        check_without_time(formulas)?;
        Ok(FormulaSteps(formulas.clone()))
    }
}

impl StateMap for FormulaSteps {
    fn dimension(&self) -> Option<usize> {
        Some(self.0.count())
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        self.0.write_values(0.0, state, image).is_ok()
    }

    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        if self.0.map_columns(0.0, states, 1, has_image).is_err() {
            has_image.fill(false);
        }
    }

    fn advance(&self, states: &mut [Vec<f64>], has_image: &mut [bool], steps: usize) -> usize {
        let starts = states.to_vec();
        let done = self.0.map_columns(0.0, states, steps, has_image);
        if done.is_ok() && !has_image.contains(&false) {
            return steps;
        }
        // Which step it was shows itself one by one.
        states.clone_from_slice(&starts);
        step_by_step(self, states, has_image, steps)
    }

    /// As many as [`Formulas::map_columns`] computes side by side.
    fn together(&self) -> usize {
        32
    }
}
