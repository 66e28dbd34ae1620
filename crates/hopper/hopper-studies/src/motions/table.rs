//! The motions as a table of times at equal errors, and as CSV.

use super::measured::Point;
use crate::error::Error;
use crate::text::{digit, duration, markdown_table};
use journal_figures::{DataFile, csv_text};

/// The errors at which times are compared.
const ERRORS: [f64; 5] = [1e-6, 1e-8, 1e-10, 1e-12, 1e-14];

/// A table, scene by scene: the least time of a start at which a program's error is no larger, over its tolerances.
/// Behind it the least error at all, with its time.
pub(crate) fn markdown(points: &[Point]) -> String {
    let mut rows = Vec::new();
    let mut scenes: Vec<&str> = points.iter().map(|point| point.scene.as_str()).collect();
    dedup(&mut scenes);
    for scene in scenes {
        let own: Vec<&Point> = points.iter().filter(|point| point.scene == scene).collect();
        let mut programs: Vec<&str> = own.iter().map(|point| point.program.as_str()).collect();
        dedup(&mut programs);
        for (at, program) in programs.into_iter().enumerate() {
            let own = || own.iter().filter(|point| point.program == program);
            let cell = |error: f64| {
                let right = own().filter(|point| point.error <= error);
                let least = right.map(|point| point.seconds).min_by(f64::total_cmp);
                least.map_or("–".to_owned(), duration)
            };
            let best = own()
                .min_by(|a, b| a.error.total_cmp(&b.error).then(a.seconds.total_cmp(&b.seconds)));
            let best = best.map_or("–".to_owned(), |best| {
                format!("{} in {}", digit(best.error), duration(best.seconds))
            });
            let cells = ERRORS.map(cell).join(" | ");
            let name = if at == 0 { scene } else { "" };
            rows.push(format!("{name} | {program} | {cells} | {best}"));
        }
    }
    markdown_table(
        "motion | program | 1e-6: | 1e-8: | 1e-10: | 1e-12: | 1e-14: | least error:",
        rows,
    )
}

/// Each once, in the order in which they occur first.
fn dedup(names: &mut Vec<&str>) {
    let mut seen = Vec::new();
    names.retain(|name| {
        let is_new = !seen.contains(name);
        seen.push(*name);
        is_new
    });
}

/// One line for each motion, program and tolerance.
pub(crate) fn csv(points: &[Point]) -> Result<DataFile, Error> {
    let header = ["motion", "program", "tolerance", "error", "seconds_per_start"];
    let rows = points.iter().map(|point| {
        vec![
            point.scene.clone(),
            point.program.clone(),
            format!("{:e}", point.tolerance),
            format!("{:e}", point.error),
            format!("{:e}", point.seconds),
        ]
    });
    Ok(csv_text("motions.csv", &header, rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_time_with_an_error_no_larger_counts() {
        let point = |tolerance: f64, error: f64, seconds: f64| Point {
            scene: "m".into(),
            program: "p".into(),
            tolerance,
            error,
            seconds,
        };
        let points = [point(1e-6, 1e-5, 1e-6), point(1e-9, 1e-9, 3e-6), point(1e-12, 2e-11, 2e-6)];
        let text = markdown(&points);
        let row = text.lines().nth(2).unwrap();
        assert_eq!(row, "| m | p | 2.0 µs | 2.0 µs | 2.0 µs | – | – | 2e-11 in 2.0 µs |");
        let bytes = csv(&points).unwrap().bytes;
        assert_eq!(String::from_utf8(bytes).unwrap().lines().count(), 4);
    }
}
