"""Attractors and the fractions of their basins along a parameter."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._arguments import threads_of, whole, wholes
from ._conventions import about, complete
from .errors import InputError

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

    from ._native import Steps


@dataclass(frozen=True)
class Change:
    """An attractor that appears or vanishes between two parameters."""

    start: float
    end: float
    label: int
    appears: bool


@dataclass(frozen=True)
class Unresolved:
    """A step of the parameter across which a fraction changes by more than was asked for."""

    start: float
    end: float
    label: int
    #: "jump", if the step is the shortest one and the intervals are apart; "uncertain", if more points are needed to see a change; "budget".
    reason: str


@dataclass(frozen=True)
class AttractorsAlong:
    """Attractors and basin fractions along a parameter. The same label is the same attractor at all parameters."""

    #: The parameters, in increasing order.
    parameter: NDArray[np.float64]
    #: For each label the fraction of its basin, and the ends of the 95 % interval, at each parameter.
    fractions: dict[int, tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]]
    #: The largest fraction that any other basin can have at each parameter.
    unseen: NDArray[np.float64]
    #: At each parameter the points of the attractors by label, one a row.
    attractors: list[dict[int, NDArray[np.float64]]]
    #: The attractors that appear or vanish.
    changes: list[Change]
    #: The steps across which a fraction changes by more than was asked for.
    unresolved: list[Unresolved]

    def to_xarray(self, name: str = "parameter") -> xarray.Dataset:
        """The fractions with the ends of their intervals, as a Dataset over the parameter and the label."""
        try:
            import xarray
        except ImportError as error:
            raise ImportError("to_xarray needs xarray: pip install 'passive-hopper[xarray]'") from error
        labels = list(self.fractions)
        texts = {"fraction": "fraction of the basin", "lower": "lower end of the 95 % interval", "upper": "upper end of the 95 % interval"}
        columns = {
            key: ((name, "basin"), np.stack([self.fractions[label][k] for label in labels], axis=1), {"long_name": text, "units": "1"})
            for k, (key, text) in enumerate(texts.items())
        }
        coordinates = {
            name: (name, self.parameter, {"long_name": name}),
            "basin": ("basin", labels, {"long_name": "label of the basin"}),
        }
        return complete(xarray.Dataset(columns, coordinates, about("basin fractions along a parameter")))


def attractors_along(
    steps_at: Callable[[float], Steps],
    parameter: tuple[float, float],
    region: Mapping[str, tuple[float, float]],
    *,
    basins: Mapping[str, tuple[float, float]] | None = None,
    known: Sequence[float] = (),
    steps: int = 16,
    difference: float = 0.02,
    shortest: float = 1e-6,
    parameters: int = 1000,
    match: str | tuple[str, float] = "flow",
    starts: int = 20,
    points: int = 1000,
    seed: int = 1,
    cells: int = 100,
    recurrences: int = 100,
    locate: int = 1000,
    budget: int = 100_000,
    lost: int = 1000,
    tests: int = 200,
    escape: float | None = None,
    periodic: Sequence[int] = (),
    threads: int | None = None,
    progress: Callable[[int, int], Any] | bool | None = None,
) -> AttractorsAlong:
    """The attractors of a system and the fractions of their basins along a parameter, refined where the fractions change.

    ``steps_at`` is a function from the parameter to the steps there, as ``lambda f: system.steps(period, parameters={"force": f})`` or the ``steps`` of a
    return map; ``parameter`` has its ends, and ``known`` values at which something is known to happen. At each value attractors are searched in ``region`` as :func:`attractors_of` does, from
    those at the value before and from random starts in ``basins``, by default the region; the labels of ``points`` random points there give the fractions.

    The parameter is divided into ``steps`` steps, and a step is halved where a fraction changes by more than ``difference``, down to ``shortest``, with at
    most ``parameters`` values.
    Attractors are matched by ``match``: "flow", where the points of one come to at the next value; ("nearest", d) by Hausdorff's distance up to d;
    ("overlap", f) by the share of their basins in common.

    >>> import nonsmooth as ns
    >>> at = lambda c: ns.map_steps(lambda t, x, p: [x[0] + 0.4 * x[0] * (1 - x[0]**2) + p.c], states="x", parameters={"c": c})
    >>> along = ns.attractors_along(at, (0.0, 0.2), {"x": (-1.6, 1.6)}, steps=4, difference=0.2, shortest=0.01, points=200)
    >>> [(own.label, own.appears, own.start < 2 * 0.4 / 27**0.5 < own.end) for own in along.changes]
    [(1, False, True)]
    """
    sides = {name: (float(left), float(right)) for name, (left, right) in region.items()}
    inside = sides if basins is None else {name: (float(left), float(right)) for name, (left, right) in basins.items()}
    if list(inside) != list(sides):
        raise InputError(f"basins= has the ends of the same components as the region, in the same order: {', '.join(sides)}")
    within, overlap = _matching(match)
    first, last = parameter
    settings = {
        "range": (float(first), float(last)),
        "known": [float(value) for value in known],
        "region": list(sides.values()),
        "basins": list(inside.values()),
        "difference": float(difference),
        "shortest": float(shortest),
        "within": within,
        "overlap": overlap,
        "escape": escape,
        "periodic": [whole("periodic", coordinate) for coordinate in periodic],
        "first_steps": whole("steps", steps),
        **wholes(parameters=parameters, starts=starts, points=points, seed=seed, cells=cells),
        **wholes(recurrences=recurrences, locate=locate, budget=budget, lost=lost, tests=tests),
    }
    found = _native._attractors_along(steps_at, settings, threads_of(threads), progress)
    return AttractorsAlong(
        found["parameter"],
        found["fractions"],
        found["unseen"],
        found["attractors"],
        [Change(*row) for row in found["changes"]],
        [Unresolved(*row) for row in found["unresolved"]],
    )


def _matching(match: str | tuple[str, float]) -> tuple[float | None, float | None]:
    """The distance of "nearest", or the share of "overlap"."""
    if match == "flow":
        return None, None
    if isinstance(match, tuple) and len(match) == 2 and match[0] in ("nearest", "overlap"):
        value = float(match[1])
        return (value, None) if match[0] == "nearest" else (None, value)
    raise InputError(f'match= is "flow", ("nearest", distance) or ("overlap", share), not {match!r}')
