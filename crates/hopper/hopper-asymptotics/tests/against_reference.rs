//! β, λ and Δ against reference values of 40 digits, and the expansions against the exact map.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use hopper_asymptotics::{
    Coefficients, Decay, Error, Form, LeftExpansion, RIGHT_RANGE, RightExpansion,
    SMALL_ALPHA_RANGE, fixed_point_series, small_hop_loss, trap_length_series,
};
use hopper_reference::{Row, rows};
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio, alpha_star};

/// Computed with 50 to 130 digits (mpmath), independently of this project.
const REFERENCE: &str = include_str!("data/local_basin.json");

/// Nine ulps: the roundings of the cube root, of μ and of some five products and quotients.
const ROUNDING: f64 = 2e-15;

/// Relative error of `Hop::loss` for small hops, measured (docs/accuracy.md). The unit tests of `small_alpha.rs`
/// compare with forty digits.
const HOP_LOSS: f64 = 2e-15;

#[test]
fn coefficients_agree_with_forty_digits() {
    let rows: Vec<Row> = rows(REFERENCE).collect();
    assert_eq!(rows.len(), 110);
    for row in &rows {
        let number = |key: &str| row.result(key).unwrap();
        let n = row.integer("n");
        let ratio = MassRatio::new(number("mass_ratio")).unwrap();
        let printed = Coefficients::new(n, ratio, Form::Printed).unwrap();
        let corrected = Coefficients::new(n, ratio, Form::Corrected).unwrap();
        assert_relative_eq!(corrected.beta, number("beta"), max_relative = ROUNDING);
        assert_relative_eq!(printed.lambda, number("lambda_printed"), max_relative = ROUNDING);
        assert_relative_eq!(corrected.lambda, number("lambda_corrected"), max_relative = ROUNDING);
        assert_relative_eq!(
            printed.trap_length(),
            number("delta_printed"),
            max_relative = 3.0 * ROUNDING
        );
        assert_relative_eq!(
            corrected.trap_length(),
            number("delta_corrected"),
            max_relative = 3.0 * ROUNDING
        );
    }
}

/// (δ − δ')/(λ |δ|^{4/3}) → 1 on the right and 10 on the left, with relative error
/// (β/α*)|δ|^{1/3}.
#[test]
fn leading_terms_have_the_stated_error() {
    for n in [1, 2, 5] {
        for m in [0.1, 0.5, 1.0, 3.0] {
            let ratio = MassRatio::new(m).unwrap();
            let map = LiftOffMap::new(ratio);
            let local = Coefficients::new(n, ratio, Form::Corrected).unwrap();
            let star = FixedPointSpeed::new(n);
            for exponent in 5..8 {
                for side in [1.0, -1.0] {
                    let alpha = star.value() + side * 10f64.powi(-exponent);
                    let delta = star.offset_of(alpha);
                    let loss = map.hop(alpha).unwrap().loss.unwrap();
                    let leading = delta - local.displacement(delta);
                    let next = local.beta / local.alpha_star * delta.abs().cbrt();
                    let error = (loss - leading) / leading;
                    // The terms after it are in δ^{2/3}, with coefficients up to 6.6.
                    let beyond = (error - side * next).abs();
                    let bound = 8.0 * delta.abs().powf(2.0 / 3.0) + 1e-7;
                    assert!(beyond < bound, "n={n} M={m} δ={delta:e}: {error} {next}");
                }
            }
        }
    }
}

const RATIOS: [f64; 7] = [1e-3, 0.05, 0.3, 1.0, 3.0, 20.0, 1e3];
const INDICES: [u64; 6] = [1, 2, 3, 10, 30, 100];

/// Every value lies within its stated error of the exact map, over the whole range.
#[test]
fn expansions_lie_within_their_errors() {
    for n in INDICES {
        for m in RATIOS {
            let ratio = MassRatio::new(m).unwrap();
            let map = LiftOffMap::new(ratio);
            let right = RightExpansion::new(n, ratio).unwrap();
            let left = LeftExpansion::new(n, ratio).unwrap();
            for k in 0..60 {
                let part = 10f64.powf(-0.2 * f64::from(k));
                let delta = RIGHT_RANGE * part;
                if let Some(exact) = map.hop_near_fixed_point(n, delta).unwrap().next {
                    let series = right.displacement(delta).unwrap();
                    assert!(
                        (series.value - exact).abs() <= series.error,
                        "n={n} M={m} δ={delta:e}: {series:?} {exact}"
                    );
                }
                let delta = -left.range() * part;
                let exact = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
                let series = left.displacement(delta).unwrap();
                assert!(
                    (series.value - exact).abs() <= series.error,
                    "n={n} M={m} δ={delta:e}: {series:?} {exact}"
                );
            }
        }
    }
}

