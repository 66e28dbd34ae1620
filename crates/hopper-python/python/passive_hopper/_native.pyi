from collections.abc import Callable, Sequence
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class UndecidedError(ArithmeticError): ...

class Landing:
    time: float
    closing_speed: float
    excess: float
    velocity: float
    sudden: bool

class Hop:
    speed: float
    next: float | None
    loss: float | None
    next_speed_squared: float
    sudden: int
    flight_time: float
    landings: list[Landing]

class Fate:
    label: int
    name: str
    hops: int

class Trap:
    n: int
    left: float
    right: float
    length: float
    error: float
    edge: Literal["crossing", "contact end", "next fixed point"]
    def __contains__(self, alpha: float) -> bool: ...

class Crisis:
    n: int
    mass_ratio: float
    alpha: float

class Bounds:
    lower: float
    upper: float
    def __contains__(self, number: float) -> bool: ...

class LiftOffMap:
    def __init__(self, mass_ratio: float) -> None: ...
    @property
    def mass_ratio(self) -> float: ...
    @overload
    def __call__(self, alpha: float, /) -> float: ...
    @overload
    def __call__(self, alpha: ArrayLike, /) -> NDArray[np.float64]: ...
    @overload
    def images(self, alpha: ArrayLike, status: Literal[False] = False) -> NDArray[np.float64]: ...
    @overload
    def images(
        self, alpha: ArrayLike, status: Literal[True]
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8]]: ...
    def hop(self, alpha: float) -> Hop: ...
    def orbit(self, alpha: float, hops: int = 100) -> NDArray[np.float64]: ...
    def fate(self, alpha: float) -> Fate: ...
    def fates(self, alpha: ArrayLike) -> NDArray[np.uint16]: ...
    def slopes(self, alpha: float) -> tuple[float, float] | None: ...

class IntervalBasins:
    def arrays(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint16]]: ...
    def __len__(self) -> int: ...
    @property
    def window(self) -> tuple[float, float]: ...
    @property
    def undecided(self) -> float: ...
    @property
    def stop_reason(self) -> str: ...
    @property
    def ground(self) -> Literal["proved", "sampled", "contact parts"]: ...
    @property
    def probes(self) -> tuple[int, int]: ...
    def fraction(self, label: int) -> Bounds: ...
    def label(self, alpha: float) -> int | None: ...

@overload
def alpha_star(n: int) -> float: ...
@overload
def alpha_star(n: Sequence[int] | range) -> NDArray[np.float64]: ...
def trap(n: int, mass_ratio: float) -> Trap: ...
def crisis(n: int) -> Crisis: ...
def grounding(n: int) -> Crisis: ...
def label_name(label: int) -> str: ...
def label_colour(label: int) -> str: ...
def basin_labels(
    M: tuple[float, float] = ...,
    alpha: tuple[float, float] | None = ...,
    shape: tuple[int, int] = ...,
    progress: Callable[[int, int], Any] | None = ...,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint16]]: ...
def interval_basins(
    mass_ratio: float,
    first: int = 1,
    last: int = 6,
    undecided: float = 1e-6,
    shortest: float = 1e-12,
    samples: int = 400,
) -> IntervalBasins: ...
def fractions(
    mass_ratio: float, first: int = 1, last: int = 6, points: int = 10_000
) -> dict[str, float]: ...
