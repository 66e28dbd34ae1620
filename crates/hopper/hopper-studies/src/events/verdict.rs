//! How right are the events that a program found?

use super::answers::Answer;
use super::found::{FoundEvents, MOST};

/// A time belongs to an exact one if it is no farther from it. It is far above the errors of all programs, and far
/// below the time between two events that are counted.
const SAME_EVENT: f64 = 1e-6;

/// The end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// The state is right, within [`SAME_EVENT`].
    Right,
    /// The first component of the state, which is wrong.
    Wrong(f64),
    /// The run had not come to the limit on time after [`MOST`] events.
    Stuck,
}

/// The verdict on one program and one scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Verdict {
    pub(crate) scene: String,
    pub(crate) program: String,
    /// Events of the exact answer.
    pub(crate) exact: usize,
    /// Events found at the time of an exact one.
    pub(crate) right: usize,
    /// Events found at other times, or more than once.
    pub(crate) wrong: usize,
    /// The largest error of the time of an event that was found.
    pub(crate) error: f64,
    /// State at the end.
    pub(crate) end: End,
    /// Seconds for an event that was found, right or wrong.
    pub(crate) seconds: f64,
    /// Lines of the model.
    pub(crate) lines: usize,
}

/// Compares the events of a program with the exact ones.
pub(crate) fn verdict(found: &FoundEvents, answer: &Answer) -> Verdict {
    let (mut right, mut wrong, mut error) = (0, 0, 0.0f64);
    let mut exact = answer.times.iter().peekable();
    // The ball's impacts are infinitely many. After the last one that is counted, up to the limit of all impacts,
    // further ones are neither right nor wrong.
    let until = answer.accumulation().map_or(f64::INFINITY, |limit| limit + SAME_EVENT);
    for &time in &found.times {
        while exact.next_if(|next| **next < time - SAME_EVENT).is_some() {}
        match exact.next_if(|next| (**next - time).abs() <= SAME_EVENT) {
            Some(next) => {
                right += 1;
                error = error.max((time - next).abs());
            }
            None if answer.times.last().is_some_and(|last| time > *last)
                && until.is_finite()
                && time <= until => {}
            None => wrong += 1,
        }
    }
    let end = if found.times.len() >= MOST {
        End::Stuck
    } else if (found.end - answer.end).abs() <= SAME_EVENT {
        End::Right
    } else {
        End::Wrong(found.end)
    };
    Verdict {
        scene: found.scene.clone(),
        program: found.name.clone(),
        exact: answer.times.len(),
        right,
        wrong,
        error,
        end,
        seconds: found.seconds / found.times.len().max(1) as f64,
        lines: found.lines,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(times: &[f64], end: f64) -> FoundEvents {
        let (scene, name) = ("a scene".to_owned(), "a program".to_owned());
        FoundEvents { scene, name, seconds: 3.0, times: times.to_vec(), end, lines: 7 }
    }

    fn answer(scene: &str) -> Answer {
        Answer { scene: scene.to_owned(), times: vec![1.0, 2.0, 3.0], end: 5.0 }
    }

    #[test]
    fn events_are_right_missed_or_wrong() {
        let verdict = verdict(&found(&[1.0, 1.5, 3.0 + 1e-9, 4.0], 5.0), &answer("a scene"));
        assert_eq!((verdict.exact, verdict.right, verdict.wrong), (3, 2, 2));
        assert!((verdict.error - 1e-9).abs() < 1e-15);
        assert_eq!((verdict.end, verdict.seconds), (End::Right, 0.75));
    }

    #[test]
    fn a_time_that_is_found_twice_is_wrong_once() {
        let verdict = verdict(&found(&[1.0, 1.0, 2.0, 3.0], 4.0), &answer("a scene"));
        assert_eq!((verdict.right, verdict.wrong, verdict.end), (3, 1, End::Wrong(4.0)));
    }

    #[test]
    fn a_run_of_too_many_events_is_stuck() {
        let verdict = verdict(&found(&[1.0; MOST], 5.0), &answer("a scene"));
        assert_eq!((verdict.right, verdict.wrong, verdict.end), (1, MOST - 1, End::Stuck));
    }
}
