//! Values, derivatives and series of every function agree with thirty digits from mpmath
//! (xtask/generators/functions.py).

use equations::{Formulas, Jet, JetSeries, Names, Series};
use interval_arithmetic::Enclosure;
use serde_json::Value;

/// The formula of a record, of x and y.
fn formula(function: &str) -> String {
    match function {
        "cube" => "x^3".to_owned(),
        "inverse_square" => "x^-2".to_owned(),
        "power" => "x^y".to_owned(),
        "quotient" => "x/y".to_owned(),
        "atan2" => "atan2(x, y)".to_owned(),
        text if text.contains(['^', '/']) => text.to_owned(),
        name => format!("{name}(x)"),
    }
}

/// A function along the motion from `start` with the rates of `field`, and its coefficients.
struct Record {
    what: String,
    field: Formulas,
    watched: Formulas,
    start: [f64; 2],
    rates: [f64; 2],
    known: Vec<f64>,
}

fn records() -> Vec<Record> {
    let lines = include_str!("data/functions.jsonl").lines();
    let records = lines.map(|line| {
        let record: Value = serde_json::from_str(line).unwrap();
        let function = record["function"].as_str().unwrap();
        let names = Names::new(&["x", "y"], &[]).unwrap();
        let rates = if record["y"].is_null() { [1.0, 0.0] } else { [1.0, 0.5] };
        let field =
            Formulas::new(names.clone(), |t, _, _| rates.map(|rate| t.number(rate))).unwrap();
        let watched = Formulas::from_text(names, &[&formula(function)]).unwrap();
        let start = [record["x"].as_f64().unwrap(), record["y"].as_f64().unwrap_or(1.0)];
        let known = record["coefficients"].as_array().unwrap();
        let known = known.iter().map(|text| text.as_str().unwrap().parse().unwrap()).collect();
        let what = format!("{function} at {start:?}");
        Record { what, field, watched, start, rates, known }
    });
    records.collect()
}

#[test]
fn series_have_the_known_coefficients() {
    let mut functions = 0;
    for Record { what, field, watched, start, known, .. } in records() {
        let series = Series::new(&field, Some(&watched)).unwrap();
        let found = series.coefficients(0.0, &start, known.len() - 1).unwrap();
        // A coefficient may be 0, as those of the sine at 0. Its error is one of the others then.
        let size = |k: usize| known[k].abs() + known[k - 1].abs().min(1.0);
        for (k, (found, known)) in found.watched(0).iter().zip(&known).enumerate().skip(1) {
            assert!((found - known).abs() <= 1e-12 * size(k), "{what}, {k}: {found} {known}");
        }
        let [off, ulp] = [(found.watched(0)[0] - known[0]).abs(), f64::EPSILON * known[0].abs()];
        assert!(off <= 2.0 * ulp + 1e-323, "{what}: {} {}", found.watched(0)[0], known[0]);
        assert_eq!(found.watched(0)[0], watched.values(0.0, &start).unwrap()[0], "{what}");
        let [column_x, column_y] = start.map(|x| [x; 3]);
        let many = watched.columns(&[0.0], &[&column_x, &column_y]).unwrap();
        assert_eq!(many.values[0], [found.watched(0)[0]; 3], "{what}");
        functions += 1;
    }
    assert!(functions > 105);
}

#[test]
fn enclosures_of_values_and_coefficients_hold_the_known_ones() {
    for Record { what, field, watched, start, known, .. } in records() {
        let series = Series::new(&field, Some(&watched)).unwrap();
        let start = start.map(Enclosure::from);
        let found = series.coefficients(Enclosure::ZERO, &start, known.len() - 1).unwrap();
        for (found, known) in found.watched(0).iter().zip(&known) {
            assert!(found.contains(*known), "{what}: {found:?} {known}");
        }
        let width = found.watched(0)[0].width();
        assert!(width <= 16.0 * f64::EPSILON * known[0].abs() + 1e-322, "{what}: {width:e}");
    }
}

/// As the start moves along the field, coefficient k becomes Σ binom(k + j, j) c_{k+j} εʲ.
#[test]
fn derivatives_of_coefficients_are_the_known_ones() {
    for Record { what, field, watched, start, rates, known } in records() {
        let series = JetSeries::new(&field, Some(&watched)).unwrap();
        let start = [0, 1].map(|axis| Jet::<4>::moving(start[axis], rates[axis]));
        let found = series.coefficients(&start, known.len() - 4).unwrap();
        for (k, found) in found.watched(0).iter().enumerate() {
            let mut binomial = 1.0;
            for (j, found) in found.0.iter().enumerate() {
                let size = known[k + j].abs() + known[(k + j).max(1) - 1].abs().min(1.0);
                let off = (found - binomial * known[k + j]).abs();
                assert!(off <= 1e-12 * binomial * size, "{what}, {k}, {j}: {found}");
                binomial *= (k + j + 1) as f64 / (j + 1) as f64;
            }
        }
    }
}

/// The first three derivatives, by three derivatives of the formula.
#[test]
fn derivatives_are_the_known_ones() {
    for Record { what, watched, start, rates, known, .. } in records() {
        let mut formula = watched;
        for (k, factorial) in [(1, 1.0), (2, 2.0), (3, 6.0)] {
            formula = formula.derivative(&rates, &[]).unwrap();
            let found = formula.values(0.0, &start).unwrap()[0];
            let (known, before) = (factorial * known[k], factorial * known[k - 1]);
            let size = known.abs() + before.abs().min(1.0);
            assert!((found - known).abs() <= 1e-12 * size, "{what}, {k}: {found} {known}");
        }
    }
}
