//! Every number that the program prints has a bound on its error, and the bound holds.

use super::common::call;
use serde_json::{Map, Value};

type Row = Map<String, Value>;

/// The rows of a table of a call.
fn rows(arguments: &[&str], table: &str) -> Vec<Row> {
    let output = call(&[arguments, &["--json"]].concat(), b"");
    assert_eq!(output.code, 0, "{arguments:?} {}", output.messages);
    let all: Value = serde_json::from_str(&output.output).unwrap();
    let rows = all[table].as_array().unwrap_or_else(|| panic!("{table} {all}"));
    rows.iter().map(|row| row.as_object().unwrap().clone()).collect()
}

/// Numbers that were given, and numbers that are bounds themselves.
const WITHOUT: [(&str, &str); 11] = [
    ("hops", "speed"),
    ("landings", "speed"),
    ("fates", "speed"),
    ("curve", "speed"),
    ("fractions", "fraction_lower"),
    ("fractions", "fraction_upper"),
    ("fractions", "length_lower"),
    ("fractions", "length_upper"),
    ("intervals", "left"),
    ("intervals", "right"),
    ("search", "wrong_probes"),
];

/// Numbers whose error has another name.
const ELSEWHERE: [(&str, &str, &str); 5] = [
    ("hops", "next_speed", "next_error"),
    ("landings", "stretch_excess", "excess_error"),
    ("orbit", "speed", "error"),
    ("fixed_points", "trap_length", "trap_error"),
    ("edge", "rest", "error"),
];

#[test]
fn every_computed_number_has_a_bound_on_its_error() {
    let folder = std::env::temp_dir().join(format!("hopper_errors_{}", std::process::id()));
    let folder = folder.to_str().unwrap();
    let sizes = ["--pixels", "4", "4", "-M", "0.2", "0.3"];
    let (hop, orbit) = (["hop", "7", "2", "-M", "0.9"], ["orbit", "5.5", "-M", "0.2"]);
    let map = ["map", "-M", "0.2", "--points", "3"];
    let intervals = ["intervals", "-M", "0.2", "--to", "2", "--undecided", "1e-2"];
    let units = ["units", "--upper", "80g", "--lower", "16g", "--stiffness", "120N/m", "1m/s"];
    let mut calls: Vec<Vec<&str>> =
        vec![hop.into(), orbit.into(), map.into(), intervals.into(), units.into()];
    let places: Vec<String> = (0..4).map(|k| format!("{folder}/{k}")).collect();
    let layers: [&[&str]; 3] = [&["--layer", "label", "hops"], &["--coverage"], &["--about", "1"]];
    for (place, layer) in places.iter().zip(layers) {
        calls.push([&["basins", "--out", place.as_str()][..], &sizes, layer].concat());
    }
    let zoom = ["--zoom", "0.12", "11.92", "--frames", "2", "--pixels", "4", "4"];
    calls.push([&["basins", "--out", places[3].as_str()][..], &zoom].concat());
    let mut numbers = 0;
    for arguments in calls {
        let output = call(&[&arguments[..], &["--json"]].concat(), b"");
        assert_eq!(output.code, 0, "{arguments:?} {}", output.messages);
        let tables: Value = serde_json::from_str(&output.output).unwrap();
        for (table, rows) in tables.as_object().unwrap() {
            for row in rows.as_array().unwrap() {
                numbers += check_row(table, row.as_object().unwrap());
            }
        }
    }
    assert!(numbers > 120, "{numbers}");
    std::fs::remove_dir_all(folder).unwrap();
}

/// The number of computed numbers of a row. Whole numbers are counts.
fn check_row(table: &str, row: &Row) -> usize {
    let is_error = |name: &str| name == "error" || name.ends_with("_error");
    let computed = |(name, value): &(&String, &Value)| {
        value.is_f64() && !is_error(name) && !WITHOUT.contains(&(table, name.as_str()))
    };
    let mut count = 0;
    for (name, value) in row.iter().filter(computed) {
        let other = ELSEWHERE.iter().find(|(own, column, _)| *own == table && column == name);
        let column = other.map_or(format!("{name}_error"), |(_, _, error)| (*error).to_owned());
        let error = row.get(&column).unwrap_or_else(|| panic!("{table}: {name} has no {column}"));
        let error =
            error.as_f64().unwrap_or_else(|| panic!("{table}: {column} of {value} is {error}"));
        assert!(error >= 0.0, "{table}: {column}");
        count += 1;
    }
    count
}

/// The bounds hold against references of 40 digits.
#[test]
fn errors_of_hops_hold_against_references() {
    let references = include_str!("../../passive-hopper/tests/data/hops_window.jsonl");
    for line in references.lines().step_by(40) {
        let reference: Value = serde_json::from_str(line).unwrap();
        let [m, alpha] = ["mass_ratio", "alpha"].map(|name| reference[name].to_string());
        let row = &rows(&["hop", &alpha, "-M", &m], "hops")[0];
        let pairs = [
            ("next_speed", "next_error", "alpha_next"),
            ("slope", "slope_error", "dalpha_next_dalpha"),
            ("mass_ratio_slope", "mass_ratio_slope_error", "dalpha_next_dM"),
        ];
        for (name, error, exact) in pairs {
            let Some(exact) = reference[exact].as_str() else { continue };
            let exact: f64 = exact.parse().unwrap();
            let off = (row[name].as_f64().unwrap() - exact).abs();
            let error = row[error].as_f64().unwrap();
            // The reference has half an ulp as an f64, and a slope 17 digits.
            assert!(off <= error + 1.01 * f64::EPSILON * exact.abs(), "{name} {row:?} {line}");
            assert!(error < 1e-12 * exact.abs().max(1.0), "{name} {row:?}");
        }
    }
}

/// The digits of text are those that the error leaves.
#[test]
fn text_shows_certain_digits() {
    let text = call(&["orbit", "5.5", "-M", "0.2", "--hops", "1"], b"").output;
    // The image has the digits 3.783365713345068….
    assert!(text.contains("3.7833657133"), "{text}");
    let shown = text.split_whitespace().find(|word| word.starts_with("3.78")).unwrap();
    assert!("3.783365713345068".starts_with(&shown[..shown.len() - 1]), "{shown}");
}
