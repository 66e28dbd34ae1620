//! Formulas of quasi-polynomials: sums of polynomials in time times exponentials, sines and cosines.
//!
//! Where the components of a state are quasi-polynomials in time, so are sums and products of them, and sines, cosines and
//! exponentials of straight lines. Every number has a bound on its error.

use crate::crossing::{QuasiPolynomial, QuasiPolynomialPart};
use equations::{Algebra, Arithmetic, Binary, Formulas, Node, Unary};
use interval_arithmetic::Enclosure;

/// The most terms of a quasi-polynomial, and the most coefficients of one: a formula with more is left to the integration.
/// Products of larger ones take milliseconds, and powers of a high degree cancel.
const MOST_TERMS: usize = 32;
const MOST_COEFFICIENTS: usize = 64;

fn is_short(function: &QuasiPolynomial) -> bool {
    let (terms, coefficients) = function.size();
    terms <= MOST_TERMS && coefficients <= MOST_COEFFICIENTS
}

/// A number with the bound on its error that holds an enclosure.
pub(super) fn with_error(number: Enclosure) -> (f64, f64) {
    let middle = number.middle();
    let error = (number.high - middle).max(middle - number.low);
    (middle, if error == 0.0 { 0.0 } else { error.next_up() })
}

/// The enclosure that a number with a bound on its error stands for.
pub(super) fn enclosed((value, error): (f64, f64)) -> Enclosure {
    if error == 0.0 { Enclosure::from(value) } else { Enclosure::around(value, error) }
}

/// exp(σt)(cos·cos ωt + sin·sin ωt), with one coefficient each.
pub(super) fn term(
    sigma: Enclosure,
    omega: Enclosure,
    (cos, sin): (Vec<Enclosure>, Vec<Enclosure>),
) -> QuasiPolynomialPart {
    let all = |numbers: Vec<Enclosure>| numbers.into_iter().map(with_error).collect();
    (with_error(sigma), with_error(omega), all(cos), all(sin))
}

fn constant(value: Enclosure) -> QuasiPolynomial {
    let zero = Enclosure::ZERO;
    QuasiPolynomial::from_parts(vec![term(zero, zero, (vec![value], vec![]))])
}

/// The coefficients α and β of a straight line α + βt.
fn line(function: &QuasiPolynomial) -> Option<(Enclosure, Enclosure)> {
    let zero = (0.0, 0.0);
    let parts = function.to_parts();
    let (sigma, omega, cos, _) = match parts.as_slice() {
        [] => return Some((Enclosure::ZERO, Enclosure::ZERO)),
        [part] => part,
        _ => return None,
    };
    let is_line =
        *sigma == zero && *omega == zero && cos[2.min(cos.len())..].iter().all(|c| *c == zero);
    let at = |k: usize| cos.get(k).map_or(Enclosure::ZERO, |c| enclosed(*c));
    is_line.then(|| (at(0), at(1)))
}

/// The value of a function that does not change.
fn number(function: &QuasiPolynomial) -> Option<Enclosure> {
    let (value, slope) = line(function)?;
    (slope == Enclosure::ZERO).then_some(value)
}

fn unary(function: Unary, x: &QuasiPolynomial) -> Option<QuasiPolynomial> {
    if function == Unary::Negative {
        return Some(-x.clone());
    }
    let (value, slope) = line(x)?;
    if slope == Enclosure::ZERO {
        let found = Enclosure::unary(function, &value);
        return found.is_valid().then(|| constant(found));
    }
    let zero = Enclosure::ZERO;
    let (sine, cosine) = value.sin_cos();
    let part = match function {
        // e^(α + βt) = e^α e^(βt).
        Unary::Exponential => term(slope, zero, (vec![value.exp()], vec![])),
        // sin(α + βt) = sin α cos βt + cos α sin βt.
        Unary::Sine => term(zero, slope, (vec![sine], vec![cosine])),
        Unary::Cosine => term(zero, slope, (vec![cosine], vec![-sine])),
        _ => return None,
    };
    Some(QuasiPolynomial::from_parts(vec![part]).normalized())
}

fn binary(function: Binary, x: &QuasiPolynomial, y: &QuasiPolynomial) -> Option<QuasiPolynomial> {
    match function {
        Binary::Sum => Some(x.clone() + y.clone()),
        Binary::Difference => Some(x.clone() - y.clone()),
        Binary::Product => Some(x.clone() * y.clone()),
        Binary::Quotient => {
            let inverse = Enclosure::quotient(&Enclosure::ONE, &number(y)?);
            inverse.is_valid().then(|| x.clone() * constant(inverse))
        }
        _ => {
            let found = Enclosure::binary(function, &number(x)?, &number(y)?);
            found.is_valid().then(|| constant(found))
        }
    }
}

/// For each part up to a wanted one, whether that one needs it.
pub(super) fn needed(nodes: &[Node], wanted: usize) -> Vec<bool> {
    let mut needed = vec![false; wanted + 1];
    needed[wanted] = true;
    for place in (0..=wanted).rev() {
        if needed[place] {
            nodes[place].operands().for_each(|operand| needed[operand] = true);
        }
    }
    needed
}

/// One formula along a motion whose components these are; `None` if it is no quasi-polynomial, or needs a component that is
/// none.
pub(super) fn quasi_value(
    formulas: &Formulas,
    output: usize,
    components: &[Option<QuasiPolynomial>],
) -> Option<QuasiPolynomial> {
    let (nodes, outputs) = formulas.nodes();
    let wanted = *outputs.get(output)?;
    let needed = needed(nodes, wanted);
    let mut values: Vec<Option<QuasiPolynomial>> = vec![None; wanted + 1];
    for place in (0..=wanted).filter(|&place| needed[place]) {
        let of = |place: usize| values[place].as_ref();
        let found = match nodes[place] {
            Node::Constant(ref number) => Some(constant(Enclosure::constant(number))),
            Node::Parameter(at) => {
                Some(constant(Enclosure::constant(&formulas.names().values[at])))
            }
            Node::State(at) => components.get(at).cloned().flatten(),
            Node::Time | Node::Call(..) => None,
            Node::Unary(function, a) => unary(function, of(a)?),
            Node::Binary(function, a, b) => binary(function, of(a)?, of(b)?),
        };
        values[place] = Some(found.filter(is_short)?);
    }
    values.pop().flatten()
}
