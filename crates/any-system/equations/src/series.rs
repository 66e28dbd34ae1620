//! Taylor series in time, along the motion ẋ = f(t, x; p).

use crate::algebra::{Algebra, Arithmetic};
use crate::error::Error;
use crate::evaluate::compute;
use crate::formulas::{Formulas, length as check_length};
use crate::graph::Graph;
use crate::node::Node;
use crate::rules::{Kind, Rule, Rules};
use std::fmt;

/// The highest order of a series. Its time grows with the square of the order; none of an integration needs more than 25.
const MOST_TERMS: usize = 10_000;

/// The coefficients of series in time, x(t + s) = Σ x_k s^k, from k = 0 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficients<A> {
    /// Row after row. A row has the coefficients of a part side by side, and then, of numbers that want it, the same ones from
    /// the last to the first.
    pub(crate) all: Vec<A>,
    pub(crate) terms: usize,
    /// The rows of the state's components, and of the watched formulas.
    states: Vec<usize>,
    watched: Vec<usize>,
    /// The rules, with the beginnings of rows as their places.
    pub(crate) rules: Vec<Rule>,
}

/// The length of a row.
#[inline(always)]
pub(crate) const fn length<A: Arithmetic>(terms: usize) -> usize {
    if A::REVERSED { 2 * terms } else { terms }
}

/// Keeps the coefficient k of a row.
#[inline(always)]
pub(crate) fn keep<A: Arithmetic>(row: &mut [A], k: usize, found: A) {
    if A::REVERSED {
        let last = row.len() - 1;
        row[last - k] = found.clone();
    }
    row[k] = found;
}

