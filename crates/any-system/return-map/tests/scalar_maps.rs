//! Maps of one variable: pieces, laps, approximations, all periodic points with proofs.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use equations::{Formulas, Jet, Names};
use example_systems::spring_leg::apexes;
use return_map::{
    ApproximateMap, Error, MapFamily, OrbitEnd, PeriodicAttractor, all_equilibria,
    all_periodic_points, family, lyapunov_exponents, map_pieces, pieces, scalar_family,
};
use std::f64::consts::PI;
use std::ops::ControlFlow::Continue;

/// Points between two ends, at no special places.
fn between((left, right): (f64, f64), count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| left + (right - left) * (0.618_033_988_75 * (k as f64 + 1.0)).fract())
}

fn worst(map: &dyn MapFamily, fast: &ApproximateMap, window: (f64, f64), count: usize) -> f64 {
    let parameter = fast.parameter();
    between(window, count)
        .filter_map(|x| Some((fast.value(x)?, map.image(&[x], parameter).ok()?.point[0])))
        .fold(0.0, |worst: f64, (fast, exact)| worst.max((fast - exact).abs()))
}

#[test]
fn laps_and_inverse_branches_of_a_smooth_map() {
    let cubic = scalar_family(|x, p| p * x * (1.0 - x * x));
    let found = map_pieces(&cubic, 2.5, (-1.2, 1.2), 21).unwrap();
    assert_eq!((found.pieces.len(), found.gaps.len()), (1, 0));
    let extrema = &found.pieces[0].extrema;
    let at = 1.0 / 3f64.sqrt();
    assert_eq!(extrema.len(), 2);
    assert!((extrema[0].at + at).abs() < 1e-12 && !extrema[0].is_maximum);
    assert!((extrema[1].at - at).abs() < 1e-12 && extrema[1].is_maximum);
    assert!((extrema[1].value - 2.5 * at * 2.0 / 3.0).abs() < 1e-14);
    let fast = ApproximateMap::new(&cubic, &found, 1e-13).unwrap();
    assert_eq!(fast.polynomials(), 1);
    assert!(fast.error() < 1e-14 && worst(&cubic, &fast, (-1.2, 1.2), 10_000) < 1e-14);
    assert_eq!(fast.laps().len(), 3);
    // Three preimages of 0: −1, 0 and 1.
    let zeros = fast.preimages(0.0);
    assert!(zeros.iter().zip([-1.0, 0.0, 1.0]).all(|(x, exact)| (x - exact).abs() < 1e-14));
    for lap in 0..3 {
        if let Some(x) = fast.inverse(lap, 0.7) {
            assert!((cubic.image(&[x], 2.5).unwrap().point[0] - 0.7).abs() < 1e-13);
        }
    }
    assert_eq!(fast.inverse(3, 0.7), None);
    // No image outside, and none at another parameter.
    assert_eq!((fast.value(1.3), fast.value(f64::NAN)), (None, None));
    assert!(fast.image(&[0.3], 2.4).is_err());
}

/// Two critical points between two samples, which have the same sign of the slope.
#[test]
fn critical_points_between_samples_are_found() {
    let bump = scalar_family(|x, _| x + 0.05 * (-((x - 0.5) / 0.02).powi(2)).exp());
    let found = map_pieces(&bump, 0.0, (0.0, 1.0), 31).unwrap();
    assert_eq!(found.pieces[0].extrema.len(), 2, "{found:?}");
}

/// A tent with a root at its border, as maps near a grazing have: x < 0: x/2, x > 0: x/2 − √x.
#[test]
fn borders_with_a_root() {
    let map = pieces(1, |x: &[f64], p| {
        let root = if x[0] > 0.0 { x[0].sqrt() } else { 0.0 };
        Ok((vec![0.5 * x[0] - root + p], if x[0] > 0.0 { "hits" } else { "misses" }))
    });
    let found = map_pieces(&map, 0.1, (-1.0, 2.0), 8).unwrap();
    assert_eq!(found.pieces.len(), 2);
    let [misses, hits] = &found.pieces[..] else { panic!() };
    assert!(
        misses.ends.1.abs() < 1e-15 && hits.ends.0.abs() < 1e-15 && hits.border_errors.0 < 1e-15
    );
    assert_eq!((hits.itinerary[0].as_str(), hits.extrema.len()), ("hits", 1));
    // ½ = 1/(2√x) at 1.
    assert!((hits.extrema[0].at - 1.0).abs() < 1e-9);
    let fast = ApproximateMap::new(&map, &found, 1e-10).unwrap();
    assert!(worst(&map, &fast, (-1.0, 2.0), 20_000) < 1e-10, "{}", fast.error());
    let near = worst(&map, &fast, (0.0, 1e-9), 1000);
    assert!(near < 1e-10, "{near}");
    assert!(fast.polynomials() < 200, "{}", fast.polynomials());
}

