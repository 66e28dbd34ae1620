//! Crossings under bounds: all are found, and no others. The names of tests give the source of a case.

use hybrid_system::*;
use nalgebra::Vector2;
use proptest::prelude::*;
use std::f64::consts::PI;

/// Times of all crossings. After each crossing the search starts again with `shift(time)`, the function shifted to
/// start there.
fn crossings(
    function: &QuasiPolynomial,
    shift: impl Fn(f64) -> QuasiPolynomial,
    horizon: f64,
) -> Vec<f64> {
    let (mut times, mut from) = (Vec::new(), 0.0);
    let mut now = function.clone();
    while let FirstCrossing::At { time, .. } =
        now.first_crossing(Direction::Either, horizon - from).unwrap()
    {
        from += time;
        times.push(from);
        now = shift(from);
        if times.len() > 50 {
            panic!("{times:?}");
        }
    }
    times
}

/// Π (t + s − r), as a polynomial in t.
fn with_roots(roots: &[f64], shift: f64) -> QuasiPolynomial {
    roots.iter().fold(QuasiPolynomial::polynomial(&[1.0]), |product, root| {
        product * QuasiPolynomial::polynomial(&[shift - root, 1.0])
    })
}

/// y = x³ + 6x² − 4x − 24 from x = −8 has its zeros at −6, −2 and 2. `SciPy` finds one of them (issue 9228).
#[test]
fn all_three_zeros_of_scipy_9228_are_found() {
    let at = |t: f64| {
        let x = t - 8.0;
        QuasiPolynomial::polynomial(&[
            ((x + 6.0) * x - 4.0) * x - 24.0,
            (3.0 * x + 12.0) * x - 4.0,
            3.0 * x + 6.0,
            1.0,
        ])
    };
    // Each zero is rounded to a multiple of 1/4, which is exact: the next search starts on the zero.
    let found = crossings(&at(0.0), |t| at((t * 4.0).round() / 4.0), 12.0);
    assert_eq!(found.len(), 3, "{found:?}");
    for (time, x) in found.iter().zip([-6.0, -2.0, 2.0]) {
        assert!((time - 8.0 - x).abs() < 1e-13, "{time}");
    }
}

#[test]
fn each_root_of_a_polynomial_is_found() {
    for roots in [vec![0.1, 0.4, 0.8], (1..10).map(|k| f64::from(k) / 10.0).collect::<Vec<_>>()] {
        let mut from = 0.0;
        for &root in &roots {
            // From 0.05 after the root before.
            let FirstCrossing::At { time, .. } =
                with_roots(&roots, from).first_crossing(Direction::Either, 2.0).unwrap()
            else {
                panic!("{root} is missed")
            };
            assert!((from + time - root).abs() < 1e-12, "{root}: {}", from + time);
            from = root + 0.05;
        }
        let end = with_roots(&roots, from).first_crossing(Direction::Either, 2.0).unwrap();
        assert_eq!(end, FirstCrossing::Never);
    }
}

#[test]
fn the_zeros_of_an_oscillator_are_found_in_each_direction() {
    let cosine = QuasiPolynomial::cosine(1.0, 1.0);
    for (direction, zero) in [
        (Direction::Falling, PI / 2.0),
        (Direction::Rising, 1.5 * PI),
        (Direction::Either, PI / 2.0),
    ] {
        let found = cosine.first_crossing(direction, 100.0).unwrap();
        let FirstCrossing::At { time, .. } = found else { panic!("{found:?}") };
        assert!((time - zero).abs() <= 4.0 * f64::EPSILON);
    }
    assert_eq!(cosine.first_crossing(Direction::Falling, 1.5).unwrap(), FirstCrossing::Never);
}

/// The guard y₀ − x² along ẋ = 1 from x = −1 stays away, touches, or crosses.
#[test]
fn a_parabola_misses_touches_or_crosses() {
    let guard = |y0: f64| QuasiPolynomial::polynomial(&[y0 - 1.0, 2.0, -1.0]);
    assert_eq!(guard(-1e-9).first_crossing(Direction::Either, 3.0).unwrap(), FirstCrossing::Never);
    let FirstCrossing::Touch { time, value } =
        guard(0.0).first_crossing(Direction::Either, 3.0).unwrap()
    else {
        panic!("it touches")
    };
    assert!((time - 1.0).abs() < 1e-6 && value.abs() < 1e-12);
    let FirstCrossing::At { time, .. } =
        guard(1e-12).first_crossing(Direction::Either, 3.0).unwrap()
    else {
        panic!("it crosses")
    };
    // −1 + 10⁻¹² is rounded to an ulp, which moves the root by about 10⁻¹⁰.
    assert!((time - 1.0 + 1e-6).abs() < 1e-9, "{time}");
}

