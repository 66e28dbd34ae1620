//! Columns side by side, their orbits hopping together.
//!
//! ```text
//!   hump by hump from below
//!     every so many-th speed is followed
//!     as soon as two neighbours have come to their ends
//!       with a common itinerary      all between them is labelled as they are
//!       else                         the middle is followed
//!     what is between such neighbours is known to orbits that come down to it
//! ```
//!
//! Several columns, because the hops of one are too few to fill the vectors of a processor.

use crate::column::Column;
use crate::itinerary::Itinerary;
use crate::known::Spacing;
use crate::{Error, Fates};
use passive_hopper::{LiftOffMap, alpha_star, index_below};
use std::ops::Range;

/// At first every 16th speed is followed.
const COARSEST: usize = 16;

/// Of a column's speeds there are so many times fewer below it, for orbits that come down.
const LOWER: usize = 8;

/// A speed that is followed.
#[derive(Debug, Clone, Copy)]
struct Start {
    column: u32,
    at: u32,
    /// The next speeds that are followed below and above; itself if there is none.
    left: u32,
    right: u32,
}

/// Orbits that have not come to their ends.
#[derive(Default)]
struct Orbits<'a> {
    starts: Vec<Start>,
    /// Map and speed.
    hops: Vec<(&'a LiftOffMap, Option<f64>)>,
    /// Where they were.
    before: Vec<f64>,
    notes: Vec<Itinerary>,
    /// Hops of the oldest.
    count: usize,
    /// Those that have come to their ends since this was last emptied.
    ended: Vec<(Start, Itinerary)>,
}

struct Strip<'a> {
    columns: Vec<Column<'a>>,
    speeds: Vec<f64>,
    spacing: Spacing,
    orbits: Orbits<'a>,
}

/// The labels of `speeds` > 0, in increasing order, at every mass ratio.
pub(crate) fn labels(all: &[&Fates], speeds: &[f64]) -> Result<Vec<Vec<u16>>, Error> {
    let (speeds, lower) = from_zero(speeds);
    let spacing = Spacing::of(&speeds, lower);
    let columns = all.iter().map(|fates| Column::new(fates, &speeds)).collect::<Result<_, _>>()?;
    let mut strip = Strip { columns, speeds, spacing, orbits: Orbits::default() };
    strip.label()?;
    Ok(strip.columns.into_iter().map(|mut column| column.labels.split_off(lower)).collect())
}

/// `speeds`, and before them fewer from 0 up; and how many these are.
fn from_zero(speeds: &[f64]) -> (Vec<f64>, usize) {
    let first = speeds.first().copied().unwrap_or(0.0);
    let count = speeds.len() / LOWER;
    let lower = (0..count).map(|k| first * (k as f64 + 0.5) / count as f64);
    (lower.chain(speeds.iter().copied()).collect(), count)
}

impl Strip<'_> {
    fn label(&mut self) -> Result<(), Error> {
        let count = self.speeds.len();
        let last = self.speeds.last().map_or(Ok(0), |&speed| index_below(speed))?;
        let with_arcs = self.columns.iter().any(|column| column.arcs.is_some());
        let mut first = 0;
        // Without arcs there are no intervals to wait for.
        for n in 0..=if with_arcs { last } else { 0 } {
            let star = alpha_star(n + 1).high;
            let end = if n == last || !with_arcs {
                count
            } else {
                first + self.speeds[first..].partition_point(|&speed| speed < star)
            };
            self.label_hump(first..end);
            first = end;
        }
        Ok(())
    }

    fn label_hump(&mut self, hump: Range<usize>) {
        self.orbits.count = 0;
        for column in 0..self.columns.len() {
            self.add_first(column, &hump);
        }
        self.sort_out(0);
        loop {
            self.narrow();
            if self.orbits.starts.is_empty() {
                break;
            }
            self.hop();
        }
        for column in self.columns.iter_mut().filter(|column| column.arcs.is_some()) {
            column.keep(hump.clone(), &self.speeds);
        }
    }

    /// The first speeds of a column that are followed: all of them where no arcs are known.
    fn add_first(&mut self, column: usize, hump: &Range<usize>) {
        if hump.is_empty() {
            return;
        }
        let (first, last) = (hump.start as u32, hump.end as u32 - 1);
        if self.columns[column].arcs.is_none() {
            for at in first..=last {
                self.add(Start { column: column as u32, at, left: at, right: at });
            }
            return;
        }
        let mut left = first;
        let mut at = first;
        loop {
            let right = (at + COARSEST as u32).min(last);
            self.add(Start { column: column as u32, at, left, right });
            if at == last {
                break;
            }
            (left, at) = (at, right);
        }
    }

    fn add(&mut self, start: Start) {
        let column = &self.columns[start.column as usize];
        self.orbits.starts.push(start);
        self.orbits.hops.push((column.fates.map(), Some(self.speeds[start.at as usize])));
        self.orbits.before.push(f64::NAN); // nowhere before: no number equals it
        self.orbits.notes.push(Itinerary::START);
    }

    /// Takes all one hop on; those that come to an end are labelled.
    fn hop(&mut self) {
        let Orbits { starts, hops, before, notes, count, .. } = &mut self.orbits;
        before.clear();
        before.extend(hops.iter().map(|hop| hop.1.unwrap_or(f64::NAN)));
        // Those with an error keep their speeds, and are sorted out one by one.
        let _ = LiftOffMap::images_of_each(hops);
        for ((start, note), (&alpha, hop)) in
            starts.iter().zip(notes.iter_mut()).zip(before.iter().zip(hops.iter()))
        {
            match &self.columns[start.column as usize].arcs {
                Some(arcs) => note.hop(alpha, hop.1, arcs, hop.0),
                None => note.give_up(),
            }
        }
        *count += 1;
        self.sort_out(0);
    }

    /// From orbit `first` on: labels those that have come to an end, and keeps the others.
    fn sort_out(&mut self, first: usize) {
        let Orbits { starts, hops, before, notes, count, ended } = &mut self.orbits;
        let mut kept = first;
        for from in first..starts.len() {
            let (start, hop) = (starts[from], hops[from]);
            let at = start.at as usize;
            let column = &mut self.columns[start.column as usize];
            let way = (self.speeds[at], before[from], hop.1);
            if let Some((label, known)) = column.end(way, *count, &self.spacing) {
                column.labels[at] = label;
                let mut note = notes[from];
                match (hop.1, known) {
                    (Some(alpha), Some(known)) => note.end_in(alpha, &known),
                    (Some(_), None) => note.give_up(),
                    (None, _) => {}
                }
                ended.push((start, note));
            } else {
                (starts[kept], hops[kept], notes[kept]) = (start, hop, notes[from]);
                kept += 1;
            }
        }
        starts.truncate(kept);
        hops.truncate(kept);
        before.truncate(kept);
        notes.truncate(kept);
    }

    /// Looks at the gaps beside those that have ended, until only orbits on their way are left.
    fn narrow(&mut self) {
        while !self.orbits.ended.is_empty() {
            let mut ended = std::mem::take(&mut self.orbits.ended);
            let first = self.orbits.starts.len();
            for (start, note) in ended.drain(..) {
                let Start { column, at, left, right } = start;
                self.columns[column as usize].finish(at as usize, note);
                for (left, right) in [(left, at), (at, right)] {
                    let gap = (left as usize, right as usize);
                    if left < right
                        && let Some(middle) = self.columns[column as usize].narrow(gap.0, gap.1)
                    {
                        self.add(Start { column, at: middle as u32, left, right });
                    }
                }
            }
            self.orbits.ended = ended;
            self.sort_out(first);
        }
    }
}
