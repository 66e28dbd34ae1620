//! The parts of which formulas consist.

use crate::constant::Constant;
use crate::function::Function;

/// A part of a formula. Numbers of other parts are places in the list of all parts; they are always earlier ones.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    /// The time.
    Time,
    /// A component of the state.
    State(usize),
    /// A parameter.
    Parameter(usize),
    /// A number.
    Constant(Constant),
    /// A function of one part.
    Unary(Unary, usize),
    /// A function of two parts.
    Binary(Binary, usize, usize),
    /// A user's function of one part.
    Call(Function, usize),
}

/// Functions of one number. Angles are in radians.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Unary {
    Negative,
    SquareRoot,
    Exponential,
    Logarithm,
    Sine,
    Cosine,
    Tangent,
    ArcSine,
    ArcCosine,
    ArcTangent,
    HyperbolicSine,
    HyperbolicCosine,
    HyperbolicTangent,
    HyperbolicSecant,
    InverseHyperbolicSine,
    InverseHyperbolicCosine,
    InverseHyperbolicTangent,
    Absolute,
    Sign,
}

/// Functions of two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Binary {
    Sum,
    Difference,
    Product,
    Quotient,
    Power,
    /// The angle of the point (x, y), of y and x.
    ArcTangent2,
    Minimum,
    Maximum,
}

/// Each function of one number, with its name in text and in files.
pub(crate) const UNARY: [(&str, Unary); 18] = [
    ("sqrt", Unary::SquareRoot),
    ("exp", Unary::Exponential),
    ("ln", Unary::Logarithm),
    ("sin", Unary::Sine),
    ("cos", Unary::Cosine),
    ("tan", Unary::Tangent),
    ("asin", Unary::ArcSine),
    ("acos", Unary::ArcCosine),
    ("atan", Unary::ArcTangent),
    ("sinh", Unary::HyperbolicSine),
    ("cosh", Unary::HyperbolicCosine),
    ("tanh", Unary::HyperbolicTangent),
    ("sech", Unary::HyperbolicSecant),
    ("asinh", Unary::InverseHyperbolicSine),
    ("acosh", Unary::InverseHyperbolicCosine),
    ("atanh", Unary::InverseHyperbolicTangent),
    ("abs", Unary::Absolute),
    ("sign", Unary::Sign),
];

/// Each function of two numbers that is written like one.
pub(crate) const BINARY: [(&str, Binary); 3] =
    [("atan2", Binary::ArcTangent2), ("min", Binary::Minimum), ("max", Binary::Maximum)];

/// The name of a function in a table.
pub(crate) fn name_in<F: PartialEq>(
    table: &[(&'static str, F)],
    function: &F,
) -> Option<&'static str> {
    table.iter().find(|(_, known)| known == function).map(|(name, _)| *name)
}

/// The function with a name in a table.
pub(crate) fn named<F: Copy>(table: &[(&'static str, F)], name: &str) -> Option<F> {
    table.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

/// How often each part is used: by the wanted ones, once each, and by the parts that these need.
pub(crate) fn uses(nodes: &[Node], wanted: &[usize]) -> Vec<usize> {
    let mut uses = vec![0; nodes.len()];
    wanted.iter().for_each(|&place| uses[place] += 1);
    for (at, node) in nodes.iter().enumerate().rev() {
        if uses[at] > 0 {
            node.operands().for_each(|operand| uses[operand] += 1);
        }
    }
    uses
}

impl Node {
    /// The parts of which this one is a function.
    pub fn operands(&self) -> impl Iterator<Item = usize> {
        let (first, second) = match *self {
            Node::Unary(_, a) | Node::Call(_, a) => (Some(a), None),
            Node::Binary(_, a, b) => (Some(a), Some(b)),
            _ => (None, None),
        };
        first.into_iter().chain(second)
    }

    /// The part in another list, where the parts of this one have these places.
    pub(crate) fn moved(&self, places: &[usize]) -> Node {
        match self {
            Node::Unary(function, a) => Node::Unary(*function, places[*a]),
            Node::Binary(function, a, b) => Node::Binary(*function, places[*a], places[*b]),
            Node::Call(function, a) => Node::Call(function.clone(), places[*a]),
            node => node.clone(),
        }
    }
}
