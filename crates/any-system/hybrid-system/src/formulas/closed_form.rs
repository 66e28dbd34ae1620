//! Motions with a closed form: linear fields, with components one after the other or two by two.
//!
//! A component x with ẋ = a x + q(t), or two of them with a constant matrix, have a closed form where q is a
//! quasi-polynomial: polynomials in time, exponentials, oscillators x″ + 2ζx′ + ω²x with polynomial, exponential or
//! harmonic forcing. With μ = σ + iω for a term e^(μt) Σ G_k t^k of q, and B for the matrix, the motion has the term
//! e^(μt) Σ Y_k t^k, and begins as the start says:
//!
//! ```text
//!   (μ − B) Y_k = G_k − (k + 1) Y_(k+1)        x(t) = y(t) + e^(Bt) (x₀ − y(0))
//! ```
//!
//! All numbers are enclosures. Where one of them does not tell a double root from two near ones, or a resonance from a
//! forcing beside it, there is no closed form, and the motion is integrated.

use super::exact::{difference, product, quotient, sum};
use super::quasi_values::{enclosed, needed, quasi_value, term};
use crate::crossing::{QuasiPolynomial, Rounded, Term};
use equations::{Binary, Formulas, Node, Unary};
use interval_arithmetic::Enclosure;
use smallvec::{SmallVec, smallvec};

/// The most components of a state that are looked at: the order of the blocks takes the cube of it.
const MOST_COMPONENTS: usize = 32;

/// Components that depend on each other, with their constant matrix.
#[derive(Debug)]
struct Block {
    components: Vec<usize>,
    /// Row by row, with one or four entries.
    matrix: Vec<Enclosure>,
}

/// A field whose motions have a closed form, as far as its structure shows.
#[derive(Debug)]
pub(super) struct ClosedForm {
    field: Formulas,
    /// Each block needs only those before it.
    blocks: Vec<Block>,
}

impl ClosedForm {
    /// The structure of a field; `None` if its motions have no closed form of this kind.
    pub(super) fn of(field: &Formulas) -> Option<ClosedForm> {
        let count = field.count();
        if count > MOST_COMPONENTS || field.uses_time() {
            return None;
        }
        let entries = field.jacobian().ok()?.constants();
        let depends =
            |row: usize, column: usize| entries[row * count + column] != Some(Enclosure::ZERO);
        // Also over others.
        let mut reaches: Vec<Vec<bool>> =
            (0..count).map(|row| (0..count).map(|column| depends(row, column)).collect()).collect();
        for over in 0..count {
            for row in 0..count {
                for column in 0..count {
                    reaches[row][column] |= reaches[row][over] && reaches[over][column];
                }
            }
        }
        let mut blocks: Vec<Block> = Vec::new();
        let mut done = vec![false; count];
        while let Some(next) = (0..count).find(|&row| {
            let is_known = |column: usize| {
                done[column] || column == row || reaches[column][row] || !reaches[row][column]
            };
            !done[row] && (0..count).all(is_known)
        }) {
            let with =
                |other: &usize| *other == next || reaches[next][*other] && reaches[*other][next];
            let components: Vec<usize> = (0..count).filter(with).collect();
            if components.len() > 2 {
                return None;
            }
            if !components.iter().all(|&row| is_affine(field, row, &components)) {
                return None;
            }
            let pairs = components.iter().flat_map(|row| components.iter().map(move |c| (row, c)));
            let matrix = pairs.map(|(row, column)| entries[row * count + column]);
            let matrix = matrix.collect::<Option<Vec<_>>>()?;
            components.iter().for_each(|&component| done[component] = true);
            blocks.push(Block { components, matrix });
        }
        done.iter().all(|done| *done).then(|| ClosedForm { field: field.clone(), blocks })
    }

