//! Boxes that are divided until each part is decided.

use crate::cells::{MOST_SIDES, part_of};
use crate::undecided::{Error, Undecided};
use interval_arithmetic::Enclosure;

/// How often boxes are divided, by [`divided`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// The most boxes that are looked at.
    pub boxes: usize,
    /// The most divisions of a box.
    pub divisions: u32,
}

/// What is decided of a box, part by part.
#[derive(Debug, Clone, PartialEq)]
pub struct Divided<T> {
    /// The parts that are decided, with what was found.
    pub decided: Vec<(Vec<Enclosure>, T)>,
    /// The parts that are not, with the reason, if there is one.
    pub open: Vec<(Vec<Enclosure>, Option<Undecided>)>,
}

/// Decides a box, or its parts where the whole is undecided: those that `split` gives, such as [`halves`], and so on within a budget. `decide`
/// returns `None`, or [`Error::Undecided`], where it does not know.
///
/// ```
/// use equations::{Formulas, Names};
/// use validated_dynamics::{Budget, EnclosedMap, Enclosure, FormulaMap, divided, halves};
/// let names = Names::new(&["x"], &[])?;
/// let square_root = FormulaMap::new(Formulas::from_text(names, &["sqrt(x)"])?, 1)?;
/// let domain = [Enclosure::between(0.0, 1.0)?];
/// // At 0 the derivative has no bound, so that the part there stays open.
/// let budget = Budget { boxes: 1000, divisions: 10 };
/// let found = divided(&domain, budget, halves, |part| square_root.image(part).map(Some))?;
/// assert_eq!((found.decided.len(), found.open.len()), (10, 1));
/// # Ok::<(), validated_dynamics::Error>(())
/// ```
///
/// # Errors
/// Errors of `decide` other than [`Error::Undecided`].
pub fn divided<T>(
    domain: &[Enclosure],
    budget: Budget,
    split: impl Fn(&[Enclosure]) -> Vec<Vec<Enclosure>>,
    mut decide: impl FnMut(&[Enclosure]) -> Result<Option<T>, Error>,
) -> Result<Divided<T>, Error> {
    let mut found = Divided { decided: Vec::new(), open: Vec::new() };
    let mut left = vec![(domain.to_vec(), 0)];
    let mut boxes = 0;
    while let Some((own, divisions)) = left.pop() {
        if boxes == budget.boxes {
            found.open.push((own, None));
            continue;
        }
        boxes += 1;
        let why = match decide(&own) {
            Ok(Some(what)) => {
                found.decided.push((own, what));
                continue;
            }
            Ok(None) => None,
            Err(Error::Undecided(undecided)) => Some(*undecided),
            Err(error) => return Err(error),
        };
        match divisions == budget.divisions {
            true => found.open.push((own, why)),
            false => left.extend(split(&own).into_iter().rev().map(|part| (part, divisions + 1))),
        }
    }
    Ok(found)
}

/// The 2ⁿ parts of a box with half of its sides; of a box with more than [`MOST_SIDES`] sides the two halves of its longest side.
pub fn halves(own: &[Enclosure]) -> Vec<Vec<Enclosure>> {
    if own.len() <= MOST_SIDES {
        return (0..1 << own.len()).map(|part| part_of(own, part)).collect();
    }
    let longest = (0..own.len()).max_by(|a, b| own[*a].width().total_cmp(&own[*b].width()));
    let part = |upper: usize| {
        let mut part = own.to_vec();
        if let Some(longest) = longest {
            part[longest] = part_of(&own[longest..=longest], upper)[0];
        }
        part
    };
    vec![part(0), part(1)]
}
