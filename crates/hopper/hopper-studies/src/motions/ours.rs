//! The motions by this repository: by Taylor's method on the formulas, of one start and of a thousand, and by the
//! Runge–Kutta pairs on plain functions.

use super::fields;
use super::scene::Scene;
use crate::error::Error;
use equations::{Formulas, Names, Series, TaylorFlow};
use hybrid_system::{
    Equations, EquationsModel, Execution, HybridSystem, Integration, Model, State, Tolerances,
};
use nalgebra::DVector;
use pxfm::{f_cos, f_sin};
use std::rc::Rc;

/// Starts that are followed at once.
pub(super) const STARTS: usize = 1000;

/// The starts are as far apart, relative to their size: they have orbits, and steps, of their own.
const APART: f64 = 1e-6;

/// A way to compute a motion: the answer of a scene at a tolerance.
pub(super) type Run = Box<dyn Fn() -> Result<Vec<f64>, Error>>;

/// The ways that a scene has, with their names and the number of starts of a run.
pub(super) fn runs(
    scene: &Scene,
    tolerance: f64,
) -> Result<Vec<(&'static str, usize, Run)>, Error> {
    let runge_kutta = ("ours, Runge–Kutta", 1, runge_kutta(scene, tolerance)?);
    Ok(match &scene.guard {
        Some(_) if scene.reset.is_some() => {
            // The term without effect keeps the field from having a closed form.
            let mut integrated = scene.clone();
            integrated.field.iter_mut().for_each(|rate| rate.push_str(" + 0*x^2"));
            vec![
                ("ours, equations", 1, events(scene, tolerance)?),
                ("ours, equations, by Taylor series", 1, events(&integrated, tolerance)?),
                runge_kutta,
            ]
        }
        Some(_) => vec![("ours, equations", 1, events(scene, tolerance)?), runge_kutta],
        None => {
            let (one, all) = taylor(scene, tolerance)?;
            vec![
                ("ours, equations", 1, one),
                ("ours, equations, 1000 starts at once", STARTS, all),
                runge_kutta,
            ]
        }
    })
}

fn texts(words: &[String]) -> Vec<&str> {
    words.iter().map(String::as_str).collect()
}

/// The state at the end, of one start and of many.
fn taylor(scene: &Scene, tolerance: f64) -> Result<(Run, Run), Error> {
    let names = Names::new(&texts(&scene.states), &[])?;
    let field = Formulas::from_text(names, &texts(&scene.field))?;
    let (start, end) = (scene.start()?, scene.end()?);
    let column = |x: &f64| (0..STARTS).map(|k| x * (1.0 + k as f64 * APART)).collect();
    let columns: Vec<Vec<f64>> = start.iter().map(column).collect();
    let one = Rc::new(Series::new(&field, None)?);
    let all = Rc::clone(&one);
    Ok((
        Box::new(move || {
            Ok(TaylorFlow::new(&one, tolerance, tolerance)?.state_at(0.0, &start, end)?)
        }),
        Box::new(move || {
            let columns: Vec<&[f64]> = columns.iter().map(|column| &column[..]).collect();
            let flow = TaylorFlow::new(&all, tolerance, tolerance)?;
            let found = flow.states_at(&[0.0], &columns, &[end])?;
            Ok(found.values.iter().filter_map(|column| column.first().copied()).collect())
        }),
    ))
}

/// The time of the last event of a model of equations.
fn events(scene: &Scene, tolerance: f64) -> Result<Run, Error> {
    let equations = Equations::new(&texts(&scene.states), &[]).mode_text("m", &texts(&scene.field));
    let guard = scene.guard.as_deref().unwrap_or_default();
    let equations = match &scene.reset {
        Some(reset) => equations.rising_text("guard", guard).resets_text(&texts(reset)),
        None => equations.either_text("guard", guard),
    };
    let model: EquationsModel<DVector<f64>> = equations.model()?;
    let model = model.tolerance(tolerance);
    let (mut start, end) = (scene.start()?, scene.end()?);
    if model.series("m").is_some_and(|series| series.dimension() > start.len()) {
        // The time, which the field needs.
        start.push(0.0);
    }
    let start = DVector::from(start);
    Ok(Box::new(move || last_event(model.start("m", start.clone(), end)?)))
}

pub(super) fn last_event<T: HybridSystem>(run: Execution<'_, T>) -> Result<Vec<f64>, Error> {
    let mut last = None;
    for arc in run {
        last = arc?.event().map(|event| event.time).or(last);
    }
    Ok(last.into_iter().collect())
}

/// By plain functions: the state at the end, or the time of the last event.
fn runge_kutta(scene: &Scene, tolerance: f64) -> Result<Run, Error> {
    let (start, end) = (scene.start()?, scene.end()?);
    let time = (end, tolerance);
    Ok(match scene.name.as_str() {
        "pendulum section" => {
            let model = Model::integrated(|(), x: &State<2>| [x[1], -f_sin(x[0])])
                .either((), |x| x[0], |x| ((), *x))
                .tolerance(tolerance);
            Box::new(move || last_event(model.run((), [start[0], start[1]], end)))
        }
        "impact oscillator" => {
            let field = |(), x: &State<3>| [x[1], f_cos(1.3 * x[2]) - 0.1 * x[1] - x[0], 1.0];
            let model = Model::integrated(field)
                .rising((), |x| x[0] - 0.5, |x| ((), [x[0], -0.8 * x[1], x[2]]))
                .tolerance(tolerance);
            Box::new(move || last_event(model.run((), [start[0], start[1], 0.0], end)))
        }
        "van der Pol" => flow(&start, time, fields::van_der_pol(5.0)),
        "van der Pol, μ = 100" => flow(&start, time, fields::van_der_pol(100.0)),
        "Arenstorf" => flow(&start, time, fields::arenstorf),
        "Lorenz" | "Lorenz to t = 50" => flow(&start, time, fields::lorenz),
        "outer planets" => flow(&start, time, fields::planets),
        _ => flow(&start, time, fields::kepler),
    })
}

/// The state at the end.
fn flow<const N: usize, F>(start: &[f64], (end, tolerance): (f64, f64), field: F) -> Run
where
    F: Fn(&[f64; N]) -> [f64; N] + 'static,
{
    let start = State::from_column_slice(start);
    Box::new(move || {
        let field = |_: f64, x: &State<N>| State::from(field(&x.data.0[0]));
        let motion = Integration::new(field, &start, Tolerances::both(tolerance))?;
        let mut motion = motion.until(end)?;
        while !motion.ended() {
            motion.step()?;
        }
        Ok(motion.state().as_slice().to_vec())
    })
}
