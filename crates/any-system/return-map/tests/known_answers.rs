//! Return maps with answers that are known: by closed forms, or proved by others.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use crate::sections::strobe;
use equations::Jet;
use example_systems::ball_on_table::{FREQUENCY, ball_on_table, periodic_start};
use example_systems::impact_oscillator::{grazing_forcing, steady_start};
use hybrid_system::{Equations, Tolerances};
use return_map::{
    BifurcationKind, Border, BranchEnd, BranchSteps, EquationReturns, FormulaMap, MapFamily,
    follow_branch, follow_equilibria, pieces,
};
use std::ops::ControlFlow::{Break, Continue};

/// The period-1 orbit of Rössler's system at c = 5.7, on x = 0 with ẋ > 0, whose place CAPD proves; the first of the doublings from
/// which its chaos comes.
#[test]
fn roessler_s_orbit_of_period_one() {
    let flow = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("section", "x")
        .crossing();
    let returns = EquationReturns::new(&flow, "c", ("flow", "section"), &["y", "z"]).unwrap();
    let steps = BranchSteps::default();
    let start = (&[-8.4, 0.03][..], 5.7);
    let here = follow_branch(&returns, 1, start, (5.699, 5.7), steps, |_| Break(())).unwrap();
    let orbit = &here.points[0];
    assert!((orbit.point[0] + 8.380_941_742_829_8).abs() < 1e-11, "{orbit:?}");
    assert!((orbit.point[1] - 0.029_590_060_630_665).abs() < 1e-12, "{orbit:?}");
    // Beside the doubling: from a point that was found by following the branch to it.
    let returns = returns.tolerances(Tolerances::both(1e-10));
    let steps = BranchSteps { first: 0.3, longest: 0.5, ..BranchSteps::default() };
    let start = (&[-4.55, 0.0525][..], 2.87);
    let branch = follow_branch(&returns, 1, start, (2.8, 2.87), steps, |_| Continue(())).unwrap();
    assert_eq!(branch.bifurcations.len(), 1);
    let doubling = &branch.bifurcations[0];
    assert_eq!(doubling.kind, BifurcationKind::Doubling);
    assert!((doubling.at.parameter - 2.832).abs() < 1e-3, "{}", doubling.at.parameter);
}

/// A ball that lands on a table once in a period (P. J. Holmes, 1982). With the table's speed w = g (1 − e)/(2 (1 + e)) at the impact
/// the derivative of the exact map has the determinant e² and the trace 1 + e² + (1 + e)² A, where A is the acceleration of the table.
/// The fold is at A = 0, the doubling at A = −2 (1 + e²)/(1 + e)²; the amplitude follows from w and A.
#[test]
fn holmes_s_lines() {
    for e in [0.5f64, 0.8] {
        let ball = ball_on_table().with_parameters(&[("restitution", &format!("{e:?}"))]);
        let impacts =
            EquationReturns::new(&ball, "amplitude", ("flight", "table"), &["phase", "v"])
                .unwrap()
                .starting_text(&["amplitude*sin(2*pi*phase)", "v", "phase"])
                .unwrap()
                .coordinates_text(&["t - 1", "speed"])
                .unwrap();
        let speed = 0.5 * (1.0 - e) / (1.0 + e);
        let amplitude =
            |acceleration: f64| (speed / FREQUENCY).hypot(acceleration / (FREQUENCY * FREQUENCY));
        let (fold, doubling) = (amplitude(0.0), amplitude(2.0 * (1.0 + e * e) / (1.0 + e).powi(2)));
        // A start between both lines.
        let start = 0.5 * (fold + doubling);
        let phase = (speed / (start * FREQUENCY)).acos() / FREQUENCY;
        let window = (0.5 * fold, 1.2 * doubling);
        let steps = BranchSteps::default();
        let branch =
            follow_branch(&impacts, 1, (&[phase, 0.5], start), window, steps, |_| Continue(()))
                .unwrap();
        let at = |kind| {
            let found = branch.bifurcations.iter().find(|found| found.kind == kind);
            found.unwrap().at.parameter
        };
        assert!((at(BifurcationKind::Fold) - fold).abs() < 1e-11, "{:?}", branch.bifurcations);
        assert!((at(BifurcationKind::Doubling) - doubling).abs() < 1e-11);
        for point in &branch.points {
            let determinant: f64 = point.multipliers.iter().map(|m| m.norm()).product();
            assert!((determinant - e * e).abs() < 1e-9, "{point:?}");
        }
    }
    let [_, speed, phase] = periodic_start(0.03);
    assert!(speed == 0.5 && phase > 0.0);
}

