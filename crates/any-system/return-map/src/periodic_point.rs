//! Periodic points in any dimension, by Newton's method.

use crate::checks::check_period;
use crate::error::Error;
use crate::families::{Image, Linearized, differences};
use crate::multipliers::Uncertain;
use equations::Jet;
use nalgebra::{Complex, DMatrix, DVector, SMatrix, SVector};

/// A point that a map f takes back to itself after `period` steps.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicPoint<const K: usize> {
    /// The point x.
    pub location: SVector<f64, K>,
    /// The period p: fᵖ(x) = x. It may be a multiple of the least period.
    pub period: usize,
    /// The largest component of |fᵖ(x) − x|.
    pub residual: f64,
    /// The multipliers: the eigenvalues of the derivative of fᵖ at x. If all lie inside the unit circle, the point
    /// attracts.
    pub multipliers: Vec<Complex<f64>>,
    /// How far each multiplier may be from the exact one: an estimate, to first order, from what changes with the distance of differences,
    /// and from the rounding of products.
    pub multiplier_errors: Vec<f64>,
    /// Newton steps taken.
    pub steps: usize,
}

/// Most Newton steps. From a good start Newton's method needs five to ten steps, because each step doubles the number
/// of right digits. The limit ends a search that does not converge.
const NEWTON_STEPS: usize = 50;

/// A step is halved at most this number of times until the residual falls: to 10⁻⁹ of its length. If even this does not
/// lower the residual, the direction is wrong, or the residual is the noise of the map.
const HALVINGS: usize = 30;

/// A Newton step that no longer lowers the residual is attributed to noise of the map if it is at most this,
/// relative to the point. The noise of an integrated return map is of the order of its flow's tolerance, far above
/// an ulp: at tolerances up to 10⁻¹² it is below this with a margin of 100. A smaller value would refuse the periodic
/// points of such maps. A larger value would accept points at which the method has stopped without a periodic point.
const NOISE: f64 = 1e-10;

