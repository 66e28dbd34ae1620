"""The exact map, fates and basins of a passive hopper: two masses, one spring, plastic landings, no motor.

All dynamics is one map of the lift-off speed, α′ = f(α; M). Lengths are in units of m₂g/k, times in units of 1/ω with
ω² = k(1+M)/m₂, speeds in units of m₂gω/k. M = m₂/m₁ is the lower mass over the upper one.

The tools for any system are in the package :mod:`nonsmooth`, which is installed with this one.

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

from nonsmooth import _native
from nonsmooth.errors import UndecidedError
from nonsmooth._native import (
    Bounds,
    Crisis,
    Fate,
    Hop,
    IntervalBasins,
    Landing,
    LiftOffMap,
    Trap,
    __version__,
    alpha_star,
    basin_labels,
    crisis,
    fractions,
    grounding,
    images,
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
from .stores import open_basins


def __getattr__(name):
    if name in ("hybrid", "labelling"):
        import importlib

        return importlib.import_module(f"passive_hopper.{name}")
    raise AttributeError(f"module 'passive_hopper' has no attribute {name!r}")


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
    "images",
    "interval_basins",
    "label_colour",
    "label_name",
    "layers",
    "motion",
    "motion_arrays",
    "open_basins",
    "plot_basins",
    "trap",
]
