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
    next_error: float | None
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
    error: float
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
    def ground(self) -> Literal["branches", "enclosures", "contact parts"]: ...
    @property
    def probes(self) -> tuple[int, int]: ...
    def fraction(self, label: int) -> Bounds: ...
    def tipping_to(self, after: IntervalBasins) -> dict[tuple[int, int], Bounds]: ...
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
    progress: Callable[[int, int], Any] | bool | None = ...,
    layer: str = "label",
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[Any]]: ...
def layers() -> list[dict[str, Any]]: ...
def interval_basins(
    mass_ratio: float,
    first: int = 1,
    last: int = 6,
    undecided: float = 1e-6,
    shortest: float = 1e-12,
    samples: int = 400,
    most: int = 100_000,
) -> IntervalBasins: ...
def fractions(
    mass_ratio: float, first: int = 1, last: int = 6, points: int = 10_000
) -> dict[str, float]: ...
def motion_arrays(alpha: float, mass_ratio: float, hops: int = 10) -> dict[str, Any]: ...
def motion_event_names() -> list[tuple[int, str]]: ...
def after_fork() -> None: ...
def animation_bytes(
    mass_ratio: float,
    times: Sequence[float],
    hops: Sequence[int],
    contact: Sequence[bool],
    states: Sequence[Sequence[float]],
    form: str = "gif",
    progress: Callable[[int, int], Any] | bool | None = None,
) -> bytes: ...
RASTER_VERSION: int

