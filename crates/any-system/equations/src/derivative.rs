//! The derivative of each function of one or two numbers, as parts of the same graph.

use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};

/// The partial derivatives of a part by those operands that move: (derivative, operand). `None` for a function with a
/// kink.
///
/// Both derivatives of formulas and Taylor series in time stand on this table: along a motion, y′ = Σ (∂y/∂u) u′.
pub(crate) fn partials(
    graph: &mut Graph,
    place: usize,
    moves: impl Fn(usize) -> bool,
) -> Option<Vec<(usize, usize)>> {
    let mut found = Vec::new();
    match graph.nodes()[place].clone() {
        Node::Time | Node::State(_) | Node::Parameter(_) | Node::Constant(_) => {}
        Node::Unary(function, u) => found.push((of_unary(graph, function, u, place)?, u)),
        Node::Call(function, u) => found.push((function.derivative(graph, u, place), u)),
        Node::Binary(function, a, b) => {
            if moves(a) {
                found.push((by_first(graph, function, (a, b), place)?, a));
            }
            if moves(b) {
                found.push((by_second(graph, function, (a, b), place)?, b));
            }
        }
    }
    Some(found)
}

/// The derivative of y = f(a, b) by a, where `y` is the place of f(a, b).
fn by_first(
    graph: &mut Graph,
    function: Binary,
    (a, b): (usize, usize),
    y: usize,
) -> Option<usize> {
    Some(match function {
        Binary::Sum | Binary::Difference => graph.number(1.0),
        Binary::Product => b,
        Binary::Quotient => {
            let one = graph.number(1.0);
            graph.binary(Binary::Quotient, one, b)
        }
        // a^b has the derivative (a^b) b/a.
        Binary::Power => {
            let product = graph.binary(Binary::Product, y, b);
            graph.binary(Binary::Quotient, product, a)
        }
        // The angle of (b, a) changes by (b a′ − a b′)/(a² + b²).
        Binary::ArcTangent2 => over_squares(graph, b, (a, b)),
        Binary::Minimum | Binary::Maximum => return None,
    })
}

/// The derivative of y = f(a, b) by b.
fn by_second(
    graph: &mut Graph,
    function: Binary,
    (a, b): (usize, usize),
    y: usize,
) -> Option<usize> {
    Some(match function {
        Binary::Sum => graph.number(1.0),
        Binary::Difference => graph.number(-1.0),
        Binary::Product => a,
        // −(a/b)/b.
        Binary::Quotient => {
            let ratio = graph.binary(Binary::Quotient, y, b);
            graph.unary(Unary::Negative, ratio)
        }
        // a^b has the derivative (a^b) ln a.
        Binary::Power => {
            let logarithm = graph.unary(Unary::Logarithm, a);
            graph.binary(Binary::Product, y, logarithm)
        }
        Binary::ArcTangent2 => {
            let part = over_squares(graph, a, (a, b));
            graph.unary(Unary::Negative, part)
        }
        Binary::Minimum | Binary::Maximum => return None,
    })
}

/// part/(a² + b²).
fn over_squares(graph: &mut Graph, part: usize, (a, b): (usize, usize)) -> usize {
    let squares = [a, b].map(|part| graph.integer_power(part, 2));
    let size = graph.binary(Binary::Sum, squares[0], squares[1]);
    graph.binary(Binary::Quotient, part, size)
}

/// The derivative of y = f(u), where `y` is the place of f(u).
fn of_unary(graph: &mut Graph, function: Unary, u: usize, y: usize) -> Option<usize> {
    let one = graph.number(1.0);
    let over = |graph: &mut Graph, divisor| graph.binary(Binary::Quotient, one, divisor);
    let over_root = |graph: &mut Graph, radicand| {
        let root = graph.unary(Unary::SquareRoot, radicand);
        graph.binary(Binary::Quotient, one, root)
    };
    Some(match function {
        Unary::Negative => graph.number(-1.0),
        Unary::SquareRoot => {
            let half = graph.number(0.5);
            graph.binary(Binary::Quotient, half, y)
        }
        Unary::Exponential => y,
        Unary::Logarithm => over(graph, u),
        Unary::Sine => graph.unary(Unary::Cosine, u),
        Unary::Cosine => {
            let sine = graph.unary(Unary::Sine, u);
            graph.unary(Unary::Negative, sine)
        }
        Unary::Tangent => one_and_square(graph, one, y),
        Unary::ArcSine | Unary::ArcCosine => {
            let radicand = factors(graph, one, u);
            let slope = over_root(graph, radicand);
            if function == Unary::ArcSine { slope } else { graph.unary(Unary::Negative, slope) }
        }
        Unary::ArcTangent => {
            let divisor = one_and_square(graph, one, u);
            over(graph, divisor)
        }
        Unary::HyperbolicSine => graph.unary(Unary::HyperbolicCosine, u),
        Unary::HyperbolicCosine => graph.unary(Unary::HyperbolicSine, u),
        Unary::HyperbolicTangent => {
            // 1 − tanh² is a difference of equal numbers far from 0.
            let secant = graph.unary(Unary::HyperbolicSecant, u);
            graph.integer_power(secant, 2)
        }
        Unary::HyperbolicSecant => {
            let tangent = graph.unary(Unary::HyperbolicTangent, u);
            let product = graph.binary(Binary::Product, y, tangent);
            graph.unary(Unary::Negative, product)
        }
        Unary::InverseHyperbolicSine => {
            let radicand = one_and_square(graph, one, u);
            over_root(graph, radicand)
        }
        Unary::InverseHyperbolicCosine => {
            let radicand = factors(graph, u, one);
            over_root(graph, radicand)
        }
        Unary::InverseHyperbolicTangent => {
            let divisor = factors(graph, one, u);
            over(graph, divisor)
        }
        Unary::Absolute | Unary::Sign => return None,
    })
}

/// 1 + a².
fn one_and_square(graph: &mut Graph, one: usize, a: usize) -> usize {
    let square = graph.integer_power(a, 2);
    graph.binary(Binary::Sum, one, square)
}

/// a² − b² by factors: no digits are lost where both are nearly equal.
fn factors(graph: &mut Graph, a: usize, b: usize) -> usize {
    let [difference, sum] = [Binary::Difference, Binary::Sum].map(|kind| graph.binary(kind, a, b));
    graph.binary(Binary::Product, difference, sum)
}
