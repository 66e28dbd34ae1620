//! The names in formulas.

use crate::constant::{Constant, Decimal};
use crate::error::Error;
use crate::formulas::length;
use crate::function::Function;
use std::collections::HashSet;

/// The names of formulas, and the values of parameters.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// The components of the state.
    pub states: Vec<String>,
    /// The parameters.
    pub parameters: Vec<String>,
    /// The values of the parameters.
    pub values: Vec<Constant>,
    /// The functions that texts and files may call besides those that all formulas have, and all that are called.
    pub functions: Vec<Function>,
}

/// The functions do not count: formulas have those that they call.
impl PartialEq for Names {
    fn eq(&self, other: &Names) -> bool {
        self.states == other.states
            && self.parameters == other.parameters
            && self.values == other.values
    }
}

impl Eq for Names {}

pub(crate) const NO_VALUE: &str =
    "a parameter without a value: give a decimal, such as -0.25 or 1e-3";

/// Names that have a meaning of their own.
pub(crate) const RESERVED: [&str; 4] = ["t", "pi", "π", "e"];

impl Names {
    /// Names of the components of a state, and of parameters with their values: decimals as text.
    ///
    /// # Errors
    /// [`Error::Name`] for a name that is used twice, that is no name, or that has a meaning, and for a value that is no
    /// decimal.
    pub fn new(states: &[&str], parameters: &[(&str, &str)]) -> Result<Names, Error> {
        let values = parameters.iter().map(|(name, value)| {
            let known = Decimal::new(value).map(Constant::Decimal);
            known.ok_or(Error::Name { name: (*name).to_owned(), reason: NO_VALUE })
        });
        let names = Names {
            states: states.iter().map(|name| (*name).to_owned()).collect(),
            parameters: parameters.iter().map(|(name, _)| (*name).to_owned()).collect(),
            values: values.collect::<Result<_, Error>>()?,
            functions: Vec::new(),
        };
        names.check()?;
        Ok(names)
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        length("values of parameters", self.parameters.len(), self.values.len())?;
        let mut known = HashSet::new();
        for name in self.all() {
            check_name(name)?;
            if !known.insert(name) {
                return Err(Error::Name { name: name.to_owned(), reason: "used twice" });
            }
        }
        Ok(())
    }

    /// All names: of components, parameters and functions.
    pub(crate) fn all(&self) -> impl Iterator<Item = &str> {
        let names = self.states.iter().chain(&self.parameters).map(String::as_str);
        names.chain(self.functions.iter().map(Function::name))
    }

    /// The same names, and functions that texts and files may call.
    ///
    /// # Errors
    /// [`Error::Name`] for a function with the name of a variable, a parameter or another function.
    pub fn with_functions(self, functions: &[Function]) -> Result<Names, Error> {
        self.with_called(functions.iter())
    }

    /// The same names and these functions. A text or a file knows a function by its name, so that no name has two meanings.
    pub(crate) fn with_called<'f>(
        mut self,
        called: impl Iterator<Item = &'f Function>,
    ) -> Result<Names, Error> {
        let known = self.functions.len();
        for function in called {
            function.note_in(&mut self.functions)?;
        }
        if self.functions.len() > known {
            self.check()?;
        }
        Ok(self)
    }
}

/// An error for a name that has a meaning in formulas, or is none.
pub(crate) fn check_name(name: &str) -> Result<(), Error> {
    let refused = |reason| Err(Error::Name { name: name.to_owned(), reason });
    if RESERVED.contains(&name) || crate::text::is_function(name) {
        return refused("taken: it has a meaning in formulas");
    }
    if !crate::text::is_name(name) {
        return refused("no name: a letter first, then letters, digits and _");
    }
    Ok(())
}
