//! In which intervals of speeds do orbits stay for ever, and where do these intervals end?
//!
//! The trap of α*_n starts at α*_n and ends where the map first falls to α*_n ([`trap`]).
//! On the contact part of hump n the end is the root of one equation, whose geometry is in [`hump`].
//! For mass ratios up to a crisis the contact part has no such root ([`crisis`]).
//! The end may then lie in the sudden window beyond; a scan finds it ([`immediate_basin`]).
//! The raster needs the traps of many speeds; an index finds them by ⌊α/π⌋ ([`trap_index`]).
//!
//! This room uses the map of `passive-hopper` and no other room of this crate.

pub(crate) mod crisis;
pub(crate) mod hump;
pub(crate) mod immediate_basin;
pub(crate) mod trap;
pub(crate) mod trap_index;
