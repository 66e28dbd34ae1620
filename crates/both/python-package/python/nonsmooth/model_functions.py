"""The functions of a model, as the user gave them, and the equations that they become."""

from __future__ import annotations

import json
from typing import Any

from ._native import Equations
from .c_functions import c_function, is_c_function
from .errors import InputError, TracingError
from .surfaces import Clock, Guard
from .tracing import Model


class Functions:
    """The functions of a system, as the user gave them."""

    def __init__(self, fields: dict[str, Any], guards: list[Any], rests: dict[str, Any], args: tuple[Any, ...]) -> None:
        for guard in guards:
            if not isinstance(guard, (Guard, Clock)):
                raise TypeError(f"guards are of nonsmooth.Guard and Clock, not {type(guard).__name__}")
        names = [guard.name for guard in guards]
        twice = {name for name in names if names.count(name) > 1}
        if twice:
            raise InputError(f"two guards are named {sorted(twice)[0]!r}: an event could not be told")
        for guard in guards:
            for mode in [*(guard.modes or []), *([guard.to] if guard.to is not None else [])]:
                if mode not in fields:
                    raise InputError(f"{guard.name!r} names the mode {mode!r}; the modes are: {', '.join(fields)}")
        self.fields, self.guards, self.args = fields, guards, args
        self.rests = {mode: (to, None) if isinstance(to, str) else tuple(to) for mode, to in rests.items()}
        for mode in [*self.rests, *(to for to, _ in self.rests.values())]:
            if mode not in fields:
                raise InputError(f"rests= names the mode {mode!r}; the modes are: {', '.join(fields)}")

    def of(self, given: Any) -> Any:
        """The function f(t, x, p) of a function with further arguments."""
        args = self.args
        if is_c_function(given):
            if args:
                raise InputError("args= are further arguments of functions of Python: a function of C has its numbers in parameters=")
            return c_function(given)
        if not args or not callable(given):
            return given
        return lambda t, x, p: given(t, x, *args) if not len(p) else given(t, x, p, *args)

    def equations(self, model: Model, tolerances: dict[str, Any]) -> Equations:
        guards = [guard for guard in self.guards if isinstance(guard, Guard)]
        given = [*self.fields.values(), *(guard.function for guard in guards), *(guard.only_where for guard in guards)]
        given += [*(surface.reset for surface in self.guards), *(reset for _, reset in self.rests.values())]
        if any(is_c_function(own) for own in given):
            raise TracingError("a function of C is called, and has no formulas")

        def part(what: str, given: Any) -> Any:
            whole = json.loads(model.formulas(what, self.of(given)).json)
            return {"parts": whole["parts"], "outputs": whole["outputs"]}

        def jump(what: str, surface: Any) -> dict[str, Any]:
            found: dict[str, Any] = {}
            if surface.to is not None:
                found["mode"] = surface.to
            if surface.reset is not None:
                found["state"] = part(f"the reset of {what}", surface.reset)
            return found

        def guard(surface: Any) -> dict[str, Any]:
            what = repr(surface.name)
            found: dict[str, Any] = {"surface": surface.name, "touch": "error", "direction": "either"}
            if isinstance(surface, Clock):
                found["role"] = "clock"
                if surface.times is not None:
                    found["times"], times = "listed", [float(time) for time in surface.times]
                else:
                    period = float(surface.period)  # type: ignore[arg-type]
                    times = [period if surface.first is None else float(surface.first), period]
                found["function"] = part(f"the times of {what}", lambda t, x, p: times)
            else:
                found.update(direction=surface.direction, role=surface.role, touch=surface.touch)
                found["function"] = part(f"the guard {what}", surface.function)
                if surface.only_where is not None:
                    found["condition"] = part(f"the condition of {what}", surface.only_where)
                    found["role"] = "crossing" if surface.role == "switch" else surface.role
            if not surface.terminal:
                found["jump"] = jump(what, surface)
            return found

        # Once for all modes: each function is traced, and compared with its formulas.
        guards = [(surface.modes, guard(surface)) for surface in self.guards]
        modes = []
        for mode, field in self.fields.items():
            what = "the field" if len(self.fields) == 1 else f"the field of {mode!r}"
            own: dict[str, Any] = {"name": mode, "field": part(what, field)}
            own["guards"] = [found for named, found in guards if named is None or mode in named]
            if mode in self.rests:
                to, reset = self.rests[mode]
                own["after_limit"] = {"mode": to}
                if reset is not None:
                    own["after_limit"]["state"] = part(f"the rest of {mode!r}", reset)
            modes.append(own)
        names = {"states": model.states, "parameters": [[name, repr(value)] for name, value in model.parameters.items()]}
        whole = {"format": "hybrid equations", "version": 1, **names, "everywhere": [], "modes": modes}
        return Equations(json.dumps(whole), **tolerances)
