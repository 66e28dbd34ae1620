//! The guards of each mode of a model, in the order in which they were added.

use crate::error::Error;
use crate::guard::Guard;
use std::fmt::Debug;

/// The guards of each mode.
#[derive(Debug, Clone)]
pub(super) struct GuardLists<M, S> {
    /// Modes with guards of their own. Their lists contain the guards of all modes too.
    modes: Vec<(M, Vec<Guard<S>>)>,
    /// The guards of every other mode.
    elsewhere: Vec<Guard<S>>,
    /// Surfaces that have several guard functions, in different modes.
    repeated: Vec<S>,
    /// The first surface with two guards in one mode.
    doubled: Option<S>,
}

impl<M: Copy + Eq, S: Copy + Eq + Debug> GuardLists<M, S> {
    pub(super) const fn new() -> Self {
        GuardLists { modes: Vec::new(), elsewhere: Vec::new(), repeated: Vec::new(), doubled: None }
    }

    /// Adds a guard to one mode, or to all modes for `None`.
    pub(super) fn add(&mut self, mode: Option<M>, guard: Guard<S>) {
        let known = self.surfaces().any(|surface| surface == guard.surface);
        if known && !self.repeated.contains(&guard.surface) {
            self.repeated.push(guard.surface);
        }
        let Some(mode) = mode else {
            for list in self.modes.iter_mut().map(|(_, list)| list).chain([&mut self.elsewhere]) {
                Self::push(list, guard, &mut self.doubled);
            }
            return;
        };
        let place = self.modes.iter().position(|(listed, _)| *listed == mode);
        let place = place.unwrap_or_else(|| {
            self.modes.push((mode, self.elsewhere.clone()));
            self.modes.len() - 1
        });
        Self::push(&mut self.modes[place].1, guard, &mut self.doubled);
    }

    fn push(list: &mut Vec<Guard<S>>, guard: Guard<S>, doubled: &mut Option<S>) {
        if list.iter().any(|listed| listed.surface == guard.surface) {
            doubled.get_or_insert(guard.surface);
        }
        list.push(guard);
    }

    /// The guards of `mode`.
    #[inline]
    pub(super) fn of(&self, mode: M) -> &[Guard<S>] {
        let own = self.modes.iter().find(|(listed, _)| *listed == mode);
        own.map_or(&self.elsewhere, |(_, list)| list)
    }

    /// Surfaces that have several guard functions.
    #[inline]
    pub(super) fn repeated(&self) -> &[S] {
        &self.repeated
    }

    /// An error if a surface has two guards in one mode: their resets could not be told apart.
    #[inline]
    pub(super) fn check(&self) -> Result<(), Error> {
        match self.doubled {
            Some(surface) => Err(Error::SurfaceTwice { surface: format!("{surface:?}") }),
            None => Ok(()),
        }
    }

    /// The number of guards that were added, those of all modes counted once.
    pub(super) fn next_index(&self) -> usize {
        let own =
            self.modes.iter().map(|(_, list)| list.len() - self.elsewhere.len()).sum::<usize>();
        own + self.elsewhere.len()
    }

    fn surfaces(&self) -> impl Iterator<Item = S> {
        let lists = self.modes.iter().map(|(_, list)| list).chain([&self.elsewhere]);
        lists.flatten().map(|guard| guard.surface)
    }
}
