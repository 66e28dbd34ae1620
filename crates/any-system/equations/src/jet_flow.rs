//! Motions with derivatives, by Taylor's method.

use crate::algebra::Arithmetic;
use crate::error::Error;
use crate::jet::Jet;
use crate::jet_series::JetSeries;
use crate::series::Coefficients;
use crate::step::{INSIDE, RATE_ERROR};
use crate::step_length::{order_of, root, safety, shortened};
use crate::taylor_flow::{MOST_HALVINGS, MOST_STEPS};

/// The sum Σ c_k x^k of jets at a jet x.
pub fn jet_horner<const T: usize>(series: &[Jet<T>], x: &Jet<T>) -> Jet<T> {
    let step = |sum: Jet<T>, c: &Jet<T>| Jet::sum(&Jet::product(&sum, x), c);
    series.iter().rev().fold(Jet::zero(), step)
}

impl JetSeries {
    /// Follows the motion from a state, the parameters included, for a `duration`, which may be below zero. The error of a
    /// component in a step is its size times `relative` and `absolute`, added; that of a derivative its largest component
    /// times `relative`.
    ///
    /// # Errors
    /// As [`coefficients`](Self::coefficients); [`Error::Tolerance`]; [`Error::Time`] for a duration that is not finite;
    /// [`Error::Stuck`] if no step is short enough, and after a million steps.
    pub fn flow<const T: usize>(
        &self,
        start: &[Jet<T>],
        duration: f64,
        (relative, absolute): (f64, f64),
    ) -> Result<Vec<Jet<T>>, Error> {
        if !((1e-17..=0.1).contains(&relative) && absolute >= 0.0) {
            return Err(Error::Tolerance { relative, absolute });
        }
        if !duration.is_finite() {
            return Err(Error::Time { time: 0.0, end: duration });
        }
        // The k-th derivative of the last term of a series is some order^k times larger: one order more for each, which is
        // e⁻² in a step.
        let order = order_of(relative) + T.saturating_sub(1);
        let (mut state, mut time) = (start.to_vec(), 0.0);
        for _ in 0..MOST_STEPS {
            if time == duration {
                return Ok(state);
            }
            let coefficients = self.coefficients(&state, order)?;
            let left = duration - time;
            let mut length = length(&coefficients, (relative, absolute), left.abs()).copysign(left);
            let mut halvings = 0;
            while !self.goes_on(&coefficients, length, (relative, absolute)) {
                length *= 0.5;
                halvings += 1;
                if halvings > MOST_HALVINGS {
                    return Err(Error::Stuck { time, end: duration });
                }
            }
            let end = if length == left { duration } else { time + length };
            if end == time {
                break;
            }
            let since = Jet::number(length);
            let states = coefficients.states().map(|series| jet_horner(series, &since));
            (state, time) = (states.collect(), end);
        }
        Err(Error::Stuck { time, end: duration })
    }

    /// The field at the end of a step and inside it is that of the polynomials, with all derivatives. A derivative is
    /// compared with the largest one.
    fn goes_on<const T: usize>(
        &self,
        coefficients: &Coefficients<Jet<T>>,
        length: f64,
        (relative, absolute): (f64, f64),
    ) -> bool {
        [INSIDE, 1.0].iter().all(|part| {
            let since = part * length;
            let at: Vec<Jet<T>> = coefficients
                .states()
                .map(|series| jet_horner(series, &Jet::number(since)))
                .collect();
            let Ok(there) = self.coefficients(&at, 1) else { return false };
            (0..T).all(|order| {
                let sizes = at.iter().map(|jet| jet.0[order].abs());
                let size = sizes.fold(0.0, f64::max);
                let mut off = 0.0_f64;
                let mut rounding = 0.0_f64;
                for (series, there) in coefficients.states().zip(there.states()) {
                    let terms = series.iter().enumerate().skip(1).rev();
                    let rate = terms.fold(0.0, |sum, (k, c)| sum * since + k as f64 * c.0[order]);
                    let own = (rate - there[1].0[order]).abs() * length.abs();
                    off = if own <= off || off.is_nan() { off } else { own };
                    rounding = rounding.max((rate * length).abs());
                }
                let scale = size.max(rounding);
                let allowed = series_order(coefficients)
                    * (relative * scale + if order == 0 { absolute } else { 0.0 });
                off <= RATE_ERROR * (allowed + f64::EPSILON * rounding + f64::MIN_POSITIVE)
            })
        })
    }
}

fn series_order<const T: usize>(coefficients: &Coefficients<Jet<T>>) -> f64 {
    coefficients.states().next().map_or(1.0, |series| series.len() as f64)
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

/// The flow with derivatives of first and of third order, compiled here. Crates that are compiled without optimization call these
/// instances, and their tests take a fraction of the time.
#[used]
static COMPILED: (Flow<2>, Flow<4>) = (JetSeries::flow::<2>, JetSeries::flow::<4>);

type Flow<const T: usize> =
    fn(&JetSeries, &[Jet<T>], f64, (f64, f64)) -> Result<Vec<Jet<T>>, Error>;
