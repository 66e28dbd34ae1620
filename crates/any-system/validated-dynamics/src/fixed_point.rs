//! Fixed points that exist: Krawczyk's method.

use crate::enclosed_map::{EnclosedMap, MapImage, StartSet};
use crate::matrix::{Matrix, common, exact, middle, offsets, sums};
use crate::multipliers::{Multiplier, multipliers};
use crate::undecided::{Error, Reason};
use interval_arithmetic::Enclosure;
use nalgebra::{DMatrix, DVector};

/// The most steps of Newton's method from a guess: each one doubles the digits.
const NEWTON_STEPS: usize = 30;

/// A step of Newton's method that changes no component by more than this part of it is the last one: what is left is rounding.
const CONVERGED: f64 = 1e-12;

/// How much wider than the distance of the fixed point the box is, at first.
const INFLATION: f64 = 4.0;

/// The least radius of the first box, about a centre that is 0. Enclosures of smaller products are wider than a rounding.
const LEAST_RADIUS: f64 = 1e-270;

/// How often the box is widened. Each time it is [`INFLATION`] times as wide, at least, in the directions that need it.
const TRIES: usize = 8;

/// A fixed point that exists, and is the only one in a box.
#[derive(Debug, Clone)]
pub struct ProvedFixedPoint {
    /// A box that holds the fixed point.
    pub point: Vec<Enclosure>,
    /// A wider box in which it is the only one.
    pub unique_in: Vec<Enclosure>,
    /// The intervals of parameters for each value of which this holds.
    pub parameters: Vec<Enclosure>,
    /// The image of a box that holds `point`: with the derivatives there, and the events.
    pub image: MapImage,
    /// The eigenvalues of the derivatives at the fixed point.
    pub multipliers: Vec<Multiplier>,
}

impl ProvedFixedPoint {
    /// True if all multipliers are inside the unit circle for certain.
    pub fn is_attracting(&self) -> bool {
        self.multipliers.iter().all(Multiplier::is_inside)
    }

    /// True if some multipliers are inside the unit circle and all others outside, for certain.
    pub fn is_saddle(&self) -> bool {
        let inside = self.multipliers.iter().filter(|multiplier| multiplier.is_inside()).count();
        let outside = self.multipliers.iter().filter(|multiplier| multiplier.is_outside()).count();
        inside > 0 && outside > 0 && inside + outside == self.multipliers.len()
    }
}

/// A fixed point of a map near a guess, for all values of the parameters.
///
/// With F(x) = f(x) − x and A ≈ DF⁻¹, the images y − A F(y) + (I − A DF(X)) (X − y) of a box X are inside of it only if there is exactly one zero of
/// F in X, for each value of the parameters (R. Krawczyk, 1969).
///
/// ```
/// use equations::{Formulas, Names};
/// use validated_dynamics::{FormulaMap, fixed_point};
/// let names = Names::new(&["x"], &[])?;
/// let cosine = FormulaMap::new(Formulas::from_text(names, &["cos(x)"])?, 1)?;
/// let found = fixed_point(&cosine, &[0.7], &[])?;
/// assert!(found.point[0].contains(0.7390851332151607) && found.point[0].width() < 1e-15);
/// assert!(found.is_attracting());
/// # Ok::<(), validated_dynamics::Error>(())
/// ```
///
/// # Errors
/// [`Error::Undecided`]: [`Reason::OtherMode`] for a map that does not lead back to the mode in which it begins; [`Reason::NoPoint`] if Newton's method does not converge from the guess, [`Reason::Singular`] for derivatives that
/// may have the eigenvalue 1, [`Reason::NotInside`], and what the map does not decide.
pub fn fixed_point(
    map: &impl EnclosedMap,
    guess: &[f64],
    parameters: &[Enclosure],
) -> Result<ProvedFixedPoint, Error> {
    let size = map.dimension();
    if guess.len() != size || !guess.iter().all(|x| x.is_finite()) {
        return Error::argument("guess", format!("{size} finite numbers are needed"));
    }
    let (centre, inverse) = newton(map, guess, parameters)?;
    let whole = StartSet::of_box(&[exact(&centre), parameters.to_vec()].concat());
    map.leads_into(&map.carry(whole.without_derivatives())?, map)?;
    let at_centre = map.image(&[exact(&centre), parameters.to_vec()].concat())?;
    let off = offsets(&at_centre.values, &centre);
    let step = Matrix::of_numbers(&inverse).apply(&off);
    let about = |x: &Enclosure, centre: f64| {
        let least = f64::EPSILON * centre.abs() + LEAST_RADIUS;
        (x.magnitude() + least) * INFLATION
    };
    let mut radii: Vec<f64> = step.iter().zip(&centre).map(|(x, c)| about(x, *c)).collect();
    let krawczyk = Krawczyk { map, centre, inverse, step, parameters };
    for _ in 0..TRIES {
        let (found, all) = krawczyk.boxes(&radii)?;
        let is_inside = |(k, x): (&Enclosure, &Enclosure)| x.low() < k.low() && k.high() < x.high();
        let inside: Vec<bool> = found.iter().zip(&all).map(is_inside).collect();
        if inside.iter().all(|own| *own) {
            return krawczyk.narrowest(found, all);
        }
        // As wide as what came out, in each direction (S. M. Rump's inflation). A direction that is inside keeps its width, which the others would follow.
        let off = offsets(&found, &krawczyk.centre);
        for (radius, (off, inside)) in radii.iter_mut().zip(off.iter().zip(inside)) {
            if !inside {
                *radius = INFLATION * off.magnitude().max(*radius);
            }
        }
    }
    Err(Error::of_variables(Reason::NotInside { tries: TRIES }, &exact(&krawczyk.centre)))
}

