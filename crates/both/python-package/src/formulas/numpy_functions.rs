//! NumPy's functions as those of formulas.

use super::symbol::Symbol;
use equations::{Binary, Unary};
use pyo3::prelude::*;

/// What a function does that asks where it is.
pub(super) const GUARD: &str =
    "a comparison is a guard between two modes, or numpy.minimum, maximum, abs";

/// A function of one number by the name that NumPy's function has.
const UNARY: [(&str, Unary); 19] = [
    ("negative", Unary::Negative),
    ("sqrt", Unary::SquareRoot),
    ("exp", Unary::Exponential),
    ("log", Unary::Logarithm),
    ("sin", Unary::Sine),
    ("cos", Unary::Cosine),
    ("tan", Unary::Tangent),
    ("arcsin", Unary::ArcSine),
    ("arccos", Unary::ArcCosine),
    ("arctan", Unary::ArcTangent),
    ("sinh", Unary::HyperbolicSine),
    ("cosh", Unary::HyperbolicCosine),
    ("tanh", Unary::HyperbolicTangent),
    ("arcsinh", Unary::InverseHyperbolicSine),
    ("arccosh", Unary::InverseHyperbolicCosine),
    ("arctanh", Unary::InverseHyperbolicTangent),
    ("absolute", Unary::Absolute),
    ("fabs", Unary::Absolute),
    ("sign", Unary::Sign),
];

/// The same of two numbers.
const BINARY: [(&str, Binary); 12] = [
    ("add", Binary::Sum),
    ("subtract", Binary::Difference),
    ("multiply", Binary::Product),
    ("divide", Binary::Quotient),
    ("true_divide", Binary::Quotient),
    ("power", Binary::Power),
    ("float_power", Binary::Power),
    ("arctan2", Binary::ArcTangent2),
    ("minimum", Binary::Minimum),
    ("maximum", Binary::Maximum),
    ("fmin", Binary::Minimum),
    ("fmax", Binary::Maximum),
];

/// Functions that ask whether something is true.
const COMPARISONS: [&str; 9] = [
    "greater",
    "greater_equal",
    "less",
    "less_equal",
    "equal",
    "not_equal",
    "heaviside",
    "floor",
    "ceil",
];

/// Functions that are made of others.
const NAMES_OF_ONE: [&str; 13] = [
    "positive",
    "conjugate",
    "square",
    "reciprocal",
    "deg2rad",
    "radians",
    "rad2deg",
    "degrees",
    "exp2",
    "log2",
    "log10",
    "expm1",
    "hypot",
];

/// Whether formulas have a function of NumPy with this name.
pub(super) fn is_function(name: &str) -> bool {
    UNARY.iter().any(|(known, _)| *known == name)
        || BINARY.iter().any(|(known, _)| *known == name)
        || NAMES_OF_ONE.contains(&name)
}

impl Symbol {
    /// A function of NumPy of one symbol, by its name.
    pub(super) fn function(&self, name: &str) -> PyResult<Option<Symbol>> {
        if let Some((_, function)) = UNARY.iter().find(|(known, _)| *known == name) {
            return self.unary(*function).map(Some);
        }
        let scaled = |factor: f64| self.binary(Binary::Product, &self.number(factor)?);
        let half = || self.binary(Binary::Quotient, &self.number(2.0)?);
        Ok(Some(match name {
            "positive" | "conjugate" | "real" => self.clone(),
            "square" => self.binary(Binary::Product, self)?,
            "reciprocal" => self.number(1.0)?.binary(Binary::Quotient, self)?,
            "deg2rad" | "radians" => scaled(std::f64::consts::PI / 180.0)?,
            "rad2deg" | "degrees" => scaled(180.0 / std::f64::consts::PI)?,
            "exp2" => scaled(std::f64::consts::LN_2)?.unary(Unary::Exponential)?,
            "log2" => {
                let logarithm = self.unary(Unary::Logarithm)?;
                logarithm.binary(Binary::Quotient, &self.number(std::f64::consts::LN_2)?)?
            }
            "log10" => {
                let logarithm = self.unary(Unary::Logarithm)?;
                logarithm.binary(Binary::Quotient, &self.number(std::f64::consts::LN_10)?)?
            }
            // eˣ − 1 = 2 sinh(x/2) e^(x/2), which loses no digits near 0.
            "expm1" => {
                let (sine, power) =
                    (half()?.unary(Unary::HyperbolicSine)?, half()?.unary(Unary::Exponential)?);
                self.number(2.0)?.binary(Binary::Product, &sine.binary(Binary::Product, &power)?)?
            }
            _ => return Ok(None),
        }))
    }

    /// A function of NumPy of two, of which one is this symbol.
    pub(super) fn function_of_two(
        name: &str,
        left: &Symbol,
        right: &Symbol,
    ) -> PyResult<Option<Symbol>> {
        if name == "hypot" {
            let square = left.binary(Binary::Product, left)?;
            let sum = square.binary(Binary::Sum, &right.binary(Binary::Product, right)?)?;
            return sum.unary(Unary::SquareRoot).map(Some);
        }
        let known = BINARY.iter().find(|(known, _)| *known == name);
        known.map(|(_, function)| left.binary(*function, right)).transpose()
    }
}

/// What is said of a function that formulas do not have.
pub(super) fn no_function(name: &str) -> String {
    match COMPARISONS.contains(&name) {
        true => format!("numpy.{name} asks where a symbol is: {GUARD}"),
        false if name == "log1p" => {
            "formulas have no numpy.log1p: write numpy.log(1 + x)".to_owned()
        }
        false => format!("formulas have no numpy.{name}"),
    }
}
