//! Maps by formulas: their derivatives are exact.

use super::derivatives::Pushed;
use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::{Formulas, Jet, JetSeries};

/// A map whose components are formulas of the components and of parameters. One of the parameters changes.
///
/// ```
/// use equations::{Formulas, Names};
/// use return_map::{FormulaMap, MapFamily};
/// let names = Names::new(&["x", "y"], &[("a", "1.4"), ("b", "0.3")])?;
/// let henon = Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"])?;
/// let henon = FormulaMap::new(&henon, "a")?;
/// assert_eq!(henon.image(&[0.5, 0.0], 2.0)?.point, [0.5, 0.15]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FormulaMap {
    series: JetSeries,
    /// The values of the parameters.
    values: Vec<f64>,
    /// The place of the one that changes.
    parameter: usize,
    dimension: usize,
}

impl FormulaMap {
    /// The map of these formulas, one for each component, as the parameter with this name changes.
    ///
    /// # Errors
    /// Those of [`equations`]: another number of formulas, an unknown name, functions without derivatives.
    pub fn new(formulas: &Formulas, parameter: &str) -> Result<FormulaMap, Error> {
        let names = formulas.names();
        let (needed, given) = (names.states.len(), formulas.count());
        if needed != given {
            return Err(
                equations::Error::Length { what: "formulas of a map", needed, given }.into()
            );
        }
        check_without_time(formulas)?;
        let place = names.parameters.iter().position(|name| name == parameter);
        let reason = "no parameter of these formulas";
        let name = parameter.to_owned();
        let parameter = place.ok_or(equations::Error::Name { name, reason })?;
        let values = names.values.iter().map(equations::Constant::value).collect();
        Ok(FormulaMap {
            series: JetSeries::of_values(formulas)?,
            values,
            parameter,
            dimension: needed,
        })
    }

    fn values<const T: usize>(
        &self,
        curve: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<Vec<Jet<T>>, Error> {
        let parameters = self.values.iter().enumerate().map(|(place, value)| {
            if place == self.parameter { parameter } else { Jet::moving(*value, 0.0) }
        });
        let all: Vec<Jet<T>> = curve.iter().copied().chain(parameters).collect();
        Ok(self.series.values(&all)?)
    }
}

/// An error for formulas of a map that use the time.
pub(crate) fn check_without_time(formulas: &Formulas) -> Result<(), Error> {
    if formulas.uses_time() {
        let (name, reason) = ("t".to_owned(), "a map has no time");
        return Err(equations::Error::Name { name, reason }.into());
    }
    Ok(())
}

impl MapFamily for FormulaMap {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        let still = |value: &f64| Jet::<1>([*value]);
        let curve: Vec<Jet<1>> = point.iter().map(still).collect();
        let image = self.values(&curve, still(&parameter))?;
        Ok(Image::of_number(image.into_iter().map(|jet| jet.0[0]).collect(), None))
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        Ok(Pushed::exact(self.values(curve, parameter)?))
    }
}
