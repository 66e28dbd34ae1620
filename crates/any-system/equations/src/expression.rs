//! Symbols that a closure computes with.

use crate::constant::Constant;
use crate::error::Error;
use crate::graph::Graph;
use crate::node::{Binary, Node, Unary};
use std::cell::RefCell;
use std::ops::{Add, Bound, Deref, Div, Index, Mul, Neg, Sub};
use std::ops::{Range, RangeBounds, RangeFrom, RangeInclusive, RangeTo, RangeToInclusive};

/// A part of a formula, as a closure sees it: a symbol that can be added, multiplied and given to functions.
///
/// It has no value, so that it cannot be compared: `if x[0] > 0.0` does not compile. Make the comparison a guard between
/// two modes, or write [`min`](Self::min), [`max`](Self::max) or [`abs`](Self::abs).
///
/// ```compile_fail,E0369
/// # use equations::{Formulas, Names};
/// Formulas::new(Names::new(&["x"], &[])?, |_, x, _| [if x[0] > 0.0 { x[0] } else { -x[0] }])?;
/// # Ok::<(), equations::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Expression<'g> {
    pub(crate) graph: &'g RefCell<Graph>,
    pub(crate) place: usize,
}

impl<'g> Expression<'g> {
    pub(crate) fn of(graph: &'g RefCell<Graph>, node: Node) -> Self {
        Expression { graph, place: graph.borrow_mut().place(node) }
    }

    pub(crate) fn with(self, add: impl FnOnce(&mut Graph) -> usize) -> Self {
        Expression { graph: self.graph, place: add(&mut self.graph.borrow_mut()) }
    }

    fn binary(self, function: Binary, other: impl Into<Term<'g>>) -> Self {
        let other = other.into().place(self.graph);
        self.with(|graph| graph.binary(function, self.place, other))
    }

    /// A number next to this symbol: its `f64`, exactly.
    pub fn number(self, value: f64) -> Self {
        Expression { graph: self.graph, place: Term::Number(value).place(self.graph) }
    }

    /// π, which is no `f64`.
    pub fn pi(self) -> Self {
        Self::of(self.graph, Node::Constant(Constant::Pi))
    }

    /// e, which is no `f64`.
    pub fn e(self) -> Self {
        Self::of(self.graph, Node::Constant(Constant::Euler))
    }

    /// The power with an integer exponent, by products.
    pub fn powi(self, exponent: i32) -> Self {
        self.with(|graph| graph.integer_power(self.place, exponent.into()))
    }

    /// The power x^y; its base must be above zero.
    pub fn pow(self, exponent: impl Into<Term<'g>>) -> Self {
        let exponent = exponent.into().place(self.graph);
        self.with(|graph| graph.power(self.place, exponent))
    }

    /// The angle of the point (x, y) from the positive x axis, above −π and up to π; `self` is y.
    pub fn atan2(self, x: impl Into<Term<'g>>) -> Self {
        self.binary(Binary::ArcTangent2, x)
    }

    /// The smaller one. It has no derivative where both are equal.
    pub fn min(self, other: impl Into<Term<'g>>) -> Self {
        self.binary(Binary::Minimum, other)
    }

    /// The larger one. It has no derivative where both are equal.
    pub fn max(self, other: impl Into<Term<'g>>) -> Self {
        self.binary(Binary::Maximum, other)
    }
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident $function:ident;)*) => {
        impl<'g> Expression<'g> {$(
            $(#[$doc])*
            pub fn $name(self) -> Self {
                self.with(|graph| graph.unary(Unary::$function, self.place))
            }
        )*}
    };
}
functions! {
    /// The square root; the number must be at or above zero.
    sqrt SquareRoot;
    /// The exponential.
    exp Exponential;
    /// The natural logarithm; the number must be above zero.
    ln Logarithm;
    /// The sine, of radians.
    sin Sine;
    /// The cosine, of radians.
    cos Cosine;
    /// The tangent, of radians.
    tan Tangent;
    /// The arc sine; the number must be in [−1, 1].
    asin ArcSine;
    /// The arc cosine; the number must be in [−1, 1].
    acos ArcCosine;
    /// The arc tangent.
    atan ArcTangent;
    /// The hyperbolic sine.
    sinh HyperbolicSine;
    /// The hyperbolic cosine.
    cosh HyperbolicCosine;
    /// The hyperbolic tangent.
    tanh HyperbolicTangent;
    /// The hyperbolic secant, 1/cosh: the square root of the slope of tanh, without overflow.
    sech HyperbolicSecant;
    /// The inverse hyperbolic sine.
    asinh InverseHyperbolicSine;
    /// The inverse hyperbolic cosine; the number must be at or above 1.
    acosh InverseHyperbolicCosine;
    /// The inverse hyperbolic tangent; the number must be between −1 and 1.
    atanh InverseHyperbolicTangent;
    /// The absolute value. It has no derivative at zero.
    abs Absolute;
    /// The sign, −1, 0 or 1. It has a jump at zero.
    sign Sign;
}

/// What can stand next to an operator: a symbol or a number.
#[derive(Clone, Copy)]
pub enum Term<'g> {
    /// A symbol.
    Symbol(Expression<'g>),
    /// A number: its `f64`, exactly.
    Number(f64),
}

impl<'g> Term<'g> {
    pub(crate) fn place(self, graph: &RefCell<Graph>) -> usize {
        match self {
            Term::Symbol(symbol) if std::ptr::eq(symbol.graph, graph) => symbol.place,
            Term::Symbol(_) => {
                graph.borrow_mut().refuse(Error::Foreign);
                graph.borrow_mut().number(0.0)
            }
            Term::Number(value) if value.is_finite() => graph.borrow_mut().number(value),
            Term::Number(value) => {
                graph.borrow_mut().refuse(Error::Number { value });
                graph.borrow_mut().number(0.0)
            }
        }
    }
}

