"""Hybrid systems: motions that events interrupt, their events, return maps, attractors and basins.

A model is written once, as functions f(t, x, p) with NumPy's functions. They become formulas: a run needs no Python, no event of its motion is
missed, and derivatives are exact.

>>> import numpy as np
>>> import nonsmooth as ns
>>> pendulum = ns.System(lambda t, x, p: [x[1], -np.sin(x[0]) - p.damping * x[1]], states="angle speed", parameters={"damping": 0.1})
>>> run = pendulum.run([3, 0], time=50)
>>> round(float(run.sol(50)[0]), 6)
0.149956
"""

import os as _os

from . import _native, hybrid, labelling, plots
from ._native import Equations, Event, Formulas, Steps, Zeno, __version__
from .along import AttractorsAlong, Change, Unresolved, attractors_along
from .basins import attractors_by_features, attractors_of, basins_of, known_attractors, map_steps
from .boundaries import Boundary, EdgeTrack, FatalShock, boundary_between, minimal_fatal_shock, track_edge
from .c_functions import c_function
from .errors import ComputationError, InputError, NonsmoothError, TracingError, UndecidedError
from .proofs import (
    Multiplier,
    ProvedBasins,
    ProvedEvent,
    ProvedOrbit,
    ProvedTrap,
    proved_basins,
    proved_orbit,
)
from .returns import Bifurcation, Branch, Diagram, Image, Linearized, PeriodicPoint, ReturnMap
from .runs import Fates, Run
from .stability import Shock, Stability, Tipping, stability_of, tipping
from .surfaces import Clock, Guard
from .systems import System
from .tracing import Parameters

# A child of fork has none of the threads of its parent: it gets its own.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_native.after_fork)

__all__ = [
    "AttractorsAlong",
    "Bifurcation",
    "Boundary",
    "Branch",
    "Change",
    "Clock",
    "ComputationError",
    "Diagram",
    "EdgeTrack",
    "Equations",
    "Event",
    "FatalShock",
    "Fates",
    "Formulas",
    "Guard",
    "Image",
    "InputError",
    "Linearized",
    "Multiplier",
    "NonsmoothError",
    "Parameters",
    "PeriodicPoint",
    "ProvedBasins",
    "ProvedEvent",
    "ProvedOrbit",
    "ProvedTrap",
    "ReturnMap",
    "Run",
    "Shock",
    "Stability",
    "Steps",
    "System",
    "Tipping",
    "TracingError",
    "UndecidedError",
    "Unresolved",
    "Zeno",
    "attractors_along",
    "attractors_by_features",
    "attractors_of",
    "basins_of",
    "boundary_between",
    "c_function",
    "hybrid",
    "known_attractors",
    "labelling",
    "map_steps",
    "minimal_fatal_shock",
    "plots",
    "proved_basins",
    "proved_orbit",
    "stability_of",
    "tipping",
    "track_edge",
]
