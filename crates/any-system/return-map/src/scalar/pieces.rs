//! The domain of a map of one variable, and the pieces on which it is smooth.

use super::extrema::{Extremum, extrema};
use super::samples::samples_of;
use crate::checks::check_dimension;
use crate::error::Error;
use crate::families::{Border, Image, MapFamily, first_difference, image_of};
use crate::orbits::{OrbitEnd, end_of};

/// A map of one variable on a window, at one value of its parameter: pieces with one itinerary each, and gaps without images.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPieces {
    /// The window.
    pub window: (f64, f64),
    /// The parameter.
    pub parameter: f64,
    /// The pieces, from left to right.
    pub pieces: Vec<MapPiece>,
    /// The intervals without images, from left to right.
    pub gaps: Vec<MapGap>,
}

/// An interval on which all orbits have one itinerary: the map is smooth inside.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MapPiece {
    /// The first and the last point that were found on it.
    pub ends: (f64, f64),
    /// How far behind them the next piece or gap is known to be; 0 at the ends of the window. To rounding this is the error of
    /// a border, such as a grazing.
    pub border_errors: (f64, f64),
    /// The images of both ends.
    pub images: (f64, f64),
    /// The modes and surfaces on the way; the name of the piece.
    pub itinerary: Vec<String>,
    /// The critical points inside, where the derivative changes its sign.
    pub extrema: Vec<Extremum>,
}

/// An interval without images.
#[derive(Debug, Clone, PartialEq)]
pub struct MapGap {
    /// The first and the last point that were found in it.
    pub ends: (f64, f64),
    /// What becomes of these points.
    pub end: OrbitEnd,
}

impl MapPieces {
    /// What lies between a piece, by its number, and the next one: a grazing, a corner, for maps that tell. `None` for the last piece, and if a
    /// gap lies between. At a grazing itself a model may not say on which side an orbit is: so narrow a gap does not count.
    pub fn border<M: MapFamily + ?Sized>(&self, map: &M, piece: usize) -> Option<Border> {
        let (own, next) = (self.pieces.get(piece)?, self.pieces.get(piece + 1)?);
        let is_next = next.ends.0 - own.ends.1 <= NARROW * (self.window.1 - self.window.0);
        let sides = (&own.itinerary[..], &next.itinerary[..]);
        let place = first_difference(sides.0, sides.1);
        let site = || map.border((&[own.ends.1], self.parameter), sides, place, BESIDE);
        is_next.then(|| site().border)
    }
}

/// A gap of this part of the window is one in which the map does not decide between two pieces.
const NARROW: f64 = 1e-9;

/// The largest distance of the end of a piece from the guard of its border, in parts of the size of the guard: the speed of an event that
/// vanishes at a grazing is the root of rounding.
const BESIDE: f64 = 1e-6;

impl MapPiece {
    /// The laps: the intervals on which the map is monotone, each with the images of its ends.
    pub fn laps(&self) -> Vec<[(f64, f64); 2]> {
        let inner = self.extrema.iter().map(|extremum| (extremum.at, extremum.value));
        let corners: Vec<(f64, f64)> = [(self.ends.0, self.images.0)]
            .into_iter()
            .chain(inner)
            .chain([(self.ends.1, self.images.1)])
            .collect();
        corners.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }
}

/// What is at a point: an image, or the reason why there is none.
type Found = Result<Image, OrbitEnd>;

/// Most pieces and gaps. A map with infinitely many has those that rounding tells apart, some hundred for each point at which they
/// accumulate; a million would fill the memory.
const MOST_PIECES: usize = 100_000;

/// The pieces of a map on a window that `samples` equally spaced points reveal.
///
/// The borders are found by halving, to neighbouring numbers. Pieces that accumulate at a border are found down to its rounding. A piece
/// between two samples of another one may be missed. Critical points are zeros of the derivative, at which it changes its sign; where
/// the derivative and its slope at two neighbouring samples allow two of them between, further points are looked at.
///
/// ```
/// use return_map::{map_pieces, pieces};
/// // A tent with its top cut off: no image above 1.
/// let tent = pieces(1, |x: &[f64], height| Ok(match x[0] < 0.5 {
///     true => (vec![2.0 * height * x[0]], "left"),
///     false => (vec![2.0 * height * (1.0 - x[0])], "right"),
/// }));
/// let found = map_pieces(&tent, 0.9, (0.0, 1.0), 11)?;
/// assert_eq!(found.pieces.len(), 2);
/// assert_eq!(found.pieces[0].itinerary, ["left"]);
/// assert!((found.pieces[0].ends.1 - 0.5).abs() < 1e-15);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadWindow`] for a window that is empty or not finite, for fewer than three samples, and for more than a million;
/// [`Error::ManyPieces`] for more than a hundred thousand pieces; [`hybrid_system::Error::Dimension`] for a map of several variables.
pub fn map_pieces<M: MapFamily + ?Sized>(
    map: &M,
    parameter: f64,
    window: (f64, f64),
    samples: usize,
) -> Result<MapPieces, Error> {
    const MOST_SAMPLES: usize = 1_000_000;
    let at = samples_of(window, samples, MOST_SAMPLES)?;
    pieces_between(map, parameter, &(0..samples).map(at).collect::<Vec<f64>>())
}

