//! How the Taylor coefficients of each part of some formulas follow from those of others.

use crate::derivative::partials;
use crate::error::Error;
use crate::formulas::{Formulas, MOST_PARTS};
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};

/// What makes the coefficient k ≥ 1 of a row from those of other rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// The time: coefficients t, 1, 0, …
    Time,
    /// A component of the state, of its rate: coefficient k is that of the rate before it, over k.
    State,
    Negative,
    Sum,
    Difference,
    /// A number times a row.
    Scaled,
    Square,
    /// Of two rows. The first one has `most` terms.
    Product,
    /// A row over a number.
    Over,
    /// Of two rows. The second one has `most` terms.
    Quotient,
    Root,
    /// A power: of the base, the exponent, which is a number, the base's slopes and its own slopes.
    Power,
    /// k times the coefficient k of a row.
    Slope,
    /// y′ = g u′, of g and the slopes of u, which has `most` terms.
    Chain,
    /// y′ = g u′ of a linear u, whose slope is a number, as in a forcing cos(ω t).
    LinearChain,
    /// y′ = g u′ + h v′, of g and the slopes of u, of h and the slopes of v.
    Chains,
}

/// A row that moves: how its coefficients come from those of at most four rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rule {
    pub(crate) kind: Kind,
    /// The place of the row.
    pub(crate) row: u32,
    /// The places of the rows from which it comes.
    pub(crate) of: [u32; 4],
    /// The number of terms of a row that is a polynomial in time.
    pub(crate) most: u32,
}

impl Rule {
    /// The number of rows from which it comes.
    fn operands(&self) -> usize {
        match self.kind {
            Kind::Time => 0,
            Kind::State | Kind::Negative | Kind::Square | Kind::Root | Kind::Slope => 1,
            Kind::Power | Kind::Chains => 4,
            _ => 2,
        }
    }

    fn new(kind: Kind, of: &[usize], most: Option<usize>) -> Rule {
        let mut rule =
            Rule { kind, row: 0, of: [0; 4], most: most.map_or(u32::MAX, |most| most as u32) };
        for (place, row) in rule.of.iter_mut().zip(of) {
            *place = *row as u32;
        }
        rule
    }
}

/// The rules of all rows that move, in an order in which each one needs earlier ones or earlier coefficients.
#[derive(Debug)]
pub(crate) struct Rules {
    /// The parts, in whose order the first rows stand.
    pub(crate) nodes: Vec<Node>,
    /// The rows that move. First those of polynomials in time, which need no others.
    pub(crate) moving: Vec<Rule>,
    /// The number of these polynomials, and of the terms of the longest one.
    pub(crate) polynomials: (usize, usize),
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
    /// The rules of a graph in which the components of the state have these rates. With `polynomials` what is a polynomial
    /// in time has only its own terms.
    pub(crate) fn new(field: &Formulas, graph: Graph, polynomials: bool) -> Result<Rules, Error> {
        let Moving { graph, moves, chains } = Moving::of(field, graph)?;
        let nodes = graph.into_nodes();
        let terms = match polynomials {
            true => terms(&nodes, &moves, &field.outputs),
            false => vec![None; nodes.len()],
        };
        let mut rules = Rules { nodes, moving: Vec::new(), polynomials: (0, 0), terms };
        let mut slopes = vec![None; rules.nodes.len()];
        for (place, chain) in chains.iter().enumerate() {
            let operands = chain.iter().map(|&(_, operand)| operand);
            let of_power =
                rules.power(place, &moves).map_or([None, None], |(a, _)| [Some(a), Some(place)]);
            for needed in operands.chain(of_power.into_iter().flatten()) {
                if slopes[needed].is_none() {
                    slopes[needed] = Some(rules.terms.len());
                    rules.terms.push(rules.terms[needed]);
                }
            }
        }
        for place in 0..rules.nodes.len() {
            if !moves[place] {
                continue;
            }
            let rule = rules.rule(place, &moves, &field.outputs, &chains[place], &slopes);
            rules.moving.push(Rule { row: place as u32, ..rule });
            if let Some(slope) = slopes[place] {
                let rule = Rule::new(Kind::Slope, &[place], None);
                rules.moving.push(Rule { row: slope as u32, ..rule });
            }
        }
        let terms = |rule: &Rule| rules.terms[rule.row as usize];
        rules.moving.sort_by_key(|rule| terms(rule).is_none());
        let polynomials = rules.moving.iter().map_while(terms);
        rules.polynomials =
            polynomials.fold((0, 0), |(count, most), own| (count + 1, most.max(own)));
        Ok(rules)
    }