impl<'g> From<Expression<'g>> for Term<'g> {
    fn from(symbol: Expression<'g>) -> Self {
        Term::Symbol(symbol)
    }
}

impl From<f64> for Term<'_> {
    fn from(value: f64) -> Self {
        Term::Number(value)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $function:ident;)*) => {$(
        impl<'g, T: Into<Term<'g>>> $operator<T> for Expression<'g> {
            type Output = Self;
            fn $method(self, other: T) -> Self {
                self.binary(Binary::$function, other)
            }
        }
        impl<'g> $operator<Expression<'g>> for f64 {
            type Output = Expression<'g>;
            fn $method(self, other: Expression<'g>) -> Expression<'g> {
                other.number(self).binary(Binary::$function, other)
            }
        }
    )*};
}
operators! {
    Add add Sum;
    Sub sub Difference;
    Mul mul Product;
    Div div Quotient;
}

impl Neg for Expression<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.with(|graph| graph.unary(Unary::Negative, self.place))
    }
}

/// The components of the state, `x[0]`: a slice. A component or a range that it does not have makes the formulas an error.
pub struct States<'g> {
    pub(crate) symbols: Vec<Expression<'g>>,
    pub(crate) zero: Expression<'g>,
}

impl States<'_> {
    fn refuse(&self, needed: usize) {
        let (what, given) = ("components of the state", self.symbols.len());
        self.zero.graph.borrow_mut().refuse(Error::Length { what, needed, given });
    }
}

/// The number of components that a range needs.
fn needed(range: &impl RangeBounds<usize>) -> usize {
    let of = |end| match end {
        Bound::Included(last) => usize::saturating_add(last, 1),
        Bound::Excluded(length) => length,
        Bound::Unbounded => 0,
    };
    of(range.start_bound().cloned()).max(of(range.end_bound().cloned()))
}

impl<'g> Deref for States<'g> {
    type Target = [Expression<'g>];
    fn deref(&self) -> &[Expression<'g>] {
        &self.symbols
    }
}

impl<'g> Index<usize> for States<'g> {
    type Output = Expression<'g>;
    fn index(&self, component: usize) -> &Expression<'g> {
        self.symbols.get(component).unwrap_or_else(|| {
            self.refuse(component.saturating_add(1));
            &self.zero
        })
    }
}

// Parts of the state, by each kind of range between brackets.
macro_rules! index_by {
    ($($range:ty),*) => {$(
        impl<'g> Index<$range> for States<'g> {
            type Output = [Expression<'g>];
            fn index(&self, components: $range) -> &[Expression<'g>] {
                let needed = needed(&components);
                self.symbols.get(components).unwrap_or_else(|| {
                    self.refuse(needed);
                    &[]
                })
            }
        }
    )*};
}

index_by!(
    Range<usize>,
    RangeFrom<usize>,
    RangeTo<usize>,
    RangeInclusive<usize>,
    RangeToInclusive<usize>
);

/// The parameters by their names, `p["damping"]`. A name that is none makes the formulas an error.
///
/// They are looked up by text, and are no fields of a struct that a macro makes: the names may come from a file, a text or
/// another language, and one that is wrong is an error value with the name in it.
pub struct Parameters<'g> {
    pub(crate) names: &'g [String],
    pub(crate) symbols: Vec<Expression<'g>>,
    pub(crate) zero: Expression<'g>,
}

impl<'g> Parameters<'g> {
    /// A number, for formulas without a symbol: its `f64`, exactly.
    pub fn number(&self, value: f64) -> Expression<'g> {
        self.zero.number(value)
    }

    /// The sum of symbols, such as of forces over bodies; 0 of no symbols.
    pub fn sum(&self, terms: impl IntoIterator<Item = Expression<'g>>) -> Expression<'g> {
        terms.into_iter().reduce(|sum, term| sum + term).unwrap_or(self.zero)
    }

    /// Σ aₖ bₖ of two vectors, the first one of numbers or of symbols. Vectors of different lengths make the formulas an
    /// error.
    pub fn dot<T: Into<Term<'g>> + Copy>(&self, a: &[T], b: &[Expression<'g>]) -> Expression<'g> {
        if a.len() != b.len() {
            let (what, needed, given) = ("components of a vector", a.len(), b.len());
            self.zero.graph.borrow_mut().refuse(Error::Length { what, needed, given });
        }
        self.sum(a.iter().zip(b).map(|(a, b)| *b * *a))
    }

    /// The product of a matrix, by its rows, and a vector.
    pub fn product<T: Into<Term<'g>> + Copy, const M: usize, const N: usize>(
        &self,
        matrix: &[[T; N]; M],
        vector: &[Expression<'g>],
    ) -> [Expression<'g>; M] {
        std::array::from_fn(|row| self.dot(&matrix[row], vector))
    }
}

impl<'g> Index<&str> for Parameters<'g> {
    type Output = Expression<'g>;
    fn index(&self, name: &str) -> &Expression<'g> {
        match self.names.iter().position(|known| known == name) {
            Some(at) => &self.symbols[at],
            None => {
                let reason = "no parameter of these formulas";
                let error = Error::Name { name: name.to_owned(), reason };
                self.zero.graph.borrow_mut().refuse(error);
                &self.zero
            }
        }
    }
}
