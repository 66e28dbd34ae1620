//! Multipliers and bifurcations are as near to the exact ones as they say.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::{Equations, EquationsModel, Event, Label, Limits, State, Tolerances};
use nalgebra::{DMatrix, RowVector2, SMatrix, SVector, Vector2};
use proptest::prelude::*;
use return_map::{
    BranchPoint, BranchSteps, EquationReturns, Error, FormulaMap, MapFamily, Section,
    SmoothSection, family, follow_branch, periodic_attractors, periodic_point, scalar_family,
    smooth_returns,
};
use std::ops::ControlFlow::{Break, Continue};

fn point_at<M: MapFamily>(map: &M, period: usize, start: &[f64], p: f64) -> BranchPoint {
    let window = (p - 1.0, p + 1.0);
    let steps = BranchSteps::default();
    let branch = follow_branch(map, period, (start, p), window, steps, |_| Break(())).unwrap();
    branch.points.into_iter().next().unwrap()
}

/// The largest distance of a multiplier from the nearest exact one, and the largest error that is stated.
fn off(found: &BranchPoint, exact: &[f64]) -> (f64, f64) {
    let nearest = |m: &nalgebra::Complex<f64>| {
        exact.iter().map(|own| (m - own).norm()).fold(f64::INFINITY, f64::min)
    };
    let off = found.multipliers.iter().map(nearest).fold(0.0, f64::max);
    (off, found.multiplier_errors.iter().copied().fold(0.0, f64::max))
}

/// Hénon's fixed point by a formula, by a closure, and by a closure with noise of 10⁻⁹.
#[test]
fn of_formulas_closures_and_noise() {
    let names = equations::Names::new(&["x", "y"], &[("a", "1.4")]).unwrap();
    let formulas = equations::Formulas::from_text(names, &["1 - a*x^2 + y", "0.3*x"]).unwrap();
    let formula = FormulaMap::new(&formulas, "a").unwrap();
    let closure = family(2, |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], 0.3 * x[0]]));
    let noisy = family(2, |x: &[f64], a| {
        let noise = 1e-9 * (1e9 * x[0]).sin();
        Ok(vec![1.0 - a * x[0] * x[0] + x[1] + noise, 0.3 * x[0]])
    });
    let x = (-0.7 + (0.49f64 + 5.6).sqrt()) / 2.8;
    let root = (1.96 * x * x + 0.3).sqrt();
    let exact = [-1.4 * x + root, -1.4 * x - root];
    let start = [0.63, 0.19];
    for (map, least, most) in
        [(&formula as &dyn MapFamily, 0.0, 1e-14), (&closure, 1e-15, 1e-11), (&noisy, 1e-9, 1e-4)]
    {
        let (off, stated) = off(&point_at(&map, 1, &start, 1.4), &exact);
        assert!(off <= stated && (least..most).contains(&stated), "{off:e} {stated:e}");
    }
    let map = |x: &Vector2<f64>| Ok(Vector2::new(1.0 - 1.4 * x[0] * x[0] + x[1], 0.3 * x[0]));
    let found = periodic_point(map, &Vector2::new(0.6, 0.2), 1).unwrap();
    for (multiplier, error) in found.multipliers.iter().zip(&found.multiplier_errors) {
        let off = exact.iter().map(|own| (multiplier - own).norm()).fold(1.0, f64::min);
        assert!(off <= *error && *error < 1e-11, "{off:e} {error:e}");
    }
}

/// A double multiplier moves by the root of a change.
#[test]
fn of_a_double_one() {
    let map = family(2, |x: &[f64], _| Ok(vec![0.5 * x[0] + x[1], 0.5 * x[1]]));
    let (off, stated) = off(&point_at(&map, 1, &[0.0, 0.0], 0.0), &[0.5]);
    assert!(off <= stated && stated < 1e-4, "{off:e} {stated:e}");
}

/// An orbit of a linear oscillator that hits a stop, with tolerances from 10⁻⁷ to 10⁻¹³.
#[test]
fn of_returns() {
    let oscillator = Equations::new(&["x", "v"], &[("f", "1"), ("stop", "1")])
        .mode_text("free", &["v", "f*cos(0.8*t) - x - 0.2*v"])
        .rising_text("stop", "x - stop")
        .resets_text(&["x", "-0.8*v"])
        .clock_text("period", "5*pi/2", "5*pi/2");
    let returns = |tolerance: f64| {
        EquationReturns::new(&oscillator, "f", ("free", "period"), &["x", "v"])
            .unwrap()
            .tolerances(Tolerances::both(tolerance))
    };
    let found =
        periodic_attractors(&returns(1e-13), 1.0, &[vec![0.0, 0.0]], (200, 8), |_| Continue(()));
    let period = found[0].orbit.len();
    let sure = point_at(&returns(1e-14), period, &found[0].orbit[0], 1.0);
    assert!(sure.itinerary.len() > period, "{sure:?}");
    let exact: Vec<_> = sure.multipliers.clone();
    for tolerance in [1e-7, 1e-10, 1e-13] {
        let found = point_at(&returns(tolerance), period, &sure.point, 1.0);
        for ((own, exact), error) in
            found.multipliers.iter().zip(&exact).zip(&found.multiplier_errors)
        {
            let off = (own - exact).norm();
            assert!(off <= error + sure.multiplier_errors[0], "{tolerance:e}: {off:e} {error:e}");
            assert!(*error < 1e3 * tolerance, "{tolerance:e}: {error:e}");
        }
    }
}

