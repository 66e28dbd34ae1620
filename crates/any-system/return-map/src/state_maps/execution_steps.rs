//! The executions of a hybrid system over some time as a map of states.

use super::EndLabels;
use crate::events::plain;
use crate::orbits::{OrbitEnd, end_of};
use basin_of_attraction::{Label, StateMap};
use hybrid_system::{End, Error, Execution, FateOf, HybridSystem, StateVector, Stop};
use std::sync::Arc;

/// The executions of a hybrid system over some time, events included: a flow, or a stroboscopic map.
///
/// With several modes the number of the mode is the last coordinate: 0 for the first one, and so on, to the nearest integer. The
/// cells of a grid need not have it ([`StateGrid::of_coordinates`](basin_of_attraction::StateGrid::of_coordinates)). A state whose execution
/// ends before the time, at a surface or by an error, or is in none of the modes then, has no image. The label of an orbit that ends at a
/// surface is [`Label::ESCAPED`], or what [`label_ends`](Self::label_ends) says; other ends are [`Label::UNDECIDED_MAP`].
///
/// ```
/// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, RecurrenceLimits, StateGrid};
/// use hybrid_system::{Equations, Label, State};
/// use return_map::ExecutionSteps;
/// use std::f64::consts::TAU;
/// // A forced oscillator beside a stop, from the beginning of each period of the force.
/// let oscillator = Equations::new(&["x", "v"], &[("kept", "0.8")])
///     .mode_text("moves", &["v", "-x - v/10 + cos(3*t)"])
///     .rising_text("stop", "x - 1/10")
///     .resets_text(&["1/10", "-kept*v"])
///     .model::<State<3>>()?;
/// let modes = [Label::new("moves")?];
/// let periods = ExecutionSteps::new(2, &modes, |_, x| oscillator.start("moves", [x[0], x[1]], TAU / 3.0));
/// let square = Hyperrectangle::new(vec![Interval::new(-2.0, 0.2)?, Interval::new(-2.0, 2.0)?])?;
/// let limits = RecurrenceLimits { locate: 20, tests: 50, ..RecurrenceLimits::default() };
/// let found = Attractors::search(&periods, StateGrid::uniform(square, 100)?, &[vec![0.0, 0.0]], limits)?;
/// assert_eq!(found.attractors()[0].period, Some(4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ExecutionSteps<M, R> {
    dimension: usize,
    modes: Vec<M>,
    run: R,
    labels: EndLabels,
}

impl<M, R> ExecutionSteps<M, R> {
    /// The executions from and to states in these modes, of so many components. `run` gives the execution from a mode and the components,
    /// with a limit on its time.
    pub fn new<'a, T>(dimension: usize, modes: &[M], run: R) -> ExecutionSteps<M, R>
    where
        T: HybridSystem<Mode = M> + 'a,
        M: Copy,
        R: Fn(M, &[f64]) -> Result<Execution<'a, T>, Error> + Sync,
    {
        ExecutionSteps { dimension, modes: modes.to_vec(), run, labels: EndLabels::default() }
    }

    /// The same with other labels of the ends of orbits, as in [`FamilySteps::label_ends`](crate::FamilySteps::label_ends).
    #[must_use]
    pub fn label_ends(self, label: impl Fn(&OrbitEnd) -> Label + Send + Sync + 'static) -> Self {
        ExecutionSteps { labels: EndLabels(Arc::new(label)), ..self }
    }

    /// The fate of the execution from a state; `None` if the state is in none of the modes.
    fn fate<'a, T>(&self, state: &[f64]) -> Option<Result<FateOf<T>, Error>>
    where
        T: HybridSystem<Mode = M> + 'a,
        M: Copy,
        R: Fn(M, &[f64]) -> Result<Execution<'a, T>, Error> + Sync,
    {
        let number = if self.modes.len() > 1 { state[self.dimension].round() } else { 0.0 };
        let mode = self.modes.get(number as usize).filter(|_| number >= 0.0)?;
        Some((self.run)(*mode, &state[..self.dimension]).map(Execution::fate))
    }
}

impl<'a, T, M, R> StateMap for ExecutionSteps<M, R>
where
    T: HybridSystem<Mode = M> + 'a,
    M: Copy + Eq + Sync,
    R: Fn(M, &[f64]) -> Result<Execution<'a, T>, Error> + Sync,
{
    fn dimension(&self) -> Option<usize> {
        Some(self.dimension + usize::from(self.modes.len() > 1))
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        let Some(Ok(fate)) = self.fate(state) else { return false };
        let end = fate.state.components().get(..self.dimension);
        let number = self.modes.iter().position(|mode| *mode == fate.mode);
        let (End::Stopped(Stop::TimeLimit), Some(end), Some(number)) = (fate.end, end, number)
        else {
            return false;
        };
        image[..self.dimension].copy_from_slice(end);
        image[self.dimension..].fill(number as f64);
        true
    }

    fn label_of_end(&self, state: &[f64]) -> Label {
        let end = match self.fate(state) {
            Some(Ok(fate)) => match fate.end {
                End::Terminal(surface) => OrbitEnd::Terminal(plain(&surface)),
                End::Stopped(Stop::Zeno) => OrbitEnd::Zeno,
                End::Stopped(Stop::NoFurtherEvent) => OrbitEnd::NoFurtherEvent,
                End::Stopped(_) => return Label::UNDECIDED_MAP,
                End::Failed(error) => end_of(error.into()),
            },
            Some(Err(error)) => end_of(error.into()),
            None => return Label::UNDECIDED_MAP,
        };
        (self.labels.0)(&end)
    }
}
