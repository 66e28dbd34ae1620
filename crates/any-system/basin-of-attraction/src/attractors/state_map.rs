//! What a search for attractors follows: a map of states, and a feature of a stretch of an orbit.
//!
//! Maps are called through a pointer: a search is compiled once, not for each map.

use crate::error::Error;
use crate::space::label::Label;
use crate::space::vectors::check_dimension;

/// A map of states: a map, a return map, or a flow over some time. It is called from several threads.
///
/// Closures `Fn(&[f64]) -> Option<Vec<f64>>` are maps, for any number of coordinates. [`array_map`] makes one of a closure on arrays, which
/// needs no memory for an image.
pub trait StateMap: Sync {
    /// The number of coordinates of a state, if only states of this number have images.
    fn dimension(&self) -> Option<usize> {
        None
    }

    /// Writes the image of a state; `false` where the map has no value. `image` has as many coordinates as `state`.
    fn image(&self, state: &[f64], image: &mut [f64]) -> bool;

    /// The label of an orbit that ends at this state, which has no image. Default: [`Label::UNDECIDED_MAP`], as nothing is known.
    ///
    /// A map that knows more says it here: a runner that has fallen has a fate of its own. Attractors have the numbers from 1 on, so that
    /// numbers from 65 001 on are free.
    ///
    /// ```
    /// use basin_of_attraction::{Attractors, Interval, Label, RecurrenceLimits, StateGrid, StateMap};
    /// struct Half;
    /// impl StateMap for Half {
    ///     fn image(&self, x: &[f64], image: &mut [f64]) -> bool {
    ///         image[0] = x[0] / 2.0;
    ///         x[0] < 1.0
    ///     }
    ///     fn label_of_end(&self, _: &[f64]) -> Label {
    ///         Label::numbered::<65_001>()
    ///     }
    /// }
    /// let grid = StateGrid::uniform(Interval::new(-2.0, 2.0)?.try_into()?, 100)?;
    /// let found = Attractors::search(&Half, grid, &[vec![0.5]], RecurrenceLimits::default())?;
    /// assert_eq!(found.label(&Half, &[-0.7]), Label::from(1));
    /// assert_eq!(found.label(&Half, &[1.5]), Label::numbered::<65_001>());
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    fn label_of_end(&self, state: &[f64]) -> Label {
        let _ = state;
        Label::UNDECIDED_MAP
    }

    /// Moves many states to their images. `states` has a column for each coordinate, and `has_image` says which of them have one. The images
    /// must have the bits of [`image`](Self::image): so a map that computes several at once is free to do so. A map with a
    /// [`label_of_end`](Self::label_of_end) leaves a state without an image where it is.
    ///
    /// Default: one after the other.
    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        let mut point = Moving::from(&vec![0.0; states.len()]);
        for (k, has_image) in has_image.iter_mut().enumerate() {
            point.at.iter_mut().zip(states.iter()).for_each(|(x, column)| *x = column[k]);
            *has_image = self.image(&point.at, &mut point.next);
            if *has_image {
                states.iter_mut().zip(&point.next).for_each(|(column, x)| column[k] = *x);
            }
        }
    }

    /// Moves many states by so many steps, until one of them has no image. The number of steps made, of all of them: `has_image` is that of the last one.
    /// The bits are those of [`images`](Self::images).
    ///
    /// Default: [`step_by_step`].
    fn advance(&self, states: &mut [Vec<f64>], has_image: &mut [bool], steps: usize) -> usize {
        step_by_step(self, states, has_image, steps)
    }

    /// How many orbits are followed together to their ends, by [`images`](Self::images) and [`advance`](Self::advance): the number that takes the least time
    /// for each orbit. Default: one.
    fn together(&self) -> usize {
        1
    }
}

/// [`StateMap::advance`] by [`StateMap::images`].
pub fn step_by_step<M: StateMap + ?Sized>(
    map: &M,
    states: &mut [Vec<f64>],
    has_image: &mut [bool],
    steps: usize,
) -> usize {
    for made in 1..=steps {
        map.images(states, has_image);
        if has_image.contains(&false) {
            return made;
        }
    }
    steps
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>> + Sync> StateMap for F {
    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        let next = self(state).filter(|next| next.len() == image.len());
        next.is_some_and(|next| {
            image.copy_from_slice(&next);
            true
        })
    }
}

/// See [`array_map`].
#[derive(Debug, Clone, Copy)]
pub struct ArrayMap<F, const N: usize>(F);