/// A point of period `period` of `map`, by damped Newton steps from `start`.
///
/// The multipliers are those of differences of order six, with an estimate of their errors: some 10⁻¹² for a smooth map to rounding.
///
/// ```
/// use nalgebra::Vector2;
/// // The fixed point of Hénon's map is a saddle.
/// let henon = |x: &Vector2<f64>| Ok(Vector2::new(1.0 - 1.4 * x[0] * x[0] + x[1], 0.3 * x[0]));
/// let point = return_map::periodic_point(henon, &Vector2::new(0.5, 0.2), 1)?;
/// assert!((point.location[0] - 0.631354477089505).abs() < 1e-14);
/// assert!(point.multipliers.iter().any(|m| m.norm() > 1.0));
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoPeriodicPoint`] for a singular derivative, and if the steps end before the residual
/// is of the size of rounding, or of the noise of the map (Newton steps under 10⁻¹⁰). [`Error::BadPeriod`] for a period
/// of 0 or above a million. [`Error::Differences`] if the map is not smooth at the orbit. Errors of the map.
pub fn periodic_point<const K: usize>(
    map: impl Fn(&SVector<f64, K>) -> Result<SVector<f64, K>, Error>,
    start: &SVector<f64, K>,
    period: usize,
) -> Result<PeriodicPoint<K>, Error> {
    let image = |x: &SVector<f64, K>| map(x);
    let slope = |x: &SVector<f64, K>| derivative(|x| iterate(&map, x, period), x);
    let number = |x: &[f64], _: f64| {
        Ok(Image::of_number(map(&SVector::from_column_slice(x))?.as_slice().to_vec(), None))
    };
    let sure = |x: &SVector<f64, K>| {
        let pushed = |curve: &[Jet<4>], parameter| differences(&number, curve, parameter);
        let found =
            Linearized::along_axes(number(x.as_slice(), 0.0)?, (x.as_slice(), 0.0), pushed)?;
        // The map has no parameter, whose column is the last one.
        let [matrix, errors] = [found.slopes, found.errors].map(|all| all.remove_column(K));
        let own = Uncertain { matrix, errors };
        Ok((SVector::from_column_slice(&found.image.point), own))
    };
    newton(image, slope, sure, start, period)
}

/// A point of period `period`, for a map that gives its derivative together with the image, as
/// [`next_with_derivative`](crate::ReturnMap::next_with_derivative) does. The multipliers are as accurate as the
/// derivative, whose own error is not known here: `multiplier_errors` are those of rounding alone.
///
/// # Errors
/// As [`periodic_point`], but for [`Error::Differences`].
pub fn periodic_point_with_derivative<const K: usize>(
    map: impl Fn(&SVector<f64, K>) -> Result<(SVector<f64, K>, SMatrix<f64, K, K>), Error>,
    start: &SVector<f64, K>,
    period: usize,
) -> Result<PeriodicPoint<K>, Error> {
    let image = |x: &SVector<f64, K>| Ok(map(x)?.0);
    let slope = |x: &SVector<f64, K>| {
        // Chain rule: the derivative of fᵖ is the product of the derivatives along the orbit.
        let (mut x, mut whole) = (*x, SMatrix::identity());
        for _ in 0..period {
            let (image, slope) = map(&x)?;
            (x, whole) = (image, slope * whole);
        }
        Ok(whole)
    };
    let sure = |x: &SVector<f64, K>| {
        let (image, slope) = map(x)?;
        let matrix = DMatrix::from_column_slice(K, K, slope.as_slice());
        let errors = matrix.abs() * f64::EPSILON;
        Ok((image, Uncertain { matrix, errors }))
    };
    newton(image, slope, sure, start, period)
}

/// fᵖ(x).
fn iterate<const K: usize>(
    map: impl Fn(&SVector<f64, K>) -> Result<SVector<f64, K>, Error>,
    x: &SVector<f64, K>,
    period: usize,
) -> Result<SVector<f64, K>, Error> {
    (0..period).try_fold(*x, |x, _| map(&x))
}

/// The image of a point, and the derivative of the map.
type ImageAndSlope<const K: usize> = (SVector<f64, K>, Uncertain);

/// Damped Newton steps on fᵖ(x) − x, given f, the derivative `whole` of fᵖ that leads there, and the derivative `sure` of f from which
/// the multipliers follow.
fn newton<const K: usize>(
    map: impl Fn(&SVector<f64, K>) -> Result<SVector<f64, K>, Error>,
    whole: impl Fn(&SVector<f64, K>) -> Result<SMatrix<f64, K, K>, Error>,
    sure: impl Fn(&SVector<f64, K>) -> Result<ImageAndSlope<K>, Error>,
    start: &SVector<f64, K>,
    period: usize,
) -> Result<PeriodicPoint<K>, Error> {
    check_period(period)?;
    let displacement = |x: &SVector<f64, K>| Ok::<_, Error>(iterate(&map, x, period)? - x);
    let none = |x: &SVector<f64, K>, residual: f64, steps: usize| {
        let point = x.iter().copied().collect();
        Error::NoPeriodicPoint { point, parameter: None, residual, steps }
    };
    let (mut x, mut rest) = (*start, displacement(start)?);
    // True if no part of a step lowers the residual, and the step is small enough to be noise.
    let mut stuck = false;
    for steps in 0..=NEWTON_STEPS {
        let whole = whole(&x)?;
        let slope = whole - SMatrix::identity();
        // Sixteen ulps a step of the map, of a point of size 1 at least: below it further Newton steps follow
        // rounding. A map of some dozen operations errs by a few ulps; the rest is a margin. For a map with larger
        // errors the residual stays above this, and the search ends by `NOISE`. A larger number would stop before the
        // last digits are right.
        let rounding = 16.0 * f64::EPSILON * period as f64 * (1.0 + x.amax());
        let step = solve(&slope, &rest);
        let tiny = step.is_some_and(|step| step.amax() <= rounding);
        // At a nearly singular derivative the residual is of rounding size even far from the point. Therefore the next
        // step must be tiny too, unless the residual is exactly zero or no steps are left.
        if stuck || rest.amax() <= rounding && (tiny || rest.amax() == 0.0 || steps == NEWTON_STEPS)
        {
            let along = |x: &SVector<f64, K>| {
                let (mut at, mut product) = sure(x)?;
                for _ in 1..period {
                    let (image, own) = sure(&at)?;
                    (at, product) = (image, product.after(&own));
                }
                Ok::<_, Error>(product)
            };
            let mut product = along(&x)?;
            // The rounding of the point grows on the way.
            if period > 1
                && let Ok(beside) = along(&(x * (1.0 + 4.0 * f64::EPSILON)))
            {
                product.errors += (beside.matrix - &product.matrix).abs();
            }
            let (multipliers, multiplier_errors) = product.eigenvalues();
            if multipliers.len() < K {
                return Err(none(&x, rest.amax(), steps));
            }
            let residual = rest.amax();
            return Ok(PeriodicPoint {
                location: x,
                period,
                residual,
                multipliers,
                multiplier_errors,
                steps,
            });
        }
        let Some(mut step) = step else { return Err(none(&x, rest.amax(), steps)) };
        let size = rest.amax();
        let whole_step = step.amax();
        let mut halvings = 0;
        loop {
            // A step may leave the domain of the map. Then it is halved as well.
            if let Ok(next) = displacement(&(x - step))
                && (next.amax() < size || size <= rounding)
            {
                (x, rest) = (x - step, next);
                break;
            }
            step *= 0.5;
            halvings += 1;
            if halvings > HALVINGS {
                // No part of the step lowers the residual. If the full step is tiny, the residual is the noise of the
                // map.
                if !(whole_step <= NOISE * (1.0 + x.amax())) {
                    return Err(none(&x, size, steps));
                }
                stuck = true;
                break;
            }
        }
    }
    Err(none(&x, rest.amax(), NEWTON_STEPS))
}

/// The solution of slope · step = rest; `None` for a singular matrix.
fn solve<const K: usize>(
    slope: &SMatrix<f64, K, K>,
    rest: &SVector<f64, K>,
) -> Option<SVector<f64, K>> {
    let matrix = DMatrix::from_column_slice(K, K, slope.as_slice());
    let side = DVector::from_column_slice(rest.as_slice());
    let solution = matrix.lu().solve(&side)?;
    Some(SVector::from_column_slice(solution.as_slice()))
}

/// The derivative of f at x by central differences: good enough for Newton's steps.
fn derivative<const K: usize>(
    f: impl Fn(&SVector<f64, K>) -> Result<SVector<f64, K>, Error>,
    x: &SVector<f64, K>,
) -> Result<SMatrix<f64, K, K>, Error> {
    // The cube root of an ulp ε. The rounding error ε/h and the truncation error h² are then of equal size, 4·10⁻¹¹.
    const STEP: f64 = 6e-6;
    let mut slope = SMatrix::<f64, K, K>::zeros();
    for axis in 0..K {
        let step = STEP * (1.0 + x[axis].abs());
        let (mut up, mut down) = (*x, *x);
        up[axis] += step;
        down[axis] -= step;
        slope.set_column(axis, &((f(&up)? - f(&down)?) / (up[axis] - down[axis])));
    }
    Ok(slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector1, Vector2};
    use proptest::prelude::*;

    #[test]
    fn the_two_cycle_of_the_logistic_map() {
        let map = |x: &Vector1<f64>| Ok(Vector1::new(3.2 * x[0] * (1.0 - x[0])));
        let point = periodic_point(map, &Vector1::new(0.5), 2).unwrap();
        // Roots of the second iterate: (r + 1 ± √((r+1)(r−3)))/(2r); its multiplier is 4 + 2r − r².
        let exact = (4.2 - (4.2f64 * 0.2).sqrt()) / 6.4;
        assert!((point.location[0] - exact).abs() < 1e-14, "{point:?}");
        assert!((point.multipliers[0].re - 0.16).abs() < 1e-8);
    }

    #[test]
    fn multipliers_are_exact_with_a_given_derivative() {
        let map = |x: &Vector1<f64>| {
            let slope = SMatrix::<f64, 1, 1>::new(3.2 * (1.0 - 2.0 * x[0]));
            Ok((Vector1::new(3.2 * x[0] * (1.0 - x[0])), slope))
        };
        let point = periodic_point_with_derivative(map, &Vector1::new(0.5), 2).unwrap();
        assert!((point.multipliers[0].re - 0.16).abs() < 1e-14, "{point:?}");
    }

    #[test]
    fn a_map_without_periodic_point_is_an_error() {
        let shift = |x: &Vector1<f64>| Ok(Vector1::new(x[0] + 1.0));
        assert!(matches!(
            periodic_point(shift, &Vector1::new(0.0), 1),
            Err(Error::NoPeriodicPoint { .. })
        ));
        let gap = |x: &Vector1<f64>| Ok(Vector1::new(x[0] * x[0] + 1.0));
        assert!(periodic_point(gap, &Vector1::new(0.3), 1).is_err());
        assert!(periodic_point(gap, &Vector1::new(0.3), 0).is_err());
        let half = |x: &Vector1<f64>| Ok(x * 0.5);
        assert!(matches!(
            periodic_point(half, &Vector1::new(0.3), usize::MAX),
            Err(Error::BadPeriod { period: usize::MAX, .. })
        ));
        let nowhere = |_: &Vector1<f64>| Ok(Vector1::new(f64::NAN));
        assert!(periodic_point(nowhere, &Vector1::new(0.3), 1).is_err());
    }

    proptest! {
        /// A linear map about a planted point has its location and its multipliers.
        #[test]
        fn planted_points_are_found(a in -5.0..5.0f64, b in -5.0..5.0f64, p in -0.9..0.9f64, q in 1.1..3.0f64, angle in 0.0..3.0f64) {
            let (sin, cos) = pxfm::f_sincos(angle);
            let rotation = SMatrix::<f64, 2, 2>::new(cos, -sin, sin, cos);
            let matrix = rotation * SMatrix::<f64, 2, 2>::new(p, 0.0, 0.0, q) * rotation.transpose();
            let center = Vector2::new(a, b);
            let map = |x: &Vector2<f64>| Ok(center + matrix * (x - center));
            let point = periodic_point(map, &Vector2::zeros(), 1).unwrap();
            prop_assert!((point.location - center).amax() < 1e-11);
            let mut found: Vec<f64> = point.multipliers.iter().map(|m| m.re).collect();
            found.sort_by(f64::total_cmp);
            prop_assert!((found[0] - p).abs() < 1e-7 && (found[1] - q).abs() < 1e-7, "{:?}", found);
        }
    }
}
