//! Walkers and runners with printed results.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use example_systems::spring_leg::spring_leg;
use hybrid_system::Equations;
use nalgebra::{Complex, Vector2};
use return_map::{
    BifurcationKind, BranchPoint, BranchSteps, EquationReturns, MapFamily, fixed_points,
    follow_branch, periodic_point,
};
use std::ops::ControlFlow::{Break, Continue};

/// The simplest walking model (M. Garcia, A. Chatterjee, A. Ruina, M. Coleman, 1998): two straight legs without mass, on a slope γ. The stance
/// leg is at the angle θ, the swing leg at φ from it; the foot scuffs through the ground while both legs are together.
fn walker() -> EquationReturns {
    let walker = Equations::new(&["theta", "omega", "phi", "swing"], &[("slope", "0.009")])
        .mode_text(
            "step",
            &[
                "omega",
                "sin(theta - slope)",
                "swing",
                "sin(theta - slope) + omega^2*sin(phi) - cos(theta - slope)*sin(phi)",
            ],
        )
        .rising_text("heel", "phi - 2*theta")
        // The other zeros of the guard are the legs beside each other.
        .only_where_text("-phi - 1/10")
        .crossing()
        .resets_text(&[
            "-theta",
            "cos(2*theta)*omega",
            "-2*theta",
            "cos(2*theta)*(1 - cos(2*theta))*omega",
        ]);
    EquationReturns::new(&walker, "slope", ("step", "heel"), &["th", "om"])
        .unwrap()
        .starting_text(&["th", "om", "2*th", "(1 - cos(2*th))*om"])
        .unwrap()
        .coordinates_text(&["theta", "omega"])
        .unwrap()
}

fn at<M: MapFamily>(map: &M, start: &[f64], p: f64) -> BranchPoint {
    let window = (p - 1e-3, p + 1e-3);
    let steps = BranchSteps::default();
    let branch = follow_branch(map, 1, (start, p), window, steps, |_| Break(())).unwrap();
    branch.points.into_iter().next().unwrap()
}

/// Both gaits at γ = 0.009 to ten digits, with their multipliers to three: from the program of M. Garcia (1998).
#[test]
fn the_gaits_of_the_simplest_walker() {
    let walker = walker();
    let long = at(&walker, &[0.2003, -0.1998], 0.009);
    let (theta, omega) = (0.200_310_900_494_83, -0.199_832_472_917_64);
    assert!(
        (long.point[0] - theta).abs() < 1e-10 && (long.point[1] - omega).abs() < 1e-10,
        "{long:?}"
    );
    assert!(long.is_stable);
    for m in &long.multipliers {
        let off = (m.re + 0.191_208_689_499_40).hypot(m.im.abs() - 0.556_333_636_871_06);
        assert!(off < 2e-3, "{long:?}");
    }
    // To more digits by the values of the map alone: the printed ones are differences.
    let image = |x: &Vector2<f64>| {
        Ok(Vector2::from_column_slice(&walker.image(x.as_slice(), 0.009)?.point))
    };
    let own = periodic_point(image, &Vector2::new(0.2003, -0.1998), 1).unwrap();
    for (m, error) in own.multipliers.iter().zip(&own.multiplier_errors) {
        let off = |own: &Complex<f64>| (own - m).norm();
        let nearest = long.multipliers.iter().map(off).fold(1.0, f64::min);
        assert!(nearest <= error + long.multiplier_errors[0] && nearest < 1e-8, "{nearest:e}");
    }
    let short = at(&walker, &[0.1939, -0.2039], 0.009);
    let (theta, omega) = (0.193_937_369_606_24, -0.203_866_927_319_62);
    assert!((short.point[0] - theta).abs() < 1e-9 && (short.point[1] - omega).abs() < 1e-9);
    let mut sizes: Vec<f64> = short.multipliers.iter().map(|m| m.re).collect();
    sizes.sort_by(f64::total_cmp);
    assert!((sizes[0] - 0.459).abs() < 5e-3 && (sizes[1] - 4.0).abs() < 5e-3, "{sizes:?}");
    // The long gait doubles on the way to steeper slopes, where the printed figures have the onset of limping near γ = 0.0151.
    let start = (&long.point[..], 0.009);
    let steps = BranchSteps { first: 0.05, longest: 0.1, ..BranchSteps::default() };
    let branch = follow_branch(&walker, 1, start, (0.005, 0.018), steps, |_| Continue(())).unwrap();
    let doubling = &branch.bifurcations[0];
    assert_eq!(doubling.kind, BifurcationKind::Doubling);
    assert!((doubling.at.parameter - 0.0151).abs() < 1e-4, "{doubling:?}");
    assert!(doubling.coefficient.is_some_and(|b| b > 0.0));
}

/// The spring leg with 80 kg, 1 m and 20 kN/m (A. Seyfarth, H. Geyer, H. Herr, 2003): with the energy of 5 m/s at 1 m and 68° a run is
/// stable, and gathers all apexes up to about 1.3 m; with that of 3 m/s no run with a fixed angle is stable.
#[test]
fn the_stable_runs_of_a_spring_leg() {
    let apexes = |energy: &str| {
        EquationReturns::new(&spring_leg(), "attack", ("flight", "apex"), &["h"])
            .unwrap()
            .starting_text(&["0", "h", &format!("sqrt({energy} + 2*gravity*(1 - h))"), "0"])
            .unwrap()
            .coordinates_text(&["height"])
            .unwrap()
    };
    let points = |map: &EquationReturns, angle: f64| {
        let image = |h: f64| Some(map.image(&[h], angle).ok()?.point[0]);
        let lowest = angle.to_radians().sin();
        let found = fixed_points(image, lowest + 1e-4, 1.42, 150).unwrap();
        found.iter().map(|found| at(map, &[found.location], angle)).collect::<Vec<_>>()
    };
    let fast = points(&apexes("25"), 68.0);
    let [stable, unstable] = &fast[..] else { panic!("{fast:?}") };
    assert!(stable.is_stable && !unstable.is_stable);
    // The unstable run bounds what the stable one gathers.
    assert!((unstable.point[0] - 1.3).abs() < 0.05, "{unstable:?}");
    let slow = apexes("9");
    for angle in 50..85 {
        let found = points(&slow, f64::from(angle));
        assert!(found.iter().all(|point| !point.is_stable), "{angle}: {found:?}");
    }
}
