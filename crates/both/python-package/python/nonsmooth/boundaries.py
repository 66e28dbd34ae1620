"""Boundaries between basins: points of them, edge states on them, and the smallest shocks across them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._arguments import state_of, threads_of, wholes

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._native import Attractors


@dataclass(frozen=True)
class Boundary:
    """Two states of different basins, with the boundary between them."""

    #: A state on the first side, and its label.
    first: NDArray[np.float64]
    first_label: int
    #: A state on the other side, and its label.
    second: NDArray[np.float64]
    second_label: int
    #: A state between the two that belongs to no known basin: there the search ended. None as a rule.
    undecided: NDArray[np.float64] | None

    @property
    def middle(self) -> NDArray[np.float64]:
        """The middle of both states. A point of the boundary is at most half of ``distance`` from it."""
        return 0.5 * self.first + 0.5 * self.second

    @property
    def distance(self) -> float:
        """The distance of both states."""
        return float(np.linalg.norm(self.first - self.second))


@dataclass(frozen=True)
class EdgeTrack:
    """An orbit on the boundary between two basins."""

    #: The middle of the pair of states after each bisection, one a row.
    points: NDArray[np.float64]
    #: The last pair.
    boundary: Boundary
    #: Why it ended: "settled" at a fixed point of the steps, the edge state; "rounds", if it still moves; "together", if the pair did not separate;
    #: "undecided", "stopped"; "both in n", if both states came to the same basin.
    end: str


@dataclass(frozen=True)
class FatalShock:
    """A displacement that takes a state to another basin. Its size is an upper bound on that of the smallest one."""

    #: The displacement.
    shock: NDArray[np.float64]
    #: Its length.
    size: float
    #: The label behind it.
    label: int
    #: How many states on the rays had no known basin. A smaller shock may lead there.
    undecided: int


def boundary_between(attractors: Attractors, first: ArrayLike, second: ArrayLike, precision: float = 1e-9) -> Boundary:
    """Two states of different basins, at most ``precision`` apart, on the line between two given states of different basins.

    >>> import nonsmooth as ns
    >>> cubic = ns.map_steps(lambda t, x, p: [1.5 * x[0] - 0.5 * x[0]**3], states="x")
    >>> found = ns.attractors_of(cubic, {"x": (-1.6, 1.6)}, starts=[[0.3], [-0.3]])
    >>> bool(abs(ns.boundary_between(found, [-0.5], [0.7]).middle[0]) < 1e-9)
    True
    """
    return _boundary(_native._boundary_between(attractors, state_of(first), state_of(second), float(precision)))


def track_edge(
    attractors: Attractors,
    first: ArrayLike,
    second: ArrayLike,
    *,
    bisect: float = 1e-9,
    separate: float = 1e-7,
    still: float = 1e-8,
    steps: int = 10_000,
    rounds: int = 1000,
) -> EdgeTrack:
    """Follows the boundary between the basins of two states, to the edge state: the saddle that attracts the boundary.

    A pair of states on both sides of the boundary is followed until it is ``separate`` apart, for ``steps`` steps at most; then it is bisected to
    the distance ``bisect``, and so on, for ``rounds`` rounds at most. It ends where the pair moves by less than ``still`` from one bisection to the next.

    >>> import nonsmooth as ns
    >>> plane = ns.map_steps(lambda t, x, p: [1.5 * x[0] - 0.5 * x[0]**3, x[1] / 2], states="x y")
    >>> found = ns.attractors_of(plane, {"x": (-1.6, 1.6), "y": (-1, 1)}, starts=[[0.3, 0], [-0.3, 0]])
    >>> ns.track_edge(found, [-0.5, 1.0], [1.0, 0.7]).end
    'settled'
    """
    settings = {"bisect": bisect, "separate": separate, "still": still, **wholes(steps=steps, rounds=rounds)}
    points, last, end = _native._track_edge(attractors, state_of(first), state_of(second), settings)
    return EdgeTrack(np.array(points), _boundary(last), end)


def minimal_fatal_shock(
    attractors: Attractors,
    state: ArrayLike,
    farthest: float,
    *,
    directions: int = 360,
    along: int = 200,
    improved: int = 20,
    changes: int = 2000,
    precision: float = 1e-10,
    seed: int = 1,
    threads: int | None = None,
) -> FatalShock | None:
    """The smallest displacement of a state, up to the size ``farthest``, that takes it to another basin; None if the search finds none.

    Rays leave the state in ``directions`` directions, with ``along`` states each. The ``improved`` shortest shocks are then shortened by up to
    ``changes`` changes of their direction. All of it takes some directions · along + improved · changes labels. Between the rays, and in basins thinner
    than the spacing, a smaller shock may be missed.
    """
    counts = wholes(directions=directions, along=along, improved=improved, changes=changes, seed=seed)
    settings = {"farthest": float(farthest), "precision": float(precision), **counts}
    found = _native._minimal_fatal_shock(attractors, state_of(state), settings, threads_of(threads))
    if found is None:
        return None
    shock, size, label, undecided = found
    return FatalShock(np.array(shock), size, label, undecided)


def _boundary(found: Any) -> Boundary:
    (first, first_label), (second, second_label), undecided = found
    return Boundary(np.array(first), first_label, np.array(second), second_label, None if undecided is None else np.array(undecided[0]))
