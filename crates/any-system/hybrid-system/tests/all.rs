//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs, clippy::disallowed_methods, clippy::panic, clippy::unwrap_used)]

mod bounds_given;
mod certain_events;
mod checkpoint;
mod clocks;
mod cradles;
mod ends_of_arcs;
mod exponential_guards;
mod instant_derivatives;
mod integrated_events;
mod integrated_modes;
mod integration;
mod jumps_and_stops;
mod known_answers;
mod many_states;
mod model;
mod observers;
mod order_of_contacts;
mod order_of_events;
mod own_search;
mod parameter_sensitivity;
mod peer_events;
mod peer_scene;
mod planted_roots;
mod semantics;
mod semantics_observers;
mod sensitivity;
mod simultaneous;
mod sliding;
mod sliding_derivatives;
mod sliding_detection;
mod sliding_surfaces;
mod sliding_undecided;
mod spring_leg;
mod stops_and_levels;
mod stops_beside_events;
mod time_limit;
mod touches;
mod touches_integrated;
mod trajectory;
mod two_sided;
mod zeno;
mod zeno_integrated;
mod zeno_series;
