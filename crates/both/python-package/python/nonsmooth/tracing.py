"""Functions of Python, texts and SymPy's expressions as formulas."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ._native import Formulas, Trace
from .errors import InputError, TracingError

#: Sizes of states at which a function and its formulas are compared, at its own and at other values of the parameters. A function that is no
#: function of its arguments, such as one that keeps something from call to call, differs at the first ones; one that asks for types, where they matter.
_COMPARED = (2.0,) * 8 + (0.01,) * 2 + (10.0,) * 8 + (1000.0,) * 8

#: How far both may be apart there, beside 1: some rounding, and the sums of NumPy in another order.
_APART = 1e-9


def name_list(names: Sequence[str] | str) -> list[str]:
    """A list of names, of a list or of a text with spaces or commas between them."""
    return names.replace(",", " ").split() if isinstance(names, str) else list(names)


class Parameters:
    """The parameters of a system, as its functions see them: by name, ``p.damping`` or ``p["damping"]``, or in order."""

    __slots__ = ("_names", "_values")

    def __init__(self, names: Sequence[str], values: Sequence[Any]) -> None:
        self._names = tuple(names)
        self._values = tuple(values)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __getitem__(self, key: str | int) -> Any:
        if not isinstance(key, str):
            return self._values[key]
        try:
            return self._values[self._names.index(key)]
        except ValueError:
            known = ", ".join(self._names) or "none"
            raise AttributeError(f"there is no parameter {key!r}; the parameters are: {known}") from None

    def __iter__(self) -> Any:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value!r}" for name, value in zip(self._names, self._values))
        return f"Parameters({shown})"


class _Symbols(np.ndarray[Any, Any]):
    """An array of symbols, whose functions are those of each symbol."""

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        plain = [part.view(np.ndarray) if isinstance(part, _Symbols) else part for part in inputs]
        (out,) = keywords.pop("out", (None,))
        if method != "__call__" or ufunc.signature is not None or keywords or ufunc.nout != 1:
            found = getattr(ufunc, method)(*plain, **keywords)
        else:
            found = np.frompyfunc(ufunc, ufunc.nin, 1)(*plain)
        if out is not None:
            # In place, as in x += 1.
            out.view(np.ndarray)[...] = found
            return out
        return found.view(_Symbols) if isinstance(found, np.ndarray) else found


def symbols(parts: Sequence[Any]) -> Any:
    """An array of these symbols."""
    array = np.empty(len(parts), dtype=object)
    for at, part in enumerate(parts):
        array[at] = part
    return array.view(_Symbols)


class Model:
    """The names of a model, and the values of its parameters."""

    def __init__(self, states: Sequence[str], parameters: Mapping[str, float]) -> None:
        self.states = list(states)
        self.parameters = {name: float(value) for name, value in parameters.items()}
        self.trace = Trace(self.states, [(name, repr(value)) for name, value in self.parameters.items()])

    def values(self) -> Parameters:
        """The parameters with their values."""
        return Parameters(list(self.parameters), list(self.parameters.values()))

    def formulas(self, what: str, given: Any) -> Formulas:
        """The formulas of a function f(t, x, p), of texts, or of SymPy's expressions.

        Raises :class:`TracingError` for a function that has none, and says why.
        """
        if isinstance(given, str):
            given = [given]
        if not callable(given):
            given = list(given)
            if all(isinstance(text, str) for text in given):
                return self.trace.of_text(given)
            given = self._of_sympy(given)
        try:
            symbolic = Parameters(list(self.parameters), self.trace.parameters())
            found = self.trace.formulas(_flat(given(self.trace.time(), symbols(self.trace.state()), symbolic)))
        except TracingError as error:
            raise TracingError(f"{what}: {error}") from error
        except Exception as error:
            # Whatever a function does with symbols: with numbers it may do well. If it does not, that is the error.
            try:
                given(*self._probe(np.random.default_rng(0)), self.values())
            except type(error):
                raise
            except Exception:
                pass
            raise TracingError(f"{what}, called with symbols, raised {type(error).__name__}: {error}") from error
        self._compare(what, given, found)
        return found

    def _of_sympy(self, expressions: list[Any]) -> Callable[..., Any]:
        try:
            import sympy
        except ImportError:
            kinds = sorted({type(part).__name__ for part in expressions})
            raise TypeError(f"a function, texts or SymPy's expressions are needed, not a list of {kinds}") from None
        names = ["t", *self.states, *self.parameters]
        expressions = [sympy.sympify(part) for part in expressions]
        unknown = set().union(*(part.free_symbols for part in expressions))
        unknown = {str(symbol) for symbol in unknown} - set(names)
        if unknown:
            raise InputError(f"the expressions have symbols without a meaning: {sorted(unknown)}; known are {names}")
        # A symbol may have been made with assumptions, such as positive: its name counts.
        plain = {symbol: sympy.Symbol(str(symbol)) for part in expressions for symbol in part.free_symbols}
        called = sympy.lambdify(
            [sympy.Symbol(name) for name in names], [part.subs(plain) for part in expressions], modules="numpy"
        )
        return lambda t, x, p: called(t, *x, *p)

    def _probe(self, random: np.random.Generator) -> tuple[float, Any]:
        """A time and a state."""
        return random.uniform(0.0, 2.0), random.uniform(-2.0, 2.0, len(self.states))

    def _compare(self, what: str, function: Callable[..., Any], formulas: Formulas) -> None:
        random = np.random.default_rng(1)
        for number, size in enumerate(_COMPARED):
            t, x = self._probe(random)
            x *= size / 2.0
            values = list(self.parameters.values())
            if number % 2 == 1:
                values = [value * factor for value, factor in zip(values, random.uniform(0.5, 1.5, len(values)))]
            try:
                with np.errstate(all="ignore"):
                    found = _flat(function(t, x.copy(), Parameters(list(self.parameters), values)))
                    plain = np.array([float(part) for part in found])
            except (ArithmeticError, ValueError):
                continue
            if not np.isfinite(plain).all():
                continue
            try:
                traced = formulas.values(t, x, list(zip(self.parameters, values)))
            except ArithmeticError as error:
                raise TracingError(f"{what} has a value where its formulas have none: {error}") from error
            apart = np.abs(plain - traced) / np.maximum(1.0, np.abs(traced))
            if np.any(apart > _APART):
                raise TracingError(
                    f"{what} gives {plain.tolist()} at t = {t!r}, x = {x.tolist()}, and its formulas {traced.tolist()}: it"
                    " is no function of its arguments alone"
                )


def _flat(found: Any) -> list[Any]:
    """What a function returns as a list of numbers or symbols."""
    if isinstance(found, np.ndarray):
        return list(found.ravel())
    if isinstance(found, (list, tuple)):
        return [part.item() if isinstance(part, np.ndarray) and part.ndim == 0 else part for part in found]
    return [found]
