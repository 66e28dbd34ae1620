"""Hybrid systems by functions f(t, x, p), which run as formulas where they can."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._arguments import numbers, threads_of
from ._native import Equations, Steps
from .callbacks import Callbacks
from .errors import InputError, TracingError
from .model_functions import Functions
from .returns import ReturnMap, _names
from .runs import Fates, Run
from .surfaces import Clock, FunctionOrFormulas, Guard
from .tracing import Model, name_list

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: The mode of a system whose modes have no names.
_ONLY = "motion"

#: The most events of a run that states no limit.
_MOST_EVENTS = 1_000_000


class System:
    """A hybrid system: ẋ = f(t, x, p), interrupted by events.

    ``field`` is the function f(t, x, p), or a dictionary with one for each mode. It is called once with symbols, which NumPy's functions accept, and
    becomes formulas: then a run needs no Python, misses no event of its Taylor polynomials, and can be pickled. A function without formulas,
    such as one with an ``if``, is called at every stage of every step. ``compiled`` tells which, ``why_not`` why; ``compiled=True`` demands formulas.
    Texts and SymPy's expressions are formulas, too.

    ``states`` are the names of the components of the state, ``parameters`` the values of the parameters by name, ``guards`` surfaces
    (:class:`Guard`) and preset times (:class:`Clock`). ``args`` are further arguments of all functions, as in SciPy: behind x, or behind p if there are parameters. ``rests`` has for a mode where
    the run goes on after infinitely many events in finite time (Zeno): the next mode, or a pair of it and the reset.
    ``tolerance`` is the relative and absolute error of a step, ``absolute`` another absolute one: a number, or one for each component.

    >>> import numpy as np, nonsmooth as ns
    >>> oscillator = ns.System(
    ...     lambda t, x, p: [x[1], -x[0] - 0.1 * x[1] + np.cos(1.3 * t)],
    ...     states=["x", "v"],
    ...     parameters={"restitution": 0.8},
    ...     guards=[ns.Guard("stop", lambda t, x, p: x[0] - 0.5, "rising", reset=lambda t, x, p: [x[0], -p.restitution * x[1]])],
    ... )
    >>> oscillator.compiled
    True
    >>> len(oscillator.run([0, 1], time=400).events)
    83
    """

    def __init__(
        self,
        field: FunctionOrFormulas | Mapping[str, FunctionOrFormulas],
        *,
        states: Sequence[str] | str,
        parameters: Mapping[str, float] | None = None,
        guards: Sequence[Guard | Clock] = (),
        args: tuple[Any, ...] = (),
        rests: Mapping[str, str | tuple[str, FunctionOrFormulas]] | None = None,
        tolerance: float | Sequence[float] = 1e-10,
        absolute: float | Sequence[float] | None = None,
        longest_step: float = float("inf"),
        compiled: bool | None = None,
    ) -> None:
        self.states = name_list(states)
        self.parameters = {name: float(value) for name, value in (parameters or {}).items()}
        fields = dict(field) if isinstance(field, Mapping) else {_ONLY: field}
        if not fields:
            raise InputError("a system has at least one mode")
        self.modes = list(fields)
        self._tolerances = _tolerances(tolerance, absolute, longest_step, len(self.states))
        functions = Functions(fields, list(guards), dict(rests or {}), args)
        self._ends = [guard.name for guard in guards if isinstance(guard, Guard) and guard.terminal]
        self._surfaces = [guard.name for guard in guards if isinstance(guard, (Guard, Clock))]
        self.why_not: str | None = None
        self._equations: Equations | None = None
        self._callbacks: Callbacks | None = None
        if compiled is not False:
            try:
                self._equations = functions.equations(Model(self.states, self.parameters), self._tolerances)
            except TracingError as error:
                if compiled:
                    raise
                self.why_not = str(error)
        else:
            self.why_not = "compiled=False"
        if self._equations is None:
            self._callbacks = Callbacks(functions, self.states, self._tolerances, self.why_not)

    @property
    def compiled(self) -> bool:
        """Whether it runs as formulas, without Python."""
        return self._equations is not None

    @property
    def equations(self) -> Equations:
        """Its formulas. A system without them raises :class:`TracingError`, which says why."""
        if self._equations is None:
            raise TracingError(f"the system has no formulas: {self.why_not}")
        return self._equations

    def with_parameters(self, **values: float) -> System:
        """The same system with other values of parameters."""
        own = object.__new__(System)
        own.__dict__.update(self.__dict__)
        own.parameters = self._parameters(values)
        if self._equations is not None:
            own._equations = self._equations.with_parameters(list(own.parameters.items()))
        return own

    def run(
        self,
        start: ArrayLike,
        time: float | tuple[float, float],
        *,
        mode: str | None = None,
        t: ArrayLike | None = None,
        events: int = _MOST_EVENTS,
        parameters: Mapping[str, float] | None = None,
    ) -> Run:
        """The run from a state, up to a time (from 0 on) or between two times, and to a number of events.

        ``mode`` is the first one, if the system has several; ``t`` has times at which states are wanted; ``parameters`` other values of some parameters.
        An error after some arcs has the :class:`Run` up to there as its attribute ``run``.
        """
        if parameters:
            return self.with_parameters(**parameters).run(start, time, mode=mode, t=t, events=events)
        begin, end = _span(time)
        state = numbers(start).ravel()
        if len(state) != len(self.states):
            raise InputError(f"the state has {len(self.states)} components ({', '.join(self.states)}), not {len(state)}")
        mode = self._first_mode(mode)
        if self._equations is not None:
            solution: Any = self._equations.run(mode, state, (begin, end), events)
        else:
            assert self._callbacks is not None
            solution = self._callbacks.run(mode, state, (begin, end), events, self.parameters)
        run = Run(self.states, solution, _asked(t, begin, end))
        error = solution.error
        if error is not None:
            error.run = run
            raise error
        return run

    def fates(
        self,
        starts: ArrayLike,
        time: float | tuple[float, float],
        *,
        mode: str | Sequence[str] | None = None,
        events: int = _MOST_EVENTS,
        parameters: Mapping[str, ArrayLike] | None = None,
        threads: int | None = None,
        progress: Callable[[int, int], Any] | bool | None = None,
    ) -> Fates:
        """How the run of each of many starts ends: in parallel, with the same bits for any number of threads.

        ``starts`` has one start a row. ``parameters`` may have an array for a parameter: one value for each start; one start is repeated for all of
        them. ``progress`` is a function of (done, all), or True for a bar of tqdm.
        """
        begin, end = _span(time)
        threads = threads_of(threads)
        rows = np.atleast_2d(numbers(starts))
        changed = {name: numbers(value) for name, value in (parameters or {}).items()}
        self._parameters({name: 0.0 for name in changed})
        try:
            shape = np.broadcast_shapes((rows.shape[0],), *(value.shape for value in changed.values()))
        except ValueError:
            sizes = {name: value.shape for name, value in changed.items()}
            raise InputError(f"{rows.shape[0]} starts and parameters of the shapes {sizes} do not fit together") from None
        rows = np.broadcast_to(rows, (shape[0], rows.shape[1]))
        if rows.shape[1] != len(self.states):
            raise InputError(f"a start has {len(self.states)} components ({', '.join(self.states)}), not {rows.shape[1]}")
        modes = [mode] * shape[0] if mode is None or isinstance(mode, str) else list(mode)
        modes = [self._first_mode(own) for own in modes]
        if len(modes) != shape[0]:
            raise InputError(f"{len(modes)} modes are given for {shape[0]} starts")
        values = [list(row) for row in zip(*(np.broadcast_to(value, shape).tolist() for value in changed.values()))]
        if self._callbacks is not None:
            given = [dict(zip(changed, own)) for own in values] if changed else [{}] * len(rows)
            runs = [(mode, row, self._parameters(own)) for mode, row, own in zip(modes, rows, given)]
            return _fates(self._callbacks.fates(runs, (begin, end), events, threads, progress), len(self.states))
        found = self._equations.fates(
            modes, rows.tolist(), (begin, end), events, list(changed), values, threads, progress
        )
        return _fates([found.reasons, found.surfaces, found.modes, found.times, found.events, found.states], len(self.states))

    def steps(
        self,
        time: float | tuple[float, float],
        *,
        modes: Sequence[str] | None = None,
        ends: Sequence[str] | None = None,
        parameters: Mapping[str, float] | None = None,
    ) -> Steps:
        """The flow over a time as a map of states, for attractors and basins: over a period of the forcing, if the system has one.

        With several modes the number of the mode in ``modes`` is the last coordinate. An orbit that ends at a surface has the label 65001, 65002, … of the
        surface's place in ``ends``: by default those of all guards with ``terminal=True``, in their order.
        """
        begin, end = _span(time)
        equations = (self.with_parameters(**parameters) if parameters else self).equations
        names = list(modes) if modes is not None else self.modes
        return _native.Steps.of_flow(equations, names, (begin, end), self._ends if ends is None else _names(ends))

    def returns(
        self,
        to: str,
        *,
        coordinates: Sequence[str],
        start: FunctionOrFormulas | None = None,
        image: FunctionOrFormulas | None = None,
        parameter: str | None = None,
        mode: str | None = None,
    ) -> ReturnMap:
        """The map from a section to the next event of the guard ``to``.

        ``coordinates`` are the names of the section's coordinates. By default a return starts at the state with these components, and zeros, and its image has
        these components of the state after the event. ``start`` f(t, q, p) gives the state of a point q, and after it perhaps the time of the start; ``image``
        f(t, x, p) gives the coordinates of a state. ``mode`` is that of the start, ``parameter`` the one that may change: the first one by default.
        """
        equations = self.equations
        if not self.parameters:
            raise InputError("a return map depends on a parameter, and the system has none: give it one, parameters={...}")
        name = next(iter(self.parameters)) if parameter is None else parameter
        self._parameters({name: 0.0})
        if to not in self._surfaces:
            raise InputError(f"there is no guard {to!r}; the guards are: {', '.join(self._surfaces) or 'none'}")
        coordinates = name_list(coordinates)
        section = Model(coordinates, self.parameters)
        begin = None if start is None else section.formulas("the start of a return", start).texts
        after = None if image is None else Model(self.states, self.parameters).formulas("the image", image).texts
        native = _native.ReturnMap(equations, name, self._first_mode(mode), to, coordinates, begin, after)
        return ReturnMap(native, name, self.parameters[name])

    def _first_mode(self, mode: str | None) -> str:
        if mode is None:
            if len(self.modes) > 1:
                raise InputError(f"the system has several modes: give mode=, one of {', '.join(self.modes)}")
            return self.modes[0]
        if mode not in self.modes:
            raise InputError(f"there is no mode {mode!r}; the modes are: {', '.join(self.modes)}")
        return mode

    def _check_parameters(self, names: Iterable[str]) -> None:
        for name in names:
            if name not in self.parameters:
                known = ", ".join(self.parameters) or "none"
                raise InputError(f"there is no parameter {name!r}; the parameters are: {known}")

    def _parameters(self, changed: Mapping[str, float]) -> dict[str, float]:
        self._check_parameters(changed)
        return {**self.parameters, **{name: float(value) for name, value in changed.items()}}

    def __getstate__(self) -> dict[str, Any]:
        if self._equations is None:
            raise TypeError(
                f"cannot pickle a System without formulas, as it holds functions: {self.why_not}; make it again where it is"
                " needed"
            )
        return dict(self.__dict__)

    def __repr__(self) -> str:
        how = "compiled" if self.compiled else "by callbacks"
        return f"System(states={self.states!r}, parameters={self.parameters!r}, modes={self.modes!r}, {how})"


def _span(time: float | tuple[float, float]) -> tuple[float, float]:
    """Both ends of a time: it begins at 0, unless the caller gives two."""
    if np.ndim(time) == 0 and isinstance(time, (int, float, np.number)):
        return 0.0, float(time)
    ends = np.ravel(np.asarray(time))
    if ends.shape != (2,):
        raise InputError(f"time= is the end of a run, or a pair of its start and end, not {time!r}")
    return float(ends[0]), float(ends[1])


def _tolerances(tolerance: Any, absolute: Any, longest_step: float, dimension: int) -> dict[str, Any]:
    found: dict[str, Any] = {"longest_step": float(longest_step)}
    absolute = tolerance if absolute is None else absolute
    for argument, name, given in (("tolerance", "relative", tolerance), ("absolute", "absolute", absolute)):
        each = [float(part) for part in np.ravel(numbers(given))]
        if np.ndim(given) == 1:
            if len(each) != dimension:
                raise InputError(f"{argument}= has {len(each)} tolerances for {dimension} components")
            if not all(part > 0.0 for part in each):
                raise InputError(f"{argument}= must be positive for each component, not {each}")
            found[f"{name}_each"] = each
        # Of a list the smallest one chooses the order of the steps.
        found[name] = min(each)
    for name in ("relative", "absolute"):
        if not 0.0 < found[name] <= 0.1:
            raise InputError(f"the {name} tolerance must be positive and at most 0.1, not {found[name]!r}")
    if not found["longest_step"] > 0.0:
        raise InputError(f"longest_step must be positive, not {longest_step!r}")
    return found


def _asked(t: ArrayLike | None, begin: float, end: float) -> Any:
    """The times at which states are wanted, within those of the run."""
    if t is None:
        return None
    times = numbers(t).ravel()
    low, high = min(begin, end), max(begin, end)
    outside = times[~((low <= times) & (times <= high))]
    if len(outside):
        raise InputError(f"t= has the time {float(outside[0])!r}, and the run goes from {begin!r} to {end!r}")
    return times


def _fates(columns: list[Any], dimension: int) -> Fates:
    """The fates of these columns, whose states may have the time behind their components."""
    reason, surface, mode = (np.array(column, dtype=str) for column in columns[:3])
    time, events, states = np.array(columns[3], dtype=float), np.array(columns[4], dtype=np.uint64), np.array(columns[5], dtype=float)
    return Fates(reason, surface, mode, time, events, states.reshape(len(reason), -1)[:, :dimension] if len(reason) else np.empty((0, dimension)))