/// The pieces that some points in ascending order reveal, from the first to the last one.
pub(super) fn pieces_between<M: MapFamily + ?Sized>(
    map: &M,
    parameter: f64,
    samples: &[f64],
) -> Result<MapPieces, Error> {
    check_dimension("a map of one variable", map.dimension(), 1)?;
    let of = |x: f64| image_of(map, &[x], parameter).map_err(end_of);
    let mut points: Vec<(f64, Found)> = Vec::with_capacity(samples.len());
    for &x in samples {
        let here = (x, of(x));
        if let Some(before) = points.last() {
            let mut between = Vec::new();
            borders(&of, before, &here, &mut between)?;
            points.extend(between);
        }
        points.push(here);
        if let Some(stopped) = map.stopped() {
            return Err(stopped);
        }
    }
    let mut found = MapPieces {
        window: (samples[0], samples[samples.len() - 1]),
        parameter,
        pieces: Vec::new(),
        gaps: Vec::new(),
    };
    let mut rest = &points[..];
    while let Some((_, first)) = rest.first() {
        let own = rest.iter().take_while(|(_, other)| is_same(first, other)).count();
        let (run, behind) = rest.split_at(own);
        let ends = (run[0].0, run[own - 1].0);
        match (first, &run[own - 1].1) {
            (Ok(image), Ok(last)) => {
                let before = points.len() - rest.len();
                let start = if before > 0 { ends.0 - points[before - 1].0 } else { 0.0 };
                let end = behind.first().map_or(0.0, |next| next.0 - ends.1);
                // The ends and the samples; the halvings between them crowd at the borders.
                let is_place = |x: &f64| {
                    *x == ends.0
                        || *x == ends.1
                        || samples.binary_search_by(|own| own.total_cmp(x)).is_ok()
                };
                let places: Vec<f64> = run.iter().map(|point| point.0).filter(is_place).collect();
                found.pieces.push(MapPiece {
                    ends,
                    border_errors: (start, end),
                    images: (image.point[0], last.point[0]),
                    itinerary: image.itinerary.clone(),
                    extrema: extrema(map, parameter, &places, &image.itinerary),
                });
            }
            (Err(end), _) | (_, Err(end)) => {
                found.gaps.push(MapGap { ends, end: end.clone() });
            }
        }
        if found.pieces.len() + found.gaps.len() > MOST_PIECES {
            return Err(Error::ManyPieces { left: found.window.0, at: ends.1, most: MOST_PIECES });
        }
        rest = behind;
    }
    map.stopped().map_or(Ok(found), Err)
}

/// True for two points of one piece or of one gap. Failures have numbers in them: they are one kind.
fn is_same(a: &Found, b: &Found) -> bool {
    match (a, b) {
        (Ok(a), Ok(b)) => a.itinerary == b.itinerary,
        (Err(OrbitEnd::Failed(_)), Err(OrbitEnd::Failed(_))) => true,
        (Err(a), Err(b)) => a == b,
        _ => false,
    }
}

/// Adds points between two others by halving, down to both sides of each border, in ascending order.
fn borders(
    of: &impl Fn(f64) -> Found,
    left: &(f64, Found),
    right: &(f64, Found),
    between: &mut Vec<(f64, Found)>,
) -> Result<(), Error> {
    if is_same(&left.1, &right.1) {
        return Ok(());
    }
    let middle = left.0 + 0.5 * (right.0 - left.0);
    if middle <= left.0 || middle >= right.0 {
        return Ok(());
    }
    if between.len() > MOST_PIECES {
        return Err(Error::ManyPieces { left: left.0, at: middle, most: MOST_PIECES });
    }
    let middle = (middle, of(middle));
    borders(of, left, &middle, between)?;
    let place = between.len();
    borders(of, &middle, right, between)?;
    between.insert(place, middle);
    Ok(())
}
