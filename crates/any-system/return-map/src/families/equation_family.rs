//! The returns of equations as a family of maps.

use super::border::{BorderSite, Clearance};
use super::differences;
use super::equation_returns::EquationReturns;
use super::equation_ways::Way;
use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::Jet;
use nalgebra::DMatrix;
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
        for _ in 0..images {
            let way = Way { arcs: self.next_return(&mut run)?, model: model.clone(), begin };
            let image = self.image_after(&way, parameter)?;
            match self.going_on((&way, &model), &run, (&image, parameter))? {
                Some(next) => run = next,
                None => (run, begin) = self.begin(&model, (&image.point, parameter))?,
            }
            if see(image).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Vec<Jet<4>>, Error> {
        let point: Vec<f64> = curve.iter().map(Jet::value).collect();
        let way = self.way(&point, parameter.value())?;
        match self.pushed_along(&way, curve, parameter) {
            Err(Error::Execution(hybrid_system::Error::NoSensitivity { .. })) => {
                differences::pushed(self, curve, parameter)
            }
            found => found,
        }
    }

    /// The execution is computed once, and each derivative by a polynomial of degree one.
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<(Image, DMatrix<f64>), Error> {
        let way = self.way(point, parameter)?;
        let image = self.image_after(&way, parameter)?;
        let mut slopes = DMatrix::zeros(point.len(), point.len() + 1);
        for axis in 0..=point.len() {
            let along = |(k, x): (usize, &f64)| Jet::moving(*x, f64::from(k == axis));
            let curve: Vec<Jet<2>> = point.iter().enumerate().map(along).collect();
            let moving = Jet::moving(parameter, f64::from(axis == point.len()));
            let pushed = match self.pushed_along(&way, &curve, moving) {
                Err(Error::Execution(hybrid_system::Error::NoSensitivity { .. })) => {
                    let further = |jet: &Jet<2>| Jet([jet.0[0], jet.0[1], 0.0, 0.0]);
                    let curve: Vec<Jet<4>> = curve.iter().map(further).collect();
                    let pushed = differences::pushed(self, &curve, further(&moving))?;
                    pushed.iter().map(|jet| Jet([jet.0[0], jet.0[1]])).collect()
                }
                found => found?,
            };
            for (row, jet) in pushed.iter().enumerate() {
                slopes[(row, axis)] = jet.0[1];
            }
        }
        Ok((image, slopes))
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
