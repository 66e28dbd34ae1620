//! Boxes of any dimension.

use crate::error::Error;
use crate::space::interval::Interval;
use crate::statistics::split_mix::SplitMix64;

/// A region of the line, the plane, or a space of any dimension: one interval for each coordinate.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval};
/// let window = Hyperrectangle::new(vec![Interval::new(-2.0, 2.0)?, Interval::new(0.0, 1.0)?])?;
/// assert_eq!((window.dimension(), window.volume()), (2, 4.0));
/// assert!(window.contains(&[0.5, 0.5]) && !window.contains(&[0.5, 1.5]));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Hyperrectangle {
    sides: Vec<Interval>,
}

impl Hyperrectangle {
    /// The points whose coordinate k lies in `sides[k]`.
    ///
    /// # Errors
    /// [`Error::NoDimension`] without sides; [`Error::BadInterval`] for a side as for [`Interval::new`], and for one
    /// of length 0.
    pub fn new(sides: Vec<Interval>) -> Result<Self, Error> {
        if sides.is_empty() {
            return Err(Error::NoDimension);
        }
        for &Interval { left, right } in &sides {
            Interval::new(left, right)?;
            if left == right || !(right - left).is_finite() {
                return Err(Error::BadInterval { left, right });
            }
        }
        Ok(Hyperrectangle { sides })
    }

    /// The interval of each coordinate.
    pub fn sides(&self) -> &[Interval] {
        &self.sides
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.sides.len()
    }

    /// The product of the lengths of the sides.
    pub fn volume(&self) -> f64 {
        self.sides.iter().map(Interval::length).product()
    }

    /// Whether a point lies in the region; `false` for a point of another dimension.
    pub fn contains(&self, point: &[f64]) -> bool {
        point.len() == self.sides.len()
            && self.sides.iter().zip(point).all(|(side, &x)| side.contains(x))
    }

    /// Random point `number` of this generator, uniform in the region. It uses one random number for each coordinate.
    pub fn random_point(&self, random: &SplitMix64, number: u64) -> Vec<f64> {
        let dimension = self.sides.len() as u64;
        let coordinate = |(k, side): (u64, &Interval)| {
            side.left
                + side.length() * random.uniform(number.wrapping_mul(dimension).wrapping_add(k))
        };
        (0..).zip(&self.sides).map(coordinate).collect()
    }
}

/// A line is a region of dimension 1.
impl TryFrom<Interval> for Hyperrectangle {
    type Error = Error;

    fn try_from(side: Interval) -> Result<Self, Error> {
        Hyperrectangle::new(vec![side])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_that_are_no_intervals_are_refused() {
        assert_eq!(Hyperrectangle::new(Vec::new()), Err(Error::NoDimension));
        for (left, right) in [(1.0, 0.0), (0.0, f64::NAN), (0.5, 0.5), (f64::MIN, f64::MAX)] {
            let side = Interval { left, right };
            assert!(matches!(Hyperrectangle::try_from(side), Err(Error::BadInterval { .. })));
        }
    }

    #[test]
    fn random_points_have_the_mean_of_the_region() {
        let sides = vec![Interval { left: -1.0, right: 3.0 }, Interval { left: 5.0, right: 6.0 }];
        let region = Hyperrectangle::new(sides).unwrap();
        let random = SplitMix64::from_seed(3);
        let points: Vec<Vec<f64>> = (0..10_000).map(|k| region.random_point(&random, k)).collect();
        assert!(points.iter().all(|point| region.contains(point)));
        let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / 1e4;
        assert!((mean(0) - 1.0).abs() < 0.05 && (mean(1) - 5.5).abs() < 0.02);
    }
}
