//! Return maps of hybrid systems that depend on a parameter, with a section by two closures.

use super::border::{Border, BorderSite};
use super::derivatives::Linearized;
use super::differences::differences;
use super::family::{Image, MapFamily};
use super::return_arcs::{elapsed, itinerary, least_certain, named_border, sliding_name};
use crate::checks::check_dimension;
use crate::error::Error;
use crate::events::plain;
use crate::return_map::{ReturnMap, next_return};
use crate::section::SmoothSection;
use equations::Jet;
use hybrid_system::{Differentiable, Event, HybridSystem, Limits, State};
use nalgebra::{DMatrix, SVector};

/// The return map of a hybrid system by closures, whose derivatives are differences.
#[derive(Debug, Clone, Copy)]
pub struct SystemReturns<S, P, C> {
    dimension: usize,
    system: S,
    point: P,
    coordinates: C,
    limits: Limits,
}

/// The return map of any hybrid system that depends on a parameter: `system` gives it at a value. The section has this number of
/// coordinates: at a value of the parameter `point` gives mode and state of a start, and `coordinates` those of an event, or `None` for an
/// event that is no return. An event at the start itself, after no time, is none.
///
/// The itinerary of an image has the mode and the surface of each event on the way. Derivatives are differences, with their errors. For
/// a model of `hybrid_system::Equations` [`EquationReturns`](super::EquationReturns) has exact ones; for a system that gives its own
/// first derivatives there is [`smooth_returns`].
///
/// ```
/// use hybrid_system::*;
/// use return_map::{BranchSteps, follow_branch, returns};
/// use nalgebra::DVector;
/// use std::ops::ControlFlow::Continue;
/// // A ball on a floor that keeps the part r of its speed and adds 1 to it. The state has a dimension chosen at run time.
/// let ball = |r: f64| {
///     Model::closed_form(|(), x: &DVector<f64>, t| {
///         DVector::from_vec(vec![x[0] + t * (x[1] - t / 2.0), x[1] - t])
///     })
///     .falling((), |x: &DVector<f64>| x[0], move |x: &DVector<f64>| {
///         ((), DVector::from_vec(vec![0.0, 1.0 - r * x[1]]))
///     })
/// };
/// let bounces = returns(1, ball, |v: &[f64], _| ((), DVector::from_vec(vec![0.0, v[0]])),
///     |event, _| Some(vec![event.after.as_ref()?.1[1]]), Limits::sampled(100.0, 10, 0.01));
/// let steps = BranchSteps::default();
/// let branch = follow_branch(&bounces, 1, (&[2.0], 0.5), (0.2, 0.8), steps, |_| Continue(()))?;
/// for found in &branch.points {
///     assert!((found.point[0] - 1.0 / (1.0 - found.parameter)).abs() < 1e-9);
/// }
/// # Ok::<(), return_map::Error>(())
/// ```
pub fn returns<T, S, P, C>(
    dimension: usize,
    system: S,
    point: P,
    coordinates: C,
    limits: Limits,
) -> SystemReturns<S, P, C>
where
    T: HybridSystem,
    S: Fn(f64) -> T + Sync,
    P: Fn(&[f64], f64) -> (T::Mode, T::State) + Sync,
    C: Fn(&Event<T::Mode, T::Surface, T::State>, f64) -> Option<Vec<f64>> + Sync,
{
    SystemReturns { dimension, system, point, coordinates, limits }
}

impl<T, S, P, C> MapFamily for SystemReturns<S, P, C>
where
    T: HybridSystem,
    S: Fn(f64) -> T + Sync,
    P: Fn(&[f64], f64) -> (T::Mode, T::State) + Sync,
    C: Fn(&Event<T::Mode, T::Surface, T::State>, f64) -> Option<Vec<f64>> + Sync,
{
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        check_dimension("the coordinates of a section", self.dimension, point.len())?;
        let (system, start) = ((self.system)(parameter), (self.point)(point, parameter));
        let coordinates = |event: &_| (self.coordinates)(event, parameter);
        let image = image_of(&system, start, self.limits, coordinates, (point, parameter))?;
        check_dimension("the coordinates of an event", self.dimension, image.point.len())?;
        Ok(image)
    }

    fn border(
        &self,
        _: (&[f64], f64),
        (own, beyond): (&[String], &[String]),
        place: usize,
        _: f64,
    ) -> BorderSite {
        border_by_names(own, beyond, place)
    }
}

