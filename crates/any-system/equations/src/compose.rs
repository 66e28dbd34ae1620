//! Formulas of formulas.

use crate::error::Error;
use crate::formulas::{Formulas, length};
use crate::graph::Graph;
use crate::node::{Node, Unary};

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
        length("inner formulas", self.names.states.len() + 1, inner.count())?;
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

    /// Some of the formulas, in this order. Numbers beyond the last one are left out.
    #[must_use]
    pub fn reordered(&self, order: impl IntoIterator<Item = usize>) -> Formulas {
        let outputs = order.into_iter().filter_map(|at| self.outputs.get(at).copied()).collect();
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
}
