//! The unstable curve of a saddle, next to it: a cubic.

use crate::branches::{BranchPoint, size_of, solve_periodic};
use crate::error::Error;
use crate::families::{MapFamily, curve_after, orbit_after};
use crate::multipliers::null_vector;
use equations::{Jet, horner};
use nalgebra::{DMatrix, DVector};

/// The curve x(s) = x* + s v + s² w₂ + s³ w₃ that g = fⁿ maps to x(μ s), up to s⁴; of a negative multiplier g = f²ⁿ.
#[derive(Debug, Clone)]
pub(super) struct LocalCurve {
    /// The saddle.
    pub(super) saddle: BranchPoint,
    /// How often f is applied.
    pub(super) times: usize,
    /// μ > 1.
    pub(super) multiplier: f64,
    /// The coefficients of 1, s, s² and s³, for each component.
    terms: Vec<Jet<4>>,
    /// The curve is used for |s| up to this one.
    pub(super) reach: f64,
}

/// g maps the curve to itself as exactly as this, on the scale of the saddle: some roundings of a map by integration.
const EXACT: f64 = 1e-12;

/// Halvings of the reach, from the size of the saddle. A cubic is exact to 10⁻¹² at about a thousandth of the size.
const MOST_HALVINGS: usize = 60;

impl LocalCurve {
    pub(super) fn new<M: MapFamily + ?Sized>(
        map: &M,
        period: usize,
        start: (&[f64], f64),
    ) -> Result<LocalCurve, Error> {
        let (saddle, derivative) = solve_periodic(map, period, start)?;
        let no_saddle = || {
            map.stopped().unwrap_or_else(|| Error::NoSaddle {
                point: saddle.point.clone(),
                parameter: saddle.parameter,
                unstable: saddle.multipliers.iter().filter(|m| m.norm() > 1.0).count(),
            })
        };
        let unstable: Vec<_> = saddle.multipliers.iter().filter(|m| m.norm() > 1.0).collect();
        let &[own] = &unstable[..] else { return Err(no_saddle()) };
        if own.im != 0.0 {
            return Err(no_saddle());
        }
        let (times, derivative, multiplier) = match own.re < 0.0 {
            true => (2 * period, &derivative * &derivative, own.re * own.re),
            false => (period, derivative, own.re),
        };
        let n = derivative.nrows();
        let shifted = |by: f64| DMatrix::identity(n, n) * by - &derivative;
        let vector = null_vector(&shifted(multiplier)).ok_or_else(no_saddle)?;
        // With its largest component positive.
        let direction = &vector * vector[vector.iamax()].signum();
        let mut curve = LocalCurve {
            terms: saddle
                .point
                .iter()
                .zip(direction.iter())
                .map(|(x, v)| Jet([*x, *v, 0.0, 0.0]))
                .collect(),
            saddle,
            times,
            multiplier,
            reach: 0.0,
        };
        for order in [2, 3] {
            // What g makes of the terms so far is μᵏ w less A w.
            let parameter = Jet::number(curve.saddle.parameter);
            let image = curve_after(map, (curve.terms.clone(), parameter), times)?;
            let side = DVector::from_iterator(n, image.iter().map(|jet| jet.0[order]));
            let power = multiplier.powi(order as i32);
            let term = shifted(power).lu().solve(&side);
            let Some(term) = term else { break };
            curve.terms.iter_mut().zip(term.iter()).for_each(|(own, term)| own.0[order] = *term);
        }
        let size = size_of(&curve.saddle.point);
        let mut reach = size;
        for _ in 0..MOST_HALVINGS {
            reach *= 0.5;
            if curve.is_exact(map, reach, EXACT * size) {
                return Ok(LocalCurve { reach, ..curve });
            }
        }
        let BranchPoint { point, parameter, .. } = curve.saddle;
        Err(map.stopped().unwrap_or(Error::NoSaddle { point, parameter, unstable: 1 }))
    }

    /// The point at s.
    pub(super) fn at(&self, s: f64) -> Vec<f64> {
        self.terms.iter().map(|jet| horner(&jet.0, s)).collect()
    }

    /// The curve x(s + r ε), of ε.
    pub(super) fn moving(&self, s: f64, rate: f64) -> Vec<Jet<4>> {
        let of = |jet: &Jet<4>| {
            let [here, first, second, third] = jet.0;
            Jet([
                horner(&[here, first, second, third], s),
                horner(&[first, 2.0 * second, 3.0 * third], s) * rate,
                horner(&[second, 3.0 * third], s) * rate * rate,
                third * rate * rate * rate,
            ])
        };
        self.terms.iter().map(of).collect()
    }

    /// True if g maps x(s/μ) to x(s), on both sides, with the same pieces of the map.
    fn is_exact<M: MapFamily + ?Sized>(&self, map: &M, s: f64, error: f64) -> bool {
        [s, -s, 0.5 * s, -0.5 * s].into_iter().all(|s| {
            let start = (&self.at(s / self.multiplier)[..], self.saddle.parameter);
            let Ok((at, itinerary)) = orbit_after(map, start, self.times) else { return false };
            let off =
                at.iter().zip(self.at(s)).fold(0.0, |off: f64, (a, b)| off.max((a - b).abs()));
            off <= error && itinerary.starts_with(&self.saddle.itinerary)
        })
    }
}
