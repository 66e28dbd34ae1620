//! The graph of the lift-off map.

use passive_hopper::LiftOffMap;

/// The graph of `map` between neighbouring `cuts`, as pieces of `count` + 1 points each.
///
/// Where the hopper is grounded there is no graph.
pub(super) fn graph_pieces(map: &LiftOffMap, cuts: &[f64], count: usize) -> Vec<Vec<(f64, f64)>> {
    journal_figures::graph_pieces(|alpha| map.image(alpha).ok().flatten(), cuts, count)
}
