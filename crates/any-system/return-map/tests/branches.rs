//! Branches with known bifurcations.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use crate::sections::strobe;
use equations::{Formulas, Names};
use example_systems::spring_leg::apexes;
use return_map::{
    BifurcationKind, Border, Branch, BranchEnd, BranchSteps, Error, FormulaMap, MapFamily, cascade,
    doubled_branch, family, follow_branch, follow_equilibria, pieces, scalar_family,
};
use std::ops::ControlFlow::{Break, Continue};

fn followed(map: &impl MapFamily, start: (&[f64], f64), window: (f64, f64)) -> Branch {
    follow_branch(map, 1, start, window, BranchSteps::default(), |_| Continue(())).unwrap()
}

fn kinds(branch: &Branch) -> Vec<(BifurcationKind, f64)> {
    branch.bifurcations.iter().map(|found| (found.kind, found.at.parameter)).collect()
}

/// x = 1 − 1/r: it crosses the branch x = 0 at r = 1, doubles at 3. The multiplier is 2 − r.
#[test]
fn the_logistic_map() {
    let exact = FormulaMap::new(
        &Formulas::from_text(Names::new(&["x"], &[("r", "2.5")]).unwrap(), &["r*x*(1 - x)"])
            .unwrap(),
        "r",
    )
    .unwrap();
    let closure = scalar_family(|x, r| r * x * (1.0 - x));
    for (map, digits) in [(&exact as &dyn MapFamily, 1e-13), (&closure, 1e-10)] {
        let branch = followed(&map, (&[0.6], 2.5), (0.5, 3.5));
        let found = kinds(&branch);
        assert_eq!(found.len(), 2, "{found:?}");
        assert_eq!(
            (found[0].0, found[1].0),
            (BifurcationKind::Transcritical, BifurcationKind::Doubling)
        );
        assert!((found[0].1 - 1.0).abs() < 1e-9 && (found[1].1 - 3.0).abs() < digits, "{found:?}");
        for point in &branch.points {
            let r = point.parameter;
            assert!((point.point[0] - (1.0 - 1.0 / r)).abs() < 1e-13, "{point:?}");
            assert!((point.multipliers[0].re - (2.0 - r)).abs() < 1e-9, "{point:?}");
            assert_eq!(point.is_stable, (1.0..3.0).contains(&r));
        }
        assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
        let ends = [branch.points.first().unwrap(), branch.points.last().unwrap()];
        assert_eq!(ends.map(|end| end.parameter), [0.5, 3.5]);
        // −ξ − 3ξ² …: b = (f″/2)² + f‴/6 = 9.
        let b = branch.bifurcations[1].coefficient.unwrap();
        assert!((b - 9.0).abs() < 1e-6, "{b}");
        let steps = BranchSteps::default();
        let doubled =
            doubled_branch(&map, (1, &branch.bifurcations[1]), (0.5, 3.5), steps, |_| Continue(()))
                .unwrap();
        let next = &doubled.bifurcations[0];
        assert!((next.at.parameter - (1.0 + 6f64.sqrt())).abs() < 10.0 * digits, "{next:?}");
        for point in &doubled.points {
            let (x, r) = (point.point[0], point.parameter);
            // Roots of the second iterate: (r + 1 ± √((r + 1)(r − 3)))/(2r).
            let root = ((r + 1.0) * (r - 3.0)).sqrt();
            let off = [1.0, -1.0].map(|s| (x - (r + 1.0 + s * root) / (2.0 * r)).abs());
            assert!(off[0].min(off[1]) < 1e-12, "{point:?}");
        }
    }
}

/// Feigenbaum's ratio, 4.669…, from the last of seven doublings.
#[test]
fn a_cascade_of_doublings() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let steps = BranchSteps::default();
    let doublings =
        cascade(&logistic, 1, (&[0.6], 2.8), (2.5, 4.0), steps, 7, |_| Continue(())).unwrap();
    let at: Vec<f64> = doublings.iter().map(|found| found.at.parameter).collect();
    assert_eq!(at.len(), 7, "{at:?}");
    for (found, exact) in at.iter().zip([3.0, 1.0 + 6f64.sqrt(), 3.544_090_359_6, 3.564_407_266_1])
    {
        assert!((found - exact).abs() < 1e-9, "{at:?}");
    }
    let ratio = (at[5] - at[4]) / (at[6] - at[5]);
    assert!((ratio - 4.669_2).abs() < 2e-3, "{ratio}");
    assert!(doublings.iter().all(|found| found.coefficient.unwrap() > 0.0));
}

