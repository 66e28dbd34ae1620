//! The events that each program finds.

use super::diffsol::run_diffsol;
use super::model_lines::model_lines;
use super::ours;
use crate::error::Error;
use crate::peers::{Python, results};
use crate::timing::least_seconds;
use std::path::Path;
use std::time::Duration;

/// Most events of a run, for the other programs: their scripts have the same number. A run with more has not come
/// to its limit on time.
pub(super) const MOST: usize = 1000;

/// The scripts of the other programs.
const PYTHON: &str = include_str!("events.py");
const DIFFSOL: &str = include_str!("../../peers-diffsol/src/main.rs");

/// Time for the runs of one scene.
const SHARE: Duration = Duration::from_secs(1);

/// The events that one program finds in one scene.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
pub(crate) struct FoundEvents {
    pub(super) scene: String,
    pub(super) name: String,
    /// Seconds for a run.
    pub(super) seconds: f64,
    pub(super) times: Vec<f64>,
    /// First component of the state at the end.
    pub(super) end: f64,
    /// Lines of the model.
    #[serde(default)]
    pub(super) lines: usize,
}

impl FoundEvents {
    /// True if these are events of this scene.
    pub(crate) fn is_of(&self, scene: &str) -> bool {
        self.scene == scene
    }
}

/// By SciPy and heyoka.
pub(crate) fn by_python(python: &Python, folder: &Path) -> Result<Vec<FoundEvents>, Error> {
    let output = folder.join("events-python.json");
    python.run(PYTHON, &[&output])?;
    let mut found: Vec<FoundEvents> = results(&output)?;
    for found in &mut found {
        let program = found.name.split(' ').next().unwrap_or_default().to_lowercase();
        found.lines = model_lines(PYTHON, &format!("{program} {}", found.scene));
    }
    Ok(found)
}

/// By diffsol.
pub(crate) fn by_diffsol(folder: &Path) -> Result<Vec<FoundEvents>, Error> {
    let output = folder.join("events-diffsol.json");
    run_diffsol(folder, &[&output])?;
    let mut found: Vec<FoundEvents> = results(&output)?;
    for found in &mut found {
        found.lines = model_lines(DIFFSOL, &found.scene);
    }
    Ok(found)
}

/// By this repository.
pub(crate) fn by_us() -> Result<Vec<FoundEvents>, Error> {
    let name = "ours".to_owned();
    let found = |(scene, run): (&str, ours::Run)| {
        let ((times, end), smallest) = least_seconds(SHARE, run)?;
        let lines = model_lines(ours::SOURCE, scene);
        Ok(FoundEvents {
            scene: scene.into(),
            name: name.clone(),
            seconds: smallest,
            times,
            end,
            lines,
        })
    };
    ours::scenes()?.into_iter().map(found).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{answers, verdict};

    /// Every event of every scene, at its time, and the right state at the end.
    #[test]
    fn our_events_are_the_exact_ones() {
        let answers = answers().unwrap();
        for (answer, (scene, run)) in answers.iter().zip(ours::scenes().unwrap()) {
            let (times, end) = run().unwrap();
            let (scene, name) = (scene.to_owned(), "ours".to_owned());
            let found = FoundEvents { scene, name, seconds: 1.0, times, end, lines: 1 };
            let verdict = verdict(&found, answer);
            assert_eq!(answer.scene, found.scene);
            assert_eq!((verdict.right, verdict.wrong), (verdict.exact, 0), "{verdict:?}");
            // The pendulum's energy errors make its times drift, over 48 periods.
            assert!(verdict.error < 1e-9 && verdict.end == verdict::End::Right, "{verdict:?}");
        }
    }

    #[test]
    fn every_source_has_every_model() {
        for answer in answers().unwrap() {
            let scene = answer.scene;
            for (source, name) in [
                (PYTHON, format!("scipy {scene}")),
                (PYTHON, format!("heyoka {scene}")),
                (DIFFSOL, scene.clone()),
                (ours::SOURCE, scene.clone()),
            ] {
                assert!(model_lines(source, &name) > 5, "{name}");
            }
        }
        assert!(PYTHON.contains("MOST = 1000") && DIFFSOL.contains("MOST: usize = 1000"));
    }
}
