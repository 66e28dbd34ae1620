//! Taylor series in time, along the motion ẋ = f(t, x; p).

use crate::algebra::Algebra;
use crate::derivative::partials;
use crate::error::Error;
use crate::evaluate::Evaluator;
use crate::formulas::{Formulas, MOST_PARTS, length};
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};
use std::fmt;

/// The highest order of a series. Its time grows with the square of the order; none of an integration needs more than 25.
const MOST_TERMS: usize = 10_000;

/// The coefficients of series in time, x(t + s) = Σ x_k s^k, from k = 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficients<A> {
    /// Of each component of the state.
    pub state: Vec<Vec<A>>,
    /// Of each watched formula.
    pub watched: Vec<Vec<A>>,
}

/// What makes the coefficient k of a part from those of others.
#[derive(Debug)]
enum Rule {
    /// The time: coefficients t, 1, 0, …
    Time,
    /// A component of the state: coefficient k + 1 is that of its rate, divided by k + 1.
    State(usize),
    /// A number or a parameter.
    Constant,
    Negative(usize),
    Sum(usize, usize),
    Difference(usize, usize),
    Product(usize, usize),
    /// a / b.
    Quotient(usize, usize),
    /// y′ = Σ g u′, with the parts g and u.
    Chain(Vec<(usize, usize)>),
}

/// Taylor series in time of the motion ẋ = f(t, x; p), and of any formulas along it.
///
/// The series of a function f(u) comes from its derivative: y′ = g u′ gives k y_k = Σ j u_j g_{k−j}. The parts g are
/// parts of the same graph, so that one recurrence serves all functions. The order 0 is the value, with the same bits.
#[derive(Debug)]
pub struct Series {
    field: Formulas,
    rules: Vec<Rule>,
    /// The places of the state's components, of their rates, and of what is watched.
    states: Vec<usize>,
    rates: Vec<usize>,
    watched: Vec<usize>,
}

impl Series {
    /// The series of a field, one formula for each component of the state, and of formulas that are watched along the
    /// motion, such as guards.
    ///
    /// # Errors
    /// [`Error::Length`] if the field has another number of formulas than the state has components; [`Error::Name`] if the
    /// watched formulas have other names or values; [`Error::Kink`] for a function with a kink or a jump;
    /// [`Error::TooLarge`].
    pub fn new(field: &Formulas, watched: Option<&Formulas>) -> Result<Series, Error> {
        length("formulas of the field", field.names.states.len(), field.count())?;
        let mut graph = Graph::of(field.nodes.clone());
        let watched =
            watched.map_or(Ok(Vec::new()), |watched| field.joined(&mut graph, watched))?;
        // Also of components that no formula has.
        let count = field.names.states.len();
        let states = (0..count).map(|component| graph.place(Node::State(component))).collect();
        let mut rules = Vec::new();
        let mut moves: Vec<bool> = Vec::new();
        let mut place = 0;
        // Parts that are added for derivatives have series too.
        while place < graph.nodes().len() {
            let node = graph.nodes()[place].clone();
            let is_variable = matches!(node, Node::Time | Node::State(_));
            moves.push(is_variable || node.operands().any(|operand| moves[operand]));
            let rule = match node {
                // Also where the function has no derivative.
                _ if !moves[place] => Rule::Constant,
                Node::Time => Rule::Time,
                Node::State(at) => Rule::State(at),
                Node::Unary(Unary::Negative, a) => Rule::Negative(a),
                Node::Binary(Binary::Sum, a, b) => Rule::Sum(a, b),
                Node::Binary(Binary::Difference, a, b) => Rule::Difference(a, b),
                Node::Binary(Binary::Product, a, b) => Rule::Product(a, b),
                Node::Binary(Binary::Quotient, a, b) => Rule::Quotient(a, b),
                _ => {
                    let found = partials(&mut graph, place, |operand| moves[operand]);
                    Rule::Chain(
                        found.ok_or_else(|| Error::Kink { part: field.text_of(&graph, place) })?,
                    )
                }
            };
            rules.push(rule);
            place += 1;
            if graph.nodes().len() > MOST_PARTS {
                return Err(Error::TooLarge { limit: MOST_PARTS });
            }
        }
        let (rates, names) = (field.outputs.clone(), field.names.clone());
        let field = Formulas { names, nodes: graph.into_nodes(), outputs: rates.clone() };
        Ok(Series { field, rules, states, rates, watched })
    }

