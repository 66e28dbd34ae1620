//! The measured bounds as text: all of them for the terminal and as CSV, and a table of `docs/accuracy.md`.

use super::measured::Measured;
use crate::error::Error;
use crate::text::markdown_table;
use journal_figures::{DataFile, csv_text};
use std::fmt::Write;

/// A ratio with two digits.
fn ratio(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        v if !(0.01..1e3).contains(&v) => format!("{v:.0e}"),
        v => format!("{v:.2}"),
    }
}

/// One line for each bound and class.
pub(crate) fn lines(measured: &[Measured]) -> String {
    let width = |of: fn(&Measured) -> &str| {
        measured.iter().map(|m| of(m).chars().count()).max().unwrap_or(0)
    };
    let (bounds, classes) = (width(|m| m.bound), width(|m| m.class));
    let mut out = format!(
        "{:bounds$}  {:classes$}  {:>11}  {:>6}  {:>7}  at\n",
        "actual error / bound", "class", "comparisons", "median", "largest"
    );
    for m in measured {
        let (median, largest) = (ratio(m.median), ratio(m.largest));
        let Measured { bound, class, count, at, .. } = m;
        let _ = writeln!(
            out,
            "{bound:bounds$}  {class:classes$}  {count:>11}  {median:>6}  {largest:>7}  {at}"
        );
    }
    out
}

/// One line for each bound and class.
pub(crate) fn csv(measured: &[Measured]) -> Result<DataFile, Error> {
    let header = ["bound", "statement", "class", "comparisons", "median", "largest", "at"];
    let rows = measured.iter().map(|m| {
        vec![
            m.bound.to_owned(),
            m.statement.to_owned(),
            m.class.to_owned(),
            m.count.to_string(),
            format!("{:.2e}", m.median),
            format!("{:.3e}", m.largest),
            m.at.clone(),
        ]
    });
    Ok(csv_text("bounds.csv", &header, rows)?)
}

/// One line for each bound, over all classes: the class with the largest ratio.
pub(crate) fn markdown(measured: &[Measured]) -> String {
    let mut bounds: Vec<&str> = Vec::new();
    for m in measured {
        if !bounds.contains(&m.bound) {
            bounds.push(m.bound);
        }
    }
    let row = |bound: &str| {
        let classes = || measured.iter().filter(|m| m.bound == bound);
        // The first class with the largest ratio.
        let worst = classes().reduce(|a, b| if b.largest > a.largest { b } else { a });
        let worst = worst?;
        let count: u64 = classes().map(|m| m.count).sum();
        let medians = || classes().filter(|m| m.count > 0).map(|m| m.median);
        let low = medians().fold(f64::INFINITY, f64::min);
        let high = medians().fold(0.0, f64::max);
        let median =
            if low >= high { ratio(high) } else { format!("{} … {}", ratio(low), ratio(high)) };
        let Measured { statement, class, at, .. } = worst;
        let largest = ratio(worst.largest);
        // A stroke is the border of a cell.
        let bound = bound.replace('|', "\\|");
        let (class, at) = (class.replace('|', "\\|").replace('*', "\\*"), at.replace('|', "\\|"));
        Some(format!("{bound} | {statement} | {count} | {median} | {largest} | {class} | {at}"))
    };
    let columns =
        "bound | derived in | comparisons: | median: | largest: | class of the largest | at";
    markdown_table(columns, bounds.into_iter().filter_map(row))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planted(class: &'static str, median: f64, largest: f64) -> Measured {
        let at = format!("in {class}");
        Measured { bound: "b", statement: "section 0", class, count: 10, median, largest, at }
    }

    #[test]
    fn the_table_has_the_worst_class_of_each_bound() {
        let all =
            [planted("one", 1e-3, 0.2), planted("two*", 0.02, 0.75), planted("three", 0.0, 0.0)];
        let text = markdown(&all);
        assert!(
            text.contains("| b | section 0 | 30 | 0 … 0.02 | 0.75 | two\\* | in two* |"),
            "{text}"
        );
        assert_eq!(lines(&all).lines().count(), 4);
        let csv = String::from_utf8(csv(&all).unwrap().bytes).unwrap();
        assert!(csv.contains("b,section 0,two*,10,2.00e-2,7.500e-1,in two*"), "{csv}");
    }
}