/// x ↦ 1/x mod 1: a hundred pieces, and those without image.
#[test]
fn many_pieces_and_gaps() {
    let gauss = pieces(1, |x: &[f64], p| match x[0] > 0.0 {
        true => Ok((vec![(1.0 / x[0]).fract()], (1.0 / x[0]).floor())),
        false => Err(Error::NoImage { point: x.to_vec(), parameter: p }),
    });
    let found = map_pieces(&gauss, 0.0, (0.01, 0.999), 2000).unwrap();
    assert!(found.pieces.len() >= 99 && found.gaps.is_empty());
    // Infinitely many.
    let all = map_pieces(&gauss, 0.0, (-0.5, 0.999), 9);
    assert!(matches!(all, Err(Error::ManyPieces { .. })), "{all:?}");
    let half = pieces(1, |x: &[f64], p| match x[0] > 0.0 {
        true => Ok((vec![x[0].sqrt()], "right")),
        false => Err(Error::NoImage { point: x.to_vec(), parameter: p }),
    });
    let right = map_pieces(&half, 0.0, (-1.0, 1.0), 8).unwrap();
    assert_eq!((right.gaps.len(), right.pieces.len()), (1, 1));
    assert!(matches!(right.gaps[0].end, OrbitEnd::Failed(_)) && right.gaps[0].ends.1 == 0.0);
    for k in 1..=30 {
        let name = f64::from(k).to_string();
        let piece = found.pieces.iter().find(|piece| piece.itinerary[0] == name).unwrap();
        assert!((piece.ends.0 - 1.0 / f64::from(k + 1)).abs() < 1e-15, "{piece:?}");
        assert!(piece.extrema.is_empty() && piece.laps().len() == 1);
    }
    for (window, samples) in
        [((1.0, 0.0), 9), ((0.0, f64::INFINITY), 9), ((0.0, 1.0), 2), ((f64::NAN, 1.0), 9)]
    {
        assert!(matches!(map_pieces(&gauss, 0.0, window, samples), Err(Error::BadWindow { .. })));
    }
    assert!(map_pieces(&family(2, |x, _| Ok(x.to_vec())), 0.0, (0.0, 1.0), 9).is_err());
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let one = map_pieces(&logistic, 3.0, (0.0, 1.0), 9).unwrap();
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert!(ApproximateMap::new(&logistic, &one, tolerance).is_err());
    }
    // Noise above the tolerance is an error, not a search without an end.
    let noisy = scalar_family(|x, _| x + 1e-6 * (1e9 * x).sin());
    let one = map_pieces(&noisy, 0.0, (0.1, 1.0), 9).unwrap();
    assert!(matches!(ApproximateMap::new(&noisy, &one, 1e-9), Err(Error::ManyPieces { .. })));
}

/// The spring leg's apex map: its smooth piece, its approximation, and a thousand runs by it.
#[test]
fn a_return_map_by_polynomials() {
    let apex = apexes().unwrap();
    let found = map_pieces(&apex, 68.0, (0.8, 1.4), 25).unwrap();
    let legs: Vec<&str> = found.pieces.iter().map(|piece| piece.itinerary[0].as_str()).collect();
    assert!(legs.contains(&"flight: touchdown"), "{found:?}");
    let fast = ApproximateMap::new(&apex, &found, 1e-9).unwrap();
    assert!(worst(&apex, &fast, (0.8, 1.4), 100) < 1e-9);
    let mut h = 0.95;
    for _ in 0..100 {
        h = fast.value(h).unwrap();
    }
    assert!((h - example_systems::spring_leg::APEX).abs() < 1e-8, "{h}");
}

