//! Many orbits: in parallel, and some at a time where a map moves them together.

use crate::attractors::state_map::{Moving, StateMap};
use rayon::prelude::*;

/// An orbit that is followed until it has ended.
pub(crate) trait FollowedOrbit {
    /// What its end says.
    type End;

    /// Looks at the point where it is; `None` if it is to be moved by a step.
    fn see(&mut self) -> Option<Self::End>;

    /// Where it is, to be moved.
    fn point(&mut self) -> &mut Moving;

    /// The steps to the next point that needs a look: at least one.
    fn steps(&self) -> usize {
        1
    }

    /// Notes that it was moved by so many steps, or that the map had no value at the last one.
    fn moved(&mut self, steps: usize, has_image: bool);

    /// Follows it alone to its end.
    fn follow(&mut self, map: &dyn StateMap) -> Self::End {
        loop {
            if let Some(end) = self.see() {
                return end;
            }
            let steps = self.steps();
            let has_image = self.point().advance(map, steps);
            self.moved(steps, has_image);
        }
    }
}

/// The most starts that one thread takes at once, and the fewest parts of the work: threads share it evenly.
const MOST: usize = 1024;
const PARTS: usize = 8;

/// Gives each of many orbits its end, in parallel: `follow` gets parts of them, each with the number of its first one.
pub(crate) fn in_parts<E: Send>(ends: &mut [E], follow: impl Fn(usize, &mut [E]) + Sync) {
    let part = ends.len().div_ceil(PARTS).clamp(1, MOST);
    let parts = ends.par_chunks_mut(part).enumerate();
    parts.for_each(|(number, ends)| follow(part * number, ends));
}

/// Follows orbits, and gives each its end. `orbit` makes memory for one, and `begin` lets it be the orbit with a number.
pub(crate) fn follow_some<O: FollowedOrbit>(
    map: &dyn StateMap,
    dimension: usize,
    orbit: impl Fn() -> O,
    begin: impl Fn(usize, &mut O),
    ends: &mut [O::End],
) {
    match map.together() {
        0 | 1 => follow_alone(map, orbit, begin, ends),
        together => follow_together(map, dimension, together, orbit, begin, ends),
    }
}

/// One orbit after the other.
fn follow_alone<O: FollowedOrbit>(
    map: &dyn StateMap,
    orbit: impl Fn() -> O,
    begin: impl Fn(usize, &mut O),
    ends: &mut [O::End],
) {
    let mut orbit = orbit();
    for (number, end) in ends.iter_mut().enumerate() {
        begin(number, &mut orbit);
        *end = orbit.follow(map);
    }
}

/// So many orbits at a time.
fn follow_together<O: FollowedOrbit>(
    map: &dyn StateMap,
    dimension: usize,
    together: usize,
    orbit: impl Fn() -> O,
    begin: impl Fn(usize, &mut O),
    ends: &mut [O::End],
) {
    let mut waiting = 0..ends.len();
    // The next orbit; `None` after the last one.
    let mut next = |orbit: &mut O| {
        let number = waiting.next()?;
        begin(number, orbit);
        Some(number)
    };
    let first = |_| {
        let mut orbit = orbit();
        next(&mut orbit).map(|number| (orbit, number))
    };
    let mut followed: Vec<(O, usize)> = (0..together).map_while(first).collect();
    let mut columns = vec![vec![0.0; followed.len()]; dimension];
    let mut has_image = vec![false; followed.len()];
    while !followed.is_empty() {
        followed.retain_mut(|(orbit, number)| {
            // Until an orbit is to be moved, or no start is left for its memory.
            while let Some(end) = orbit.see() {
                ends[*number] = end;
                match next(orbit) {
                    Some(other) => *number = other,
                    None => return false,
                }
            }
            true
        });
        has_image.truncate(followed.len());
        for (k, column) in columns.iter_mut().enumerate() {
            column.truncate(followed.len());
            column
                .iter_mut()
                .zip(&mut followed)
                .for_each(|(x, (orbit, _))| *x = orbit.point().at[k]);
        }
        let steps = followed.iter().map(|(orbit, _)| orbit.steps()).min().unwrap_or(1);
        let steps = map.advance(&mut columns, &mut has_image, steps);
        for (place, (orbit, _)) in followed.iter_mut().enumerate() {
            let at = orbit.point().at.iter_mut().zip(&columns);
            at.for_each(|(x, column)| *x = column[place]);
            orbit.moved(steps, has_image[place]);
        }
    }
}