/// Near roots of order 3 and more rounding hides the sign over a long interval. The signs before and behind it decide:
/// roots of odd order are crossings, roots of even order are touches.
#[test]
fn roots_of_odd_order_are_crossings_and_of_even_order_touches() {
    for order in 2..=7 {
        let function = with_roots(&vec![1.0; order], 0.0);
        let found = function.first_crossing(Direction::Either, 3.0).unwrap();
        let (time, value) = match found {
            FirstCrossing::At { time, rising } if order % 2 == 1 => {
                assert!(rising);
                (time, function.value(time))
            }
            FirstCrossing::Touch { time, value } if order % 2 == 0 => (time, value),
            _ => panic!("{order}: {found:?}"),
        };
        // Behind a hidden crossing the value is clear of rounding: the sum of the coefficients up to t = 3, 4ᵒʳᵈᵉʳ,
        // times some 30ε. Its root is the length of the hidden interval.
        let rounding = 4f64.powi(order as i32) * 30.0 * f64::EPSILON;
        let length = 2.0 * rounding.powf(1.0 / order as f64);
        assert!((time - 1.0).abs() < length && value.abs() < rounding, "{order}: {time} {value}");
    }
}

/// Starts at zero of order 1 to 8, to both sides.
#[test]
fn starts_at_zero_are_left_by_their_derivatives() {
    for order in 1..=8usize {
        for sign in [1.0, -1.0] {
            let mut coefficients = vec![0.0; order + 2];
            (coefficients[order], coefficients[order + 1]) = (sign, -sign);
            let function = QuasiPolynomial::polynomial(&coefficients);
            let (back, away) = if sign > 0.0 {
                (Direction::Falling, Direction::Rising)
            } else {
                (Direction::Rising, Direction::Falling)
            };
            let found = function.first_crossing(back, 5.0).unwrap();
            let FirstCrossing::At { time, .. } = found else { panic!("{order}: {found:?}") };
            assert!((time - 1.0).abs() < 1e-14);
            assert_eq!(function.first_crossing(away, 5.0).unwrap(), FirstCrossing::Never);
        }
    }
    // On the surface within rounding, as after an event.
    let rounded =
        QuasiPolynomial::cosine(0.3, 1.0) + QuasiPolynomial::polynomial(&[-0.3 + 5e-17, 1.0, -0.5]);
    let FirstCrossing::At { time, .. } = rounded.first_crossing(Direction::Falling, 9.0).unwrap()
    else {
        panic!()
    };
    assert!(time > 1.0);
    let zero = QuasiPolynomial::polynomial(&[0.0, 0.0]);
    assert_eq!(zero.first_crossing(Direction::Either, 1.0).unwrap(), FirstCrossing::Never);
    // The sign of a tiny value counts.
    let tiny = QuasiPolynomial::polynomial(&[1e-166, -1e-166]);
    assert_eq!(
        tiny.first_crossing(Direction::Either, 2.0).unwrap(),
        FirstCrossing::At { time: 1.0, rising: false }
    );
    assert!(tiny.first_crossing(Direction::Either, f64::INFINITY).is_err());
    assert!(
        QuasiPolynomial::polynomial(&[f64::NAN]).first_crossing(Direction::Either, 1.0).is_err()
    );
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Face {
    Floor,
    Ceiling,
}

/// A ball between floor and ceiling: two guards, both given as quasi-polynomials.
struct Box {
    height: f64,
}

impl HybridSystem for Box {
    type State = State<2>;
    type Mode = ();
    type Surface = Face;
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - 0.5 * t), x[1] - t)
    }
    fn guards(&self, _: ()) -> &[Guard<Face>] {
        const { &[Guard::falling(Face::Floor), Guard::rising(Face::Ceiling)] }
    }
    fn guard_value(&self, face: Face, x: &State<2>) -> f64 {
        match face {
            Face::Floor => x[0],
            Face::Ceiling => x[0] - self.height,
        }
    }
    fn guard_quasi_polynomial(&self, (): (), face: Face, x: &State<2>) -> Option<QuasiPolynomial> {
        Some(QuasiPolynomial::polynomial(&[self.guard_value(face, x), x[1], -0.5]))
    }
    fn reset(&self, _: (), face: Face, x: &State<2>) -> Reset<(), State<2>> {
        let height = if face == Face::Floor { 0.0 } else { self.height };
        Reset::Jump { mode: (), state: Vector2::new(height, -x[1]) }
    }
}