    /// The rules for rows that are `length` long: with the beginnings of rows as their places.
    pub(crate) fn of_length(&self, length: usize) -> Vec<Rule> {
        let begin = |row: u32| row * length as u32;
        let moved = |rule: &Rule| Rule { row: begin(rule.row), of: rule.of.map(begin), ..*rule };
        self.moving.iter().map(moved).collect()
    }

    /// For each row, whether one of these parts needs it, or its coefficients.
    pub(crate) fn needed(&self, wanted: &[usize]) -> Vec<bool> {
        let mut needed = vec![false; self.rows()];
        wanted.iter().for_each(|&row| needed[row] = true);
        loop {
            let before = needed.iter().filter(|needed| **needed).count();
            for rule in self.moving.iter().rev() {
                if needed[rule.row as usize] {
                    rule.of[..rule.operands()].iter().for_each(|&row| needed[row as usize] = true);
                }
            }
            for (place, node) in self.nodes.iter().enumerate().rev() {
                if needed[place] {
                    node.operands().for_each(|operand| needed[operand] = true);
                }
            }
            if needed.iter().filter(|needed| **needed).count() == before {
                return needed;
            }
        }
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.terms.len()
    }

    /// Base and exponent of a power whose exponent is a number.
    fn power(&self, place: usize, moves: &[bool]) -> Option<(usize, usize)> {
        match self.nodes[place] {
            Node::Binary(Binary::Power, a, b) if moves[a] && !moves[b] => Some((a, b)),
            _ => None,
        }
    }

    fn rule(
        &self,
        place: usize,
        moves: &[bool],
        rates: &[usize],
        chain: &[(usize, usize)],
        slopes: &[Option<usize>],
    ) -> Rule {
        let terms = |row: usize| self.terms[row];
        let is_shorter = |a: usize, b: usize| {
            terms(a).is_some_and(|own| terms(b).is_none_or(|other| own < other))
        };
        let slope = |part: usize| slopes[part].unwrap_or(part);
        let rule = |kind: Kind, of: &[usize]| Rule::new(kind, of, None);
        if let Some((a, exponent)) = self.power(place, moves) {
            return rule(Kind::Power, &[a, exponent, slope(a), slope(place)]);
        }
        match self.nodes[place] {
            Node::State(component) => rule(Kind::State, &[rates[component]]),
            Node::Unary(Unary::Negative, a) => rule(Kind::Negative, &[a]),
            Node::Unary(Unary::SquareRoot, a) => rule(Kind::Root, &[a]),
            Node::Binary(Binary::Sum, a, b) => rule(Kind::Sum, &[a, b]),
            Node::Binary(Binary::Difference, a, b) => rule(Kind::Difference, &[a, b]),
            Node::Binary(Binary::Product, a, b) if !moves[a] => rule(Kind::Scaled, &[a, b]),
            Node::Binary(Binary::Product, a, b) if !moves[b] => rule(Kind::Scaled, &[b, a]),
            Node::Binary(Binary::Product, a, b) if a == b => rule(Kind::Square, &[a]),
            Node::Binary(Binary::Product, a, b) if is_shorter(b, a) => {
                Rule::new(Kind::Product, &[b, a], terms(b))
            }
            Node::Binary(Binary::Product, a, b) => Rule::new(Kind::Product, &[a, b], terms(a)),
            Node::Binary(Binary::Quotient, a, b) if !moves[b] => rule(Kind::Over, &[a, b]),
            Node::Binary(Binary::Quotient, a, b) => Rule::new(Kind::Quotient, &[a, b], terms(b)),
            _ => match *chain {
                [(g, u)] if terms(u) == Some(2) => rule(Kind::LinearChain, &[g, u]),
                [(g, u)] => Rule::new(Kind::Chain, &[g, slope(u)], terms(u)),
                [(g, u), (h, v), ..] => rule(Kind::Chains, &[g, slope(u), h, slope(v)]),
                // Numbers do not move, so that only the time is left without a chain.
                [] => rule(Kind::Time, &[]),
            },
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
            let has_own_rule = match *node {
                Node::Unary(Unary::Negative | Unary::SquareRoot, _) => true,
                Node::Binary(Binary::Sum | Binary::Difference, ..) => true,
                Node::Binary(Binary::Product | Binary::Quotient, ..) => true,
                Node::Binary(Binary::Power, _, exponent) => !moving.moves[exponent],
                _ => false,
            };
            let chain = match moves && !is_variable && !has_own_rule {
                true => partials(&mut moving.graph, place, |operand| moving.moves[operand])
                    .ok_or_else(|| Error::Kink { part: field.text_of(&moving.graph, place) })?,
                // Also where the function has no derivative.
                false => Vec::new(),
            };
            moving.graph.check()?;
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
