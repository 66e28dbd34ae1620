//! The first steps of many orbits, column by column: most orbits have come to a known attractor by then.

use crate::attractors::followed_orbit::UNTRACKED;
use crate::attractors::known_cells::{KnownCells, Place};
use crate::attractors::recurrence_limits::RecurrenceLimits;
use crate::attractors::state_map::StateMap;

/// Orbits after some steps.
pub(crate) struct FirstSteps {
    /// For each orbit its end, and the steps until then, if it has ended.
    pub(crate) ends: Vec<Option<(EarlyEnd, usize)>>,
    /// The others.
    pub(crate) others: Vec<Unended>,
}

/// How an orbit ends before its recurrences are looked for.
#[derive(Clone, Copy)]
pub(crate) enum EarlyEnd {
    /// At the attractor with this index.
    Known(usize),
    Escaped,
    /// The map has no value, or one that is not finite.
    Stopped,
}

/// An orbit that goes on.
pub(crate) struct Unended {
    pub(crate) number: usize,
    pub(crate) at: Vec<f64>,
    pub(crate) steps: usize,
    /// Steps outside the region since it was inside.
    pub(crate) outside: usize,
}

/// Orbits that have not ended, by columns.
struct Followed {
    numbers: Vec<usize>,
    columns: Vec<Vec<f64>>,
    outside: Vec<usize>,
    has_image: Vec<bool>,
}

impl Followed {
    /// Keeps the orbits for which this holds.
    fn retain(&mut self, mut keeps: impl FnMut(&mut Self, usize) -> bool) {
        let mut kept = 0;
        for lane in 0..self.numbers.len() {
            if !keeps(self, lane) {
                continue;
            }
            self.numbers[kept] = self.numbers[lane];
            self.outside[kept] = self.outside[lane];
            self.columns.iter_mut().for_each(|column| column[kept] = column[lane]);
            kept += 1;
        }
        self.numbers.truncate(kept);
        self.outside.truncate(kept);
        self.has_image.truncate(kept);
        self.columns.iter_mut().for_each(|column| column.truncate(kept));
    }
}

/// The first steps of so many orbits. `start` writes the start with a number.
///
/// An orbit ends as it would alone: in a cell of a known attractor, beyond the distance of escape, where the map has no value. Recurrences are
/// not looked for so early.
pub(crate) fn first_steps(
    map: &dyn StateMap,
    known: &KnownCells,
    limits: &RecurrenceLimits,
    count: usize,
    start: impl Fn(usize, &mut [f64]),
) -> FirstSteps {
    let mut state = vec![0.0; known.dimension()];
    let mut columns = vec![vec![0.0; count]; known.dimension()];
    for number in 0..count {
        start(number, &mut state);
        known.wrap(&mut state);
        columns.iter_mut().zip(&state).for_each(|(column, x)| column[number] = *x);
    }
    let mut ends: Vec<Option<(EarlyEnd, usize)>> = vec![None; count];
    let mut followed = Followed {
        numbers: (0..count).collect(),
        columns,
        outside: vec![0; count],
        has_image: vec![true; count],
    };
    // Elsewhere an orbit needs a look at each of its coordinates at each step.
    let steps = match known.is_within(limits.escape) {
        true => UNTRACKED.min(limits.budget / 100).min(limits.lost),
        false => 0,
    };
    let (mut cells, mut places) = (Vec::new(), Vec::new());
    for step in 0..steps {
        known.places(&followed.columns, &mut cells, &mut places);
        followed.retain(|followed, lane| {
            let end = match places[lane] {
                _ if !followed.has_image[lane] => EarlyEnd::Stopped,
                Place::Owned(own) => EarlyEnd::Known(own),
                Place::Inside => {
                    followed.outside[lane] = 0;
                    return true;
                }
                Place::Outside => {
                    let at = || followed.columns.iter().map(|column| column[lane]);
                    let beyond = |escape: f64| at().any(|x| x.abs() > escape);
                    if !at().all(f64::is_finite) {
                        EarlyEnd::Stopped
                    } else if limits.escape.is_some_and(beyond) {
                        EarlyEnd::Escaped
                    } else {
                        followed.outside[lane] += 1;
                        return true;
                    }
                }
            };
            // A step without a value is none.
            let made = step - usize::from(!followed.has_image[lane]);
            ends[followed.numbers[lane]] = Some((end, made));
            false
        });
        if followed.numbers.is_empty() {
            break;
        }
        map.images(&mut followed.columns, &mut followed.has_image);
        known.wrap_columns(&mut followed.columns);
    }
    let mut others = Vec::new();
    for (lane, &number) in followed.numbers.iter().enumerate() {
        if !followed.has_image[lane] {
            ends[number] = Some((EarlyEnd::Stopped, steps - 1));
            continue;
        }
        let at = followed.columns.iter().map(|column| column[lane]).collect();
        others.push(Unended { number, at, steps, outside: followed.outside[lane] });
    }
    FirstSteps { ends, others }
}
