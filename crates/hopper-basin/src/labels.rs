//! The fates of many lift-off speeds at one mass ratio, hop by hop together.

use crate::arcs::Arcs;
use crate::itinerary::Itinerary;
use crate::ladder::Ladder;
use crate::orbits::Orbits;
use crate::{Fates, HopperFate};

/// Speeds in increasing order are first looked at so far apart.
const COARSEST: usize = 16;

/// Fewer speeds are all followed: there is little between them that has a common itinerary.
const MANY: usize = 20;

/// Not labelled yet; what stays so is undecided.
const OPEN: u16 = HopperFate::UNDECIDED;

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, those that [`fate`](Self::fate) gives one
    /// by one; a speed that it refuses has the label of an undecided hop.
    ///
    /// The orbits hop together, as [`LiftOffMap::images`](passive_hopper::LiftOffMap::images) does. Of speeds in
    /// increasing order not all are followed: what lies between two orbits that visit the same arcs of the map, on
    /// which it is proved to be monotone, ends as they do.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60]), [1, HopperFate::Decaying.label()]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    pub fn labels(&self, speeds: &[f64]) -> Vec<u16> {
        let mut labels = vec![OPEN; speeds.len()];
        let largest = speeds.iter().fold(0.0, |a: f64, &b| if b > a { b } else { a });
        let Ok(ladder) = Ladder::below(self, largest) else {
            return speeds.iter().map(|&speed| self.label_of(speed)).collect();
        };
        let many = speeds.len() >= MANY && speeds.is_sorted();
        match many.then(|| Arcs::below(self.map().mass_ratio(), largest)) {
            Some(Ok(Some(arcs))) => {
                Column { fates: self, ladder: &ladder, arcs: &arcs, speeds }.label(&mut labels);
            }
            _ => {
                let mut orbits = Orbits::new(self, &ladder, speeds, ());
                orbits.add(0..speeds.len() as u32, &mut labels, &mut []);
                while !orbits.is_empty() {
                    orbits.hop(&(), &mut labels, &mut []);
                }
            }
        }
        labels
    }

    /// The label of one fate.
    pub(crate) fn label_of(&self, alpha: f64) -> u16 {
        self.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
    }
}

/// Speeds in increasing order: what lies between two with a common itinerary needs no orbit of its own.
struct Column<'a> {
    fates: &'a Fates,
    ladder: &'a Ladder,
    arcs: &'a Arcs,
    speeds: &'a [f64],
}

impl Column<'_> {
    /// First every 16th, then, as soon as its ends are known, the middle of what is open.
    fn label(&self, labels: &mut [u16]) {
        let last = self.speeds.len().saturating_sub(1) as u32;
        let coarse: Vec<u32> = (0..last).step_by(COARSEST).chain([last]).collect();
        let mut gaps = Gaps::between(&coarse, self.speeds.len());
        let mut orbits = Orbits::new(self.fates, self.ladder, self.speeds, Itinerary::START);
        orbits.add(coarse.into_iter(), labels, &mut gaps.notes);
        let mut ended = Vec::new();
        loop {
            while !orbits.ended.is_empty() {
                std::mem::swap(&mut ended, &mut orbits.ended);
                let middles = gaps.narrow(&ended, labels);
                orbits.add(middles.into_iter(), labels, &mut gaps.notes);
                ended.clear();
            }
            if orbits.is_empty() {
                break;
            }
            orbits.hop(self.arcs, labels, &mut gaps.notes);
        }
    }
}

/// The gaps between the speeds whose orbits are followed.
struct Gaps {
    notes: Vec<Itinerary>,
    /// For a speed that is followed the next ones below and above that are.
    below: Vec<u32>,
    above: Vec<u32>,
}

impl Gaps {
    fn between(followed: &[u32], count: usize) -> Self {
        let mut gaps = Gaps {
            notes: vec![Itinerary::START; count],
            below: (0..count as u32).collect(),
            above: (0..count as u32).collect(),
        };
        for pair in followed.windows(2) {
            gaps.join(pair[0], pair[1]);
        }
        gaps
    }

    fn join(&mut self, left: u32, right: u32) {
        self.above[left as usize] = right;
        self.below[right as usize] = left;
    }

    /// Of the gaps beside those that have `ended`, fills the closed ones and halves the open ones; the middles.
    fn narrow(&mut self, ended: &[u32], labels: &mut [u16]) -> Vec<u32> {
        let mut middles = Vec::new();
        for &at in ended {
            for (left, right) in [(self.below[at as usize], at), (at, self.above[at as usize])] {
                middles.extend(self.halved(left, right, labels));
            }
        }
        middles
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
        self.join(left, middle);
        self.join(middle, right);
        Some(middle)
    }
}
