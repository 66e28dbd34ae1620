//! The graph of the lift-off map.

use crate::error::Error;
use passive_hopper::{LiftOffMap, alpha_star, index_below};
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

/// Most pieces of a graph: half as many humps. A page is some thousand dots wide, so that a hump of more would be some dots.
const MOST_PIECES: u64 = 400;

/// The points where pieces of the map meet between two speeds, and the two speeds. Instead of 0 it begins at 10⁻³.
///
/// # Errors
/// [`Error::TooWide`] for more than 200 humps; [`Error::Hopper`] unless both are speeds or 0, and the first one is smaller.
pub fn cuts_between(from: f64, to: f64) -> Result<Vec<f64>, Error> {
    let (first, last) = (index_below(from)?, index_below(to)?);
    if !(from < to) {
        return Err(Error::EmptyWindow { from, to });
    }
    if 2 * (last - first) > MOST_PIECES {
        return Err(Error::TooWide { from, to, humps: last - first, most: MOST_PIECES / 2 });
    }
    let inside = (first..=last + 1).flat_map(|n| [n as f64 * PI, alpha_star(n)]);
    let start = from.max(FIRST_SPEED.min(0.5 * to));
    let mut cuts = vec![start];
    cuts.extend(inside.filter(|&cut| start < cut && cut < to));
    cuts.push(to);
    Ok(cuts)
}
