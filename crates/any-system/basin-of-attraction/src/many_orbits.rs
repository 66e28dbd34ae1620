//! Many orbits: in parallel, and some at a time where a map moves them together.

use crate::state_map::StateMap;
use rayon::prelude::*;

/// An orbit that is followed until it has ended.
pub(crate) trait FollowedOrbit {
    /// What its end says.
    type End;

    /// Begins at another start.
    fn restart(&mut self, start: &[f64]);

    /// Looks at the point where it is; `None` if it is to be moved by a step.
    fn see(&mut self) -> Option<Self::End>;

    /// Where it is, to be moved.
    fn at(&mut self) -> &mut [f64];

    /// Notes that it was moved, or that the map had no value.
    fn moved(&mut self, has_image: bool);
}

/// Orbits that are moved together: enough for maps that compute eight at a time while some of them take longer.
const TOGETHER: usize = 64;

/// Starts that one thread takes at once, so that threads share the work evenly.
const BLOCK: usize = 1024;

/// Follows so many orbits to their ends. `orbit` makes memory for one, and `start` writes the start with a number.
pub(crate) fn follow_many<O: FollowedOrbit>(
    map: &dyn StateMap,
    dimension: usize,
    count: usize,
    orbit: impl Fn() -> O + Sync,
    start: impl Fn(usize, &mut [f64]) + Sync,
) -> Vec<O::End>
where
    O::End: Send,
{
    let blocks = (0..count.div_ceil(BLOCK)).into_par_iter();
    let follow = |block: usize| {
        let first = BLOCK * block;
        let ends = follow_block(map, dimension, BLOCK.min(count - first), &orbit, |k, state| {
            start(first + k, state);
        });
        ends.into_iter().flatten().collect::<Vec<_>>()
    };
    blocks.flat_map_iter(follow).collect()
}

fn follow_block<O: FollowedOrbit>(
    map: &dyn StateMap,
    dimension: usize,
    count: usize,
    orbit: impl Fn() -> O,
    start: impl Fn(usize, &mut [f64]),
) -> Vec<Option<O::End>> {
    let mut ends: Vec<Option<O::End>> = (0..count).map(|_| None).collect();
    let mut state = vec![0.0; dimension];
    let mut waiting = 0..count;
    // Writes the next start; `None` after the last one.
    let mut next = |orbit: &mut O| {
        let number = waiting.next()?;
        start(number, &mut state);
        orbit.restart(&state);
        Some(number)
    };
    let begin = |_| {
        let mut orbit = orbit();
        next(&mut orbit).map(|number| (orbit, number))
    };
    let mut followed: Vec<(O, usize)> = (0..TOGETHER).map_while(begin).collect();
    let mut columns = vec![vec![0.0; followed.len()]; dimension];
    let mut has_image = vec![false; followed.len()];
    while !followed.is_empty() {
        followed.retain_mut(|(orbit, number)| {
            // Until an orbit is to be moved, or no start is left for its memory.
            while let Some(end) = orbit.see() {
                ends[*number] = Some(end);
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
            column.iter_mut().zip(&mut followed).for_each(|(x, (orbit, _))| *x = orbit.at()[k]);
        }
        map.images(&mut columns, &mut has_image);
        for (place, (orbit, _)) in followed.iter_mut().enumerate() {
            let at = orbit.at().iter_mut().zip(&columns);
            at.for_each(|(x, column)| *x = column[place]);
            orbit.moved(has_image[place]);
        }
    }
    ends
}
