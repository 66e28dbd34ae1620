//! Sets as certificates have them: a centre, directions and radii.

use crate::frame::{Frame, inverse_of};
use crate::matrix::Matrix;
use crate::set::AffineSet;
use nalgebra::DMatrix;
use serde_json::{Value, json};

/// How much larger the parts of a set are written that came in by nonlinearity and by rounding. A second program, whose balls are wider than
/// intervals, must find its own image of a step inside: for a larger factor it does so for wider sets, which grow faster. At 3, sets of van der Pol's
/// oscillator must be ten times as narrow.
const ERRORS: f64 = 1.2;

/// By how much sets are written wider in each component, as a part of it: an ulp, for what the other program computes in another order.
const ROUNDING: f64 = f64::EPSILON;

/// The same for the radii themselves, relatively.
const RELATIVE: f64 = 1e-9;

/// The decimal digits of directions and radii: few, for short files.
const DIGITS: usize = 5;

/// The points c + A r with |r_k| ≤ ρ_k. All its numbers are `f64`, and the set is exactly this one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenSet {
    centre: Vec<f64>,
    directions: DMatrix<f64>,
    radii: Vec<f64>,
}

impl WrittenSet {
    /// A set that holds this one: along its own directions or along an orthogonal frame, whichever box about it is narrower.
    pub(crate) fn of(set: &AffineSet) -> WrittenSet {
        let shape = rounded(&Frame::independent(&set.shape_directions()));
        let (columns, weights) = set.directions();
        let frame = rounded(&Frame::of_columns(&columns, &weights).directions);
        let found = [shape, frame].into_iter().filter_map(|directions| along(set, directions));
        let excess = |written: &WrittenSet| {
            let written = written.set();
            let sides = written.hull().iter().zip(set.hull());
            let part = sides.map(|(own, hull)| own.width() / (hull.width() + f64::MIN_POSITIVE));
            part.fold(0.0, f64::max)
        };
        let best =
            found.filter(WrittenSet::is_finite).min_by(|a, b| excess(a).total_cmp(&excess(b)));
        // The axes are their own inverse.
        best.unwrap_or_else(|| {
            let directions = DMatrix::identity(set.centre().len(), set.centre().len());
            let radii = radii(set, &Matrix::identity(set.centre().len()));
            WrittenSet { centre: set.centre().to_vec(), directions, radii }
        })
    }

    fn is_finite(&self) -> bool {
        self.radii.iter().all(|radius| radius.is_finite())
    }

    /// The same set.
    pub(crate) fn set(&self) -> AffineSet {
        AffineSet::of_radii(&self.centre, &self.directions, &self.radii)
    }

    /// `[centre, rows of directions, radii]`.
    pub(crate) fn as_json(&self) -> Value {
        json!([self.centre, rows_of(&self.directions), self.radii])
    }
}

/// The rows of a matrix.
pub(crate) fn rows_of(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// The set along these directions, if they have an inverse.
fn along(set: &AffineSet, directions: DMatrix<f64>) -> Option<WrittenSet> {
    let inverse = inverse_of(&directions, &directions.clone().try_inverse()?)?;
    Some(WrittenSet { centre: set.centre().to_vec(), directions, radii: radii(set, &inverse) })
}

/// The radii of a set in directions with this inverse.
fn radii(set: &AffineSet, inverse: &Matrix) -> Vec<f64> {
    let [shape, errors] = set.coordinates(inverse);
    let radius = |(row, (shape, errors)): (usize, (f64, f64))| {
        let along = inverse.row(row).iter().zip(set.centre());
        let rounding: f64 = along.map(|(x, c)| x.magnitude() * c.abs() * ROUNDING).sum();
        rounded_up((shape + ERRORS * errors + rounding) * (1.0 + RELATIVE))
    };
    shape.into_iter().zip(errors).enumerate().map(radius).collect()
}

/// Directions with few digits: they need not be exact, for a set is written along any.
fn rounded(directions: &DMatrix<f64>) -> DMatrix<f64> {
    directions.map(|x| format!("{x:.DIGITS$e}").parse().unwrap_or(x))
}

/// A number with few digits that is not below a positive one.
fn rounded_up(x: f64) -> f64 {
    // One more in the last digit is more than half of it.
    let last = interval_arithmetic::pow(0.1, DIGITS as f64);
    format!("{:.DIGITS$e}", x * (1.0 + last)).parse().map_or(x, |up: f64| up.max(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use interval_arithmetic::Enclosure;

    #[test]
    fn a_written_set_holds_the_set_and_is_hardly_wider() {
        let states = [Enclosure::new(0.9, 1.1), Enclosure::new(-0.1, 0.3)];
        let set = AffineSet::of_box(&states);
        let turn = Matrix::from_fn(2, 2, |row, column| {
            Enclosure::from([[0.6, -0.8], [0.8, 0.6]][row][column])
        });
        let at_centre = turn.apply(&set.centre_box());
        let turned = set.image(&at_centre, &turn, None);
        let written = WrittenSet::of(&turned).set();
        for (own, wide) in turned.hull().iter().zip(written.hull()) {
            assert!(own.is_inside(wide) && wide.width() < 1.001 * own.width(), "{own} {wide}");
        }
    }
}
