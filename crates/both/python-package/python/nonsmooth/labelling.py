"""Basins of any labelling, and the attractors of any map.

A labelling is a vectorised function: from arrays of coordinates to an array of integers. Basin n has the label n. The
codes of the other labels are those of all files and figures of this package: :data:`UNDECIDED`,
:data:`UNDECIDED_PRECISION`, :data:`UNDECIDED_MAP`, :data:`OUTSIDE`, :data:`ESCAPED`.

>>> import numpy as np
>>> from nonsmooth.labelling import label_image, region_fractions
>>> disc = lambda x, y: x**2 + y**2 < 1
>>> fractions = region_fractions(disc, [(-1, 1), (-1, 1)], count=10_000, seed=1)
>>> np.pi / 4 in fractions[1]
True
>>> x, y = np.meshgrid(np.linspace(-1, 1, 256), np.linspace(-1, 1, 256), indexing="ij")
>>> image = label_image(disc(x, y))
>>> image.boxes(8).mixed
124
>>> image.exceeds_ln_2()
False
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .errors import InputError
from . import _native
from ._conventions import about, complete, flag_attributes
from ._native import Attractors, BoxCount, Interval, LabelImage, UncertaintyExponent
from ._progress import function_of

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

__all__ = [
    "Attractors",
    "BoxCount",
    "ESCAPED",
    "Interval",
    "LabelImage",
    "OUTSIDE",
    "UNDECIDED",
    "UNDECIDED_MAP",
    "UNDECIDED_PRECISION",
    "UncertaintyExponent",
    "basins_of",
    "label_image",
    "region_fractions",
    "uncertainty_exponent",
]

_CODES = _native.label_codes()
#: The fate is not known: a budget was used up, or no reason is given.
UNDECIDED = _CODES["UNDECIDED"]
#: The fate is not known, because the arithmetic does not decide it.
UNDECIDED_PRECISION = _CODES["UNDECIDED_PRECISION"]
#: The fate is not known, because the map could not be evaluated.
UNDECIDED_MAP = _CODES["UNDECIDED_MAP"]
#: The point is outside the region of interest. No measure counts it.
OUTSIDE = _CODES["OUTSIDE"]
#: The orbit leaves for good: a known fate, and no basin of an attractor.
ESCAPED = _CODES["ESCAPED"]

#: Pixels that a labelling gets at a time: some megabytes of coordinates.
_PIXELS_AT_A_TIME = 1 << 18


def _labels(found, shape):
    """An array of uint16 of this shape. Numbers that are no labels are errors, not wrapped."""
    import numpy

    labels = numpy.asarray(found)
    if labels.dtype.kind not in "bui":
        raise TypeError(f"labels are integers or booleans, not {labels.dtype}")
    if labels.size and not (0 <= int(labels.min()) and int(labels.max()) <= 65535):
        raise InputError(f"labels are integers from 0 to 65535, not {labels.min()} to {labels.max()}")
    if shape is not None and labels.shape != shape:
        try:
            labels = numpy.broadcast_to(labels, shape)
        except ValueError:
            raise InputError(
                f"the labelling returned the shape {labels.shape} for points of the shape {shape}"
            ) from None
    return numpy.ascontiguousarray(labels, dtype=numpy.uint16)


def label_image(labels: ArrayLike | xarray.DataArray) -> LabelImage:
    """The :class:`LabelImage` of a two-dimensional array of labels, with the axes (x, y): any integers from 0 to 65535,
    or booleans."""
    labels = _labels(labels, None)
    if labels.ndim != 2:
        raise InputError(f"an image of labels has two dimensions, not {labels.ndim}")
    return LabelImage(labels)


def basins_of(
    label: Callable[..., Any],
    window: Mapping[str, tuple[float, float]],
    shape: tuple[int, int] = (512, 512),
    names: Mapping[int, str] | None = None,
    progress: Callable[[int, int], Any] | bool | None = None,
) -> xarray.Dataset:
    """The labels of a window of the plane by any labelling, as an ``xarray.Dataset``.

    ``label(x, y)`` gets two arrays of one shape, and returns the labels. ``window`` has the two coordinates with their
    ends, as ``{"x": (-2, 2), "y": (-2, 2)}``; ``names`` names labels. Each label is that of its pixel's middle.
    ``progress(done, all)`` counts columns; ``progress=True`` shows a bar of tqdm.

    >>> from nonsmooth.labelling import basins_of
    >>> found = basins_of(lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(4, 4), names={1: "above"})
    >>> found.label.dims, found.label.attrs["flag_meanings"]
    (('x', 'y'), 'basin_0 above')
    """
    import numpy

    check_window(window, names)
    xs, ys = pixels(window, shape)
    progress = function_of(progress)
    labels = numpy.empty((len(xs), len(ys)), dtype=numpy.uint16)
    for begin, end in strips(len(xs), len(ys)):
        x, y = numpy.meshgrid(xs[begin:end], ys, indexing="ij")
        labels[begin:end] = _labels(_called(label, x, y), x.shape)
        if progress is not None:
            progress(end, len(xs))
    return dataset_of(labels, window, names)


def check_window(window, names):
    """Refuses what is no window, and tells what to install for a Dataset."""
    try:
        import xarray  # noqa: F401
    except ImportError as error:
        raise ImportError(
            "basins_of needs xarray: pip install 'passive-hopper[xarray]'. A labelling of arrays needs label_image"
            " alone."
        ) from error
    if not isinstance(window, Mapping):
        raise TypeError(f"a window names its coordinates, as {{'x': (-2, 2), 'y': (-2, 2)}}, and is not {window!r}")
    if len(window) != 2:
        raise InputError(f"a window has two coordinates with their ends, not {len(window)}")
    for name in window:
        if not (isinstance(name, str) and name.isidentifier() and name != "label"):
            raise InputError(
                f"a coordinate is named by a word of letters, digits and _, other than 'label', not {name!r}"
            )
    if names is not None and not isinstance(names, Mapping):
        raise TypeError(f"names maps labels to their names, as {{1: 'above'}}, and is not {names!r}")


def pixels(window, shape):
    """The middles of the pixels of a window along both coordinates."""
    across, up = window.values()
    return _native.pixel_middles((across, up), shape)


def strips(columns, rows, parts=1):
    """The first column and the one behind the last of each strip: of as many pixels as are computed at a time, and at least so many parts."""
    width = max(1, min(_PIXELS_AT_A_TIME // rows, -(-columns // parts)))
    return [(begin, min(begin + width, columns)) for begin in range(0, columns, width)]


def dataset_of(labels, window, names):
    """An array of labels of a window as a Dataset."""
    import numpy
    import xarray

    first, second = window
    xs, ys = pixels(window, labels.shape)
    codes = numpy.unique(labels)
    names = {code: name.lower() for name, code in _CODES.items()} | (names or {})
    meanings = [str(names.get(int(code), f"basin {code}")) for code in codes]
    return complete(
        xarray.Dataset(
            {"label": ((first, second), labels, flag_attributes(codes, meanings, "basin"))},
            coords={first: (first, xs, {"long_name": first}), second: (second, ys, {"long_name": second})},
            attrs=about("basins of attraction"),
        )
    )


def region_fractions(
    label: Callable[..., Any], window: Sequence[tuple[float, float]], count: int = 10_000, seed: int = 0
) -> dict[int, Interval]:
    """The fraction of each basin in a region of any dimension, with a 95 % interval: a dictionary from labels to
    :class:`Interval`.

    ``window`` has the ends of each coordinate; ``label`` gets one array of coordinates for each, of ``count`` random
    points. Points with the label :data:`OUTSIDE` are not counted. The same seed gives the same points.
    """
    return _native.region_fractions(_flat(label), list(window), count, seed)


def uncertainty_exponent(
    label: Callable[..., Any],
    window: Sequence[tuple[float, float]],
    epsilons: Sequence[float],
    count: int = 100_000,
    seed: int = 0,
) -> UncertaintyExponent:
    """The exponent of final-state uncertainty: the fraction of pairs of points at a distance ε with different labels is
    ∝ ε^exponent.

    The dimension of the boundary is that of the space less the exponent. Points may lie outside the window by up to ε.

    >>> from nonsmooth.labelling import uncertainty_exponent
    >>> found = uncertainty_exponent(lambda x, y: x > 0.5, [(0, 1), (0, 1)], [0.1, 0.03, 0.01, 0.003])
    >>> 1 in found.exponent and found.follows_a_power_law
    True
    """
    return _native.uncertainty_exponent(_flat(label), list(window), list(epsilons), count, seed)


def _called(label, *coordinates):
    """The labels that a function gives. StopIteration would end a loop of the caller as if it were complete (PEP
    479)."""
    try:
        return label(*coordinates)
    except StopIteration as error:
        raise RuntimeError("the function label raised StopIteration") from error


def _flat(label):
    def flat(*coordinates):
        return _labels(_called(label, *coordinates), coordinates[0].shape)

    return flat
