//! Derivatives by parameters, against closed forms and finite differences through events.

#![cfg(feature = "ode")]
#![allow(clippy::type_complexity)] // the type of a model contains the types of its closures

use hybrid_system::model_parts::{Integrated, ModelPart};
use hybrid_system::*;
use nalgebra::{Matrix1x2, RowVector2, SMatrix, Vector2};

/// The error of central differences of smooth functions of scale one.
const DIFFERENCES: f64 = 1e-8;

fn arcs_of<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    start: T::State,
    events: usize,
) -> Vec<Arc<T::Mode, T::Surface, T::State>> {
    let mut arcs: Vec<_> = Execution::new(system, mode, start, Limits::new(100.0, events))
        .collect::<Result<_, _>>()
        .unwrap();
    arcs.truncate(events);
    arcs
}

/// A ball that falls from height 1. With t₁ = √(2/g) and v₁ = √(2g) bounce n comes at tₙ = t₁(1 + 2 Σ eᵏ), k < n,
/// and the ball leaves with the speed eⁿ v₁.
fn check_ball<F, S>(family: &F)
where
    F: Parametric<2, 2, System = S>,
    S: Differentiable<2, Mode = ()>,
{
    let (g, e): (f64, f64) = (2.0, 0.7);
    let (first, speed) = ((2.0 / g).sqrt(), (2.0 * g).sqrt());
    let arcs = arcs_of(family.system(), (), Vector2::new(1.0, 0.0), 4);
    let fixed = SMatrix::zeros();
    for n in 1..=4 {
        let bounce = n as i32;
        let (state, time) = event_parameter_sensitivity(family, &arcs[..n], &fixed).unwrap();
        let powers: f64 = (1..bounce).map(|k| e.powi(k)).sum();
        let slopes: f64 = (1..bounce).map(|k| f64::from(k) * e.powi(k - 1)).sum();
        let by_gravity = -first * (1.0 + 2.0 * powers) / (2.0 * g);
        assert!((time - RowVector2::new(by_gravity, 2.0 * first * slopes)).amax() < DIFFERENCES);
        let after = arcs[n - 1].event().unwrap().after.unwrap().1;
        assert!((after[1] - e.powi(bounce) * speed).abs() < 1e-9);
        let by_gravity = e.powi(bounce) * speed / (2.0 * g);
        let by_restitution = f64::from(bounce) * e.powi(bounce - 1) * speed;
        assert!((state.row(1) - RowVector2::new(by_gravity, by_restitution)).amax() < DIFFERENCES);
        assert!(state.row(0).amax() < DIFFERENCES, "the ball stays on the floor");
        // At the same time, in free fall from the bounce: δx = δx⁺ − f⁺δτ.
        let at_time = parameter_sensitivity(family, &arcs[..n], &fixed).unwrap();
        let expected = state - Vector2::new(after[1], -g) * time;
        assert!((at_time - expected).amax() < DIFFERENCES);
    }
}

#[test]
fn times_and_speeds_of_a_ball_by_gravity_and_restitution() {
    check_ball(&Family::new([2.0, 0.7], |[g, e]| {
        Model::closed_form(move |(), x: &State<2>, t| {
            [x[0] + t * (x[1] - g * t / 2.0), x[1] - g * t]
        })
        .field(move |(), x| [x[1], -g])
        .falling((), |x| x[0], move |x| ((), [0.0, -e * x[1]]))
        .signal(0, move |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -g / 2.0])))
    }));
    check_ball(&Family::new([2.0, 0.7], |[g, e]| {
        Model::integrated(move |(), x: &State<2>| [x[1], -g]).tolerance(1e-12).falling(
            (),
            |x| x[0],
            move |x| ((), [0.0, -e * x[1]]),
        )
    }));
}

/// Warms with the rate a towards 3 until x = 2, and cools towards 0 until x = w.
fn thermostat(
    [a, w]: [f64; 2],
) -> Model<
    bool,
    usize,
    State<1>,
    Integrated<impl Fn(bool, &State<1>) -> [f64; 1]>,
    impl ModelPart<bool, usize, State<1>>,
> {
    Model::integrated(move |on, x: &State<1>| [a * (if on { 3.0 } else { 0.0 } - x[0])])
        .tolerance(1e-12)
        .rising(true, |x| x[0] - 2.0, |x| (false, *x))
        .falling(false, move |x| x[0] - w, |x| (true, *x))
}

#[test]
fn the_period_of_a_thermostat_by_its_rate_and_its_threshold() {
    let (a, w) = (1.5, 1.0f64);
    let family = Family::new([a, w], thermostat);
    let arcs = arcs_of(family.system(), true, State::<1>::new(w), 2);
    // The cycle starts at the threshold w: the start depends on it.
    let start = Matrix1x2::new(0.0, 1.0);
    let (state, period) = event_parameter_sensitivity(&family, &arcs, &start).unwrap();
    let exact = (((3.0 - w) / 1.0).ln() + (2.0 / w).ln()) / a;
    assert!((arcs[1].event().unwrap().time - exact).abs() < 1e-10);
    let by_threshold = (-1.0 / (3.0 - w) - 1.0 / w) / a;
    assert!((period - Matrix1x2::new(-exact / a, by_threshold)).amax() < DIFFERENCES);
    assert!((state - start).amax() < DIFFERENCES, "the state stays at the threshold");
}

