//! The right answers of the scenes, computed with 40 digits by `xtask/generators/scenes.py`.

use crate::error::Error;

/// The answers, one scene a line.
const ANSWERS: &str = include_str!("../../tests/data/events.jsonl");

/// The right answer of a scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Answer {
    /// Name of the scene.
    pub(crate) scene: String,
    /// Times of the events, ascending.
    pub(crate) times: Vec<f64>,
    /// First component of the state at the end.
    pub(crate) end: f64,
}

impl Answer {
    /// The time at which the ball's impacts accumulate: the sum of all flights, √(2h/g) (1 + e)/(1 − e) with h = 1, g =
    /// 9.81, e = 0.8. `None` for the other scenes.
    pub(crate) fn accumulation(&self) -> Option<f64> {
        (self.scene == "ball").then(|| 9.0 * (2.0f64 / 9.81).sqrt())
    }
}

/// A line of the file. Numbers are texts of 25 digits.
#[derive(serde::Deserialize)]
struct Line {
    scene: String,
    times: Vec<String>,
    end: String,
}

/// The right answers of all scenes.
pub(crate) fn answers() -> Result<Vec<Answer>, Error> {
    let wrong = |reason: String| Error::Reference { reason };
    let number = |text: &String| {
        text.parse::<f64>().map_err(|error| wrong(format!("events.jsonl: {text}: {error}")))
    };
    let answer = |line: &str| {
        let line: Line =
            serde_json::from_str(line).map_err(|e| wrong(format!("events.jsonl: {e}")))?;
        let times = line.times.iter().map(number).collect::<Result<_, _>>()?;
        Ok(Answer { scene: line.scene, times, end: number(&line.end)? })
    };
    ANSWERS.lines().map(answer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(scene: &str) -> Vec<f64> {
        answers().unwrap().into_iter().find(|answer| answer.scene == scene).unwrap().times
    }

    /// The closed forms, by other formulas than the generator's.
    #[test]
    fn answers_follow_the_closed_forms() {
        let first = (2.0f64 / 9.81).sqrt();
        for (k, time) in times("ball").iter().enumerate() {
            let exact = first * (9.0 - 10.0 * 0.8f64.powi(k as i32 + 1));
            assert!((time - exact).abs() < 1e-14, "{k}: {time} {exact}");
        }
        let relay = times("relay with hysteresis");
        // From 0.01 above to 0.01 below the middle and back.
        let period = 0.02 / 0.7 + 0.02 / 1.3;
        for pair in relay.windows(3) {
            assert!((pair[2] - pair[0] - period).abs() < 1e-14);
        }
        // A pendulum passes its lowest point twice a period, and each level near the top twice in a short time.
        let (zeros, tops) = (times("pendulum"), times("turning points"));
        let quarter = zeros[0];
        for (k, time) in zeros.iter().enumerate() {
            assert!((time - quarter * (2 * k + 1) as f64).abs() < 1e-12);
        }
        for pair in tops[1..].chunks_exact(2) {
            let turning = 0.5 * (pair[0] + pair[1]) / (4.0 * quarter);
            assert!((turning - turning.round()).abs() < 1e-14 && pair[1] - pair[0] < 0.03);
        }
    }

    /// Van der Pol's period for μ = 5 is 11.6122 (Hairer, Nørsett, Wanner and others).
    #[test]
    fn van_der_pol_settles_to_its_period() {
        let zeros = times("van der Pol");
        let period = zeros[50] - zeros[48];
        assert!((period - 11.612_230_667).abs() < 1e-8, "{period}");
    }
}
