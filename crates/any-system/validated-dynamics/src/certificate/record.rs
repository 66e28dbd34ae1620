//! What a run does, step by step, as a certificate has it.

use super::written_set::WrittenSet;
use crate::set::AffineSet;
use crate::system::ValidatedGuard;
use crate::tube::Tube;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use serde_json::{Value, json};

/// A step of a run that is written down ends sooner by this factor, so often, until the written set is on the sides of all surfaces on which its
/// states are.
const SOONER: f64 = 0.8;
const SOONER_TRIES: usize = 8;

/// A step of a run, with the set after it.
#[derive(Debug, Clone, PartialEq)]
enum Step {
    /// A flow of this length, without an event.
    Flow(f64, WrittenSet),
    /// An event of all states within this time: the states after it. If it changes nothing, the flow goes on up to this time, to the
    /// second set.
    Event(Label, f64, WrittenSet, Option<WrittenSet>),
    /// A flow of this length on which all states cross a surface, and none has an event, for its condition is not met.
    Pass(Label, f64, WrittenSet),
    /// One application of a map that is formulas.
    Applied(WrittenSet),
}

/// A run: each step leads all points of the set before it into the set behind it, whatever the steps before were.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    start: WrittenSet,
    begin: Option<WrittenSet>,
    steps: Vec<Step>,
    image: Option<WrittenSet>,
}

impl Record {
    /// From this set of variables, and the set itself as it is written.
    pub(crate) fn from(start: &AffineSet) -> (Record, AffineSet) {
        let start = WrittenSet::of(start);
        let set = start.set();
        (Record { start, begin: None, steps: Vec::new(), image: None }, set)
    }

    /// The states at the start of a run, as they are written.
    pub(crate) fn begin(&mut self, set: &AffineSet) -> AffineSet {
        let written = WrittenSet::of(set);
        self.begin.insert(written).set()
    }

    /// The states after a flow of this time of a step, or of a shorter one, which is given with them.
    ///
    /// The written set is wider: where it would meet a surface that no state has met, the step ends sooner.
    pub(crate) fn flow(
        &mut self,
        tube: &Tube<'_>,
        guards: &[ValidatedGuard],
        longest: f64,
    ) -> (f64, AffineSet) {
        let written_at = |time| WrittenSet::of(&tube.set_at(Enclosure::from(time)));
        let mut time = longest;
        let mut written = written_at(time);
        for _ in 0..SOONER_TRIES {
            let set = written.set();
            let keeps_side = |(place, guard): (usize, &ValidatedGuard)| {
                let before = tube.guard_at(place, Enclosure::from(time)).sign();
                let after = guard.function.enclosures(Enclosure::ZERO, set.hull());
                before.is_none() || after.is_ok_and(|after| after[0].sign() == before)
            };
            if guards.iter().enumerate().all(keeps_side) {
                break;
            }
            time *= SOONER;
            written = written_at(time);
        }
        let set = written.set();
        self.steps.push(Step::Flow(time, written));
        (time, set)
    }

    /// The states after an event.
    pub(crate) fn event(&mut self, surface: Label, within: f64, set: &AffineSet) -> AffineSet {
        self.push(set, |written| Step::Event(surface, within, written, None))
    }

    /// The states after a flow through a surface that changes nothing: that of the event before, if it was one.
    pub(crate) fn pass(
        &mut self,
        surface: Label,
        (length, set): (f64, &AffineSet),
        is_event: bool,
    ) -> AffineSet {
        match self.steps.last_mut() {
            Some(Step::Event(_, _, _, beyond)) if is_event => {
                beyond.insert(WrittenSet::of(set)).set()
            }
            _ => self.push(set, |written| Step::Pass(surface, length, written)),
        }
    }

    /// The images under a map.
    pub(crate) fn applied(&mut self, set: &AffineSet) -> AffineSet {
        self.push(set, Step::Applied)
    }

    /// What is read of the last states.
    pub(crate) fn read(&mut self, set: &AffineSet) -> AffineSet {
        let written = WrittenSet::of(set);
        self.image.insert(written).set()
    }

    fn push(&mut self, set: &AffineSet, step: impl FnOnce(WrittenSet) -> Step) -> AffineSet {
        let written = WrittenSet::of(set);
        let set = written.set();
        self.steps.push(step(written));
        set
    }

    pub(crate) fn as_json(&self) -> Value {
        let last = self.steps.len();
        let step = |(number, step): (usize, &Step)| match step {
            Step::Flow(length, set) => json!(["flow", length, set.as_json()]),
            Step::Event(surface, length, _, Some(set)) if number + 1 < last => {
                json!(["pass", surface.as_str(), length, set.as_json()])
            }
            Step::Event(surface, within, set, _) => {
                json!(["event", surface.as_str(), within, set.as_json()])
            }
            Step::Pass(surface, length, set) => {
                json!(["pass", surface.as_str(), length, set.as_json()])
            }
            Step::Applied(set) => json!(["applied", set.as_json()]),
        };
        json!({
            "start": self.start.as_json(),
            "begin": self.begin.as_ref().map(WrittenSet::as_json),
            "steps": self.steps.iter().enumerate().map(step).collect::<Vec<_>>(),
            "image": self.image.as_ref().map(WrittenSet::as_json),
        })
    }
}
