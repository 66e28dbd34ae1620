//! The graph of the lift-off map.

use crate::error::Error;
use journal_figures::graph_pieces_to;
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, HopWithin, LiftOffMap, alpha_star, index_below,
};
use std::cell::RefCell;
use std::f64::consts::PI;

/// The speed at which drawings begin instead of 0, which is not a lift-off speed. On the page it is 0.
const FIRST_SPEED: f64 = 1e-3;

/// The graph of the map, and the speeds at which it is not known whether there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// Smooth pieces.
    pub pieces: Vec<Vec<(f64, f64)>>,
    /// Speeds whose hop was tried and is not decided, from the lowest up. They are in no piece, and need not be
    /// grounded.
    pub undecided: Vec<f64>,
}

impl Graph {
    /// The graph between neighbouring `cuts`, in pieces of `count` + 1 points each, with every digit of
    /// [`LiftOffMap::image`].
    pub fn exact(map: &LiftOffMap, cuts: &[f64], count: usize) -> Self {
        Self::of(
            |alpha| map.image(alpha).ok(),
            |value| journal_figures::graph_pieces(value, cuts, count),
        )
    }

    /// The same for a drawing: images to a thousandth, and edges to a ten-thousandth of a piece. From M = 10⁴ on,
    /// where a hop has hundreds of landings and 1024 bits take a second, only `f64` decides.
    pub fn drawn(map: &LiftOffMap, cuts: &[f64], count: usize) -> Self {
        Self::of(
            |alpha| drawn_image(map, alpha),
            |value| graph_pieces_to(DRAWN_HALVINGS, value, cuts, count),
        )
    }

    fn of(
        image: impl Fn(f64) -> Option<Option<f64>>,
        pieces: impl FnOnce(&dyn Fn(f64) -> Option<f64>) -> Vec<Vec<(f64, f64)>>,
    ) -> Self {
        let undecided = RefCell::new(Vec::new());
        let value = |alpha: f64| {
            let image = image(alpha);
            if image.is_none() {
                undecided.borrow_mut().push(alpha);
            }
            image.flatten()
        };
        let pieces = pieces(&value);
        let mut undecided = undecided.into_inner();
        undecided.sort_by(f64::total_cmp);
        undecided.dedup();
        Graph { pieces, undecided }
    }
}

/// The largest error of an image that is drawn, relative to its speed: less than the width of a line.
const DRAWN: f64 = 1e-3;

/// Halvings to an edge that is drawn, from a 64th of a piece.
const DRAWN_HALVINGS: usize = 8;

/// The largest mass ratio for which 106 bits decide what `f64` leaves open: a hop then has up to some hundred
/// landings, and takes milliseconds.
const LARGEST_EXTENDED: f64 = 1e4;

/// The image for a drawing, or that the hopper is grounded; `None` if it is not decided.
fn drawn_image(map: &LiftOffMap, alpha: f64) -> Option<Option<f64>> {
    match map.hop_within(alpha, 0.0) {
        HopWithin::Next { speed, error } if error <= DRAWN * alpha => return Some(Some(speed)),
        HopWithin::Grounded => return Some(None),
        _ => {}
    }
    if map.mass_ratio().value() > LARGEST_EXTENDED {
        return None;
    }
    let mut orbit = ExtendedOrbit::new(map, alpha, Arithmetic::Bits106).ok()?;
    match orbit.hop().ok()? {
        ExtendedStep::LiftsOff => Some(Some(orbit.speed())),
        ExtendedStep::Grounded => Some(None),
        ExtendedStep::Inconclusive => None,
    }
}

/// The graph of `map` between neighbouring `cuts`, as pieces of `count` + 1 points each.
///
/// Where the hopper is grounded there is no graph, nor where a hop is not decided; [`Graph`] tells them apart.
pub fn graph_pieces(map: &LiftOffMap, cuts: &[f64], count: usize) -> Vec<Vec<(f64, f64)>> {
    Graph::exact(map, cuts, count).pieces
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

/// Most pieces of a graph: half as many humps. A page is some thousand dots wide, so that a hump of more would be
/// some dots.
const MOST_PIECES: u64 = 400;

/// The points where pieces of the map meet between two speeds, and the two speeds. Instead of 0 it begins at 10⁻³.
///
/// # Errors
/// [`Error::TooWide`] for more than 200 humps; [`Error::Hopper`] unless both are speeds or 0, and the first one is
/// smaller.
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

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::MassRatio;

    #[test]
    fn drawn_graphs_are_those_of_the_map() {
        let map = LiftOffMap::new(MassRatio::new(0.2).unwrap());
        let (exact, drawn) = (Graph::exact(&map, &cuts(3), 40), Graph::drawn(&map, &cuts(3), 40));
        assert!(exact.undecided.is_empty() && drawn.undecided.is_empty());
        for (exact, drawn) in exact.pieces.iter().flatten().zip(drawn.pieces.iter().flatten()) {
            assert!(exact.0 == drawn.0 && (exact.1 - drawn.1).abs() < 1e-9, "{exact:?} {drawn:?}");
        }
    }

    /// At a huge mass ratio some hops have thousands of landings, and 106 bits do not decide all of them. They are
    /// not called grounded.
    #[test]
    fn undecided_speeds_are_named() {
        let map = LiftOffMap::new(MassRatio::new(1e6).unwrap());
        let graph = Graph::drawn(&map, &cuts(1), 8);
        assert!(!graph.undecided.is_empty() && !graph.pieces.is_empty());
        let inside = |alpha: f64| graph.pieces.iter().flatten().any(|&(own, _)| own == alpha);
        assert!(graph.undecided.iter().all(|&alpha| !inside(alpha)));
    }
}
