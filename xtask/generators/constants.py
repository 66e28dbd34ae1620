"""The committed constants of the Rust sources, found by their names wherever they stand."""

import re
from typing import Callable, NamedTuple

CONSTANTS = ()
