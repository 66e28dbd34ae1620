//! Arrays of a million speeds, from Python and in Rust, in turns.

use super::python::{Python, results};
use crate::error::Error;
use crate::repository::Progress;
use crate::text::markdown_table;
use passive_hopper::{LiftOffMap, MassRatio};
use resumable_job::write_atomically;
use std::path::Path;
use std::time::Instant;

/// Speeds of the array.
const SPEEDS: usize = 1_000_000;
/// The speeds lie between these two, in the window of Fig. 6.
const WINDOW: (f64, f64) = (4.5, 20.0);
/// Mass ratios: a light lower mass, that of most examples, and equal masses.
const RATIOS: [f64; 3] = [0.1, 0.2, 1.0];
/// Turns of each language. Other processes disturb most of them on a busy computer; the least time counts.
const TURNS: usize = 7;
/// Computations of the array in one turn.
const REPEATS: usize = 3;

/// Seconds of a hop in the array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArrayTime {
    pub(crate) ratio: f64,
    pub(crate) rust: f64,
    pub(crate) python: f64,
}

/// The least times of both languages for the same array.
///
/// Rust writes into an array that is there; Python makes a new one for each result, as every call does.
///
/// # Errors
/// [`Error::CheckFailed`] if an image from Python has other bits than in Rust.
pub(crate) fn array_times(
    python: &Python,
    folder: &Path,
    progress: &Progress,
) -> Result<Vec<ArrayTime>, Error> {
    let bar = progress.bar("arrays", TURNS as u64);
    let speeds = speeds();
    let mut images = vec![0.0; SPEEDS];
    let mut times =
        RATIOS.map(|ratio| ArrayTime { ratio, rust: f64::INFINITY, python: f64::INFINITY });
    for turn in 0..TURNS {
        let (theirs, bytes) = from_python(python, folder, &speeds)?;
        for (k, time) in times.iter_mut().enumerate() {
            time.python = time.python.min(theirs.get(k).copied().unwrap_or(f64::INFINITY));
            let map = LiftOffMap::new(MassRatio::new(time.ratio)?);
            for _ in 0..REPEATS {
                let begin = Instant::now();
                map.images_into(&speeds, &mut images)?;
                time.rust = time.rust.min(begin.elapsed().as_secs_f64() / SPEEDS as f64);
            }
            if bytes.get(8 * k * SPEEDS..8 * (k + 1) * SPEEDS) != Some(&little_endian(&images)) {
                let text = format!("Python's images for M = {} have other bits", time.ratio);
                return Err(Error::CheckFailed(text));
            }
        }
        bar.set(turn as u64 + 1);
    }
    bar.finish();
    Ok(times.to_vec())
}

/// The times as a table.
pub(crate) fn arrays_markdown(times: &[ArrayTime]) -> String {
    let row = |ArrayTime { ratio, rust, python }: &ArrayTime| {
        let slower = python / rust;
        format!("{ratio} | {:.1} ns | {:.1} ns | {slower:.2}", 1e9 * rust, 1e9 * python)
    };
    markdown_table("M: | in Rust: | from Python: | ratio:", times.iter().map(row))
}

/// Speeds spread over the window, with no order that the processor could learn: multiples of the golden section,
/// which has no good rational approximations, modulo 1.
fn speeds() -> Vec<f64> {
    let (least, most) = WINDOW;
    let part = |k: usize| (k as f64 * 0.618_033_988_749_894_9) % 1.0;
    (0..SPEEDS).map(|k| least + (most - least) * part(k)).collect()
}

fn little_endian(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// One turn of Python: seconds a hop for each mass ratio, and the images of all.
fn from_python(
    python: &Python,
    folder: &Path,
    speeds: &[f64],
) -> Result<(Vec<f64>, Vec<u8>), Error> {
    let names = ["arrays.json", "speeds.bin", "arrays-seconds.json", "images.bin"];
    let [job, input, seconds, images] = names.map(|name| folder.join(name));
    let text = serde_json::json!({ "ratios": RATIOS, "repeats": REPEATS }).to_string();
    write_atomically(&job, text.as_bytes())?;
    write_atomically(&input, &little_endian(speeds))?;
    python.run(include_str!("arrays.py"), &[&job, &input, &seconds, &images])?;
    let bytes = std::fs::read(&images)
        .map_err(|source| crate::error::Error::File { path: images.clone(), source })?;
    Ok((results(&seconds)?, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speeds_fill_the_window() {
        let mut speeds = speeds();
        speeds.sort_by(f64::total_cmp);
        assert!(speeds[0] >= WINDOW.0 && speeds[SPEEDS - 1] < WINDOW.1);
        // The widest gap is a few times the mean one.
        let mean = (WINDOW.1 - WINDOW.0) / SPEEDS as f64;
        assert!(speeds.windows(2).all(|pair| pair[1] - pair[0] < 5.0 * mean));
    }

    #[test]
    fn each_mass_ratio_has_a_line() {
        let time = ArrayTime { ratio: 0.2, rust: 2e-8, python: 2.1e-8 };
        let text = arrays_markdown(&[time]);
        assert_eq!(text.lines().last(), Some("| 0.2 | 20.0 ns | 21.0 ns | 1.05 |"));
    }
}
