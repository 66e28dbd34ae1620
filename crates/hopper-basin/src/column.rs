//! Many speeds in increasing order at one mass ratio.
//!
//! What lies between two speeds with a [common itinerary](Itinerary) needs no orbit of its own, and is an interval of
//! known fate for orbits that come down to it. So the humps are taken from below: their orbits soon end in what is
//! known already.

use crate::Fates;
use crate::arcs::Arcs;
use crate::itinerary::Itinerary;
use crate::ladder::{Ladder, RUNGS};
use crate::orbits::{Ends, Known, Orbits};
use std::ops::Range;

/// The speeds, and what is known of the lower ones.
pub(crate) struct Column<'a> {
    fates: &'a Fates,
    arcs: &'a Arcs,
    /// Those asked for, and before them others from 0 up, for orbits that come down.
    speeds: &'a [f64],
    /// Every so many-th speed is followed at first.
    coarsest: usize,
    notes: Vec<Itinerary>,
    /// For a speed that is followed the next ones below and above that are.
    below: Vec<u32>,
    above: Vec<u32>,
    intervals: Intervals<'a>,
}

/// Traps, and intervals between neighbouring speeds of known fate.
struct Intervals<'a> {
    ladder: &'a Ladder,
    speeds: &'a [f64],
    /// The first of the speeds that were asked for, by number, and speeds per unit before and from there.
    first: usize,
    densities: (f64, f64),
    /// For every speed the interval from it to the next one, or none.
    which: Vec<u32>,
    known: Vec<Known>,
}

const NONE: u32 = u32::MAX;

impl Ends for Intervals<'_> {
    #[inline]
    fn known(&self, alpha: f64, fates: &Fates) -> Option<Known> {
        self.ladder.known(alpha, fates).or_else(|| {
            // A guess for equal spacing; what it finds is looked at.
            let split = self.speeds[self.first];
            let at = if alpha < split {
                (alpha * self.densities.0) as usize
            } else {
                self.first + ((alpha - split) * self.densities.1) as usize
            };
            let known = self.known.get(*self.which.get(at)? as usize)?;
            (alpha >= known.between.0 && alpha <= known.between.1).then_some(*known)
        })
    }
}

/// `speeds`, and before them half as many from 0 up; and how many these are.
pub(crate) fn from_zero(speeds: &[f64]) -> (Vec<f64>, usize) {
    let first = speeds.first().copied().unwrap_or(0.0);
    let count = if first > 0.0 { speeds.len() / 2 } else { 0 };
    let lower = (0..count).map(|k| first * (k as f64 + 0.5) / count as f64);
    (lower.chain(speeds.iter().copied()).collect(), count)
}

impl<'a> Column<'a> {
    /// Nothing known yet but traps. The speeds are those of [`from_zero`].
    pub(crate) fn new(
        fates: &'a Fates,
        ladder: &'a Ladder,
        arcs: &'a Arcs,
        (speeds, first): (&'a [f64], usize),
    ) -> Self {
        let count = speeds.len();
        let (split, last) = (speeds[first], speeds[count - 1]);
        let densities = (first as f64 / split, (count - 1 - first) as f64 / (last - split));
        let which = vec![NONE; count];
        Column {
            fates,
            arcs,
            speeds,
            coarsest: (count / DENSE).clamp(1, COARSEST),
            notes: vec![Itinerary::START; count],
            below: (0..count as u32).collect(),
            above: (0..count as u32).collect(),
            intervals: Intervals { ladder, speeds, first, densities, which, known: Vec::new() },
        }
    }

    /// Labels all, hump by hump.
    pub(crate) fn label(mut self, labels: &mut [u16]) {
        let mut first = 0;
        for n in 0..=RUNGS {
            let star = passive_hopper::alpha_star(n + 1).high;
            let end = first + self.speeds[first..].partition_point(|&speed| speed < star);
            if end > first {
                self.label_hump(first as u32..end as u32, labels);
                self.keep(first..end, labels);
            }
            first = end;
        }
    }

    /// First every so many-th, then, as soon as its ends are known, the middle of what is open.
    fn label_hump(&mut self, range: Range<u32>, labels: &mut [u16]) {
        let last = range.end - 1;
        let coarse: Vec<u32> = (range.start..last).step_by(self.coarsest).chain([last]).collect();
        for pair in coarse.windows(2) {
            self.join(pair[0], pair[1]);
        }
        let notes = &mut self.notes;
        let mut orbits = Orbits::new(self.fates, &self.intervals, self.speeds, Itinerary::START);
        orbits.add(coarse.into_iter(), labels, notes);
        let (mut ended, mut middles) = (Vec::new(), Vec::new());
        loop {
            while !orbits.ended.is_empty() {
                std::mem::swap(&mut ended, &mut orbits.ended);
                let mut gaps = Gaps { notes, below: &mut self.below, above: &mut self.above };
                gaps.narrow(&ended, labels, &mut middles);
                orbits.add(middles.drain(..), labels, notes);
                ended.clear();
            }
            if orbits.is_empty() {
                break;
            }
            orbits.hop(self.arcs, labels, notes);
        }
    }

    fn join(&mut self, left: u32, right: u32) {
        self.above[left as usize] = right;
        self.below[right as usize] = left;
    }

    /// Keeps what is between followed speeds of a hump with common itineraries, joined where they meet.
    fn keep(&mut self, range: Range<usize>, labels: &[u16]) {
        let Intervals { which, known, .. } = &mut self.intervals;
        let mut at = range.start;
        let mut open: Option<Known> = None;
        while at + 1 < range.end {
            let next = self.above[at] as usize;
            let closed = self.notes[at].leads_as(&self.notes[next]) && labels[at] == labels[next];
            if closed {
                let from = open.take().map_or(self.speeds[at], |known| known.between.0);
                let id = RUNGS as u32 + 1 + known.len() as u32;
                open = Some(Known { label: labels[at], id, between: (from, self.speeds[next]) });
                which[at..next].fill(known.len() as u32);
            } else if let Some(done) = open.take() {
                known.push(done);
            }
            at = next;
        }
        known.extend(open);
    }
}

/// The gaps between the speeds that are followed.
struct Gaps<'a> {
    notes: &'a [Itinerary],
    below: &'a mut [u32],
    above: &'a mut [u32],
}

impl Gaps<'_> {
    /// Of the gaps beside those that have `ended`, fills the closed ones and halves the open ones.
    fn narrow(&mut self, ended: &[u32], labels: &mut [u16], middles: &mut Vec<u32>) {
        for &at in ended {
            for (left, right) in [(self.below[at as usize], at), (at, self.above[at as usize])] {
                middles.extend(self.halved(left, right, labels));
            }
        }
    }

    /// The middle of a gap whose ends are known and differ.
    fn halved(&mut self, left: u32, right: u32, labels: &mut [u16]) -> Option<u32> {
        let (from, to) = (left as usize, right as usize);
        let known = self.notes[from].ended && self.notes[to].ended;
        if right - left < 2 || !known {
            return None;
        }
        if labels[from] == labels[to] && self.notes[from].leads_as(&self.notes[to]) {
            let label = labels[from];
            labels[from + 1..to].fill(label);
            return None;
        }
        let middle = left.midpoint(right);
        (self.above[from], self.below[middle as usize]) = (middle, left);
        (self.above[middle as usize], self.below[to]) = (right, middle);
        Some(middle)
    }
}

/// At first at most every 16th speed is followed, and at least so many in all.
const COARSEST: usize = 16;
const DENSE: usize = 512;
