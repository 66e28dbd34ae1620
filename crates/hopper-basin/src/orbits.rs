//! Orbits of many lift-off speeds at one mass ratio, hopping together.

use crate::arcs::Arcs;
use crate::itinerary::Itinerary;
use crate::{Fates, HOP_BUDGET, HopperFate};

/// What is noted of an orbit on its way.
pub(crate) trait Note: Copy {
    /// What it takes to note it.
    type With;
    /// A hop.
    fn hop(&mut self, alpha: f64, next: Option<f64>, fates: &Fates, with: &Self::With);
    /// The end at a speed, in an interval of known fate or in a way that says nothing of its neighbours; or on the
    /// ground.
    fn end(&mut self, speed: Option<f64>, known: Option<Known>);
}

/// The label of what is not labelled yet; what stays so is undecided.
pub(crate) const OPEN: u16 = HopperFate::UNDECIDED;

/// An interval all of whose points have the same fate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Known {
    /// The label of the fate.
    pub(crate) label: u16,
    /// One for each interval.
    pub(crate) id: u32,
    /// Its ends; no numbers if they are not known.
    pub(crate) between: (f64, f64),
}

/// Where orbits come to their ends.
pub(crate) trait Ends {
    /// The interval that holds `alpha`.
    fn known(&self, alpha: f64, fates: &Fates) -> Option<Known>;
}

/// Nothing.
impl Note for () {
    type With = ();
    fn hop(&mut self, _: f64, _: Option<f64>, _: &Fates, (): &()) {}
    fn end(&mut self, _: Option<f64>, _: Option<Known>) {}
}

impl Note for Itinerary {
    type With = Arcs;
    #[inline]
    fn hop(&mut self, alpha: f64, next: Option<f64>, fates: &Fates, arcs: &Arcs) {
        self.hop(alpha, next, arcs, fates.map());
    }
    #[inline]
    fn end(&mut self, speed: Option<f64>, known: Option<Known>) {
        self.ended = true;
        match (speed, known) {
            (Some(alpha), Some(known)) => self.ends_in(alpha, &known),
            (Some(_), None) => self.sure = false,
            (None, _) => {}
        }
    }
}

/// Orbits that have not come to their end.
pub(crate) struct Orbits<'a, N, E> {
    fates: &'a Fates,
    ends: &'a E,
    starts: &'a [f64],
    note: N,
    /// Which start.
    index: Vec<u32>,
    /// Where they are.
    speeds: Vec<Option<f64>>,
    /// Where they were.
    before: Vec<f64>,
    notes: Vec<N>,
    hops: usize,
    /// The starts whose orbits have come to their ends since this was last emptied.
    pub(crate) ended: Vec<u32>,
}

impl<'a, N: Note, E: Ends> Orbits<'a, N, E> {
    /// None yet.
    pub(crate) fn new(fates: &'a Fates, ends: &'a E, starts: &'a [f64], note: N) -> Self {
        let (index, speeds, before, notes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let ended = Vec::new();
        Orbits { fates, ends, starts, note, index, speeds, before, notes, hops: 0, ended }
    }

    /// Adds the orbits of the starts with these numbers; those in a trap come to their end at once.
    pub(crate) fn add(
        &mut self,
        starts: impl Iterator<Item = u32>,
        labels: &mut [u16],
        notes: &mut [N],
    ) {
        let first = self.index.len();
        for at in starts {
            let Some(&start) = self.starts.get(at as usize) else { continue };
            self.index.push(at);
            self.speeds.push(Some(start));
            self.before.push(f64::NAN); // nowhere before: no number equals it
            self.notes.push(self.note);
        }
        self.sort_out(first, labels, notes);
    }

    /// Whether all have come to their ends.
    pub(crate) fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// Takes all one hop on; those that come to an end are labelled, with their notes.
    pub(crate) fn hop(&mut self, with: &N::With, labels: &mut [u16], notes: &mut [N]) {
        self.before.clear();
        self.before.extend(self.speeds.iter().map(|speed| speed.unwrap_or(f64::NAN)));
        // Those with an error keep their speeds, and are sorted out one by one.
        let _ = self.fates.map().images(&mut self.speeds);
        for ((note, &alpha), &next) in self.notes.iter_mut().zip(&self.before).zip(&self.speeds) {
            note.hop(alpha, next, self.fates, with);
        }
        self.hops += 1;
        self.sort_out(0, labels, notes);
    }

    /// From orbit `first` on: labels those that have come to an end, and keeps the others.
    fn sort_out(&mut self, first: usize, labels: &mut [u16], notes: &mut [N]) {
        let mut kept = first;
        for at in first..self.index.len() {
            let index = self.index[at];
            if let Some((label, known)) = self.end(at) {
                labels[index as usize] = label;
                if let Some(slot) = notes.get_mut(index as usize) {
                    *slot = self.notes[at];
                    slot.end(self.speeds[at], known);
                    self.ended.push(index);
                }
            } else {
                self.index[kept] = index;
                self.speeds[kept] = self.speeds[at];
                self.notes[kept] = self.notes[at];
                kept += 1;
            }
        }
        self.index.truncate(kept);
        self.speeds.truncate(kept);
        self.before.truncate(kept);
        self.notes.truncate(kept);
    }

    /// The label of an orbit that has come to its end, and the interval of known fate that it has come to.
    #[inline]
    fn end(&self, at: usize) -> Option<(u16, Option<Known>)> {
        let Some(alpha) = self.speeds[at] else { return Some((HopperFate::GROUNDED, None)) };
        let moves = alpha != self.before[at] && alpha > 0.0 && self.hops <= HOP_BUDGET;
        if moves {
            let known = self.ends.known(alpha, self.fates)?;
            // Higher indices share a label of the generic traps.
            if u64::from(known.label) != HopperFate::LARGEST_LABEL {
                return Some((known.label, Some(known)));
            }
        }
        Some((self.fates.label_of(self.starts[self.index[at] as usize]), None))
    }
}
