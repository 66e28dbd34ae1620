//! The return map: from a section to the next event on it.

use crate::error::Error;
use crate::events::{less_certain, plain};
use crate::section::{Section, SmoothSection};
use hybrid_system::{
    Arc, ArcEnd, Certainty, Differentiable, Event, Execution, HybridSystem, Limits, State, Stop,
    event_sensitivity,
};
use nalgebra::{RowSVector, SMatrix, SVector};
use std::fmt::Debug;

/// The map from a section to the next event on it, along executions of a hybrid system.
#[derive(Debug, Clone, Copy)]
pub struct ReturnMap<'a, T, C, const N: usize> {
    /// The system.
    pub system: &'a T,
    /// The section.
    pub section: &'a C,
    /// Limits on the time and the events of one return.
    pub limits: Limits,
    /// Whether an event on the section at the start itself, after no time, is a return. Default: false, so that a
    /// start on the surface of its own section never returns at once.
    pub counts_at_once: bool,
}

/// A return to the section, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothReturn<const K: usize> {
    /// The return.
    pub to: Return<K>,
    /// Derivative of the image with respect to the start.
    pub derivative: SMatrix<f64, K, K>,
    /// Derivative of the return time with respect to the start.
    pub time_derivative: RowSVector<f64, K>,
    /// How far an entry of the derivative may be off: an estimate. The error of the motion is taken from those of the times of the events
    /// ([`Event::time_error`]), and grows as neighbours part on the way.
    pub error: f64,
}

/// A return to the section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Return<const K: usize> {
    /// The image: coordinates on the section.
    pub coordinates: SVector<f64, K>,
    /// Return time.
    pub time: f64,
    /// Number of events, the last one on the section included.
    pub events: usize,
    /// How certain it is that no event on the way was missed: the least certain one counts.
    pub certainty: Certainty,
}

