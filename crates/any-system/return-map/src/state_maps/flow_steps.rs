//! The motion of a field over some time as a map of states.

use crate::error::Error;
use basin_of_attraction::StateMap;
use equations::{Formulas, Series, TaylorFlow};

/// The motion of a field over some time: of a field that depends on the time from the same time on, over a period of it (a stroboscopic map).
/// By Taylor's method, eight states at a time.
///
/// ```
/// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, RecurrenceLimits, StateGrid};
/// use equations::{Formulas, Names};
/// use return_map::FlowSteps;
/// use std::f64::consts::TAU;
/// // Duffing's oscillator, at the beginning of each period.
/// let names = Names::new(&["x", "v"], &[("d", "0.15"), ("f", "0.2")])?;
/// let field = Formulas::from_text(names, &["v", "x - x^3 - d*v + f*cos(t)"])?;
/// let periods = FlowSteps::new(&field, (0.0, TAU), 1e-9)?;
/// let square = Hyperrectangle::new(vec![Interval::new(-2.2, 2.2)?; 2])?;
/// let limits = RecurrenceLimits { locate: 50, ..RecurrenceLimits::default() };
/// let starts = [vec![1.0, 0.0], vec![-1.0, 0.0]];
/// let found = Attractors::search(&periods, StateGrid::uniform(square, 100)?, &starts, limits)?;
/// assert_eq!(found.attractors().len(), 2);
/// assert!(found.attractors().iter().all(|attractor| attractor.period == Some(1)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FlowSteps {
    series: Series,
    from: f64,
    to: f64,
    tolerance: f64,
    /// Absolute and relative, of each component.
    each: Vec<(f64, f64)>,
    longest_step: f64,
}

impl FlowSteps {
    /// The motion of a field with one formula for each component, from the first of these times to the second. `tolerance` is the relative and
    /// the absolute error of a Taylor step; [`tolerances`](Self::tolerances) tells others.
    ///
    /// # Errors
    /// Those of [`equations`]: another number of formulas than components; [`equations::Error::Tolerance`] unless 10⁻¹⁷ ≤ `tolerance` ≤ 0.1;
    /// [`equations::Error::Time`] for times that are not finite.
    pub fn new(
        field: &Formulas,
        (from, to): (f64, f64),
        tolerance: f64,
    ) -> Result<FlowSteps, Error> {
        if !(from.is_finite() && to.is_finite()) {
            return Err(equations::Error::Time { time: from, end: to }.into());
        }
        let series = Series::new(field, None)?;
        let (each, longest_step) =
            (vec![(tolerance, tolerance); series.dimension()], f64::INFINITY);
        let steps = FlowSteps { series, from, to, tolerance, each, longest_step };
        steps.flow()?;
        Ok(steps)
    }

    /// The same with an absolute and a relative tolerance of each component, and no Taylor step longer than a time. The order of the steps stays.
    ///
    /// # Errors
    /// Those of [`TaylorFlow::tolerances`] and [`TaylorFlow::longest_step`].
    pub fn tolerances(
        mut self,
        each: Vec<(f64, f64)>,
        longest_step: f64,
    ) -> Result<FlowSteps, Error> {
        (self.each, self.longest_step) = (each, longest_step);
        self.flow()?;
        Ok(self)
    }

    fn flow(&self) -> Result<TaylorFlow<'_>, equations::Error> {
        TaylorFlow::new(&self.series, self.tolerance, 0.0)?
            .tolerances(self.each.clone())?
            .longest_step(self.longest_step)
    }
}

impl StateMap for FlowSteps {
    fn dimension(&self) -> Option<usize> {
        Some(self.series.dimension())
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        let end = self.flow().and_then(|flow| flow.state_at(self.from, state, self.to));
        end.is_ok_and(|end| {
            image.copy_from_slice(&end);
            true
        })
    }

    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        let starts: Vec<&[f64]> = states.iter().map(Vec::as_slice).collect();
        let ends = self.flow().and_then(|flow| flow.states_at(&[self.from], &starts, &[self.to]));
        has_image.fill(ends.is_ok());
        if let Ok(ends) = ends {
            ends.failed.iter().for_each(|(failed, _)| has_image[*failed] = false);
            states.iter_mut().zip(ends.values).for_each(|(column, ends)| *column = ends);
        }
    }

    /// Enough for eight lanes while some motions take longer.
    fn together(&self) -> usize {
        32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use equations::Names;

    #[test]
    fn tolerances_of_components_change_the_steps_and_wrong_ones_are_refused() {
        let names = Names::new(&["x", "v"], &[]).unwrap();
        let field = Formulas::from_text(names, &["v", "x - x^3 - v/10"]).unwrap();
        let steps = || FlowSteps::new(&field, (0.0, 3.0), 1e-12).unwrap();
        let image = |steps: &FlowSteps| {
            let mut image = [0.0; 2];
            assert!(steps.image(&[0.3, 0.1], &mut image));
            image
        };
        let fine = image(&steps());
        let same = steps().tolerances(vec![(1e-12, 1e-12); 2], f64::INFINITY).unwrap();
        assert_eq!(image(&same), fine);
        let coarse = steps().tolerances(vec![(1e-3, 1e-3); 2], f64::INFINITY).unwrap();
        let error = (image(&coarse)[0] - fine[0]).abs();
        assert!(0.0 < error && error < 1e-2, "{error}");
        // Many at once have the same bits.
        let (mut columns, mut has_image) = (vec![vec![0.3; 9], vec![0.1; 9]], [true; 9]);
        coarse.images(&mut columns, &mut has_image);
        assert!(has_image.iter().all(|has| *has) && columns[0][8] == image(&coarse)[0]);
        assert!(steps().tolerances(vec![(1e-3, 1e-3)], f64::INFINITY).is_err());
        assert!(steps().tolerances(vec![(0.0, 0.0); 2], f64::INFINITY).is_err());
        assert!(steps().tolerances(vec![(1e-3, 1e-3); 2], 0.0).is_err());
    }
}
