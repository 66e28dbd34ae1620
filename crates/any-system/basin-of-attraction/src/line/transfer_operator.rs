//! The transfer operator of full branches at Chebyshev nodes.

use crate::error::Error;
use crate::line::full_branches::{ROUNDING, refused};
use crate::space::interval::Interval;
use interval_arithmetic::bracketed_root;

/// Squarings of the operator: 2⁴⁰ steps of the power method. The second eigenvalue is smaller by the contraction of the branches, which is some 10⁻¹¹ at
/// least.
const MOST_SQUARINGS: usize = 40;

/// A function that the operator changes less than this, beside its factor, is found. More nodes are tried where there is none.
const FOUND: f64 = 1e-9;

/// What an operator says of the set that the branches leave.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers {
    pub(crate) dimension: f64,
    pub(crate) escape_rate: f64,
    /// How far both may be off by rounding.
    pub(crate) error: f64,
}

/// The transfer operator at some nodes.
pub(crate) struct Operator {
    /// For each node and branch the slope there.
    slopes: Vec<Vec<f64>>,
    /// For each node and branch the weights of the nodes at the preimage.
    weights: Vec<Vec<Vec<f64>>>,
}

impl Operator {
    pub(crate) fn new(
        branches: usize,
        interval: Interval,
        inverse: &impl Fn(usize, f64) -> (f64, f64),
        nodes: usize,
    ) -> Result<Operator, Error> {
        let middle = 0.5 * (interval.left + interval.right);
        let half = 0.5 * (interval.right - interval.left);
        let place = |j: usize| pxfm::f_cospi((j as f64 + 0.5) / nodes as f64);
        let (mut slopes, mut weights) = (Vec::new(), Vec::new());
        for j in 0..nodes {
            let x = middle + half * place(j);
            let (mut own_slopes, mut own_weights) = (Vec::new(), Vec::new());
            for k in 0..branches {
                let (preimage, slope) = inverse(k, x);
                if !(slope > 0.0 && slope.is_finite() && preimage.is_finite()) {
                    return Err(refused("the slope of an inverse branch", slope, ""));
                }
                own_slopes.push(slope);
                own_weights.push(interpolation((preimage - middle) / half, nodes));
            }
            slopes.push(own_slopes);
            weights.push(own_weights);
        }
        Ok(Operator { slopes, weights })
    }

    /// The largest eigenvalue at s, and how far it is off as a part of it: by squares of the operator.
    fn eigenvalue(&self, s: f64) -> Result<(f64, f64), Error> {
        let count = self.slopes.len();
        let mut rows = vec![0.0; count * count];
        for (row, (slopes, weights)) in
            rows.chunks_exact_mut(count).zip(self.slopes.iter().zip(&self.weights))
        {
            for (slope, weights) in slopes.iter().zip(weights) {
                let factor = pxfm::f_pow(*slope, s);
                row.iter_mut().zip(weights).for_each(|(sum, w)| *sum += factor * w);
            }
        }
        let mut power = rows.clone();
        let (mut value, mut off) = (f64::NAN, f64::INFINITY);
        for _ in 0..MOST_SQUARINGS {
            power = squared(&power, count);
            let function: Vec<f64> =
                power.chunks_exact(count).map(|row| row.iter().sum()).collect();
            let image = rows.chunks_exact(count);
            let image: Vec<f64> =
                image.map(|row| row.iter().zip(&function).map(|(a, b)| a * b).sum()).collect();
            let sum: f64 = function.iter().sum();
            value = image.iter().sum::<f64>() / sum;
            let largest = function.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let apart = image.iter().zip(&function).map(|(a, b)| (a - value * b).abs());
            let before = off;
            off = apart.fold(0.0, f64::max) / (value * largest).abs();
            if off <= ROUNDING || off >= before && off <= FOUND {
                return Ok((value, off.min(before).max(ROUNDING)));
            }
        }
        if off <= FOUND && value > 0.0 {
            return Ok((value, off));
        }
        let remedy = ": it has no positive function; the branches do not contract, or their slopes vary too much for 60 nodes";
        Err(refused("an eigenvalue", value, remedy))
    }