/// Beyond a grazing the derivative of the map grows as the inverse root of the distance (A. B. Nordmark, 1991).
#[test]
fn the_derivative_is_infinite_at_a_grazing() {
    let strobe = strobe();
    let largest = |beyond: f64| {
        let forcing = grazing_forcing() + beyond;
        let [x, v, _] = steady_start(forcing);
        let image = strobe.image(&[x, v], forcing).unwrap();
        assert_eq!(image.itinerary, ["free: stop", "free: strobe"]);
        let curve = [Jet::moving(x, 1.0), Jet::moving(v, 0.0)];
        let moved = strobe.pushed(&curve, Jet::number(forcing)).unwrap().curve;
        moved[0].0[1].hypot(moved[1].0[1])
    };
    let [near, nearer, nearest] = [1e-4, 1e-6, 1e-7].map(largest);
    assert!((nearer / near - 10.0).abs() < 0.5, "{near} {nearer}");
    assert!((nearest / nearer - 10f64.sqrt()).abs() < 0.01, "{nearer} {nearest}");
}

/// On the motion with impacts the largest multiplier grows as C/v beside the grazing, with the speed v of the impact (A. B. Nordmark, 1991).
#[test]
fn a_multiplier_is_infinite_at_a_grazing() {
    let strobe = strobe();
    let steps = BranchSteps::default();
    // The branch with impacts comes from its fold, and ends at the grazing.
    let start = (&[0.11, 0.80][..], 0.2);
    let window = (0.1, 0.4);
    let branch = follow_branch(&strobe, 1, start, window, steps, |_| Continue(())).unwrap();
    // The speed of the impact is in proportion to the distance from the grazing.
    let products: Vec<f64> = branch
        .points
        .iter()
        .filter(|point| !point.is_stable)
        .map(|point| (grazing_forcing() - point.parameter, point.spectral_radius()))
        .filter(|(distance, _)| *distance < 6e-4 && *distance > 0.0)
        .map(|(distance, multiplier)| multiplier * distance)
        .collect();
    let (low, high) =
        products.iter().fold((1.0f64, 0.0f64), |(low, high), x| (low.min(*x), high.max(*x)));
    assert!(products.len() > 5 && low > 0.0 && high < 1.002 * low, "{products:?}");
}

/// The tent map p·min(x, 1 − x): the fixed point p/(1 + p) with the multiplier −p is born at p = 1 on the border, and doubles nowhere.
#[test]
fn the_fixed_point_of_the_tent_map() {
    let tent = pieces(1, |x: &[f64], p| match x[0] < 0.5 {
        true => Ok((vec![p * x[0]], "left")),
        false => Ok((vec![p * (1.0 - x[0])], "right")),
    });
    let steps = BranchSteps::default();
    let start = (&[0.6][..], 1.5);
    let branch = follow_branch(&tent, 1, start, (0.5, 2.0), steps, |_| Continue(())).unwrap();
    for point in &branch.points {
        let p = point.parameter;
        assert!((point.point[0] - p / (1.0 + p)).abs() < 1e-12, "{point:?}");
        assert!((point.multipliers[0].re + p).abs() <= point.multiplier_errors[0], "{point:?}");
    }
    let BranchEnd::Border { at, .. } = &branch.ends[0] else { panic!("{:?}", branch.ends) };
    assert!((at.parameter - 1.0).abs() < 1e-9 && (at.point[0] - 0.5).abs() < 1e-9, "{at:?}");
    assert_eq!(branch.ends[1], BranchEnd::Window);
    // The multiplier is −1 at the border itself, and behind it no more.
    assert!(branch.bifurcations.is_empty(), "{:?}", branch.bifurcations);
}

