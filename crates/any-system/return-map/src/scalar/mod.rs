//! What does a map of one variable look like?
//!
//! `pieces` has its domain, by `samples`, its smooth pieces with their borders, and its laps (`extrema`). `cells` are polynomials on intervals, and
//! `approximate_map` is a map by such ones: fast, with inverse branches and compositions, saved and read. `fixed_point` finds fixed points that
//! samples reveal, `all_periodic` all of them with proofs, `stability` from which side they attract.

mod all_periodic;
mod approximate_map;
mod cells;
mod extrema;
mod fixed_point;
mod pieces;
mod samples;
mod stability;

pub use all_periodic::{AllPeriodicPoints, ProvedPoint, all_equilibria, all_periodic_points};
pub use approximate_map::ApproximateMap;
pub use extrema::Extremum;
pub use fixed_point::{FixedPoint, Intersection, fixed_points};
pub use pieces::{MapGap, MapPiece, MapPieces, map_pieces};
pub use stability::{OneSidedStability, Side, Stability, one_sided_stability};
