//! Guards known by their values only: a change of sign between two samples.

use super::bracketed_root::bracketed_root;
use super::guarded_flow::GuardedFlow;
use super::same_instant::sooner;
use super::step_past_root::step_to_sign;
use crate::error::Error;
use crate::guard::Guard;
use std::fmt::Debug;

/// The first crossing among the guards with these indices, and the index of the crossed guard.
///
/// # Errors
/// [`Error::BadSamplingInterval`] if the samples would not advance to the horizon; [`Error::NotFinite`] for a guard
/// that is not finite at a sample; [`Error::UndecidedStart`] as for [`SampledGuard::advance`].
pub(crate) fn sampled_crossing<F>(
    flow: &F,
    horizon: f64,
    interval: f64,
    indices: &[usize],
) -> Result<Option<(f64, usize)>, Error>
where
    F: GuardedFlow,
{
    // The last condition: samples at an interval below an ulp of the horizon would never reach it.
    if !(interval > 0.0) || !horizon.is_finite() || horizon + interval == horizon {
        return Err(Error::BadSamplingInterval { interval, horizon });
    }
    let guards = flow.guards();
    let mut sampled: Vec<SampledGuard<F::Surface>> = indices
        .iter()
        .map(|&index| {
            let value = flow.guard_value(guards[index].surface, flow.start());
            if !value.is_finite() {
                return Err(Error::NotFinite { at: 0.0, value });
            }
            Ok(SampledGuard::new(guards[index], value))
        })
        .collect::<Result<_, _>>()?;
    let mut sample = 0u64;
    loop {
        sample += 1;
        // A product instead of a sum: rounding does not accumulate over many samples.
        let time = (sample as f64 * interval).min(horizon);
        let state = flow.state(time);
        let mut earliest: Option<(f64, usize)> = None;
        for (guard, &index) in sampled.iter_mut().zip(indices) {
            let surface = guard.guard.surface;
            let value = flow.guard_value(surface, &state);
            if !value.is_finite() {
                return Err(Error::NotFinite { at: time, value });
            }
            let Some((left, right)) = guard.advance(time, value, interval)? else { continue };
            let along = |time: f64| flow.guard_at(surface, time);
            let root = bracketed_root(along, left, right)?;
            let at = step_to_sign(along, root, right, value);
            if earliest.is_none_or(|(best, _)| sooner(at, best)) {
                earliest = Some((at, index));
            }
        }
        if earliest.is_some() || time >= horizon {
            return Ok(earliest);
        }
    }
}

/// One guard, sampled from the start of an arc.
struct SampledGuard<S> {
    guard: Guard<S>,
    /// The last sample at which the guard was not zero, and its value there; `None` if it was zero at all of them.
    last_nonzero: Option<(f64, f64)>,
    /// The first of the samples since then, at all of which the guard is exactly zero.
    first_zero: Option<f64>,
}

impl<S: Copy + Debug> SampledGuard<S> {
    fn new(guard: Guard<S>, at_start: f64) -> Self {
        let last_nonzero = (at_start != 0.0).then_some((0.0, at_start));
        SampledGuard { guard, last_nonzero, first_zero: None }
    }

    /// Takes the next sample. Returns a bracket of the root if the guard has been crossed in its direction.
    ///
    /// | before | now | meaning |
    /// |---|---|---|
    /// | any | 0 | undecided until the next value that is not zero |
    /// | 0 since the start | beyond the surface | error: crossed at once, or gone and come back between two samples |
    /// | 0 since the start | before the surface | left the start, no crossing |
    /// | one side | other side, admitted | crossing |
    fn advance(
        &mut self,
        time: f64,
        value: f64,
        interval: f64,
    ) -> Result<Option<(f64, f64)>, Error> {
        if value == 0.0 {
            self.first_zero.get_or_insert(time);
            return Ok(None);
        }
        let zero = self.first_zero.take();
        match self.last_nonzero.replace((time, value)) {
            None if self.guard.direction.leads_to(value) => Err(Error::UndecidedStart {
                surface: format!("{:?}", self.guard.surface),
                interval,
            }),
            Some((since, before)) if self.guard.direction.admits(before, value) => {
                // A sample that is exactly zero is the first root. With this sample as left end the bracket returns it;
                // with `since` the root finder could return a later one.
                Ok(Some((zero.unwrap_or(since), time)))
            }
            _ => Ok(None),
        }
    }
}
