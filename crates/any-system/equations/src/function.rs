//! Functions that a user brings.

use crate::error::Error;
use crate::expression::Expression;
use crate::graph::Graph;
use crate::node::Node;
use interval_arithmetic::Enclosure;
use std::cell::RefCell;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// A function of one number, and of no more, that formulas do not have, with all that they need of it: its value, its
/// enclosures, and its derivative as an expression, from which all higher ones and the Taylor series follow.
///
/// ```
/// use equations::{Enclosure, Formulas, Function, Names};
/// // Lambert's function W(x) for x ≥ 0, with W e^W = x. It rises, so that enclosures are those of the ends.
/// let value = |x: f64| {
///     let mut w = x.ln_1p();
///     for _ in 0..8 {
///         w -= (w - x * (-w).exp()) / (1.0 + w);
///     }
///     w
/// };
/// // Newton's method is right to some ulps.
/// let enclosure = move |x: Enclosure| {
///     let ends = Enclosure::new(value(x.low()), value(x.high()));
///     (x.low() >= 0.0).then(|| ends * Enclosure::around(1.0, 1e-14))
/// };
/// // W′ = e^(−W)/(1 + W): the closure has the argument and the value as symbols.
/// let lambert = Function::new("lambert", value, enclosure, |_, w| (-w).exp() / (1.0 + w))?;
///
/// let names = Names::new(&["x"], &[])?.with_functions(&[lambert.clone()])?;
/// let by_text = Formulas::from_text(names.clone(), &["2*lambert(x)"])?;
/// let by_closure = Formulas::new(names, move |_, x, _| [2.0 * lambert.of(x[0])])?;
/// assert_eq!(by_text.jacobian()?.texts(), by_closure.jacobian()?.texts());
/// let slope = by_text.jacobian()?.values(0.0, &[1f64.exp()])?[0]; // W(e) = 1
/// assert!((slope - (-1f64).exp()).abs() < 1e-15);
/// # Ok::<(), equations::Error>(())
/// ```
///
/// The value must depend on the number alone, so that all runs have the same bits. It must return for every `f64`: a step
/// that is refused later may ask for it outside the domain, or at NaN; answer NaN there. The enclosure must contain the
/// values of the exact function at all numbers of an interval; `None` means that it may leave the domain. No test can show
/// that it does: proofs take it as given.
#[derive(Clone)]
pub struct Function(Arc<Parts>);

type Value = dyn Fn(f64) -> f64 + Send + Sync;
type Enclosed = dyn Fn(Enclosure) -> Option<Enclosure> + Send + Sync;
type Derivative = dyn for<'g> Fn(Expression<'g>, Expression<'g>) -> Expression<'g> + Send + Sync;

struct Parts {
    name: String,
    value: Box<Value>,
    enclosure: Box<Enclosed>,
    derivative: Box<Derivative>,
}

impl Function {
    /// A function with a name, by its value, its enclosure, and its derivative from the argument and the value.
    ///
    /// # Errors
    /// [`Error::Name`] for a name that is none, or that has a meaning in formulas.
    pub fn new(
        name: &str,
        value: impl Fn(f64) -> f64 + Send + Sync + 'static,
        enclosure: impl Fn(Enclosure) -> Option<Enclosure> + Send + Sync + 'static,
        derivative: impl for<'g> Fn(Expression<'g>, Expression<'g>) -> Expression<'g>
        + Send
        + Sync
        + 'static,
    ) -> Result<Function, Error> {
        crate::names::check_name(name)?;
        Ok(Function(Arc::new(Parts {
            name: name.to_owned(),
            value: Box::new(value),
            enclosure: Box::new(enclosure),
            derivative: Box::new(derivative),
        })))
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// The function of a symbol.
    pub fn of<'g>(&self, argument: Expression<'g>) -> Expression<'g> {
        argument.with(|graph| graph.place(Node::Call(self.clone(), argument.place)))
    }

    /// Adds it to a list of functions, unless it is there.
    ///
    /// # Errors
    /// [`Error::Name`] for another one with its name: a text or a file could not tell them apart.
    pub(crate) fn note_in(&self, known: &mut Vec<Function>) -> Result<(), Error> {
        match known.iter().find(|known| known.name() == self.name()) {
            Some(known) if known == self => Ok(()),
            Some(_) => {
                let reason =
                    "that of two functions: make a function once, and use it wherever it is called";
                Err(Error::Name { name: self.name().to_owned(), reason })
            }
            None => {
                known.push(self.clone());
                Ok(())
            }
        }
    }

    pub(crate) fn value(&self, x: f64) -> f64 {
        (self.0.value)(x)
    }

    pub(crate) fn enclosure(&self, x: Enclosure) -> Option<Enclosure> {
        (self.0.enclosure)(x)
    }

    /// The derivative at an argument, where the value stands as well.
    pub(crate) fn derivative(&self, graph: &mut Graph, argument: usize, value: usize) -> usize {
        let shared = RefCell::new(std::mem::take(graph));
        let symbol = |place| Expression { graph: &shared, place };
        let found = (self.0.derivative)(symbol(argument), symbol(value)).place;
        *graph = shared.into_inner();
        found
    }
}

/// Two functions are equal if they are the same one.
impl PartialEq for Function {
    fn eq(&self, other: &Function) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Function {}

impl Hash for Function {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.name.hash(state);
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0.name)
    }
}
