//! The guards of each mode of a model, in the order in which they were added.

use crate::error::Error;
use crate::guard::{Guard, Role};
use std::fmt::Debug;

/// The guards of each mode.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GuardLists<M, S> {
    /// Modes with guards of their own. Their lists contain the guards of all modes too.
    modes: Vec<(M, Vec<Guard<S>>)>,
    /// The guards of every other mode.
    elsewhere: Vec<Guard<S>>,
    /// Surfaces that have several guard functions, in different modes.
    repeated: Vec<S>,
    /// The guard that was added last: its mode, or `None` for all modes, and its surface.
    last: Option<(Option<M>, S)>,
    /// A role was declared before any guard.
    nothing_declared: bool,
    /// The first surface with two guards in one mode.
    doubled: Option<S>,
    /// The first clock that has a guard function instead of times.
    timeless: Option<S>,
}

impl<M: Copy + Eq, S: Copy + Eq + Debug> GuardLists<M, S> {
    pub(super) const fn new() -> Self {
        GuardLists {
            modes: Vec::new(),
            elsewhere: Vec::new(),
            repeated: Vec::new(),
            last: None,
            nothing_declared: false,
            doubled: None,
            timeless: None,
        }
    }

    /// Adds a guard to one mode, or to all modes for `None`.
    pub(super) fn add(&mut self, mode: Option<M>, guard: Guard<S>) {
        self.last = Some((mode, guard.surface));
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

    /// Adds a guard that has a function, likewise.
    pub(super) fn add_watched(&mut self, mode: Option<M>, guard: Guard<S>) {
        self.note_clock(guard);
        self.add(mode, guard);
    }

    /// Adds an observer to all modes.
    pub(super) fn add_observer(&mut self, guard: Guard<S>) {
        self.note_clock(guard);
        self.add(None, guard.crossing());
    }

    /// Gives the guard that was added last this role.
    pub(super) fn declare_last(&mut self, role: Role) {
        let Some((mode, surface)) = self.last else {
            self.nothing_declared = true;
            return;
        };
        self.declare(mode, surface, role);
    }

    /// Gives the guards of a surface this role, in one mode, or in all modes for `None`.
    pub(super) fn declare(&mut self, mode: Option<M>, surface: S, role: Role) {
        let lists = self
            .modes
            .iter_mut()
            .filter(|(listed, _)| mode.is_none_or(|mode| mode == *listed))
            .map(|(_, list)| list);
        let elsewhere = mode.is_none().then_some(&mut self.elsewhere);
        for guard in lists.chain(elsewhere).flatten() {
            if guard.surface == surface && guard.role != Role::Clock {
                guard.role = role;
            }
        }
    }

    /// A clock has times, and no function.
    fn note_clock(&mut self, guard: Guard<S>) {
        if guard.role == Role::Clock {
            self.timeless.get_or_insert(guard.surface);
        }
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

    /// An error if a surface has two guards in one mode, whose resets could not be told apart, and for a clock without
    /// times.
    #[inline]
    pub(super) fn check(&self) -> Result<(), Error> {
        let name = |surface: S| format!("{surface:?}");
        if self.nothing_declared {
            let part = "a contact or a crossing before any guard";
            return Err(Error::NoSuchGuard { part, surface: "none".into() });
        }
        match (self.doubled, self.timeless) {
            (Some(surface), _) => Err(Error::SurfaceTwice { surface: name(surface) }),
            (None, Some(surface)) => Err(Error::ClockWithoutTimes { surface: name(surface) }),
            (None, None) => Ok(()),
        }
    }

    /// True if a mode has a guard of this surface.
    pub(super) fn contains(&self, surface: S) -> bool {
        self.surfaces().any(|listed| listed == surface)
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
