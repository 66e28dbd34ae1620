//! An event of all states of a set, and what it does to them.

use crate::matrix::Matrix;
use crate::set::{AffineSet, Chain};
use crate::system::ValidatedGuard;
use crate::undecided::Reason;
use equations::Formulas;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;

/// An event of all states of a set.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedEvent {
    /// The surface.
    pub surface: Label,
    /// The mode before.
    pub mode: Label,
    /// The mode after; `None` if the execution ends.
    pub next: Option<Label>,
    /// The times since the start.
    pub time: Enclosure,
    /// A box of the states before the event, on the surface.
    pub before: Vec<Enclosure>,
    /// A box of the states after it.
    pub after: Vec<Enclosure>,
    /// The states after it.
    pub(crate) set: AffineSet,
    /// Their derivatives with respect to the first ones, if they are wanted.
    pub(crate) chain: Option<Chain>,
}

impl ProvedEvent {
    /// The derivatives of the states after the event with respect to the variables of the start's box; `None` for a run without them.
    pub fn derivatives(&self) -> Option<Matrix> {
        self.chain.as_ref().map(Chain::matrix)
    }
}

/// True if the condition of an event holds at all of these states.
pub(crate) fn holds(guard: &ValidatedGuard, states: &[Enclosure]) -> Result<bool, Reason> {
    let Some(condition) = &guard.condition else { return Ok(true) };
    let value = condition.enclosures(Enclosure::ZERO, states).map_err(Reason::Domain)?;
    let sign = value.first().and_then(Enclosure::sign);
    sign.map(|sign| sign > 0.0).ok_or(Reason::Condition { surface: guard.surface })
}

/// The states after an event, and their derivatives, if they are wanted.
pub(crate) fn jumped(
    guard: &ValidatedGuard,
    before: &AffineSet,
    chain: Option<Chain>,
) -> Result<(AffineSet, Option<Chain>), Reason> {
    let Some((state, slopes)) = &guard.reset else { return Ok((before.clone(), chain)) };
    carried(before, chain, (state, slopes)).map_err(Reason::Domain)
}

/// The image of a set under formulas, with their derivatives, and the derivatives of all.
pub(crate) fn carried(
    set: &AffineSet,
    chain: Option<Chain>,
    (formulas, slopes): (&Formulas, &Formulas),
) -> Result<(AffineSet, Option<Chain>), equations::Error> {
    let at_centre = formulas.enclosures(Enclosure::ZERO, &set.centre_box())?;
    let entries = slopes.enclosures(Enclosure::ZERO, set.hull())?;
    let slopes = Matrix::of_rows(at_centre.len(), set.hull().len(), &entries);
    let bounds = formulas.enclosures(Enclosure::ZERO, set.hull())?;
    let chain = chain.map(|chain| chain.then(&slopes));
    Ok((set.image(&at_centre, &slopes, Some(&bounds)), chain))
}