    /// The coefficients up to `order` at a time and a state.
    ///
    /// ```
    /// use equations::{Formulas, Names, Series};
    /// let names = Names::new(&["x", "v"], &[])?;
    /// let oscillator = Formulas::from_text(names, &["v", "-x"])?;
    /// let series = Series::new(&oscillator, None)?;
    /// let found = series.coefficients(0.0, &[0.0, 1.0], 5)?;
    /// assert_eq!(found.state[0], [0.0, 1.0, 0.0, -1.0 / 6.0, 0.0, 1.0 / 120.0]); // the sine
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::Order`] above 10 000; [`Error::NoValue`] for a part without a value, or whose derivative
    /// has none, as that of √x at 0.
    pub fn coefficients<A: Algebra + fmt::Debug>(
        &self,
        time: A,
        state: &[A],
        order: usize,
    ) -> Result<Coefficients<A>, Error> {
        length("components of the state", self.field.names.states.len(), state.len())?;
        if order > MOST_TERMS {
            return Err(Error::Order { order, most: MOST_TERMS });
        }
        self.field.check_start(&time, state)?;
        let mut start = Evaluator::new(&self.field);
        start.compute(&time, state);
        self.check(&time, state, &start.parts)?;
        // The coefficients of a part stand side by side.
        let terms = order + 1;
        let mut all = vec![A::zero(); start.parts.len() * terms];
        let mut last = start.parts;
        last.iter().enumerate().for_each(|(at, value)| all[at * terms] = value.clone());
        for k in 1..terms {
            for (at, last) in last.iter_mut().enumerate() {
                *last = self.coefficient(&all, terms, at, k);
                all[at * terms + k] = last.clone();
            }
            self.check(&time, state, &last)?;
        }
        let series = |place: usize| all[place * terms..][..terms].to_vec();
        let all_of = |places: &[usize]| places.iter().map(|&place| series(place)).collect();
        Ok(Coefficients { state: all_of(&self.states), watched: all_of(&self.watched) })
    }

    /// An error unless the coefficients of one order have values.
    fn check<A: Algebra + fmt::Debug>(
        &self,
        time: &A,
        state: &[A],
        values: &[A],
    ) -> Result<(), Error> {
        match values.iter().all(A::is_valid) {
            true => Ok(()),
            false => Err(self.field.no_value(time, state, values)),
        }
    }

    fn coefficient<A: Algebra>(&self, all: &[A], terms: usize, at: usize, k: usize) -> A {
        let series = |place: usize| &all[place * terms..][..terms];
        match &self.rules[at] {
            Rule::Time if k == 1 => A::constant(&1.0.into()),
            Rule::Time | Rule::Constant => A::zero(),
            Rule::State(component) => divided(&series(self.rates[*component])[k - 1], k),
            Rule::Negative(a) => A::unary(Unary::Negative, &series(*a)[k]),
            Rule::Sum(a, b) => A::binary(Binary::Sum, &series(*a)[k], &series(*b)[k]),
            Rule::Difference(a, b) => A::binary(Binary::Difference, &series(*a)[k], &series(*b)[k]),
            Rule::Product(a, b) if a == b => square(series(*a), k),
            Rule::Product(a, b) => convolution(&series(*a)[..=k], &series(*b)[..=k]),
            Rule::Quotient(a, b) => {
                // a = y b: y_k = (a_k − Σ_{j < k} y_j b_{k−j})/b_0.
                let known = convolution(&series(at)[..k], &series(*b)[1..=k]);
                let rest = A::binary(Binary::Difference, &series(*a)[k], &known);
                A::binary(Binary::Quotient, &rest, &series(*b)[0])
            }
            Rule::Chain(factors) => {
                // k y_k = Σ_{j = 1}^{k} j u_j g_{k−j}.
                let mut sum = A::zero();
                for &(g, u) in factors {
                    let (g, u) = (&series(g)[..k], &series(u)[1..=k]);
                    for (j, (u, g)) in u.iter().zip(g.iter().rev()).enumerate() {
                        sum = A::add_product(&sum, &A::times(u, (j + 1) as f64), g);
                    }
                }
                divided(&sum, k)
            }
        }
    }
}

/// Σ a_j b_{n−j} of two series with the terms 0 to n.
fn convolution<A: Algebra>(a: &[A], b: &[A]) -> A {
    a.iter().zip(b.iter().rev()).fold(A::zero(), |sum, (a, b)| A::add_product(&sum, a, b))
}

/// The coefficient k of a square: each product of two different ones occurs twice.
fn square<A: Algebra>(a: &[A], k: usize) -> A {
    let pairs = (0..k.div_ceil(2)).fold(A::zero(), |sum, j| A::add_product(&sum, &a[j], &a[k - j]));
    let twice = A::times(&pairs, 2.0);
    if k.is_multiple_of(2) { A::binary(Binary::Sum, &twice, &A::square(&a[k / 2])) } else { twice }
}

fn divided<A: Algebra>(x: &A, k: usize) -> A {
    A::binary(Binary::Quotient, x, &A::constant(&(k as f64).into()))
}
