//! Guards with exponentials: damped and overdamped oscillators, growing oscillations. The zeros are those of mpmath 1.3
//! with 40 digits (`findroot` on each change of sign of a fine sample), rounded to 20 digits.

#![allow(clippy::excessive_precision)]

use hybrid_system::*;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Zeros are found to this relative error: some ulps for the rounding of the guard, whose slope at the zeros is at
/// least a hundredth of its size.
const KNOWN: f64 = 1e-14;

fn constant(value: f64) -> QuasiPolynomial {
    QuasiPolynomial::polynomial(&[value])
}

fn crossing(function: &QuasiPolynomial, direction: Direction, horizon: f64) -> f64 {
    match function.first_crossing(direction, horizon).unwrap() {
        FirstCrossing::At { time, .. } => time,
        other => panic!("{other:?}"),
    }
}

fn assert_close(found: f64, known: f64) {
    assert!((found - known).abs() <= KNOWN * known, "{found} instead of {known}");
}

/// ẍ + ẋ/4 + x = 0, and the guard x − 1/16, which only watches.
struct Oscillator;

/// Damping γ and frequency √(1 − γ²).
const GAMMA: f64 = 0.125;

impl HybridSystem for Oscillator {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        let omega = (1.0 - GAMMA * GAMMA).sqrt();
        let (sin, cos) = (omega * t).sin_cos();
        let decay = (-GAMMA * t).exp();
        let slope = (x[1] + GAMMA * x[0]) / omega;
        let position = decay * (x[0] * cos + slope * sin);
        Vector2::new(position, decay * omega * (slope * cos - x[0] * sin) - GAMMA * position)
    }
    fn guards(&self, (): ()) -> &[Guard<()>] {
        const { &[Guard::either(()).crossing()] }
    }
    fn guard_value(&self, (): (), x: &State<2>) -> f64 {
        x[0] - 0.0625
    }
    fn guard_quasi_polynomial(&self, (): (), (): (), x: &State<2>) -> Option<QuasiPolynomial> {
        let omega = (1.0 - GAMMA * GAMMA).sqrt();
        let swing = QuasiPolynomial::cosine(x[0], omega)
            + QuasiPolynomial::sine((x[1] + GAMMA * x[0]) / omega, omega);
        Some(swing.damped(GAMMA) - constant(0.0625))
    }
    fn reset(&self, (): (), (): (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: *x }
    }
}

#[test]
fn all_zeros_of_a_damped_oscillator_are_found_with_certainty() {
    let known = [
        1.6328070160304343632,
        4.9928838549282610186,
        7.8743654283447156773,
        11.474156228491708814,
        14.00713079418229118,
        18.193733592669429371,
        19.864340337216363081,
    ];
    let limits = Limits::new(1e4, 100);
    let events: Vec<_> = Execution::new(&Oscillator, (), Vector2::new(1.0, 0.0), limits)
        .filter_map(|arc| arc.unwrap().event().cloned())
        .collect();
    assert_eq!(events.len(), known.len());
    for (event, known) in events.iter().zip(known) {
        assert_eq!(event.certainty, Certainty::Certain);
        // The errors of the states add up from event to event: some ulps of an amplitude of 1, at slopes above 0.1.
        let error = (event.time - known).abs();
        assert!(error < 1e-13, "{} instead of {known}", event.time);
    }
}

#[test]
fn zeros_of_damped_growing_and_mixed_oscillations() {
    let damped = QuasiPolynomial::cosine(1.0, 3.0).damped(0.2) - constant(0.1);
    assert_close(crossing(&damped, Direction::Falling, 20.0), 0.48678219312100599482);
    assert_close(crossing(&damped, Direction::Rising, 20.0), 1.6170048263808456557);
    let growing = QuasiPolynomial::sine(0.001, 7.0).damped(-0.5) - constant(5.0);
    assert_close(crossing(&growing, Direction::Rising, 1e3), 17.218411812429598896);
    assert_close(crossing(&growing, Direction::Falling, 1e3), 17.357834867674454108);
    // (t² − 3t) exp(−t) + 1/4
    let product = QuasiPolynomial::polynomial(&[0.0, -3.0, 1.0])
        * QuasiPolynomial::exponential(1.0, -1.0)
        + constant(0.25);
    assert_close(crossing(&product, Direction::Falling, 1e2), 0.094581833665207862292);
    assert_close(crossing(&product, Direction::Rising, 1e2), 2.0518140303741448866);
    // Two oscillations with dampings and frequencies of their own.
    let two = QuasiPolynomial::sine(1.0, 2.0).damped(0.5)
        - QuasiPolynomial::sine(0.5, 3.0).damped(0.25)
        + constant(0.03125);
    assert_close(crossing(&two, Direction::Falling, 15.0), 1.8741022627880670075);
    assert_close(crossing(&two, Direction::Rising, 15.0), 3.1134231177904008139);
}