/// The image at the end of a return from a mode and a state.
fn image_of<T: HybridSystem>(
    system: &T,
    start: (T::Mode, T::State),
    limits: Limits,
    coordinates: impl Fn(&Event<T::Mode, T::Surface, T::State>) -> Option<Vec<f64>>,
    (from, parameter): (&[f64], f64),
) -> Result<Image, Error> {
    let mut arcs = Vec::new();
    let point = next_return(system, start, (limits, false), coordinates, |arc| arcs.push(arc))
        .map_err(|error| error.at_start(from, Some(parameter)))?;
    if !point.iter().all(|x| x.is_finite()) {
        return Err(Error::NoImage { point: from.to_vec(), parameter });
    }
    let name = |mode| system.slides_on(mode).map_or_else(|| plain(&mode), |on| sliding_name(&on));
    let (itinerary, certainty) = (itinerary(&arcs, name), least_certain(&arcs));
    Ok(Image { point, itinerary, time: elapsed(&arcs), certainty })
}

fn border_by_names(own: &[String], beyond: &[String], place: usize) -> BorderSite {
    let piece = || BorderSite { border: Border::Piece, itinerary: own.to_vec(), place, side: 1.0 };
    named_border(own, beyond, place).unwrap_or_else(piece)
}

/// The return map of a system that gives its own derivatives.
#[derive(Debug, Clone, Copy)]
pub struct SmoothReturns<S, F, const N: usize, const K: usize> {
    system: S,
    section: F,
    limits: Limits,
}

/// The return map of a [`Differentiable`] system that depends on a parameter: `system` and `section` give both at a value. First derivatives
/// by the coordinates are those of [`ReturnMap::next_with_derivative`]: by the flow's variational equations and the saltation at each
/// event, with the error that [`SmoothReturn`](crate::SmoothReturn) states. Derivatives by the parameter, and higher ones, are differences.
pub fn smooth_returns<T, C, S, F, const N: usize, const K: usize>(
    system: S,
    section: F,
    limits: Limits,
) -> SmoothReturns<S, F, N, K>
where
    T: Differentiable<N>,
    C: SmoothSection<T, N, K>,
    S: Fn(f64) -> T + Sync,
    F: Fn(f64) -> C + Sync,
{
    SmoothReturns { system, section, limits }
}

impl<T, C, S, F, const N: usize, const K: usize> MapFamily for SmoothReturns<S, F, N, K>
where
    T: Differentiable<N>,
    C: SmoothSection<T, N, K>,
    S: Fn(f64) -> T + Sync,
    F: Fn(f64) -> C + Sync,
{
    fn dimension(&self) -> usize {
        K
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        check_dimension("the coordinates of a section", K, point.len())?;
        let (system, section) = ((self.system)(parameter), (self.section)(parameter));
        let start = section.point(&SVector::from_column_slice(point));
        let coordinates = |event: &Event<T::Mode, T::Surface, State<N>>| {
            Some(section.coordinates(event)?.as_slice().to_vec())
        };
        image_of(&system, start, self.limits, coordinates, (point, parameter))
    }

    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        let image = self.image(point, parameter)?;
        let (system, section) = ((self.system)(parameter), (self.section)(parameter));
        let map = ReturnMap::new(&system, &section, self.limits);
        let found = map.next_with_derivative(&SVector::from_column_slice(point))?;
        let still: Vec<Jet<4>> = point.iter().copied().map(Jet::number).collect();
        let moving = Jet::moving(parameter, 1.0);
        let beside = differences(&|point: &[f64], p| self.image(point, p), &still, moving)?;
        let by_parameter = beside.curve.iter().map(|jet| jet.0[1]);
        let slopes = found.derivative.iter().copied().chain(by_parameter);
        let errors = std::iter::repeat_n(found.error, K * K).chain(beside.errors);
        let [slopes, errors] =
            [slopes.collect(), errors.collect()].map(|all| DMatrix::from_vec(K, K + 1, all));
        Ok(Linearized { image, slopes, errors })
    }

    fn border(
        &self,
        _: (&[f64], f64),
        (own, beyond): (&[String], &[String]),
        place: usize,
        _: f64,
    ) -> BorderSite {
        border_by_names(own, beyond, place)
    }
}
