"""Attractors and basins of systems, return maps and any labelling."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError
from . import labelling
from ._native import Attractors, Steps
from .returns import ReturnMap
from .surfaces import FunctionOrFormulas
from .systems import System
from .tracing import Model, name_list

if TYPE_CHECKING:
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
    **limits: Any,
) -> Attractors:
    """The attractors of a system in a region, found by recurrences from random starts, and tested as traps.

    ``region`` has for each component of the state its ends, as ``{"x": (-2, 2), "v": (-2, 2)}``. ``step`` is the time of a step of a :class:`System`: a period
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
    if isinstance(of, System) and list(region) != of.states:
        raise InputError(f"region has the ends of each component, in this order: {', '.join(of.states)}; not {list(region)}")
    sides = [(float(left), float(right)) for left, right in region.values()]
    if isinstance(starts, (int, np.integer)):
        low, high = np.array(sides).T
        rows = np.random.default_rng(seed).uniform(low, high, (int(starts), len(sides)))
    else:
        rows = np.atleast_2d(np.asarray(starts, dtype=float))
        if not np.isfinite(rows).all():
            raise InputError("starts= has numbers that are not finite")
    return Attractors(steps, region=sides, starts=rows.tolist(), **limits)


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
    **search: Any,
) -> xarray.Dataset:
    """The basins in a window of the plane, as an ``xarray.Dataset`` with the label of each pixel's middle.

    ``of`` is a :class:`System`, which is followed in steps of the time ``step``; or Steps of a return map; or any labelling: a function of two arrays that
    returns labels. ``window`` names two components of the state with their ends, ``others`` has the values of all other ones. The attractors are those
    given, or are searched by :func:`attractors_of` in ``region``, by default the window, with the settings ``search``.

    The Dataset of a system also has the steps until each start is at its attractor. Codes of labels are those of :mod:`nonsmooth.labelling`.

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
        return labelling.basins_of(of, window, shape, names, progress)
    steps = _steps(of, step, parameters)
    known = of.states if isinstance(of, System) else list(window)
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
        absent = [name for name in known if name not in whole]
        if absent:
            raise InputError(f"region= needs the ends of each component; there are none of: {', '.join(absent)}")
        attractors = attractors_of(steps, {name: whole[name] for name in known}, **search)
    elif search:
        raise TypeError(f"attractors= are given, so that there is no search with {', '.join(search)}")
    times = []

    def label(x: Any, y: Any) -> Any:
        columns = {**{name: float(value) for name, value in (others or {}).items()}, **dict(zip(window, (x, y)))}
        starts = np.stack([np.broadcast_to(columns[name], x.shape).ravel() for name in known], axis=1)
        labels, steps = attractors.convergences(starts, threads)
        times.append(steps.reshape(x.shape))
        return labels.reshape(x.shape)

    found = labelling.basins_of(label, window, shape, names, progress)
    about = {"long_name": "steps until the start is at its attractor", "units": "1"}
    return found.assign(steps=(tuple(window), np.concatenate(times), about))


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
