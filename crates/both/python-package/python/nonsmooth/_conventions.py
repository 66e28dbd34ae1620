"""The CF conventions (climate and forecast, version 1.11) for the datasets of this package."""

import re

from . import _native
from .errors import InputError

CONVENTIONS = "CF-1.11"


def about(title):
    """The attributes of a Dataset as a whole."""
    own = f"nonsmooth {_native.__version__}"
    return {"Conventions": CONVENTIONS, "title": title, "source": own, "history": f"computed by {own}"}


def word(name):
    """A name as one word of flag_meanings: letters, digits, and _ - . + @."""
    return re.sub(r"[^A-Za-z0-9_.+@-]+", "_", name.replace("α*_", "alpha_star_")).strip("_")


def flag_attributes(codes, names, long_name):
    """The attributes of an array of flags: its codes, which have the type of the array, and a word for each."""
    import numpy

    codes = numpy.asarray(codes)
    words = [word(name) for name in names]
    for index, own in enumerate(words):
        if not own:
            raise InputError(f"the name {names[index]!r} of the label {codes[index]} has no letter or digit")
        if own in words[:index]:
            raise InputError(f"two labels are named {own!r}; give each a name of its own")
    # Lists of numbers would become int64 in a file, whatever the array has.
    return {"long_name": long_name, "flag_values": codes, "flag_meanings": " ".join(words)}


def complete(dataset):
    """The dataset, whose coordinates have no missing values, so that files say so."""
    for coordinate in dataset.coords.values():
        coordinate.encoding["_FillValue"] = None
    return dataset
