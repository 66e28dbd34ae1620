//! Formulas and their Taylor series in time, in numbers with derivatives.

use crate::algebra::Arithmetic;
use crate::error::Error;
use crate::evaluate::compute;
use crate::formulas::{Formulas, length as check_length};
use crate::jet::Jet;
use crate::node::Node;
use crate::series::{Coefficients, Series, coefficient, keep, length};

/// Taylor series in time of a motion, and of formulas along it, whose coefficients are [`Jet`]s: with the derivatives by
/// start, time and parameters.
///
/// The parameters are components of the state behind the others, so that a jet of the state says how each of them changes.
///
/// ```
/// use equations::{Formulas, Jet, JetSeries, Names};
/// let names = Names::new(&["x"], &[("rate", "2")])?;
/// let growth = Formulas::new(names, |_, x, p| [p["rate"] * x[0]])?;
/// let series = JetSeries::new(&growth, None)?;
/// // From x = 3, as the rate changes: x(t + s) = 3 e^(rate s) has the coefficients 3, 3 rate, 3 rate²/2.
/// let found = series.coefficients(&[Jet::number(3.0), Jet::<3>::moving(2.0, 1.0)], 2)?;
/// assert_eq!(found.state(0)[1], Jet([6.0, 3.0, 0.0]));
/// assert_eq!(found.state(0)[2], Jet([6.0, 6.0, 1.5]));
/// # Ok::<(), equations::Error>(())
/// ```
#[derive(Debug)]
pub struct JetSeries {
    series: Series,
}

impl JetSeries {
    /// The series of a field that does not need the time, and of watched formulas. If it needs the time, let the time be a
    /// component: [`Formulas::with_time_as_state`].
    ///
    /// # Errors
    /// As [`Series::new`].
    pub fn new(field: &Formulas, watched: Option<&Formulas>) -> Result<JetSeries, Error> {
        let moved = |formulas: &Formulas, rate: Option<f64>| {
            let names = &formulas.names.parameters;
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            formulas.with_states_for(&names, |_| rate.map(|rate| Node::Constant(rate.into())))
        };
        let watched = watched.map(|watched| moved(watched, None)).transpose()?;
        let field = moved(field, Some(0.0))?;
        Ok(JetSeries { series: Series::with(&field, watched.as_ref(), false)? })
    }

    /// Formulas without a motion: their values alone are wanted.
    ///
    /// # Errors
    /// As [`Series::new`].
    pub fn of_values(formulas: &Formulas) -> Result<JetSeries, Error> {
        let (names, zero) = (formulas.names.clone(), Node::Constant(0.0.into()));
        let outputs = vec![0; names.states.len()];
        JetSeries::new(&Formulas::of(names, vec![zero], outputs), Some(formulas))
    }

    /// The values of the watched formulas.
    ///
    /// # Errors
    /// As [`coefficients`](Self::coefficients).
    pub fn values<const T: usize>(&self, state: &[Jet<T>]) -> Result<Vec<Jet<T>>, Error> {
        let found = self.coefficients(state, 0)?;
        Ok(found.all_watched().map(|series| series[0]).collect())
    }

    /// The coefficients up to `order` at a state, the parameters included.
    ///
    /// # Errors
    /// As [`Series::coefficients`].
    pub fn coefficients<const T: usize>(
        &self,
        state: &[Jet<T>],
        order: usize,
    ) -> Result<Coefficients<Jet<T>>, Error> {
        let mut found = self.series.empty(order)?;
        let row = length::<Jet<T>>(found.terms);
        for (part, value) in self.values_of_parts(state)?.into_iter().enumerate() {
            found.all[part * row] = value;
        }
        let values = || state.iter().map(Jet::value).collect::<Vec<f64>>();
        if !self.series.finish(&mut found).is_valid() {
            let part = self.series.without_value(&found);
            return Err(self.series.field.no_value(part, &0.0, &values()));
        }
        Ok(found)
    }

    /// The values of all parts: series in ε, by the same rules as those in time, from what the state says.
    fn values_of_parts<const T: usize>(&self, state: &[Jet<T>]) -> Result<Vec<Jet<T>>, Error> {
        let Series { field, .. } = &self.series;
        check_length("components of the state", self.series.dimension(), state.len())?;
        let mut memory = self.series.memory::<f64>(T.max(1) - 1)?;
        let row = length::<f64>(memory.terms);
        let values: Vec<f64> = state.iter().map(Jet::value).collect();
        field.check_start(&0.0, &values)?;
        let Coefficients { all, rules, .. } = &mut memory;
        compute(&field.nodes, &0.0, &values, all, row);
        for k in 1..T {
            let inverse = 1.0 / k as f64;
            for rule in rules.iter() {
                let found = match field.nodes.get(rule.row as usize / row) {
                    Some(Node::State(component)) => state[*component].0[k],
                    _ => coefficient(all, row, rule, (k, inverse)),
                };
                keep(&mut all[rule.row as usize..][..row], k, found);
            }
        }
        let parts = field.nodes.len();
        let found: Vec<Jet<T>> =
            (0..parts).map(|part| Jet(std::array::from_fn(|k| all[part * row + k]))).collect();
        match found.iter().position(|jet| !jet.is_valid()) {
            Some(part) => Err(field.no_value(part, &0.0, &values)),
            None => Ok(found),
        }
    }
}