/// Hénon's map, b = 0.3: the fold at a = −(1 − b)²/4, the doublings at 3(1 − b)²/4 and at 0.9125.
#[test]
fn henon_s_map() {
    let names = Names::new(&["x", "y"], &[("a", "1"), ("b", "0.3")]).unwrap();
    let formulas = Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"]).unwrap();
    let exact = FormulaMap::new(&formulas, "a").unwrap();
    let branch = followed(&exact, (&[1.0, 0.3], 0.2), (-0.5, 1.0));
    let found = kinds(&branch);
    let fold = found.iter().find(|found| found.0 == BifurcationKind::Fold).unwrap();
    assert!((fold.1 + 0.1225).abs() < 1e-13, "{found:?}");
    let doubling = branch.bifurcations.iter().find(|found| found.kind == BifurcationKind::Doubling);
    let doubling = doubling.unwrap();
    assert!((doubling.at.parameter - 0.3675).abs() < 1e-12, "{found:?}");
    let steps = BranchSteps::default();
    let doubled =
        doubled_branch(&exact, (1, doubling), (-0.5, 1.0), steps, |_| Continue(())).unwrap();
    assert!((doubled.bifurcations[0].at.parameter - 0.9125).abs() < 1e-12, "{:?}", kinds(&doubled));
}

/// The delayed logistic map x′ = r x (1 − y), y′ = x: an invariant circle begins at r = 2, where the multipliers are e^(±iπ/3).
#[test]
fn an_invariant_circle_begins() {
    let delayed = family(2, |x, r| Ok(vec![r * x[0] * (1.0 - x[1]), x[0]]));
    let branch = followed(&delayed, (&[0.4, 0.4], 1.7), (1.2, 2.3));
    let circle = &branch.bifurcations[0];
    assert_eq!((circle.kind, branch.bifurcations.len()), (BifurcationKind::NeimarkSacker, 1));
    assert!((circle.at.parameter - 2.0).abs() < 1e-9, "{circle:?}");
    let angle = circle.at.multipliers[0].im.abs().atan2(circle.at.multipliers[0].re);
    assert!((angle - std::f64::consts::FRAC_PI_3).abs() < 1e-8);
    // A stable circle: Re d < 0.
    assert!(circle.coefficient.unwrap() < -0.1, "{circle:?}");
    // Behind it the orbit stays near the circle, and not at the point.
    let mut x = vec![0.52, 0.52];
    for _ in 0..5000 {
        x = delayed.image(&x, 2.05).unwrap().point;
    }
    let off = (x[0] - (1.0 - 1.0 / 2.05)).hypot(x[1] - (1.0 - 1.0 / 2.05));
    assert!((0.02..0.5).contains(&off), "{off}");
}

/// x ↦ r x − x³ has a pitchfork at 1, with c = −1, and x ↦ r x + x³ one with c = 1.
#[test]
fn pitchforks_are_told_apart() {
    for sign in [-1.0, 1.0] {
        let map = scalar_family(move |x, r| r * x + sign * x * x * x);
        let branch = followed(&map, (&[0.0], 0.5), (0.2, 1.7));
        let fork = &branch.bifurcations[0];
        assert_eq!(fork.kind, BifurcationKind::Pitchfork);
        assert!((fork.at.parameter - 1.0).abs() < 1e-9);
        assert!((fork.coefficient.unwrap() - sign).abs() < 1e-6, "{fork:?}");
    }
}

/// The skew tent map x ↦ a x + μ for x < 0, b x + μ for x > 0: its fixed point μ/(1 − a) meets the border at μ = 0.
#[test]
fn a_border_collision_ends_a_branch() {
    let (a, b) = (0.4, -1.5);
    let tent = pieces(1, move |x: &[f64], mu| {
        let left = x[0] < 0.0;
        Ok((vec![if left { a } else { b } * x[0] + mu], if left { "left" } else { "right" }))
    });
    let branch = followed(&tent, (&[-1.0], -0.6), (-1.0, 1.0));
    let BranchEnd::Border { border: Border::Piece, at, beyond, place } = &branch.ends[1] else {
        panic!("{:?}", branch.ends)
    };
    assert!(at.parameter.abs() < 1e-9 && at.point[0].abs() < 1e-9, "{at:?}");
    assert_eq!((at.itinerary[0].as_str(), beyond[0].as_str(), *place), ("left", "right", 0));
    assert_eq!(branch.ends[0], BranchEnd::Window);
    assert!(
        branch.points.iter().all(|point| (point.point[0] - point.parameter / 0.6).abs() < 1e-12)
    );
}

