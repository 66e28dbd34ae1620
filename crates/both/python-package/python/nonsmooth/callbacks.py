"""Runs of a model whose functions are called: the time is the last component of its state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._native import CFunction, Event
from ._progress import function_of
from .c_functions import c_function, is_c_function
from .errors import ComputationError, InputError
from .model_functions import Functions
from .surfaces import Clock, Guard
from .tracing import Parameters

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Callbacks:
    """A system whose functions are called: the time is the last component of its state."""

    def __init__(
        self, functions: Functions, states: list[str], tolerances: dict[str, Any], why_not: str | None
    ) -> None:
        if "absolute_each" in tolerances or "relative_each" in tolerances or tolerances["absolute"] != tolerances["relative"]:
            raise InputError("tolerances for each component, and another absolute one, need formulas")
        for guard in functions.guards:
            if isinstance(guard, Guard) and guard.only_where is not None:
                raise InputError(f"only_where of {guard.name!r} needs formulas")
        for what, given in [
            *((f"the field of {mode!r}", field) for mode, field in functions.fields.items()),
            *((f"the guard {guard.name!r}", guard.function) for guard in functions.guards if isinstance(guard, Guard)),
            *((f"the reset of {guard.name!r}", guard.reset) for guard in functions.guards if guard.reset is not None),
        ]:
            if not callable(given) and not is_c_function(given):
                raise TypeError(f"{what} is no function, and there are no formulas ({why_not}): give functions of Python or C for all")
            if is_c_function(given):
                # Another signature is an error here, not in a run.
                c_function(given)
        self.functions, self.states, self.tolerances = functions, states, tolerances

    def run(
        self, mode: str, start: NDArray[np.float64], times: tuple[float, float], events: int, parameters: dict[str, float]
    ) -> CallbackSolution:
        system = self._system(Parameters(list(parameters), list(parameters.values())))
        begin = [*start, times[0]]
        if self._is_in_c():
            arcs, stop, end, error = self._in_c(system).arcs((mode, begin, list(parameters.values())), times, events)
            return CallbackSolution(arcs, stop, end, error)
        execution = system.run(begin, time=times[1], mode=mode, events=events, start_time=times[0])
        arcs, error = [], None
        try:
            arcs.extend(execution)
        except Exception as raised:
            error = raised
        return CallbackSolution(arcs, execution.stop, execution.time, error)

    def fates(
        self,
        starts: list[tuple[str, NDArray[np.float64], dict[str, float]]],
        times: tuple[float, float],
        events: int,
        threads: int | None,
        progress: Any,
    ) -> list[Any]:
        """How runs end, each with its mode, start and parameters: lists or arrays of the reasons, surfaces, modes, times, numbers of events and states."""
        if starts and self._is_in_c():
            system = self._system(Parameters([*starts[0][2]], [*starts[0][2].values()]))
            runs = [(mode, [*start, times[0]], [*own.values()]) for mode, start, own in starts]
            found = self._in_c(system).fates(runs, times, events, threads, progress)
            return [*found.values()]
        told, ends = function_of(progress), []
        for k, (mode, start, own) in enumerate(starts):
            try:
                ends.append(self.run(mode, start, times, events, own).fate())
            except ComputationError as error:
                # It has not moved: the state is its start, with the time behind it.
                ends.append((f"failed: {error}", "", mode, times[0], 0, np.append(start, times[0])))
            if told is not None:
                told(k + 1, len(starts))
        return [list(column) for column in zip(*ends)] if ends else [[]] * 6

    def _is_in_c(self) -> bool:
        """Whether no function is one of Python: then runs need no interpreter."""
        surfaces = self.functions.guards
        given = [*self.functions.fields.values(), *(own.function for own in surfaces if isinstance(own, Guard))]
        resets = [own.reset for own in surfaces if own.reset is not None]
        return not self.functions.rests and all(is_c_function(own) for own in [*given, *resets])

    def _in_c(self, system: Any) -> Any:
        """The same system without Python."""

        def surface(own: Any) -> Any:
            value = self.functions.of(own.function) if isinstance(own, Guard) else None
            reset = None if own.reset is None else self.functions.of(own.reset)
            observes = not own.terminal and own.reset is None and own.to is None
            return value, reset, own.to, own.terminal, observes

        fields = [(mode, self.functions.of(field)) for mode, field in self.functions.fields.items()]
        return _native.CSystem(system, fields, [surface(own) for own in self.functions.guards])

    def _system(self, p: Parameters) -> Any:
        dimension = len(self.states)

        def of(given: Any, results: int = dimension) -> Any:
            own = self.functions.of(given)
            if not isinstance(own, CFunction):
                return own
            return lambda t, x, p: own(t, x, [*p], results)

        fields = {mode: of(field) for mode, field in self.functions.fields.items()}
        in_c = [(mode, self.functions.of(field)) for mode, field in self.functions.fields.items()]

        def field(mode: str, x: Any) -> list[Any]:
            return [*np.ravel(fields[mode](x[-1], x[:-1], p)), 1.0]

        def reset(surface: Any) -> Any:
            if surface.terminal:
                return (lambda mode, x: None) if isinstance(surface, Clock) else None
            own = None if surface.reset is None else of(surface.reset)

            def jump(mode: str, x: Any) -> tuple[str, Any]:
                state = x if own is None else [*np.ravel(own(x[-1], x[:-1], p)), x[-1]]
                return (surface.to if surface.to is not None else mode, state)

            return jump

        def native(surface: Any) -> Any:
            modes = None if surface.modes is None else list(surface.modes)
            if isinstance(surface, Clock):
                times = None if surface.times is None else [float(time) for time in surface.times]
                first = 0.0 if surface.period is None else surface.period if surface.first is None else surface.first
                return _native.Clock(
                    surface.name, times=times, period=surface.period, first=first, reset=reset(surface), modes=modes
                )
            own, in_c = of(surface.function, 1), self.functions.of(surface.function)

            def plain(x: Any) -> Any:
                found = own(x[-1], x[:-1], p)
                # A list of one number is one, as for formulas.
                return found[0] if isinstance(found, (list, tuple, np.ndarray)) and np.size(found) == 1 else found

            value: Any = plain
            if isinstance(in_c, CFunction):
                value = _native.CGuard(in_c, [*p])
            observes = not surface.terminal and surface.reset is None and surface.to is None
            role: Any = "terminal" if surface.terminal else "observer" if observes else surface.role
            return _native.Guard(
                surface.name,
                value,
                surface.direction,
                reset=None if observes else reset(surface),
                role=role,
                touch=surface.touch,
                modes=modes,
            )

        def rest(mode: str, x: Any) -> Any:
            if mode not in self.functions.rests:
                return None
            to, own = self.functions.rests[mode]
            return (to, x if own is None else [*np.ravel(of(own)(x[-1], x[:-1], p)), x[-1]])

        return _native.HybridSystem(
            field=_native.CField(in_c, [*p]) if all(isinstance(own, CFunction) for _, own in in_c) else field,
            guards=[native(surface) for surface in self.functions.guards],
            rest=rest if self.functions.rests else None,
            tolerance=self.tolerances["relative"],
            longest_step=self.tolerances["longest_step"],
        )


class CallbackSolution:
    """A run by callbacks, with what a Solution of formulas has."""

    def __init__(self, arcs: list[Any], stop: str | None, end: float, error: Exception | None) -> None:
        if error is not None and not arcs:
            raise error
        self.arcs, self.error = arcs, error
        self.stop: str = stop or "failed"
        self.times = (arcs[0].time, end)

    @property
    def events(self) -> list[Event]:
        return [arc.event for arc in self.arcs if arc.event is not None]

    def states(self, times: Any, /) -> Any:
        return _native.arc_states(self.arcs, times)

    def trajectory(self, grid: Any, /) -> Any:
        return _native.arc_trajectory(self.arcs, grid)

    def fate(self) -> tuple[Any, ...]:
        """How it ended: the reason, the surface, the mode, the time, the number of events and the state.

        An exception of a function of the user passes through; a run that cannot go on has failed.
        """
        if self.error is not None and not isinstance(self.error, ComputationError):
            raise self.error
        reason = self.stop if self.error is None else f"failed: {self.error}"
        surface = self.events[-1].surface if self.stop == "terminal" else ""
        rows = self.trajectory([self.times[0]])
        return reason, surface, str(rows["modes"][-1]), rows["times"][-1], len(self.events), rows["states"][-1]