struct Krawczyk<'m, M> {
    map: &'m M,
    centre: Vec<f64>,
    /// Approximates the inverse of Df − I.
    inverse: DMatrix<f64>,
    /// A F at the centre.
    step: Vec<Enclosure>,
    parameters: &'m [Enclosure],
}

impl<M: EnclosedMap> Krawczyk<'_, M> {
    /// Krawczyk's box, and the box with these radii from which it comes.
    fn boxes(&self, radii: &[f64]) -> Result<(Vec<Enclosure>, Vec<Enclosure>), Error> {
        let around = |(centre, radius): (&f64, &f64)| Enclosure::around(*centre, *radius);
        let all: Vec<Enclosure> = self.centre.iter().zip(radii).map(around).collect();
        let image = self.map.image(&[&all[..], self.parameters].concat())?;
        Ok((self.operator(&image, &all), all))
    }

    /// y − A F(y) + (I − A DF) (X − y).
    fn operator(&self, image: &MapImage, all: &[Enclosure]) -> Vec<Enclosure> {
        let size = self.centre.len();
        let slopes = Matrix::from_fn(size, size, |row, column| {
            let own = image.derivatives.at(row, column);
            if row == column { own - Enclosure::ONE } else { own }
        });
        let scaled = Matrix::of_numbers(&self.inverse).times(&slopes);
        let rest = Matrix::identity(size).minus(&scaled).apply(&offsets(all, &self.centre));
        let newton: Vec<Enclosure> = self
            .centre
            .iter()
            .zip(&self.step)
            .map(|(c, step)| Enclosure::from(*c) - *step)
            .collect();
        sums(&newton, &rest)
    }

    /// The fixed point of a proved box, once more on the narrow box, with its multipliers.
    fn narrowest(
        &self,
        point: Vec<Enclosure>,
        unique_in: Vec<Enclosure>,
    ) -> Result<ProvedFixedPoint, Error> {
        // The derivatives are those between the fixed point and the centre.
        let about = |(x, c): (&Enclosure, &f64)| x.hull(&Enclosure::from(*c));
        let all: Vec<Enclosure> = point.iter().zip(&self.centre).map(about).collect();
        let image = self.map.image(&[&all[..], self.parameters].concat())?;
        let point = common(&point, &self.operator(&image, &all));
        let size = self.centre.len();
        let own = Matrix::from_fn(size, size, |row, column| image.derivatives.at(row, column));
        let (multipliers, parameters) = (multipliers(&own), self.parameters.to_vec());
        Ok(ProvedFixedPoint { point, unique_in, parameters, image, multipliers })
    }
}

/// A point near the fixed point and an approximate inverse of Df − I there, by Newton's method in the middle of the parameters.
fn newton(
    map: &impl EnclosedMap,
    guess: &[f64],
    parameters: &[Enclosure],
) -> Result<(Vec<f64>, DMatrix<f64>), Error> {
    let size = guess.len();
    let at = exact(&middle(parameters));
    let mut point = guess.to_vec();
    let mut last = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let image = map.image(&[exact(&point), at.clone()].concat())?;
        let slopes = image.derivatives.middle().columns(0, size) - DMatrix::identity(size, size);
        let Some(inverse) =
            slopes.try_inverse().filter(|found| found.iter().all(|x| x.is_finite()))
        else {
            return Err(Error::of_variables(Reason::Singular, &exact(&point)));
        };
        let off = offsets(&image.values, &point).iter().map(Enclosure::middle).collect::<Vec<_>>();
        let step = &inverse * DVector::from_vec(off);
        let relative =
            |(step, x): (&f64, &f64)| step.abs() / (x.abs() + f64::MIN_POSITIVE).max(1e-3);
        last = step.iter().zip(&point).map(relative).fold(0.0, f64::max);
        point.iter_mut().zip(&step).for_each(|(x, step)| *x -= step);
        if last < CONVERGED {
            return Ok((point, inverse));
        }
    }
    Err(Error::of_variables(Reason::NoPoint { step: last }, &exact(&point)))
}