#[test]
fn what_cannot_be_followed_is_an_error() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let steps = BranchSteps::default();
    let follow = |start: (&[f64], f64), window, period, steps| {
        follow_branch(&logistic, period, start, window, steps, |_| Continue(()))
    };
    for (start, window, period, steps) in [
        ((&[0.6][..], 2.5), (3.5, 0.5), 1, steps),
        ((&[0.6], 2.5), (0.5, f64::INFINITY), 1, steps),
        ((&[0.6], 5.0), (0.5, 3.5), 1, steps),
        ((&[0.6], f64::NAN), (0.5, 3.5), 1, steps),
        ((&[0.6], 2.5), (0.5, 3.5), 1, BranchSteps { first: 0.0, ..steps }),
    ] {
        assert!(matches!(follow(start, window, period, steps), Err(Error::BadArgument { .. })));
    }
    let none = follow((&[0.6], 2.5), (0.5, 3.5), 0, steps);
    assert!(matches!(none, Err(Error::BadPeriod { period: 0, .. })));
    assert!(follow((&[], 2.5), (0.5, 3.5), 1, steps).is_err());
    assert!(follow((&[f64::NAN], 2.5), (0.5, 3.5), 1, steps).is_err());
    // No fixed point at all.
    let shift = scalar_family(|x, p| x + 1.0 + 0.0 * p);
    let none = follow_branch(&shift, 1, (&[0.0], 0.5), (0.0, 1.0), steps, |_| Continue(()));
    let Err(Error::NoPeriodicPoint { point, parameter, residual, .. }) = none else {
        panic!("{none:?}")
    };
    assert_eq!((&point[..], parameter, residual), (&[0.0][..], Some(0.5), 1.0));
    // A domain that ends: what was found stays.
    let root = family(1, |x, p| match p > -0.3 {
        true => Ok(vec![0.5 * x[0] + p]),
        false => Err(Error::NoImage { point: x.to_vec(), parameter: p }),
    });
    let branch = followed(&root, (&[1.0], 0.5), (-1.0, 1.0));
    assert!(matches!(branch.ends[0], BranchEnd::Lost { .. }), "{:?}", branch.ends);
    assert!((branch.points[0].parameter + 0.3).abs() < 1e-8);
    assert!(branch.points.len() > 20);
    // It can be stopped.
    let mut seen = 0;
    let stop = |_: &_| {
        seen += 1;
        if seen >= 5 { Break(()) } else { Continue(()) }
    };
    let branch = follow_branch(&logistic, 1, (&[0.6], 2.5), (0.5, 3.5), steps, stop).unwrap();
    assert_eq!(branch.ends[1], BranchEnd::Stopped);
    assert!(branch.points.len() < 10);
}

/// A forced oscillator that grazes a stop: its free orbit ends at the forcing that the amplitude gives, by name of the surface.
#[test]
fn a_grazing_ends_a_branch_of_a_return_map() {
    use example_systems::impact_oscillator::{grazing_forcing, steady_start};
    let strobe = strobe();
    let [x, v, _] = steady_start(0.3);
    let steps = BranchSteps { first: 0.3, longest: 0.5, ..BranchSteps::default() };
    let branch =
        follow_branch(&strobe, 1, (&[x, v], 0.3), (0.2, 0.9), steps, |_| Continue(())).unwrap();
    for point in &branch.points {
        let [x, v, _] = steady_start(point.parameter);
        assert!((point.point[0] - x).abs() < 1e-11 && (point.point[1] - v).abs() < 1e-11);
        // e^(−ζ 2π/ω) for both multipliers.
        let exact = (-0.05 * std::f64::consts::TAU / 1.3f64).exp();
        assert!(point.multipliers.iter().all(|m| (m.norm() - exact).abs() < 1e-11));
    }
    let BranchEnd::Border { border, at, beyond, place } = &branch.ends[1] else {
        panic!("{:?}", branch.ends)
    };
    assert_eq!(border, &Border::Grazing { surface: String::from("free: stop") });
    let exact = grazing_forcing();
    assert!((at.parameter - exact).abs() < 1e-13, "{} {exact}", at.parameter);
    assert_eq!(beyond[*place], "free: stop");
}

/// A field with a fold, ẋ = p + x², and one with a pitchfork, ẋ = p x − x³.
#[test]
fn equilibria_fold_and_fork() {
    let fold = family(1, |x, p| Ok(vec![p + x[0] * x[0]]));
    let steps = BranchSteps::default();
    let branch =
        follow_equilibria(&fold, (&[-0.5], -0.25), (-1.0, 1.0), steps, |_| Continue(())).unwrap();
    assert_eq!(kinds(&branch)[0].0, BifurcationKind::Fold);
    assert!(branch.bifurcations[0].at.parameter.abs() < 1e-13);
    assert!((branch.bifurcations[0].coefficient.unwrap().abs() - 1.0).abs() < 1e-8);
    for point in &branch.points {
        let x = point.point[0];
        assert!((point.parameter + x * x).abs() < 1e-12 && (point.is_stable == (x < 0.0)));
    }
    let fork = family(1, |x, p| Ok(vec![p * x[0] - x[0] * x[0] * x[0]]));
    let branch =
        follow_equilibria(&fork, (&[0.0], -0.5), (-1.0, 1.0), steps, |_| Continue(())).unwrap();
    assert_eq!(kinds(&branch)[0].0, BifurcationKind::Pitchfork);
    assert!((branch.bifurcations[0].coefficient.unwrap() + 1.0).abs() < 1e-6);
}

