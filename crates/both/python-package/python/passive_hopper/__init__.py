"""The exact map, fates and basins of a passive hopper: two masses, one spring, plastic landings, no motor.

All dynamics is one map of the lift-off speed, α′ = f(α; M). Lengths are in units of m₂g/k, times in units of 1/ω with
ω² = k(1+M)/m₂, speeds in units of m₂gω/k. M = m₂/m₁ is the lower mass over the upper one.

The modules :mod:`passive_hopper.hybrid` and :mod:`passive_hopper.labelling` are for any hybrid system, and for the
basins of any labelling.

>>> import numpy as np
>>> from passive_hopper import LiftOffMap, alpha_star
>>> m = LiftOffMap(0.2)
>>> m(np.linspace(4.5, 20, 1000)).shape
(1000,)
>>> m.fate(4.55).name
'to α*_1'
>>> bool(np.isnan(LiftOffMap(0.8)(3.0)))
True
"""

import os as _os

from . import _native, hybrid, labelling
from ._native import (
    Bounds,
    Crisis,
    Fate,
    Hop,
    IntervalBasins,
    Landing,
    LiftOffMap,
    Trap,
    UndecidedError,
    __version__,
    alpha_star,
    basin_labels,
    crisis,
    fractions,
    grounding,
    interval_basins,
    label_colour,
    label_name,
    layers,
    motion_arrays,
    trap,
)
from .datasets import basins
from .motions import animate, motion
from .plots import cobweb, plot_basins

# A child of fork has none of the threads of its parent: it gets its own.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_native.after_fork)

__all__ = [
    "Bounds",
    "Crisis",
    "Fate",
    "Hop",
    "IntervalBasins",
    "Landing",
    "LiftOffMap",
    "Trap",
    "UndecidedError",
    "alpha_star",
    "animate",
    "basin_labels",
    "basins",
    "cobweb",
    "crisis",
    "fractions",
    "grounding",
    "hybrid",
    "interval_basins",
    "label_colour",
    "label_name",
    "labelling",
    "layers",
    "motion",
    "motion_arrays",
    "plot_basins",
    "trap",
]