/// The map of states with N coordinates by a closure on arrays; `None` where it has no value.
///
/// ```
/// use basin_of_attraction::{StateMap, array_map};
/// let henon = array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
/// let mut image = [0.0; 2];
/// assert!(henon.image(&[0.5, 0.1], &mut image) && image[1] == 0.15);
/// ```
pub fn array_map<const N: usize, F>(map: F) -> ArrayMap<F, N>
where
    F: Fn([f64; N]) -> Option<[f64; N]> + Sync,
{
    ArrayMap(map)
}

impl<F: Fn([f64; N]) -> Option<[f64; N]> + Sync, const N: usize> StateMap for ArrayMap<F, N> {
    fn dimension(&self) -> Option<usize> {
        Some(N)
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        let next = <[f64; N]>::try_from(state).ok().and_then(&self.0);
        match next.filter(|_| image.len() == N) {
            Some(next) => {
                image.copy_from_slice(&next);
                true
            }
            None => false,
        }
    }

    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        let Ok(columns) = <&mut [Vec<f64>; N]>::try_from(states) else {
            has_image.fill(false);
            return;
        };
        for (k, has_image) in has_image.iter_mut().enumerate() {
            let next = (self.0)(std::array::from_fn(|axis| columns[axis][k]));
            *has_image = next.is_some();
            if let Some(next) = next {
                columns.iter_mut().zip(next).for_each(|(column, x)| column[k] = x);
            }
        }
    }

    /// A processor computes some images at once, where an orbit alone waits for each of its steps. With 4 the tests of Hénon's attractor take 0.5 of the
    /// time; with 32 a little less, but long orbits are then labelled in 1.2 of theirs, as their visited cells fill the fastest memory.
    fn together(&self) -> usize {
        4
    }
}

/// Numbers that tell attractors apart, made of the successive points of a stretch of an orbit.
pub type OrbitFeature<'a> = dyn Fn(&[Vec<f64>]) -> Vec<f64> + Sync + 'a;

/// An error unless a map takes states with so many coordinates.
pub(crate) fn check_map(map: &dyn StateMap, expected: usize) -> Result<(), Error> {
    map.dimension().map_or(Ok(()), |dimension| check_dimension(dimension, expected))
}

/// An error unless a map and all these states have so many coordinates.
pub(crate) fn check_starts(
    map: &dyn StateMap,
    starts: &[Vec<f64>],
    expected: usize,
) -> Result<(), Error> {
    check_map(map, expected)?;
    starts.iter().try_for_each(|start| check_dimension(start.len(), expected))
}

/// A state that moves, with memory for its image.
#[derive(Debug, Clone)]
pub(crate) struct Moving {
    pub(crate) at: Vec<f64>,
    next: Vec<f64>,
}

impl Moving {
    pub(crate) fn from(start: &[f64]) -> Moving {
        Moving { at: start.to_vec(), next: vec![0.0; start.len()] }
    }

    /// To the image; `false` if there is none, and the state stays.
    pub(crate) fn step(&mut self, map: &dyn StateMap) -> bool {
        let found = map.image(&self.at, &mut self.next);
        if found {
            std::mem::swap(&mut self.at, &mut self.next);
        }
        found
    }

    /// By so many steps, or to where the map has no value: false.
    pub(crate) fn advance(&mut self, map: &dyn StateMap, steps: usize) -> bool {
        if steps == 1 {
            return self.step(map);
        }
        let mut columns: Vec<Vec<f64>> = self.at.iter().map(|x| vec![*x]).collect();
        let mut has_image = [true];
        map.advance(&mut columns, &mut has_image, steps);
        self.at.iter_mut().zip(&columns).for_each(|(x, column)| *x = column[0]);
        has_image[0]
    }
}

/// Finds that an orbit repeats itself to the last bit, within three times its period and what comes before it (R. P. Brent,
/// BIT 20, 176, 1980).
#[derive(Debug, Default)]
pub(crate) struct Repeats {
    anchor: Vec<f64>,
    points: usize,
    /// The number of the anchor.
    anchored: usize,
}

impl Repeats {
    /// The period, if the orbit was at this point before. The points of one orbit are given one after the other.
    #[inline]
    pub(crate) fn see(&mut self, at: &[f64]) -> Option<usize> {
        self.points += 1;
        if self.anchored > 0 && self.anchor == at {
            return Some(self.points - self.anchored);
        }
        if self.points.is_power_of_two() {
            self.anchor.clear();
            self.anchor.extend_from_slice(at);
            self.anchored = self.points;
        }
        None
    }

    /// Whether it has seen no point.
    pub(crate) fn is_new(&self) -> bool {
        self.points == 0
    }

    /// Begins with another orbit.
    pub(crate) fn forget(&mut self) {
        (self.points, self.anchored) = (0, 0);
    }
}
