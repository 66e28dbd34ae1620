//! Motions side by side: each in a lane, with its own steps, and with the bits of one alone.

use crate::algebra::Arithmetic;
use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::formulas::length;
use crate::lanes::{Lanes, WIDTH};
use crate::simd;
use crate::step::{Step, end_of, memory, outline};
use crate::taylor_flow::TaylorFlow;

/// One step of all lanes: where it is right. Elsewhere the step is to be done alone.
#[inline(always)]
pub(crate) fn step_of_lanes(
    flow: &TaylorFlow<'_>,
    (time, end): (Lanes, Lanes),
    state: &[Lanes],
    step: &mut Step<Lanes>,
) -> Lanes {
    let zero = flow.series.compute(&time, state, &mut step.coefficients);
    step.time = time;
    let left = end.with(time, |end, time| (end - time).abs());
    let mut length = flow.length_for_state(&step.coefficients).smaller(left);
    for (lane, length) in length.0.iter_mut().enumerate() {
        *length = flow.length_for_watched(&step.coefficients, |x| x.0[lane], *length);
    }
    step.end = end_of(time, length, end);
    let moved = step.end.with(time, |end, time| f64::from(end != time));
    let right = flow.is_right(step).with(zero, |right, zero| right + zero);
    right.with(moved, |right, moved| f64::from(right == 1.0 && moved == 1.0))
}

/// Motions that are followed side by side, step by step: each part of the field is looked up once for all of them.
///
/// A motion is in a lane, below [`WIDTH`](Self::WIDTH). It begins with [`begin`](Self::begin). After each
/// [`step`](Self::step) of all lanes [`go_on`](Self::go_on) brings a motion behind its own step.
pub struct SideBySide<'f> {
    flow: &'f TaylorFlow<'f>,
    followed: [bool; WIDTH],
    /// Where each one is, and its end.
    times: (Lanes, Lanes),
    state: Vec<Lanes>,
    step: Step<Lanes>,
    /// Where the last step is right.
    right: Lanes,
    /// Memory for a step that is done alone.
    single: Step,
    single_state: Vec<f64>,
}

impl<'f> SideBySide<'f> {
    /// The number of lanes.
    pub const WIDTH: usize = WIDTH;

    /// Without motions.
    ///
    /// # Errors
    /// Never, for a flow that [`TaylorFlow::new`] has made.
    pub fn new(flow: &'f TaylorFlow<'f>) -> Result<Self, Error> {
        let dimension = flow.series.dimension();
        Ok(SideBySide {
            flow,
            followed: [false; WIDTH],
            times: (Lanes::zero(), Lanes::zero()),
            state: vec![Lanes::zero(); dimension],
            step: memory(flow.series, flow.order)?,
            right: Lanes::zero(),
            single: flow.memory()?,
            single_state: vec![0.0; dimension],
        })
    }

    /// Begins a motion in a lane, from a time and a state, up to `end`.
    ///
    /// # Errors
    /// [`Error::Time`] for a time or an end that is not finite; [`Error::Length`] for a state of another length, and for a lane that is
    /// not there.
    pub fn begin(
        &mut self,
        lane: usize,
        time: f64,
        state: impl ExactSizeIterator<Item = f64>,
        end: f64,
    ) -> Result<(), Error> {
        length("components of the state", self.state.len(), state.len())?;
        if !(time.is_finite() && end.is_finite()) {
            return Err(Error::Time { time, end });
        }
        let Some(followed) = self.followed.get_mut(lane) else { return Err(no_lane(lane)) };
        *followed = true;
        (self.times.0.0[lane], self.times.1.0[lane]) = (time, end);
        self.state.iter_mut().zip(state).for_each(|(own, x)| own.0[lane] = x);
        Ok(())
    }

    /// Ends the motion in a lane.
    pub fn end(&mut self, lane: usize) {
        if let Some(followed) = self.followed.get_mut(lane) {
            *followed = false;
        }
    }

    /// Whether a motion is in a lane.
    pub fn is_followed(&self, lane: usize) -> bool {
        self.followed.get(lane).is_some_and(|followed| *followed)
    }

    /// The state in a lane.
    pub fn state(&self, lane: usize) -> impl Iterator<Item = f64> {
        self.state.iter().filter_map(move |x| x.0.get(lane).copied())
    }

    /// One step of all lanes; false if none has a motion.
    pub fn step(&mut self) -> bool {
        let Some(followed) = self.followed.iter().position(|followed| *followed) else {
            return false;
        };
        self.repeat(followed);
        self.right = simd::step_of_lanes(self.flow, self.times, &self.state, &mut self.step);
        true
    }

    /// Lets free lanes repeat one that is followed: every number that is computed belongs to a motion that was asked for.
    fn repeat(&mut self, lane: usize) {
        let SideBySide { followed, times: (time, end), state, .. } = self;
        for lanes in [time, end].into_iter().chain(state) {
            let repeated = lanes.0[lane];
            let free = (0..WIDTH).filter(|free| !followed[*free]);
            free.for_each(|free| lanes.0[free] = repeated);
        }
    }

    /// Brings the motion in a lane behind its step, which is done alone unless it is right: the time there. `see` may
    /// receive the step, in memory of [`TaylorFlow::outline`].
    ///
    /// # Errors
    /// As [`TaylorFlow::step`]; [`Error::Length`] for a lane without a motion.
    pub fn go_on(&mut self, lane: usize, see: Option<&mut Step>) -> Result<f64, Error> {
        if !self.is_followed(lane) {
            return Err(no_lane(lane));
        }
        if self.right.0[lane] == 1.0 {
            for (x, end) in self.state.iter_mut().zip(&self.step.state_at_end) {
                x.0[lane] = end.0[lane];
            }
            if let Some(see) = see {
                self.step.show(|x| x.0[lane], see);
            }
            self.times.0.0[lane] = self.step.end.0[lane];
        } else {
            let (time, end) = (self.times.0.0[lane], self.times.1.0[lane]);
            self.single_state.iter_mut().zip(&self.state).for_each(|(own, x)| *own = x.0[lane]);
            self.times.0.0[lane] =
                self.flow.one_step(time, &mut self.single_state, end, &mut self.single)?;
            self.state.iter_mut().zip(&self.single_state).for_each(|(x, own)| x.0[lane] = *own);
            if let Some(see) = see {
                self.single.show(|x| *x, see);
            }
        }
        Ok(self.times.0.0[lane])
    }
}

/// The error of a lane that is not there, or has no motion.
fn no_lane(lane: usize) -> Error {
    Error::Length { what: "lanes with a motion", needed: lane + 1, given: 0 }
}

impl TaylorFlow<'_> {
    /// Memory for the polynomials of a step, without that for its computation.
    ///
    /// # Errors
    /// Never, for a flow that [`TaylorFlow::new`] has made.
    pub fn outline(&self) -> Result<Step, Error> {
        outline(self.series, self.order)
    }
}
