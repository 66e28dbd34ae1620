//! What the crates for the hopper know is found again by tools that do not know the hopper: crises, groundings and minima on fixed points
//! as folds, its pieces and laps, and its map from the equations of a juggler.

#![allow(clippy::disallowed_methods)]

use equations::{Formulas, Names};
use hopper_basin::{crisis, grounding, minima_on_fixed_points};
use hybrid_system::Equations;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use return_map::{
    BifurcationKind, BranchSteps, EquationReturns, Error, FormulaMap, MapFamily, all_equilibria,
    follow_equilibria, map_pieces, pieces,
};
use std::f64::consts::PI;
use std::ops::ControlFlow::Continue;

/// α′² − target² on the contact part of a hump, with half the time of flight h as the variable: A(h)² − μ Γ(h)² − target².
fn above(target: f64) -> Formulas {
    let names = Names::new(&["h"], &[("M", "0.7"), ("target", &format!("{target:?}"))]).unwrap();
    let a = "(h^2 - sin(h)^2)/(h - sin(h)*cos(h))";
    let gamma = "2*(h*cos(h) - sin(h))^2/(h - sin(h)*cos(h))";
    let text = format!("({a})^2 - M/(1 + M)^2*({gamma})^2 - target^2");
    Formulas::from_text(names, &[&text]).unwrap()
}

/// The mass ratio at which the minimum of a hump is at a speed: the fold of the branch of hops that end there. It begins at a mass ratio at
/// which some hops do.
fn fold(hump: u64, target: f64, from: &str) -> (f64, f64) {
    let formula = above(target).with_parameters(&[("M", from)]).unwrap();
    // The fixed point itself is a triple root.
    let (left, right) = (alpha_star(hump), (hump as f64 + 1.0) * PI);
    let found = all_equilibria(&formula, (left + 0.1, right), |_| Continue(())).unwrap();
    assert!(found.undecided.is_empty());
    let start = found.points[0].at.middle();
    let map = FormulaMap::new(&formula, "M").unwrap();
    let from: f64 = from.parse().unwrap();
    let steps = BranchSteps::default();
    let branch =
        follow_equilibria(&map, (&[start], from), (0.01, 1.0), steps, |_| Continue(())).unwrap();
    let folds = branch.bifurcations.iter().filter(|found| found.kind == BifurcationKind::Fold);
    // The other fold is that of 1/M: μ is the same, at M = 1.
    let lower = folds.min_by(|a, b| a.at.parameter.total_cmp(&b.at.parameter)).unwrap();
    (lower.at.parameter, lower.error)
}

#[test]
fn crises_and_groundings_are_folds() {
    for n in 1..=4 {
        let known = crisis(n).unwrap();
        let (found, error) = fold(n, alpha_star(n), "0.2");
        let off = (found - known.mass_ratio).abs();
        assert!(off <= error + known.error && error < 1e-14, "{n}: {off:e} {error:e} {known:?}");
    }
    for n in 0..=2 {
        let known = grounding(n).unwrap();
        let (found, error) = fold(n, 0.0, "0.9");
        let off = (found - known.mass_ratio).abs();
        assert!(off <= error + known.error && error < 1e-14, "{n}: {off:e} {error:e} {known:?}");
    }
}

#[test]
fn minima_on_fixed_points_are_folds() {
    let range = basin_of_attraction::Interval::new(0.1, 0.3).unwrap();
    let known = minima_on_fixed_points(range, 3, 1).unwrap();
    assert!(known.iter().any(|fall| fall.fixed_point != fall.hump));
    for fall in &known {
        let (found, error) = fold(fall.hump, alpha_star(fall.fixed_point), "0.5");
        // These mass ratios have no stated error: they are found to rounding.
        let off = (found - fall.mass_ratio).abs();
        assert!(off <= error + 4.0 * f64::EPSILON && error < 1e-14, "{off:e} {error:e} {fall:?}");
    }
}

/// The map over the mass ratio. A piece has the number of its sudden lift-offs.
fn lift_off() -> impl MapFamily {
    pieces(1, |alpha: &[f64], mass_ratio| {
        let point = || Error::NoImage { point: alpha.to_vec(), parameter: mass_ratio };
        let map = LiftOffMap::new(MassRatio::new(mass_ratio).map_err(|_| point())?);
        let hop = map.hop(alpha[0]).map_err(|_| point())?;
        Ok((vec![hop.next.ok_or_else(point)?], hop.sudden))
    })
}

