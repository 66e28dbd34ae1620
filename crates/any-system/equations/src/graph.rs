//! All parts of some formulas, equal ones merged.

use crate::constant::Constant;
use crate::error::Error;
use crate::function::Function;
use crate::node::{Binary, Node, Unary};
use std::collections::HashMap;

/// 2⁵³: an `f64` of this size is an integer of its own.
const LARGEST_INTEGER: f64 = 9_007_199_254_740_992.0;

/// The most functions of the user in one list: each derivative of a motion may need one more, and so does a family such as
/// those of Bessel.
const MOST_FUNCTIONS: usize = 100;

/// A list of parts. Each one stands behind those of which it is a function, and no two are equal.
#[derive(Debug, Clone, Default)]
pub(crate) struct Graph {
    nodes: Vec<Node>,
    known: HashMap<Node, usize>,
    /// The functions of the user that are called.
    called: Vec<Function>,
    /// What a closure did wrong: it cannot return an error from an operator.
    pub(crate) wrong: Option<Error>,
}

/// What equal parts have in common. Sums and products of the same two parts are equal in either order: they have the
/// same bits. They stay as they were written first.
fn merged(node: &Node) -> Node {
    match *node {
        Node::Binary(kind @ (Binary::Sum | Binary::Product), a, b) if a > b => {
            Node::Binary(kind, b, a)
        }
        _ => node.clone(),
    }
}

impl Graph {
    /// The graph of a list without equal parts.
    pub(crate) fn of(nodes: Vec<Node>) -> Self {
        let known = nodes.iter().enumerate().map(|(at, node)| (merged(node), at)).collect();
        let mut graph = Graph { known, ..Graph::default() };
        nodes.iter().for_each(|node| graph.note_call(node));
        Graph { nodes, ..graph }
    }

    /// Notes a call. A function that is made anew wherever its derivative is asked for would be another one each time, and
    /// the derivatives of a motion would never end.
    fn note_call(&mut self, node: &Node) {
        let Node::Call(function, _) = node else { return };
        let noted = function.note_in(&mut self.called);
        if let Err(error) = noted {
            self.refuse(error);
        } else if self.called.len() > MOST_FUNCTIONS {
            self.refuse(Error::TooLarge { limit: MOST_FUNCTIONS });
        }
    }

    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    pub(crate) fn into_nodes(self) -> Vec<Node> {
        self.nodes
    }

    /// The place of a part, which is added if it is new.
    pub(crate) fn place(&mut self, node: Node) -> usize {
        let key = merged(&node);
        if let Some(&known) = self.known.get(&key) {
            return known;
        }
        self.note_call(&node);
        self.nodes.push(node);
        self.known.insert(key, self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    pub(crate) fn number(&mut self, value: f64) -> usize {
        self.place(Node::Constant(value.into()))
    }

    fn is_number(&self, at: usize, value: f64) -> bool {
        matches!(&self.nodes[at], Node::Constant(Constant::Double(bits)) if *bits == value.to_bits())
    }

    /// A function of one part.
    pub(crate) fn unary(&mut self, function: Unary, a: usize) -> usize {
        self.place(Node::Unary(function, a))
    }

    /// A function of two parts, as it is written.
    pub(crate) fn binary(&mut self, function: Binary, a: usize, b: usize) -> usize {
        self.place(Node::Binary(function, a, b))
    }

    /// A sum of a derivative: without parts that are 0.
    pub(crate) fn sum(&mut self, a: usize, b: usize) -> usize {
        match (self.is_number(a, 0.0), self.is_number(b, 0.0)) {
            (true, _) => b,
            (_, true) => a,
            // a + (−c) has the bits of a − c.
            _ => match self.nodes[b] {
                Node::Unary(Unary::Negative, c) => self.binary(Binary::Difference, a, c),
                _ => self.binary(Binary::Sum, a, b),
            },
        }
    }

    /// A product of a derivative: 0 if a factor is, and without factors that are 1 or −1.
    pub(crate) fn product(&mut self, a: usize, b: usize) -> usize {
        if self.is_number(a, 0.0) || self.is_number(b, 1.0) {
            a
        } else if self.is_number(b, 0.0) || self.is_number(a, 1.0) {
            b
        } else if self.is_number(a, -1.0) {
            self.unary(Unary::Negative, b)
        } else if self.is_number(b, -1.0) {
            self.unary(Unary::Negative, a)
        } else {
            self.binary(Binary::Product, a, b)
        }
    }

    /// Keeps the first error of a closure.
    pub(crate) fn refuse(&mut self, error: Error) {
        self.wrong.get_or_insert(error);
    }

    /// The error of a closure.
    pub(crate) fn check(&mut self) -> Result<(), Error> {
        self.wrong.take().map_or(Ok(()), Err)
    }

    /// The part with an integer exponent: by squaring, so that 0 and numbers below it have powers too.
    pub(crate) fn integer_power(&mut self, base: usize, exponent: i64) -> usize {
        let mut left = exponent.unsigned_abs();
        let (mut square, mut product) = (base, None);
        while left > 0 {
            if left % 2 == 1 {
                product = Some(match product {
                    None => square,
                    Some(product) => self.binary(Binary::Product, product, square),
                });
            }
            left /= 2;
            if left > 0 {
                square = self.binary(Binary::Product, square, square);
            }
        }
        match product {
            None => self.number(1.0),
            Some(product) if exponent < 0 => {
                let one = self.number(1.0);
                self.binary(Binary::Quotient, one, product)
            }
            Some(product) => product,
        }
    }

    /// A power, as it is written: by products for an integer, as a square root for ½.
    pub(crate) fn power(&mut self, base: usize, exponent: usize) -> usize {
        match self.short_exponent(exponent) {
            Some(0.5) => self.unary(Unary::SquareRoot, base),
            Some(integer) => self.integer_power(base, integer as i64),
            None => self.binary(Binary::Power, base, exponent),
        }
    }

    /// An exponent that is an integer or ½ exactly.
    pub(crate) fn short_exponent(&self, exponent: usize) -> Option<f64> {
        let (negative, number) = match &self.nodes[exponent] {
            Node::Unary(Unary::Negative, number) => (true, *number),
            _ => (false, exponent),
        };
        let Node::Constant(constant) = &self.nodes[number] else { return None };
        let enclosure = constant.enclosure();
        let value = if negative { -enclosure.low() } else { enclosure.low() };
        // Larger integers are all even, and no less exact.
        let is_integer = value.fract() == 0.0 && value.abs() <= LARGEST_INTEGER;
        (enclosure.low() == enclosure.high() && (is_integer || value == 0.5)).then_some(value)
    }
}