impl<'a, T, C, const N: usize> ReturnMap<'a, T, C, N>
where
    T: HybridSystem<State = State<N>>,
{
    /// The map of `system` on `section`; `limits` bound each return.
    pub fn new(system: &'a T, section: &'a C, limits: Limits) -> Self {
        ReturnMap { system, section, limits, counts_at_once: false }
    }

    /// Follows the execution from `coordinates` to its next event on the section. An event at the start itself is none.
    ///
    /// # Errors
    /// [`Error::NoReturn`] if the execution ends before it returns; [`Error::Execution`] if it fails.
    pub fn next<const K: usize>(&self, coordinates: &SVector<f64, K>) -> Result<Return<K>, Error>
    where
        C: Section<T, N, K>,
    {
        self.next_along(coordinates, |_| {})
    }

    /// The same; `see` receives each arc on the way, with its mode, its event and how certain this is.
    ///
    /// # Errors
    /// As [`next`](Self::next).
    pub fn next_along<const K: usize>(
        &self,
        coordinates: &SVector<f64, K>,
        mut see: impl FnMut(&Arc<T::Mode, T::Surface, State<N>>),
    ) -> Result<Return<K>, Error>
    where
        C: Section<T, N, K>,
    {
        let (mut time, mut events, mut certainty) = (0.0, 0, Certainty::Exact);
        let image = next_return(
            self.system,
            self.section.point(coordinates),
            (self.limits, self.counts_at_once),
            |event| self.section.coordinates(event),
            |arc| {
                time = arc.time + arc.duration;
                if let Some(event) = arc.event() {
                    events += 1;
                    certainty = less_certain(certainty, event.certainty);
                }
                see(&arc);
            },
        )
        .map_err(|error| error.at_start(coordinates.as_slice(), None))?;
        Ok(Return { coordinates: image, time, events, certainty })
    }

    /// The next return, with the derivatives of image and return time.
    ///
    /// The derivative is the product of the state-transition matrices of the arcs and of the events. Perturbed
    /// executions are compared at the events themselves, not at equal times.
    ///
    /// # Errors
    /// As [`next`](Self::next), and as [`event_sensitivity`]: a return that grazes a guard, or that passes a Zeno
    /// limit, has no derivative.
    pub fn next_with_derivative<const K: usize>(
        &self,
        coordinates: &SVector<f64, K>,
    ) -> Result<SmoothReturn<K>, Error>
    where
        T: Differentiable<N>,
        C: SmoothSection<T, N, K>,
    {
        let (mode, state) = self.section.point(coordinates);
        let mut change = self.section.point_jacobian(coordinates);
        let mut time_derivative = RowSVector::zeros();
        let mut execution = Execution::new(self.system, mode, state, self.limits);
        let (mut time, mut events, mut surface) = (0.0, 0, None);
        let (mut certainty, mut rate) = (Certainty::Exact, f64::EPSILON);
        let (first, mut largest) = (change.amax(), change.amax());
        for arc in execution.by_ref() {
            let arc = arc?;
            time = arc.time + arc.duration;
            if matches!(arc.end, ArcEnd::Zeno { .. }) {
                return Err(hybrid_system::Error::NoSensitivity { time: arc.time }.into());
            }
            let Some(event) = arc.event() else { continue };
            (events, surface) = (events + 1, Some(event.surface));
            certainty = less_certain(certainty, event.certainty);
            let back =
                self.section.coordinates(event).filter(|_| !is_at_once(event, self.counts_at_once));
            // A terminal event off the section: the execution ends, and this loop ends too.
            if back.is_none() && event.after.is_none() {
                continue;
            }
            let (through, delay) = event_sensitivity(self.system, &arc)?;
            time_derivative += delay * change;
            change = through * change;
            // As a part of the arc: an arc of no time has no error.
            let part = if arc.duration > 0.0 { event.time_error / arc.duration } else { 0.0 };
            rate += f64::EPSILON + part.min(1.0);
            largest = largest.max(change.amax());
            if let Some(coordinates) = back {
                let derivative = self.section.coordinates_jacobian(event) * change;
                let to = Return { coordinates, time, events, certainty };
                let parted = if first > 0.0 { (largest / first).max(1.0) } else { 1.0 };
                let error = rate * parted * largest.max(derivative.amax());
                return Ok(SmoothReturn { to, derivative, time_derivative, error });
            }
        }
        let none = no_return(execution.stop(), surface, time, events);
        Err(none.at_start(coordinates.as_slice(), None))
    }

    /// The image of a point of a one-dimensional section; `None` if the execution ends without a return.
    ///
    /// An execution ends in a mode without a further event, in a terminal mode, or at a Zeno limit after which the
    /// system does not go on. That there is no further event is as certain as the search of the mode's guards
    /// ([`hybrid_system::Certainty`]).
    ///
    /// # Errors
    /// As [`next`](Self::next), except that an execution that ends gives `None`. An execution that reaches a limit
    /// may still return later, and is an error.
    pub fn image(&self, coordinate: f64) -> Result<Option<f64>, Error>
    where
        C: Section<T, N, 1>,
    {
        match self.next(&SVector::<f64, 1>::new(coordinate)) {
            Ok(back) => Ok(Some(back.coordinates[0])),
            Err(Error::NoReturn {
                stop: Stop::NoFurtherEvent | Stop::Terminal | Stop::Zeno,
                ..
            }) => Ok(None),
            Err(error) => Err(error),
        }
    }
}

/// True if an event is after no time: at the start itself, within the rounding of its time.
fn is_at_once<M, S, X>(event: &Event<M, S, X>, counts: bool) -> bool {
    !counts && event.time <= event.time_rounding
}

/// What `coordinates` gives of the first event after a start that is a return. `see` receives each arc on the way.
pub(crate) fn next_return<T: HybridSystem, R>(
    system: &T,
    (mode, state): (T::Mode, T::State),
    (limits, counts_at_once): (Limits, bool),
    coordinates: impl Fn(&Event<T::Mode, T::Surface, T::State>) -> Option<R>,
    mut see: impl FnMut(Arc<T::Mode, T::Surface, T::State>),
) -> Result<R, Error> {
    let mut execution = Execution::new(system, mode, state, limits);
    let (mut time, mut events, mut surface) = (0.0, 0, None);
    for arc in execution.by_ref() {
        let arc = arc?;
        time = arc.time + arc.duration;
        let back = arc.event().and_then(|event| {
            (events, surface) = (events + 1, Some(event.surface));
            coordinates(event).filter(|_| !is_at_once(event, counts_at_once))
        });
        see(arc);
        if let Some(back) = back {
            return Ok(back);
        }
    }
    Err(no_return(execution.stop(), surface, time, events))
}

/// The error of an execution that ended before its return, after the last event on this surface.
fn no_return<S: Debug>(stop: Option<Stop>, last: Option<S>, time: f64, events: usize) -> Error {
    let stop = stop.unwrap_or(Stop::Failed);
    let surface = last.filter(|_| stop == Stop::Terminal).map(|surface| plain(&surface));
    let (start, parameter) = (Vec::new(), None);
    Error::NoReturn { start, parameter, stop, surface, time, events }
}