/// A collision: the second image of a minimum falls onto a fixed point where the square of the map is at it and has no slope.
#[test]
fn second_images_of_minima_are_folds() {
    let range = basin_of_attraction::Interval::new(0.13, 0.3).unwrap();
    let known = minima_on_fixed_points(range, 3, 2).unwrap();
    let mut tried = 0;
    for fall in known.iter().filter(|fall| fall.hops == 2) {
        let star = alpha_star(fall.fixed_point);
        let twice = return_map::scalar_family(|alpha, mass_ratio| {
            let Ok(mass_ratio) = MassRatio::new(mass_ratio) else { return f64::NAN };
            let map = LiftOffMap::new(mass_ratio);
            let image = |alpha| map.image(alpha).ok().flatten().unwrap_or(f64::NAN);
            image(image(alpha)) - star
        });
        // On one side of the fold there are two roots, next to the minimum of the map.
        let hump = (alpha_star(fall.hump), (fall.hump as f64 + 1.0) * PI);
        let start = [1.0001, 0.9999].into_iter().find_map(|part| {
            let beside = fall.mass_ratio * part;
            let found = map_pieces(&lift_off(), beside, hump, 200).unwrap();
            let mut extrema = found.pieces.iter().flat_map(|piece| &piece.extrema);
            let at = extrema.find(|e| !e.is_maximum)?.at;
            let value = |alpha: f64| Some(twice.image(&[alpha], beside).ok()?.point[0]);
            // A root of the parabola about the minimum.
            let h = 1e-3;
            let here = value(at)?;
            let second = (value(at + h)? + value(at - h)? - 2.0 * here) / (h * h);
            let aside = (-2.0 * here / second).sqrt();
            aside.is_finite().then_some((at + aside, beside))
        });
        let (start, beside) = start.unwrap();
        let steps = BranchSteps { first: 1e-3, longest: 1e-2, ..BranchSteps::default() };
        let window = (0.99 * fall.mass_ratio, 1.01 * fall.mass_ratio);
        let start = (&[start][..], beside);
        let branch = follow_equilibria(&twice, start, window, steps, |_| Continue(())).unwrap();
        let fold = branch.bifurcations.iter().find(|found| found.kind == BifurcationKind::Fold);
        let found = fold.unwrap();
        // By differences of a map that turns within 0.1.
        let off = (found.at.parameter - fall.mass_ratio).abs();
        assert!(
            off <= found.error + 4.0 * f64::EPSILON && off < 1e-14,
            "{off:e} {fall:?} {found:?}"
        );
        tried += 1;
    }
    assert!(tried > 0, "{known:?}");
}

/// At M = 0.2: sudden landings for α in (kπ, α*_k), two laps on each contact part, whose minimum is where 4μ sin h (sin h − h cos h) = 1.
#[test]
fn humps_windows_and_laps() {
    let map = lift_off();
    let found = map_pieces(&map, 0.2, (0.5, 4.0 * PI), 2000).unwrap();
    assert!(found.gaps.is_empty());
    let names: Vec<&str> = found.pieces.iter().map(|piece| piece.itinerary[0].as_str()).collect();
    assert_eq!(names, ["0", "1", "0", "1", "0", "1", "0"]);
    for (k, pair) in found.pieces.windows(2).enumerate() {
        let n = (k / 2 + 1) as u64;
        let border = if k % 2 == 0 { n as f64 * PI } else { alpha_star(n) };
        let at = pair[0].ends.1.midpoint(pair[1].ends.0);
        assert!((at - border).abs() < 1e-13, "{k}: {at} {border}");
    }
    let mu = MassRatio::new(0.2).unwrap().mu();
    for (k, piece) in found.pieces.iter().step_by(2).enumerate() {
        let minima: Vec<_> = piece.extrema.iter().filter(|extremum| !extremum.is_maximum).collect();
        for minimum in &minima {
            let slope = |h: f64| 1.0 - 4.0 * mu * h.sin() * (h.sin() - h * h.cos());
            let speed = |h: f64| (h * h - h.sin().powi(2)) / (h - h.sin() * h.cos());
            // The first h at which the slope is zero behind the last one whose speed is smaller.
            let (mut low, mut high) = (alpha_star(k as u64).max(0.5), (k as f64 + 1.0) * PI);
            while high - low > 1e-15 * high {
                let middle = low.midpoint(high);
                if speed(middle) < minimum.at { low = middle } else { high = middle }
            }
            assert!(slope(low).abs() < 1e-6, "{k}: {minimum:?} {}", slope(low));
        }
        if k > 0 {
            assert_eq!((minima.len(), piece.laps().len()), (1, 3), "{k}: {piece:?}");
        }
    }
}

/// The juggler of the same map, from its equations: a hand s on a spring catches a ball P, and throws it where s = 1.
fn juggler() -> Equations {
    let both = "(u + M*w)/(1 + M)";
    Equations::new(&["s", "w", "P", "u"], &[("M", "0.2")])
        .mode_text("free", &["w", "-s", "u", "-1"])
        .falling_text("catch", "P - s")
        .only_where_text("1 - s")
        .resets_text(&["s", both, "s", both])
        .to("held")
        .falling_text("catch above", "P - s")
        .only_where_text("s - 1")
        .resets_text(&["s", both, "s", both])
        .mode_text("held", &["w", "-(M*s + 1)/(1 + M)", "u", "-(M*s + 1)/(1 + M)"])
        .rising_text("throw", "s - 1")
        .to("free")
}

#[test]
fn the_map_of_a_juggler_by_its_equations() {
    let throws = EquationReturns::new(&juggler(), "M", ("free", "throw"), &["alpha"])
        .unwrap()
        .starting_text(&["1", "alpha", "1", "alpha"])
        .unwrap()
        .coordinates_text(&["w"])
        .unwrap();
    for mass_ratio in [0.1, 0.2, 0.5] {
        let map = LiftOffMap::new(MassRatio::new(mass_ratio).unwrap());
        for alpha in [1.5, 2.7, 3.5, 4.1, 4.7, 5.5, 6.6, 7.0, 8.3, 12.0] {
            let Some(known) = map.image(alpha).unwrap() else { continue };
            let image = throws.image(&[alpha], mass_ratio).unwrap();
            assert!(
                (image.point[0] - known).abs() < 1e-11,
                "{mass_ratio} {alpha}: {image:?} {known}"
            );
            assert_eq!(image.itinerary.len(), 2 + map.hop(alpha).unwrap().sudden);
        }
    }
}
