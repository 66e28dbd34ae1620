//! From a section back to it.

use crate::{Error, Section, SmoothSection};
use hybrid_system::{
    ArcEnd, Differentiable, Execution, HybridSystem, Limits, Stop, event_sensitivity,
};
use nalgebra::{RowSVector, SMatrix, SVector};

/// The map from a section to the next event on it, along executions of a hybrid system.
#[derive(Debug, Clone, Copy)]
pub struct ReturnMap<'a, T, C, const N: usize> {
    /// The system.
    pub system: &'a T,
    /// The section.
    pub section: &'a C,
    /// How far one return may go.
    pub limits: Limits,
}

/// A return to the section, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothReturn<const K: usize> {
    /// The return.
    pub to: Return<K>,
    /// Derivative of the image.
    pub derivative: SMatrix<f64, K, K>,
    /// Derivative of the return time.
    pub time_derivative: RowSVector<f64, K>,
}

/// A return to the section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Return<const K: usize> {
    /// Where on the section, the image.
    pub coordinates: SVector<f64, K>,
    /// Return time.
    pub time: f64,
    /// Number of events on the way, the last one included.
    pub events: usize,
}

impl<'a, T, C, const N: usize> ReturnMap<'a, T, C, N>
where
    T: HybridSystem<N>,
{
    /// The map of `system` on `section`; `limits` bound each return.
    pub fn new(system: &'a T, section: &'a C, limits: Limits) -> Self {
        ReturnMap { system, section, limits }
    }

    /// Follows the execution from `coordinates` to its next event on the section.
    ///
    /// # Errors
    /// [`Error::NoReturn`] if the execution ends before; [`Error::Execution`] if it fails.
    pub fn next<const K: usize>(&self, coordinates: &SVector<f64, K>) -> Result<Return<K>, Error>
    where
        C: Section<T, N, K>,
    {
        let (mode, state) = self.section.point(coordinates);
        let mut execution = Execution::new(self.system, mode, state, self.limits);
        let (mut time, mut events) = (0.0, 0);
        for arc in execution.by_ref() {
            let arc = arc?;
            time = arc.time + arc.duration;
            let Some(event) = arc.event() else { continue };
            events += 1;
            if let Some(coordinates) = self.section.coordinates(event) {
                return Ok(Return { coordinates, time, events });
            }
        }
        let stop = execution.stop().unwrap_or(Stop::Failed);
        Err(Error::NoReturn { stop, time, events })
    }

    /// The same with the derivatives of image and return time, by state transition along the arcs and through
    /// the events, each compared at the event itself.
    ///
    /// # Errors
    /// As [`next`](Self::next), and as [`event_sensitivity`]: a return that grazes a guard, or passes infinitely many
    /// events, has no derivative.
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
        let (mut time, mut events) = (0.0, 0);
        for arc in execution.by_ref() {
            let arc = arc?;
            time = arc.time + arc.duration;
            if matches!(arc.end, ArcEnd::Zeno { .. }) {
                return Err(hybrid_system::Error::NoSensitivity { time: arc.time }.into());
            }
            let Some(event) = arc.event() else { continue };
            events += 1;
            let back = self.section.coordinates(event);
            if back.is_none() && event.after.is_none() {
                continue;
            }
            let (through, delay) = event_sensitivity(self.system, &arc)?;
            time_derivative += delay * change;
            change = through * change;
            if let Some(coordinates) = back {
                let derivative = self.section.coordinates_jacobian(event) * change;
                let to = Return { coordinates, time, events };
                return Ok(SmoothReturn { to, derivative, time_derivative });
            }
        }
        let stop = execution.stop().unwrap_or(Stop::Failed);
        Err(Error::NoReturn { stop, time, events })
    }

    /// The image of a point of a one-dimensional section; nothing if it never returns.
    ///
    /// # Errors
    /// As [`next`](Self::next), except that an execution that provably never returns is no error.
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
