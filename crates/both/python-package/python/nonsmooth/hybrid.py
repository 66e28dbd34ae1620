"""Hybrid systems: flows that are interrupted by events, given by Python functions.

The search for events is that of the Rust crate ``hybrid-system``: each crossing says how certain it is that none came
before, infinitely many events in finite time (Zeno) end in their limit, and what rounding hides raises
:class:`UndecidedError`.

>>> from nonsmooth.hybrid import Guard, HybridSystem
>>> room = HybridSystem(
...     field=lambda heater, x: [30 - x[0]] if heater == "on" else [10 - x[0]],
...     guards=[
...         Guard("warm", lambda x: x[0] - 21, "rising", modes=["on"], reset=lambda heater, x: ("off", x)),
...         Guard("cold", lambda x: x[0] - 19, "falling", modes=["off"], reset=lambda heater, x: ("on", x)),
...     ],
... )
>>> [arc.event.surface for arc in room.run([15], mode="on", time=1.2) if arc.event]
['warm', 'cold', 'warm', 'cold']

With ``slide="filippov"`` a motion goes on along a surface at which the fields on both sides point:

>>> relay = HybridSystem(
...     field=lambda sign, x: [0.3 - sign],
...     guards=[
...         Guard("up", lambda x: x[0], "rising", modes=[-1], reset=lambda sign, x: (1, x)),
...         Guard("down", lambda x: x[0], "falling", modes=[1], reset=lambda sign, x: (-1, x)),
...     ],
...     slide="filippov",
... )
>>> run = relay.run([0.7], mode=1, time=5)
>>> [arc.end for arc in run][-1], run.mode.surface, run.state.tolist()
('time limit', 'down', [0.0])

:func:`sensitivity` and :func:`event_sensitivity` give the derivatives of states and event times by the start.
"""

from .errors import UndecidedError
from ._native import (
    Arc,
    Clock,
    Event,
    Execution,
    Guard,
    HybridSystem,
    QuasiPolynomial,
    Sliding,
    SlidingMode,
    Zeno,
    event_sensitivity,
    sensitivity,
)

__all__ = [
    "Arc",
    "Clock",
    "Event",
    "Execution",
    "Guard",
    "HybridSystem",
    "QuasiPolynomial",
    "Sliding",
    "SlidingMode",
    "UndecidedError",
    "Zeno",
    "event_sensitivity",
    "sensitivity",
]
