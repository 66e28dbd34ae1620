//! The guards of the modes of a system that makes its lists when they are asked for.

use crate::guard::Guard;
use std::sync::OnceLock;

/// The guards of the modes that have been asked for.
///
/// A list that only grows: a reference into it stays valid while other modes are added. It has one entry for each mode
/// that an execution has visited.
pub(crate) struct GuardTable<M, S> {
    entry: OnceLock<Box<Entry<M, S>>>,
}

struct Entry<M, S> {
    mode: M,
    guards: Vec<Guard<S>>,
    rest: GuardTable<M, S>,
}

impl<M: Copy + Eq, S> GuardTable<M, S> {
    pub(crate) const fn new() -> Self {
        GuardTable { entry: OnceLock::new() }
    }

    /// The guards of `mode`, made at the first call.
    pub(crate) fn guards(&self, mode: M, make: impl Fn() -> Vec<Guard<S>>) -> &[Guard<S>] {
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
        let guard = Guard::rising;
        let first = table.guards(1, || vec![guard(1)]);
        for mode in 2..200_000 {
            table.guards(mode % 100, || vec![guard(2)]);
        }
        let again = table.guards(1, || vec![guard(3)]);
        assert_eq!((first, again), (&[guard(1)][..], &[guard(1)][..]));
    }

    #[test]
    fn a_long_list_is_dropped_without_a_deep_stack() {
        let table: GuardTable<u32, u8> = GuardTable::new();
        let mut last = &table;
        for mode in 0..200_000 {
            let entry = Entry { mode, guards: Vec::new(), rest: GuardTable::new() };
            last = &last.entry.get_or_init(|| Box::new(entry)).rest;
        }
        drop(table);
    }
}
