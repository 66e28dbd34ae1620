//! Derivatives through several events at one instant, through preset times, touches and sliding, against differences.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::{Matrix2, SMatrix, Vector2};

/// Half the distance of two runs.
const REACH: f64 = 1e-5;

/// The error of a difference of runs with tolerance 1e-12, and of the difference quotients of a model by closures.
const DIFFERENCES: f64 = 1e-6;

type V = State<2>;

fn arcs_of<T: HybridSystem<State = V>>(
    system: &T,
    mode: T::Mode,
    start: V,
    time: f64,
) -> Vec<Arc<T::Mode, T::Surface, V>> {
    Execution::new(system, mode, start, Limits::new(time, 50)).collect::<Result<_, _>>().unwrap()
}

/// The state at a time.
fn end_of<T: HybridSystem<State = V>>(system: &T, mode: T::Mode, start: V, time: f64) -> V {
    let arcs = arcs_of(system, mode, start, time);
    let last = arcs.last().unwrap();
    last.state(system, last.duration).unwrap()
}

/// ∂x(t)/∂x₀ by differences of runs.
fn by_differences(end: impl Fn(V) -> V, start: V) -> Matrix2<f64> {
    let column = |axis: usize| {
        let mut shift = V::zeros();
        shift[axis] = REACH;
        (end(start + shift) - end(start - shift)) / (2.0 * REACH)
    };
    Matrix2::from_columns(&[column(0), column(1)])
}

#[track_caller]
fn assert_close<const R: usize, const C: usize>(a: &SMatrix<f64, R, C>, b: &SMatrix<f64, R, C>) {
    assert!((a - b).amax() < DIFFERENCES * (1.0 + b.amax()), "{a} {b}");
}

/// Two modes that leave at x = 1, each by a surface of its own: both events are at the same instant for every start.
#[test]
fn events_at_one_surface_have_the_derivatives_of_differences() {
    let model = Model::integrated(|mode: u8, _: &V| [f64::from(mode + 1), 1.0])
        .tolerance(1e-12)
        .rising(0, |x| x[0] - 1.0, |x: &V| (1, [x[0], 2.0 * x[1]]))
        .contact()
        .rising(1, |x| x[0] - 1.0, |x: &V| (2, [x[0], x[1] + 3.0 * x[0] * x[0]]))
        .contact();
    let start = V::new(0.2, 0.3);
    let arcs = arcs_of(&model, 0, start, 2.0);
    assert_eq!(arcs.len(), 3);
    let expected = by_differences(|start| end_of(&model, 0, start, 2.0), start);
    assert_close(&sensitivity(&model, &arcs).unwrap(), &expected);
}

/// The first reset leads beyond the surface y = 2 of the next mode: an event at once, at the time of the first one.
fn beyond(speed: f64) -> impl Differentiable<2, Mode = u8, Surface = usize> {
    Model::closed_form(move |mode: u8, x: &V, t| match mode {
        0 => [x[0] + speed * t, x[1] + t],
        1 => [x[0] + t, x[1] + 4.0 * t],
        _ => [x[0] - t, x[1] - 2.0 * t],
    })
    .field(move |mode: u8, _| match mode {
        0 => [speed, 1.0],
        1 => [1.0, 4.0],
        _ => [-1.0, -2.0],
    })
    .rising(0, |x| x[0] - 1.0, move |x: &V| (1, [x[0], x[1] + 5.0 * x[0] * speed]))
    .rising(1, |x| x[1] - 2.0, |x: &V| (2, [x[0] + 0.1 * x[1] * x[1], x[1]]))
    .contact()
    .signal(0, move |_, x| Some(QuasiPolynomial::polynomial(&[x[0] - 1.0, speed])))
    .signal(1, |_, x| Some(QuasiPolynomial::polynomial(&[x[1] - 2.0, 4.0])))
}

#[test]
fn an_event_at_once_beyond_a_surface_has_the_derivatives_of_differences() {
    let (start, speed) = (V::new(0.2, 0.3), 1.25);
    let model = beyond(speed);
    let arcs = arcs_of(&model, 0, start, 2.0);
    assert_eq!(arcs[1].event().unwrap().kind, EventKind::AtStart);
    let expected = by_differences(|start| end_of(&model, 0, start, 2.0), start);
    assert_close(&sensitivity(&model, &arcs).unwrap(), &expected);
}

