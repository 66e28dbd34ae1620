"""The old name of :mod:`nonsmooth.hybrid`."""

import warnings

from nonsmooth.hybrid import *  # noqa: F403
from nonsmooth.hybrid import __all__  # noqa: F401

warnings.warn(
    "passive_hopper.hybrid is now nonsmooth.hybrid; the old name works in this release only",
    DeprecationWarning,
    stacklevel=2,
)
