//! The returns of equations as a family of maps.

use super::border::{BorderSite, Clearance};
use super::derivatives::{Linearized, Pushed, third_order};
use super::differences::differences;
use super::equation_returns::EquationReturns;
use super::equation_ways::Way;
use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::Jet;
use std::ops::ControlFlow;

impl MapFamily for EquationReturns {
    fn dimension(&self) -> usize {
        self.section.states.len()
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        self.image_after(&self.way(point, parameter)?, parameter)
    }

    /// Where nothing depends on the time, and a return begins at the state in which the one before has ended, the execution goes on.
    fn orbit(
        &self,
        start: &[f64],
        parameter: f64,
        images: usize,
        see: &mut dyn FnMut(Image) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        let model = self.model(Some(parameter))?;
        let (mut run, mut begin) = self.begin(&model, (start, parameter))?;
        let mut from = start.to_vec();
        for _ in 0..images {
            let arcs = self.next_return(&mut run);
            let arcs = arcs.map_err(|error| error.at_start(&from, Some(parameter)))?;
            let way = Way { arcs, from, model: model.clone(), begin };
            let image = self.image_after(&way, parameter)?;
            match self.going_on((&way, &model), &run, (&image, parameter))? {
                Some(next) => run = next,
                None => (run, begin) = self.begin(&model, (&image.point, parameter))?,
            }
            from = image.point.clone();
            if see(image).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        let point: Vec<f64> = curve.iter().map(Jet::value).collect();
        self.derivatives(&self.way(&point, parameter.value())?, curve, parameter)
    }

    /// The execution is computed once, and each derivative by a polynomial of degree one.
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        let way = self.way(point, parameter)?;
        let image = self.image_after(&way, parameter)?;
        let pushed = |curve: &[Jet<2>], moving| self.derivatives(&way, curve, moving);
        Linearized::along_axes(image, (point, parameter), pushed)
    }

    fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Option<Vec<Clearance>>, Error> {
        Ok(Some(self.observed()?.clearances(curve, parameter)?))
    }

    fn border(
        &self,
        at: (&[f64], f64),
        pieces: (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        self.border_at(at, pieces, place, within)
    }

    fn along(
        &self,
        itinerary: &[String],
        border: Option<&BorderSite>,
    ) -> Result<Box<dyn MapFamily + '_>, Error> {
        Ok(Box::new(self.passages(itinerary, border)?))
    }
}

impl EquationReturns {
    /// The image of a curve along a return from its first point: exact to the tolerance of each arc; by differences where an execution has no
    /// derivatives, as through a Zeno limit.
    fn derivatives<const T: usize>(
        &self,
        way: &Way,
        curve: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<Pushed, Error> {
        match self.pushed_along(way, curve, parameter) {
            Err(Error::Execution(hybrid_system::Error::NoSensitivity { .. })) => {
                let image = |point: &[f64], parameter| self.image(point, parameter);
                let curve: Vec<Jet<4>> = curve.iter().map(third_order).collect();
                differences(&image, &curve, third_order(&parameter))
            }
            found => {
                let (curve, growth) = found?;
                let tolerance = self.tolerances.relative.max(f64::EPSILON);
                Ok(Pushed::within(curve, tolerance * way.arcs.len() as f64 * growth))
            }
        }
    }
}
