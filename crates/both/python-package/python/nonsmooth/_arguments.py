"""Arguments of users: numbers, counts and threads, or an exception with the name and the number."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: Counts of the native module are below it.
_LARGEST = 2**63


def numbers(given: ArrayLike) -> Any:
    """An array of floats. Masked numbers would pass as numbers: they are refused."""
    if np.ma.is_masked(given):
        raise TypeError("the array has masked numbers: give those that count, as by array.compressed()")
    return np.array(given, dtype=float)


def state_of(given: ArrayLike) -> list[float]:
    """A state as a list."""
    return [float(number) for number in np.atleast_1d(numbers(given))]


def whole(name: str, value: Any, least: int = 0) -> int:
    """A count."""
    try:
        found = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}= is a whole number, not {value!r}") from None
    if not least <= found < _LARGEST:
        raise InputError(f"{name}= is a whole number from {least} on, not {value!r}")
    return found


def wholes(**counts: Any) -> Mapping[str, int]:
    """Counts by their names."""
    return {name: whole(name, value) for name, value in counts.items()}


def threads_of(threads: int | None) -> int | None:
    """A number of threads; None for all processors."""
    return None if threads is None else whole("threads", threads, 1)
