//! Motions at the limits of numbers and of methods, with exact answers: what the equations and the Runge–Kutta pairs of this
//! repository do.

use super::ours::last_event;
use crate::error::Error;
use crate::text::{digit, duration, markdown_table};
use crate::timing::least_seconds;
use equations::{Formulas, Names, Series, TaylorFlow};
use hybrid_system::{Equations, Integration, Model, State, Tolerances};
use pxfm::{f_cos, f_sin};
use std::convert::Infallible;
use std::time::Duration;

/// The tolerance of all of them, relative; the absolute one is zero for the smallest states.
const TOLERANCE: f64 = 1e-12;

/// Time for the runs of one motion; one that takes longer is followed once.
const SHARE: Duration = Duration::from_millis(100);

/// Periods whose events are counted: a million events.
const TURNS: f64 = 500_000.0;

/// A motion: what is hard about it, and the relative error by each of both.
struct Hard {
    what: &'static str,
    taylor: fn() -> Result<f64, Error>,
    runge_kutta: fn() -> Result<f64, Error>,
}

const ALL: [Hard; 9] = [
    Hard {
        what: "ẋ = √x from x = 0, where two motions begin",
        taylor: || taylor("sqrt(x)", 0.0, (0.0, 1.0), 0.0),
        runge_kutta: || runge_kutta(|_, x| x.sqrt(), 0.0, (0.0, 1.0), 0.0),
    },
    Hard {
        what: "ẋ = √x from x = 1 backward, up to x = 10⁻¹²",
        taylor: || taylor("sqrt(x)", 1.0, (0.0, -1.999_998), 1e-12),
        runge_kutta: || runge_kutta(|_, x| x.sqrt(), 1.0, (0.0, -1.999_998), 1e-12),
    },
    Hard {
        what: "ẋ = x² up to 10⁻⁶ before its pole",
        taylor: || taylor("x^2", 1.0, (0.0, POLE), 1.0 / (1.0 - POLE)),
        runge_kutta: || runge_kutta(|_, x| x * x, 1.0, (0.0, POLE), 1.0 / (1.0 - POLE)),
    },
    Hard {
        what: "ẋ = −x from x = 10⁻³⁰⁰",
        taylor: || taylor("-x", 1e-300, (0.0, 1.0), 1e-300 * DECAY),
        runge_kutta: || runge_kutta(|_, x| -x, 1e-300, (0.0, 1.0), 1e-300 * DECAY),
    },
    Hard {
        what: "ẋ = −x from x = 10³⁰⁰",
        taylor: || taylor("-x", 1e300, (0.0, 1.0), 1e300 * DECAY),
        runge_kutta: || runge_kutta(|_, x| -x, 1e300, (0.0, 1.0), 1e300 * DECAY),
    },
    Hard {
        what: "ẋ = cos t from t = 10⁹",
        taylor: || taylor("cos(t)", 1.0, (LATE, LATE + 10.0), late()),
        runge_kutta: || runge_kutta(|t, _| f_cos(t), 1.0, (LATE, LATE + 10.0), late()),
    },
    Hard {
        what: "an event at the limit on time",
        taylor: || event_at_limit(true),
        runge_kutta: || event_at_limit(false),
    },
    Hard {
        what: "a million events of an oscillator",
        taylor: || million_events("-x", (1.0, std::f64::consts::TAU)),
        runge_kutta: || million_events_by_runge_kutta(|x| -x, (1.0, std::f64::consts::TAU)),
    },
    Hard {
        what: "a million events of a pendulum",
        taylor: || million_events("-sin(x)", (1.0, PENDULUM)),
        runge_kutta: || million_events_by_runge_kutta(|x| -f_sin(x), (1.0, PENDULUM)),
    },
];

/// The period of a pendulum from rest at 1 rad, 4 K(sin ½) (mpmath).
const PENDULUM: f64 = 6.699_975_664_370_453;

/// 10⁻⁶ before 1.
const POLE: f64 = 1.0 - 1e-6;

/// e⁻¹.
const DECAY: f64 = 0.367_879_441_171_442_33;

const LATE: f64 = 1e9;

/// 1 and the integral of the cosine over the ten units of time behind it.
fn late() -> f64 {
    1.0 + (f_sin(LATE + 10.0) - f_sin(LATE))
}

/// The error, relative to the answer or to the start, if it is larger: the rounding of a start stays.
fn relative(found: f64, exact: f64, start: f64) -> f64 {
    let size = exact.abs().max(start.abs());
    (found - exact).abs() / if size == 0.0 { 1.0 } else { size }
}

