//! Symbols that a function of Python computes with.

use super::numpy_functions::{GUARD, is_function, no_function};
use crate::errors::{InputError, TracingError};
use equations::{Binary, Node, Unary};
use numpy::PyUntypedArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use std::sync::{Arc, Mutex, PoisonError};

/// The parts of the formulas of some functions, which their symbols share.
pub(crate) type Parts = Arc<Mutex<Recorded>>;

/// What functions have done with symbols.
#[derive(Debug, Default)]
pub(crate) struct Recorded {
    pub(super) nodes: Vec<Node>,
    /// Why there are no formulas: a function may catch the exception of what it has asked for, and go another way.
    pub(super) refused: Option<String>,
}

/// The most parts: a function that makes more would fill the memory.
const MOST_PARTS: usize = 1_000_000;

/// A part of a formula: what a function of a System sees instead of a number, in the one call that makes formulas of it.
///
/// It can be added, multiplied and given to NumPy's functions. It has no value: a function that asks for one is called as it is,
/// without formulas.
#[pyclass(frozen, module = "nonsmooth._native")]
#[derive(Debug, Clone)]
pub(crate) struct Symbol {
    pub(super) parts: Parts,
    pub(super) place: usize,
}

impl Symbol {
    /// The exception of something that formulas cannot do, which is remembered.
    fn refused(&self, text: String) -> PyErr {
        let mut recorded = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        recorded.refused.get_or_insert_with(|| text.clone());
        TracingError::new_err(text)
    }

    fn no_value(&self, asked: &str) -> PyErr {
        self.refused(format!("{asked} asks for the value of a symbol"))
    }

    /// A new part, and its symbol.
    pub(super) fn of(parts: &Parts, node: Node) -> PyResult<Symbol> {
        let mut list = parts.lock().unwrap_or_else(PoisonError::into_inner);
        if list.nodes.len() >= MOST_PARTS {
            let text = format!("the function has more than {MOST_PARTS} parts");
            return Err(TracingError::new_err(text));
        }
        list.nodes.push(node);
        Ok(Symbol { parts: Arc::clone(parts), place: list.nodes.len() - 1 })
    }

    pub(super) fn unary(&self, function: Unary) -> PyResult<Symbol> {
        Symbol::of(&self.parts, Node::Unary(function, self.place))
    }

    pub(super) fn binary(&self, function: Binary, other: &Symbol) -> PyResult<Symbol> {
        Symbol::of(&self.parts, Node::Binary(function, self.place, other.place))
    }

    pub(super) fn number(&self, value: f64) -> PyResult<Symbol> {
        if !value.is_finite() {
            let text = format!("{value} is no number of a formula: it must be finite");
            return Err(InputError::new_err(text));
        }
        Symbol::of(&self.parts, Node::Constant(value.into()))
    }

    /// The symbol, or the number as one; `None` for anything else.
    pub(super) fn operand(&self, other: &Bound<'_, PyAny>) -> PyResult<Option<Symbol>> {
        if let Ok(symbol) = other.cast::<Symbol>() {
            let symbol = symbol.get();
            if Arc::ptr_eq(&symbol.parts, &self.parts) {
                return Ok(Some(symbol.clone()));
            }
            let text =
                "a symbol of another call is used in this one: a function keeps it somewhere";
            return Err(TracingError::new_err(text));
        }
        // An array of one number could be taken for a number, and a text for none.
        if other.is_instance_of::<PyUntypedArray>() || !other.hasattr("__float__")? {
            return Ok(None);
        }
        other.extract::<f64>().ok().map(|value| self.number(value)).transpose()
    }

    /// An operator with this symbol on the left, or on the right.
    fn operator(
        &self,
        other: &Bound<'_, PyAny>,
        function: Binary,
        is_left: bool,
    ) -> PyResult<Py<PyAny>> {
        let py = other.py();
        let Some(other) = self.operand(other)? else { return Ok(py.NotImplemented()) };
        let (left, right) = if is_left { (self, &other) } else { (&other, self) };
        Ok(Py::new(py, left.binary(function, right)?)?.into_any())
    }
}

/// What NumPy adds to the name of a function of each element.
const VECTORIZED: &str = " (vectorized)";

