//! How the returns of equations are computed: executions from a section to a section.

use super::equation_returns::{EquationReturns, ReturnModel};
use super::family::Image;
use super::return_arcs::{ReturnArcs, elapsed, itinerary, least_certain};
use crate::checks::check_dimension;
use crate::error::Error;
use equations::{Jet, Series};
use hybrid_system::{Along, Execution, Limits, Stop};
use nalgebra::DVector;
use std::sync;

/// A return from a point.
#[derive(Debug)]
pub(super) struct Way {
    pub(super) arcs: ReturnArcs,
    /// The point from which it begins.
    pub(super) from: Vec<f64>,
    pub(super) model: sync::Arc<ReturnModel>,
    /// The time at which it begins. That of the arcs counts from there.
    pub(super) begin: f64,
}

/// How far the state at the start of a return may be from that after the one before, in parts of its size, for the execution to go on:
/// the rounding of the coordinates.
const SAME: f64 = 1e-12;

/// The time at which a return begins, unless the start says another one.
const START: f64 = 0.0;

/// The number of models that are kept. A map has many images at one parameter, and a diagram computes as many columns at once as there are
/// processors.
const KEPT_MODELS: usize = 16;

impl EquationReturns {
    /// The model at a value of the parameter.
    pub(super) fn model(&self, value: Option<f64>) -> Result<sync::Arc<ReturnModel>, Error> {
        let bits = value.map(f64::to_bits);
        if let Ok(models) = self.models.try_lock()
            && let Some((_, model)) = models.iter().find(|(known, _)| Some(*known) == bits)
        {
            return Ok(sync::Arc::clone(model));
        }
        let equations = match value {
            Some(value) => {
                self.equations.clone().with_parameters(&[(&self.parameter, &format!("{value:?}"))])
            }
            None => self.equations.clone(),
        };
        let model = sync::Arc::new(equations.model::<DVector<f64>>()?.tolerances(self.tolerances));
        if let (Ok(mut models), Some(bits)) = (self.models.try_lock(), bits) {
            models.truncate(KEPT_MODELS - 1);
            models.insert(0, (bits, sync::Arc::clone(&model)));
        }
        Ok(model)
    }