/// A pendulum with drag k between walls at ±c that give back the part e of the speed.
fn pendulum(
    [k, c, e]: [f64; 3],
) -> Model<
    (),
    usize,
    State<2>,
    Integrated<impl Fn((), &State<2>) -> [f64; 2]>,
    impl ModelPart<(), usize, State<2>>,
> {
    let bounce = move |x: &State<2>| ((), [x[0], -e * x[1]]);
    Model::integrated(move |(), x: &State<2>| [x[1], -x[0].sin() - k * x[1]])
        .tolerance(1e-13)
        .rising((), move |x| x[0] - c, bounce)
        .falling((), move |x| x[0] + c, bounce)
}

#[test]
fn an_integrated_flow_through_events_against_finite_differences() {
    let parameters = [0.1, 0.5, 0.9];
    let family = Family::new(parameters, pendulum);
    let start = Vector2::new(0.1, 1.4);
    let time = 3.3;
    let until = |p: [f64; 3]| -> Vec<_> {
        let model = pendulum(p);
        Execution::new(&model, (), start, Limits::new(time, 100)).collect::<Result<_, _>>().unwrap()
    };
    let arcs = until(parameters);
    assert!(arcs.len() > 3, "{} arcs", arcs.len());
    let found = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap();
    for axis in 0..3 {
        let end = |shift: f64| {
            let mut p = parameters;
            p[axis] += shift;
            let arcs = until(p);
            let last = arcs.last().unwrap();
            last.state(&pendulum(p), last.duration).unwrap()
        };
        // Fourth order, h = 1e-3: the error of the quotient is 1e-12/h and h⁴.
        let h = 1e-3;
        let quotient = (8.0 * (end(h) - end(-h)) - (end(2.0 * h) - end(-2.0 * h))) / (12.0 * h);
        assert!((found.column(axis) - quotient).amax() < 1e-7, "{axis}: {found} {quotient}");
    }
}

#[test]
fn no_event_has_no_derivative() {
    let family = Family::new([1.0, 1.0], thermostat);
    let arcs: Vec<_> =
        Execution::new(family.system(), true, State::<1>::new(1.0), Limits::new(0.1, 9))
            .collect::<Result<_, _>>()
            .unwrap();
    let none = event_parameter_sensitivity(&family, &arcs, &SMatrix::zeros());
    assert!(matches!(none, Err(Error::NoSensitivity { .. })));
    let none = event_parameter_sensitivity(&family, &arcs[..0], &SMatrix::zeros());
    assert!(matches!(none, Err(Error::NoSensitivity { .. })));
    // The state at the limit on time has one: x = 3 − 2e^(−at).
    let by_rate = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap()[(0, 0)];
    assert!((by_rate - 0.2 * (-0.1f64).exp()).abs() < DIFFERENCES);
}

/// The same numbers with the parameter as a component of the state.
#[test]
fn a_parameter_as_a_component_gives_the_same_derivative() {
    let augmented =
        Model::integrated(|on, x: &State<2>| [x[1] * (if on { 3.0 } else { 0.0 } - x[0]), 0.0])
            .tolerance(1e-12)
            .rising(true, |x: &State<2>| x[0] - 2.0, |x| (false, *x))
            .falling(false, |x| x[0] - 1.0, |x| (true, *x));
    let arcs = arcs_of(&augmented, true, Vector2::new(1.0, 1.5), 2);
    let by_component = sensitivity(&augmented, &arcs).unwrap()[(0, 1)];
    let family = Family::new([1.5, 1.0], thermostat);
    let arcs = arcs_of(family.system(), true, State::<1>::new(1.0), 2);
    let by_parameter = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap()[(0, 0)];
    assert!((by_component - by_parameter).abs() < DIFFERENCES);
}

#[test]
fn each_row_of_a_matrix_of_derivatives_has_the_tolerance_of_its_component() {
    let each = Tolerances::both(1e-10).absolute_each(&[1e-12, 1e-9]).relative_each(&[0.0, 1e-11]);
    let family = Family::new([0.1, 9.0, 1.0], |p| pendulum(p).tolerances(each));
    let flow = family.flow_by_parameters((), &Vector2::new(0.1, 1.4), 3.0);
    let tight = Family::new([0.1, 9.0, 1.0], pendulum);
    let exact = tight.flow_by_parameters((), &Vector2::new(0.1, 1.4), 3.0);
    assert!((flow - exact).amax() < 1e-7 && flow[(0, 0)] != 0.0);
}