/// The skew tent map a x + μ for x < 0, b x + μ for x > 0: with b < −1 the points of its cycle of two are μ (1 + a)/(1 − a b) and
/// μ (1 + b)/(1 − a b), with the multiplier a b. It is born at the border, where both collide.
#[test]
fn the_cycle_of_the_skew_tent_map() {
    let (a, b) = (0.4, -1.5);
    let tent = pieces(1, move |x: &[f64], mu| {
        let left = x[0] < 0.0;
        Ok((vec![if left { a } else { b } * x[0] + mu], if left { "left" } else { "right" }))
    });
    let steps = BranchSteps::default();
    let start = (&[0.5][..], 0.5);
    let branch = follow_branch(&tent, 2, start, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
    assert!(branch.points.len() > 20);
    for point in &branch.points {
        let mu = point.parameter;
        assert!((point.point[0] - mu * (1.0 + a) / (1.0 - a * b)).abs() < 1e-12, "{point:?}");
        assert!((point.multipliers[0].re - a * b).abs() < 1e-10 && point.is_stable);
        assert_eq!(point.itinerary, ["right", "left"]);
    }
    let BranchEnd::Border { at, .. } = &branch.ends[0] else { panic!("{:?}", branch.ends) };
    assert!(at.parameter.abs() < 1e-9, "{at:?}");
}

/// The valve's cycle without impacts: it begins at the Hopf bifurcation of the equilibrium, which the field alone tells, and ends where it
/// grazes the seat. Two branches, with impacts and without, end at this grazing.
#[test]
fn the_valve_from_its_hopf_bifurcation_to_its_grazing() {
    let valve = example_systems::valve::valve_equations();
    let field = valve.field(hybrid_system::Label::new("open").unwrap()).unwrap();
    let steps = BranchSteps { first: 0.05, longest: 0.25, ..BranchSteps::default() };
    let see = |_: &_| Continue(());
    let rest = (&[2.0, 0.0, 12.0][..], 2.0 * 12f64.sqrt());
    let field = FormulaMap::new(field, "flow").unwrap();
    let equilibria = follow_equilibria(&field, rest, (6.0, 9.5), steps, see).unwrap();
    let [hopf] = &equilibria.bifurcations[..] else { panic!("{:?}", equilibria.bifurcations) };
    assert_eq!(hopf.kind, BifurcationKind::Hopf);
    let names = ["displacement", "pressure"];
    let returns = EquationReturns::new(&valve, "flow", ("open", "turning point"), &names).unwrap();
    let grazes = |branch: &return_map::Branch, end: usize| match &branch.ends[end] {
        BranchEnd::Border { border: Border::Grazing { surface }, at, .. }
            if surface == "open: seat" =>
        {
            at.parameter
        }
        other => panic!("{other:?}"),
    };
    let start = (&[8.845, 0.7278][..], 7.56);
    let free = follow_branch(&returns, 1, start, (7.5, 8.6), steps, see).unwrap();
    let grazing = grazes(&free, if free.points[0].parameter < 7.6 { 0 } else { 1 });
    let start = (&[8.2, 0.76][..], 7.25);
    let hits = follow_branch(&returns, 1, start, (7.2, 7.6), steps, see).unwrap();
    let same = grazes(&hits, if hits.points[0].parameter < 7.21 { 1 } else { 0 });
    assert!(
        (grazing - same).abs() < 1e-12 && (grazing - 7.557_210_971_877).abs() < 1e-11,
        "{grazing} {same}"
    );
    // Where it begins the cycle has no size, and the map a fold.
    let fold = free.bifurcations.iter().find(|found| found.kind == BifurcationKind::Fold).unwrap();
    assert!((fold.at.parameter - hopf.at.parameter).abs() < 1e-6, "{fold:?} {hopf:?}");
    assert!((fold.at.point[0] - hopf.at.point[0]).abs() < 1e-4);
}

/// The rimless wheel (M. J. Coleman, 1998) over its slope γ: with half the angle α between spokes the map of Ω, the square of the speed
/// after a collision, is cos² 2α (Ω + 4 sin γ sin α). The branch ends where the wheel only just passes the vertical.
#[test]
fn the_rimless_wheel_over_its_slope() {
    let wheel = Equations::new(&["angle", "speed"], &[("slope", "0.1"), ("half", "0.3")])
        .mode_text("rolls", &["speed", "sin(angle)"])
        .rising_text("forward", "angle - slope - half")
        .resets_text(&["slope - half", "cos(2*half)*speed"])
        .falling_text("backward", "angle - slope + half")
        .resets_text(&["slope + half", "cos(2*half)*speed"]);
    let returns = EquationReturns::new(&wheel, "slope", ("rolls", "forward"), &["after"])
        .unwrap()
        .starting_text(&["slope - half", "after"])
        .unwrap()
        .coordinates_text(&["speed"])
        .unwrap();
    let (alpha, kept) = (0.3f64, 0.6f64.cos().powi(2));
    let rolling = |slope: f64| kept * 4.0 * slope.sin() * alpha.sin() / (1.0 - kept);
    let steps = BranchSteps { first: 0.1, longest: 0.3, ..BranchSteps::default() };
    let start = (&[rolling(0.1).sqrt()][..], 0.1);
    let branch = follow_branch(&returns, 1, start, (0.0, 0.2), steps, |_| Continue(())).unwrap();
    for point in &branch.points {
        assert!((point.point[0].powi(2) - rolling(point.parameter)).abs() < 1e-12, "{point:?}");
        // Beside the vertical the motion is unstable: the longer it stays there, the fewer digits a derivative has.
        let excess = rolling(point.parameter) - 2.0 * (1.0 - (point.parameter - alpha).cos());
        let off = (point.multipliers[0].re - kept).abs();
        assert!(off < 1e-12 + 1e-17 / (excess * excess), "{excess:e} {point:?}");
    }
    let slowest = branch.points.iter().map(|point| point.parameter).fold(1.0, f64::min);
    let excess = rolling(slowest) - 2.0 * (1.0 - (slowest - alpha).cos());
    assert!((0.0..1e-8).contains(&excess), "{slowest} {excess:e} {:?}", branch.ends);
}
