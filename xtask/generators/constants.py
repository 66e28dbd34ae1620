"""The committed constants that were computed: each is made again, or a choice is measured."""

from typing import Callable, NamedTuple

import first_flight
import guesses
import separations
import sines
import verner


class Constant(NamedTuple):
    name: str
    # Takes whether a sample suffices, prints what it finds, and returns the count of failures.
    verify: Callable


CONSTANTS = (
    Constant("sines", sines.verify),
    Constant("first_flight", first_flight.verify),
    Constant("guesses", guesses.verify),
    Constant("separations", separations.verify),
    Constant("verner", verner.verify),
)
