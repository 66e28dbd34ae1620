"""Periodic orbits that exist for certain, and basins that are proved."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from . import _native
from ._arguments import numbers, whole
from .errors import InputError

if TYPE_CHECKING:
    from os import PathLike

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


@dataclass(frozen=True)
class ProvedTrap:
    """A set that is led into itself: the points centre + directions @ u with abs(u_k) ≤ size. All of them converge to the orbit."""

    orbit: ProvedOrbit
    centre: NDArray[np.float64]
    directions: NDArray[np.float64]
    size: float


@dataclass(frozen=True, eq=False)
class ProvedBasins:
    """Which starts of a window come to which trap, or stop at which surface. A code is the place of a fate in ``traps + surfaces``; −1 is open."""

    traps: list[ProvedTrap]
    #: The surfaces at which starts stop.
    surfaces: list[str]
    #: A lower bound of the share of the window that each fate has. What is left is open.
    shares: NDArray[np.float64]
    #: The cells with a fate: for each variable a low and a high end, in the shape (cells, variables, 2).
    cells: NDArray[np.float64]
    #: The codes of their fates.
    codes: NDArray[np.int64]
    #: The number of images that were computed.
    images: int
    _window: list[tuple[float, float]]
    _native: _native.ProvedBasins

    def __reduce__(self) -> NoReturn:
        raise TypeError("ProvedBasins hold their proof and are not pickled: keep .cells, .codes and .shares, or a certificate")

    def at(self, points: Any) -> NDArray[np.int64]:
        """The codes of the fates of points: an array in whose last axis the variables are."""
        points = numbers(points)
        if points.ndim == 0 or points.shape[-1] != len(self._window):
            raise InputError(f"points have {len(self._window)} variables in the last axis; the shape is {points.shape}")
        rows = np.ascontiguousarray(points.reshape(-1, points.shape[-1]))
        return self._native.codes(rows).reshape(points.shape[:-1])

    def raster(self, pixels: int | Sequence[int]) -> NDArray[np.int64]:
        """The codes at the middles of equal pixels of the window: an array with one axis for each variable."""
        counts = list(pixels) if isinstance(pixels, Iterable) else [pixels] * len(self._window)
        counts = [whole("pixels", count, 1) for count in counts]
        if len(counts) != len(self._window):
            raise InputError(f"pixels has {len(counts)} numbers for {len(self._window)} variables")
        sides = zip(self._window, counts, strict=True)
        axes = [low + (high - low) * (np.arange(count) + 0.5) / count for (low, high), count in sides]
        return self.at(np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1))


def _orbit(variables: list[str], found: tuple[Any, ...]) -> ProvedOrbit:
    point, unique_in, multipliers, attracting, saddle, events = found
    return ProvedOrbit(
        variables,
        np.array(point),
        np.array(unique_in),
        [Multiplier(complex(real, imaginary), radius) for real, imaginary, radius in multipliers],
        attracting,
        saddle,
        [ProvedEvent(name, time, np.array(after)) for name, time, after in events],
    )


def _question(
    system: System,
    surface: str,
    variables: list[str],
    start: Sequence[str],
    read: Sequence[str] | None,
    mode: str | None,
    count: int,
    intervals: Mapping[str, tuple[float, float]],
    certificate: str | PathLike[str] | None,
) -> dict[str, Any]:
    for name, texts in (("start", start), ("read", read)):
        if isinstance(texts, str):
            raise InputError(f"{name}= is a list of formulas, not the text {texts!r}")
    if read is not None and len(read) != len(variables):
        raise InputError(f"read= has {len(read)} formulas for the variables {', '.join(variables)}")
    if certificate is not None and not (Path(certificate).name and Path(certificate).parent.is_dir()):
        raise InputError(f"certificate= is a file in a folder that exists, not {str(certificate)!r}")
    return {
        "mode": system._first_mode(mode),
        "surface": surface,
        "variables": variables + list(intervals),
        "states": [str(text) for text in start] + list(intervals),
        "read": variables if read is None else list(read),
        # Outwards: the decimals that were written are inside.
        "intervals": [
            (name, float(np.nextafter(low, -np.inf)), float(np.nextafter(high, np.inf)))
            for name, (low, high) in intervals.items()
        ],
        "count": whole("count", count, 1),
        "certificate": None if certificate is None else Path(certificate).stem,
    }


def _written(certificate: str | PathLike[str] | None, text: str | None) -> None:
    if certificate is not None and text is not None:
        Path(certificate).write_text(text, encoding="utf-8", newline="\n")


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
    certificate: str | PathLike[str] | None = None,
) -> ProvedOrbit:
    """Proves that the map to a surface has exactly one fixed point in a box that Newton's method finds from a guess, or raises :class:`UndecidedError` with the reason.

    The variables of the map are the names of ``guess``. ``start`` has a formula of them for each component of the state, and one for the time, the last component,
    if the model uses it. ``read`` are formulas of the state after the event number ``count`` of the surface, one for each variable; without it, the variables
    are names of the state. ``intervals`` are parameters with two ends: the result holds for each value of them.

    The fixed point is a periodic orbit if ``start`` gives back the state after the event: of what is read, with a time that is less by a whole number of
    periods of the forcing. A map that ends in another mode than it begins is refused.

    ``certificate`` is a file for the numbers of the proof, which the project's ``check_certificate.py`` confirms. The proof takes longer then.

    Parameters are the decimals that Python prints: 0.2 is 1/5. Numbers inside of a function are their doubles, exactly: a period of the forcing is best
    written with a parameter, ``t - 2*pi/w``.

    >>> import nonsmooth as ns
    >>> section = ns.Guard("section", "x", "rising")
    >>> rossler = ns.System(
    ...     ["-y - z", "x + a*y", "b + z*(x - c)"],
    ...     states="x y z",
    ...     parameters={"a": 0.2, "b": 0.2, "c": 5.7},
    ...     guards=[section],
    ... )
    >>> orbit = ns.proved_orbit(rossler, "section", guess={"y": -8.4, "z": 0.03}, start=["0", "y", "z"])
    >>> orbit.saddle, bool(abs(orbit.point[0].mean() + 8.38094174283) < 1e-11)
    (True, True)
    """
    variables = list(guess)
    own = dict(intervals or {})
    system._check_parameters(own)
    for name, (low, high) in own.items():
        if not low <= high:
            raise InputError(f"the interval of {name} is [{low}, {high}]: the first end is the lower one")
    question = _question(system, surface, variables, start, read, mode, count, own, certificate)
    found, text = _native._proved_orbit(system.equations, question, [float(guess[name]) for name in variables])
    _written(certificate, text)
    return _orbit(variables, found)


def proved_basins(
    system: System,
    surface: str,
    *,
    guesses: Sequence[Mapping[str, float]],
    start: Sequence[str],
    window: Mapping[str, tuple[float, float]],
    read: Sequence[str] | None = None,
    mode: str | None = None,
    count: int = 1,
    first: int = 5,
    last: int = 8,
    images: int = 20_000,
    certificate: str | PathLike[str] | None = None,
    progress: Any = None,
) -> ProvedBasins:
    """Proves which starts of a window come to which fixed point of the map to a surface, cell by cell.

    The map is that of :func:`proved_orbit`: its variables are the names of ``window``. Each guess is near a fixed point that attracts, about which a trap is proved. A cell
    has a fate if it is in a trap, if its image is in cells with this fate, or if all its points stop at a surface. Cells are divided from
    2**-first of the window's sides down to 2**-last; an image is computed once for each cell, and of at most so many ``images``. The traps are proved before,
    which takes seconds. ``progress`` is a function of (images, all images), or True for a bar.

    For a flow without a section of its own, take a guard of the time: the map is then that over a fixed time. If the model is forced, this is a whole period,
    from the time 0.

    With a ``certificate`` the sets are wider, so that more cells may stay open, and the file is large: some kilobytes a cell.

    >>> import nonsmooth as ns
    >>> well = ns.System(["v", "x - x^3 - v"], states="x v", guards=[ns.Guard("later", "t - 2", "rising")])
    >>> basins = ns.proved_basins(
    ...     well,
    ...     "later",
    ...     guesses=[{"x": 1, "v": 0}, {"x": -1, "v": 0}],
    ...     start=["x", "v", "0"],
    ...     window={"x": (-1.5, 1.5), "v": (-1, 1)},
    ...     first=4,
    ...     last=6,
    ... )
    >>> basins.at([[0.8, 0], [-0.8, 0], [0, 0]])
    array([ 0,  1, -1])
    >>> bool(basins.shares.sum() > 0.75), basins.raster(30).shape
    (True, (30, 30))

    Raises :class:`UndecidedError` where no trap is proved. Cells that are not decided are open, and no error.
    """
    variables = list(window)
    for guess in guesses:
        if not isinstance(guess, Mapping):
            raise InputError(f"a guess has a number for each variable by its name, as {{'x': 1.0}}, not {guess!r}")
        if set(guess) != set(variables):
            raise InputError(f"a guess has {sorted(guess)}, but the window has {sorted(variables)}")
    question = _question(system, surface, variables, start, read, mode, count, {}, certificate)
    sides = [(float(low), float(high)) for low, high in window.values()]
    division = (whole("first", first, 0), whole("last", last, 0), whole("images", images, 1))
    at = [[float(guess[name]) for name in variables] for guess in guesses]
    native = _native._proved_basins(system.equations, question, at, sides, division, progress)
    _written(certificate, native.certificate())
    traps = [
        ProvedTrap(_orbit(variables, orbit), np.array(centre), np.array(directions), size)
        for orbit, centre, directions, size in native.traps()
    ]
    rows, codes = native.cells()
    cells = rows.reshape(-1, 2, len(variables)).swapaxes(1, 2)
    shares = np.array(native.shares())
    return ProvedBasins(traps, native.surfaces(), shares, cells, codes, native.images(), sides, native)