/// exp(−t) − 6 exp(−2t) + 9(1 − 10⁻¹⁰) exp(−3t) is zero at ln 3 ∓ 10⁻⁵: between the zeros it is below 10⁻¹⁰.
#[test]
fn two_close_zeros_of_an_overdamped_system_are_found() {
    let c = 1.0 - 1e-10;
    let function = QuasiPolynomial::exponential(1.0, -1.0)
        - QuasiPolynomial::exponential(6.0, -2.0)
        + QuasiPolynomial::exponential(9.0 * c, -3.0);
    // 9c is rounded by up to 9e-16, which moves a zero by 9e-16 · exp(−3t) / |g′| ≈ 5e-12.
    let close = |found: f64, known: f64| assert!((found - known).abs() < 2e-11, "{found}");
    close(crossing(&function, Direction::Falling, 1e3), 1.098602288617695652076);
    close(crossing(&function, Direction::Rising, 1e3), 1.098622288618523722436);
}

/// An exponential has no zero, although its value underflows; and a growing one overflows without harm.
#[test]
fn exponentials_that_underflow_or_overflow_do_not_hide_the_result() {
    for rate in [-1.0, 1.0, -1e3, 1e3] {
        let function = QuasiPolynomial::exponential(1.0, rate);
        assert_eq!(function.first_crossing(Direction::Either, 1e6).unwrap(), FirstCrossing::Never);
        // Π/3 is a zero of the oscillation, whatever the damping is.
        let swing = QuasiPolynomial::cosine(1.0, 1.5).damped(rate);
        assert_close(crossing(&swing, Direction::Either, 1e6), PI / 3.0);
    }
}

/// Π (exp(−t) − exp(−r)) has its zeros at the planted times, in turn falling and rising.
#[test]
fn planted_zeros_of_sums_of_exponentials_are_found() {
    for roots in [[0.5f64, 1.0, 1.5], [0.25, 0.251, 3.0], [1.0, 1.0 + 1e-5, 2.0]] {
        let function = roots.iter().fold(constant(1.0), |product, root| {
            product * (QuasiPolynomial::exponential(1.0, -1.0) - constant((-root).exp()))
        });
        // The rounding of the coefficients, 1e-15, over the slope at the root.
        let slope = |k: usize| -> f64 {
            (0..3).filter(|&j| j != k).map(|j| (-roots[j]).exp() - (-roots[k]).exp()).product()
        };
        for (k, direction) in [(0, Direction::Falling), (1, Direction::Rising)] {
            let found = crossing(&function, direction, 50.0);
            let error = 1e-15 / (slope(k) * (-roots[k]).exp()).abs();
            assert!((found - roots[k]).abs() < error, "{found} instead of {}: {error}", roots[k]);
        }
    }
}

#[test]
fn a_frequency_whose_square_underflows_keeps_its_zeros() {
    let slow = QuasiPolynomial::sine(1.0, 1e-170);
    assert_close(crossing(&slow, Direction::Falling, 1e180), PI * 1e170);
    let fast = QuasiPolynomial::cosine(1.0, 1e170);
    assert_close(crossing(&fast, Direction::Falling, 1.0), PI / 2.0 * 1e-170);
    let late = QuasiPolynomial::sine(1.0, 1.0);
    assert_close(crossing(&late, Direction::Falling, 1e300), PI);
}

