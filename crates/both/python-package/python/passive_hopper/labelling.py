"""The old name of :mod:`nonsmooth.labelling`."""

import warnings

from nonsmooth.labelling import *  # noqa: F403
from nonsmooth.labelling import __all__  # noqa: F401

warnings.warn(
    "passive_hopper.labelling is now nonsmooth.labelling; the old name works in this release only",
    DeprecationWarning,
    stacklevel=2,
)
