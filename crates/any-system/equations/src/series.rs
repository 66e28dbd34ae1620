//! Taylor series in time, along the motion ẋ = f(t, x; p).

use crate::algebra::Algebra;
use crate::error::Error;
use crate::evaluate::compute;
use crate::formulas::{Formulas, length};
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};
use crate::rules::{Rule, Rules};
use std::fmt;

/// The highest order of a series. Its time grows with the square of the order; none of an integration needs more than 25.
const MOST_TERMS: usize = 10_000;

/// The coefficients of series in time, x(t + s) = Σ x_k s^k, from k = 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficients<A> {
    /// Row after row: those of a part stand side by side.
    all: Vec<A>,
    terms: usize,
    /// The rows of the state's components, and of the watched formulas.
    states: Vec<usize>,
    watched: Vec<usize>,
}

impl<A> Coefficients<A> {
    fn row(&self, row: usize) -> &[A] {
        &self.all[row * self.terms..][..self.terms]
    }

    /// Of a component of the state; none beyond the last one.
    pub fn state(&self, component: usize) -> &[A] {
        self.states.get(component).map_or(&[], |&row| self.row(row))
    }

    /// Of a watched formula; none beyond the last one.
    pub fn watched(&self, formula: usize) -> &[A] {
        self.watched.get(formula).map_or(&[], |&row| self.row(row))
    }

    /// Of all components, one after the other.
    pub fn states(&self) -> impl ExactSizeIterator<Item = &[A]> {
        self.states.iter().map(|&row| self.row(row))
    }

    /// Of all watched formulas, one after the other.
    pub fn all_watched(&self) -> impl ExactSizeIterator<Item = &[A]> {
        self.watched.iter().map(|&row| self.row(row))
    }
}

