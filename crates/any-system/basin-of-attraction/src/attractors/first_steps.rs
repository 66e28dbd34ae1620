//! The first steps of many orbits, column by column: most orbits have come to a known attractor by then.
//!
//! Where the cells of the attractors have a table and equal lengths, no branch depends on where an orbit is. The processor does not foresee this, and a wrong
//! guess takes as long as some steps of a simple map.

use crate::attractors::followed_orbit::UNTRACKED;
use crate::attractors::known_cells::KnownCells;
use crate::attractors::recurrence_limits::RecurrenceLimits;
use crate::attractors::state_map::StateMap;
use crate::space::label::Label;
use std::hint::select_unpredictable;

/// An orbit that goes on.
pub(crate) struct Unended {
    pub(crate) number: usize,
    pub(crate) at: Vec<f64>,
    pub(crate) steps: usize,
    /// Steps outside the region since it was inside.
    pub(crate) outside: usize,
}

/// Orbits that have not ended, by columns: fewer than 2³², for fewer than 2¹⁶ steps.
struct Followed {
    numbers: Vec<u32>,
    columns: Vec<Vec<f64>>,
    /// Steps outside the region since it was inside.
    outside: Vec<u16>,
    has_image: Vec<bool>,
    /// Memory of a look.
    cells: Vec<f64>,
    labels: Vec<Label>,
    sizes: Vec<f64>,
    kept: Vec<u32>,
}

impl Followed {
    fn new(columns: Vec<Vec<f64>>, count: usize) -> Followed {
        Followed {
            numbers: (0..count as u32).collect(),
            columns,
            outside: vec![0; count],
            has_image: vec![true; count],
            cells: Vec::new(),
            labels: Vec::new(),
            sizes: Vec::new(),
            kept: vec![0; count],
        }
    }

    /// Looks at all orbits after so many steps, and keeps those that have not ended. The ends of these are provisional.
    fn look(
        &mut self,
        (map, known): (&dyn StateMap, &KnownCells),
        escape: f64,
        steps: usize,
        ends: &mut [(Label, usize)],
    ) {
        known.labels_of_columns(&self.columns, &mut self.cells, &mut self.labels);
        self.measure();
        let mut kept = 0;
        let each = self.numbers.iter().zip(&self.has_image).zip(&self.labels).zip(&self.sizes);
        for (lane, (((&number, &has_image), &label), &size)) in each.enumerate() {
            let end = select_unpredictable(size > escape, Label::ESCAPED, label);
            let is_stopped = !has_image | !(size < f64::INFINITY);
            let end = select_unpredictable(is_stopped, Label::UNDECIDED_MAP, end);
            // A step without a value is none.
            ends[number as usize] = (end, steps - usize::from(!has_image));
            self.kept[kept] = lane as u32;
            kept += usize::from((end == Label::UNDECIDED) | (end == Label::OUTSIDE));
        }
        self.label_ends(map, ends);
        for (outside, label) in self.outside.iter_mut().zip(&self.labels) {
            *outside = if *label == Label::OUTSIDE { *outside + 1 } else { 0 };
        }
        self.keep(kept);
    }

    /// The labels of those that have no image.
    fn label_ends(&self, map: &dyn StateMap, ends: &mut [(Label, usize)]) {
        if !self.has_image.contains(&false) {
            return;
        }
        let stopped = (0..self.numbers.len()).filter(|&lane| !self.has_image[lane]);
        stopped.for_each(|lane| {
            ends[self.numbers[lane] as usize].0 = map.label_of_end(&self.at(lane))
        });
    }

    /// Where an orbit is.
    fn at(&self, lane: usize) -> Vec<f64> {
        self.columns.iter().map(|column| column[lane]).collect()
    }

    /// The largest absolute value of a coordinate of each; NaN or infinite if one is not finite.
    fn measure(&mut self) {
        self.sizes.clear();
        self.sizes.resize(self.numbers.len(), 0.0);
        for column in &self.columns {
            for (size, x) in self.sizes.iter_mut().zip(column) {
                *size = if *size >= x.abs() { *size } else { x.abs() + 0.0 * *size };
            }
        }
    }

    /// Keeps the first so many of `kept`. All of them have an image.
    fn keep(&mut self, count: usize) {
        fn take<T: Copy>(kept: &[u32], all: &mut Vec<T>) {
            for (place, &lane) in kept.iter().enumerate() {
                all[place] = all[lane as usize];
            }
            all.truncate(kept.len());
        }
        if count < self.numbers.len() {
            let kept = &self.kept[..count];
            take(kept, &mut self.numbers);
            take(kept, &mut self.outside);
            self.columns.iter_mut().for_each(|column| take(kept, column));
        }
        self.has_image.truncate(count);
    }
}

/// The first steps of as many orbits as `ends` has places: the labels and steps of those that end, and the others. `start` writes the start with a number.
///
/// An orbit ends as it would alone: in a cell of a known attractor, beyond the distance of escape, where the map has no value. Recurrences are
/// not looked for so early.
pub(crate) fn first_steps(
    map: &dyn StateMap,
    known: &KnownCells,
    limits: &RecurrenceLimits,
    start: impl Fn(usize, &mut [f64]),
    ends: &mut [(Label, usize)],
) -> Vec<Unended> {
    let mut state = vec![0.0; known.dimension()];
    let mut columns = vec![vec![0.0; ends.len()]; known.dimension()];
    for number in 0..ends.len() {
        start(number, &mut state);
        known.wrap(&mut state);
        columns.iter_mut().zip(&state).for_each(|(column, x)| column[number] = *x);
    }
    // Elsewhere an orbit needs a look at each of its coordinates at each step.
    let steps = match known.is_within(limits.escape) {
        true => UNTRACKED.min(limits.budget / 100).min(limits.lost),
        false => 0,
    };
    let mut followed = Followed::new(columns, ends.len());
    for step in 0..steps {
        followed.look((map, known), limits.escape.unwrap_or(f64::INFINITY), step, ends);
        if followed.numbers.is_empty() {
            break;
        }
        map.images(&mut followed.columns, &mut followed.has_image);
        known.wrap_columns(&mut followed.columns);
    }
    let mut others = Vec::new();
    for (lane, &number) in followed.numbers.iter().enumerate() {
        let (number, at) = (number as usize, followed.at(lane));
        if !followed.has_image[lane] {
            ends[number] = (map.label_of_end(&at), steps - 1);
            continue;
        }
        others.push(Unended { number, at, steps, outside: followed.outside[lane].into() });
    }
    others
}
