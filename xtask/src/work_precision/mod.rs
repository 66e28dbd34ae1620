//! Time and error of every way to compute a hop, on the same inputs and in one run.

mod hybrid_hopper;
mod methods;
mod ode_hopper;
pub(crate) mod scenes;
pub(crate) mod table;
mod timing;

pub(crate) use methods::{ALL as METHODS, Method};
pub(crate) use timing::{median_seconds, median_time, sin_cos_seconds, sin_cos_time};

use crate::Error;
use crate::output::repository;
use crate::progress::Progress;
use crate::reference::{Hop, Line, parse};
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star, index_below};
use std::time::Duration;

/// Where the files of hops lie in the repository.
const HOPS: &str = "crates/passive-hopper/tests/data";

/// What of a hop is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// α′.
    Speed,
    /// α − α′.
    Loss,
    /// α′ − α*_n.
    Offset,
}

/// An input with its exact answer.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) mass_ratio: MassRatio,
    /// The lift-off speed; for a start near a fixed point the nearest `f64`.
    pub(crate) alpha: f64,
    /// (n, δ) with α = α*_n + δ; nothing below π.
    pub(crate) local: Option<(u64, f64)>,
    pub(crate) sudden: Option<usize>,
    /// The exact quantity; nothing if the hopper is grounded.
    pub(crate) exact: Option<f64>,
}

impl Case {
    /// Of a reference hop.
    pub(crate) fn of(hop: &Hop) -> Self {
        let (mass_ratio, alpha) = (hop.mass_ratio, hop.alpha);
        let (sudden, exact) = (Some(hop.sudden), hop.next);
        Case { mass_ratio, alpha, local: cell(alpha), sudden, exact }
    }
}

/// Inputs of a kind.
#[derive(Debug, Clone)]
pub(crate) struct Class {
    pub(crate) name: String,
    pub(crate) quantity: Quantity,
    pub(crate) cases: Vec<Case>,
}

/// What a method says of a hop.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Answer {
    pub(crate) next: Option<f64>,
    /// The loss, if the method knows it better than as a difference.
    pub(crate) loss: Option<f64>,
    /// α′ − α*_n, if the method knows it better than as a difference.
    pub(crate) offset: Option<f64>,
    pub(crate) sudden: Option<usize>,
}

/// How a method did on a class.
#[derive(Debug, Clone)]
pub(crate) struct Score {
    pub(crate) class: String,
    pub(crate) method: Method,
    pub(crate) cases: usize,
    /// Inputs the method refused, with an error or because they are outside its range.
    pub(crate) refused: usize,
    /// Answers with a wrong number of sudden lift-offs, or grounded wrongly or not.
    pub(crate) wrong: usize,
    /// Relative errors of the others: median and worst, if there are any.
    pub(crate) errors: Option<(f64, f64)>,
    /// Median time for a hop, over passes through the answered inputs.
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

/// The paper's window, random hops and the hard classes.
fn classes() -> Result<Vec<Class>, Error> {
    let mut classes: Vec<Class> = Vec::new();
    let files = ["window", "random", "boundaries", "extreme", "near_fixed_point"];
    let names = files.iter().map(|name| format!("hops_{name}.jsonl"));
    for name in names.chain(["losses_tiny.jsonl".to_owned()]) {
        for (_, line) in parse(&repository().join(HOPS).join(name))? {
            let Some((name, quantity, case)) = case(line) else { continue };
            match classes.iter_mut().find(|class| class.name == name) {
                Some(class) => class.cases.push(case),
                None => classes.push(Class { name, quantity, cases: vec![case] }),
            }
        }
    }
    Ok(classes)
}

fn case(line: Line) -> Option<(String, Quantity, Case)> {
    match line {
        // Its α′ rounds to α: the losses are judged instead.
        Line::Hop(hop) if hop.class == "tiny_alpha" => None,
        Line::Hop(hop) => {
            let case = Case::of(&hop);
            Some((hop.class, Quantity::Speed, case))
        }
        Line::Local { mass_ratio, n, offset, sudden, next } => {
            let alpha = alpha_star(n) + offset;
            let case = Case {
                mass_ratio,
                alpha,
                local: Some((n, offset)),
                sudden: Some(sudden),
                exact: next,
            };
            Some(("near_fixed_point".into(), Quantity::Offset, case))
        }
        Line::Loss(loss) => {
            let case = Case {
                mass_ratio: loss.mass_ratio,
                alpha: loss.alpha,
                local: None,
                sudden: Some(0),
                exact: Some(loss.loss),
            };
            Some(("tiny_alpha".into(), Quantity::Loss, case))
        }
        _ => None, // not about single hops
    }
}

/// The fixed point in whose cell (nπ, (n+1)π) `alpha` lies, and the offset from it.
fn cell(alpha: f64) -> Option<(u64, f64)> {
    let below = index_below(alpha).ok()?;
    let n = if alpha > (below + 1) as f64 * std::f64::consts::PI { below + 1 } else { below };
    (n > 0).then(|| (n, FixedPointSpeed::new(n).offset_of(alpha)))
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
            Some(None) => {} // grounded, rightly
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

/// The relative error; none of it for a hopper that is grounded, and nothing for a wrong verdict.
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
    use super::*;

    #[test]
    fn all_classes_are_there_with_their_cases() {
        let classes = classes().unwrap();
        let sizes: Vec<_> = classes.iter().map(|c| (c.name.as_str(), c.cases.len())).collect();
        for known in [("window", 1000), ("grazing", 400), ("tiny_alpha", 50), ("huge_M", 51)] {
            assert!(sizes.contains(&known), "{sizes:?}");
        }
        assert_eq!(classes.len(), 10);
    }

    /// Every method on a plain hop, 4.55 to 4.5 at M = 0.2: right to its own precision.
    #[test]
    fn methods_agree_on_a_plain_hop() {
        let alpha = 4.55;
        let mass_ratio = MassRatio::new(0.2).unwrap();
        let exact = passive_hopper::LiftOffMap::new(mass_ratio).image(alpha).unwrap();
        let case = Case { mass_ratio, alpha, local: cell(alpha), sudden: Some(0), exact };
        for &method in METHODS {
            let answer = method.hop(&case).unwrap_or_default();
            let error = error(Quantity::Speed, &case, &answer).flatten().unwrap();
            assert!(error <= method.expected_error(), "{}: {error:e}", method.name());
        }
    }

    #[test]
    fn wrong_verdicts_are_not_errors() {
        let case = Case {
            mass_ratio: MassRatio::ONE,
            alpha: 5.0,
            local: cell(5.0),
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