    /// The components in time from a start; `None` if they are not quasi-polynomials with coefficients that are known
    /// well.
    pub(super) fn motion(&self, start: &[f64]) -> Option<Vec<QuasiPolynomial>> {
        let mut known: Vec<Option<QuasiPolynomial>> = vec![None; start.len()];
        for block in &self.blocks {
            // The matrix stands for their own influence.
            block.components.iter().for_each(|&own| known[own] = Some(QuasiPolynomial::default()));
            let forcing = block.components.iter().map(|&own| quasi_value(&self.field, own, &known));
            let forcing = forcing.collect::<Option<Vec<_>>>()?;
            let from: Vec<f64> = block.components.iter().map(|&own| start[own]).collect();
            let found = match block.components.len() {
                1 => vec![single(block.matrix[0], &forcing[0], from[0])?],
                _ => pair(&block.matrix, &forcing, &from)?,
            };
            for (&own, found) in block.components.iter().zip(found) {
                known[own] = (is_known(&found) && found.check().is_ok()).then_some(found);
                known[own].as_ref()?;
            }
        }
        known.into_iter().collect()
    }
}

/// True if a formula is a sum of these components times what does not move with them: `0*sqrt(x)` has the derivative zero, and
/// no value below zero.
fn is_affine(field: &Formulas, row: usize, components: &[usize]) -> bool {
    let (nodes, outputs) = field.nodes();
    let needed = needed(nodes, outputs[row]);
    let mut moves = vec![false; needed.len()];
    for place in (0..needed.len()).filter(|&place| needed[place]) {
        let node = &nodes[place];
        let is_moving = match *node {
            Node::State(at) => components.contains(&at),
            _ => node.operands().any(|operand| moves[operand]),
        };
        let is_linear = match *node {
            Node::State(_) | Node::Unary(Unary::Negative, _) => true,
            Node::Binary(Binary::Sum | Binary::Difference, ..) => true,
            Node::Binary(Binary::Product, a, b) => !(moves[a] && moves[b]),
            Node::Binary(Binary::Quotient, _, b) => !moves[b],
            _ => false,
        };
        if is_moving && !is_linear {
            return false;
        }
        moves[place] = is_moving;
    }
    true
}

/// The largest error of a coefficient, relative to the largest one. Near a resonance and near a double root coefficients are
/// large, and their errors hide the signs of the motion at its start. A larger number would hide more; a smaller one would
/// integrate what has a closed form.
const KNOWN: f64 = 1e-11;

/// The largest bound on the error of a closed form, relative to its own size on the motion. Coefficients are large and cancel
/// where a root is small beside the forcing, near a resonance and near a double root. The bound is some ten times the error. A
/// larger number would give motions with fewer digits than an integration; a smaller one would integrate what has a closed
/// form.
const SHARP: f64 = 1e-10;

/// True if the coefficients are known well beside the largest one: else the signs of the motion at its start are hidden.
fn is_known(function: &QuasiPolynomial) -> bool {
    let numbers = || function.terms().iter().flat_map(|term| term.cos.iter().chain(&term.sin));
    let largest = numbers().map(|number| number.value.abs()).fold(0.0, f64::max);
    numbers().all(|number| number.error <= KNOWN * largest)
}

/// Parts of a motion at which its size is looked at: its ends, and some that no periodic motion passes at zero.
const LOOKS: [f64; 8] = [0.0, 1.0, 0.382, 0.764, 0.146, 0.528, 0.910, 0.292];

/// True if the errors of a function up to a time are small beside its size there, or below the absolute tolerance.
///
/// The errors of rates and frequencies do not count: they are some roundings, as those of the model's own numbers, and an
/// integration has these too.
pub(super) fn is_sharp(function: &QuasiPolynomial, time: f64, absolute: f64) -> bool {
    let error = function.error_until(time);
    LOOKS.iter().any(|part| error <= SHARP * function.value(part * time).abs() + absolute)
}

/// A complex number.
#[derive(Debug, Clone, Copy)]
struct Complex {
    re: Enclosure,
    im: Enclosure,
}

impl Complex {
    const ZERO: Complex = Complex { re: Enclosure::ZERO, im: Enclosure::ZERO };