/// The Hopf bifurcation of ẋ = p x − y − x (x² + y²), ẏ = x + p y − y (x² + y²): ṙ = p r − r³. With the eigenvector (1, −i)/√2 of
/// length 1 the radius is r = √2 |ζ|, so that l₁ is −2.
#[test]
fn a_cycle_begins_at_an_equilibrium() {
    for (sign, stable) in [(-1.0, true), (1.0, false)] {
        let field = family(2, move |x, p| {
            let r = sign * (x[0] * x[0] + x[1] * x[1]);
            Ok(vec![p * x[0] - x[1] + r * x[0], x[0] + p * x[1] + r * x[1]])
        });
        let steps = BranchSteps::default();
        let branch =
            follow_equilibria(&field, (&[0.0, 0.0], -0.5), (-1.0, 1.0), steps, |_| Continue(()))
                .unwrap();
        let hopf = &branch.bifurcations[0];
        assert_eq!(hopf.kind, BifurcationKind::Hopf);
        assert!(hopf.at.parameter.abs() < 1e-12);
        assert_eq!(hopf.coefficient.unwrap() < 0.0, stable);
        assert!((hopf.coefficient.unwrap().abs() - 2.0).abs() < 1e-6, "{hopf:?}");
    }
}

/// The spring leg at 5 m/s over its angle of attack: stable between a fold and a doubling, or the end of its flights.
#[test]
fn the_spring_leg_over_its_angle_of_attack() {
    let apex = apexes().unwrap().tolerances(hybrid_system::Tolerances::both(1e-11));
    let steps = BranchSteps { first: 0.05, longest: 0.15, ..BranchSteps::default() };
    let start = (&[example_systems::spring_leg::APEX][..], 68.0);
    let branch = follow_branch(&apex, 1, start, (66.2, 68.95), steps, |_| Continue(())).unwrap();
    let found = kinds(&branch);
    let of = |kind| found.iter().find(|found| found.0 == kind).unwrap().1;
    let (fold, doubling) = (of(BifurcationKind::Fold), of(BifurcationKind::Doubling));
    assert!((66.30..66.31).contains(&fold) && (68.8..68.9).contains(&doubling), "{found:?}");
    for point in &branch.points {
        // Between them the lower one of two runs is stable.
        let is_lower = point.point[0] < 1.05;
        let inside = point.parameter < doubling && is_lower;
        assert_eq!(point.is_stable, inside && point.multipliers[0].re < 1.0, "{point:?}");
    }
    let at = |angle: f64| branch.points.iter().find(|point| point.parameter == angle).unwrap();
    assert!((at(68.0).multipliers[0].re + 0.161).abs() < 1e-3);
    assert!((at(68.0).point[0] - example_systems::spring_leg::APEX).abs() < 1e-9);
    let itinerary = ["flight: touchdown", "stance: take-off", "flight: apex"];
    assert_eq!(at(68.0).itinerary, itinerary);
}

/// The coefficients of normal forms have units: a map in millionths is no other one. A cyclic shift has its eigenvalues.
#[test]
fn units_and_symmetric_matrices() {
    let scaled = scalar_family(|x, r| r * x * (1.0 - x / 1e6));
    let branch = followed(&scaled, (&[6e5], 2.5), (0.5, 3.5));
    let expected = [BifurcationKind::Transcritical, BifurcationKind::Doubling];
    assert_eq!(kinds(&branch).iter().map(|found| found.0).collect::<Vec<_>>(), expected);
    // x₁′ = p − x₄/2, x₂′ = x₁, …: the multipliers are the fourth roots of −½.
    let delay = family(4, |x, p| Ok(vec![p - 0.5 * x[3], x[0], x[1], x[2]]));
    let branch = followed(&delay, (&[0.3, 0.3, 0.3, 0.3], 0.5), (0.2, 0.9));
    for point in &branch.points {
        assert_eq!(point.multipliers.len(), 4);
        assert!(point.multipliers.iter().all(|m| (m.norm() - 0.5f64.powf(0.25)).abs() < 1e-9));
    }
    assert!(branch.bifurcations.is_empty(), "{:?}", kinds(&branch));
}