/// A map by polynomials is a map for all that takes one.
#[test]
fn an_approximate_map_has_slopes() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let found = map_pieces(&logistic, 4.0, (0.0, 1.0), 20).unwrap();
    let fast = ApproximateMap::new(&logistic, &found, 1e-10).unwrap();
    for x in between((0.0, 1.0), 20) {
        let found = fast.linearized(&[x], 4.0).unwrap();
        let off = (found.slopes[(0, 0)] - 4.0 * (1.0 - 2.0 * x)).abs();
        assert!(off <= found.errors[(0, 0)] && found.errors[(0, 0)] < 1e-6, "{off:e} {found:?}");
    }
    let exponent = lyapunov_exponents(&fast, (&[0.3], 4.0), 100, 20_000).unwrap().per_image[0];
    assert!(exponent.lower < 2f64.ln() && 2f64.ln() < exponent.upper, "{exponent:?}");
    let found = map_pieces(&logistic, 3.2, (0.0, 1.0), 20).unwrap();
    let fast = ApproximateMap::new(&logistic, &found, 1e-10).unwrap();
    assert_eq!(PeriodicAttractor::new(&fast, 2, (&[0.5], 3.2)).unwrap().orbit.len(), 2);
}

#[test]
fn compositions() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let one = map_pieces(&logistic, 3.7, (0.0, 1.0), 9).unwrap();
    let one = ApproximateMap::new(&logistic, &one, 1e-12).unwrap();
    let two = one.then(&one).unwrap();
    let three = one.then(&two).unwrap();
    assert_eq!((two.laps().len(), three.laps().len()), (4, 8));
    let image = |x: f64| logistic.image(&[x], 3.7).unwrap().point[0];
    for x in between((0.0, 1.0), 1000) {
        let exact = image(image(image(x)));
        assert!((three.value(x).unwrap() - exact).abs() <= three.error() + 1e-11);
    }
    // Pieces of both maps: the tent twice has four.
    let tent = pieces(1, |x: &[f64], p| match x[0] < 0.5 {
        true => Ok((vec![2.0 * p * x[0]], "L")),
        false => Ok((vec![2.0 * p * (1.0 - x[0])], "R")),
    });
    let one = map_pieces(&tent, 0.95, (0.0, 1.0), 9).unwrap();
    let one = ApproximateMap::new(&tent, &one, 1e-12).unwrap();
    let two = one.then(&one).unwrap();
    let names: Vec<String> = two.pieces().iter().map(|piece| piece.itinerary.concat()).collect();
    assert_eq!(names, ["LL", "LR", "RR", "RL"]);
    assert!((two.pieces()[0].ends.1 - 0.25 / 0.95).abs() < 1e-14);
}

#[cfg(feature = "serde")]
#[test]
fn maps_and_branches_are_saved_and_read() {
    use return_map::{Branch, BranchSteps, continue_branch, follow_branch};
    use std::ops::ControlFlow::{Break, Continue};
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let one = map_pieces(&logistic, 3.7, (0.0, 1.0), 9).unwrap();
    let fast = ApproximateMap::new(&logistic, &one, 1e-12).unwrap();
    let text = serde_json::to_string(&fast).unwrap();
    let read: ApproximateMap = serde_json::from_str(&text).unwrap();
    assert_eq!(read, fast);
    for (from, to) in [("\"right\":1.0", "\"right\":-1.0"), ("\"owners\":[0]", "\"owners\":[7]")] {
        let broken = text.replace(from, to);
        assert!(broken != text && serde_json::from_str::<ApproximateMap>(&broken).is_err());
    }
    let steps = BranchSteps::default();
    let mut seen = 0;
    let stop = |_: &_| {
        seen += 1;
        if seen < 9 { Continue(()) } else { Break(()) }
    };
    let branch = follow_branch(&logistic, 1, (&[0.6], 2.5), (1.5, 3.5), steps, stop).unwrap();
    let text = serde_json::to_string(&branch).unwrap();
    let read: Branch = serde_json::from_str(&text).unwrap();
    assert_eq!(read, branch);
    let whole = continue_branch(&logistic, &read, (1.5, 3.5), steps, |_| Continue(())).unwrap();
    let ends = [whole.points.first().unwrap(), whole.points.last().unwrap()];
    assert_eq!(ends.map(|end| end.parameter), [1.5, 3.5]);
    assert_eq!(whole.bifurcations.len(), 1);
    let in_order = whole.points.windows(2).all(|pair| pair[0].parameter < pair[1].parameter);
    assert!(in_order);
    // Another map is refused.
    let other = scalar_family(|x, r| 1.1 * r * x * (1.0 - x));
    let refused = continue_branch(&other, &branch, (1.5, 3.5), steps, |_| Continue(()));
    assert!(matches!(refused, Err(Error::OtherBranch { .. })));
}