    fn real(re: Enclosure) -> Self {
        Complex { re, im: Enclosure::ZERO }
    }
    fn plus(self, other: Self) -> Self {
        Complex { re: sum(self.re, other.re), im: sum(self.im, other.im) }
    }
    fn minus(self, other: Self) -> Self {
        Complex { re: difference(self.re, other.re), im: difference(self.im, other.im) }
    }
    fn times(self, other: Self) -> Self {
        Complex {
            re: difference(product(self.re, other.re), product(self.im, other.im)),
            im: sum(product(self.re, other.im), product(self.im, other.re)),
        }
    }
    /// The quotient; `None` if the divisor may be zero.
    fn over(self, other: Self) -> Option<Self> {
        let size = sum(product(other.re, other.re), product(other.im, other.im));
        if !size.is_positive() {
            return None;
        }
        let turned = self.times(Complex { re: other.re, im: -other.im });
        Some(Complex { re: quotient(turned.re, size), im: quotient(turned.im, size) })
    }
    fn is_zero(self) -> bool {
        self.re == Enclosure::ZERO && self.im == Enclosure::ZERO
    }
}

/// Few coefficients, without allocating.
type Few<T> = SmallVec<[T; 3]>;

/// μ and the coefficients G of the real part of e^(μt) Σ G_k t^k.
fn exponential_form(Term { sigma, omega, cos, sin }: &Term) -> (Complex, Few<Complex>) {
    let mu = Complex { re: enclosed(*sigma), im: enclosed(*omega) };
    let at = |list: &[Rounded], k: usize| list.get(k).map_or(Enclosure::ZERO, |c| enclosed(*c));
    let length = cos.len().max(sin.len());
    let coefficient = |k| Complex { re: at(cos, k), im: -at(sin, k) };
    (mu, (0..length).map(coefficient).collect())
}

fn real_form(mu: Complex, coefficients: &[Complex]) -> QuasiPolynomial {
    let cos: Few<Enclosure> = coefficients.iter().map(|y| y.re).collect();
    let sin: Few<Enclosure> = coefficients.iter().map(|y| -y.im).collect();
    QuasiPolynomial::from_terms(vec![term(mu.re, mu.im, (&cos, &sin))])
}

fn whole(k: usize) -> Complex {
    Complex::real(Enclosure::from(k as f64))
}

/// x with ẋ = a x + q(t) from a start.
fn single(a: Enclosure, forcing: &QuasiPolynomial, start: f64) -> Option<QuasiPolynomial> {
    let mut found = QuasiPolynomial::default();
    let mut at_start = Enclosure::ZERO;
    for part in forcing.terms() {
        let (mu, g) = exponential_form(part);
        let distance = mu.minus(Complex::real(a));
        let mut y: Few<Complex> = smallvec![Complex::ZERO; g.len() + 1];
        if distance.is_zero() {
            // y = Σ G_k t^(k+1)/(k + 1).
            for (k, g) in g.iter().enumerate() {
                y[k + 1] = g.over(whole(k + 1))?;
            }
        } else {
            for k in (0..g.len()).rev() {
                y[k] = g[k].minus(whole(k + 1).times(y[k + 1])).over(distance)?;
            }
            y.pop();
        }
        at_start = sum(at_start, y.first().map_or(Enclosure::ZERO, |y| y.re));
        found = found + real_form(mu, &y);
    }
    let own = Complex::real(difference(Enclosure::from(start), at_start));
    Some(found + real_form(Complex::real(a), &[own]))
}

