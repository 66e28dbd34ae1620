//! Formulas of quasi-polynomials: sums of polynomials in time times exponentials, sines and cosines.
//!
//! Where the components of a state are quasi-polynomials in time, so are sums and products of them, and sines, cosines and
//! exponentials of straight lines. Every number has a bound on its error.

use crate::crossing::{Coefficients, QuasiPolynomial, Rounded, Term};
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
pub(super) fn with_error(number: Enclosure) -> Rounded {
    let value = number.middle();
    let error = (number.high() - value).max(value - number.low());
    Rounded { value, error: if error == 0.0 { 0.0 } else { error.next_up() } }
}

/// The enclosure that a number with a bound on its error stands for.
pub(super) fn enclosed(Rounded { value, error }: Rounded) -> Enclosure {
    if error == 0.0 { Enclosure::from(value) } else { Enclosure::around(value, error) }
}

/// exp(σt)(p(t) cos ωt + q(t) sin ωt), with the coefficients of p and q.
pub(super) fn term(
    sigma: Enclosure,
    omega: Enclosure,
    (cos, sin): (&[Enclosure], &[Enclosure]),
) -> Term {
    let all = |numbers: &[Enclosure]| -> Coefficients {
        numbers.iter().map(|number| with_error(*number)).collect()
    };
    Term { sigma: with_error(sigma), omega: with_error(omega), cos: all(cos), sin: all(sin) }
}

fn constant(value: Enclosure) -> QuasiPolynomial {
    let zero = Enclosure::ZERO;
    QuasiPolynomial::from_terms(vec![term(zero, zero, (&[value], &[]))])
}

/// The coefficients α and β of a straight line α + βt.
fn line(function: &QuasiPolynomial) -> Option<(Enclosure, Enclosure)> {
    let zero = Rounded::default();
    let Term { sigma, omega, cos, .. } = match function.terms() {
        [] => return Some((Enclosure::ZERO, Enclosure::ZERO)),
        [term] => term,
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
    let found = match function {
        // e^(α + βt) = e^α e^(βt).
        Unary::Exponential => term(slope, zero, (&[value.exp()], &[])),
        // sin(α + βt) = sin α cos βt + cos α sin βt.
        Unary::Sine => term(zero, slope, (&[sine], &[cosine])),
        Unary::Cosine => term(zero, slope, (&[cosine], &[-sine])),
        _ => return None,
    };
    Some(QuasiPolynomial::from_terms(vec![found]).normalized())
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