/// Of the logistic map at r = 4 the points of period n are sin² of multiples of π/(2ⁿ ± 1): 2ⁿ of them.
#[test]
fn all_periodic_points_are_proved() {
    let logistic =
        Formulas::from_text(Names::new(&["x"], &[("r", "4")]).unwrap(), &["r*x*(1 - x)"]).unwrap();
    for n in 1..=7 {
        let found = all_periodic_points(&logistic, n, (-1.0, 2.0), |_| Continue(())).unwrap();
        assert!(found.undecided.is_empty(), "{n} {found:?}");
        let mut exact: Vec<f64> = (0..1 << n)
            .map(|k| {
                let k = f64::from(k);
                let divisor = f64::from(1 << n);
                let divisor = if k % 2.0 == 0.0 { divisor - 1.0 } else { divisor + 1.0 };
                (std::f64::consts::FRAC_PI_2 * (k + k % 2.0) / divisor).sin().powi(2)
            })
            .collect();
        exact.sort_by(f64::total_cmp);
        assert_eq!(found.points.len(), exact.len(), "{n}");
        for (point, exact) in found.points.iter().zip(&exact) {
            assert!((point.at.middle() - exact).abs() < 1e-12, "{n} {point:?} {exact}");
            assert!(point.at.width() < 1e-11);
            let least = point.least_period.unwrap();
            assert!(n.is_multiple_of(least));
            if *exact == 0.0 {
                assert_eq!(least, 1);
            }
        }
        let own = found.points.iter().filter(|point| point.least_period == Some(n)).count();
        assert_eq!(own, [2, 2, 6, 12, 30, 54, 126][n - 1]);
    }
}

#[test]
fn what_cannot_be_proved_is_named() {
    let of = |text: &str| Formulas::from_text(Names::new(&["x"], &[]).unwrap(), &[text]).unwrap();
    // A tangent fixed point at ½.
    let found = all_periodic_points(&of("x^2 + 0.25"), 1, (-2.0, 2.0), |_| Continue(())).unwrap();
    assert!(found.points.is_empty() && found.undecided.len() <= 3, "{found:?}");
    assert!(found.undecided.iter().any(|(low, high)| *low <= 0.5 && 0.5 <= *high));
    assert!(
        found.undecided.iter().all(|(low, high)| (low - 0.5).abs() < 1e-5 && high - low < 1e-5)
    );
    // No value to the left of 0.
    let found = all_periodic_points(&of("sqrt(x)"), 1, (-1.0, 3.0), |_| Continue(())).unwrap();
    assert_eq!(found.points.len(), 1, "{found:?}");
    assert!(found.points[0].at.contains(1.0));
    let found = all_equilibria(&of("x - x^3"), (-2.0, 2.0), |_| Continue(())).unwrap();
    assert_eq!((found.points.len(), found.undecided.len()), (3, 0));
    for (point, exact) in found.points.iter().zip([-1.0, 0.0, 1.0]) {
        assert!(point.at.contains(exact) && point.least_period == Some(0), "{point:?}");
        assert!(point.multiplier.contains(1.0 - 3.0 * exact * exact));
    }
    // On the end of the window, and outside of it.
    assert_eq!(all_equilibria(&of("x - 1"), (0.0, 1.0), |_| Continue(())).unwrap().points.len(), 1);
    assert_eq!(
        all_equilibria(&of("x - 1"), (0.0, 0.999), |_| Continue(())).unwrap().points.len(),
        0
    );
    assert!(all_periodic_points(&of("x"), 0, (0.0, 1.0), |_| Continue(())).is_err());
    assert!(all_periodic_points(&of("x^2"), 1, (1.0, 0.0), |_| Continue(())).is_err());
    assert!(all_periodic_points(&of("x*t"), 1, (0.0, 1.0), |_| Continue(())).is_err());
    let two = Formulas::from_text(Names::new(&["x", "y"], &[]).unwrap(), &["x", "y"]).unwrap();
    assert!(all_periodic_points(&two, 1, (0.0, 1.0), |_| Continue(())).is_err());
}

