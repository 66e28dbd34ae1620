"""Return maps: from a section to its next crossing, their periodic points, branches and diagrams."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._arguments import numbers
from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._native import Steps


@dataclass(frozen=True)
class Image:
    """The image of a point of a section."""

    #: The point.
    point: NDArray[np.float64]
    #: The time until then.
    time: float
    #: The mode and the surface of each event on the way.
    itinerary: list[str]
    #: How certain it is that no event on the way was missed: "exact", "certain", "interpolated" or "sampled".
    certainty: str


@dataclass(frozen=True)
class Linearized:
    """The image of a point with the derivatives of the map."""

    #: The image.
    point: NDArray[np.float64]
    #: The derivatives by the coordinates of the point.
    slopes: NDArray[np.float64]
    #: The derivatives by the parameter.
    parameter_slopes: NDArray[np.float64]
    #: How far all of them may be off: an estimate. The last column is that of the parameter.
    errors: NDArray[np.float64]


@dataclass(frozen=True)
class PeriodicPoint:
    """A point that the map takes back to itself."""

    #: The point.
    point: NDArray[np.float64]
    #: The parameter.
    parameter: float
    #: The eigenvalues of the derivative of the map, period times.
    multipliers: NDArray[np.complex128]
    #: How far each multiplier may be off: an estimate.
    multiplier_errors: NDArray[np.float64]
    #: Whether the point attracts: all multipliers are inside the unit circle.
    is_stable: bool
    #: The events on the way.
    itinerary: list[str]
    #: How far the point is known: the last step of Newton's method, in units of its size.
    error: float


@dataclass(frozen=True)
class Bifurcation(PeriodicPoint):
    """A bifurcation of a branch, located on it."""

    #: "fold", "doubling", "Neimark–Sacker", "transcritical" or "pitchfork".
    kind: str
    #: How far the parameter may be off: an estimate.
    parameter_error: float
    #: The coefficient of the normal form; None if it is not known.
    coefficient: float | None


@dataclass(frozen=True)
class Branch:
    """A branch of periodic points, from one end to the other."""

    points: list[PeriodicPoint]
    bifurcations: list[Bifurcation]
    #: Why it ends before its first point, and behind its last one: "window", "closed", "doubling", "point limit", "grazing", "corner",
    #: "sliding", "chattering", "border" or "lost".
    ends: tuple[str, str]

    @property
    def parameter(self) -> NDArray[np.float64]:
        """The parameter at each point."""
        return np.array([point.parameter for point in self.points])

    @property
    def point(self) -> NDArray[np.float64]:
        """The points, one a row."""
        return np.array([point.point for point in self.points])

    @property
    def is_stable(self) -> NDArray[np.bool_]:
        """Whether each point attracts."""
        return np.array([point.is_stable for point in self.points])


@dataclass(frozen=True)
class Diagram:
    """A bifurcation diagram: points after a transient, each with its parameter."""

    parameter: NDArray[np.float64]
    #: The points, one a row.
    point: NDArray[np.float64]
    #: The parameters at which an orbit failed, each with the reason.
    failed: list[tuple[float, str]]


class ReturnMap:
    """The map from a section to the next event of a surface, as one parameter changes. :meth:`System.returns` makes it.

    >>> import nonsmooth as ns
    >>> ball = ns.System(
    ...     lambda t, x, p: [x[1], -1],
    ...     states=["height", "speed"],
    ...     parameters={"r": 0.5},
    ...     guards=[ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -p.r * x[1] + 0.3])],
    ... )
    >>> bounces = ball.returns("floor", coordinates=["speed"])
    >>> round(float(bounces.image([1.0]).point[0]), 12)
    0.8
    >>> fixed = bounces.periodic_point([0.7])
    >>> round(float(fixed.point[0]), 12), round(float(fixed.multipliers[0].real), 12)
    (0.6, 0.5)
    """

    def __init__(self, native: Any, parameter: str, value: float) -> None:
        self._native = native
        #: The name of the parameter, and the value that is taken where none is given.
        self.parameter, self.value = parameter, value

    def _value(self, value: float | None) -> float:
        own = self.value if value is None else float(value)
        if not np.isfinite(own):
            raise InputError(f"the parameter {self.parameter} is {own!r}: it must be finite")
        return own

    @property
    def dimension(self) -> int:
        """The number of coordinates of the section."""
        return int(self._native.dimension)

    def image(self, point: ArrayLike, value: float | None = None) -> Image:
        """The image of a point, at a value of the parameter."""
        return Image(**self._native.image(_vector(point), self._value(value)))

    def __call__(self, point: ArrayLike, value: float | None = None) -> NDArray[np.float64]:
        """The image of a point alone."""
        return self.image(point, value).point

    def linearized(self, point: ArrayLike, value: float | None = None) -> Linearized:
        """The image with exact derivatives, through all events."""
        return Linearized(**self._native.linearized(_vector(point), self._value(value)))

    def orbit(self, point: ArrayLike, images: int, value: float | None = None) -> NDArray[np.float64]:
        """The point and its images, one a row."""
        found: NDArray[np.float64] = self._native.orbit(_vector(point), self._value(value), images)
        return found

    def periodic_point(self, start: ArrayLike, period: int = 1, value: float | None = None) -> PeriodicPoint:
        """The point of a period near a start, by Newton's method."""
        return PeriodicPoint(**_point(self._native.periodic_point(_vector(start), self._value(value), period)))

    def branch(
        self,
        start: ArrayLike,
        window: tuple[float, float],
        period: int = 1,
        value: float | None = None,
        longest_step: float = 0.02,
    ) -> Branch:
        """The branch of periodic points through one near a start, in a window of the parameter, with its bifurcations.

        ``longest_step`` is a part of the window: two bifurcations of one kind within one step would be missed.
        """
        points, bifurcations, ends = self._native.branch(
            _vector(start), self._value(value), period, window, longest_step
        )
        return Branch(
            [PeriodicPoint(**_point(own)) for own in points],
            [Bifurcation(**_point(own)) for own in bifurcations],
            (ends[0], ends[1]),
        )

    def diagram(
        self,
        values: ArrayLike,
        seeds: ArrayLike,
        *,
        transient: int = 500,
        keep: int = 100,
        carried: bool = False,
        progress: Callable[[int, int], Any] | bool | None = None,
    ) -> Diagram:
        """The bifurcation diagram: at each value of the parameter the orbits of the seeds, after a transient.

        With ``carried`` an orbit begins where that of the value before has ended, so that attractors are followed. Seeds are one a row.
        """
        rows = np.atleast_2d(np.asarray(seeds, dtype=float))
        found = self._native.diagram(
            np.asarray(values, dtype=float).ravel().tolist(), rows.tolist(), transient, keep, carried, progress
        )
        return Diagram(*found)

    def lyapunov(
        self, start: ArrayLike, *, transient: int = 500, images: int = 5000, value: float | None = None
    ) -> list[tuple[float, float, float]]:
        """The Lyapunov exponents of an orbit, for each image: the value and both ends of its 95 % interval."""
        found: list[tuple[float, float, float]] = self._native.lyapunov(
            _vector(start), self._value(value), transient, images
        )
        return found

    def steps(self, value: float | None = None, ends: Sequence[str] = ()) -> Steps:
        """The map at a value of the parameter, for attractors and basins. An orbit that ends at a surface of ``ends`` has the label
        65001, 65002, … of its place there."""
        return _native.Steps.of_returns(self._native, self._value(value), _names(ends))

    def __repr__(self) -> str:
        return f"ReturnMap(dimension={self.dimension}, {self.parameter}={self.value!r})"


def _names(ends: Sequence[str]) -> list[str]:
    if isinstance(ends, str):
        raise InputError(f"ends= is a list of names, not the text {ends!r}")
    return list(ends)


def _vector(point: ArrayLike) -> Any:
    return np.atleast_1d(numbers(point))


def _point(found: dict[str, Any]) -> dict[str, Any]:
    real, imaginary = found["multipliers"]
    return {**found, "multipliers": real + 1j * imaginary}
