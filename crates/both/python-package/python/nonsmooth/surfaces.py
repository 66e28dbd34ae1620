"""What ends an arc: guards, at which a function changes its sign, and clocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from .errors import InputError

#: A function f(t, x, p) of the time, the state and the parameters; or texts, or SymPy's expressions.
FunctionOrFormulas = Callable[..., Any] | str | Sequence[Any]


@dataclass(frozen=True)
class Guard:
    """A surface: an event where g(t, x, p) changes its sign, in the given direction.

    An event with ``reset`` goes on from the state r(t, x, p), one with ``to`` in another mode, one with ``terminal=True`` ends the run. One
    without any of these is observed: it is in the events of a run, and changes nothing.

    ``modes`` are the modes in which the guard counts; all, if there are none. An event counts only where ``only_where(t, x, p)`` is positive. ``role``
    says what a reset that leads beyond the surface means: "contact" for a floor, where the next event is at once, "crossing" for a surface
    that only a crossing of the flow counts. ``touch`` says what a guard that touches 0 is: "error", "event" or "ignore".
    """

    name: str
    function: FunctionOrFormulas
    direction: Literal["rising", "falling", "either"] = "either"
    reset: FunctionOrFormulas | None = None
    to: str | None = None
    modes: Sequence[str] | None = None
    terminal: bool = False
    only_where: FunctionOrFormulas | None = None
    role: Literal["switch", "contact", "crossing"] = "switch"
    touch: Literal["error", "event", "ignore"] = "error"

    def __post_init__(self) -> None:
        for what, value, known in (
            ("direction", self.direction, ("rising", "falling", "either")),
            ("role", self.role, ("switch", "contact", "crossing")),
            ("touch", self.touch, ("error", "event", "ignore")),
        ):
            if value not in known:
                raise InputError(f"{what}={value!r} of the guard {self.name!r}: it is one of {', '.join(known)}")
        _check(self)


@dataclass(frozen=True)
class Clock:
    """Events at preset times: ``times``, or ``first`` and then after each ``period``. The rest is as in :class:`Guard`."""

    name: str
    period: float | None = None
    first: float | None = None
    times: Sequence[float] | None = None
    reset: FunctionOrFormulas | None = None
    to: str | None = None
    modes: Sequence[str] | None = None
    terminal: bool = False

    def __post_init__(self) -> None:
        if (self.times is None) == (self.period is None):
            raise InputError(f"the clock {self.name!r} has either times= or period=")
        if self.times is not None and self.first is not None:
            raise InputError(f"the clock {self.name!r} has times=, and so no first=")
        _check(self)


def _check(surface: Guard | Clock) -> None:
    if surface.terminal and (surface.reset is not None or surface.to is not None):
        raise InputError(f"{surface.name!r} ends the run: it has no reset= and no to=")
    if isinstance(surface.modes, str):
        raise TypeError(f"modes of {surface.name!r} is a list of names, not the text {surface.modes!r}")
