//! β, λ, Δ against 40 digits, and the expansions against the map.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use hopper_asymptotics::{Coefficients, Form};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

/// Computed with 50 to 130 digits (mpmath), independently of this project.
const REFERENCE: &str = include_str!("data/local_basin.json");

/// A handful of roundings: cube root, mu, three products.
const ROUNDING: f64 = 2e-15;

#[test]
fn coefficients_agree_with_forty_digits() {
    let rows: Vec<serde_json::Value> = serde_json::from_str(REFERENCE).unwrap();
    assert_eq!(rows.len(), 110);
    for row in &rows {
        let number = |key: &str| row[key].as_str().unwrap().parse::<f64>().unwrap();
        let n = row["n"].as_u64().unwrap();
        let ratio = MassRatio::new(number("mass_ratio")).unwrap();
        let printed = Coefficients::new(n, ratio, Form::Printed).unwrap();
        let corrected = Coefficients::new(n, ratio, Form::Corrected).unwrap();
        assert_relative_eq!(corrected.beta, number("beta"), max_relative = ROUNDING);
        assert_relative_eq!(printed.lambda, number("lambda_printed"), max_relative = ROUNDING);
        assert_relative_eq!(corrected.lambda, number("lambda_corrected"), max_relative = ROUNDING);
        assert_relative_eq!(
            printed.delta(),
            number("delta_printed"),
            max_relative = 3.0 * ROUNDING
        );
        assert_relative_eq!(
            corrected.delta(),
            number("delta_corrected"),
            max_relative = 3.0 * ROUNDING
        );
    }
}

/// (δ − δ')/(λ |δ|^{4/3}) → 1 on the right and 10 on the left, with relative error
/// (β/α*)|δ|^{1/3}; the printed λ gives ¾ and 7.5.
#[test]
fn leading_terms_have_the_stated_error() {
    for n in [1, 2, 5] {
        for m in [0.1, 0.5, 1.0, 3.0] {
            let ratio = MassRatio::new(m).unwrap();
            let map = LiftOffMap::new(ratio);
            let local = Coefficients::new(n, ratio, Form::Corrected).unwrap();
            let star = alpha_star(n);
            for exponent in 5..8 {
                for side in [1.0, -1.0] {
                    let alpha = star.high + side * 10f64.powi(-exponent);
                    let delta = star.offset_of(alpha);
                    let loss = map.hop(alpha).unwrap().loss.unwrap();
                    let leading = delta - local.displacement(delta);
                    let next = local.beta / local.alpha_star * delta.abs().cbrt();
                    let error = (loss - leading) / leading;
                    // Beyond it come terms in δ^{2/3}, with coefficients up to 6.6 (theory: c).
                    let beyond = (error - side * next).abs();
                    let bound = 8.0 * delta.abs().powf(2.0 / 3.0) + 1e-7;
                    assert!(beyond < bound, "n={n} M={m} δ={delta:e}: {error} {next}");
                }
            }
        }
    }
}
