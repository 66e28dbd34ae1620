"""The old name of :mod:`nonsmooth._native`, which pickles of version 0.2 have."""

from nonsmooth._native import _restored  # noqa: F401
