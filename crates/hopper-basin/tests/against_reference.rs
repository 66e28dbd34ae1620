//! Traps, crises, fates and the paper's measures against independent values.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use hopper_basin::{Fates, HopperFate, Trap, TrapEdge, crisis, grounding, shares};
use passive_hopper::MassRatio;
use serde_json::Value;

fn rows(text: &str) -> Vec<Value> {
    serde_json::from_str(text).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// Computed with 50 to 130 digits (mpmath). Δ is a difference near α*, computed to an absolute
/// 1e-15 and a few ulps; the largest α here is 36, the smallest Δ 4e-5.
#[test]
fn delta_agrees_with_forty_digits_on_the_contact_intervals() {
    let mut compared = 0;
    for row in rows(include_str!("data/local_basin.json")) {
        let n = row["n"].as_u64().unwrap();
        let ratio = MassRatio::new(number(&row["mass_ratio"])).unwrap();
        let trap = Trap::new(n, ratio).unwrap();
        if row["edge"].as_str().unwrap().starts_with("contact") {
            assert_eq!(trap.edge, TrapEdge::Crossing);
            assert_relative_eq!(
                trap.delta,
                number(&row["delta_exact"]),
                max_relative = 1e-13,
                epsilon = 2e-15
            );
            compared += 1;
        } else {
            assert_eq!(trap.edge, TrapEdge::ContactEnd, "{row}");
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn crises_agree_with_thirty_digits() {
    for row in rows(include_str!("data/critical.json")) {
        let found = crisis(row["n"].as_u64().unwrap()).unwrap();
        assert_relative_eq!(found.mu, number(&row["mu_c"]), max_relative = 1e-14);
        assert_relative_eq!(found.mass_ratio, number(&row["M_c"]), max_relative = 1e-14);
        assert_relative_eq!(found.alpha, number(&row["alpha_touch"]), max_relative = 1e-9);
    }
}

#[test]
fn grounding_opens_where_theory_says() {
    let known = [
        (0, 0.327_498_113_640_356_01),
        (1, 0.626_355_616_933_350_12),
        (2, 0.737_064_974_899_340_31),
        (6, 0.878_977_498_741_877_11),
    ];
    for (n, mass_ratio) in known {
        assert_relative_eq!(grounding(n).unwrap().mass_ratio, mass_ratio, max_relative = 1e-13);
    }
}

#[test]
fn every_reference_fate() {
    let mut seen = [0; 3];
    for line in include_str!("data/fates.jsonl").lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let ratio = MassRatio::new(row["mass_ratio"].as_f64().unwrap()).unwrap();
        let fate = Fates::new(ratio).unwrap().fate(row["alpha"].as_f64().unwrap()).unwrap();
        let (expected, kind) = match row["fate"].as_str().unwrap() {
            "incessant" => (HopperFate::Incessant { n: row["n"].as_u64().unwrap() }, 0),
            "decaying" => (HopperFate::Decaying, 1),
            "grounded" => (HopperFate::Grounded, 2),
            other => panic!("{other}"),
        };
        assert_eq!(fate, expected, "{line}");
        seen[kind] += 1;
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

/// Sec. VI B: 1 and 0.953 at M = 0.1, 0.037 at M = 0.2, here with a tenth of the paper's points;
/// the sampling error of 5000 points is below 0.004.
#[test]
fn the_papers_measures() {
    let low = shares(MassRatio::new(0.1).unwrap(), 1, 6, 1000).unwrap();
    assert_eq!(low.incessant(), 1.0);
    assert!((low.of(1) - 0.953).abs() < 0.004);
    let high = shares(MassRatio::new(0.2).unwrap(), 1, 6, 1000).unwrap();
    assert!((high.incessant() - 0.037).abs() < 0.004);
}