    /// The parameters of the equations as jets, with one of them moving.
    pub(super) fn parameters<const T: usize>(
        &self,
        moving: Jet<T>,
    ) -> impl Iterator<Item = Jet<T>> + '_ {
        let names = self.equations.names();
        names.parameters.iter().zip(&names.values).map(move |(name, value)| {
            if *name == self.parameter { moving } else { Jet::number(value.value()) }
        })
    }

    /// The state and the time at which a return starts.
    pub(super) fn start<const T: usize>(
        &self,
        coordinates: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<(Vec<Jet<T>>, Jet<T>), Error> {
        let what = "the coordinates of a section";
        check_dimension(what, self.section.states.len(), coordinates.len())?;
        match &self.start {
            Some(start) => {
                let begin = Jet::number(START);
                let mut state = start.values((coordinates, begin), self.parameters(parameter))?;
                let has_time = state.len() > self.equations.names().states.len();
                let time = if has_time { state.pop() } else { None };
                Ok((state, time.unwrap_or(Jet::number(START))))
            }
            None => {
                let place = |name| self.section.states.iter().position(|own| own == name);
                let names = self.equations.names().states.iter();
                let of = |name| place(name).map_or(Jet::number(0.0), |place| coordinates[place]);
                Ok((names.map(of).collect(), Jet::number(START)))
            }
        }
    }

    /// The coordinates of a state.
    fn image_of<const T: usize>(
        &self,
        (state, time): (&[Jet<T>], Jet<T>),
        parameter: Jet<T>,
    ) -> Result<Vec<Jet<T>>, Error> {
        // The time is no component of the formulas.
        let names = &self.equations.names().states;
        let state = &state[..names.len().min(state.len())];
        match &self.coordinates {
            Some(coordinates) => coordinates.values((state, time), self.parameters(parameter)),
            None => {
                let of = |name: &String| {
                    let place = names.iter().position(|own| own == name);
                    let reason = "no component of the state: give the coordinates by formulas";
                    let name = name.clone();
                    place.map(|place| state[place]).ok_or(equations::Error::Name { name, reason })
                };
                Ok(self.section.states.iter().map(of).collect::<Result<_, _>>()?)
            }
        }
    }

    /// The execution from a point, and the time at which it begins. The times of its arcs count from there.
    pub(super) fn begin<'m>(
        &self,
        model: &'m ReturnModel,
        (point, parameter): (&[f64], f64),
    ) -> Result<(Execution<'m, ReturnModel>, f64), Error> {
        let coordinates: Vec<Jet<1>> = point.iter().map(|x| Jet([*x])).collect();
        let (state, begin) = self.start(&coordinates, Jet([parameter]))?;
        let mut state: Vec<f64> = state.iter().map(Jet::value).collect();
        let dimension = model.series(self.mode.as_str()).map_or(0, Series::dimension);
        if state.len() + 1 == dimension {
            state.push(begin.value());
        }
        let run = Execution::new(model, self.mode, DVector::from(state), self.limits);
        Ok((run, begin.value()))
    }

    /// The arcs of an execution up to its next return.
    pub(super) fn next_return(
        &self,
        run: &mut Execution<'_, ReturnModel>,
    ) -> Result<ReturnArcs, Error> {
        let (begin, events_before) = (run.time(), run.jump());
        let (mut arcs, mut last) = (Vec::new(), None);
        for arc in run.by_ref() {
            let arc = arc?;
            let back = arc.event().is_some_and(|event| {
                last = Some(event.surface);
                let at_once = event.time - begin <= event.time_rounding;
                event.surface == self.surface && !at_once && event.after.is_some()
            });
            arcs.push(arc);
            if back {
                return Ok(arcs);
            }
        }
        let stop = run.stop().unwrap_or(Stop::Failed);
        let surface = last.filter(|_| stop == Stop::Terminal).map(|surface| surface.to_string());
        let (time, events) = (run.time() - begin, run.jump() - events_before);
        let (start, parameter) = (Vec::new(), None);
        Err(Error::NoReturn { start, parameter, stop, surface, time, events })
    }

    /// The execution behind a return, with the limits of the next one; `None` if the next return begins anew.
    pub(super) fn going_on<'m>(
        &self,
        (way, model): (&Way, &'m ReturnModel),
        run: &Execution<'m, ReturnModel>,
        (image, parameter): (&Image, f64),
    ) -> Result<Option<Execution<'m, ReturnModel>>, Error> {
        if !self.is_autonomous || !self.goes_on(&way.arcs, image, parameter)? {
            return Ok(None);
        }
        let (time, events) = (run.time() + self.limits.time, run.jump());
        let events = events.saturating_add(self.limits.events);
        let limits = Limits { time, events, ..self.limits };
        Ok(Some(Execution::restore(model, run.checkpoint(), limits)))
    }

    /// True if a return may go on from the event that has ended the one before: it does from the same mode and state.
    fn goes_on(&self, arcs: &ReturnArcs, image: &Image, parameter: f64) -> Result<bool, Error> {
        let after = arcs.last().and_then(|arc| arc.event()?.after.as_ref());
        let Some((mode, state)) = after else { return Ok(false) };
        let coordinates: Vec<Jet<1>> = image.point.iter().map(|x| Jet([*x])).collect();
        let (start, _) = self.start(&coordinates, Jet([parameter]))?;
        let size = state.amax().max(f64::MIN_POSITIVE);
        let is_same = |(own, again): (&f64, &Jet<1>)| (own - again.value()).abs() <= SAME * size;
        Ok(*mode == self.mode && state.iter().zip(&start).all(is_same))
    }

    /// The return from a point.
    pub(super) fn way(&self, point: &[f64], parameter: f64) -> Result<Way, Error> {
        let model = self.model(Some(parameter))?;
        let (mut run, begin) = self.begin(&model, (point, parameter))?;
        let arcs = self.next_return(&mut run);
        let arcs = arcs.map_err(|error| error.at_start(point, Some(parameter)))?;
        Ok(Way { arcs, from: point.to_vec(), model, begin })
    }

    /// The image at the end of a return.
    pub(super) fn image_after(&self, way: &Way, parameter: f64) -> Result<Image, Error> {
        let arcs = &way.arcs;
        let still = |value: f64| Jet::<1>([value]);
        let after = arcs.last().and_then(|arc| arc.event()?.after.as_ref());
        let state = after.map_or(&[][..], |(_, state)| state.as_slice());
        let state: Vec<Jet<1>> = state.iter().copied().map(still).collect();
        let at = (&state[..], still(way.begin + elapsed(arcs)));
        let image = self.image_of(at, still(parameter))?;
        let (point, certainty): (Vec<f64>, _) =
            (image.iter().map(Jet::value).collect(), least_certain(arcs));
        if !point.iter().all(|x| x.is_finite()) {
            return Err(Error::NoImage { point: way.from.clone(), parameter });
        }
        Ok(Image {
            point,
            itinerary: itinerary(arcs, |mode| mode.to_string()),
            time: elapsed(arcs),
            certainty,
        })
    }

    /// The image of a curve at the end of the arcs from its first point; and the error of its derivative over that of the motion. The error
    /// of the motion grows as neighbours part on the way, and moves the derivative by as much of its largest value on the way.
    pub(super) fn pushed_along<const T: usize>(
        &self,
        way: &Way,
        curve: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<(Vec<Jet<T>>, f64), Error> {
        let (mut start, begin) = self.start(curve, parameter)?;
        if way.arcs.first().is_some_and(|arc| arc.start.len() > start.len()) {
            start.push(begin);
        }
        let along = Along::curve(&start).and_parameter_curve(&self.parameter, parameter);
        let back = way.model.jet::<T>(&way.arcs, &along)?;
        // The time of the arcs is that since their start.
        let mut time = begin;
        time.0.iter_mut().zip(back.time.0).skip(1).for_each(|(own, more)| *own += more);
        time.0[0] += elapsed(&way.arcs);
        let image = self.image_of((&back.state, time), parameter)?;
        let [first, last, own] = [&start, &back.state, &image].map(|state| {
            state.iter().fold(0.0, |most: f64, jet| most.max(jet.0.get(1).map_or(0.0, |x| x.abs())))
        });
        // A start that does not move says nothing of neighbours, and an image that does not nothing of the coordinates.
        let ratio = |above: f64, below: f64| if below > 0.0 { above / below } else { 1.0 };
        let parted = ratio(back.largest, first).max(1.0);
        Ok((image, parted * back.largest * ratio(own, last)))
    }
}