fn taylor(rate: &str, start: f64, (from, to): (f64, f64), exact: f64) -> Result<f64, Error> {
    let field = Formulas::from_text(Names::new(&["x"], &[])?, &[rate])?;
    let series = Series::new(&field, None)?;
    let flow = TaylorFlow::new(&series, TOLERANCE, 0.0)?;
    Ok(relative(flow.state_at(from, &[start], to)?[0], exact, start))
}

fn runge_kutta(
    rate: fn(f64, f64) -> f64,
    start: f64,
    (from, to): (f64, f64),
    exact: f64,
) -> Result<f64, Error> {
    let field = |t: f64, x: &State<1>| State::from([rate(t, x[0])]);
    let tolerances = Tolerances { absolute: f64::MIN_POSITIVE, ..Tolerances::both(TOLERANCE) };
    let motion = Integration::starting_at(from, field, &State::from([start]), tolerances)?;
    let mut motion = motion.until(to)?;
    while !motion.ended() {
        motion.step()?;
    }
    Ok(relative(motion.state()[0], exact, start))
}

/// ẋ = 1 from 0 reaches 1 when the run ends. The error of a missed event is 1.
fn event_at_limit(by_taylor: bool) -> Result<f64, Error> {
    let found = if by_taylor {
        // The term without effect keeps the field from having a closed form.
        let model = Equations::new(&["x"], &[]).mode_text("m", &["1 + 0*x^2"]);
        let model = model.rising_text("one", "x - 1").model::<State<1>>()?;
        last_event(model.start("m", [0.0], 1.0)?)?
    } else {
        let model = Model::integrated(|(), _: &State<1>| [1.0]);
        let model = model.rising((), |x| x[0] - 1.0, |x| ((), *x)).crossing();
        last_event(model.run((), [0.0], 1.0))?
    };
    Ok(found.first().map_or(1.0, |time| relative(*time, 1.0, 0.0)))
}

/// ẍ = f(x) from rest at `start`: the last of a million zeros of x, two in each period.
fn million_events(rate: &str, (start, period): (f64, f64)) -> Result<f64, Error> {
    let model = Equations::new(&["x", "v"], &[]).mode_text("m", &["v", rate]);
    let model = model.either_text("zero", "x").model::<State<2>>()?.tolerance(TOLERANCE);
    error_of_last(last_event(model.start("m", [start, 0.0], TURNS * period)?)?, period)
}

fn million_events_by_runge_kutta(
    rate: fn(f64) -> f64,
    (start, period): (f64, f64),
) -> Result<f64, Error> {
    let model = Model::integrated(|(), x: &State<2>| [x[1], rate(x[0])]).tolerance(TOLERANCE);
    let model = model.either((), |x| x[0], |x| ((), *x));
    error_of_last(last_event(model.run((), [start, 0.0], TURNS * period))?, period)
}

/// The error of a missed event is 1.
fn error_of_last(found: Vec<f64>, period: f64) -> Result<f64, Error> {
    let exact = (TURNS - 0.25) * period;
    Ok(found.first().map_or(1.0, |time| relative(*time, exact, 0.0)))
}

/// Errors and times of all of them.
pub(crate) fn markdown() -> String {
    let cell = |run: fn() -> Result<f64, Error>| {
        // A refusal is a result, and has a time.
        let Ok((found, least)) = least_seconds(SHARE, || Ok::<_, Infallible>(run().ok()));
        let error = found.map_or("refused".to_owned(), digit);
        format!("{error} | {}", duration(least))
    };
    let rows = ALL
        .iter()
        .map(|hard| format!("{} | {} | {}", hard.what, cell(hard.taylor), cell(hard.runge_kutta)));
    let columns = "motion | equations: error: | time: | Runge–Kutta: error: | time:";
    markdown_table(columns, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each is right, or refused.
    #[test]
    fn hard_motions_are_right_or_refused() {
        for hard in &ALL[..7] {
            // The pairs take a million steps where the time is rounded.
            let is_long = hard.what.contains("10⁹");
            let runge_kutta = (!is_long).then_some(hard.runge_kutta);
            for run in [Some(hard.taylor), runge_kutta].into_iter().flatten() {
                let found = run();
                assert!(
                    found.as_ref().map_or(true, |error| *error < 1e-6),
                    "{}: {found:?}",
                    hard.what
                );
            }
        }
    }
}
