//! The classes of hops: the paper's window, random hops and the hard ones.

use super::case::{Case, Quantity};
use crate::error::Error;
use crate::reference::{Line, parse};
use crate::repository::repository;
use passive_hopper::alpha_star;

/// The folder with the files of hops in the repository.
const HOPS: &str = "crates/hopper/passive-hopper/tests/data";

/// Inputs of one kind.
#[derive(Debug, Clone)]
pub(crate) struct Class {
    pub(crate) name: String,
    pub(crate) quantity: Quantity,
    pub(crate) cases: Vec<Case>,
}

/// The paper's window, random hops and the hard classes.
pub(super) fn classes() -> Result<Vec<Class>, Error> {
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
        // Here α′ rounds to α, and every method would seem exact. The losses of the same hops are compared instead.
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
        _ => None, // lines about fates, fixed points and traps
    }
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
}