def basin_region(
    M: tuple[float, float],
    alpha: tuple[float, float],
    shape: tuple[int, int],
    columns: tuple[int, int],
    threads: int | None = None,
    progress: Callable[[int, int], Any] | bool | None = None,
    layer: str = "label",
) -> NDArray[Any]: ...
def first_window() -> tuple[float, float]: ...
def pixel_middles(
    window: tuple[tuple[float, float], tuple[float, float]], shape: tuple[int, int]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def label_codes() -> dict[str, int]: ...

class Interval:
    value: float
    lower: float
    upper: float
    def __contains__(self, number: float) -> bool: ...

class BoxCount:
    size: float
    boxes: int
    mixed: int
    open: int
    basin_entropy: float
    boundary_entropy: float | None

class LabelImage:
    def __init__(self, labels: NDArray[np.uint16]) -> None: ...
    def array(self) -> NDArray[np.uint16]: ...
    def counts(self) -> dict[int, int]: ...
    def fractions(self) -> dict[int, Interval]: ...
    def fraction_bounds(self) -> dict[int, Bounds]: ...
    def boxes(self, side: int) -> BoxCount: ...
    def exceeds_ln_2(self) -> bool: ...
    def far_from_other_boundaries(self, distance: int) -> float: ...

class UncertaintyExponent:
    exponent: Interval
    follows_a_power_law: bool
    fractions: list[tuple[float, Interval]]

class Attractors:
    def __init__(
        self,
        map: Callable[[NDArray[np.float64]], Sequence[float] | NDArray[np.float64] | None],
        *,
        region: Sequence[tuple[float, float]],
        starts: Sequence[Sequence[float]],
        cells: int = 100,
        recurrences: int = 100,
        locate: int = 1000,
        budget: int = 100_000,
        lost: int = 1000,
        tests: int = 200,
        escape: float | None = None,
        periodic: Sequence[int] = ...,
    ) -> None: ...
    @property
    def points(self) -> dict[int, NDArray[np.float64]]: ...
    @property
    def unmatched(self) -> list[tuple[list[float], str]]: ...
    @property
    def remedy(self) -> str | None: ...
    def labels(self, starts: Sequence[Sequence[float]]) -> NDArray[np.uint16]: ...

def region_fractions(
    label: Callable[..., NDArray[np.uint16]], window: Sequence[tuple[float, float]], count: int, seed: int
) -> dict[int, Interval]: ...
def uncertainty_exponent(
    label: Callable[..., NDArray[np.uint16]],
    window: Sequence[tuple[float, float]],
    epsilons: Sequence[float],
    count: int,
    seed: int,
) -> UncertaintyExponent: ...

_Mode = Any
_Vector = Sequence[float] | NDArray[np.float64]
_State = NDArray[np.float64]
_Reset = Callable[[_Mode, _State], tuple[_Mode, _Vector] | None]

class QuasiPolynomial:
    @staticmethod
    def polynomial(coefficients: Sequence[float]) -> QuasiPolynomial: ...
    @staticmethod
    def sine(amplitude: float, omega: float) -> QuasiPolynomial: ...
    @staticmethod
    def cosine(amplitude: float, omega: float) -> QuasiPolynomial: ...
    @staticmethod
    def exponential(amplitude: float, rate: float) -> QuasiPolynomial: ...
    def damped(self, rate: float) -> QuasiPolynomial: ...
    def derivative(self) -> QuasiPolynomial: ...
    def first_crossing(self, direction: str, horizon: float) -> float | None: ...
    def __call__(self, time: float) -> float: ...
    def __add__(self, other: QuasiPolynomial) -> QuasiPolynomial: ...
    def __sub__(self, other: QuasiPolynomial) -> QuasiPolynomial: ...
    def __neg__(self) -> QuasiPolynomial: ...
    def __mul__(self, other: QuasiPolynomial | float) -> QuasiPolynomial: ...
    def __rmul__(self, factor: float) -> QuasiPolynomial: ...

class Guard:
    name: str
    def __init__(
        self,
        name: str,
        value: Callable[[_State], float],
        direction: Literal["rising", "falling", "either"],
        *,
        reset: _Reset | None = None,
        role: Literal["switch", "contact", "crossing", "observer", "terminal"] = "switch",
        touch: Literal["error", "event", "ignore"] = "error",
        modes: Sequence[_Mode] | None = None,
        signal: Callable[[_Mode, _State], QuasiPolynomial | None] | None = None,
        enclosure: Callable[[_Mode, _State, int, tuple[float, float]], tuple[float, float] | None] | None = None,
    ) -> None: ...

class Clock:
    name: str
    def __init__(
        self,
        name: str,
        *,
        times: Sequence[float] | Callable[[float], float | None] | None = None,
        period: float | None = None,
        first: float = 0.0,
        reset: _Reset | None = None,
        modes: Sequence[_Mode] | None = None,
    ) -> None: ...

class Event:
    surface: str
    time: float
    time_error: float
    time_rounding: float
    at_time_limit: bool
    jump: int
    before: _State
    next_mode: _Mode | None
    after: _State | None
    kind: Literal["crossing", "touch", "at start", "clock"]
    direction: Literal["rising", "falling"] | None
    certainty: Literal["exact", "certain", "interpolated", "sampled"]

class Zeno:
    time: float
    time_error: float
    state: _State
    state_error: float
    ratio: float
    period: int
    next_mode: _Mode | None
    after: _State | None

class Sliding:
    surface: str
    below: _Mode
    above: _Mode
    time: float
    state: _State
    rates: tuple[float, float]
    field: _State | None

class SlidingMode:
    surface: str
    below: _Mode
    above: _Mode

class Arc:
    @property
    def mode(self) -> _Mode: ...
    @property
    def time(self) -> float: ...
    @property
    def jump(self) -> int: ...
    @property
    def start(self) -> _State: ...
    @property
    def duration(self) -> float: ...
    @property
    def end(self) -> Literal["event", "zeno", "sliding", "time limit", "never", "unfinished"]: ...
    @property
    def certainty(self) -> Literal["exact", "certain", "interpolated", "sampled"] | None: ...
    @property
    def event(self) -> Event | None: ...
    @property
    def zeno(self) -> Zeno | None: ...
    @property
    def sliding(self) -> Sliding | None: ...
    def states(self, elapsed: ArrayLike) -> NDArray[np.float64]: ...

class Execution:
    def __iter__(self) -> Execution: ...
    def __next__(self) -> Arc: ...
    def run_until(self, time: float) -> Execution: ...
    def trajectory(self, grid: ArrayLike) -> dict[str, Any]: ...
    @property
    def mode(self) -> _Mode: ...
    @property
    def state(self) -> _State: ...
    @property
    def time(self) -> float: ...
    @property
    def jump(self) -> int: ...
    @property
    def stop(self) -> str | None: ...

class HybridSystem:
    def __init__(
        self,
        *,
        flow: Callable[[_Mode, _State, float], _Vector] | None = None,
        field: Callable[[_Mode, _State], _Vector] | None = None,
        guards: Sequence[Guard | Clock] = (),
        rest: _Reset | None = None,
        slide: Callable[[Sliding], tuple[_Mode, _Vector] | None] | Literal["filippov"] | None = None,
        tolerance: float = 1e-10,
        longest_step: float = ...,
        check_interval: float = ...,
        sampled: float | None = None,
    ) -> None: ...
    def run(
        self, start: ArrayLike, *, time: float, mode: _Mode = None, events: int = 1_000_000, start_time: float = 0.0
    ) -> Execution: ...

def sensitivity(arcs: Sequence[Arc]) -> NDArray[np.float64]: ...
def event_sensitivity(arc: Arc) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
