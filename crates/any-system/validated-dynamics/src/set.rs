//! Sets of states that are carried along: a centre, the shape of the start, and errors in a frame of their own.

use crate::frame::Frame;
use crate::matrix::{Matrix, common, exact, middle, offsets, sums};
use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;

/// A set of states, c + C r₀ + B r: `r₀` is the start's box, `r` what came in by rounding and by nonlinearity.
///
/// A differentiable map carries it to another one, with its value at the centre and its derivatives on the set. C keeps how the
/// states depend on the start, so that a box that turns and stretches stays narrow; B is orthogonal (R. J. Lohner, 1987).
#[derive(Debug, Clone, PartialEq)]
pub struct AffineSet {
    centre: Vec<f64>,
    shape: DMatrix<f64>,
    start: Vec<Enclosure>,
    frame: Frame,
    errors: Vec<Enclosure>,
    /// A box that holds the states and the centre. It may be narrower than the box of the sum: the states are those of the sum that are in it.
    /// Both are convex, so that they hold the points between a state and the centre.
    hull: Vec<Enclosure>,
}

impl AffineSet {
    /// All states of a box.
    pub fn of_box(states: &[Enclosure]) -> AffineSet {
        let centre = middle(states);
        let size = states.len();
        AffineSet {
            start: offsets(states, &centre),
            shape: DMatrix::identity(size, size),
            frame: Frame::axes(size),
            errors: vec![Enclosure::ZERO; size],
            hull: states.to_vec(),
            centre,
        }
    }

    /// The points c + A r with |r_k| at most these radii.
    pub(crate) fn of_radii(centre: &[f64], directions: &DMatrix<f64>, radii: &[f64]) -> AffineSet {
        let r: Vec<Enclosure> =
            radii.iter().map(|radius| Enclosure::around(0.0, *radius)).collect();
        let hull = sums(&exact(centre), &Matrix::of_numbers(directions).apply(&r));
        AffineSet {
            centre: centre.to_vec(),
            shape: directions.clone(),
            start: r,
            frame: Frame::axes(centre.len()),
            errors: vec![Enclosure::ZERO; centre.len()],
            hull,
        }
    }

    /// Bounds of the coordinates of c + C r₀ + B r in directions with this inverse: of the part C r₀, and of the part B r.
    pub(crate) fn coordinates(&self, inverse: &Matrix) -> [Vec<f64>; 2] {
        let bounds = |directions: &Matrix, r: &[Enclosure]| {
            inverse.times(directions).apply(r).iter().map(Enclosure::magnitude).collect()
        };
        [
            bounds(&Matrix::of_numbers(&self.shape), &self.start),
            bounds(&self.frame.matrix(), &self.errors),
        ]
    }

    /// The directions of the shape, as columns, each one as long as the set is in it.
    pub(crate) fn shape_directions(&self) -> DMatrix<f64> {
        let (rows, columns) = (self.shape.nrows(), self.shape.ncols());
        DMatrix::from_fn(rows, columns, |row, column| {
            self.shape[(row, column)] * self.start[column].magnitude()
        })
    }

    /// A box that holds the set.
    pub fn hull(&self) -> &[Enclosure] {
        &self.hull
    }

    /// The centre.
    pub fn centre(&self) -> &[f64] {
        &self.centre
    }

    /// The directions in which the set is wide, as columns, and its radii in them.
    pub(crate) fn directions(&self) -> (DMatrix<f64>, Vec<f64>) {
        let (rows, shaped) = (self.centre.len(), self.start.len());
        let columns = DMatrix::from_fn(rows, shaped + rows, |row, column| match column < shaped {
            true => self.shape[(row, column)],
            false => self.frame.directions[(row, column - shaped)],
        });
        let all = self.start.iter().chain(&self.errors);
        (columns, all.map(Enclosure::magnitude).collect())
    }

    /// The values of a map on the set, from its value at the centre and its derivatives on the set: f(c) + Df (x − c), along the set's own
    /// directions and along the axes, whichever is narrower.
    pub(crate) fn values(&self, at_centre: &[Enclosure], derivatives: &Matrix) -> Vec<Enclosure> {
        self.values_by(at_centre, derivatives, &self.moved(derivatives))
    }

    /// The directions of the shape and of the frame, as a map with these derivatives moves them.
    fn moved(&self, derivatives: &Matrix) -> [Matrix; 2] {
        let shape = Matrix::of_numbers(&self.shape);
        [derivatives.times(&shape), derivatives.times(&self.frame.matrix())]
    }

