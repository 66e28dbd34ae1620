"""Periodic orbits that exist for certain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import _native
from ._arguments import whole
from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .systems import System


@dataclass(frozen=True)
class Multiplier:
    """A disc of the complex plane that holds one multiplier, or more of them where discs meet."""

    centre: complex
    radius: float


@dataclass(frozen=True)
class ProvedEvent:
    """An event of all states of the box."""

    surface: str
    #: The times since the start that it may have: the lower and the upper end.
    time: tuple[float, float]
    #: The states after it: a row of two ends for each component.
    after: NDArray[np.float64]


@dataclass(frozen=True)
class ProvedOrbit:
    """A periodic orbit that exists. Boxes have a row of two ends for each variable."""

    #: The names of the variables.
    variables: list[str]
    #: A box that holds the fixed point of the return map.
    point: NDArray[np.float64]
    #: A wider box in which it is the only one.
    unique_in: NDArray[np.float64]
    multipliers: list[Multiplier]
    #: Whether all multipliers are inside the unit circle for certain.
    attracting: bool
    #: Whether some are inside and all others outside, for certain.
    saddle: bool
    #: The events of a period.
    events: list[ProvedEvent]


def proved_orbit(
    system: System,
    surface: str,
    *,
    guess: Mapping[str, float],
    start: Sequence[str],
    read: Sequence[str] | None = None,
    mode: str | None = None,
    count: int = 1,
    intervals: Mapping[str, tuple[float, float]] | None = None,
) -> ProvedOrbit:
    """Proves that the return map to a surface has exactly one fixed point near a guess, or raises :class:`UndecidedError` with the reason.

    The variables of the map are the names of ``guess``. ``start`` has a formula of them for each component of the state, and one for the time, the last component,
    if the model uses it. ``read`` are formulas of the state after the event number ``count`` of the surface, one for each variable; without it, the variables
    are names of the state. ``intervals`` are parameters with two ends: the result holds for each value of them.

    Parameters are the decimals that Python prints: 0.2 is 1/5. Numbers inside of a function are their doubles, exactly.

    >>> import nonsmooth as ns
    >>> section = ns.Guard("section", "x", "rising")
    >>> rossler = ns.System(
    ...     ["-y - z", "x + a*y", "b + z*(x - c)"],
    ...     states="x y z",
    ...     parameters={"a": 0.2, "b": 0.2, "c": 5.7},
    ...     guards=[section],
    ... )
    >>> orbit = ns.proved_orbit(rossler, "section", guess={"y": -8.4, "z": 0.03}, start=["0", "y", "z"])
    >>> orbit.saddle, bool(orbit.point[0, 0] < -8.380941742829 < orbit.point[0, 1] + 1e-11)
    (True, True)
    """
    variables = list(guess)
    own = dict(intervals or {})
    system._check_parameters(own)
    for name, (low, high) in own.items():
        if not low <= high:
            raise InputError(f"the interval of {name} is [{low}, {high}]: the first end is the lower one")
    question = {
        "mode": system._first_mode(mode),
        "surface": surface,
        "variables": variables + list(own),
        "guess": [float(guess[name]) for name in variables],
        "states": list(start) + list(own),
        "read": variables if read is None else list(read),
        "intervals": [(name, float(low), float(high)) for name, (low, high) in own.items()],
        "count": whole("count", count, 1),
    }
    point, unique_in, multipliers, attracting, saddle, events = _native._proved_orbit(system.equations, question)
    return ProvedOrbit(
        variables,
        np.array(point),
        np.array(unique_in),
        [Multiplier(complex(real, imaginary), radius) for real, imaginary, radius in multipliers],
        attracting,
        saddle,
        [ProvedEvent(name, time, np.array(after)) for name, time, after in events],
    )
