"""What random starts show of the stability of attractors, and of where their states go at a change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._arguments import threads_of, whole
from ._native import Interval

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._native import Attractors

#: The ends of each coordinate: by name, or one pair for each.
Region = Mapping[str, tuple[float, float]] | Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Shock:
    """A displacement of a state from the nearest point of an attractor."""

    #: Its size.
    size: float
    #: The nearest point of the attractor, where it begins.
    start: NDArray[np.float64]
    #: The state behind it, and its label.
    state: NDArray[np.float64]
    label: int


@dataclass(frozen=True)
class Stability:
    """The stability of one attractor. Intervals are of 95 %."""

    #: Basin stability: the fraction of the region that is in its basin. Undecided starts are counted in the upper end.
    fraction: Interval
    #: The mean number of steps to the attractor, from its basin; None for fewer than two starts.
    mean_time: Interval | None
    #: The median; None for few starts.
    median_time: Interval | None
    #: The steps of the start that took longest, this start, and the share of the basin that may take longer; None without starts.
    longest: tuple[int, list[float], float] | None
    #: The smallest fatal shock that was found: an upper bound on the smallest one.
    fatal: Shock | None
    #: The largest harmless shock that was found: a lower bound on the largest one.
    harmless: Shock | None
    #: The mean size of harmless shocks; None for fewer than two.
    mean_harmless: Interval | None


@dataclass(frozen=True)
class Tipping:
    """Where the states of a basin go at a change."""

    #: The labels before and after.
    before: int
    after: int
    #: The probability that a state of the first basin is in the second one, with the 95 % interval.
    probability: Interval
    #: The number of points that went this way.
    count: int


def stability_of(
    attractors: Attractors,
    region: Region,
    *,
    starts: int = 1000,
    seed: int = 1,
    precision: float | None = 1e-6,
    threads: int | None = None,
) -> dict[int, Stability]:
    """The stability of each attractor, by label: basin stability, times of convergence, fatal and harmless shocks, all from so many random starts in a region.

    A start is a shock to each attractor: its displacement from the nearest point. The smallest fatal one is shortened by bisection to ``precision``; None leaves
    it as it is.

    >>> import nonsmooth as ns
    >>> cubic = ns.map_steps(lambda t, x, p: [1.5 * x[0] - 0.5 * x[0]**3], states="x")
    >>> found = ns.attractors_of(cubic, {"x": (-1.7, 1.6)}, starts=[[0.3], [-0.3]])
    >>> stable = ns.stability_of(found, {"x": (-1.5, 1.5)})
    >>> 0.5 in stable[1].fraction, round(stable[1].fatal.size, 5)
    (True, 1.0)
    """
    sample = {"region": _sides(region), "count": whole("starts", starts, 1), "seed": whole("seed", seed)}
    found = _native._stability(attractors, sample, precision, threads_of(threads))
    return {label: _stability(row) for label, row in found.items()}


def tipping(
    before: Attractors,
    after: Attractors,
    region: Region,
    *,
    points: int = 10_000,
    seed: int = 1,
    threads: int | None = None,
) -> list[Tipping]:
    """Where states go when a parameter changes at once. Labels are those of each set by itself: of two searches the same attractor may have two labels. For each pair of basins the probability that a state of the one before is in the one after, by the same random points
    of a region.

    >>> import nonsmooth as ns
    >>> def at(c):
    ...     cubic = ns.map_steps(lambda t, x, p: [x[0] + 0.4 * x[0] * (1 - x[0]**2) + p.c], states="x", parameters={"c": c})
    ...     return ns.attractors_of(cubic, {"x": (-1.6, 1.6)}, starts=[[-1], [1]])
    >>> [(own.before, own.after) for own in ns.tipping(at(0), at(0.1), {"x": (-1, 1)}) if own.probability.value > 0]
    [(1, 1), (1, 2), (2, 2)]
    """
    sample = {"region": _sides(region), "count": whole("points", points, 1), "seed": whole("seed", seed)}
    return [Tipping(*row) for row in _native._tipping(before, after, sample, threads_of(threads))]


def _sides(region: Region) -> list[tuple[float, float]]:
    sides = region.values() if isinstance(region, Mapping) else region
    return [(float(left), float(right)) for left, right in sides]


def _shock(row: Any) -> Shock | None:
    if row is None:
        return None
    size, start, state, label = row
    return Shock(size, np.array(start), np.array(state), label)


def _stability(row: Any) -> Stability:
    fraction, mean_time, longest, fatal, harmless, mean_harmless, median_time = row
    return Stability(fraction, mean_time, median_time, longest, _shock(fatal), _shock(harmless), mean_harmless)