    fn values_by(
        &self,
        at_centre: &[Enclosure],
        derivatives: &Matrix,
        [shaped, framed]: &[Matrix; 2],
    ) -> Vec<Enclosure> {
        let offset = sums(&shaped.apply(&self.start), &framed.apply(&self.errors));
        let along = sums(at_centre, &offset);
        let plain = sums(at_centre, &derivatives.apply(&offsets(&self.hull, &self.centre)));
        common(&along, &plain)
    }

    /// The image under a map with these values at the centre and these derivatives on the set, which is in `bounds` as well, if they are given.
    pub(crate) fn image(
        &self,
        at_centre: &[Enclosure],
        derivatives: &Matrix,
        bounds: Option<&[Enclosure]>,
    ) -> AffineSet {
        let moved = self.moved(derivatives);
        let centre = middle(at_centre);
        let hull = self.values_by(at_centre, derivatives, &moved);
        let hull = bounds.map_or(hull.clone(), |bounds| common(&hull, bounds));
        // Derivatives on the hull are taken between the centre and the states: rounding may have put the centre outside.
        let hull = hull.iter().zip(&centre).map(|(x, c)| x.hull(&Enclosure::from(*c))).collect();
        let [shaped, framed] = moved;
        let shape = shaped.middle();
        let lost = shaped.minus(&Matrix::of_numbers(&shape)).apply(&self.start);
        let new = sums(&offsets(at_centre, &centre), &lost);
        let widths: Vec<f64> = self.errors.iter().map(Enclosure::width).collect();
        let frame = Frame::of_moved(&framed, &widths);
        let errors =
            sums(&frame.inverse.times(&framed).apply(&self.errors), &frame.inverse.apply(&new));
        AffineSet { centre, shape, start: self.start.clone(), frame, errors, hull }
    }

    /// The centre as a set of one state.
    pub(crate) fn centre_box(&self) -> Vec<Enclosure> {
        exact(&self.centre)
    }
}

/// The derivatives of a composition of maps, with respect to the first one's argument: M + B R, with numbers M, a frame B and
/// enclosures R.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    middle: DMatrix<f64>,
    frame: Frame,
    errors: Matrix,
}

impl Chain {
    /// Of no map, on `size` variables.
    pub(crate) fn identity(size: usize) -> Chain {
        Chain {
            middle: DMatrix::identity(size, size),
            frame: Frame::axes(size),
            errors: Matrix::from_fn(size, size, |_, _| Enclosure::ZERO),
        }
    }

    /// The derivatives.
    pub(crate) fn matrix(&self) -> Matrix {
        Matrix::of_numbers(&self.middle).plus(&self.frame.matrix().times(&self.errors))
    }

    /// With one more map behind, with these derivatives.
    pub(crate) fn then(&self, derivatives: &Matrix) -> Chain {
        let carried = derivatives.times(&Matrix::of_numbers(&self.middle));
        let middle = carried.middle();
        let new = carried.minus(&Matrix::of_numbers(&middle));
        let moved = derivatives.times(&self.frame.matrix());
        let widest = |row| self.errors.row(row).iter().map(Enclosure::width);
        let widths: Vec<f64> = (0..self.errors.rows())
            .map(|row| widest(row).fold(f64::MIN_POSITIVE, f64::max))
            .collect();
        let frame = Frame::of_moved(&moved, &widths);
        let errors = frame.inverse.times(&moved).times(&self.errors);
        Chain { errors: errors.plus(&frame.inverse.times(&new)), middle, frame }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_that_turns_a_thousand_times_keeps_its_width() {
        // A turn by 0.1: boxes along the axes would grow by cos 0.1 + sin 0.1 each time, to 10³⁹.
        let (sine, cosine) = Enclosure::from(0.1).sin_cos();
        let turn = Matrix::of_rows(2, 2, &[cosine, -sine, sine, cosine]);
        let mut set = AffineSet::of_box(&[Enclosure::new(0.9, 1.1), Enclosure::new(-0.1, 0.1)]);
        let mut chain = Chain::identity(2);
        for _ in 0..1000 {
            let at_centre = turn.apply(&set.centre_box());
            set = set.image(&at_centre, &turn, None);
            chain = chain.then(&turn);
        }
        let width = set.hull()[0].width();
        assert!(width < 0.3 && width > 0.19, "{width}");
        let (sine, cosine) = pxfm_sin_cos();
        assert!(set.hull()[0].contains(cosine) && set.hull()[1].contains(sine));
        assert!(chain.matrix().at(0, 0).contains(cosine));
        assert!(chain.matrix().width() < 1e-12);
    }

    /// Sine and cosine of 100, to 17 digits.
    fn pxfm_sin_cos() -> (f64, f64) {
        (-0.506_365_641_109_758_8, 0.862_318_872_287_683_9)
    }
}