    /// The dimension and the escape rate, off by rounding alone.
    pub(crate) fn numbers(&self) -> Result<Numbers, Error> {
        let dimension = self.dimension()?;
        let (at_one, off) = self.eigenvalue(1.0)?;
        // d ln λ/ds, by a difference: where it is small, rounding moves the root far.
        let (below, above) = ((dimension - 1e-3).max(0.0), (dimension + 1e-3).min(1.0));
        let ((low, _), (high, _)) = (self.eigenvalue(below)?, self.eigenvalue(above)?);
        let rate = (pxfm::f_log(low) - pxfm::f_log(high)) / (above - below);
        let of_root = self.eigenvalue(dimension)?.1 / rate.abs();
        // The eigenvalue of branches that fill the interval is 1 to rounding.
        let escape_rate = (-pxfm::f_log(at_one)).max(0.0);
        let error = off.max(if self.slopes[0].len() == 1 { 0.0 } else { of_root });
        Ok(Numbers { dimension, escape_rate, error })
    }

    /// The s at which the eigenvalue is 1.
    fn dimension(&self) -> Result<f64, Error> {
        let largest = self.slopes.iter().flatten().fold(0.0, |most: f64, slope| most.max(*slope));
        let contracts = |(value, off): (f64, f64)| value + 4.0 * off < 1.0;
        if !(largest < 1.0) && !contracts(self.eigenvalue(1.0)?) {
            let remedy = ": inverse branches must contract";
            return Err(refused("the largest slope of inverse branches", largest, remedy));
        }
        let failed = std::cell::RefCell::new(None);
        let off = |s: f64| match self.eigenvalue(s) {
            Ok((value, _)) => pxfm::f_log(value),
            Err(error) => {
                *failed.borrow_mut() = Some(error);
                f64::NAN
            }
        };
        let (at_zero, at_one) = (off(0.0), off(1.0));
        if let Some(error) = failed.borrow_mut().take() {
            return Err(error);
        }
        // One branch has one point; branches that fill the interval leave nothing out.
        if self.slopes[0].len() == 1 {
            return Ok(0.0);
        }
        if at_one >= 0.0 {
            return Ok(1.0);
        }
        let root = bracketed_root(off, 0.0, 1.0);
        let none = || refused("an eigenvalue", at_zero, ": it is 1 nowhere");
        failed.into_inner().map_or_else(|| root.map_err(|_| none()), Err)
    }
}

/// The square of a matrix, row by row, over its largest element.
fn squared(matrix: &[f64], count: usize) -> Vec<f64> {
    let mut found = vec![0.0; count * count];
    for (row, own) in found.chunks_exact_mut(count).zip(matrix.chunks_exact(count)) {
        for (factor, other) in own.iter().zip(matrix.chunks_exact(count)) {
            row.iter_mut().zip(other).for_each(|(sum, x)| *sum += factor * x);
        }
    }
    let largest = found.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    found.iter_mut().for_each(|x| *x /= largest);
    found
}

/// The weights of the values at Chebyshev nodes at a place in [−1, 1].
fn interpolation(place: f64, nodes: usize) -> Vec<f64> {
    // Of the barycentric formula.
    let node = |j: usize| pxfm::f_cospi((j as f64 + 0.5) / nodes as f64);
    let sign = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
    let own = (0..nodes).find(|&j| place == node(j));
    let mut weights: Vec<f64> = (0..nodes)
        .map(|j| match own {
            Some(own) => f64::from(own == j),
            None => sign(j) * pxfm::f_sinpi((j as f64 + 0.5) / nodes as f64) / (place - node(j)),
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    weights
}
