//! The parts of which formulas consist.

use crate::constant::Constant;

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

impl Node {
    /// The parts of which this one is a function.
    pub fn operands(&self) -> impl Iterator<Item = usize> {
        let (first, second) = match *self {
            Node::Unary(_, a) => (Some(a), None),
            Node::Binary(_, a, b) => (Some(a), Some(b)),
            _ => (None, None),
        };
        first.into_iter().chain(second)
    }

    /// True for a function that has no Taylor series at some arguments, because it has a kink or a jump there.
    pub fn has_kink(&self) -> bool {
        matches!(
            self,
            Node::Unary(Unary::Absolute | Unary::Sign, _)
                | Node::Binary(Binary::Minimum | Binary::Maximum, ..)
        )
    }
}
