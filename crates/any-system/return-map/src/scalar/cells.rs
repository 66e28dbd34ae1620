//! A function on an interval by polynomials on cells.

use crate::error::Error;
use equations::{Arithmetic, Jet};
use pxfm::f_cospi;

/// A polynomial on an interval: Chebyshev coefficients.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Cell {
    pub(super) left: f64,
    pub(super) right: f64,
    coefficients: Vec<f64>,
}

/// The degree of a polynomial before terms that do not count are left out. A larger one needs fewer cells and more time at each value.
const DEGREE: usize = 16;

/// A part of the tolerance that the terms may have that are left out.
const LEFT_OUT: f64 = 0.1;

/// A cell is halved if at one of its tests it is further from the function than this part of the tolerance: between the tests it
/// may be further.
const TESTED: f64 = 0.25;

/// The smallest cell, on the scale of its ends: some roundings.
const NARROWEST: f64 = 4.0 * f64::EPSILON;

impl Cell {
    /// The value by Clenshaw's recurrence, for numbers and jets.
    fn clenshaw<A: Arithmetic>(&self, x: &A, number: impl Fn(f64) -> A) -> A {
        let double = A::sum(x, x);
        let (mut one, mut two) = (A::zero(), A::zero());
        for &coefficient in self.coefficients.iter().skip(1).rev() {
            let next =
                A::sum(&A::difference(&A::product(&double, &one), &two), &number(coefficient));
            (two, one) = (one, next);
        }
        let first = number(self.coefficients.first().copied().unwrap_or(f64::NAN));
        A::sum(&A::difference(&A::product(x, &one), &two), &first)
    }

    /// The value at a point of the cell.
    pub(super) fn value(&self, x: f64) -> f64 {
        let inside = ((x - self.left) - (self.right - x)) / (self.right - self.left);
        self.clenshaw(&inside, |number| number)
    }

    /// The image of a curve.
    pub(super) fn pushed<const T: usize>(&self, x: &Jet<T>) -> Jet<T> {
        let unit = 2.0 / (self.right - self.left);
        let mut inside = Jet(x.0.map(|term| term * unit));
        inside.0[0] = ((x.value() - self.left) - (self.right - x.value())) * (0.5 * unit);
        self.clenshaw(&inside, Jet::number)
    }

    /// A bound on the slope: that of the polynomial of Chebyshev Tₙ is at most n².
    pub(super) fn steepest(&self) -> f64 {
        let terms = self.coefficients.iter().enumerate();
        let sum: f64 = terms.map(|(n, term)| (n * n) as f64 * term.abs()).sum();
        2.0 * sum / (self.right - self.left)
    }

    /// How far the slope may be off where the values are off by this: the slope of a polynomial of degree n is at most n² times its values, on
    /// [−1, 1] (A. A. Markov).
    pub(super) fn slope_error(&self, error: f64) -> f64 {
        (DEGREE * DEGREE) as f64 * 2.0 * error / (self.right - self.left)
    }

    /// The polynomial through the function at the Chebyshev points of the second kind, without the last terms that are below `small`.
    fn new(values: &[f64], (left, right): (f64, f64), small: f64) -> Cell {
        let n = values.len() - 1;
        let end = |k: usize| if k == 0 || k == n { 0.5 } else { 1.0 };
        let term = |j: usize| {
            let products = values
                .iter()
                .enumerate()
                .map(|(k, value)| end(k) * value * f_cospi((j * k % (2 * n)) as f64 / n as f64));
            end(j) * 2.0 / n as f64 * products.sum::<f64>()
        };
        let mut coefficients: Vec<f64> = (0..=n).map(term).collect();
        let mut sum = 0.0;
        while coefficients.len() > 1 {
            sum += coefficients.last().map_or(0.0, |last| last.abs());
            if !(sum <= small) {
                break;
            }
            coefficients.pop();
        }
        Cell { left, right, coefficients }
    }

    /// True for a cell that may be evaluated: of a file.
    #[cfg(feature = "serde")]
    pub(super) fn is_sound(&self) -> bool {
        self.left < self.right
            && (self.right - self.left).is_finite()
            && !self.coefficients.is_empty()
            && self.coefficients.iter().all(|term| term.is_finite())
    }
}

/// Polynomials that are as near to a function as the tolerance, on cells from left to right, and the largest difference at
/// any test. The values must be finite.
///
/// Each cell is tested halfway between the points of its polynomial, and at one more point. A cell of a few roundings is not halved: the
/// function jumps there, or has noise.
pub(super) fn cells(
    function: &impl Fn(f64) -> Result<f64, Error>,
    (left, right): (f64, f64),
    tolerance: f64,
) -> Result<(Vec<Cell>, f64), Error> {
    let mut todo = vec![(left, right)];
    let (mut done, mut worst) = (Vec::new(), 0f64);
    while let Some((left, right)) = todo.pop() {
        let at = |place: f64| {
            // From the nearer end, so that the ends are met.
            let s = f_cospi(place / DEGREE as f64);
            let x = if s > 0.0 {
                right - 0.5 * (1.0 - s) * (right - left)
            } else {
                left + 0.5 * (1.0 + s) * (right - left)
            };
            x.clamp(left, right)
        };
        let values: Vec<f64> =
            (0..=DEGREE).map(|k| function(at(k as f64))).collect::<Result<_, _>>()?;
        let cell = Cell::new(&values, (left, right), LEFT_OUT * tolerance);
        let mut off = 0f64;
        // The last one is in no simple ratio to the others: a term that vanishes at all of them is seen.
        for place in (0..DEGREE).map(|k| k as f64 + 0.5).chain([0.381_966 * DEGREE as f64]) {
            let x = at(place);
            off = off.max((cell.value(x) - function(x)?).abs());
        }
        let middle = left + 0.5 * (right - left);
        let narrow = right - left <= NARROWEST * left.abs().max(right.abs());
        if off <= TESTED * tolerance || narrow || middle <= left || middle >= right {
            worst = worst.max(off);
            done.push(cell);
            continue;
        }
        if done.len() + todo.len() > MOST_CELLS {
            return Err(Error::ManyPieces { left, at: middle, most: MOST_CELLS });
        }
        todo.push((middle, right));
        todo.push((left, middle));
    }
    Ok((done, worst))
}

/// Most cells: some 20 MB. Smooth functions need some tens; noise above the tolerance would need as many as there are numbers.
const MOST_CELLS: usize = 100_000;
