from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NoReturn, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

__version__: str


@final
class Symbol:
    """A part of a formula: what a function of a System sees instead of a number."""

    def __add__(self, other: object, /) -> Symbol: ...
    def __radd__(self, other: object, /) -> Symbol: ...
    def __sub__(self, other: object, /) -> Symbol: ...
    def __rsub__(self, other: object, /) -> Symbol: ...
    def __mul__(self, other: object, /) -> Symbol: ...
    def __rmul__(self, other: object, /) -> Symbol: ...
    def __truediv__(self, other: object, /) -> Symbol: ...
    def __rtruediv__(self, other: object, /) -> Symbol: ...
    def __pow__(self, other: object, modulo: None = None, /) -> Symbol: ...
    def __rpow__(self, other: object, modulo: None = None, /) -> Symbol: ...
    def __neg__(self) -> Symbol: ...
    def __pos__(self) -> Symbol: ...
    def __abs__(self) -> Symbol: ...
    def __complex__(self) -> NoReturn: ...
    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any: ...

@final
class Formulas:
    """Formulas of the time, the state and the parameters."""

    @staticmethod
    def from_json(text: str) -> Formulas: ...
    @property
    def json(self) -> str: ...
    @property
    def texts(self) -> list[str]: ...
    @property
    def latex(self) -> list[str]: ...
    def jacobian(self) -> Formulas: ...
    def values(
        self, time: float, state: ArrayLike, parameters: Sequence[tuple[str, float]] | None = None
    ) -> NDArray[np.float64]: ...
    def __len__(self) -> int: ...

@final
class Trace:
    """The symbols of some functions of one model, with names."""

    def __new__(cls, states: Sequence[str], parameters: Sequence[tuple[str, str]]) -> Self: ...
    def time(self) -> Symbol: ...
    def state(self) -> list[Symbol]: ...
    def parameters(self) -> list[Symbol]: ...
    def of_text(self, texts: Sequence[str]) -> Formulas: ...
    def formulas(self, outputs: Sequence[Any]) -> Formulas: ...

@final
class Solution:
    """A run of a model of formulas: its arcs and events, and the states at all times."""

    @property
    def stop(self) -> str: ...
    @property
    def error(self) -> Exception | None: ...
    @property
    def times(self) -> tuple[float, float]: ...
    @property
    def events(self) -> list[Event]: ...
    @property
    def modes(self) -> list[str]: ...
    def states(self, times: ArrayLike) -> NDArray[np.float64]: ...
    def trajectory(self, grid: ArrayLike) -> dict[str, Any]: ...
    def __len__(self) -> int: ...

@final
class Fates:
    """The ends of many runs, in arrays with one entry for each run."""

    @property
    def reasons(self) -> list[str]: ...
    @property
    def surfaces(self) -> list[str]: ...
    @property
    def modes(self) -> list[str]: ...
    @property
    def times(self) -> NDArray[np.float64]: ...
    @property
    def events(self) -> NDArray[np.uint64]: ...
    @property
    def states(self) -> NDArray[np.float64]: ...
    @property
    def first_error(self) -> tuple[int, Exception] | None: ...
    def __len__(self) -> int: ...

@final
class Equations:
    """A hybrid system by its equations: what the functions of a System become."""

    def __new__(
        cls,
        json: str,
        *,
        relative: float = 1e-12,
        absolute: float = 1e-12,
        relative_each: Sequence[float] | None = None,
        absolute_each: Sequence[float] | None = None,
        longest_step: float = ...,
        steps: int = 1_000_000,
    ) -> Self: ...
    @property
    def json(self) -> str: ...
    @property
    def content_hash(self) -> str: ...
    def with_parameters(self, values: Sequence[tuple[str, float]]) -> Equations: ...
    def run(self, mode: str, start: ArrayLike, times: tuple[float, float], events: int) -> Solution: ...
    def fates(
        self,
        modes: Sequence[str],
        starts: Sequence[Sequence[float]],
        times: tuple[float, float],
        events: int,
        names: Sequence[str] = ...,
        values: Sequence[Sequence[float]] = ...,
        threads: int | None = None,
        progress: Callable[[int, int], Any] | bool | None = None,
    ) -> Fates: ...

@final
class Landing:
    time: float
    closing_speed: float
    excess: float
    velocity: float
    sudden: bool

@final
class Hop:
    speed: float
    next: float | None
    next_error: float | None
    loss: float | None
    next_speed_squared: float
    sudden: int
    flight_time: float
    landings: list[Landing]

@final
class Fate:
    label: int
    name: str
    hops: int

@final
class Trap:
    n: int
    left: float
    right: float
    length: float
    error: float
    edge: Literal["crossing", "contact end", "next fixed point"]
    def __contains__(self, alpha: float, /) -> bool: ...

@final
class Crisis:
    n: int
    mass_ratio: float
    error: float
    alpha: float

@final
class Bounds:
    lower: float
    upper: float
    def __contains__(self, number: float, /) -> bool: ...

