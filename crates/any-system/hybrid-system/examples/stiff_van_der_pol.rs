//! A stiff mode: van der Pol's oscillator with μ = 1000, by an implicit method of the model's own.
//!
//! ```text
//!   ẋ = y      ẏ = μ(1 − x²)y − x          the section x = 0, in both directions
//! ```
//!
//! Near x = 2 the state returns to the slow curve y = x/(μ(1 − x²)) at the rate 3μ, and moves along it for 800 units of
//! time: an explicit method takes millions of steps there. The Rosenbrock method of order two here has a matrix in each
//! step, and its steps follow the slow motion. The model gives `flow` and `first_crossing` by this method; execution,
//! resets and limits are those of every other model.
//!
//! Run with `cargo run -p hybrid-system --example stiff_van_der_pol`.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::*;
use interval_arithmetic::bracketed_root;
use nalgebra::{Matrix2, Vector2};

/// γ = 1 − 1/√2: the method of order two is L-stable.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

struct VanDerPol {
    mu: f64,
    /// Error of a step, relative and absolute.
    tolerance: f64,
}

/// A step of the implicit method, with the cubic through its ends and the slopes there.
struct Step {
    from: f64,
    to: f64,
    states: [State<2>; 2],
    slopes: [State<2>; 2],
}

impl Step {
    fn state(&self, time: f64) -> State<2> {
        let h = self.to - self.from;
        let s = (time - self.from) / h;
        let [a, b] = self.states;
        let [fa, fb] = self.slopes;
        let bend = (b - a) * (1.0 - 2.0 * s) + (fa * (s - 1.0) + fb * s) * h;
        a * (1.0 - s) + b * s + bend * (s * (s - 1.0))
    }
}

impl VanDerPol {
    fn field(&self, x: &State<2>) -> State<2> {
        Vector2::new(x[1], self.mu * (1.0 - x[0] * x[0]) * x[1] - x[0])
    }

    /// The state after a step of size h, and its distance from the state by the embedded method of order one.
    fn rosenbrock(&self, x: &State<2>, h: f64) -> Option<(State<2>, State<2>)> {
        let jacobian = Matrix2::new(
            0.0,
            1.0,
            -2.0 * self.mu * x[0] * x[1] - 1.0,
            self.mu * (1.0 - x[0] * x[0]),
        );
        let inverse = (Matrix2::identity() - jacobian * (GAMMA * h)).try_inverse()?;
        let k1 = inverse * self.field(x);
        let k2 = inverse * (self.field(&(x + k1 * h)) - k1 * 2.0);
        Some((x + (k1 * 3.0 + k2) * (0.5 * h), (k1 + k2) * (0.5 * h)))
    }

    /// Takes steps from `start` to `end`, until `visit` returns something.
    fn steps<R>(
        &self,
        start: &State<2>,
        end: f64,
        most: usize,
        mut visit: impl FnMut(&Step) -> Result<Option<R>, Error>,
    ) -> Result<(State<2>, Option<R>), Error> {
        // A first step that changes the state by little. The controller lengthens it by up to five times at each step.
        let (mut time, mut state, mut h) = (0.0, *start, 1e-6);
        for _ in 0..most {
            if time == end {
                return Ok((state, None));
            }
            h = f64::min(h, end - time);
            let to = if h < end - time { time + h } else { end };
            if to == time {
                return Err(Error::Integration { reason: "the step is too small", time });
            }
            let trial = self.rosenbrock(&state, to - time);
            let (after, error) = trial.unwrap_or((state, State::repeat(f64::NAN)));
            let ratio = error.component_div(&after.map(|x| self.tolerance * (1.0 + x.abs())));
            let worst = ratio.norm();
            // The error is of second order in h. NaN gives the smallest factor.
            let factor = (0.9 / worst.sqrt()).clamp(0.2, 5.0);
            h *= if factor.is_nan() { 0.2 } else { factor };
            if !(worst <= 1.0) {
                continue;
            }
            let slopes = [self.field(&state), self.field(&after)];
            let step = Step { from: time, to, states: [state, after], slopes };
            if let Some(found) = visit(&step)? {
                return Ok((after, Some(found)));
            }
            (time, state) = (to, after);
        }
        Err(Error::Integration { reason: "no steps are left", time })
    }
}

/// Most steps of one arc: a hundred times the number of a half period.
const MOST_STEPS: usize = 1_000_000;

impl HybridSystem for VanDerPol {
    type State = State<2>;
    type Mode = ();
    type Surface = ();

    fn flow(&self, _: (), start: &State<2>, time: f64) -> State<2> {
        let end = self.steps(start, time, MOST_STEPS, |_| Ok(None::<()>));
        end.map_or(State::repeat(f64::NAN), |(state, _)| state)
    }

    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::either(())] }
    }

    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }

    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        // Exactly on the section: the next arc leaves it to the side of y.
        Reset::Jump { mode: (), state: Vector2::new(0.0, x[1]) }
    }

    fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
        Some(self.field(x))
    }

    fn first_crossing(
        &self,
        _: (),
        start: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        // The side of the guard: at a start on the section the execution has decided it.
        let side = search.leaving.first().map_or(start[0].signum(), |leaving| leaving.side);
        let mut longest: f64 = 0.0;
        let crossing = |step: &Step| {
            longest = longest.max(step.to - step.from);
            if step.states[1][0] * side > 0.0 {
                return Ok(None);
            }
            // At the start of the arc x may be zero: the bracket begins behind it, on the guard's side.
            let guard = |time: f64| step.state(time)[0] * side;
            let after_start = step.from + 1e-6 * (step.to - step.from);
            Ok(Some(bracketed_root(guard, after_start, step.to)?))
        };
        let most = MOST_STEPS.min(search.steps);
        let (state, time) = self.steps(start, search.horizon, most, crossing)?;
        // The ends of steps were compared: two crossings in one step would be missed.
        let certainty = Certainty::Sampled { interval: longest };
        let Some(time) = time else {
            return Ok(NextEvent::None { state: Some(state), certainty });
        };
        Ok(NextEvent::Crossing(Crossing {
            surface: (),
            time,
            // Errors of steps are damped; an estimate.
            time_rounding: 2.0 * f64::EPSILON * time,
            time_error: self.tolerance * (1.0 + time),
            state: self.flow((), start, time),
            from: None,
            kind: EventKind::Crossing,
            certainty,
        }))
    }
}

fn main() -> Result<(), Error> {
    let oscillator = VanDerPol { mu: 1000.0, tolerance: 1e-6 };
    let start = Vector2::new(2.0, 0.0);
    for arc in Execution::new(&oscillator, (), start, Limits::new(5000.0, 100)) {
        if let Some(event) = arc?.event() {
            println!("t = {:10.4}: x = 0, y = {:+.4}", event.time, event.before[1]);
        }
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Half a period is 807.20056, by the explicit pair of orders 8(7) at a tolerance of 1e-10.
    #[test]
    fn half_a_period_of_the_stiff_oscillator() {
        let oscillator = VanDerPol { mu: 1000.0, tolerance: 1e-6 };
        let start = Vector2::new(2.0, 0.0);
        let times: Vec<f64> = Execution::new(&oscillator, (), start, Limits::new(5000.0, 100))
            .filter_map(|arc| arc.unwrap().event().map(|event| event.time))
            .collect();
        assert_eq!(times.len(), 6);
        for pair in times.windows(2) {
            assert!((pair[1] - pair[0] - 807.200_56).abs() < 0.02, "{times:?}");
        }
    }
}