#[test]
fn inputs_out_of_range_are_errors_and_no_wrong_answers() {
    for broken in [
        QuasiPolynomial::exponential(1.0, f64::INFINITY),
        QuasiPolynomial::sine(f64::NAN, 1.0),
        QuasiPolynomial::sine(1.0, f64::NAN),
        QuasiPolynomial::polynomial(&[1e300, -1e300]) * constant(1e300),
    ] {
        let found = broken.first_crossing(Direction::Either, 1.0);
        assert!(matches!(found, Err(Error::NotFinite { .. })), "{found:?}");
    }
    for horizon in [f64::NAN, -1.0, f64::INFINITY] {
        let found = QuasiPolynomial::sine(1.0, 1.0).first_crossing(Direction::Either, horizon);
        assert!(matches!(found, Err(Error::BadLimit { .. })), "{found:?}");
    }
    // The square of the time overflows, the zero does not.
    let parabola = QuasiPolynomial::polynomial(&[-1.0, 0.0, 1.0]);
    assert_eq!(crossing(&parabola, Direction::Rising, 1e300), 1.0);
}

/// sin 10⁹t − 2 + 10⁻⁹t has its first zero after 10¹⁸ radians. Each oscillation takes some intervals.
#[test]
fn a_budget_that_ends_is_an_error_with_the_budget_and_the_remedy() {
    let function = QuasiPolynomial::sine(1.0, 1e9) + QuasiPolynomial::polynomial(&[-2.0, 1e-9]);
    let error = function.first_crossing_within(Direction::Either, 3e9, 1000).unwrap_err();
    let Error::IntervalBudget { time, intervals: 1000, .. } = error else { panic!("{error:?}") };
    assert!(time > 0.0 && time < 1e9);
    let text = error.to_string();
    assert!(text.contains("1000 intervals") && text.contains("larger budget"), "{text}");
}

/// After 10¹⁷ radians rounding hides the phase. The search says so.
#[test]
fn a_phase_that_rounding_hides_is_undecided() {
    let function = QuasiPolynomial::sine(1.0, 1e17) + constant(1.0);
    let found = function.first_crossing_within(Direction::Falling, 1.0, 1_000_000);
    assert!(!matches!(found, Ok(FirstCrossing::At { .. } | FirstCrossing::Never)), "{found:?}");
}

/// The derivatives of a product have rounded coefficients, whose errors count: (t − 1)³ is flat around 1, whatever the
/// rounding of its factors is.
#[test]
fn the_rounding_of_coefficients_counts() {
    let third = 1.0 / 3.0;
    let factor = QuasiPolynomial::polynomial(&[-third, 1.0]);
    let cube = factor.clone() * factor.clone() * factor;
    let time = crossing(&cube, Direction::Rising, 3.0);
    assert!((time - third).abs() < 1e-4, "{time}");
    // The same with an even order is a touch, by rounding.
    let factor = QuasiPolynomial::sine(1.0, 1.0) - constant(third.sin());
    let found = (factor.clone() * factor).first_crossing(Direction::Either, 2.0).unwrap();
    let FirstCrossing::Touch { time, .. } = found else { panic!("{found:?}") };
    assert!((time - third).abs() < 1e-6, "{time}");
}

#[test]
fn a_function_whose_derivatives_overflow_is_an_error_with_a_remedy() {
    // e^{700 t} = 1e300: the derivatives of 1 − 1e300 e^{−700 t} exceed the largest double.
    let large = QuasiPolynomial::exponential(1.0, 700.0) + QuasiPolynomial::polynomial(&[-1e300]);
    let error = large.first_crossing(Direction::Rising, 10.0).unwrap_err();
    assert!(matches!(error, Error::DerivativeOverflows { .. }), "{error}");
    // The remedy.
    let small = QuasiPolynomial::exponential(1e-300, 700.0) + QuasiPolynomial::polynomial(&[-1.0]);
    let found = small.first_crossing(Direction::Rising, 10.0).unwrap();
    let FirstCrossing::At { time, rising: true } = found else { panic!("{found:?}") };
    assert!((time - 300.0 * std::f64::consts::LN_10 / 700.0).abs() < 1e-15, "{time}");
}
