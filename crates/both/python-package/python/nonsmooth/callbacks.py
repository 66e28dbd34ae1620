"""Runs of a model whose functions are called: the time is the last component of its state."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._native import CFunction, Event
from .c_functions import c_function, is_c_function
from .errors import InputError
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
        if "absolute_each" in tolerances or tolerances["absolute"] != tolerances["relative"]:
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
                raise TypeError(f"{what} is no function, and there are no formulas ({why_not}): give functions for all")
            if is_c_function(given):
                # Another signature is an error here, not in a run.
                c_function(given)
        self.functions, self.states, self.tolerances = functions, states, tolerances

    def run(
        self, mode: str, start: NDArray[np.float64], times: tuple[float, float], events: int, parameters: dict[str, float]
    ) -> CallbackSolution:
        p = Parameters(list(parameters), list(parameters.values()))
        dimension = len(start)

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

        system = _native.HybridSystem(
            field=_native.CField(in_c, [*p]) if all(isinstance(own, CFunction) for _, own in in_c) else field,
            guards=[native(surface) for surface in self.functions.guards],
            rest=rest if self.functions.rests else None,
            tolerance=self.tolerances["relative"],
            longest_step=self.tolerances["longest_step"],
        )
        execution = system.run([*start, times[0]], time=times[1], mode=mode, events=events, start_time=times[0])
        return CallbackSolution(execution, len(self.states))


class CallbackSolution:
    """A run by callbacks, with what a Solution of formulas has."""

    def __init__(self, execution: Any, dimension: int) -> None:
        self.arcs: list[Any] = []
        self.error: Exception | None = None
        self._dimension = dimension
        try:
            self.arcs.extend(execution)
        except Exception as error:
            if not self.arcs:
                raise
            self.error = error
        self.stop: str = execution.stop or "failed"
        self.times = (self.arcs[0].time, execution.time)

    @property
    def events(self) -> list[Event]:
        return [arc.event for arc in self.arcs if arc.event is not None]

    def states(self, times: Any, /) -> Any:
        return _native.arc_states(self.arcs, times)

    def trajectory(self, grid: Any, /) -> Any:
        return _native.arc_trajectory(self.arcs, grid)
