//! What each basin has at least of a line of speeds, also where no interval has a label.
//!
//! ```text
//!   a gap [a, b] between intervals, |F′| ≤ D on it:
//!
//!      a              b                  the fate of a speed is that of its image; F = α′² takes every value between F(a) and F(b):
//!      ├──────────────┤                  a basin has at least 1/D of the gap for each of its values there
//!       ╲    F         ╲
//!        ├──●●─────●────┤                what it has of the image is known, since images lie below
//! ```
//!
//! Where F is nearly straight little is lost: what stays unknown is of the size of the square of the gap, where a
//! gap that counts as open leaves all of it (docs/theory.md, Theorem 96).

mod basin_lengths;
mod gaps;

pub(crate) use basin_lengths::BasinLengths;
