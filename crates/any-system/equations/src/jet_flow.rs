//! Motions with derivatives, by Taylor's method.

use crate::algebra::Arithmetic;
use crate::error::Error;
use crate::jet::Jet;
use crate::jet_series::JetSeries;
use crate::series::Coefficients;
use crate::taylor_flow::{order_of, root, safety, shortened};

/// The most steps of one motion.
const MOST_STEPS: usize = 1_000_000;

/// The last step of a motion with derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct JetStep<const T: usize> {
    /// The coefficients of state and watched formulas, in powers of the time since the step began.
    pub coefficients: Coefficients<Jet<T>>,
    /// The time from its beginning to the end of the motion.
    pub length: f64,
}

/// The sum Σ c_k x^k of jets at a jet x.
pub fn jet_horner<const T: usize>(series: &[Jet<T>], x: &Jet<T>) -> Jet<T> {
    let step = |sum: Jet<T>, c: &Jet<T>| Jet::sum(&Jet::product(&sum, x), c);
    series.iter().rev().fold(Jet::zero(), step)
}

impl JetSeries {
    /// Follows the motion from a state, the parameters included, for a `duration`, which may be below zero, and gives its
    /// last step. The error of a component in a step is its size times `relative` and `absolute`, added; that of a
    /// derivative its largest component times `relative`.
    ///
    /// # Errors
    /// As [`coefficients`](Self::coefficients); [`Error::Tolerance`]; [`Error::Time`] for a duration that is not finite;
    /// [`Error::Stuck`] after a million steps.
    pub fn flow<const T: usize>(
        &self,
        start: &[Jet<T>],
        duration: f64,
        (relative, absolute): (f64, f64),
    ) -> Result<JetStep<T>, Error> {
        if !((1e-17..=0.1).contains(&relative) && absolute >= 0.0) {
            return Err(Error::Tolerance { relative, absolute });
        }
        if !duration.is_finite() {
            return Err(Error::Time { time: 0.0, end: duration });
        }
        let order = order_of(relative);
        let (mut state, mut time) = (start.to_vec(), 0.0);
        for _ in 0..MOST_STEPS {
            let coefficients = self.coefficients(&state, order)?;
            let left = duration - time;
            let length = length(&coefficients, (relative, absolute), left.abs());
            if length >= left.abs() {
                return Ok(JetStep { coefficients, length: left });
            }
            let end = time + length.copysign(left);
            if end == time {
                break;
            }
            let since = Jet::number(end - time);
            let states = coefficients.states().map(|series| jet_horner(series, &since));
            state = states.collect();
            time = end;
        }
        Err(Error::Stuck { time, end: duration })
    }
}

/// The length of a step, at most `longest`.
fn length<const T: usize>(
    coefficients: &Coefficients<Jet<T>>,
    (relative, absolute): (f64, f64),
    longest: f64,
) -> f64 {
    let order = coefficients.states().next().map_or(1, <[Jet<T>]>::len) - 1;
    if order == 0 {
        return longest;
    }
    let mut length = longest;
    for series in coefficients.states() {
        let size = |k: usize| series[k].value().abs();
        let allowed = absolute + relative * size(0);
        for k in [order - 1, order] {
            // 0/0: a component that is zero and stays.
            let radius = root(size(k) * relative / allowed, k).recip();
            length = length.min(safety(order) * radius);
        }
    }
    // A derivative may begin at zero: its last terms are small beside its largest one on the step.
    for part in 1..T {
        let size = |k: usize| {
            coefficients.states().map(|series| series[k].0[part].abs()).fold(0.0, f64::max)
        };
        length = shortened(order + 1, size, relative, length);
    }
    length
}