/// The same by the speed, as a parameter.
#[test]
fn an_event_at_once_beyond_a_surface_has_derivatives_by_parameters() {
    let make = |speed: f64| {
        Model::integrated(move |mode: u8, _: &V| match mode {
            0 => [speed, 1.0],
            1 => [1.0, 4.0],
            _ => [-1.0, -2.0],
        })
        .tolerance(1e-12)
        .rising(0, |x| x[0] - 1.0, move |x: &V| (1, [x[0], x[1] + 5.0 * x[0] * speed]))
        .rising(1, |x| x[1] - 2.0, |x: &V| (2, [x[0] + 0.1 * x[1] * x[1], x[1]]))
        .contact()
    };
    let start = V::new(0.2, 0.3);
    let family = Family::new([1.25], |[speed]| make(speed));
    let arcs = arcs_of(family.system(), 0, start, 2.0);
    let found = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap();
    let end = |speed| end_of(&make(speed), 0, start, 2.0);
    assert_close(&found, &((end(1.25 + REACH) - end(1.25 - REACH)) / (2.0 * REACH)));
    let (state, time) =
        event_parameter_sensitivity(&family, &arcs[..2], &SMatrix::zeros()).unwrap();
    // x = 1 is reached at 0.8/speed, by both events.
    assert!((time[0] + 0.8 / (1.25 * 1.25)).abs() < DIFFERENCES);
    let after =
        |speed: f64| arcs_of(&make(speed), 0, start, 2.0)[1].event().unwrap().after.unwrap().1;
    assert_close(&state, &((after(1.25 + REACH) - after(1.25 - REACH)) / (2.0 * REACH)));
}

/// From (0, 0) the lines x = 1 and y = 1 are reached together. Nearby orbits reach one of them first, and the
/// resets do not commute.
#[test]
fn two_surfaces_at_one_instant_have_no_derivative() {
    let model = Model::integrated(|mode: u8, _: &V| match mode {
        0 => [1.0, 1.0],
        1 => [2.0, 1.0],
        2 => [1.0, 3.0],
        _ => [2.0, 3.0],
    })
    .tolerance(1e-12)
    .rising(0, |x| x[0] - 1.0, |x| (1, *x))
    .rising(0, |x| x[1] - 1.0, |x| (2, *x))
    .rising(1, |x| x[1] - 1.0, |x: &V| (3, [2.0 * x[0], x[1]]))
    .rising(2, |x| x[0] - 1.0, |x: &V| (3, [x[0], 3.0 * x[1]]));
    let arcs = arcs_of(&model, 0, V::zeros(), 2.0);
    assert_eq!(arcs.len(), 3);
    let error = sensitivity(&model, &arcs).unwrap_err();
    assert!(matches!(error, Error::CornerSensitivity { .. }), "{error}");
    // Next to this start there is one.
    let start = V::new(0.1, 0.0);
    let arcs = arcs_of(&model, 0, start, 2.0);
    let expected = by_differences(|start| end_of(&model, 0, start, 2.0), start);
    assert_close(&sensitivity(&model, &arcs).unwrap(), &expected);
}

#[test]
fn an_observer_at_the_instant_of_an_impact_changes_no_derivative() {
    let walls = Model::closed_form(|(), x: &State<2>, t| [x[0] + 2.0 * t, x[1] + t])
        .field(|(), _| [2.0, 1.0])
        .rising((), |x| x[0] - 1.0, |x: &V| ((), [x[0] - 3.0, x[1] + x[0] * x[0]]))
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] - 1.0, 2.0])))
        .observer(Guard::either(1), |x| x[0] + x[1] * 4.0 - 3.0)
        .signal(1, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] + x[1] * 4.0 - 3.0, 6.0])));
    let start = V::new(0.0, 0.0);
    let arcs = arcs_of(&walls, (), start, 1.0);
    let at_impact: Vec<_> = arcs.iter().filter_map(Arc::event).map(|event| event.time).collect();
    assert_eq!(at_impact, [0.5, 0.5]);
    let found = sensitivity(&walls, &arcs).unwrap();
    let differences = by_differences(|start| end_of(&walls, (), start, 1.0), start);
    assert_close(&found, &differences);
}

#[test]
fn a_preset_time_does_not_change_with_the_start() {
    let ticks = PeriodicTimes::new(1.0, 1.0).unwrap();
    let make = move |rate: f64| {
        Model::integrated(move |(), x: &V| [2.0 - rate * x[0], x[0]]).tolerance(1e-12).clock(
            (),
            0,
            move |after| ticks.next_after(after),
            move |(), x: &V| ((), [rate * x[0] * x[1], x[1]]),
        )
    };
    let (model, start) = (make(0.8), V::new(0.7, 0.2));
    let arcs = arcs_of(&model, (), start, 2.7);
    assert_eq!(arcs.len(), 3);
    let expected = by_differences(|start| end_of(&model, (), start, 2.7), start);
    assert_close(&sensitivity(&model, &arcs).unwrap(), &expected);
    let (_, time) = event_sensitivity(&model, &arcs[0]).unwrap();
    assert_eq!(time.amax(), 0.0);
    // A period may be one of the parameters.
    let family = Family::new([0.8], move |[rate]| make(rate));
    let arcs = arcs_of(family.system(), (), start, 2.7);
    let error = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap_err();
    assert_eq!(error, Error::ClockSensitivity { time: 1.0 });
}

