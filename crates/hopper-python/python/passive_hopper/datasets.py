"""Basins as an xarray.Dataset."""

from . import _native


def basins(M=(0.1, 1.0), alpha=None, shape=(512, 512), progress=None):
    """The basins over a window of (M, α), as an ``xarray.Dataset`` with the dimensions ``M`` and ``alpha``.

    The arguments are those of :func:`basin_labels`. The variable ``label`` has the attributes ``flag_values`` and
    ``flag_meanings`` of the CF conventions.

    >>> from passive_hopper import basins
    >>> found = basins(shape=(8, 8))
    >>> found["label"].dims
    ('M', 'alpha')
    """
    try:
        import xarray
    except ImportError as error:
        raise ImportError(
            "basins needs xarray: pip install 'passive-hopper[xarray]'. basin_labels gives the same as arrays."
        ) from error
    import numpy

    ratios, speeds, labels = _native.basin_labels(M=M, alpha=alpha, shape=shape, progress=progress)
    codes = numpy.unique(labels)
    meanings = [_native.label_name(int(code)).replace(" ", "_") for code in codes]
    attributes = {
        "long_name": "fate",
        "flag_values": codes,
        "flag_meanings": " ".join(meanings),
    }
    return xarray.Dataset(
        {"label": (("M", "alpha"), labels, attributes)},
        coords={
            "M": ("M", ratios, {"long_name": "mass ratio m2/m1", "units": "1"}),
            "alpha": ("alpha", speeds, {"long_name": "lift-off speed", "units": "m2 g omega/k"}),
        },
        attrs={"source": f"passive_hopper {_native.__version__}", "title": "basins of a passive hopper"},
    )