/// Two components with a constant matrix.
fn pair(
    matrix: &[Enclosure],
    forcing: &[QuasiPolynomial],
    start: &[f64],
) -> Option<Vec<QuasiPolynomial>> {
    let &[a, b, c, d] = matrix else { return None };
    let mut found = [QuasiPolynomial::default(), QuasiPolynomial::default()];
    let mut left = [start[0], start[1]].map(Enclosure::from);
    for (row, forcing) in forcing.iter().enumerate() {
        for part in forcing.terms() {
            let (mu, g) = exponential_form(part);
            // The inverse of [[μ − a, −b], [−c, μ − d]].
            let (first, last) = (mu.minus(Complex::real(a)), mu.minus(Complex::real(d)));
            let determinant = first.times(last).minus(Complex::real(product(b, c)));
            let mut y: Few<[Complex; 2]> = smallvec![[Complex::ZERO; 2]; g.len() + 1];
            for k in (0..g.len()).rev() {
                let mut right = y[k + 1].map(|y| Complex::ZERO.minus(whole(k + 1).times(y)));
                right[row] = right[row].plus(g[k]);
                let [p, q] = right;
                y[k] = [
                    last.times(p).plus(Complex::real(b).times(q)).over(determinant)?,
                    Complex::real(c).times(p).plus(first.times(q)).over(determinant)?,
                ];
            }
            y.pop();
            for (axis, found) in found.iter_mut().enumerate() {
                let own: Few<Complex> = y.iter().map(|y| y[axis]).collect();
                left[axis] = difference(left[axis], own.first().map_or(Enclosure::ZERO, |y| y.re));
                *found = std::mem::take(found) + real_form(mu, &own);
            }
        }
    }
    let own = free(matrix, left)?;
    Some(found.into_iter().zip(own).map(|(found, own)| found + own).collect())
}

/// The square root, exact where it is a number.
fn root(square: Enclosure) -> Option<Enclosure> {
    let near = Enclosure::from(square.middle().sqrt());
    if product(near, near) == square { Some(near) } else { square.sqrt() }
}

/// The roots τ ± r. The smaller one, in which τ and r cancel, is the determinant over the larger one.
fn real_roots(matrix: &[Enclosure], middle: Enclosure, root: Enclosure) -> [Enclosure; 2] {
    let (mut upper, mut lower) = (sum(middle, root), difference(middle, root));
    let &[a, b, c, d] = matrix else { return [upper, lower] };
    let determinant = difference(product(a, d), product(b, c));
    let narrower = |direct: Enclosure, large: Enclosure| {
        let by_product = quotient(determinant, large);
        if by_product.width() < direct.width() { by_product } else { direct }
    };
    if middle.is_negative() {
        upper = narrower(upper, lower);
    } else if middle.is_positive() {
        lower = narrower(lower, upper);
    }
    [upper, lower]
}

/// e^(Bt) u.
fn free(matrix: &[Enclosure], u: [Enclosure; 2]) -> Option<[QuasiPolynomial; 2]> {
    let &[a, b, c, d] = matrix else { return None };
    let half = |x: Enclosure| product(Enclosure::from(0.5), x);
    let (middle, radius) = (half(sum(a, d)), half(difference(a, d)));
    // (B − τ) u, and the square of the distance of the roots from their middle τ.
    let bent = [
        sum(product(radius, u[0]), product(b, u[1])),
        difference(product(c, u[0]), product(radius, u[1])),
    ];
    let square = sum(product(radius, radius), product(b, c));
    let zero = Enclosure::ZERO;
    let of = |axis: usize| -> Option<Vec<Term>> {
        let (u, bent) = (u[axis], bent[axis]);
        if square == zero {
            return Some(vec![term(middle, zero, (&[u, bent], &[]))]);
        }
        if square.is_negative() {
            let omega = root(-square)?;
            return Some(vec![term(middle, omega, (&[u], &[quotient(bent, omega)]))]);
        }
        if square.is_positive() {
            let root = root(square)?;
            let other = quotient(bent, root);
            let [upper, lower] = real_roots(matrix, middle, root);
            return Some(vec![
                term(upper, zero, (&[half(sum(u, other))], &[])),
                term(lower, zero, (&[half(difference(u, other))], &[])),
            ]);
        }
        None
    };
    Some([QuasiPolynomial::from_terms(of(0)?), QuasiPolynomial::from_terms(of(1)?)])
}