/// The remainders of both sides fall with the stated exponents.
#[test]
fn remainders_of_both_sides_have_the_stated_exponents() {
    for n in [1, 2] {
        let ratio = MassRatio::new(0.5).unwrap();
        let map = LiftOffMap::new(ratio);
        let (right, left) =
            (RightExpansion::new(n, ratio).unwrap(), LeftExpansion::new(n, ratio).unwrap());
        let right_rest = |d: f64| {
            right.displacement(d).unwrap().value
                - map.hop_near_fixed_point(n, d).unwrap().next.unwrap()
        };
        let left_rest = |d: f64| {
            left.displacement(d).unwrap().value
                - map.hop_near_fixed_point(n, d).unwrap().next.unwrap()
        };
        let slope = (right_rest(1e-3) / right_rest(1e-4)).abs().log10();
        assert!((slope - RightExpansion::NEGLECTED_EXPONENT).abs() < 0.06, "n={n} right: {slope}");
        let slope = (left_rest(-1e-7) / left_rest(-1e-9)).abs().log10() / 2.0;
        assert!((slope - LeftExpansion::NEGLECTED_EXPONENT).abs() < 0.06, "n={n} left: {slope}");
    }
}

/// Exact Δ of 40 digits, exact α*_n and exact small hops lie within the stated errors.
#[test]
fn trap_lengths_fixed_points_and_small_hops_lie_within_their_errors() {
    let rows: Vec<Row> = rows(REFERENCE).collect();
    let mut compared = 0;
    for row in &rows {
        let number = |key: &str| row.result(key).unwrap();
        let ratio = MassRatio::new(number("mass_ratio")).unwrap();
        let Ok(length) = trap_length_series(row.integer("n"), ratio) else { continue };
        assert!((length.value - number("delta_exact")).abs() <= length.error, "{row} {length:?}");
        compared += 1;
    }
    assert!(compared > 50, "{compared}");
    for n in [1, 2, 5, 20, 1000, 1_000_000] {
        let series = fixed_point_series(n).unwrap();
        assert!((series.value - alpha_star(n)).abs() <= series.error, "{n} {series:?}");
    }
    for m in RATIOS {
        let map = LiftOffMap::new(MassRatio::new(m).unwrap());
        for k in 0..40 {
            let alpha = SMALL_ALPHA_RANGE * 10f64.powf(-0.25 * f64::from(k));
            let loss = small_hop_loss(map.mass_ratio(), alpha).unwrap();
            let exact = map.hop(alpha).unwrap().loss.unwrap();
            assert!(
                (loss.value - exact).abs() <= loss.error + HOP_LOSS * exact,
                "M={m} α={alpha}: {loss:?} {exact:e}"
            );
        }
    }
    assert!(small_hop_loss(MassRatio::ONE, 0.5).is_err() && fixed_point_series(0).is_err());
    assert!(trap_length_series(1, MassRatio::new(0.1).unwrap()).is_err());
}

#[test]
fn input_outside_the_range_is_an_error() {
    let right = RightExpansion::new(1, MassRatio::ONE).unwrap();
    let left = LeftExpansion::new(1, MassRatio::ONE).unwrap();
    for delta in [-1e-9, 0.2, f64::NAN, f64::INFINITY] {
        assert!(matches!(right.displacement(delta), Err(Error::OutsideRange { .. })));
    }
    for delta in [1e-9, -0.2, f64::NAN] {
        assert!(matches!(left.displacement(delta), Err(Error::OutsideRange { .. })));
    }
    assert!(
        RightExpansion::new(0, MassRatio::ONE).is_err()
            && LeftExpansion::new(0, MassRatio::ONE).is_err()
    );
}