#[pymethods]
impl Symbol {
    fn __add__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Sum, true)
    }

    fn __radd__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Sum, false)
    }

    fn __sub__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Difference, true)
    }

    fn __rsub__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Difference, false)
    }

    fn __mul__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Product, true)
    }

    fn __rmul__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Product, false)
    }

    fn __truediv__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Quotient, true)
    }

    fn __rtruediv__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Quotient, false)
    }

    fn __pow__(
        &self,
        other: &Bound<'_, PyAny>,
        modulo: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        match modulo {
            Some(_) => Err(TracingError::new_err("formulas have no powers with a remainder")),
            None => self.operator(other, Binary::Power, true),
        }
    }

    fn __rpow__(
        &self,
        other: &Bound<'_, PyAny>,
        _modulo: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        self.operator(other, Binary::Power, false)
    }

    fn __neg__(&self) -> PyResult<Symbol> {
        self.unary(Unary::Negative)
    }

    fn __pos__(&self) -> Symbol {
        self.clone()
    }

    fn __abs__(&self) -> PyResult<Symbol> {
        self.unary(Unary::Absolute)
    }

    /// NumPy's functions of arrays of symbols call methods of these names.
    fn __getattr__(own: &Bound<'_, Self>, name: &str) -> PyResult<Py<PyAny>> {
        let py = own.py();
        if !is_function(name) {
            let text = format!("a symbol of a formula has no attribute {name:?}");
            return Err(pyo3::exceptions::PyAttributeError::new_err(text));
        }
        let function = py.import("numpy")?.getattr(name)?;
        let bound = py.import("functools")?.getattr("partial")?.call1((function, own))?;
        Ok(bound.unbind())
    }

    /// A function of NumPy with symbols among its arguments.
    #[pyo3(signature = (ufunc, method, *inputs, **keywords))]
    fn __array_ufunc__(
        &self,
        ufunc: &Bound<'_, PyAny>,
        method: &str,
        inputs: &Bound<'_, PyTuple>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Py<PyAny>> {
        let py = ufunc.py();
        let name: String = ufunc.getattr("__name__")?.extract()?;
        if method != "__call__" || keywords.is_some_and(|keywords| !keywords.is_empty()) {
            let text = format!("numpy.{name} with a symbol takes no {method} and no keywords");
            return Err(TracingError::new_err(text));
        }
        let is_list = |input: &Bound<'_, PyAny>| {
            input.is_instance_of::<PyList>() || input.is_instance_of::<PyTuple>()
        };
        if inputs.iter().any(|input| input.is_instance_of::<PyUntypedArray>() || is_list(&input)) {
            let numpy = py.import("numpy")?;
            // Such a function of NumPy is made here, and is called anew with arrays alone.
            let each = match name.ends_with(VECTORIZED) {
                true => ufunc.clone(),
                false => numpy.call_method1("frompyfunc", (ufunc, inputs.len(), 1))?,
            };
            let whole = |input: Bound<'_, PyAny>| {
                let array = numpy.call_method1("empty", ((), "object"))?;
                array.set_item((), input)?;
                Ok::<_, PyErr>(array)
            };
            let arrays = inputs.iter().map(|input| match input.cast::<Symbol>() {
                Ok(_) => whole(input),
                Err(_) if is_list(&input) => numpy.call_method1("array", (input, "object")),
                Err(_) => Ok(input),
            });
            let arrays = PyTuple::new(py, arrays.collect::<PyResult<Vec<_>>>()?)?;
            return Ok(each.call1(arrays)?.unbind());
        }
        let operands = inputs.iter().map(|input| self.operand(&input));
        let Some(operands) = operands.collect::<PyResult<Option<Vec<_>>>>()? else {
            return Ok(py.NotImplemented());
        };
        let found = match operands.as_slice() {
            [one] => one.function(&name)?,
            [left, right] => Symbol::function_of_two(&name, left, right)?,
            _ => None,
        };
        let found = found.ok_or_else(|| self.refused(no_function(&name)))?;
        Ok(Py::new(py, found)?.into_any())
    }

    fn __richcmp__(
        &self,
        _other: &Bound<'_, PyAny>,
        _how: pyo3::pyclass::CompareOp,
    ) -> PyResult<bool> {
        Err(self.refused(format!("a symbol is compared: {GUARD}")))
    }

    fn __hash__(&self) -> usize {
        self.place
    }

    fn __bool__(&self) -> PyResult<bool> {
        Err(self.no_value("a condition"))
    }

    fn __float__(&self) -> PyResult<f64> {
        Err(self.no_value("float(), a function of the module math, or an array of numbers"))
    }

    fn __int__(&self) -> PyResult<i64> {
        Err(self.no_value("int()"))
    }

    fn __index__(&self) -> PyResult<i64> {
        Err(self.no_value("an index"))
    }

    fn __complex__(&self) -> PyResult<f64> {
        Err(self.no_value("complex()"))
    }

    fn __mod__(&self, _other: &Bound<'_, PyAny>) -> PyResult<Symbol> {
        Err(self
            .refused("formulas have no %: a value that wraps is a guard with a reset".to_owned()))
    }

    fn __floordiv__(&self, _other: &Bound<'_, PyAny>) -> PyResult<Symbol> {
        Err(self.refused("formulas have no //: a step is a guard between two modes".to_owned()))
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(TracingError::new_err("a symbol of a formula belongs to one call, and is not copied"))
    }

    fn __repr__(&self) -> String {
        format!("Symbol({})", self.place)
    }
}
