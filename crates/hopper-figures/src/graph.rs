//! The graph of the lift-off map.

use passive_hopper::{LiftOffMap, alpha_star};
use std::f64::consts::PI;

/// The speed at which drawings begin instead of 0, which is not a lift-off speed. On the page it is 0.
const FIRST_SPEED: f64 = 1e-3;

/// The graph of `map` between neighbouring `cuts`, as pieces of `count` + 1 points each.
///
/// Where the hopper is grounded there is no graph.
pub fn graph_pieces(map: &LiftOffMap, cuts: &[f64], count: usize) -> Vec<Vec<(f64, f64)>> {
    journal_figures::graph_pieces(|alpha| map.image(alpha).ok().flatten(), cuts, count)
}

/// The points where pieces of the map meet, up to α*_n: nπ and α*_n. The first piece begins at 10⁻³ instead of 0,
/// which is not a lift-off speed.
pub fn cuts(n: u64) -> Vec<f64> {
    let mut cuts = vec![FIRST_SPEED];
    for k in 1..=n {
        cuts.extend([k as f64 * PI, alpha_star(k)]);
    }
    cuts
}
