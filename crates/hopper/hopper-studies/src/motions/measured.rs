//! Time and error of each program on each motion, at many tolerances.

use super::ours;
use super::scene::{SCENES, Scene, scenes};
use crate::error::Error;
use crate::events::run_diffsol;
use crate::peers::{Python, results};
use crate::repository::say;
use crate::timing::least_seconds;
use resumable_job::write_atomically;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The tolerances are powers of ten with these exponents, relative and absolute.
const EXPONENTS: std::ops::RangeInclusive<i32> = 3..=15;

/// Time for the runs of one scene at one tolerance; the scripts of the other programs have the same.
const SHARE: Duration = Duration::from_millis(100);

/// The script of SciPy and heyoka.
const PYTHON: &str = include_str!("motions.py");

/// A program's answer to a scene at a tolerance, and the seconds of a start.
#[derive(Debug, Clone, serde::Deserialize)]
struct Found {
    scene: String,
    program: String,
    tolerance: f64,
    seconds: f64,
    answer: Vec<f64>,
}

/// Time and error of a program on a motion at a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    pub(super) scene: String,
    pub(super) program: String,
    pub(super) tolerance: f64,
    pub(super) error: f64,
    /// Of one start.
    pub(super) seconds: f64,
}

/// By this repository.
pub(crate) fn by_us() -> Result<Vec<Point>, Error> {
    let mut found = Vec::new();
    for scene in scenes()? {
        say(format_args!("measuring {}", scene.name))?;
        for exponent in EXPONENTS {
            let tolerance = 10f64.powi(-exponent);
            for (program, starts, run) in ours::runs(&scene, tolerance)? {
                // A tolerance that a program refuses has no point.
                let Ok((answer, seconds)) = least_seconds(SHARE, &run) else { continue };
                let seconds = seconds / starts as f64;
                let (name, program) = (scene.name.clone(), program.to_owned());
                found.push(Found { scene: name, program, tolerance, seconds, answer });
            }
        }
    }
    compared(found)
}

/// By SciPy and heyoka.
pub(crate) fn by_python(python: &Python, folder: &Path) -> Result<Vec<Point>, Error> {
    let (input, output) = inputs(folder, "motions-python.json")?;
    python.run(PYTHON, &[&input, &output])?;
    compared(results(&output)?)
}

/// By diffsol.
pub(crate) fn by_diffsol(folder: &Path) -> Result<Vec<Point>, Error> {
    let (input, output) = inputs(folder, "motions-diffsol.json")?;
    run_diffsol(folder, &[&output, &input])?;
    compared(results(&output)?)
}

fn inputs(folder: &Path, output: &str) -> Result<(PathBuf, PathBuf), Error> {
    let input = folder.join("motions.jsonl");
    write_atomically(&input, SCENES.as_bytes())?;
    Ok((input, folder.join(output)))
}

/// The errors.
fn compared(found: Vec<Found>) -> Result<Vec<Point>, Error> {
    let scenes = scenes()?;
    let of = |name: &str| scenes.iter().find(|scene| scene.name == name);
    let point = |Found { scene, program, tolerance, seconds, answer }| {
        let error = of(&scene).map_or(Ok(f64::INFINITY), |known: &Scene| known.error(&answer))?;
        Ok(Point { scene, program, tolerance, error, seconds })
    };
    found.into_iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every way has every answer, to what its tolerance lets expect.
    #[test]
    fn our_motions_have_their_answers() {
        for scene in scenes().unwrap() {
            for (program, _, run) in ours::runs(&scene, 1e-11).unwrap() {
                let starts_many = program.contains("1000") && scene.states.len() > 4;
                if starts_many {
                    continue;
                }
                let error = scene.error(&run().unwrap()).unwrap();
                // Errors add up along the motion; those of the impacts and next to the pericentre grow most. Up to t = 50
                // chaos has lost all digits.
                let is_lost = scene.name == "Lorenz to t = 50";
                assert!(is_lost || error < 1e-6, "{}, {program}: {error:e}", scene.name);
            }
        }
    }

    #[test]
    fn the_script_has_the_same_tolerances_and_starts() {
        assert!(
            PYTHON.contains("range(3, 16)") && PYTHON.contains("STARTS, BATCH, APART = 1000, 8")
        );
        assert_eq!((EXPONENTS, ours::STARTS), (3..=15, 1000));
    }
}
