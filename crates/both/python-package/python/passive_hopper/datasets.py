"""Basins as an xarray.Dataset, in memory or in a Zarr store on disk."""

from __future__ import annotations

import hashlib
import operator
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nonsmooth.errors import InputError
from nonsmooth import _native
from nonsmooth._conventions import CONVENTIONS, complete, flag_attributes

if TYPE_CHECKING:
    import distributed
    import xarray


def basins(
    M: tuple[float, float] = (0.1, 1.0),
    alpha: tuple[float, float] | None = None,
    shape: tuple[int, int] = (512, 512),
    progress: Callable[[int, int], Any] | bool | None = None,
    store: str | os.PathLike[str] | None = None,
    client: distributed.Client | None = None,
    layer: str = "label",
) -> xarray.Dataset:
    """The basins over a window of (M, α), as an ``xarray.Dataset`` with the dimensions ``M`` and ``alpha``.

    ``alpha`` is the window of the paper, from α*_1 to α*_6, unless given. Each label is the fate of its pixel's middle.
    The variable ``label`` has the attributes ``flag_values`` and ``flag_meanings`` of the CF conventions. Another
    ``layer`` of ``layers()`` has its own variable: ``hops`` until the fate is known, or ``proof``, whose labels say
    whether the fate is proved. ``progress(done, all)`` counts columns; ``progress=True`` shows a bar of tqdm.

    >>> from passive_hopper import basins
    >>> found = basins(shape=(8, 8))
    >>> found["label"].dims
    ('M', 'alpha')

    With ``store``, a folder such as ``"basins.zarr"``, the labels are written to it region by region, in the format
    Zarr 3, and the Dataset reads them from there. A call that was interrupted, or killed, goes on where it was. A store
    of another job is refused. A store without the attribute ``sha256`` is not finished. ``open_basins`` reads a finished one from anywhere, and compares it with
    its digest.

    With ``client``, a ``dask.distributed.Client``, the workers of its cluster compute and write the regions. They need
    the folder at the same path. Workers may be lost: their regions are computed again.
    """
    import_xarray("basins", "basin_labels gives the same as arrays.")
    # Numbers of NumPy, and integers, are the same job as floats.
    M = tuple(float(end) for end in M)
    alpha = tuple(float(end) for end in (_native.first_window() if alpha is None else alpha))
    shape = tuple(operator.index(side) for side in shape)
    layer = layer_of(layer)["key"]
    if any(side < 1 for side in shape):
        raise InputError(f"a raster has at least one pixel across and up, not {shape}")
    for name, window in (("M", M), ("alpha", alpha)):
        if not 0 <= window[0] < window[1] < float("inf"):
            raise InputError(
                f"{name}={window!r} is no window: give its lower and its upper end, not negative and finite"
            )
    for name, window, values in zip(("M", "alpha"), (M, alpha), _native.pixel_middles((M, alpha), shape)):
        if len(values) > 1 and not (values[1:] > values[:-1]).all():
            raise InputError(
                f"{name}={window!r} has fewer floats than the {len(values)} pixels across it; give a wider window or"
                " fewer pixels"
            )
    if store is not None:
        if client is not None and not callable(getattr(client, "submit", None)):
            raise TypeError(f"client is a dask.distributed.Client, not {client!r}")
        from .stores import write_basins

        return write_basins(store, (M, alpha, shape, layer), client=client, progress=progress)
    if client is not None:
        raise InputError("the workers of a client write into a store: give store='….zarr' as well")
    _, _, numbers = _native.basin_labels(M=M, alpha=alpha, shape=shape, progress=progress, layer=layer)
    import numpy

    return dataset((M, alpha, shape, layer), numbers, numpy.unique(numbers), hashlib.sha256(numbers).hexdigest())


def import_xarray(name, other):
    """xarray, or an ImportError that says what to install."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError(f"{name} needs xarray: pip install 'passive-hopper[xarray]'. {other}") from error
    return xarray


def layer_of(key):
    """The entry of a layer of numbers."""
    found = [layer for layer in _native.layers() if layer["key"] == key and layer["dtype"] is not None]
    if not found:
        known = "', '".join(layer["key"] for layer in _native.layers() if layer["dtype"] is not None)
        raise InputError(f"there is no layer {key!r} of numbers; there are '{known}'")
    return found[0]


def coordinates(M, alpha, shape, layer):
    """The coordinates of a raster: names, values and attributes."""
    ratios, speeds = _native.pixel_middles((M, alpha), shape)
    return {
        "M": (ratios, {"long_name": "mass ratio m2/m1", "units": "1"}),
        "alpha": (speeds, {"long_name": "lift-off speed, in units of m2 g omega/k", "units": "1"}),
    }


def job_attributes(M, alpha, shape, layer):
    """The attributes that say which job it is: the same for the same numbers."""
    # The first layer is not named: its stores are older than the others.
    named = "" if layer == _native.layers()[0]["key"] else f", layer={layer!r}"
    return {
        "Conventions": CONVENTIONS,
        "title": "basins of a passive hopper",
        "source": f"passive_hopper {_native.__version__}",
        "computation": int(_native.RASTER_VERSION),
        "command": f"passive_hopper.basins(M={M!r}, alpha={alpha!r}, shape={shape!r}{named})",
        # Without a date: the same call gives the same file.
        "history": f"computed by passive_hopper {_native.__version__}",
    }


def number_attributes(layer, numbers):
    """The attributes of the numbers that occur; without any, those of numbers that are not there yet."""
    import numpy

    own = layer_of(layer)
    if not own["fates"]:
        return {"long_name": own["about"], "units": "1"}
    if not len(numbers):
        return {"long_name": own["name"]}
    codes = numpy.array(sorted(numbers), dtype=own["dtype"])
    flag = own["columns"][1:]
    # A label with a flag has a bit above its code.
    words = [
        " ".join([_native.label_name(int(code) & 0xFFFF), *(flag if code >> 16 else [])]) for code in codes.tolist()
    ]
    return flag_attributes(codes, words, own["name"])


def dataset(job, numbers, occurring, sha256):
    """A raster in memory."""
    import xarray

    return complete(
        xarray.Dataset(
            {job[3]: (("M", "alpha"), numbers, number_attributes(job[3], occurring))},
            coords={name: (name, *own) for name, own in coordinates(*job).items()},
            attrs=job_attributes(*job) | {"sha256": sha256},
        )
    )
