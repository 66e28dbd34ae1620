//! Formulas of formulas.

use crate::error::Error;
use crate::formulas::{Formulas, length};
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};

impl Formulas {
    /// The formulas at another time and another state, f(τ(t, x), ξ(t, x)): `inner` has τ first, then each component of ξ.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let names = Names::new(&["x", "y"], &[])?;
    /// let sum = Formulas::from_text(names.clone(), &["t + x - y"])?;
    /// let inner = Formulas::from_text(names, &["2*t", "y", "x^2"])?;
    /// assert_eq!(sum.composed(&inner)?.texts(), ["2*t + y - x^2"]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of inner formulas; [`Error::Name`] for other names or values; [`Error::TooLarge`].
    pub fn composed(&self, inner: &Formulas) -> Result<Formulas, Error> {
        self.composed_of(inner, self.names.states.len())
    }

    /// The same with the number of components that these formulas speak of.
    pub(crate) fn composed_of(
        &self,
        inner: &Formulas,
        components: usize,
    ) -> Result<Formulas, Error> {
        length("inner formulas", components + 1, inner.count())?;
        let mut graph = Graph::default();
        let inner = self.joined(&mut graph, inner)?;
        let mut places: Vec<usize> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            places.push(match node {
                Node::Time => inner[0],
                Node::State(component) => inner[1 + component],
                node => graph.place(node.moved(&places)),
            });
        }
        graph.check()?;
        let outputs = self.outputs.iter().map(|&place| places[place]).collect();
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), outputs)
    }

    /// For each formula, true if it is 0 at every state by the way in which it is written: as a number, as a − a, as a difference of equal numbers, or
    /// as a product with such a factor. A formula that is 0 for another reason may have `false`.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let found = Formulas::from_text(Names::new(&["x"], &[])?, &["0.7 - 0.7", "x*0", "x"])?;
    /// assert_eq!(found.vanishes(), [true, true, false]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    pub fn vanishes(&self) -> Vec<bool> {
        // A decimal that is a double is the same number as this double.
        let number = |place: usize| {
            let enclosure = match &self.nodes[place] {
                Node::Constant(constant) => constant.enclosure(),
                Node::Parameter(at) => self.names.values[*at].enclosure(),
                _ => return None,
            };
            (enclosure.low() == enclosure.high()).then_some(enclosure.low())
        };
        let equal = |a: usize, b: usize| {
            a == b || number(a).zip(number(b)).is_some_and(|(own, other)| own == other)
        };
        let mut zero: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for (place, node) in self.nodes.iter().enumerate() {
            zero.push(match *node {
                Node::Constant(_) | Node::Parameter(_) => number(place) == Some(0.0),
                Node::Unary(Unary::Negative, a) => zero[a],
                Node::Binary(Binary::Difference, a, b) => equal(a, b) || (zero[a] && zero[b]),
                Node::Binary(Binary::Sum, a, b) => zero[a] && zero[b],
                Node::Binary(Binary::Product, a, b) => zero[a] || zero[b],
                _ => false,
            });
        }
        self.outputs.iter().map(|&place| zero[place]).collect()
    }

    /// True if each formula is written as the other's of the same place: the values are the same at every state.
    pub fn is_written_as(&self, other: &Formulas) -> bool {
        let Ok(both) = self.and(other) else { return false };
        let (own, others) = both.outputs.split_at(self.count());
        own == others
    }

    /// The formulas from the last to the first.
    #[must_use]
    pub fn turned_round(&self) -> Formulas {
        let outputs = self.outputs.iter().rev().copied().collect();
        Formulas::of(self.names.clone(), self.nodes.clone(), outputs)
    }

    /// The formulas with the other sign.
    #[must_use]
    pub fn negative(&self) -> Formulas {
        let mut graph = Graph::of(self.nodes.clone());
        let negative = |&place: &usize| graph.unary(Unary::Negative, place);
        let outputs = self.outputs.iter().map(negative).collect();
        Formulas::of(self.names.clone(), graph.into_nodes(), outputs)
    }

    /// The rates of the formulas along ẋ = f(t, x): ∂g/∂t + ∇g·f.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let names = Names::new(&["x", "v"], &[])?;
    /// let field = Formulas::from_text(names.clone(), &["v", "-x"])?;
    /// let height = Formulas::from_text(names, &["x - t^2"])?;
    /// assert_eq!(height.rate(&field)?.values(3.0, &[1.0, 2.0])?, [2.0 - 6.0]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for a field of another length than the state; [`Error::Name`] for other names or values; [`Error::Kink`]
    /// for a function with a kink or a jump; [`Error::TooLarge`].
    pub fn rate(&self, field: &Formulas) -> Result<Formulas, Error> {
        length("components of the field", self.names.states.len(), field.count())?;
        let mut graph = Graph::of(self.nodes.clone());
        let field = self.joined(&mut graph, field)?;
        let mut sums = self.along(&mut graph, |node| f64::from(*node == Node::Time))?;
        for (component, rate) in field.into_iter().enumerate() {
            let slopes =
                self.along(&mut graph, |node| f64::from(*node == Node::State(component)))?;
            for (sum, slope) in sums.iter_mut().zip(slopes) {
                let term = graph.product(slope, rate);
                *sum = graph.sum(*sum, term);
            }
        }
        graph.check()?;
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), sums)
    }

    /// The smaller one of each of the formulas and the other's.
    ///
    /// # Errors
    /// [`Error::Length`] for another number of formulas; [`Error::Name`] for other names or values; [`Error::TooLarge`].
    pub fn minimum(&self, other: &Formulas) -> Result<Formulas, Error> {
        length("other formulas", self.count(), other.count())?;
        let mut graph = Graph::of(self.nodes.clone());
        let other = self.joined(&mut graph, other)?;
        let pairs = self.outputs.iter().zip(other);
        let outputs = pairs.map(|(&a, b)| graph.binary(Binary::Minimum, a, b)).collect();
        graph.check()?;
        Formulas::of_parts(self.names.clone(), graph.into_nodes(), outputs)
    }
}
