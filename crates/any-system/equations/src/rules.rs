//! How the Taylor coefficients of each part of some formulas follow from those of others.

use crate::derivative::partials;
use crate::error::Error;
use crate::formulas::{Formulas, MOST_PARTS};
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};

/// What makes the coefficient k ≥ 1 of a row from those of other rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rule {
    /// The time: coefficients t, 1, 0, …
    Time,
    /// A component of the state, with the row of its rate: coefficient k is that of the rate before it, over k.
    State(usize),
    Negative(usize),
    Sum(usize, usize),
    Difference(usize, usize),
    /// A number times a row.
    Scaled(usize, usize),
    /// The first one has no more terms than the second.
    Product(usize, usize),
    Square(usize),
    /// A row over a number.
    Over(usize, usize),
    Quotient(usize, usize),
    /// k times the coefficient k of a row.
    Slope(usize),
    /// y′ = Σ g u′, with the rows of g and of the slopes of u. A function of one number has one term.
    Chain((usize, usize), Option<(usize, usize)>),
}

/// The rules of all rows that move, in an order in which each one needs earlier ones or earlier coefficients.
#[derive(Debug)]
pub(crate) struct Rules {
    /// The parts, in whose order the first rows stand.
    pub(crate) nodes: Vec<Node>,
    /// The rows that move.
    pub(crate) moving: Vec<(usize, Rule)>,
    /// The number of terms of a row that is a polynomial in time.
    pub(crate) terms: Vec<Option<usize>>,
}

/// The parts of a graph while their rules are made.
struct Moving {
    graph: Graph,
    /// For each part, whether it changes with time.
    moves: Vec<bool>,
    /// For each part with factors by the chain rule: (derivative, operand).
    chains: Vec<Vec<(usize, usize)>>,
}

impl Rules {
    /// The rules of a graph in which the components of the state have these rates.
    pub(crate) fn new(field: &Formulas, graph: Graph) -> Result<Rules, Error> {
        let Moving { graph, moves, chains } = Moving::of(field, graph)?;
        let nodes = graph.into_nodes();
        let terms = terms(&nodes, &moves, &field.outputs);
        let mut rules = Rules { nodes, moving: Vec::new(), terms };
        let mut slopes = vec![None; rules.nodes.len()];
        for chain in &chains {
            for &(_, operand) in chain {
                if slopes[operand].is_none() {
                    slopes[operand] = Some(rules.terms.len());
                    rules.terms.push(rules.terms[operand]);
                }
            }
        }
        for place in 0..rules.nodes.len() {
            if !moves[place] {
                continue;
            }
            let rule = rules.rule(place, &moves, &field.outputs, &chains[place], &slopes);
            rules.moving.push((place, rule));
            if let Some(slope) = slopes[place] {
                rules.moving.push((slope, Rule::Slope(place)));
            }
        }
        Ok(rules)
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.terms.len()
    }

    fn rule(
        &self,
        place: usize,
        moves: &[bool],
        rates: &[usize],
        chain: &[(usize, usize)],
        slopes: &[Option<usize>],
    ) -> Rule {
        let is_longer = |a: usize, b: usize| {
            let length = |row: usize| self.terms[row].unwrap_or(usize::MAX);
            length(a) > length(b)
        };
        match self.nodes[place] {
            Node::State(component) => Rule::State(rates[component]),
            Node::Unary(Unary::Negative, a) => Rule::Negative(a),
            Node::Binary(Binary::Sum, a, b) => Rule::Sum(a, b),
            Node::Binary(Binary::Difference, a, b) => Rule::Difference(a, b),
            Node::Binary(Binary::Product, a, b) if a == b => Rule::Square(a),
            Node::Binary(Binary::Product, a, b) if !moves[a] => Rule::Scaled(a, b),
            Node::Binary(Binary::Product, a, b) if !moves[b] => Rule::Scaled(b, a),
            Node::Binary(Binary::Product, a, b) if is_longer(a, b) => Rule::Product(b, a),
            Node::Binary(Binary::Product, a, b) => Rule::Product(a, b),
            Node::Binary(Binary::Quotient, a, b) if !moves[b] => Rule::Over(a, b),
            Node::Binary(Binary::Quotient, a, b) => Rule::Quotient(a, b),
            _ => {
                let mut terms = chain.iter().map(|&(g, u)| (g, slopes[u].unwrap_or(u)));
                // Numbers do not move, so that only the time is left without a chain.
                terms.next().map_or(Rule::Time, |first| Rule::Chain(first, terms.next()))
            }
        }
    }
}

impl Moving {
    fn of(field: &Formulas, graph: Graph) -> Result<Moving, Error> {
        let mut moving = Moving { graph, moves: Vec::new(), chains: Vec::new() };
        // Parts that are added for derivatives have series too.
        while moving.moves.len() < moving.graph.nodes().len() {
            let place = moving.moves.len();
            let node = &moving.graph.nodes()[place];
            let is_variable = matches!(node, Node::Time | Node::State(_));
            let moves = is_variable || node.operands().any(|operand| moving.moves[operand]);
            let has_own_rule = matches!(
                node,
                Node::Unary(Unary::Negative, _)
                    | Node::Binary(
                        Binary::Sum | Binary::Difference | Binary::Product | Binary::Quotient,
                        ..
                    )
            );
            let chain = match moves && !is_variable && !has_own_rule {
                true => partials(&mut moving.graph, place, |operand| moving.moves[operand])
                    .ok_or_else(|| Error::Kink { part: field.text_of(&moving.graph, place) })?,
                // Also where the function has no derivative.
                false => Vec::new(),
            };
            moving.moves.push(moves);
            moving.chains.push(chain);
            if moving.graph.nodes().len() > MOST_PARTS {
                return Err(Error::TooLarge { limit: MOST_PARTS });
            }
        }
        Ok(moving)
    }
}

/// For each part that is a polynomial in time, whatever the state: its number of terms.
///
/// A component is one if its rate is. So each round finds components whose rates need those of the rounds before.
fn terms(nodes: &[Node], moves: &[bool], rates: &[usize]) -> Vec<Option<usize>> {
    let mut components: Vec<Option<usize>> = vec![None; rates.len()];
    loop {
        let mut terms: Vec<Option<usize>> = Vec::with_capacity(nodes.len());
        for (place, node) in nodes.iter().enumerate() {
            let found = match *node {
                _ if !moves[place] => Some(1),
                Node::Time => Some(2),
                Node::State(component) => components[component],
                Node::Unary(Unary::Negative, a) => terms[a],
                Node::Binary(Binary::Sum | Binary::Difference, a, b) => {
                    terms[a].zip(terms[b]).map(|(a, b)| a.max(b))
                }
                Node::Binary(Binary::Product, a, b) => {
                    terms[a].zip(terms[b]).map(|(a, b)| a + b - 1)
                }
                Node::Binary(Binary::Quotient, a, b) if !moves[b] => terms[a],
                _ => None,
            };
            // Longer ones than any series are no shorter than one.
            terms.push(found.filter(|terms| *terms <= MOST_PARTS));
        }
        let next: Vec<Option<usize>> =
            rates.iter().map(|&rate| terms[rate].map(|terms| terms + 1)).collect();
        if next == components {
            return terms;
        }
        components = next;
    }
}
