"""Attractors and basins of systems, return maps and any labelling."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import labelling
from ._arguments import numbers, threads_of, whole
from ._native import Attractors, Steps
from ._progress import function_of
from .errors import InputError
from .returns import ReturnMap
from .surfaces import FunctionOrFormulas
from .systems import System
from .tracing import Model, name_list

if TYPE_CHECKING:
    import distributed
    import xarray
    from numpy.typing import ArrayLike


def map_steps(
    map: FunctionOrFormulas, *, states: Sequence[str] | str, parameters: Mapping[str, float] | None = None
) -> Steps:
    """A map x ↦ f(t, x, p) of formulas, for attractors and basins: texts, SymPy's expressions, or a function, which is called once with symbols. It must not
    depend on t.

    >>> import nonsmooth as ns
    >>> henon = ns.map_steps(lambda t, x, p: [1 - p.a * x[0]**2 + x[1], 0.3 * x[0]], states="x y", parameters={"a": 1.4})
    >>> henon([0.5, 0.1])
    [0.75, 0.15]
    """
    return Steps.of_formulas(Model(name_list(states), parameters or {}).formulas("the map", map))


def attractors_of(
    of: System | Steps,
    region: Mapping[str, tuple[float, float]],
    *,
    step: float | tuple[float, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    starts: int | ArrayLike = 100,
    seed: int = 0,
    threads: int | None = None,
    **limits: Any,
) -> Attractors:
    """The attractors of a system in a region, found by recurrences from random starts, and tested as traps.

    ``region`` has for each component of the state its ends, as ``{"x": (-2, 2), "v": (-2, 2)}``. Of a system with several modes the number of the mode is the last
    component, "mode", which the region need not name. ``step`` is the time of a step of a :class:`System`: a period
    of its forcing, if it has one; else shorter than its shortest cycle. Steps of a :class:`ReturnMap` are their own. ``starts`` is the number of random
    starts, or the starts, one a row. ``limits`` are those of :class:`labelling.Attractors`: ``cells``, ``recurrences``, ``locate``, ``budget``,
    ``tests``, ``escape``, ``lost``, ``periodic``.

    >>> import numpy as np, nonsmooth as ns
    >>> duffing = ns.System(["v", "x - x^3 - 0.15*v + 0.2*cos(t)"], states="x v")
    >>> found = ns.attractors_of(duffing, {"x": (-2.2, 2.2), "v": (-2.2, 2.2)}, step=2 * np.pi, starts=10, locate=50)
    >>> found.periods
    {1: 1, 2: 1}
    """
    steps = _steps(of, step, parameters)
    if isinstance(of, System):
        wanted = _coordinates(of)
        if "mode" in wanted[len(of.states) :]:
            # Each mode is a whole number within.
            region = {**region, "mode": region.get("mode", (-0.5, len(of.modes) - 0.5))}
        if list(region) != wanted:
            raise InputError(f"region has the ends of each component, in this order: {', '.join(wanted)}; not {list(region)}")
    sides = [(float(left), float(right)) for left, right in region.values()]
    if isinstance(starts, (int, np.integer)):
        low, high = np.array(sides).T
        rows = np.random.default_rng(seed).uniform(low, high, (int(starts), len(sides)))
    else:
        rows = np.atleast_2d(numbers(starts))
        if not np.isfinite(rows).all():
            raise InputError("starts= has numbers that are not finite")
    return Attractors(steps, region=sides, starts=rows.tolist(), threads=threads_of(threads), **limits)


def known_attractors(
    of: System | Steps,
    points: Mapping[int, ArrayLike],
    distance: float | None = None,
    *,
    step: float | tuple[float, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    threads: int | None = None,
    **limits: Any,
) -> Attractors:
    """The attractors of a system that are known by some of their points: ``points`` has them by label, one a row. An orbit has come to one as soon as it is
    within ``distance``, by default the largest one that tests find right. ``limits`` are ``budget``, ``stretch`` and ``tests`` of
    :meth:`labelling.Attractors.of_points`.

    >>> import nonsmooth as ns
    >>> pendulum = ns.System(["v", "-sin(x) - 0.3*v"], states="x v")
    >>> rest = ns.known_attractors(pendulum, {1: [[0, 0]], 2: [[2 * 3.141592653589793, 0]]}, step=1.0, tests=20)
    >>> rest.labels([[1.0, 0.0], [5.0, 0.0]]).tolist()
    [1, 2]
    """
    own = {_label(label): np.atleast_2d(numbers(rows)).tolist() for label, rows in points.items()}
    return Attractors.of_points(_steps(of, step, parameters), own, distance, threads=threads_of(threads), **limits)


def attractors_by_features(
    of: System | Steps,
    features: Callable[[Any], Any],
    starts: ArrayLike,
    *,
    radius: float,
    beside: float,
    step: float | tuple[float, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    threads: int | None = None,
    **limits: Any,
) -> Attractors:
    """The attractors of a system by features of orbits: ``features`` makes some numbers of an array with the points of a stretch of an orbit, one a row.
    ``starts`` has one start a row, ``radius`` the largest distance of features of one attractor, ``beside`` how far from an attractor orbits start that test it.
    ``limits`` are ``transient``, ``stretch``, ``agree``, ``budget``, ``fewest`` and ``tests`` of :meth:`labelling.Attractors.of_features`.

    >>> import nonsmooth as ns
    >>> well = ns.System(["v", "x - x^3 - 0.3*v"], states="x v")
    >>> starts = [[0.1 * k, 0.0] for k in range(-12, 13) if k]
    >>> found = ns.attractors_by_features(well, lambda points: points.mean(axis=0)[:1], starts, step=1.0, radius=0.2, beside=0.05,
    ...                                   transient=60, stretch=10, tests=20)
    >>> {label: round(float(points[0, 0]), 3) for label, points in found.points.items()}
    {1: -1.0, 2: 1.0}
    """
    rows = np.atleast_2d(numbers(starts)).tolist()
    return Attractors.of_features(_steps(of, step, parameters), features, rows, radius=radius, beside=beside, threads=threads_of(threads), **limits)


def basins_of(
    of: System | Steps | Callable[..., Any],
    window: Mapping[str, tuple[float, float]],
    shape: tuple[int, int] = (512, 512),
    *,
    step: float | tuple[float, float] | None = None,
    others: Mapping[str, float] | None = None,
    region: Mapping[str, tuple[float, float]] | None = None,
    attractors: Attractors | None = None,
    parameters: Mapping[str, float] | None = None,
    names: Mapping[int, str] | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], Any] | bool | None = None,
    client: distributed.Client | None = None,
    **search: Any,
) -> xarray.Dataset:
    """The basins in a window of the plane, as an ``xarray.Dataset`` with the label of each pixel's middle.

    ``of`` is a :class:`System`, which is followed in steps of the time ``step``; or Steps of a return map or a map; or any labelling: a function of two arrays that
    returns labels. ``window`` names two components of the state with their ends, ``others`` has the values of all other ones, of a
    system with several modes also the number of the "mode". The attractors are those
    given, or are searched by :func:`attractors_of` in ``region``, by default the window, with the settings ``search``.

    The Dataset of a system also has the steps until each start is at its attractor. Codes of labels are those of :mod:`nonsmooth.labelling`. With ``client``, a
    ``dask.distributed.Client``, the workers of its cluster compute strips of columns; those of a lost worker are computed again.

    >>> import numpy as np, nonsmooth as ns
    >>> duffing = ns.System(["v", "x - x^3 - 0.15*v + 0.2*cos(t)"], states="x v")
    >>> window = {"x": (-2.2, 2.2), "v": (-2.2, 2.2)}
    >>> found = ns.basins_of(duffing, window, (64, 64), step=2 * np.pi, starts=10, locate=50)
    >>> np.unique(found.label).tolist()
    [1, 2]
    """
    if not isinstance(of, (System, Steps)):
        if isinstance(of, ReturnMap):
            raise TypeError("give the steps of a return map, of.steps(value): its parameter has a value there")
        if client is not None:
            raise InputError("the workers of a client compute the basins of a System or of Steps, not those of a labelling")
        return labelling.basins_of(of, window, shape, names, progress)
    labelling.check_window(window, names)
    threads = threads_of(threads)
    steps = _steps(of, step, parameters)
    # The components of a state: those of Steps have no names, and come in the order of the region, or of the window and the others.
    known = _coordinates(of) if isinstance(of, System) else list(region) if region is not None else [*window, *(others or {})]
    if not set(window) <= set(known):
        raise InputError(f"the window names {list(window)}; the components of the state are: {', '.join(known)}")
    unknown = [name for name in others or {} if name not in known or name in window]
    if unknown:
        raise InputError(f"others= names {unknown}; the components beside the window are: {[own for own in known if own not in window]}")
    rest = [name for name in known if name not in window]
    missing = [name for name in rest if name not in (others or {})]
    if missing:
        raise InputError(f"others= needs a value of each component that is not in the window: {', '.join(missing)}")
    if attractors is None:
        whole = dict(window) if region is None else dict(region)
        if isinstance(of, System) and known != of.states:
            whole.setdefault("mode", (-0.5, len(of.modes) - 0.5))
        absent = [name for name in known if name not in whole]
        if absent:
            raise InputError(f"region= needs the ends of each component; there are none of: {', '.join(absent)}")
        attractors = attractors_of(steps, {name: whole[name] for name in known}, threads=threads, **search)
    elif search:
        raise TypeError(f"attractors= are given, so that there is no search with {', '.join(search)}")
    start = Starts(known, list(window), {name: float(value) for name, value in (others or {}).items()})
    xs, ys = labelling.pixels(window, shape)
    parts = [(attractors, start, xs[begin:end], ys) for begin, end in labelling.strips(len(xs), len(ys), _LEAST_STRIPS)]
    told = function_of(progress)
    found = []
    for part in _computed(parts, threads, client):
        found.append(part)
        if told is not None:
            told(sum(len(labels) for labels, _ in found), len(xs))
    dataset = labelling.dataset_of(np.concatenate([labels for labels, _ in found]), window, names)
    # Where the window is in a state, for pictures with attractors.
    dataset.attrs["components"] = [known.index(name) for name in window]
    if attractors.kind == "features":
        return dataset
    about = {"long_name": "steps until the start is at its attractor", "units": "1"}
    return dataset.assign(steps=(tuple(window), np.concatenate([steps for _, steps in found]), about))


#: Strips of a window at least: progress is told, and workers are given work, by strips. More would leave processors without work at the end of each.
_LEAST_STRIPS = 16

#: How often a strip is given to the cluster again after its worker was lost. One that kills every worker is an error in the end.
_TRIALS = 20


@dataclass(frozen=True)
class Starts:
    """The starts of a window: the names of the components of a state, those of the window, and the values of the others."""

    known: list[str]
    window: list[str]
    others: dict[str, float]

    def rows(self, x: Any, y: Any) -> Any:
        """The starts with these values in the window, one a row."""
        across, up = np.meshgrid(x, y, indexing="ij")
        columns = {**self.others, **dict(zip(self.window, (across, up)))}
        return np.stack([np.broadcast_to(columns[name], across.shape).ravel() for name in self.known], axis=1)


def _strip(attractors: Attractors, starts: Starts, x: Any, y: Any, threads: int | None) -> tuple[Any, Any]:
    """The labels of a strip, and the steps of its starts. Features tell no steps."""
    rows, shape = starts.rows(x, y), (len(x), len(y))
    if attractors.kind == "features":
        return attractors.labels(rows, threads).reshape(shape), None
    labels, steps = attractors.convergences(rows, threads)
    return labels.reshape(shape), steps.reshape(shape)


def _computed(parts: Sequence[Any], threads: int | None, client: Any) -> Iterator[tuple[Any, Any]]:
    """The strips, one after the other: by this process, or by the workers of a cluster."""
    if client is None:
        yield from (_strip(*part, threads) for part in parts)
        return
    if not callable(getattr(client, "submit", None)):
        raise TypeError(f"client is a dask.distributed.Client, not {client!r}")
    # Sent once to each worker: it makes the attractors again when it gets them.
    shared = client.scatter(parts[0][0], broadcast=True)
    futures = [client.submit(_strip, shared, *part[1:], 1, pure=False, retries=_TRIALS) for part in parts]
    try:
        for future in futures:
            yield future.result()
    finally:
        client.cancel(futures)


def _coordinates(system: System) -> list[str]:
    """The coordinates of the steps of a system: its components, and the number of the mode, if it has several."""
    return [*system.states, "mode"] if len(system.modes) > 1 else system.states


def _label(label: Any) -> int:
    """The label of a basin, as a user gives it."""
    found = whole("the label of points", label)
    if found > 65_000:
        raise InputError(f"attractors have labels up to 65000, not {found}: the others mean ends and what is undecided")
    return found


def _steps(of: Any, step: Any, parameters: Any) -> Steps:
    if isinstance(of, Steps):
        if step is not None or parameters:
            raise TypeError("Steps have their own time and parameters: step= and parameters= are those of a System")
        return of
    if not isinstance(of, System):
        raise TypeError(f"a System or Steps are needed, not {type(of).__name__}")
    if step is None:
        raise InputError("a System is followed in steps: give step=, the period of its forcing or a short time")
    return of.steps(step, parameters=parameters)
