"""Hybrid systems: flows that are interrupted by events, given by Python functions.

The search for events is that of the Rust crate ``hybrid-system``: each crossing says how certain it is that none came before, infinitely many
events in finite time (Zeno) end in their limit, and what rounding hides raises :class:`UndecidedError`.

>>> from passive_hopper.hybrid import Guard, HybridSystem
>>> room = HybridSystem(
...     field=lambda heater, x: [30 - x[0]] if heater == "on" else [10 - x[0]],
...     guards=[
...         Guard("warm", lambda x: x[0] - 21, "rising", modes=["on"], reset=lambda heater, x: ("off", x)),
...         Guard("cold", lambda x: x[0] - 19, "falling", modes=["off"], reset=lambda heater, x: ("on", x)),
...     ],
... )
>>> [arc.event.surface for arc in room.run([15], mode="on", time=1.2) if arc.event]
['warm', 'cold', 'warm', 'cold']
"""

from ._native import (
    Arc,
    Clock,
    Event,
    Execution,
    Guard,
    HybridSystem,
    QuasiPolynomial,
    Sliding,
    UndecidedError,
    Zeno,
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
    "UndecidedError",
    "Zeno",
]