@final
class LiftOffMap:
    def __new__(cls, mass_ratio: float) -> Self: ...
    @property
    def mass_ratio(self) -> float: ...
    @overload
    def __call__(self, alpha: float, /) -> float: ...
    @overload
    def __call__(self, alpha: ArrayLike, /) -> NDArray[np.float64]: ...
    @overload
    def images(
        self,
        alpha: ArrayLike,
        status: Literal[False] = False,
        *,
        out: NDArray[np.float64] | None = None,
        where: None = None,
    ) -> NDArray[np.float64]: ...
    @overload
    def images(
        self, alpha: ArrayLike, status: Literal[True], *, out: None = None, where: None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8]]: ...
    @overload
    def hop(self, alpha: float) -> Hop: ...
    @overload
    def hop(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...
    def orbit(self, alpha: float, hops: int = 100) -> NDArray[np.float64]: ...
    @overload
    def fate(self, alpha: float) -> Fate: ...
    @overload
    def fate(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...
    def fates(self, alpha: ArrayLike) -> NDArray[np.uint16]: ...
    @overload
    def slopes(self, alpha: float) -> tuple[float, float] | None: ...
    @overload
    def slopes(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...

@final
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
def images(alpha: ArrayLike, M: ArrayLike) -> NDArray[np.float64]: ...
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
def _restored(kind: str, values: tuple[Any, ...]) -> Any: ...
def _solution(equations: Equations, stored: str) -> Solution: ...
def _equations(
    json: str,
    relative: float,
    absolute: float,
    relative_each: Sequence[float] | None,
    absolute_each: Sequence[float] | None,
    longest_step: float,
    steps: int,
) -> Equations: ...
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

@final
class Interval:
    value: float
    lower: float
    upper: float
    def __contains__(self, number: float, /) -> bool: ...

@final
class BoxCount:
    size: float
    boxes: int
    mixed: int
    open: int
    basin_entropy: float
    boundary_entropy: float | None

@final
class LabelImage:
    def __new__(cls, labels: NDArray[np.uint16]) -> Self: ...
    def array(self) -> NDArray[np.uint16]: ...
    def counts(self) -> dict[int, int]: ...
    def fractions(self) -> dict[int, Interval]: ...
    def fraction_bounds(self) -> dict[int, Bounds]: ...
    def boxes(self, side: int) -> BoxCount: ...
    def exceeds_ln_2(self) -> bool: ...
    def far_from_other_boundaries(self, distance: int) -> float: ...

@final
class UncertaintyExponent:
    exponent: Interval
    follows_a_power_law: bool
    fractions: list[tuple[float, Interval]]

@final
class Attractors:
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
    def __new__(
        cls,
        map: Callable[[NDArray[np.float64]], Sequence[float] | NDArray[np.float64] | None] | Steps,
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
    ) -> Self: ...
    @staticmethod
    def of_points(
        map: Callable[[NDArray[np.float64]], Sequence[float] | NDArray[np.float64] | None] | Steps,
        points: Mapping[int, Sequence[Sequence[float]]],
        distance: float | None = None,
        *,
        budget: int = 100_000,
        stretch: int = 1000,
        tests: int = 200,
    ) -> Attractors: ...
    @staticmethod
    def of_features(
        map: Callable[[NDArray[np.float64]], Sequence[float] | NDArray[np.float64] | None] | Steps,
        features: Callable[[NDArray[np.float64]], Sequence[float] | NDArray[np.float64] | float],
        starts: Sequence[Sequence[float]],
        *,
        radius: float,
        beside: float,
        transient: int = 1000,
        stretch: int = 1000,
        agree: int = 3,
        budget: int = 30,
        fewest: int = 4,
        tests: int = 100,
    ) -> Attractors: ...
    @property
    def kind(self) -> str: ...
    @property
    def distance(self) -> float | None: ...
    @property
    def points(self) -> dict[int, NDArray[np.float64]]: ...
    @property
    def unmatched(self) -> list[tuple[list[float], str]]: ...
    @property
    def remedy(self) -> str | None: ...
    @property
    def periods(self) -> dict[int, int | None]: ...
    def labels(self, starts: ArrayLike, threads: int | None = None) -> NDArray[np.uint16]: ...
    def convergences(
        self, starts: ArrayLike, threads: int | None = None
    ) -> tuple[NDArray[np.uint16], NDArray[np.uint64]]: ...

def _boundary_between(attractors: Attractors, first: list[float], second: list[float], precision: float) -> Any: ...
def _track_edge(attractors: Attractors, first: list[float], second: list[float], settings: Mapping[str, Any]) -> Any: ...
def _minimal_fatal_shock(
    attractors: Attractors, state: list[float], settings: Mapping[str, Any], threads: int | None
) -> Any: ...
def _stability(
    attractors: Attractors, sample: Mapping[str, Any], precision: float | None, threads: int | None
) -> dict[int, Any]: ...
def _tipping(
    before: Attractors, after: Attractors, sample: Mapping[str, Any], threads: int | None
) -> list[tuple[int, int, Interval, int]]: ...
def _attractors_along(
    steps_at: Callable[[float], Steps], settings: Mapping[str, Any], threads: int | None, progress: Any
) -> dict[str, Any]: ...
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

@final
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
    def __add__(self, other: QuasiPolynomial, /) -> QuasiPolynomial: ...
    def __radd__(self, other: QuasiPolynomial, /) -> QuasiPolynomial: ...
    def __sub__(self, other: QuasiPolynomial, /) -> QuasiPolynomial: ...
    def __rsub__(self, other: QuasiPolynomial, /) -> QuasiPolynomial: ...
    def __neg__(self) -> QuasiPolynomial: ...
    def __mul__(self, other: QuasiPolynomial | float, /) -> QuasiPolynomial: ...
    def __rmul__(self, factor: float, /) -> QuasiPolynomial: ...

@final
class Guard:
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
    name: str
    def __new__(
        cls,
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
    ) -> Self: ...

@final
class Clock:
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
    name: str
    def __new__(
        cls,
        name: str,
        *,
        times: Sequence[float] | Callable[[float], float | None] | None = None,
        period: float | None = None,
        first: float = 0.0,
        reset: _Reset | None = None,
        modes: Sequence[_Mode] | None = None,
    ) -> Self: ...

@final
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

@final
class Zeno:
    time: float
    time_error: float
    state: _State
    state_error: float
    ratio: float
    period: int
    next_mode: _Mode | None
    after: _State | None

@final
class Sliding:
    surface: str
    below: _Mode
    above: _Mode
    time: float
    state: _State
    rates: tuple[float, float]
    field: _State | None

@final
class SlidingMode:
    surface: str
    below: _Mode
    above: _Mode

@final
class Arc:
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
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

@final
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

@final
class HybridSystem:
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
    def __new__(
        cls,
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
    ) -> Self: ...
    def run(
        self, start: ArrayLike, *, time: float, mode: _Mode = None, events: int = 1_000_000, start_time: float = 0.0
    ) -> Execution: ...

@final
class CFunction:
    """A function of C with the signature void (double, double *, double *, double *)."""

    def __new__(cls, address: int, owner: Any) -> Self: ...
    def __call__(
        self, time: float, state: Sequence[float], parameters: Sequence[float], results: int
    ) -> list[float]: ...

@final
class CField:
    """The field of a model by functions of C, one for each mode."""

    def __new__(cls, functions: Sequence[tuple[Any, CFunction]], parameters: Sequence[float]) -> Self: ...
    def __call__(self, mode: Any, state: Sequence[float]) -> list[float]: ...

@final
class CGuard:
    """The value of a guard by a function of C."""

    def __new__(cls, function: CFunction, parameters: Sequence[float]) -> Self: ...
    def __call__(self, state: Sequence[float]) -> float: ...

@final
class ReturnMap:
    """The map from a section to the next event of a surface, as a parameter changes."""

    def __new__(
        cls,
        equations: Equations,
        parameter: str,
        mode: str,
        surface: str,
        coordinates: Sequence[str],
        start: Sequence[str] | None = None,
        image: Sequence[str] | None = None,
    ) -> Self: ...
    @property
    def dimension(self) -> int: ...
    def image(self, point: ArrayLike, parameter: float) -> dict[str, Any]: ...
    def linearized(self, point: ArrayLike, parameter: float) -> dict[str, Any]: ...
    def orbit(self, point: ArrayLike, parameter: float, images: int) -> NDArray[np.float64]: ...
    def periodic_point(self, start: ArrayLike, parameter: float, period: int) -> dict[str, Any]: ...
    def branch(
        self, start: ArrayLike, parameter: float, period: int, window: tuple[float, float], longest: float
    ) -> tuple[list[dict[str, Any]], list[dict[str, Any]], list[str]]: ...
    def diagram(
        self,
        parameters: Sequence[float],
        seeds: Sequence[Sequence[float]],
        transient: int,
        keep: int,
        carried: bool = False,
        progress: Callable[[int, int], Any] | bool | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], list[tuple[float, str]]]: ...
    def lyapunov(
        self, start: ArrayLike, parameter: float, transient: int, images: int
    ) -> list[tuple[float, float, float]]: ...

@final
class Steps:
    """A map of states: of formulas, of a flow over some time, or of returns to a surface."""

    @staticmethod
    def of_flow(
        equations: Equations, modes: Sequence[str], times: tuple[float, float], ends: Sequence[str]
    ) -> Steps: ...
    @staticmethod
    def of_returns(returns: ReturnMap, parameter: float, ends: Sequence[str]) -> Steps: ...
    @staticmethod
    def of_formulas(formulas: Formulas) -> Steps: ...
    @property
    def dimension(self) -> int: ...
    def __call__(self, state: Sequence[float]) -> list[float] | None: ...

def arc_states(arcs: Sequence[Arc], times: ArrayLike) -> NDArray[np.float64]: ...
def arc_trajectory(arcs: Sequence[Arc], grid: ArrayLike) -> dict[str, Any]: ...
def sensitivity(arcs: Sequence[Arc]) -> NDArray[np.float64]: ...
def event_sensitivity(arc: Arc) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