/// The derivative by the system's own derivatives: a rimless wheel, integrated with tolerances from 10⁻⁴ to 10⁻¹³.
#[test]
fn of_variational_equations() {
    let (alpha, slope) = (0.3f64, 0.1f64);
    let kept = (2.0 * alpha).cos();
    let wheel = Equations::new(&["angle", "speed"], &[])
        .mode("rolls", |_, x, _| [x[1], x[0].sin()])
        .rising("forward", move |_, x, _| x[0] - (slope + alpha))
        .resets(move |_, x, _| [x[0].number(slope - alpha), kept * x[1]]);
    let speed = (kept * kept * 4.0 * slope.sin() * alpha.sin() / (1.0 - kept * kept)).sqrt();
    for tolerance in [1e-4, 1e-7, 1e-10, 1e-13] {
        let wheel = |_| wheel.model::<State<2>>().unwrap().tolerance(tolerance);
        let map = smooth_returns(wheel, |_| AfterCollision(slope - alpha), Limits::new(100.0, 10));
        let found = map.linearized(&[speed], 0.0).unwrap();
        let off = (found.slopes[(0, 0)] - kept * kept).abs();
        let stated = found.errors[(0, 0)];
        assert!(off <= stated && stated < 1e5 * tolerance, "{tolerance:e}: {off:e} {stated:e}");
    }
    // It stops before the vertical, with the start in the error.
    let map = smooth_returns(
        |_| wheel.model::<State<2>>().unwrap(),
        |_| AfterCollision(slope - alpha),
        Limits::new(10.0, 10),
    );
    let none = map.image(&[0.01], 0.5);
    let Err(Error::NoReturn { start, parameter, .. }) = none else { panic!("{none:?}") };
    assert_eq!((start, parameter), (vec![0.01], Some(0.5)));
}

/// The speed after a collision, at this angle.
struct AfterCollision(f64);

impl Section<EquationsModel<State<2>>, 2, 1> for AfterCollision {
    fn point(&self, speed: &SVector<f64, 1>) -> (Label, State<2>) {
        (Label::new("rolls").unwrap(), Vector2::new(self.0, speed[0]))
    }
    fn coordinates(&self, event: &Event<Label, Label, State<2>>) -> Option<SVector<f64, 1>> {
        Some(SVector::<f64, 1>::new(event.after?.1[1]))
    }
}

impl SmoothSection<EquationsModel<State<2>>, 2, 1> for AfterCollision {
    fn point_jacobian(&self, _: &SVector<f64, 1>) -> SMatrix<f64, 2, 1> {
        Vector2::new(0.0, 1.0)
    }
    fn coordinates_jacobian(&self, _: &Event<Label, Label, State<2>>) -> SMatrix<f64, 1, 2> {
        RowVector2::new(0.0, 1.0)
    }
}

/// Over the top of a pendulum, as the foot of a wheel: the slower, the longer beside the saddle, where neighbours part.
#[test]
fn beside_a_saddle() {
    let wheel = Equations::new(&["x", "v"], &[("p", "0")])
        .mode_text("over", &["v", "sin(x)"])
        .rising_text("down", "x - 1")
        .resets_text(&["-1", "v"]);
    let returns = EquationReturns::new(&wheel, "p", ("over", "down"), &["v"])
        .unwrap()
        .starting_text(&["-1", "v"])
        .unwrap();
    // The speed over the top that is just enough is 2 sin ½. All speeds come back.
    for above in [1e-1, 1e-3, 1e-5, 1e-7, 1e-9] {
        let found = returns.linearized(&[2.0 * 0.5f64.sin() + above], 0.0).unwrap();
        let off = (found.slopes[(0, 0)] - 1.0).abs();
        let stated = found.errors[(0, 0)];

        assert!(off <= stated, "{above:e}: {off:e} {stated:e}");
    }
}

