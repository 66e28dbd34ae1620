//! Values of formulas.

use crate::algebra::Algebra;
use crate::error::Error;
use crate::formulas::{Formulas, length};
use crate::node::{Binary, Node};
use interval_arithmetic::Enclosure;
use smallvec::SmallVec;
use std::fmt::Debug;

/// Parts whose values are kept on the stack: guards and jumps have fewer. More would make small formulas slower.
const PARTS_IN_PLACE: usize = 64;

/// Parts of the smallest formulas, such as x − ½: the processor clears them at once.
const FEW_PARTS: usize = 8;

/// Formulas with memory for the values of their parts, for many values one after the other.
///
/// ```
/// use equations::{Evaluator, Formulas, Names};
/// let field = Formulas::from_text(Names::new(&["x"], &[("a", "3")])?, &["a*x*(1 - x)"])?;
/// let mut evaluator = Evaluator::new(&field);
/// let mut x = 0.5;
/// for _ in 0..1000 {
///     x = evaluator.values(0.0, &[x])?[0];
/// }
/// assert!((x - 2.0 / 3.0).abs() < 0.01);
/// # Ok::<(), equations::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Evaluator<'f, A> {
    formulas: &'f Formulas,
    /// The value of each part. Those of numbers and parameters stay.
    pub(crate) parts: Vec<A>,
    outputs: Vec<A>,
}

impl<'f, A: Algebra + Debug> Evaluator<'f, A> {
    /// Memory for the values of these formulas, with their numbers and parameters.
    pub fn new(formulas: &'f Formulas) -> Self {
        let outputs = Vec::with_capacity(formulas.count());
        Evaluator { formulas, parts: formulas.numbers(), outputs }
    }

    /// The values at a time and a state.
    ///
    /// # Errors
    /// As [`Formulas::values`].
    pub fn values(&mut self, time: A, state: &[A]) -> Result<&[A], Error> {
        length("components of the state", self.formulas.names.states.len(), state.len())?;
        self.formulas.check_start(&time, state)?;
        self.compute(&time, state);
        // A part that is infinite may leave no trace, as in 1/(1/x) or min(ln(x), 1).
        if let Some(part) = self.parts.iter().position(|value| !value.is_valid()) {
            return Err(self.formulas.no_value(part, &time, state));
        }
        self.outputs.clear();
        self.outputs.extend(self.formulas.outputs.iter().map(|&at| self.parts[at].clone()));
        Ok(&self.outputs)
    }

    /// The values of all parts.
    pub(crate) fn compute(&mut self, time: &A, state: &[A]) {
        compute(&self.formulas.nodes, time, state, &mut self.parts, 1);
    }
}

/// The values of some parts: that of part k at the place k · `stride` of `values`. Those of numbers are there.
#[inline(always)]
pub(crate) fn compute<A: Algebra>(
    nodes: &[Node],
    time: &A,
    state: &[A],
    values: &mut [A],
    stride: usize,
) {
    for (part, node) in nodes.iter().enumerate() {
        let of = |part: usize| &values[part * stride];
        values[part * stride] = match *node {
            Node::Parameter(_) | Node::Constant(_) => continue,
            Node::Time => time.clone(),
            Node::State(component) => state[component].clone(),
            Node::Unary(function, a) => A::unary(function, of(a)),
            Node::Binary(Binary::Product, a, b) if a == b => A::square(of(a)),
            Node::Binary(function, a, b) => A::binary(function, of(a), of(b)),
            Node::Call(ref function, a) => A::call(function, of(a)),
        };
    }
}

impl Formulas {
    /// The values, to the rounding of each operation: the same bits on every machine. [`Evaluator`] gives many of them
    /// in less time.
    ///
    /// # Errors
    /// [`Error::Length`] for another number of components; [`Error::NoValue`] if a part has no finite value, with this
    /// part: outside of a domain, at a pole, beyond the largest `f64`.
    pub fn values(&self, time: f64, state: &[f64]) -> Result<Vec<f64>, Error> {
        Evaluator::new(self).values(time, state).map(<[f64]>::to_vec)
    }

