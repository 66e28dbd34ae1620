//! Functions of time, state and parameters.

use crate::algebra::{Algebra, Arithmetic};
use crate::constant::{Constant, Decimal};
use crate::derivative::partials;
use crate::error::Error;
use crate::expression::{Expression, Parameters, States, Term};
use crate::graph::Graph;
use crate::names::{NO_VALUE, Names};
use crate::node::{Binary, Node, uses};
use interval_arithmetic::Enclosure;
use std::cell::RefCell;

/// The largest number of parts of formulas. Ten times what 10 000 parts need for their second derivatives in one
/// direction; a value of so many parts takes milliseconds.
pub(crate) const MOST_PARTS: usize = 1_000_000;

/// Functions of time, state and parameters, in names of the user: a field, a guard, a jump, or what is wanted of a state.
///
/// Equal parts are computed once. Formulas are data: they compare, print, and are written to JSON.
#[derive(Debug, Clone, PartialEq)]
pub struct Formulas {
    pub(crate) names: Names,
    pub(crate) nodes: Vec<Node>,
    pub(crate) outputs: Vec<usize>,
    /// For each part its value if it is a number or a parameter, else 0: what an evaluation begins with.
    pub(crate) numbers: Vec<f64>,
}

impl Formulas {
    /// The formulas of a closure, which is called once, with symbols: of the time, of the state, and of the parameters.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let names = Names::new(&["angle", "speed"], &[("damping", "0.1")])?;
    /// let pendulum = Formulas::new(names, |_, x, p| [x[1], -x[0].sin() - p["damping"] * x[1]])?;
    /// assert_eq!(pendulum.values(0.0, &[0.0, 2.0])?, [2.0, -0.2]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Name`] for a parameter that is not among the names; [`Error::Foreign`] for a symbol of another closure;
    /// [`Error::Number`] for a number that is not finite; [`Error::TooLarge`] for more than a million parts.
    pub fn new<const N: usize>(
        names: Names,
        closure: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Result<Formulas, Error> {
        Formulas::of_vector(names, |time, state, parameters| {
            closure(time, state, parameters).into()
        })
    }

    /// The formulas of a closure that returns a vector, for a number of them that is known when it runs.
    ///
    /// # Errors
    /// As [`Formulas::new`].
    pub fn of_vector(
        names: Names,
        closure: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Result<Formulas, Error> {
        names.check()?;
        let graph = RefCell::new(Graph::default());
        let symbol = |node| Expression::of(&graph, node);
        let zero = symbol(Node::Constant(0.0.into()));
        let symbols = (0..names.states.len()).map(|at| symbol(Node::State(at))).collect();
        let state = States { symbols, zero };
        let parameters = Parameters {
            names: &names.parameters,
            symbols: (0..names.parameters.len()).map(|at| symbol(Node::Parameter(at))).collect(),
            zero,
        };
        let outputs = closure(symbol(Node::Time), &state, &parameters);
        let outputs: Vec<usize> =
            outputs.into_iter().map(|output| Term::Symbol(output).place(&graph)).collect();
        let mut graph = graph.take();
        graph.check()?;
        Formulas::of_parts(names, graph.into_nodes(), outputs)
    }

    /// The formulas with these places in a list of parts, in which each part stands behind those of which it is a function: for programs
    /// that make formulas of other things. Equal parts become one, and powers with integers products.
    ///
    /// ```
    /// use equations::{Binary, Formulas, Names, Node};
    /// let names = Names::new(&["x"], &[])?;
    /// let parts = [Node::State(0), Node::Constant(2.0.into()), Node::Binary(Binary::Power, 0, 1)];
    /// let square = Formulas::of_nodes(names, &parts, &[2])?;
    /// assert_eq!(square.values(0.0, &[-3.0])?, [9.0]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for a place of no part before, of no component and of no parameter; [`Error::Number`]; [`Error::Name`];
    /// [`Error::TooLarge`].
    pub fn of_nodes(names: Names, nodes: &[Node], outputs: &[usize]) -> Result<Formulas, Error> {
        names.check()?;
        if nodes.len() > MOST_PARTS {
            return Err(Error::TooLarge { limit: MOST_PARTS });
        }
        let within = |what, place: usize, given: usize| match place < given {
            true => Ok(()),
            false => Err(Error::Length { what, needed: place.saturating_add(1), given }),
        };
        let mut graph = Graph::default();
        let mut places = Vec::with_capacity(nodes.len());
        for node in nodes {
            let mut operands = node.operands();
            operands.try_for_each(|place| within("parts before a part", place, places.len()))?;
            match node {
                Node::State(place) => within("components", *place, names.states.len())?,
                Node::Parameter(place) => within("parameters", *place, names.parameters.len())?,
                Node::Constant(Constant::Double(bits)) if !f64::from_bits(*bits).is_finite() => {
                    return Err(Error::Number { value: f64::from_bits(*bits) });
                }
                _ => {}
            }
            places.push(match node {
                Node::Binary(Binary::Power, a, b) => graph.power(places[*a], places[*b]),
                node => graph.place(node.moved(&places)),
            });
            // A power with a large integer has many parts.
            if graph.nodes().len() > MOST_PARTS {
                return Err(Error::TooLarge { limit: MOST_PARTS });
            }
        }
        outputs.iter().try_for_each(|output| within("parts", *output, places.len()))?;
        graph.check()?;
        let outputs = outputs.iter().map(|output| places[*output]).collect();
        Formulas::of_parts(names, graph.into_nodes(), outputs)
    }

    pub(crate) fn of(names: Names, nodes: Vec<Node>, outputs: Vec<usize>) -> Formulas {
        let mut formulas = Formulas { names, nodes, outputs, numbers: Vec::new() };
        formulas.numbers = formulas.numbers();
        formulas
    }

    /// The formulas of a list of parts, without those that no output needs.
    pub(crate) fn of_parts(
        names: Names,
        nodes: Vec<Node>,
        outputs: Vec<usize>,
    ) -> Result<Formulas, Error> {
        if nodes.len() > MOST_PARTS {
            return Err(Error::TooLarge { limit: MOST_PARTS });
        }
        let called = nodes.iter().filter_map(|node| match node {
            Node::Call(function, _) => Some(function),
            _ => None,
        });
        let names = names.with_called(called)?;
        let uses = uses(&nodes, &outputs);
        let mut new_place = vec![0; nodes.len()];
        let mut kept = Vec::new();
        for (place, node) in nodes.iter().enumerate().filter(|(place, _)| uses[*place] > 0) {
            new_place[place] = kept.len();
            kept.push(node.moved(&new_place));
        }
        let outputs = outputs.into_iter().map(|place| new_place[place]).collect();
        Ok(Formulas::of(names, kept, outputs))
    }

    /// The names of the state's components and of the parameters, with their values.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// The number of formulas.
    pub fn count(&self) -> usize {
        self.outputs.len()
    }

    /// The parts, and the places of the formulas among them: for programs that compute with other kinds of numbers.
    pub fn nodes(&self) -> (&[Node], &[usize]) {
        (&self.nodes, &self.outputs)
    }

    /// The number of different parts.
    pub fn parts(&self) -> usize {
        self.nodes.len()
    }

    /// The same formulas with other values of the parameters, given as decimals by name.
    ///
    /// # Errors
    /// [`Error::Name`] for a name that is no parameter, and for a value that is no decimal.
    pub fn with_parameters(mut self, values: &[(&str, &str)]) -> Result<Formulas, Error> {
        for &(name, value) in values {
            let refused = |reason| Error::Name { name: name.to_owned(), reason };
            let at = self.names.parameters.iter().position(|known| known == name);
            let at = at.ok_or(refused("no parameter of these formulas"))?;
            let value = Decimal::new(value).ok_or(refused(NO_VALUE))?;
            self.names.values[at] = Constant::Decimal(value);
        }
        self.numbers = self.numbers();
        Ok(self)
    }

    /// The outputs of several formulas with the same names, one after the other.
    ///
    /// # Errors
    /// [`Error::Name`] for other names or values; [`Error::TooLarge`].
    pub fn and(&self, other: &Formulas) -> Result<Formulas, Error> {
        let mut graph = Graph::of(self.nodes.clone());
        let more = self.joined(&mut graph, other)?;
        let outputs = self.outputs.iter().copied().chain(more).collect();
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), outputs)
    }

