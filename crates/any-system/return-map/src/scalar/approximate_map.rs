//! A map of one variable by polynomials: fast to iterate, to invert, to compose and to store.

use super::cells::{Cell, cells};
use super::pieces::{MapPiece, MapPieces, pieces_between};
use crate::checks::check_positive;
use crate::error::Error;
use crate::families::{Image, Linearized, MapFamily, Pushed};
use equations::Jet;
use interval_arithmetic::bracketed_root;
use nalgebra::DMatrix;

/// A map of one variable at one value of its parameter, by Chebyshev polynomials on cells: an iteration evaluates one of
/// them, whatever the flow behind it takes.
///
/// ```
/// use return_map::{ApproximateMap, map_pieces, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let found = map_pieces(&logistic, 3.7, (0.0, 1.0), 11)?;
/// let fast = ApproximateMap::new(&logistic, &found, 1e-12)?;
/// assert!((fast.value(0.3).expect("an image") - 3.7 * 0.3 * 0.7).abs() < 1e-12);
/// // Both preimages of 0.5:
/// assert_eq!(fast.preimages(0.5).len(), 2);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Accuracy
/// [`error`](Self::error) is the largest difference at the tests, of which each cell has sixteen; cells are halved until it is below
/// a quarter of the tolerance. At a jump or a kink that the pieces do not show it may be larger than the tolerance. At the borders of a
/// piece, where roots begin, cells get narrow.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Parts"))]
pub struct ApproximateMap(Parts);

/// What a map consists of. From a file it is checked before it is used.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Parts {
    parameter: f64,
    tolerance: f64,
    error: f64,
    pieces: Vec<MapPiece>,
    /// The cells of all pieces, from left to right, and for each one the number of its piece.
    cells: Vec<Cell>,
    owners: Vec<usize>,
}

impl ApproximateMap {
    /// The map on these pieces, as near as `tolerance`.
    ///
    /// # Errors
    /// [`Error::BadArgument`] for a tolerance that is not positive; [`Error::ManyPieces`] for a map with more noise than the tolerance; those of
    /// the map.
    pub fn new<M: MapFamily + ?Sized>(
        map: &M,
        on: &MapPieces,
        tolerance: f64,
    ) -> Result<ApproximateMap, Error> {
        check_positive("the tolerance of an approximate map", tolerance)?;
        let mut made = Parts {
            parameter: on.parameter,
            tolerance,
            error: 0.0,
            pieces: on.pieces.clone(),
            cells: Vec::new(),
            owners: Vec::new(),
        };
        let value = |x: f64| {
            let image = map.image(&[x], on.parameter)?;
            image
                .point
                .first()
                .copied()
                .filter(|y| y.is_finite())
                .ok_or_else(|| missing(x, on.parameter))
        };
        for (number, piece) in on.pieces.iter().enumerate() {
            // A piece of one point has no polynomial.
            if piece.ends.0 < piece.ends.1 {
                let (cells, error) = cells(&value, piece.ends, tolerance)?;
                made.owners.extend(cells.iter().map(|_| number));
                made.cells.extend(cells);
                made.error = made.error.max(error);
            }
        }
        Ok(ApproximateMap(made))
    }

    /// The largest difference from the map at the tests.
    pub fn error(&self) -> f64 {
        self.0.error
    }

    /// The tolerance that was asked for.
    pub fn tolerance(&self) -> f64 {
        self.0.tolerance
    }

    /// The parameter of the map.
    pub fn parameter(&self) -> f64 {
        self.0.parameter
    }

    /// The pieces, with their borders and critical points.
    pub fn pieces(&self) -> &[MapPiece] {
        &self.0.pieces
    }

    /// The number of polynomials.
    pub fn polynomials(&self) -> usize {
        self.0.cells.len()
    }

    fn cell(&self, x: f64) -> Option<(&Cell, &MapPiece)> {
        let place = self.0.cells.partition_point(|cell| cell.right < x);
        let cell = self.0.cells.get(place).filter(|cell| cell.left <= x)?;
        Some((cell, self.0.pieces.get(*self.0.owners.get(place)?)?))
    }

    /// The image; `None` outside of all pieces.
    pub fn value(&self, x: f64) -> Option<f64> {
        self.cell(x).map(|(cell, _)| cell.value(x))
    }

    /// The laps: the intervals on which the map is monotone, each as both ends with their images.
    pub fn laps(&self) -> Vec<[(f64, f64); 2]> {
        self.0.pieces.iter().flat_map(MapPiece::laps).collect()
    }

    /// The inverse of a lap, by its number among the [laps](Self::laps): the point of it with this image; `None` if it has none.
    pub fn inverse(&self, lap: usize, image: f64) -> Option<f64> {
        self.inverse_on(self.laps().get(lap)?, image)
    }

    fn inverse_on(&self, lap: &[(f64, f64); 2], image: f64) -> Option<f64> {
        let [(left, at_left), (right, at_right)] = *lap;
        if image < at_left.min(at_right) || image > at_left.max(at_right) {
            return None;
        }
        let off = |x: f64| match x {
            x if x == left => at_left - image,
            x if x == right => at_right - image,
            x => self.value(x).map_or(f64::NAN, |value| value - image),
        };
        bracketed_root(off, left, right).ok()
    }