/// Orbits of the logistic map at r = 4 from sin²(πk/(2ⁿ − 1)) have the multiplier ±2ⁿ. The rounding of the first point grows as much on
/// the way, and the derivative along the orbit is another one.
#[test]
fn of_long_orbits() {
    let names = equations::Names::new(&["x"], &[("r", "4")]).unwrap();
    let formulas = equations::Formulas::from_text(names, &["r*x*(1 - x)"]).unwrap();
    let formula = FormulaMap::new(&formulas, "r").unwrap();
    let closure = scalar_family(|x, r| r * x * (1.0 - x));
    for (n, k) in [(2, 1.0f64), (5, 1.0), (8, 1.0), (12, 1.0), (16, 1.0), (12, 1001.0), (20, 1.0)] {
        let x = (std::f64::consts::PI * k / (2f64.powi(n) - 1.0)).sin().powi(2);
        for map in [&formula as &dyn MapFamily, &closure] {
            let found = point_at(&map, n as usize, &[x], 4.0);
            let off = (found.multipliers[0].norm() - 2f64.powi(n)).abs();
            assert!(off <= found.multiplier_errors[0], "{n} {k}: {off:e} {found:?}");
        }
    }
}

/// A multiplier that passes −1 as p³ or p⁵: where is known to the root of its error.
#[test]
fn of_flat_bifurcations() {
    for power in [1, 3, 5] {
        let map = scalar_family(move |x, p: f64| -x + p.powi(power) * x - x * x * x);
        let steps = BranchSteps::default();
        for (start, window) in [(-0.5, (-1.0, 1.0)), (-0.09, (-0.1, 0.1))] {
            let start = (&[0.0][..], start);
            let branch = follow_branch(&map, 1, start, window, steps, |_| Continue(())).unwrap();
            let [found] = &branch.bifurcations[..] else { panic!("{:?}", branch.bifurcations) };
            assert!(found.at.parameter.abs() <= found.error && found.error < 0.02, "{found:?}");
        }
    }
}

/// Closed forms: of closures, whose derivatives are differences.
#[test]
fn bifurcations_are_where_they_say() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let henon = family(2, |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], 0.3 * x[0]]));
    let delayed = family(2, |x: &[f64], r| Ok(vec![r * x[0] * (1.0 - x[1]), x[0]]));
    let pitchfork = scalar_family(|x, p| x + p * x - x * x * x);
    type Case<'m> = (&'m dyn MapFamily, usize, &'m [f64], f64, (f64, f64), &'m [f64]);
    let six = 1.0 + 6f64.sqrt();
    let cases: [Case<'_>; 6] = [
        (&logistic, 1, &[0.6], 2.5, (0.5, 3.5), &[1.0, 3.0]),
        (&logistic, 2, &[0.513], 3.2, (3.1, 3.5), &[six]),
        (&henon, 1, &[0.9, 0.27], 0.2, (-0.5, 1.0), &[-0.1225, 0.3675]),
        (&henon, 2, &[1.1, -0.05], 0.6, (0.4, 1.0), &[0.9125]),
        (&delayed, 1, &[0.4, 0.4], 1.7, (1.5, 2.2), &[2.0]),
        (&pitchfork, 1, &[0.0], -0.5, (-1.0, 1.0), &[0.0]),
    ];
    for (map, period, start, at, window, exact) in cases {
        let start = (start, at);
        let steps = BranchSteps::default();
        let branch = follow_branch(&map, period, start, window, steps, |_| Continue(())).unwrap();
        let mut found = exact.iter().map(|exact| {
            let off = |found: &return_map::Bifurcation| (found.at.parameter - exact).abs();
            let all = branch.bifurcations.iter();
            all.min_by(|a, b| off(a).total_cmp(&off(b)))
                .map(|found| (off(found), found.error, found.kind))
        });
        assert!(
            found.all(|found| found.is_some_and(|(off, error, _)| off <= error && error < 1e-8)),
            "{exact:?}: {:?}",
            branch.bifurcations
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// The multipliers of an orbit of period n of a linear map with rotation of its axes in between, against a product in another order.
    #[test]
    fn of_planted_matrices(entries in proptest::collection::vec(-2.0f64..2.0, 9), d in proptest::collection::vec(-1.5f64..1.5, 3)) {
        let basis = DMatrix::from_vec(3, 3, entries) + DMatrix::identity(3, 3) * 3.0;
        let inverse = basis.clone().try_inverse();
        prop_assume!(inverse.is_some());
        let inverse = inverse.unwrap();
        prop_assume!(basis.norm() * inverse.norm() < 1e4);
        let diagonal = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(d.clone()));
        let matrix = &basis * diagonal * &inverse;
        let condition = basis.norm() * inverse.norm();
        let map = family(3, |x: &[f64], _| {
            Ok((&matrix * nalgebra::DVector::from_column_slice(x)).as_slice().to_vec())
        });
        let found = point_at(&map, 1, &[0.0, 0.0, 0.0], 0.0);
        let (off, stated) = off(&found, &d);
        // The matrix itself is rounded.
        let planted = 1e-15 * condition * condition;
        prop_assert!(off <= stated + planted, "{:e} {:e} {:?}", off, stated, found.multipliers);
    }
}