/// The number of hops and the offset after them agree with the exact map within their errors.
#[test]
fn the_law_of_the_approach_lies_within_its_errors() {
    for n in INDICES {
        for m in [1e-3, 0.01, 0.2, 1.0, 5.0, 1e3] {
            let ratio = MassRatio::new(m).unwrap();
            let (map, law) = (LiftOffMap::new(ratio), Decay::new(n, ratio).unwrap());
            for part in [1.0, 1e-2, 1e-6] {
                let start = part * law.range();
                let mut delta = start;
                for k in 1..=1000u32 {
                    delta = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
                    if ![1, 10, 100, 1000].contains(&k) {
                        continue;
                    }
                    let hops = law.hops(start, delta).unwrap();
                    let off = (hops.value - f64::from(k)).abs();
                    assert!(off <= hops.error, "n={n} M={m} δ₀={start:e} k={k}: {hops:?}");
                    let after = law.offset_after(start, f64::from(k)).unwrap();
                    assert!(
                        (after.value - delta).abs() <= after.error,
                        "n={n} M={m}: {after:?} {delta:e}"
                    );
                }
            }
            assert!(law.hops(2.0 * law.range(), 1e-9).is_err());
        }
    }
    let law = Decay::new(1, MassRatio::ONE).unwrap();
    for (start, end) in [(1e-6, 0.0), (1e-6, 1e-5), (f64::NAN, 1e-9), (-1e-6, 1e-9)] {
        assert!(law.hops(start, end).is_err());
    }
    assert!(
        law.offset_after(1e-6, f64::INFINITY).is_err() && law.offset_after(1e-6, -1.0).is_err()
    );
}

/// u_k − λk/3 − L ln k tends to the C that the law gives for the start.
#[test]
fn the_constant_of_the_law_is_the_limit() {
    let law = Decay::new(1, MassRatio::ONE).unwrap();
    let constant = law.constant(1e-6).unwrap();
    let rest = |hops: f64| {
        let u = 1.0 / law.offset_after(1e-6, hops).unwrap().value.cbrt();
        u - law.rate * hops - law.logarithm * hops.ln()
    };
    assert!((rest(1e12) - constant.value).abs() < 1e-3 + constant.error);
    assert!((rest(1e8) - constant.value).abs() > (rest(1e10) - constant.value).abs());
}

/// The remainders of the other expansions fall with the stated exponents.
#[test]
fn remainders_of_the_other_expansions_have_the_stated_exponents() {
    // Small hops: the remainder of the loss falls like α⁹.
    let ratio = MassRatio::new(0.5).unwrap();
    let rest = |alpha: f64| {
        let exact = LiftOffMap::new(ratio).hop(alpha).unwrap().loss.unwrap();
        (small_hop_loss(ratio, alpha).unwrap().value - exact).abs()
    };
    let slope = (rest(0.1) / rest(0.02)).ln() / 5f64.ln();
    let stated = small_hop_loss(ratio, 0.1).unwrap().neglected_exponent;
    assert!((slope - stated).abs() < 0.1, "{slope}");
    // Fixed points: in q.
    let rest = |n: u64| (fixed_point_series(n).unwrap().value - alpha_star(n)).abs();
    let slope = (rest(2) / rest(1)).ln() / (2.5f64 / 1.5).ln();
    assert!((slope - fixed_point_series(1).unwrap().neglected_exponent).abs() < 1.0, "{slope}");
    // Numbers of hops: in the start's offset. The orbit is so long that its end has no effect.
    let law = Decay::new(1, MassRatio::ONE).unwrap();
    let map = LiftOffMap::new(MassRatio::ONE);
    let rest = |start: f64| {
        let mut delta = start;
        for _ in 0..200_000 {
            delta = map.hop_near_fixed_point(1, delta).unwrap().next.unwrap();
        }
        (law.hops(start, delta).unwrap().value - 200_000.0).abs()
    };
    let slope = (rest(1e-5) / rest(1e-7)).ln() / 100f64.ln();
    assert!((slope - Decay::NEGLECTED_EXPONENT).abs() < 0.06, "{slope}");
    // Length of the trap: in λ, at one fixed point.
    let rows: Vec<Row> = rows(REFERENCE).collect();
    let point = |m: &str| {
        let row =
            rows.iter().find(|row| row.integer("n") == 10 && row.text("mass_ratio") == m).unwrap();
        let exact = row.result("delta_exact").unwrap();
        let ratio = MassRatio::new(m.parse().unwrap()).unwrap();
        let found = trap_length_series(10, ratio).unwrap();
        let lambda = Coefficients::new(10, ratio, Form::Corrected).unwrap().lambda;
        (lambda, (found.value - exact).abs(), found.neglected_exponent)
    };
    let (first, last) = (point("0.1"), point("0.5"));
    let slope = (last.1 / first.1).ln() / (last.0 / first.0).ln();
    // λ is only 10 to 25, so that the terms after the first neglected one change the slope.
    assert!((slope - first.2).abs() < 0.8, "{slope}");
}
