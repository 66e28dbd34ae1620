//! Formulas together with their derivatives along a motion, with respect to its start.

use crate::error::Error;
use crate::formulas::{Formulas, length};
use crate::graph::Graph;
use crate::node::Node;

impl Formulas {
    /// The formulas f, and after them the products Df·V, row by row, with the n² entries of a matrix V, row by row, as further components
    /// of the state of n components.
    ///
    /// Of a field this is the field of the motion together with V = ∂x/∂x₀, whose rate is Df·V. Of a guard g along this motion they
    /// are the guard and its derivatives with respect to the start. Components that are `carried` change by the same amount whatever the
    /// state is, such as a time and a parameter: their rows of V are those of the identity for ever, and are taken as these numbers.
    ///
    /// ```
    /// use equations::{Formulas, Names, Series};
    /// let names = Names::new(&["x", "v"], &[])?;
    /// let oscillator = Formulas::from_text(names, &["v", "-x"])?;
    /// let motion = Series::new(&oscillator.with_variations(&oscillator.carried())?, None)?;
    /// let start = [1.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    /// // ∂x/∂v₀ is the sine.
    /// assert_eq!(motion.coefficients(0.0, &start, 3)?.state(3), [0.0, 1.0, 0.0, -1.0 / 6.0]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of marks than components; [`Error::Kink`] for a function with a kink or a jump;
    /// [`Error::TooLarge`].
    pub fn with_variations(&self, carried: &[bool]) -> Result<Formulas, Error> {
        let count = self.names.states.len();
        length("marks of components", count, carried.len())?;
        let mut names = self.names.clone();
        for (row, column) in (0..count).flat_map(|row| (0..count).map(move |column| (row, column)))
        {
            let mut name = format!("d{row}_{column}");
            while names.all().any(|known| known == name) {
                name.push('_');
            }
            names.states.push(name);
        }
        let mut graph = Graph::of(self.nodes.clone());
        let columns: Vec<Vec<usize>> = (0..count)
            .map(|at| self.along(&mut graph, |node| f64::from(*node == Node::State(at))))
            .collect::<Result<_, Error>>()?;
        let mut outputs = self.outputs.clone();
        for formula in 0..self.count() {
            for variation in 0..count {
                let mut sum = graph.number(0.0);
                for (component, column) in columns.iter().enumerate() {
                    let entry = match carried[component] {
                        true => graph.number(f64::from(component == variation)),
                        false => graph.place(Node::State(count * (1 + component) + variation)),
                    };
                    let term = graph.product(column[formula], entry);
                    sum = graph.sum(sum, term);
                }
                outputs.push(sum);
            }
        }
        graph.check()?;
        Formulas::of_parts(names, graph.into_nodes(), outputs)
    }

    /// For each formula of a field, true if it is a number whatever time and state are.
    pub fn carried(&self) -> Vec<bool> {
        self.constants().iter().map(Option::is_some).collect()
    }

    /// The same formulas with some parameters as further components of the state, the last ones, in this order, and with a
    /// `further` formula for each of them, made of the number of its component: of a field the number 0; of a jump the component
    /// itself, which stays; of others none.
    ///
    /// ```
    /// use equations::{Formulas, Names, Node};
    /// let names = Names::new(&["x"], &[("a", "2"), ("b", "3")])?;
    /// let field = Formulas::from_text(names, &["a*x + b"])?;
    /// let moved = field.with_states_for(&["b"], |_| Some(Node::Constant(0.0.into())))?;
    /// assert_eq!(moved.names().states, ["x", "b"]);
    /// assert_eq!(moved.values(0.0, &[1.0, 5.0])?, [7.0, 0.0]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Name`] for a name that is no parameter, or is given twice.
    pub fn with_states_for(
        &self,
        parameters: &[&str],
        further: impl Fn(usize) -> Option<Node>,
    ) -> Result<Formulas, Error> {
        let mut names = self.names.clone();
        let mut places = Vec::new();
        for &name in parameters {
            let place = self.names.parameters.iter().position(|known| known == name);
            let refused = |reason| Error::Name { name: name.to_owned(), reason };
            let place = place.ok_or_else(|| refused("no parameter of these formulas"))?;
            if places.contains(&place) {
                return Err(refused("used twice"));
            }
            places.push(place);
            names.states.push(name.to_owned());
        }
        // The parameters that stay, and their new places.
        let stays = |place: &usize| !places.contains(place);
        let kept: Vec<usize> = (0..names.parameters.len()).filter(stays).collect();
        names.parameters = kept.iter().map(|&place| self.names.parameters[place].clone()).collect();
        names.values = kept.iter().map(|&place| self.names.values[place].clone()).collect();
        let first = self.names.states.len();
        let moved = |node: &Node| match node {
            Node::Parameter(at) => match places.iter().position(|place| place == at) {
                Some(added) => Node::State(first + added),
                None => Node::Parameter(kept.iter().position(|place| place == at).unwrap_or(0)),
            },
            node => node.clone(),
        };
        let mut graph = Graph::of(self.nodes.iter().map(moved).collect());
        let added = (first..first + places.len()).filter_map(further);
        let added: Vec<usize> = added.map(|node| graph.place(node)).collect();
        let outputs = self.outputs.iter().copied().chain(added).collect();
        Ok(Formulas::of(names, graph.into_nodes(), outputs))
    }

    /// These formulas at the states that other formulas are, f(t, ξ(t, y)): `inner` has a formula for each component of the state, of a state with
    /// names of its own, and the same parameters.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let height = Formulas::from_text(Names::new(&["x", "y"], &[])?, &["y - x^2"])?;
    /// let chart = Formulas::from_text(Names::new(&["s"], &[])?, &["s", "s^2"])?;
    /// assert_eq!(height.on(&chart)?.values(0.0, &[3.0])?, [0.0]);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] for another number of inner formulas; [`Error::Name`] for other parameters or values; [`Error::TooLarge`].
    pub fn on(&self, inner: &Formulas) -> Result<Formulas, Error> {
        let mut renamed = self.clone();
        renamed.names.states.clone_from(&inner.names.states);
        let time = Formulas::of(inner.names.clone(), vec![Node::Time], vec![0]);
        renamed.composed_of(&time.and(inner)?, self.names.states.len())
    }

    /// The formulas, and after them the last `count` components of the state as formulas of themselves: of a map that has parameters
    /// among its variables.
    #[must_use]
    pub fn with_last_states(&self, count: usize) -> Formulas {
        let mut graph = Graph::of(self.nodes.clone());
        let states = self.names.states.len();
        let last = (states.saturating_sub(count)..states).map(|at| graph.place(Node::State(at)));
        let outputs = self.outputs.iter().copied().chain(last).collect();
        Formulas::of(self.names.clone(), graph.into_nodes(), outputs)
    }
}
