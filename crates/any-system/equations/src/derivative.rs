//! The derivative of each function of one or two numbers, as parts of the same graph.

use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};

/// The partial derivatives of a part by its operands: (derivative, operand). `None` for a function with a kink.
///
/// Both derivatives of formulas and Taylor series in time stand on this table: along a motion, y′ = Σ (∂y/∂u) u′.
pub(crate) fn partials(graph: &mut Graph, place: usize) -> Option<Vec<(usize, usize)>> {
    let node = graph.nodes()[place].clone();
    Some(match node {
        Node::Time | Node::State(_) | Node::Parameter(_) | Node::Constant(_) => vec![],
        Node::Unary(function, u) => vec![(of_unary(graph, function, u, place)?, u)],
        Node::Binary(function, a, b) => match function {
            Binary::Sum => {
                let one = graph.number(1.0);
                vec![(one, a), (one, b)]
            }
            Binary::Difference => {
                let (one, minus) = (graph.number(1.0), graph.number(-1.0));
                vec![(one, a), (minus, b)]
            }
            Binary::Product => vec![(b, a), (a, b)],
            Binary::Quotient => {
                // (a/b)′ = a′/b − (a/b) b′/b.
                let one = graph.number(1.0);
                let by_first = graph.binary(Binary::Quotient, one, b);
                let ratio = graph.binary(Binary::Quotient, place, b);
                vec![(by_first, a), (graph.unary(Unary::Negative, ratio), b)]
            }
            Binary::Power => {
                // y = x^v: y′ = y (v ln x)′ = (y v/x) x′ + (y ln x) v′.
                let product = graph.binary(Binary::Product, place, b);
                let by_base = graph.binary(Binary::Quotient, product, a);
                let logarithm = graph.unary(Unary::Logarithm, a);
                vec![(by_base, a), (graph.binary(Binary::Product, place, logarithm), b)]
            }
            Binary::ArcTangent2 => {
                // The angle of (b, a): (b a′ − a b′)/(a² + b²).
                let squares = [a, b].map(|part| graph.integer_power(part, 2));
                let size = graph.binary(Binary::Sum, squares[0], squares[1]);
                let by_y = graph.binary(Binary::Quotient, b, size);
                let by_x = graph.binary(Binary::Quotient, a, size);
                vec![(by_y, a), (graph.unary(Unary::Negative, by_x), b)]
            }
            Binary::Minimum | Binary::Maximum => return None,
        },
    })
}

/// The derivative of y = f(u), where `y` is the place of f(u).
fn of_unary(graph: &mut Graph, function: Unary, u: usize, y: usize) -> Option<usize> {
    let one = graph.number(1.0);
    let square = graph.integer_power(u, 2);
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
        Unary::Tangent => {
            let square = graph.integer_power(y, 2);
            graph.binary(Binary::Sum, one, square)
        }
        Unary::ArcSine | Unary::ArcCosine => {
            let radicand = factors(graph, one, u);
            let slope = over_root(graph, radicand);
            if function == Unary::ArcSine { slope } else { graph.unary(Unary::Negative, slope) }
        }
        Unary::ArcTangent => {
            let divisor = graph.binary(Binary::Sum, one, square);
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
            let radicand = graph.binary(Binary::Sum, one, square);
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

/// a² − b² by factors: no digits are lost where both are nearly equal.
fn factors(graph: &mut Graph, a: usize, b: usize) -> usize {
    let [difference, sum] = [Binary::Difference, Binary::Sum].map(|kind| graph.binary(kind, a, b));
    graph.binary(Binary::Product, difference, sum)
}