    /// The outputs of all of these formulas with the same names, one after the other; `None` of none.
    ///
    /// # Errors
    /// As [`and`](Self::and).
    pub fn all_of<'f>(
        mut all: impl Iterator<Item = &'f Formulas>,
    ) -> Result<Option<Formulas>, Error> {
        let Some(first) = all.next() else { return Ok(None) };
        all.try_fold(first.clone(), |known, more| known.and(more)).map(Some)
    }

    /// True if the time stands in a formula.
    pub fn uses_time(&self) -> bool {
        self.nodes.contains(&Node::Time)
    }

    /// The same formulas with the time as a further component of the state, the last one, and with a `further` formula:
    /// of a field the rate of the time, the number 1; of a jump the time, which stays.
    #[must_use]
    pub fn with_time_as_state(&self, further: Option<Node>) -> Formulas {
        let mut names = self.names.clone();
        let component = names.states.len();
        names.states.push("t".to_owned());
        let is_time = |node: &Node| *node == Node::Time;
        let moved = |node: &Node| if is_time(node) { Node::State(component) } else { node.clone() };
        let mut graph = Graph::of(self.nodes.iter().map(moved).collect());
        let further = further.map(|node| graph.place(moved(&node)));
        let outputs = self.outputs.iter().copied().chain(further).collect();
        Formulas::of(names, graph.into_nodes(), outputs)
    }

    /// The derivatives in one direction of state and parameters, with the same names. The direction's components are
    /// numbers; a direction along the state's component k is 1 there and 0 elsewhere.
    ///
    /// Derivatives are formulas again, so that they have derivatives, values, enclosures and series.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let names = Names::new(&["x"], &[("a", "3")])?;
    /// let power = Formulas::new(names, |_, x, p| [p["a"] * x[0].powi(4)])?;
    /// let third = power.derivative(&[1.0], &[0.0])?.derivative(&[1.0], &[0.0])?.derivative(&[1.0], &[0.0])?;
    /// assert_eq!(third.values(0.0, &[2.0])?, [144.0]); // 24 a x
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::Number`] for a component that is not finite; [`Error::Kink`] for a function with a kink
    /// or a jump; [`Error::TooLarge`].
    pub fn derivative(&self, states: &[f64], parameters: &[f64]) -> Result<Formulas, Error> {
        length("components of the direction", self.names.states.len(), states.len())?;
        length("parameters of the direction", self.names.parameters.len(), parameters.len())?;
        if let Some(&value) = states.iter().chain(parameters).find(|value| !value.is_finite()) {
            return Err(Error::Number { value });
        }
        let mut graph = Graph::of(self.nodes.clone());
        let outputs = self.along(&mut graph, |node| match node {
            Node::State(at) => states[*at],
            Node::Parameter(at) => parameters[*at],
            _ => 0.0,
        })?;
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), outputs)
    }

    /// All first derivatives by the components of the state, row by row: ∂f_i/∂x_j is the output i n + j.
    ///
    /// # Errors
    /// As [`Formulas::derivative`].
    pub fn jacobian(&self) -> Result<Formulas, Error> {
        self.all_derivatives(self.names.states.len(), Node::State)
    }

    /// For each formula its enclosure, if it is a number whatever time and state are.
    pub fn constants(&self) -> Vec<Option<Enclosure>> {
        let mut values: Vec<Option<Enclosure>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            values.push(match *node {
                Node::Time | Node::State(_) => None,
                Node::Parameter(at) => Some(Enclosure::constant(&self.names.values[at])),
                Node::Constant(ref constant) => Some(Enclosure::constant(constant)),
                Node::Unary(function, a) => values[a].map(|a| Enclosure::unary(function, &a)),
                Node::Call(ref function, a) => values[a].map(|a| Enclosure::call(function, &a)),
                Node::Binary(function, a, b) => {
                    values[a].zip(values[b]).map(|(a, b)| Enclosure::binary(function, &a, &b))
                }
            });
        }
        let valid = |at: &usize| values[*at].filter(Enclosure::is_valid);
        self.outputs.iter().map(valid).collect()
    }

    /// All first derivatives by the parameters, row by row: ∂f_i/∂p_j is the output i k + j.
    ///
    /// # Errors
    /// As [`Formulas::derivative`].
    pub fn parameter_jacobian(&self) -> Result<Formulas, Error> {
        self.all_derivatives(self.names.parameters.len(), Node::Parameter)
    }

    fn all_derivatives(
        &self,
        count: usize,
        variable: impl Fn(usize) -> Node,
    ) -> Result<Formulas, Error> {
        let mut graph = Graph::of(self.nodes.clone());
        let columns: Vec<Vec<usize>> = (0..count)
            .map(|at| {
                let variable = variable(at);
                self.along(&mut graph, |node| f64::from(*node == variable))
            })
            .collect::<Result<_, Error>>()?;
        let outputs =
            (0..self.count()).flat_map(|row| columns.iter().map(move |column| column[row]));
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), outputs.collect())
    }

    /// The places of another's outputs in a graph that begins with these parts.
    pub(crate) fn joined(&self, graph: &mut Graph, other: &Formulas) -> Result<Vec<usize>, Error> {
        if self.names != other.names {
            let all = |names: &Names| [&names.states[..], &names.parameters[..]].concat();
            let (own, others) = (all(&self.names), all(&other.names));
            let differs =
                (0..own.len().max(others.len())).find(|&at| own.get(at) != others.get(at));
            // With equal names a value differs.
            let at = differs.unwrap_or(self.names.states.len());
            let name = others.get(at).or(own.get(at)).cloned().unwrap_or_default();
            let reason = "not the same, or has another value, in the watched formulas";
            return Err(Error::Name { name, reason });
        }
        let mut places: Vec<usize> = Vec::with_capacity(other.nodes.len());
        for node in &other.nodes {
            let node = node.moved(&places);
            places.push(graph.place(node));
        }
        Ok(other.outputs.iter().map(|&place| places[place]).collect())
    }

    /// The text of a part of a graph with these names.
    pub(crate) fn text_of(&self, graph: &Graph, place: usize) -> String {
        let nodes = graph.nodes()[..=place].to_vec();
        Formulas::of(self.names.clone(), nodes, vec![]).part(place)
    }

    /// The derivatives of the outputs, where those of the variables are numbers.
    pub(crate) fn along(
        &self,
        graph: &mut Graph,
        direction: impl Fn(&Node) -> f64,
    ) -> Result<Vec<usize>, Error> {
        let mut changes: Vec<usize> = Vec::with_capacity(self.nodes.len());
        let zero = graph.number(0.0);
        for (place, node) in self.nodes.iter().enumerate() {
            let moves = node.operands().any(|operand| changes[operand] != zero);
            let change = if !moves {
                graph.number(direction(node))
            } else {
                let rates = partials(graph, place, |operand| changes[operand] != zero)
                    .ok_or_else(|| Error::Kink { part: self.part(place) })?;
                graph.check()?;
                let terms: Vec<usize> = rates
                    .into_iter()
                    .map(|(rate, operand)| graph.product(rate, changes[operand]))
                    .collect();
                terms.into_iter().fold(zero, |sum, term| graph.sum(sum, term))
            };
            if graph.nodes().len() > MOST_PARTS {
                return Err(Error::TooLarge { limit: MOST_PARTS });
            }
            changes.push(change);
        }
        Ok(self.outputs.iter().map(|&place| changes[place]).collect())
    }
}

/// An error unless the lengths are equal.
pub(crate) fn length(what: &'static str, needed: usize, given: usize) -> Result<(), Error> {
    if needed == given { Ok(()) } else { Err(Error::Length { what, needed, given }) }
}
