//! Which attractors has a map of several variables, and to which one does an orbit come?
//!
//! `state_map` is the map, which `watched_map` counts and stops, and `state_grid` the cells, along each `axis`, with `grid_distances`. `recurrences` searches: a `followed_orbit` that recurs and passes its `confirmation`
//! is a `candidate`, which `trap_test` tests; its cells are then `known_cells`. `labelled_orbits` come to them, the `first_steps` of many by columns,
//! `many_orbits` side by side. `pilot` suggests the `recurrence_limits`, `unmatched` says why an orbit has no attractor. `known_attractors` are given by points; `box_dimension` is that of an attractor.

pub(crate) mod axis;
pub(crate) mod box_dimension;
pub(crate) mod candidate;
pub(crate) mod confirmation;
pub(crate) mod first_steps;
pub(crate) mod followed_orbit;
pub(crate) mod grid_distances;
pub(crate) mod known_attractors;
pub(crate) mod known_cells;
pub(crate) mod labelled_orbits;
pub(crate) mod many_orbits;
pub(crate) mod pilot;
pub(crate) mod recurrence_limits;
pub(crate) mod recurrences;
pub(crate) mod state_grid;
pub(crate) mod state_map;
pub(crate) mod trap_test;
pub(crate) mod unmatched;
pub(crate) mod watched_map;