    /// All points with this image, from left to right.
    pub fn preimages(&self, image: f64) -> Vec<f64> {
        let mut found: Vec<f64> =
            self.laps().iter().filter_map(|lap| self.inverse_on(lap, image)).collect();
        found.dedup();
        found
    }

    /// This map, and another one behind it. The pieces are cut where the image is on a border of the other map. The error adds that of both
    /// maps, the first times a bound on the slopes of the second.
    ///
    /// # Errors
    /// As [`new`](Self::new) and [`map_pieces`](super::map_pieces); [`Error::BadArgument`] without a piece.
    pub fn then(&self, next: &ApproximateMap) -> Result<ApproximateMap, Error> {
        let ends = |piece: &MapPiece| [piece.ends.0, piece.ends.1];
        let mut cuts: Vec<f64> = self.0.pieces.iter().flat_map(ends).collect();
        for border in next.0.pieces.iter().flat_map(ends) {
            cuts.extend(self.preimages(border));
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        // Some points in each interval between two cuts: a thin one is not missed.
        const INSIDE: usize = 8;
        let mut samples = Vec::with_capacity(cuts.len() * INSIDE);
        for pair in cuts.windows(2) {
            let part = |k: usize| pair[0] + (pair[1] - pair[0]) * (k as f64 / INSIDE as f64);
            samples.extend((0..INSIDE).map(part));
        }
        samples.extend(cuts.last());
        samples.dedup();
        if samples.len() < 2 {
            let what = "the number of pieces of a map";
            return Err(Error::BadArgument { what, value: 0.0 });
        }
        let both = Both(self, next);
        let found = pieces_between(&both, self.0.parameter, &samples)?;
        let tolerance = self.0.tolerance.max(next.0.tolerance);
        let mut made = ApproximateMap::new(&both, &found, tolerance)?;
        made.0.error += next.0.error + self.0.error * next.steepest();
        Ok(made)
    }

    /// No slope is larger.
    fn steepest(&self) -> f64 {
        self.0.cells.iter().map(Cell::steepest).fold(0.0, f64::max)
    }
}

fn missing(x: f64, parameter: f64) -> Error {
    Error::NoImage { point: vec![x], parameter }
}

/// The map at its own parameter.
impl MapFamily for ApproximateMap {
    fn dimension(&self) -> usize {
        1
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        let x = point.first().copied().unwrap_or(f64::NAN);
        let found = self.cell(x).filter(|_| parameter == self.0.parameter);
        let (cell, piece) = found.ok_or_else(|| missing(x, parameter))?;
        let itinerary = piece.itinerary.clone();
        Ok(Image { itinerary, ..Image::of_number(vec![cell.value(x)], None) })
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        let x = curve.first().copied().unwrap_or(Jet::number(f64::NAN));
        let found = self.cell(x.value()).filter(|_| parameter == Jet::number(self.0.parameter));
        let (cell, _) = found.ok_or_else(|| missing(x.value(), parameter.value()))?;
        let pushed = cell.pushed(&x);
        let errors = vec![cell.slope_error(self.0.error) * x.0[1].abs()];
        Ok(Pushed { curve: vec![pushed], errors })
    }

    /// It is known at one value of the parameter: the last column is zero.
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        let image = self.image(point, parameter)?;
        let line: Vec<Jet<4>> = point.iter().map(|x| Jet::moving(*x, 1.0)).collect();
        let Pushed { curve, errors } = self.pushed(&line, Jet::number(parameter))?;
        let slopes = DMatrix::from_row_slice(1, 2, &[curve[0].0[1], 0.0]);
        let errors = DMatrix::from_row_slice(1, 2, &[errors[0], 0.0]);
        Ok(Linearized { image, slopes, errors })
    }
}

/// One map behind another.
struct Both<'m>(&'m ApproximateMap, &'m ApproximateMap);

impl MapFamily for Both<'_> {
    fn dimension(&self) -> usize {
        1
    }

    fn image(&self, point: &[f64], _: f64) -> Result<Image, Error> {
        let Both(first, second) = self;
        let mut between = first.image(point, first.0.parameter)?;
        let after = second.image(&between.point, second.0.parameter)?;
        between.itinerary.extend(after.itinerary);
        Ok(Image { point: after.point, time: between.time + after.time, ..between })
    }

    fn pushed(&self, curve: &[Jet<4>], _: Jet<4>) -> Result<Pushed, Error> {
        let Both(first, second) = self;
        let between = first.pushed(curve, Jet::number(first.0.parameter))?;
        second.pushed(&between.curve, Jet::number(second.0.parameter))
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for ApproximateMap {
    type Error = String;

    fn try_from(parts: Parts) -> Result<ApproximateMap, String> {
        let Parts { pieces, cells, owners, .. } = &parts;
        let in_order = cells.windows(2).all(|pair| pair[0].right <= pair[1].left);
        let have_owners =
            owners.len() == cells.len() && owners.iter().all(|&owner| owner < pieces.len());
        if !cells.iter().all(Cell::is_sound) || !in_order || !have_owners {
            return Err("no approximate map: its polynomials must be finite, on cells from left to right, each of one piece".to_owned());
        }
        Ok(ApproximateMap(parts))
    }
}