/// x = sin t touches 1.
#[test]
fn a_touch_has_a_derivative_only_if_it_changes_nothing() {
    let swing = |kept: f64| {
        Model::closed_form(|(), x: &V, t: f64| {
            [x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin()]
        })
        .field(|(), x| [x[1], -x[0]])
        .guard(
            (),
            Guard::rising(0).touch(Touch::Event),
            |x| x[0] - 1.0,
            move |x: &V| ((), [kept * x[0], x[1]]),
        )
        .signal(0, |(), x| {
            let swing = QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0);
            Some(swing - QuasiPolynomial::polynomial(&[1.0]))
        })
    };
    let start = V::new(0.0, 1.0);
    let watched = swing(1.0);
    let arcs = arcs_of(&watched, (), start, 3.0);
    assert_eq!(arcs[0].event().unwrap().kind, EventKind::Touch);
    let (sin, cos) = 3.0f64.sin_cos();
    assert_close(&sensitivity(&watched, &arcs).unwrap(), &Matrix2::new(cos, sin, -sin, cos));
    let changed = swing(0.5);
    let arcs = arcs_of(&changed, (), start, 3.0);
    let error = sensitivity(&changed, &arcs).unwrap_err();
    assert!(matches!(error, Error::GrazingSensitivity { .. }), "{error}");
}

/// Dry friction with a mode for sticking: the belt has the speed 1, the friction the size μ.
#[test]
fn sliding_by_closures_has_the_derivatives_of_differences() {
    let make = |friction: f64| {
        Model::integrated(move |mode: u8, x: &V| match mode {
            0 => [x[1], -x[0] + friction],
            1 => [x[1], -x[0] - friction],
            _ => [x[1], 0.0],
        })
        .tolerance(1e-12)
        .rising(0, |x| x[1] - 1.0, |x| (1, *x))
        .falling(1, |x| x[1] - 1.0, |x| (0, *x))
        .rising(2, move |x| x[0] - friction, |x| (0, *x))
        .slide(|sliding| Some((2, sliding.state)))
    };
    let (start, time) = (Vector2::new(-1.0, 0.0), 7.0);
    let family = Family::new([2.0], |[friction]| make(friction));
    let arcs = arcs_of(family.system(), 0, start, time);
    assert!(arcs.iter().any(|arc| arc.mode == 2 && arc.duration > 1.0));
    let expected = by_differences(|start| end_of(&make(2.0), 0, start, time), start);
    assert_close(&sensitivity(family.system(), &arcs).unwrap(), &expected);
    let end = |friction| end_of(&make(friction), 0, start, time);
    let by_friction = (end(2.0 + REACH) - end(2.0 - REACH)) / (2.0 * REACH);
    let found = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap();
    assert_close(&found, &by_friction);
}

/// The same by Filippov's convention. The surface depends on a parameter, the speed of the belt, and the exit on the
/// friction.
#[test]
fn sliding_by_filippov_has_derivatives_by_parameters() {
    let tolerances = Tolerances::both(1e-12);
    let make = |[friction, speed]: [f64; 2]| {
        let belt = Model::integrated(move |faster: bool, x: &V| {
            [x[1], -x[0] - 0.1 * x[1] + if faster { -friction } else { friction }]
        })
        .tolerance(1e-12)
        .rising(false, move |x| x[1] - speed, |x| (true, *x))
        .falling(true, move |x| x[1] - speed, |x| (false, *x));
        Filippov::new(belt, tolerances)
    };
    let (start, time, mode) = (Vector2::new(-1.0, 0.0), 7.0, FilippovMode::Free(false));
    let parameters = [2.0, 1.0];
    let family = Family::new(parameters, make);
    let arcs = arcs_of(family.system(), mode, start, time);
    let exits = arcs.iter().filter_map(Arc::event);
    assert!(exits.filter(|e| matches!(e.surface, FilippovSurface::Tangent { .. })).count() > 0);
    let column = |axis: usize| {
        let end = |shift: f64| {
            let mut parameters = parameters;
            parameters[axis] += shift;
            end_of(&make(parameters), mode, start, time)
        };
        (end(REACH) - end(-REACH)) / (2.0 * REACH)
    };
    let found = parameter_sensitivity(&family, &arcs, &SMatrix::zeros()).unwrap();
    assert_close(&found, &Matrix2::from_columns(&[column(0), column(1)]));
    // In the middle of the sliding motion the speed is that of the belt.
    let sliding: Vec<_> = arcs_of(family.system(), mode, start, 2.0);
    let found = parameter_sensitivity(&family, &sliding, &SMatrix::zeros()).unwrap();
    assert!(found[(1, 0)].abs() < DIFFERENCES && (found[(1, 1)] - 1.0).abs() < DIFFERENCES);
}
