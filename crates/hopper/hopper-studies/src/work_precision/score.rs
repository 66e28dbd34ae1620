//! Time and error of each method on each class.

use super::case::{Answer, Case, Quantity};
use super::classes::{Class, classes};
use super::methods::{ALL as METHODS, Method};
use crate::error::Error;
use crate::repository::Progress;
use passive_hopper::FixedPointSpeed;
use std::time::Duration;

/// Time and error of a method on a class.
#[derive(Debug, Clone)]
pub(crate) struct Score {
    pub(crate) class: String,
    pub(crate) method: Method,
    pub(crate) cases: usize,
    /// Inputs that the method refused, by an error or because they lie outside its range.
    pub(crate) refused: usize,
    /// Results with a wrong number of sudden lift-offs, or with a wrong decision whether the hopper is grounded.
    pub(crate) wrong: usize,
    /// Relative errors of all other results, median and worst; `None` if there are none.
    pub(crate) errors: Option<(f64, f64)>,
    /// Median time of a hop, over passes through the inputs that the method did not refuse.
    pub(crate) time: Option<Duration>,
}

/// Every method on every class.
pub(crate) fn measure(progress: &Progress) -> Result<Vec<Score>, Error> {
    let classes = classes()?;
    let bar = progress.bar("work and precision", (classes.len() * METHODS.len()) as u64);
    let mut scores = Vec::new();
    for class in &classes {
        for &method in METHODS {
            scores.push(score(class, method));
            bar.set(scores.len() as u64);
        }
    }
    bar.finish();
    Ok(scores)
}

fn score(class: &Class, method: Method) -> Score {
    let mut answered = Vec::new();
    let (mut refused, mut wrong, mut errors) = (0, 0, Vec::new());
    for case in &class.cases {
        let Some(answer) = method.hop(case) else {
            refused += 1;
            continue;
        };
        answered.push(case);
        match error(class.quantity, case, &answer) {
            None => wrong += 1,
            Some(Some(error)) => errors.push(error),
            Some(None) => {} // correctly grounded: there is no error to count
        }
    }
    errors.sort_by(f64::total_cmp);
    let worst = errors.last().copied();
    let time = (!answered.is_empty()).then(|| method.time(&answered));
    Score {
        class: class.name.clone(),
        method,
        cases: class.cases.len(),
        refused,
        wrong,
        errors: worst.map(|worst| (errors[errors.len() / 2], worst)),
        time,
    }
}

/// The relative error of a result. `None` means a wrong decision, `Some(None)` a hopper that is correctly grounded.
fn error(quantity: Quantity, case: &Case, answer: &Answer) -> Option<Option<f64>> {
    if answer.sudden.is_some_and(|sudden| case.sudden.is_some_and(|right| right != sudden)) {
        return None;
    }
    let (Some(next), Some(exact)) = (answer.next, case.exact) else {
        return (answer.next.is_none() && case.exact.is_none()).then_some(None);
    };
    let found = match quantity {
        Quantity::Speed => next,
        Quantity::Loss => answer.loss.unwrap_or(case.alpha - next),
        Quantity::Offset => {
            let difference =
                || FixedPointSpeed::new(case.local.map_or(0, |(n, _)| n)).offset_of(next);
            answer.offset.unwrap_or_else(difference)
        }
    };
    Some(Some(((found - exact) / exact).abs()))
}

#[cfg(test)]
mod tests {
    use super::super::case::fixed_point_of_pi_interval;
    use super::*;
    use passive_hopper::MassRatio;

    /// The hop from 4.55 at M = 0.2 has no sudden lift-off and ends near 4.5.
    #[test]
    fn methods_agree_on_a_plain_hop() {
        let alpha = 4.55;
        let mass_ratio = MassRatio::new(0.2).unwrap();
        let exact = passive_hopper::LiftOffMap::new(mass_ratio).image(alpha).unwrap();
        let case = Case {
            mass_ratio,
            alpha,
            local: fixed_point_of_pi_interval(alpha),
            sudden: Some(0),
            exact,
        };
        for &method in METHODS {
            let answer = method.hop(&case).unwrap_or_default();
            let error = error(Quantity::Speed, &case, &answer).flatten().unwrap();
            assert!(error <= method.expected_error(), "{}: {error:e}", method.name());
        }
    }

    #[test]
    fn wrong_decisions_are_not_errors() {
        let case = Case {
            mass_ratio: MassRatio::ONE,
            alpha: 5.0,
            local: fixed_point_of_pi_interval(5.0),
            sudden: Some(0),
            exact: Some(2.0),
        };
        let right = Answer { next: Some(2.5), sudden: Some(0), ..Answer::default() };
        assert_eq!(error(Quantity::Speed, &case, &right), Some(Some(0.25)));
        let counted = Answer { sudden: Some(1), ..right };
        assert_eq!(error(Quantity::Speed, &case, &counted), None);
        assert_eq!(error(Quantity::Speed, &case, &Answer::default()), None);
        let grounded = Case { exact: None, ..case };
        assert_eq!(error(Quantity::Speed, &grounded, &Answer::default()), Some(None));
    }
}