#[test]
fn a_ball_between_two_walls_needs_no_sampling() {
    let limits = Limits::new(20.0, 1000);
    let start = Vector2::new(0.0, 3.0);
    let events: Vec<_> = Execution::new(&Box { height: 1.0 }, (), start, limits)
        .filter_map(|arc| arc.unwrap().event().copied())
        .collect();
    assert!(events.len() > 20);
    // Each flight takes 3 − √7. The ball has speed √7 at the ceiling and 3 at the floor.
    let up = 3.0 - 7f64.sqrt();
    for (k, event) in events.iter().enumerate() {
        assert_eq!(event.surface, if k % 2 == 0 { Face::Ceiling } else { Face::Floor });
        assert_eq!(event.certainty, Certainty::Certain);
        let speed = if k % 2 == 0 { 7f64.sqrt() } else { 3.0 };
        assert!((event.before[1].abs() - speed).abs() < 1e-12);
        assert!((event.time - up * (k + 1) as f64).abs() < 1e-12);
    }
}

/// A dip far narrower than a useful sampling interval.
#[test]
fn a_narrow_dip_is_not_missed() {
    // cos 40t + 1 − 10⁻¹⁰ is below zero for a time of 7e-7 around π/40.
    let function = QuasiPolynomial::cosine(1.0, 40.0) + QuasiPolynomial::polynomial(&[1.0 - 1e-10]);
    let FirstCrossing::At { time, .. } = function.first_crossing(Direction::Falling, 10.0).unwrap()
    else {
        panic!("missed")
    };
    assert!((time - (PI - (2e-10f64).sqrt()) / 40.0).abs() < 1e-11);
}

proptest! {
    /// Random polynomials given by their roots: the first positive root is found.
    #[test]
    fn the_first_positive_root_is_found(mut roots in proptest::collection::vec(-3.0..3.0f64, 1..6)) {
        roots.sort_by(f64::total_cmp);
        prop_assume!(roots.windows(2).all(|pair| pair[1] - pair[0] > 1e-3));
        prop_assume!(roots.iter().all(|root| root.abs() > 1e-3));
        let found = with_roots(&roots, 0.0).first_crossing(Direction::Either, 4.0).unwrap();
        match roots.iter().find(|root| **root > 0.0) {
            None => prop_assert_eq!(found, FirstCrossing::Never),
            Some(root) => {
                let FirstCrossing::At { time, .. } = found else { panic!("{found:?}") };
                prop_assert!((time - root).abs() < 1e-9, "{} {}", time, root);
            }
        }
    }

    /// Sums of sines against dense samples: no change of sign before the first crossing.
    #[test]
    fn no_change_of_sign_before_the_first_crossing(a in -2.0..2.0f64, b in -2.0..2.0f64, c in -1.0..1.0f64, w in 0.3..5.0f64) {
        let function = QuasiPolynomial::cosine(a, w) + QuasiPolynomial::sine(b, 1.0) + QuasiPolynomial::polynomial(&[c, 0.1]);
        let start = function.value(0.0);
        prop_assume!(start.abs() > 1e-9);
        let found = function.first_crossing(Direction::Either, 20.0).unwrap();
        let until = match found {
            FirstCrossing::At { time, .. } => time,
            FirstCrossing::Touch { time, .. } | FirstCrossing::Undecided { time, .. } => time,
            FirstCrossing::Never => 20.0,
        };
        for k in 0..4000 {
            let t = until * f64::from(k) / 4000.0;
            prop_assert!(function.value(t) * start >= -1e-12, "{} before {}", t, until);
        }
        if let FirstCrossing::At { time, .. } = found {
            prop_assert!(function.value(time).abs() < 1e-12);
        }
    }
}