impl<A: Arithmetic> Coefficients<A> {
    #[inline(always)]
    fn row(&self, row: usize) -> &[A] {
        &self.all[row * length::<A>(self.terms)..][..self.terms]
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
    #[inline(always)]
    pub fn states(&self) -> impl ExactSizeIterator<Item = &[A]> {
        self.states.iter().map(|&row| self.row(row))
    }

    /// Of all watched formulas, one after the other.
    #[inline(always)]
    pub fn all_watched(&self) -> impl ExactSizeIterator<Item = &[A]> {
        self.watched.iter().map(|&row| self.row(row))
    }

    /// Writes the coefficients of the state and of the watched formulas, each as `of` takes it.
    pub(crate) fn show(&self, of: impl Fn(&A) -> f64, into: &mut Coefficients<f64>) {
        let row_length = length::<f64>(into.terms);
        for (row, own) in self.states().chain(self.all_watched()).enumerate() {
            let into = &mut into.all[row * row_length..][..own.len()];
            into.iter_mut().zip(own).for_each(|(into, own)| *into = of(own));
        }
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
    pub(crate) rules: Rules,
    /// The rows of the state's components and of the watched formulas.
    states: Vec<usize>,
    watched: Vec<usize>,
    /// The first parts, of which the field consists, and with them those of the watched formulas.
    pub(crate) field_parts: usize,
    pub(crate) value_parts: usize,
    /// For each row, whether the field needs it.
    in_field: Vec<bool>,
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
        Series::with(field, watched, true)
    }

    /// The same, with or without the knowledge of what is a polynomial in time.
    pub(crate) fn with(
        field: &Formulas,
        watched: Option<&Formulas>,
        polynomials: bool,
    ) -> Result<Series, Error> {
        check_length("formulas of the field", field.names.states.len(), field.count())?;
        let mut graph = Graph::of(field.nodes.clone());
        let field_parts = field.nodes.len();
        let watched =
            watched.map_or(Ok(Vec::new()), |watched| field.joined(&mut graph, watched))?;
        // Also of components that no formula has.
        let count = field.names.states.len();
        let states: Vec<usize> =
            (0..count).map(|component| graph.place(Node::State(component))).collect();
        let value_parts = graph.nodes().len();
        let rules = Rules::new(field, graph, polynomials)?;
        let in_field = rules.needed(&states);
        let (names, outputs) = (field.names.clone(), field.outputs.clone());
        let field = Formulas::of(names, rules.nodes.clone(), outputs);
        Ok(Series { field, rules, states, watched, field_parts, value_parts, in_field })
    }

    /// The number of components of the state.
    pub fn dimension(&self) -> usize {
        self.states.len()
    }

    /// The degree in time of a motion all of whose components are polynomials, from any start: such as a free fall.
    pub fn degree(&self) -> Option<usize> {
        let degree = |&row: &usize| self.rules.terms[row].map(|terms| terms - 1);
        let degrees: Option<Vec<usize>> = self.states.iter().map(degree).collect();
        Some(degrees?.into_iter().max().unwrap_or(0))
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
        let length = length::<A>(found.terms);
        let wrong = |row: &usize| !found.all[row * length..][..found.terms].iter().all(A::is_valid);
        match (0..self.field.nodes.len()).find(wrong) {
            Some(part) => Err(self.field.no_value(part, &time, state)),
            None => Ok(found),
        }
    }

    /// Memory for coefficients up to an order, to be used again and again.
    pub(crate) fn memory<A: Algebra>(&self, order: usize) -> Result<Coefficients<A>, Error> {
        let mut memory = self.empty(order)?;
        let length = length::<A>(memory.terms);
        for (row, value) in self.field.numbers().into_iter().enumerate() {
            memory.all[row * length] = value;
        }
        Ok(memory)
    }

    /// The same without the values of numbers.
    pub(crate) fn empty<A: Arithmetic>(&self, order: usize) -> Result<Coefficients<A>, Error> {
        if order > MOST_TERMS {
            return Err(Error::Order { order, most: MOST_TERMS });
        }
        let terms = order + 1;
        if self.rules.rows() * length::<A>(terms) > u32::MAX as usize {
            return Err(Error::TooLarge { limit: u32::MAX as usize / length::<A>(terms) });
        }
        let all = vec![A::zero(); self.rules.rows() * length::<A>(terms)];
        let (states, watched) = (self.states.clone(), self.watched.clone());
        let rules = self.rules.of_length(length::<A>(terms));
        Ok(Coefficients { all, terms, states, watched, rules })
    }

    /// Memory for the coefficients of the state and of the watched formulas alone.
    pub(crate) fn outline(&self, order: usize) -> Result<Coefficients<f64>, Error> {
        if order > MOST_TERMS {
            return Err(Error::Order { order, most: MOST_TERMS });
        }
        let (terms, count) = (order + 1, self.states.len());
        let rows = count + self.watched.len();
        let all = vec![0.0; rows * length::<f64>(terms)];
        let (states, watched) = ((0..count).collect(), (count..rows).collect());
        Ok(Coefficients { all, terms, states, watched, rules: Vec::new() })
    }

    /// The place of a watched formula among the parts.
    pub(crate) fn watched_part(&self, formula: usize) -> Option<usize> {
        self.watched.get(formula).copied()
    }

    /// Computes all coefficients at a time and a state. Those of watched formulas may have no values.
    pub(crate) fn expand<A: Algebra + fmt::Debug>(
        &self,
        time: &A,
        state: &[A],
        into: &mut Coefficients<A>,
    ) -> Result<(), Error> {
        check_length("components of the state", self.states.len(), state.len())?;
        self.field.check_start(time, state)?;
        if self.compute(time, state, into).is_valid() {
            return Ok(());
        }
        match self.without_value(into) {
            part if self.in_field[part] => Err(self.field.no_value(part, time, state)),
            _ => Ok(()),
        }
    }

    /// The same without a test of time and state: zero, or no value if a coefficient has none.
    #[inline(always)]
    pub(crate) fn compute<A: Algebra>(
        &self,
        time: &A,
        state: &[A],
        into: &mut Coefficients<A>,
    ) -> A {
        let length = length::<A>(into.terms);
        compute(&self.field.nodes, time, state, &mut into.all, length);
        self.finish(into)
    }

    /// Computes the coefficients from those of order 0: zero, or no value if one of them has none.
    #[inline(always)]
    pub(crate) fn finish<A: Arithmetic>(&self, into: &mut Coefficients<A>) -> A {
        let (terms, length) = (into.terms, length::<A>(into.terms));
        let Coefficients { all, rules, .. } = into;
        let nothing_of = |x: &A| A::times(x, 0.0);
        let mut zero = A::zero();
        for x in all.iter().step_by(length) {
            zero = A::sum(&zero, &nothing_of(x));
        }
        let (polynomials, longest) = self.rules.polynomials;
        for k in 1..terms {
            let inverse = 1.0 / k as f64;
            // Behind their last terms the coefficients are zero, and stay so.
            for rule in &rules[if k < longest { 0 } else { polynomials }..] {
                let found = coefficient(all, length, rule, (k, inverse));
                zero = A::sum(&zero, &nothing_of(&found));
                keep(&mut all[rule.row as usize..][..length], k, found);
            }
        }
        zero
    }

    /// Of the lowest order without a value, the first part, and one that the field needs if there is one.
    #[cold]
    pub(crate) fn without_value<A: Arithmetic>(&self, into: &Coefficients<A>) -> usize {
        let (terms, length) = (into.terms, length::<A>(into.terms));
        let parts = self.field.nodes.len();
        let order = |k: usize| (0..parts).map(move |row| row * length + k);
        let wrong = || (0..terms).flat_map(order).filter(|&at| !into.all[at].is_valid());
        let in_field = wrong().find(|&at| self.in_field[at / length]);
        in_field.or_else(|| wrong().next()).map_or(0, |at| at / length)
    }
}

/// The coefficient k of a row, from those of all rows, with the `f64` next to 1/k.
#[inline(always)]
pub(crate) fn coefficient<A: Arithmetic>(
    all: &[A],
    length: usize,
    rule: &Rule,
    (k, inverse): (usize, f64),
) -> A {
    let [a, b, c, d] = rule.of.map(|row| row as usize);
    let row = rule.row as usize;
    let of = |row: usize, k: usize| &all[row + k];
    match rule.kind {
        Kind::Time if k == 1 => A::one(),
        Kind::Time => A::zero(),
        Kind::State => A::over(of(a, k - 1), k as f64, inverse),
        Kind::Negative => A::negative(of(a, k)),
        Kind::Sum => A::sum(of(a, k), of(b, k)),
        Kind::Difference => A::difference(of(a, k), of(b, k)),
        Kind::Scaled => A::product(of(a, 0), of(b, k)),
        Kind::Over => A::quotient(of(a, k), of(b, 0)),
        Kind::Slope => A::times(of(a, k), k as f64),
        Kind::Square => {
            let ends = A::product(of(a, 0), of(a, k));
            A::sum(&inner_square(all, length, a, k), &A::times(&ends, 2.0))
        }
        Kind::Product => {
            let ends = A::sum(&A::product(of(a, 0), of(b, k)), &A::product(of(a, k), of(b, 0)));
            A::sum(&inner(all, length, (a, b), k, rule.most), &ends)
        }
        Kind::Quotient => {
            // a = y b: y_k = (a_k − Σ_{j ≥ 1} b_j y_{k−j})/b_0.
            let known = inner(all, length, (b, row), k, rule.most);
            let known = A::sum(&known, &A::product(of(b, k), of(row, 0)));
            A::quotient(&A::difference(of(a, k), &known), of(b, 0))
        }
        Kind::Root => {
            // y y = a: 2 y_0 y_k = a_k − Σ y_j y_{k−j}.
            let rest = A::difference(of(a, k), &inner_square(all, length, row, k));
            A::quotient(&rest, &A::times(of(row, 0), 2.0))
        }
        Kind::Power => {
            // y′ a = exponent a′ y: k y_k a_0 = exponent Σ_{j ≥ 1} j a_j y_{k−j} − Σ_{0 < j < k} j y_j a_{k−j}.
            let grows = product_of_slopes(all, length, (row, c), k, u32::MAX);
            let known = inner(all, length, (d, a), k, u32::MAX);
            let rest = A::difference(&A::product(of(b, 0), &grows), &known);
            A::over(&A::quotient(&rest, of(a, 0)), k as f64, inverse)
        }
        Kind::Chain => {
            A::over(&product_of_slopes(all, length, (a, b), k, rule.most), k as f64, inverse)
        }
        Kind::LinearChain => A::over(&A::product(of(b, 1), of(a, k - 1)), k as f64, inverse),
        Kind::Chains => {
            let first = product_of_slopes(all, length, (a, b), k, u32::MAX);
            let second = product_of_slopes(all, length, (c, d), k, u32::MAX);
            A::over(&A::sum(&first, &second), k as f64, inverse)
        }
    }
}

/// Σ a_j b_{k−j} for 0 < j < k, and j < `most`. The two terms at the ends, which have just been computed, are added by
/// themselves: nothing waits for them.
#[inline(always)]
fn inner<A: Arithmetic>(
    all: &[A],
    length: usize,
    (a, b): (usize, usize),
    k: usize,
    most: u32,
) -> A {
    let count = (most as usize).min(k) - 1;
    let second = if A::REVERSED { b + length - k } else { b + k - count };
    A::convolution(&all[a + 1..][..count], &all[second..][..count])
}

/// The same of a row with itself: each product of two different coefficients occurs twice.
#[inline(always)]
fn inner_square<A: Arithmetic>(all: &[A], length: usize, a: usize, k: usize) -> A {
    let twice = A::times(&inner(all, length, (a, a), k, k.div_ceil(2) as u32), 2.0);
    match k.is_multiple_of(2) {
        true => A::sum(&twice, &A::square(&all[a + k / 2])),
        false => twice,
    }
}

/// k times the coefficient k of y, with y′ = g u′: Σ_{j ≥ 1} j u_j g_{k−j}.
#[inline(always)]
fn product_of_slopes<A: Arithmetic>(
    all: &[A],
    length: usize,
    (g, slope): (usize, usize),
    k: usize,
    most: u32,
) -> A {
    let end = A::product(&all[slope + k], &all[g]);
    A::sum(&inner(all, length, (slope, g), k, most), &end)
}
