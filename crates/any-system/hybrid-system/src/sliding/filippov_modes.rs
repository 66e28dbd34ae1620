//! The modes and surfaces of a system with sliding modes, and the guards of each mode.

use crate::guard::Guard;
use std::sync::OnceLock;

/// A mode of [`Filippov`](crate::Filippov).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FilippovMode<M, S> {
    /// A mode of the model.
    Free(M),
    /// The state slides along a surface of the model.
    Sliding {
        /// The surface.
        surface: S,
        /// The name of the same surface in the other mode, if the model has two names for it; else `surface` again.
        partner: S,
        /// The mode below the surface, where g < 0.
        below: M,
        /// The mode above it.
        above: M,
    },
}

/// A surface of [`Filippov`](crate::Filippov).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FilippovSurface<M, S> {
    /// A surface of the model.
    Model(S),
    /// The field of `mode` is tangent to `surface`: ∇g·f = 0. The sliding motion leaves the surface there, into
    /// that mode.
    Tangent {
        /// The surface along which the state slides.
        surface: S,
        /// The mode on one of its sides.
        mode: M,
    },
}

type FilippovGuard<M, S> = Guard<FilippovSurface<M, S>>;

/// The guards of the modes that have been asked for.
///
/// A list that only grows: a reference into it stays valid while other modes are added. It has one entry for each mode
/// that an execution has visited.
pub(super) struct GuardTable<M, S> {
    entry: OnceLock<Box<Entry<M, S>>>,
}

struct Entry<M, S> {
    mode: FilippovMode<M, S>,
    guards: Vec<FilippovGuard<M, S>>,
    rest: GuardTable<M, S>,
}

impl<M: Copy + Eq, S: Copy + Eq> GuardTable<M, S> {
    pub(super) const fn new() -> Self {
        GuardTable { entry: OnceLock::new() }
    }

    /// The guards of `mode`, made at the first call.
    pub(super) fn guards(
        &self,
        mode: FilippovMode<M, S>,
        make: impl Fn() -> Vec<FilippovGuard<M, S>>,
    ) -> &[FilippovGuard<M, S>] {
        let mut table = self;
        loop {
            let entry = table
                .entry
                .get_or_init(|| Box::new(Entry { mode, guards: make(), rest: GuardTable::new() }));
            if entry.mode == mode {
                return &entry.guards;
            }
            table = &entry.rest;
        }
    }
}

impl<M, S> Drop for GuardTable<M, S> {
    /// Entry by entry: the compiler's own drop would recurse as deep as the list is long.
    fn drop(&mut self) {
        let mut next = self.entry.take();
        while let Some(mut entry) = next {
            next = entry.rest.entry.take();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guards_are_made_once_and_stay() {
        let table: GuardTable<u32, u8> = GuardTable::new();
        let guard = |surface| Guard::rising(FilippovSurface::Model(surface));
        let first = table.guards(FilippovMode::Free(1), || vec![guard(1)]);
        for mode in 2..200_000 {
            table.guards(FilippovMode::Free(mode % 100), || vec![guard(2)]);
        }
        let again = table.guards(FilippovMode::Free(1), || vec![guard(3)]);
        assert_eq!((first, again), (&[guard(1)][..], &[guard(1)][..]));
    }

    #[test]
    fn a_long_list_is_dropped_without_a_deep_stack() {
        let table: GuardTable<u32, u8> = GuardTable::new();
        let mut last = &table;
        for mode in 0..200_000 {
            let entry = Entry {
                mode: FilippovMode::Free(mode),
                guards: Vec::new(),
                rest: GuardTable::new(),
            };
            last = &last.entry.get_or_init(|| Box::new(entry)).rest;
        }
        drop(table);
    }
}