/// Beside a border at which the second derivative of a piece is infinite: distances that fit on the piece are still too long.
#[test]
fn derivatives_beside_a_singular_border_are_as_sure_as_they_say() {
    let map = pieces(1, |x: &[f64], _| {
        let d = x[0];
        Ok((vec![d - d.abs().powf(4.0 / 3.0)], d > 0.0))
    });
    for d in [1e-1, 1e-2, 1e-3] {
        let found = map.pushed(&[Jet::moving(d, 1.0)], Jet::number(0.0)).unwrap().curve[0];
        let exact = 1.0 - 4.0 / 3.0 * d.cbrt();
        assert!((found.0[1] - exact).abs() < 1e-6, "{d}: {found:?} {exact}");
    }
    // A kink has no derivative, though both sides of it cancel.
    for kink in [|x: f64| 1.5 * x.abs(), |x: f64| x.abs().sqrt(), |x: f64| 1.0 - 1.5 * x.abs()] {
        let map = scalar_family(move |x, _| kink(x));
        let found = map.pushed(&[Jet::moving(0.0, 1.0)], Jet::number(0.0));
        assert!(matches!(found, Err(Error::Differences { .. })), "{found:?}");
    }
}

/// Features that are far smaller than a number, and numbers that are small or large themselves.
#[test]
fn derivatives_of_small_features() {
    let slope = |map: &dyn MapFamily, x: f64| map.linearized(&[x], 0.0).unwrap().slopes[(0, 0)];
    let close = |found: f64, exact: f64, error: f64, what: &str| {
        assert!((found - exact).abs() <= error, "{what}: {found} {exact}");
    };
    for s in [1e-4, 1e-6, 1e-8] {
        close(slope(&scalar_family(|x, _| s * (x / s).sin()), 0.0), 1.0, 1e-7, "sine");
        close(slope(&scalar_family(|x, _| x / (1.0 + (x / s).powi(2))), 0.0), 1.0, 1e-7, "peak");
        let ricker = scalar_family(|x, _| x * (2.5 * (1.0 - x / s)).exp());
        close(slope(&ricker, s), -1.5, 1e-6, "Ricker");
        let bump = scalar_family(|x, _| 0.5 * x + s * (-(x / s).powi(2)).exp());
        close(slope(&bump, -0.5 * s), 0.5 + (-0.25f64).exp(), 1e-6, "bump");
    }
    for c in [1e5, 1e6, 1e8] {
        let map = scalar_family(|x, _| x + 0.5 * (x - c).sin());
        close(slope(&map, c), 1.5, 1e-9 * c.sqrt() + 1e-14 * c, "shifted");
    }
    for k in [128.0, 256.0, 1024.0] {
        let map = scalar_family(|x, _| 0.5 * x + 0.1 / k * (2.0 * PI * k * x).sin());
        close(slope(&map, 0.0), 0.5 + 0.2 * PI, 1e-8, "aliases");
    }
    let kink = scalar_family(|x, _| if x > 1e-4 { 0.6 * x - 1e-5 } else { 0.5 * x });
    close(slope(&kink, 0.0), 0.5, 1e-9, "a kink beside");
    // Values that do not change, and the top of a parabola.
    assert_eq!(slope(&scalar_family(|_, _| 3.0), 0.3), 0.0);
    close(slope(&scalar_family(|x, _| 3.9 * x * (1.0 - x)), 0.5), 0.0, 1e-12, "top");
}
