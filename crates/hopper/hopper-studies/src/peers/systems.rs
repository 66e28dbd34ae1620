//! A system with events of a user, and a raster: by heyoka, from Python and in Rust, in one run.

use super::python::{Python, results};
use crate::error::Error;
use crate::repository::Progress;
use crate::text::markdown_table;
use basin_of_attraction::{Grid, Interval, columns_in_parallel};
use hopper_figures::{LAYERS, LayerColumns};
use hybrid_system::{Equations, EquationsModel, State};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// The end of the motions, and starts that are followed at once, as in the script.
const END: f64 = 400.0;
const STARTS: usize = 1000;
const WINDOW: (f64, f64) = (-1.0, 0.4);
/// Pixels a side of the raster.
const SIDE: usize = 512;
/// Runs, of which the least time counts, of one start, of all starts, and of the raster.
const REPEATS: [usize; 3] = [15, 3, 5];
/// The components of the last state agree to this: each program follows them to its own rounding, which eighty impacts have made larger. Here the
/// numbers are decimals, and doubles in Python.
const SAME: f64 = 1e-10;

/// What the script has measured: heyoka first, then ours.
#[derive(serde::Deserialize)]
struct Found {
    heyoka: String,
    one: [f64; 2],
    each: [f64; 2],
    raster: f64,
    end: [[f64; 2]; 2],
    events: [usize; 2],
}

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SystemTime {
    what: &'static str,
    heyoka: Option<f64>,
    python: f64,
    rust: f64,
}

/// The least times of all.
///
/// # Errors
/// [`Error::CheckFailed`] if a result from Python, or one of heyoka, is another one than in Rust.
pub(crate) fn system_times(
    python: &Python,
    folder: &Path,
    progress: &Progress,
) -> Result<(String, Vec<SystemTime>), Error> {
    let bar = progress.bar("systems", 2);
    let [seconds, labels] = ["systems.json", "labels.bin"].map(|name| folder.join(name));
    python.run(include_str!("systems.py"), &[&seconds, &labels])?;
    let found: Found = results(&seconds)?;
    bar.set(1);
    let model = oscillator()?;
    let run = || Ok::<_, Error>(model.start("motion", [0.0, 1.0], END)?.fate());
    let (one, fate) = least(REPEATS[0], run)?;
    let (many, _) = least(REPEATS[1], || Ok(fates(&model)))?;
    let (raster, numbers) = least(REPEATS[2], raster)?;
    let theirs =
        std::fs::read(&labels).map_err(|source| Error::File { path: labels.clone(), source })?;
    let same_end = |end: &[f64; 2]| (0..2).all(|axis| (end[axis] - fate.state[axis]).abs() <= SAME);
    let checks = [
        ("events", found.events == [fate.events; 2]),
        ("state of heyoka", same_end(&found.end[0])),
        ("state", same_end(&found.end[1])),
        ("raster", theirs == numbers),
    ];
    if let Some((what, _)) = checks.iter().find(|(_, same)| !same) {
        return Err(Error::CheckFailed(format!("another {what} from Python than in Rust")));
    }
    bar.finish();
    let line = |what, heyoka, python, rust| SystemTime { what, heyoka, python, rust };
    let rows = vec![
        line("impact oscillator, 83 impacts, one run", Some(found.one[0]), found.one[1], one),
        line(
            "the same, each of 1000 starts",
            Some(found.each[0]),
            found.each[1],
            many / STARTS as f64,
        ),
        line("basins of the hopper, 512² pixels", None, found.raster, raster),
    ];
    Ok((found.heyoka, rows))
}

/// The times as a table.
pub(crate) fn systems_markdown((heyoka, rows): &(String, Vec<SystemTime>)) -> String {
    let time = |seconds: f64| match seconds {
        ..1e-2 => format!("{:.0} µs", 1e6 * seconds),
        _ => format!("{:.1} ms", 1e3 * seconds),
    };
    let row = |SystemTime { what, heyoka, python, rust }: &SystemTime| {
        let (theirs, ratio) = match heyoka {
            Some(seconds) => (time(*seconds), format!("{:.2}", python / seconds)),
            None => ("–".to_owned(), "–".to_owned()),
        };
        format!(
            "{what} | {theirs} | {} | {} | {ratio} | {:.2}",
            time(*python),
            time(*rust),
            python / rust
        )
    };
    let columns = format!(
        "scene | heyoka {heyoka}: | ours, from Python: | ours, in Rust: | Python over heyoka: | Python over Rust:"
    );
    markdown_table(&columns, rows.iter().map(row))
}

fn least<T>(repeats: usize, run: impl Fn() -> Result<T, Error>) -> Result<(f64, T), Error> {
    let timed = || {
        let begin = Instant::now();
        let found = run()?;
        Ok::<_, Error>((begin.elapsed().as_secs_f64(), found))
    };
    let mut best = timed()?;
    for _ in 1..repeats {
        let (seconds, found) = timed()?;
        best = (best.0.min(seconds), found);
    }
    Ok(best)
}

/// The impact oscillator of the script.
fn oscillator() -> Result<EquationsModel<State<3>>, Error> {
    Ok(Equations::new(&["x", "v"], &[("restitution", "0.8")])
        .mode_text("motion", &["v", "cos(1.3*t) - 0.1*v - x"])
        .rising_text("stop", "x - 0.5")
        .resets_text(&["x", "-restitution*v"])
        .model()?)
}

fn fates(model: &EquationsModel<State<3>>) -> usize {
    let (left, right) = WINDOW;
    let x = |k: usize| left + (right - left) * k as f64 / STARTS as f64;
    let run = |k: usize| model.start("motion", [x(k), 1.0], END);
    model.fates(STARTS, run, |_| ControlFlow::Continue(())).len()
}

/// The labels of the paper's window, as bytes.
fn raster() -> Result<Vec<u8>, Error> {
    let (x, y) = (Interval::new(0.1, 1.0)?, hopper_basin::first_humps(5));
    let grid = Grid { x, y, columns: SIDE, rows: SIDE };
    let Some(values) = LAYERS[0].values() else { return Ok(Vec::new()) };
    let strip = |strip: usize| {
        let begin = strip * values.together;
        let columns = begin..(begin + values.together).min(SIDE);
        (values.columns)(&LayerColumns { grid, logarithmic: false, columns })
    };
    let strips = SIDE.div_ceil(values.together);
    let found = columns_in_parallel(strips, strip, |_| ControlFlow::Continue(()))?;
    let numbers = found.into_iter().flatten().flatten();
    Ok(numbers.flat_map(|label| (label as u16).to_le_bytes()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oscillator_has_its_impacts() {
        let fate = oscillator().unwrap().start("motion", [0.0, 1.0], END).unwrap().fate();
        assert_eq!(fate.events, 83);
    }

    #[test]
    fn a_line_has_all_ratios() {
        let row = SystemTime { what: "a run", heyoka: Some(2e-4), python: 4e-4, rust: 3.2e-4 };
        let text = systems_markdown(&("7".to_owned(), vec![row]));
        assert_eq!(text.lines().last(), Some("| a run | 200 µs | 400 µs | 320 µs | 2.00 | 1.25 |"));
    }
}