    /// As [`values`](Self::values), written into a slice of their number. Up to 64 parts need no memory of their own.
    ///
    /// # Errors
    /// As [`values`](Self::values).
    pub fn write_values(&self, time: f64, state: &[f64], into: &mut [f64]) -> Result<(), Error> {
        length("components of the state", self.names.states.len(), state.len())?;
        length("values", self.count(), into.len())?;
        let parts = self.parts_at(time, state);
        if !parts.iter().chain(state).all(|value| value.is_finite()) {
            self.check_start(&time, state)?;
            let part = parts.iter().position(|value| !value.is_finite()).unwrap_or(0);
            return Err(self.no_value(part, &time, state));
        }
        into.iter_mut().zip(&self.outputs).for_each(|(into, &at)| *into = parts[at]);
        Ok(())
    }

    /// The value of the first formula, NaN where it has none or the state has another length: for functions that are
    /// evaluated very often, such as guards.
    pub fn first_value(&self, time: f64, state: &[f64]) -> f64 {
        if state.len() != self.names.states.len() {
            return f64::NAN;
        }
        let Some(&first) = self.outputs.first() else { return f64::NAN };
        let value_of = |parts: &mut [f64]| {
            parts.copy_from_slice(&self.numbers);
            compute(&self.nodes, &time, state, parts, 1);
            if parts.iter().all(|value| value.is_finite()) { parts[first] } else { f64::NAN }
        };
        match self.nodes.len() {
            0..=FEW_PARTS => value_of(&mut [0.0; FEW_PARTS][..self.nodes.len()]),
            count => value_of(&mut SmallVec::<[f64; PARTS_IN_PLACE]>::from_elem(0.0, count)),
        }
    }

    // Not inlined, the parts would be moved.
    #[inline(always)]
    fn parts_at(&self, time: f64, state: &[f64]) -> SmallVec<[f64; PARTS_IN_PLACE]> {
        let mut parts = SmallVec::from_slice(&self.numbers);
        compute(&self.nodes, &time, state, &mut parts, 1);
        parts
    }

    /// Enclosures of the values at all times and states of the given intervals, and at the exact decimals of numbers and
    /// parameters.
    ///
    /// ```
    /// # use equations::{Formulas, Names};
    /// use interval_arithmetic::Enclosure;
    /// let names = Names::new(&["x"], &[])?;
    /// let square = Formulas::from_text(names, &["x^2 - 0.2"])?;
    /// let found = square.enclosures(Enclosure::ZERO, &[Enclosure::new(-1.0, 2.0)])?[0];
    /// assert!(found.contains(-0.2) && found.contains(3.8) && found.width() < 4.0 + 1e-14);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Formulas::values`], if a number of an interval may be outside the domain of a function.
    pub fn enclosures(
        &self,
        time: Enclosure,
        state: &[Enclosure],
    ) -> Result<Vec<Enclosure>, Error> {
        Evaluator::new(self).values(time, state).map(<[Enclosure]>::to_vec)
    }

    /// The values of numbers and parameters, and 0 for all other parts.
    pub(crate) fn numbers<A: Algebra>(&self) -> Vec<A> {
        self.nodes.iter().map(|node| self.number(node)).collect()
    }

    fn number<A: Algebra>(&self, node: &Node) -> A {
        match node {
            Node::Constant(constant) => A::constant(constant),
            Node::Parameter(at) => A::constant(&self.names.values[*at]),
            _ => A::zero(),
        }
    }

    /// An error unless time and state have values.
    pub(crate) fn check_start<A: Algebra + Debug>(
        &self,
        time: &A,
        state: &[A],
    ) -> Result<(), Error> {
        let wrong = state.iter().position(|component| !component.is_valid());
        let part = match wrong {
            Some(component) => self.names.states[component].clone(),
            None if !time.is_valid() => "t".to_owned(),
            None => return Ok(()),
        };
        Err(self.no_value_of(part, time, state))
    }

    /// The error that names a part without a value.
    pub(crate) fn no_value<A: Debug>(&self, part: usize, time: &A, state: &[A]) -> Error {
        self.no_value_of(self.part(part), time, state)
    }

    fn no_value_of<A: Debug>(&self, part: String, time: &A, state: &[A]) -> Error {
        let state: Vec<String> = state.iter().map(|value| format!("{value:?}")).collect();
        let parameters = self.names.parameters.iter().zip(&self.names.values);
        let parameters: Vec<String> =
            parameters.map(|(name, value)| format!("{name} = {value}")).collect();
        Error::NoValue {
            part,
            time: format!("{time:?}"),
            state: state.join(", "),
            parameters: parameters.join(", "),
        }
    }
}
