//! To which attractor do orbits come, and when: one orbit, many at once, the pixels of a window.

use crate::attractors::first_steps::first_steps;
use crate::attractors::followed_orbit::{End, Orbit, Settled};
use crate::attractors::many_orbits::{FollowedOrbit, follow_some, in_parts};
use crate::attractors::recurrences::Attractors;
use crate::attractors::state_map::{Moving, StateMap, check_map};
use crate::attractors::unmatched::UnmatchedReason;
use crate::error::Error;
use crate::space::label::Label;
use crate::space::raster::{Grid, LabelImage};
use crate::space::value_image::ValueImage;
use crate::space::vectors::check_dimension;

impl Attractors {
    /// The label of the attractor to which the orbit of a point comes; undecided if it comes to none of them.
    ///
    /// The label is the same for each call: no attractor is added. A point of another dimension is undecided.
    /// [`convergences`](Self::convergences) takes less time for many points.
    pub fn label(&self, map: &dyn StateMap, start: &[f64]) -> Label {
        self.convergence(map, start).map_or(Label::UNDECIDED, |(label, _)| label)
    }

    /// The label, and the number of steps after which the orbit is in a cell of the attractor, or has escaped: the time to convergence. Of
    /// an undecided orbit it is the number of steps that were made.
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a point of another dimension.
    pub fn convergence(&self, map: &dyn StateMap, start: &[f64]) -> Result<(Label, usize), Error> {
        let dimension = self.known.dimension();
        check_dimension(start.len(), dimension)?;
        check_map(map, dimension)?;
        let orbit = Orbit::new(&self.known, &self.limits, start);
        Ok(Labelled { attractors: self, map, orbit }.follow(map))
    }

    /// The labels and times of many starts, as [`convergence`](Self::convergence) gives them: in parallel, and some orbits at a time where
    /// the map moves them together. `start` writes the start with a number.
    ///
    /// ```
    /// # use basin_of_attraction::{Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid, array_map};
    /// let cubic = array_map(|[x]| Some([1.5 * x - 0.5 * x * x * x]));
    /// let grid = StateGrid::uniform(Interval::new(-1.7, 1.6)?.try_into()?, 100)?;
    /// let found = Attractors::search(&cubic, grid, &[vec![0.3], vec![-0.3]], RecurrenceLimits::default())?;
    /// let all = found.convergences(&cubic, 1000, |k, state| state[0] = 1e-3 * (k as f64 + 0.5))?;
    /// assert!(all.iter().all(|(label, steps)| *label == Label::from(1) && *steps < 30));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a map of another dimension.
    pub fn convergences(
        &self,
        map: &dyn StateMap,
        count: usize,
        start: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Result<Vec<(Label, usize)>, Error> {
        let dimension = self.known.dimension();
        check_map(map, dimension)?;
        let Attractors { known, limits, .. } = self;
        let orbit = || Labelled {
            attractors: self,
            map,
            orbit: Orbit::new(known, limits, &vec![0.0; dimension]),
        };
        let mut all = vec![(Label::UNDECIDED, 0); count];
        in_parts(&mut all, |first, ends| {
            let start = |k, state: &mut [f64]| start(first + k, state);
            let others = first_steps(map, known, limits, start, ends);
            let begin = |k: usize, own: &mut Labelled<'_>| own.orbit.resume(known, &others[k]);
            let mut later = vec![(Label::UNDECIDED, 0); others.len()];
            follow_some(map, dimension, orbit, begin, &mut later);
            others.iter().zip(later).for_each(|(other, end)| ends[other.number] = end);
        });
        Ok(all)
    }

    /// The labels of the pixels of a window of the plane, in parallel: `state` writes the state for the x and y of a pixel's middle.
    ///
    /// # Errors
    /// [`Error::BadRaster`] as for [`Grid::pixels`]; [`Error::WrongDimension`] for a map of another dimension.
    pub fn raster(
        &self,
        map: &dyn StateMap,
        grid: Grid,
        state: impl Fn(f64, f64, &mut [f64]) + Sync,
    ) -> Result<LabelImage, Error> {
        self.raster_with_times(map, grid, state).map(|(labels, _)| labels)
    }

    /// The labels, and the times of convergence in steps; NaN for undecided pixels.
    ///
    /// # Errors
    /// As [`raster`](Self::raster).
    pub fn raster_with_times(
        &self,
        map: &dyn StateMap,
        grid: Grid,
        state: impl Fn(f64, f64, &mut [f64]) + Sync,
    ) -> Result<(LabelImage, ValueImage<f64>), Error> {
        let pixel = |k: usize, own: &mut [f64]| {
            state(grid.x_at(k % grid.columns), grid.y_at(k / grid.columns), own);
        };
        let found = self.convergences(map, grid.pixels()?, pixel)?;
        let time = |(label, steps): &(Label, usize)| {
            if label.is_undecided() { f64::NAN } else { *steps as f64 }
        };
        let values = found.iter().map(time).collect();
        let labels = found.into_iter().map(|(label, _)| label).collect();
        Ok((LabelImage { grid, labels }, ValueImage { grid, values }))
    }

    /// The label at the end of an orbit at this state; `None` if it moves on, and may come to an attractor.
    fn label_at(&self, map: &dyn StateMap, end: &End, at: &[f64]) -> Option<Label> {
        match end {
            End::Known(own) => Some(self.attractors()[*own].label),
            End::Escaped => Some(Label::ESCAPED),
            End::Unmatched(UnmatchedReason::Stopped) => Some(map.label_of_end(at)),
            End::Settled(Settled { drifts: true, .. }) => None,
            End::Unmatched(_) | End::Budget | End::Settled(_) => Some(Label::UNDECIDED),
        }
    }
}

/// An orbit that comes to an attractor, or to none.
struct Labelled<'a> {
    attractors: &'a Attractors,
    map: &'a dyn StateMap,
    orbit: Orbit,
}

impl FollowedOrbit for Labelled<'_> {
    type End = (Label, usize);

    fn see(&mut self) -> Option<(Label, usize)> {
        let Attractors { known, limits, .. } = self.attractors;
        while let Some(end) = self.orbit.see(known, limits) {
            if let Some(label) = self.attractors.label_at(self.map, &end, self.orbit.at()) {
                return Some((label, self.orbit.steps()));
            }
            self.orbit.go_on();
        }
        None
    }

    fn point(&mut self) -> &mut Moving {
        self.orbit.point()
    }

    fn moved(&mut self, _: usize, has_image: bool) {
        self.orbit.moved(&self.attractors.known, has_image);
    }
}