/// Taylor series in time of the motion ẋ = f(t, x; p), and of any formulas along it.
///
/// The series of a function f(u) comes from its derivative: y′ = g u′ gives k y_k = Σ j u_j g_{k−j}. The parts g are
/// parts of the same graph, so that one recurrence serves all functions. The order 0 is the value, with the same bits.
#[derive(Debug)]
pub struct Series {
    /// The field and the watched formulas, with the parts that their series need.
    pub(crate) field: Formulas,
    rules: Rules,
    /// The rows of the state's components and of the watched formulas.
    states: Vec<usize>,
    watched: Vec<usize>,
    /// The first parts, of which the field consists.
    pub(crate) field_parts: usize,
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
        let field_parts = field.nodes.len();
        let watched =
            watched.map_or(Ok(Vec::new()), |watched| field.joined(&mut graph, watched))?;
        // Also of components that no formula has.
        let count = field.names.states.len();
        let states = (0..count).map(|component| graph.place(Node::State(component))).collect();
        let rules = Rules::new(field, graph)?;
        let (names, outputs) = (field.names.clone(), field.outputs.clone());
        let field = Formulas { names, nodes: rules.nodes.clone(), outputs };
        Ok(Series { field, rules, states, watched, field_parts })
    }

    /// The number of components of the state.
    pub fn dimension(&self) -> usize {
        self.states.len()
    }

    /// The degree in time of a motion all of whose components are polynomials, from any start: such as a free fall.
    pub fn degree(&self) -> Option<usize> {
        let degrees = self.states.iter().map(|&row| self.rules.terms[row].map(|terms| terms - 1));
        degrees.fold(Some(0), |most, degree| most.zip(degree).map(|(most, one)| most.max(one)))
    }

    /// The coefficients up to `order` at a time and a state.
    ///
    /// ```
    /// use equations::{Formulas, Names, Series};
    /// let names = Names::new(&["x", "v"], &[])?;
    /// let oscillator = Formulas::from_text(names, &["v", "-x"])?;
    /// let series = Series::new(&oscillator, None)?;
    /// let found = series.coefficients(0.0, &[0.0, 1.0], 5)?;
    /// assert_eq!(found.state(0), [0.0, 1.0, 0.0, -1.0 / 6.0, 0.0, 1.0 / 120.0]); // the sine
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
        let mut found = self.memory(order)?;
        self.expand(&time, state, &mut found)?;
        Ok(found)
    }

    /// Memory for coefficients up to an order, to be used again and again.
    pub(crate) fn memory<A: Algebra>(&self, order: usize) -> Result<Coefficients<A>, Error> {
        if order > MOST_TERMS {
            return Err(Error::Order { order, most: MOST_TERMS });
        }
        let terms = order + 1;
        let mut all = vec![A::zero(); self.rules.rows() * terms];
        for (row, value) in self.field.numbers().into_iter().enumerate() {
            all[row * terms] = value;
        }
        Ok(Coefficients { all, terms, states: self.states.clone(), watched: self.watched.clone() })
    }

    /// Computes all coefficients at a time and a state.
    pub(crate) fn expand<A: Algebra + fmt::Debug>(
        &self,
        time: &A,
        state: &[A],
        into: &mut Coefficients<A>,
    ) -> Result<(), Error> {
        length("components of the state", self.states.len(), state.len())?;
        self.field.check_start(time, state)?;
        let terms = into.terms;
        compute(&self.field.nodes, time, state, &mut into.all, terms);
        for k in 1..terms {
            for &(row, rule) in &self.rules.moving {
                let coefficient = self.coefficient(&into.all, terms, (row, rule), k);
                into.all[row * terms + k] = coefficient;
            }
        }
        if into.all.iter().all(A::is_valid) {
            return Ok(());
        }
        // Of the lowest order without a value, the first part.
        let parts = self.field.nodes.len();
        let order = |k: usize| (0..parts).map(move |row| row * terms + k);
        let wrong = (0..terms).flat_map(order).find(|&at| !into.all[at].is_valid());
        let part = wrong.map_or(0, |at| at / terms);
        Err(self.field.no_value(part, time, state))
    }

    #[inline(always)]
    fn coefficient<A: Algebra>(
        &self,
        all: &[A],
        terms: usize,
        (row, rule): (usize, Rule),
        k: usize,
    ) -> A {
        let of = |row: usize| &all[row * terms..][..terms];
        // The last term of a row that may differ from zero, up to k.
        let last = |row: usize| self.rules.terms[row].map_or(k, |terms| k.min(terms - 1));
        match rule {
            Rule::Time if k == 1 => A::constant(&1.0.into()),
            Rule::Time => A::zero(),
            Rule::State(rate) => A::over(&of(rate)[k - 1], k as f64),
            Rule::Negative(a) => A::unary(Unary::Negative, &of(a)[k]),
            Rule::Sum(a, b) => A::binary(Binary::Sum, &of(a)[k], &of(b)[k]),
            Rule::Difference(a, b) => A::binary(Binary::Difference, &of(a)[k], &of(b)[k]),
            Rule::Scaled(number, a) => A::binary(Binary::Product, &of(number)[0], &of(a)[k]),
            Rule::Over(a, number) => A::binary(Binary::Quotient, &of(a)[k], &of(number)[0]),
            Rule::Slope(a) => A::times(&of(a)[k], k as f64),
            Rule::Square(a) => square(of(a), k),
            Rule::Product(a, b) => {
                let last = last(a);
                convolution(&of(a)[..=last], &of(b)[k - last..=k])
            }
            Rule::Quotient(a, b) => {
                // a = y b: y_k = (a_k − Σ_{j ≥ 1} b_j y_{k−j})/b_0.
                let last = last(b);
                let known = convolution(&of(b)[1..=last], &of(row)[k - last..k]);
                let rest = A::binary(Binary::Difference, &of(a)[k], &known);
                A::binary(Binary::Quotient, &rest, &of(b)[0])
            }
            Rule::Chain(first, second) => {
                // k y_k = Σ_{j = 1}^{k} j u_j g_{k−j}.
                let sum = |(g, slope): (usize, usize)| {
                    let last = last(slope);
                    convolution(&of(slope)[1..=last], &of(g)[k - last..k])
                };
                let first = sum(first);
                let all = match second {
                    Some(second) => A::binary(Binary::Sum, &first, &sum(second)),
                    None => first,
                };
                A::over(&all, k as f64)
            }
        }
    }
}

/// Σ a_j b_{n−j} of two series with the terms 0 to n. Two sums, of even and of odd j, are computed side by side.
#[inline(always)]
fn convolution<A: Algebra>(a: &[A], b: &[A]) -> A {
    let (mut even, mut odd) = (A::zero(), A::zero());
    let (pairs, left) = a.as_chunks::<2>();
    let (first, others) = b.as_rchunks::<2>();
    for (a, b) in pairs.iter().zip(others.iter().rev()) {
        even = A::add_product(&even, &a[0], &b[1]);
        odd = A::add_product(&odd, &a[1], &b[0]);
    }
    if let ([a], [b]) = (left, first) {
        even = A::add_product(&even, a, b);
    }
    A::binary(Binary::Sum, &even, &odd)
}

/// The coefficient k of a square: each product of two different ones occurs twice.
#[inline(always)]
fn square<A: Algebra>(a: &[A], k: usize) -> A {
    let half = k.div_ceil(2);
    let twice = A::times(&convolution(&a[..half], &a[k + 1 - half..=k]), 2.0);
    if k.is_multiple_of(2) { A::binary(Binary::Sum, &twice, &A::square(&a[k / 2])) } else { twice }
}
