//! Values of formulas.

use crate::algebra::Algebra;
use crate::error::Error;
use crate::formulas::{Formulas, length};
use crate::node::{Binary, Node};
use interval_arithmetic::Enclosure;

/// Where formulas are computed: time, state and parameters in one kind of number.
#[derive(Debug, Clone)]
pub(crate) struct Place<'a, A> {
    pub(crate) time: A,
    pub(crate) state: &'a [A],
    pub(crate) parameters: Vec<A>,
}

impl Formulas {
    /// The values, to the rounding of each operation: the same bits on every machine.
    ///
    /// # Errors
    /// [`Error::Length`] for another number of components; [`Error::NoValue`] if a value is not finite, with the first
    /// part of which this is so.
    pub fn values(&self, time: f64, state: &[f64]) -> Result<Vec<f64>, Error> {
        self.outputs_at(time, state)
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
        self.outputs_at(time, state)
    }

    fn outputs_at<A: Algebra + std::fmt::Debug>(
        &self,
        time: A,
        state: &[A],
    ) -> Result<Vec<A>, Error> {
        let place = self.place(time, state)?;
        let all = self.all_values(&place);
        if self.outputs.iter().all(|&at| all[at].is_valid()) {
            return Ok(self.outputs.iter().map(|&at| all[at].clone()).collect());
        }
        Err(self.no_value(&place, &all, &self.outputs))
    }

    /// Where formulas are computed, with the values of the parameters.
    pub(crate) fn place<'a, A: Algebra>(
        &self,
        time: A,
        state: &'a [A],
    ) -> Result<Place<'a, A>, Error> {
        length("components of the state", self.names.states.len(), state.len())?;
        let parameters = self.names.values.iter().map(A::constant).collect();
        Ok(Place { time, state, parameters })
    }

    /// The values of all parts.
    pub(crate) fn all_values<A: Algebra>(&self, place: &Place<'_, A>) -> Vec<A> {
        let mut values: Vec<A> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let value = match node {
                Node::Time => place.time.clone(),
                Node::State(at) => place.state[*at].clone(),
                Node::Parameter(at) => place.parameters[*at].clone(),
                Node::Constant(constant) => A::constant(constant),
                Node::Unary(function, a) => A::unary(*function, &values[*a]),
                Node::Binary(Binary::Product, a, b) if a == b => A::square(&values[*a]),
                Node::Binary(function, a, b) => A::binary(*function, &values[*a], &values[*b]),
            };
            values.push(value);
        }
        values
    }

    /// The error that names the part without a value from which it comes that one of `wanted` has none.
    pub(crate) fn no_value<A: Algebra + std::fmt::Debug>(
        &self,
        place: &Place<'_, A>,
        values: &[A],
        wanted: &[usize],
    ) -> Error {
        let is_wrong = |at: &usize| !values[*at].is_valid();
        let mut first = wanted.iter().copied().find(is_wrong).unwrap_or(0);
        while let Some(operand) = self.nodes[first].operands().find(is_wrong) {
            first = operand;
        }
        let list = |values: &[A]| {
            values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", ")
        };
        Error::NoValue {
            part: self.part(first),
            time: format!("{:?}", place.time),
            state: list(place.state),
            parameters: list(&place.parameters),
        }
    }
}
