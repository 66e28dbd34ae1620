from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NoReturn, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

__version__: str


@final
class Symbol:
    """A part of a formula: what a function of a System sees instead of a number, in the one call that makes formulas of it.

    It can be added, multiplied and given to NumPy's functions. It has no value: a function that asks for one is called as it is,
    without formulas.
    """

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
    """Formulas of the time, the state and the parameters.

    str(formulas) shows them; pickle and copy keep them with exact numbers.
    """

    @staticmethod
    def from_json(text: str) -> Formulas:
        """The formulas of a text of JSON."""
    @property
    def json(self) -> str:
        """The formulas as JSON, with exact numbers."""
    @property
    def texts(self) -> list[str]:
        """Each formula as text."""
    @property
    def latex(self) -> list[str]:
        """Each formula in LaTeX."""
    def jacobian(self) -> Formulas:
        """The derivatives by the components of the state, row by row, as formulas."""
    def values(
        self, time: float, state: ArrayLike, parameters: Sequence[tuple[str, float]] | None = None
    ) -> NDArray[np.float64]:
        """The values at a time and a state; at other values of parameters, given by their names."""
    def __len__(self) -> int: ...

@final
class Trace:
    """The symbols of some functions of one model, with names."""

    def __new__(cls, states: Sequence[str], parameters: Sequence[tuple[str, str]]) -> Self: ...
    def time(self) -> Symbol:
        """The symbol of the time."""
    def state(self) -> list[Symbol]:
        """The symbols of the components of the state."""
    def parameters(self) -> list[Symbol]:
        """The symbols of the parameters."""
    def of_text(self, texts: Sequence[str]) -> Formulas:
        """The formulas of texts."""
    def formulas(self, outputs: Sequence[Any]) -> Formulas:
        """The formulas of what a function has returned: symbols and numbers."""

@final
class Solution:
    """A run of a model of formulas: its arcs and events, and the states at all times."""

    @property
    def stop(self) -> str:
        """Why the run ended, as Execution.stop has it."""
    @property
    def error(self) -> Exception | None:
        """The exception of a run that failed after its first arc; None if it did not."""
    @property
    def times(self) -> tuple[float, float]:
        """The times of the start and of the end."""
    @property
    def events(self) -> list[Event]:
        """The events."""
    @property
    def modes(self) -> list[str]:
        """The modes in which the arcs are."""
    def states(self, times: ArrayLike) -> NDArray[np.float64]:
        """The states at rising times, one row for each: after all events at each of them."""
    def trajectory(self, grid: ArrayLike) -> dict[str, Any]:
        """As Execution.trajectory, of the whole run."""
    def __len__(self) -> int: ...

@final
class Fates:
    """The ends of many runs, in arrays with one entry for each run."""

    @property
    def reasons(self) -> list[str]:
        """Why each run ended: as Run.reason. A run that failed has the text of its error."""
    @property
    def surfaces(self) -> list[str]:
        """The surface whose event ended each run; an empty text for others."""
    @property
    def modes(self) -> list[str]:
        """The mode at the end of each run."""
    @property
    def times(self) -> NDArray[np.float64]:
        """The time at the end of each run; NaN for one that did not begin."""
    @property
    def events(self) -> NDArray[np.uint64]:
        """The number of events of each run."""
    @property
    def states(self) -> NDArray[np.float64]:
        """The state at the end of each run, one row for each; NaN for one that did not begin."""
    @property
    def first_error(self) -> tuple[int, Exception] | None:
        """The exception of the first run that failed; None if all ended."""
    def __len__(self) -> int: ...

@final
class Equations:
    """A hybrid system by its equations: what the functions of a System become.

    It is made of JSON, and pickles as such.
    """

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
    def json(self) -> str:
        """The equations as JSON, with exact numbers."""
    @property
    def content_hash(self) -> str:
        """A short name of the equations: the SHA-256 of their JSON."""
    def with_parameters(self, values: Sequence[tuple[str, float]]) -> Equations:
        """The same equations with other values of parameters."""
    def run(self, mode: str, start: ArrayLike, times: tuple[float, float], events: int) -> Solution:
        """The run from a state in a mode between two times. No Python runs meanwhile, and Ctrl-C ends it."""
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
    ) -> Fates:
        """The ends of many runs: starts has one start a row, and there is one mode for each. values has the values of the parameters with these
        names, one row for each start.
        """

@final
class Landing:
    """One landing of a hop."""
    time: float
    closing_speed: float
    excess: float
    velocity: float
    sudden: bool

@final
class Hop:
    """One hop: from a gradual lift-off to the next one."""
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
    """The long-term behaviour of a hopper."""
    label: int
    name: str
    hops: int

@final
class Trap:
    """The trap [α*_n, α*_n + Δ]: every orbit in it converges to α*_n."""
    n: int
    left: float
    right: float
    length: float
    error: float
    edge: Literal["crossing", "contact end", "next fixed point"]
    def __contains__(self, alpha: float, /) -> bool: ...

@final
class Crisis:
    """A mass ratio at which the map's minimum on a hump touches its fixed point, or zero."""
    n: int
    mass_ratio: float
    error: float
    alpha: float

@final
class Bounds:
    """A number between two bounds."""
    lower: float
    upper: float
    def __contains__(self, number: float, /) -> bool: ...

@final
class LiftOffMap:
    """The map α′ = f(α; M) from one gradual lift-off speed to the next.

    Speeds are in units of m₂gω/k, and M = m₂/m₁ is the lower mass over the upper one. A call takes a number or
    anything that NumPy makes an array of, and gives a float or an array of the same shape. NaN means that the
    hopper is grounded, and stays NaN.

    >>> from passive_hopper import LiftOffMap
    >>> m = LiftOffMap(0.2)
    >>> m(7.0)
    5.4319312674983316
    >>> m([5.5, 7.0]).shape
    (2,)

    Every result has the bits of the Rust library: α′ is right to some ulps, and every decision of a hop is larger
    than its error.
    """
    def __new__(cls, mass_ratio: float) -> Self: ...
    @property
    def mass_ratio(self) -> float:
        """M = m₂/m₁."""
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
    ) -> NDArray[np.float64]:
        """f(α) for all speeds at once; NaN where the hopper is grounded.

        With status=True a pair: the images, and an array of uint8 with 0 where the hopper lifts off again, 1 where
        it is grounded, 2 where the hop cannot be decided, and 3 where the speed was NaN. Without it an undecided
        hop raises UndecidedError. `out` is an array of float64 for the images, of the shape of the speeds.
        """
    @overload
    def images(
        self, alpha: ArrayLike, status: Literal[True], *, out: None = None, where: None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8]]: ...
    @overload
    def hop(self, alpha: float) -> Hop:
        """The hop that starts with speed α, with all its landings. Of an array a record array: `speed`, `next`, `next_error`, `loss`, `sudden`, `flight_time`."""
    @overload
    def hop(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...
    def orbit(self, alpha: float, hops: int = 100) -> NDArray[np.float64]:
        """The speeds α, f(α), f(f(α)), …: an array with up to `hops` + 1 speeds. It ends early if the hopper is grounded."""
    @overload
    def fate(self, alpha: float) -> Fate:
        """The fate of the orbit from α, with the number of hops until it is known. NaN, which the map gives for a
        grounded hopper, is grounded. Of an array a record array: `label`, `hops`.
        """
    @overload
    def fate(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...
    def fates(self, alpha: ArrayLike) -> NDArray[np.uint16]:
        """The labels of many speeds, as an array of uint16; label_name names them. NaN is grounded."""
    @overload
    def slopes(self, alpha: float) -> tuple[float, float] | None:
        """The derivatives (∂α′/∂α, ∂α′/∂M); None if the hopper is grounded, and for NaN. Of an array a record array: `by_speed`, `by_mass_ratio`."""
    @overload
    def slopes(self, alpha: ArrayLike) -> np.recarray[Any, Any]: ...

@final
class IntervalBasins:
    """All basins at one mass ratio, as intervals of the lift-off speed."""
    def arrays(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.uint16]]:
        """The lower ends, the upper ends and the labels (uint16) of all intervals, from below."""
    def __len__(self) -> int: ...
    @property
    def window(self) -> tuple[float, float]:
        """The window of speeds."""
    @property
    def undecided(self) -> float:
        """The total length that belongs to no interval."""
    @property
    def stop_reason(self) -> str:
        """Why the search stopped."""
    @property
    def ground(self) -> Literal["branches", "enclosures", "contact parts"]:
        """What the labels stand on: "branches" of the map that are proved to be all, "enclosures" of images of
        intervals, or "contact parts" alone, at M > 50, where the sudden windows stay undecided.
        """
    @property
    def probes(self) -> tuple[int, int]:
        """The number of random speeds whose fate was compared with their interval, and the number of those that differ."""
    def fraction(self, label: int) -> Bounds:
        """Bounds on the fraction of the window that has this label. They hold as the labels do: see `ground`."""
    def tipping_to(self, after: IntervalBasins) -> dict[tuple[int, int], Bounds]:
        """The probability that a speed of one basin is in another after the mass ratio has changed to that of `after`:
        a dictionary from pairs (label before, label after) to Bounds. Both have the same window.
        """
    def label(self, alpha: float) -> int | None:
        """The label of the interval that contains α; None where it is undecided."""

@overload
def alpha_star(n: int) -> float:
    """α*_n, the n-th solution of tan α* = α*, in units of m₂gω/k: a float for an int, an array for a sequence of ints.

    >>> from passive_hopper import alpha_star
    >>> alpha_star(1)
    4.493409457909064
    """
@overload
def alpha_star(n: Sequence[int] | range) -> NDArray[np.float64]: ...
def trap(n: int, mass_ratio: float) -> Trap:
    """The trap of α*_n."""
def crisis(n: int) -> Crisis:
    """The mass ratio from which orbits of hump n fall below α*_n."""
def grounding(n: int) -> Crisis:
    """The mass ratio from which orbits of hump n are grounded."""
def images(alpha: ArrayLike, M: ArrayLike) -> NDArray[np.float64]:
    """α′ = f(α; M) for arrays of speeds and of mass ratios, which are broadcast against each other; NaN where the hopper is grounded.

    >>> import numpy as np
    >>> from passive_hopper import images
    >>> images([[5.5], [7.0]], [0.2, 0.4]).shape
    (2, 2)
    """
def label_name(label: int) -> str:
    """The name of a label of fates and basins.

    >>> from passive_hopper import label_name
    >>> label_name(0)
    'decaying'
    """
def label_colour(label: int) -> str:
    """The colour of a label in the figures, as CSS."""
def basin_labels(
    M: tuple[float, float] = ...,
    alpha: tuple[float, float] | None = ...,
    shape: tuple[int, int] = ...,
    progress: Callable[[int, int], Any] | bool | None = ...,
    layer: str = "label",
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[Any]]:
    """The label of every pixel of a window of (M, α): arrays of M, of α, and of labels (uint16) with the shape (M, α).

    Each label is the fate of its pixel's middle. label_name names the labels. Another `layer` of `layers()` gives its
    numbers instead: "hops" until the fate is known (uint64), or "proof", labels with 65536 more where the fate is
    proved (uint32). `alpha` is the window of the paper, from α*_1 to α*_6, unless given. `progress(done, all)` is
    called with the number of finished columns, some times a second and at the end; `progress=True` shows a bar of
    tqdm. Ctrl-C ends the computation.
    """
def layers() -> list[dict[str, Any]]:
    """The layers of a raster, as a list of dicts: key, name, about, the type of its numbers (None for shares), and the
    names of what they mean.
    """
def interval_basins(
    mass_ratio: float,
    first: int = 1,
    last: int = 6,
    undecided: float = 1e-6,
    shortest: float = 1e-12,
    samples: int = 400,
    most: int = 100_000,
) -> IntervalBasins:
    """All basins between α*_first and α*_last at one mass ratio, as intervals with ends to an ulp.

    The search stops as soon as no more than the length `undecided` is open or about `most` intervals are found, and
    does not follow intervals below `shortest`. `samples` points search each sudden window for branches of the map.
    No label is wrong, at any M.

    >>> from passive_hopper import interval_basins
    >>> basins = interval_basins(0.2, last=2)
    >>> basins.ground
    'branches'
    >>> basins.fraction(1)
    Bounds(lower=0.046297011493017744, upper=0.04629728650865171)
    """
def fractions(
    mass_ratio: float, first: int = 1, last: int = 6, points: int = 10_000
) -> dict[str, float]:
    """The basin fractions by the paper's protocol: `points` equally spaced speeds between any two neighbouring fixed
    points. A dictionary from names of fates to fractions.
    """
def motion_arrays(alpha: float, mass_ratio: float, hops: int = 10) -> dict[str, Any]:
    """The motion over some hops as a dictionary of arrays: times (units of 1/ω), hops, contact (whether the lower mass
    is on the ground), states with the columns y₁, ẏ₁, y₂, ẏ₂ (units of m₂g/k and m₂gω/k), event_times and
    event_kinds; and grounded.

    A landing has two samples at the same time, before the collision and after it. motion(…) is the same as an
    xarray.Dataset.
    """
def motion_event_names() -> list[tuple[int, str]]:
    """The meanings of event_kinds: pairs of a code and a name."""
def after_fork() -> None:
    """To be called in the child after a fork: of the threads of the parent none is there."""
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
) -> bytes:
    """The animation of a motion as the bytes of a file; `form` is "gif" or "apng". `progress(done, all)` counts the
    frames.

    The motion is given by its samples: times, numbers of hops, whether the lower mass is on the ground, and states
    with the columns y₁, ẏ₁, y₂, ẏ₂, as motion_arrays gives them.
    """
RASTER_VERSION: int

def basin_region(
    M: tuple[float, float],
    alpha: tuple[float, float],
    shape: tuple[int, int],
    columns: tuple[int, int],
    threads: int | None = None,
    progress: Callable[[int, int], Any] | bool | None = None,
    layer: str = "label",
) -> NDArray[Any]:
    """The labels of the columns from `columns[0]` to before `columns[1]` of the raster of basin_labels, by this number
    of threads, or by all.
    """
def first_window() -> tuple[float, float]:
    """The window of speeds of the paper, from α*_1 to α*_6."""
def pixel_middles(
    window: tuple[tuple[float, float], tuple[float, float]], shape: tuple[int, int]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The middles of the pixels of a window ((left, right), (bottom, top)): an array for each side."""
def label_codes() -> dict[str, int]:
    """The codes of labels that are no basins, by name."""

@final
class Interval:
    """A number, and an interval in which it lies: a 95 % confidence interval, or bounds. The source says which."""
    value: float
    lower: float
    upper: float
    def __contains__(self, number: float, /) -> bool: ...

@final
class BoxCount:
    """A count of boxes of one size."""
    size: float
    boxes: int
    mixed: int
    open: int
    basin_entropy: float
    boundary_entropy: float | None

@final
class LabelImage:
    """Labels of the pixels of a window: an array of uint16 with the shape (x, y).

    nonsmooth.labelling.label_image makes it of any array of integers.
    """
    def __new__(cls, labels: NDArray[np.uint16]) -> Self: ...
    def array(self) -> NDArray[np.uint16]:
        """The labels, an array of uint16 with the shape (x, y)."""
    def counts(self) -> dict[int, int]:
        """The number of pixels of each label."""
    def fractions(self) -> dict[int, Interval]:
        """The fraction of each basin with a 95 % interval, as if the pixels were independent random points of the
        window. Undecided pixels widen the intervals; pixels outside are not counted.
        """
    def fraction_bounds(self) -> dict[int, Bounds]:
        """Bounds on the fraction of each basin, if a square whose four corners have one label belongs to it."""
    def boxes(self, side: int) -> BoxCount:
        """The boxes of a side, in pixels, with the entropies of the basins in them."""
    def exceeds_ln_2(self) -> bool:
        """Whether the boundary entropy exceeds ln 2 at every size of boxes from two pixels to an eighth of the image:
        then the boundary is fractal at these scales. False says that this is not shown.
        """
    def far_from_other_boundaries(self, distance: int) -> float:
        """The largest fraction of the image that lies on the boundary of one basin and farther than `distance` pixels
        from the boundary of another one: 0 if all basins share one boundary at this distance (Wada).
        """

@final
class UncertaintyExponent:
    """The uncertainty exponent of a labelling: the fraction of pairs of points at a distance ε whose labels differ is
    ∝ ε^exponent.
    """
    exponent: Interval
    follows_a_power_law: bool
    fractions: list[tuple[float, Interval]]

@final
class Attractors:
    """The attractors of a map of several variables, found by recurrences to cells of a grid and tested as traps.

    map(x) is a step: a map, a return map, or a flow over some time. Steps of a System need no Python, and run on all processors. A function takes an array, and returns a list, a tuple
    or an array, or None where it has no value. region has the ends of each coordinate; starts is an array with one
    start a row. The basins have the labels 1, 2, … in the order in which the attractors are found; ESCAPED is the
    label of an orbit that passes the distance `escape` from the origin.

    periodic has the coordinates, from 0, whose side of the region is one period, such as angles.

    cells along every side of the region locate an attractor; an orbit of `recurrences` steps within visited cells
    is a candidate, which is followed ten times as long as it took to be found, and which `tests` random orbits
    test. No orbit takes more than `budget` steps to a candidate. Attractors closer than three cells of the finest
    grid tried, of 16 times as many cells, may be found as one. If no attractor is found, `remedy` says what would
    help.

    >>> from nonsmooth.labelling import Attractors
    >>> newton = lambda x: (x - (x ** 2 - 2) / (2 * x)) if x[0] else None
    >>> found = Attractors(newton, region=[(-3.1, 3)], starts=[[1.0], [-1.0]], tests=20)
    >>> [round(float(points[0, 0]), 6) for points in found.points.values()]
    [1.414214, -1.414214]
    >>> found.labels([[0.3], [-7.0]]).tolist()
    [1, 2]
    """
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
        threads: int | None = None,
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
        threads: int | None = None,
    ) -> Attractors:
        """Attractors that are known by some of their points: fixed points, cycles, clouds of points. `points` has them by label, one a row.

        An orbit has come to one as soon as it is within `distance` of one of its points. Orbits from random states within it test that: they must come back.
        Without a distance the largest one that passes is taken, of halves of the distance between two attractors. `stretch` is a number of steps within which an orbit on an
        attractor comes near to its points again, `budget` the most steps of an orbit.

        >>> from nonsmooth.labelling import Attractors
        >>> cubic = lambda x: 1.5 * x - 0.5 * x**3
        >>> known = Attractors.of_points(cubic, {1: [[1.0]], 2: [[-1.0]]}, tests=20)
        >>> known.labels([[0.3], [-0.2], [0.0]]).tolist()
        [1, 2, 65535]
        """
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
        threads: int | None = None,
    ) -> Attractors:
        """Attractors by features of their orbits. `features` makes some numbers of an array with the points of a stretch of an orbit, one a row, such as their mean.
        Orbits whose features are within `radius` of each other are of one attractor, if `agree` successive stretches are, and if orbits that start within `beside` of its states
        come to it.

        Each start is followed for `transient` steps, and then in stretches of `stretch` steps, at most `budget` of them. A group has `fewest` orbits at least.

        >>> from nonsmooth.labelling import Attractors
        >>> cubic = lambda x: 1.5 * x - 0.5 * x**3
        >>> starts = [[0.15 * k] for k in range(-10, 11) if k]
        >>> found = Attractors.of_features(cubic, lambda points: points.mean(axis=0), starts, radius=0.1, beside=0.01,
        ...                                transient=100, stretch=10, tests=20)
        >>> found.labels([[0.3], [-0.2]]).tolist()
        [2, 1]
        """
    @property
    def kind(self) -> str:
        """How they are known: "recurrences", "points" or "features"."""
    @property
    def distance(self) -> float | None:
        """The distance within which an orbit has come to an attractor that is known by points; None for other attractors."""
    @property
    def points(self) -> dict[int, NDArray[np.float64]]:
        """The successive points of an orbit on each attractor, by label: arrays with one point a row."""
    @property
    def unmatched(self) -> list[tuple[list[float], str]]:
        """The starts whose orbits belong to no attractor, each with the reason: "left the region: …", "cut by the
        region: …", "stopped", "not settled: …" with the drift a step, or "no trap".
        """
    @property
    def remedy(self) -> str | None:
        """What would help if no attractor was found: a larger region, more cells, or a larger budget; None if one was
        found.
        """
    @property
    def periods(self) -> dict[int, int | None]:
        """The number of steps after which each attractor repeats itself, by label; None for one that does not, and where attractors are known
        by points or features.
        """
    def labels(self, starts: ArrayLike, threads: int | None = None) -> NDArray[np.uint16]:
        """The labels of starts, one a row: an array of uint16. A start that comes to no attractor is undecided."""
    def convergences(
        self, starts: ArrayLike, threads: int | None = None
    ) -> tuple[NDArray[np.uint16], NDArray[np.uint64]]:
        """The labels of starts, and the numbers of steps after which each is at its attractor."""

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
def _proved_orbit(
    equations: Equations, question: Mapping[str, Any], guess: list[float]
) -> tuple[tuple[Any, ...], str | None]: ...
def _proved_basins(
    equations: Equations,
    question: Mapping[str, Any],
    guesses: list[list[float]],
    window: list[tuple[float, float]],
    division: tuple[int, int, int],
    progress: Any,
) -> ProvedBasins: ...
def region_fractions(
    label: Callable[..., NDArray[np.uint16]], window: Sequence[tuple[float, float]], count: int, seed: int
) -> dict[int, Interval]:
    """As nonsmooth.labelling.region_fractions, for a function that returns an array of uint16."""
def uncertainty_exponent(
    label: Callable[..., NDArray[np.uint16]],
    window: Sequence[tuple[float, float]],
    epsilons: Sequence[float],
    count: int,
    seed: int,
) -> UncertaintyExponent:
    """As nonsmooth.labelling.uncertainty_exponent, for a function that returns an array of uint16."""

_Mode = Any
_Vector = Sequence[float] | NDArray[np.float64]
_State = NDArray[np.float64]
_Reset = Callable[[_Mode, _State], tuple[_Mode, _Vector] | None]

@final
class QuasiPolynomial:
    """A sum of polynomials times exponentials, sines and cosines of time: g(t) = Σ exp(σt) (p(t) cos ωt + q(t) sin ωt).

    Along the flow of constant forces, springs and linear dampers a guard is such a function. A Guard with a signal=
    has crossings that are certain: none is missed.

    >>> from nonsmooth.hybrid import QuasiPolynomial as Q
    >>> height = Q.polynomial([0, -4, 0.5]) + Q.sine(5, 1)      # t²/2 − 4t + 5 sin t
    >>> time = height.first_crossing("falling", 20)
    >>> abs(height(time)) < 1e-14
    True
    """
    @staticmethod
    def polynomial(coefficients: Sequence[float]) -> QuasiPolynomial:
        """A polynomial, lowest power first."""
    @staticmethod
    def sine(amplitude: float, omega: float) -> QuasiPolynomial:
        """amplitude · sin ωt."""
    @staticmethod
    def cosine(amplitude: float, omega: float) -> QuasiPolynomial:
        """amplitude · cos ωt."""
    @staticmethod
    def exponential(amplitude: float, rate: float) -> QuasiPolynomial:
        """amplitude · exp(rate · t)."""
    def damped(self, rate: float) -> QuasiPolynomial:
        """This function times exp(−rate · t)."""
    def derivative(self) -> QuasiPolynomial:
        """Its derivative."""
    def first_crossing(self, direction: str, horizon: float) -> float | None:
        """The time of the first crossing of zero in a direction ("rising", "falling" or "either") up to a horizon;
        None if there is none.
        """
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
    """A surface g(x) = 0, and what happens when a state crosses it.

    name names its events. value(x) is g. direction is "rising" (g goes from negative to positive), "falling" or
    "either". reset(mode, x) returns the next mode and state as a pair, or None to end the execution.

    role is "switch": an event where the flow crosses the surface, with a reset. If a jump can lead to the far side,
    the guard must say what that means: "contact", a floor that holds, where the event is at once; or "crossing",
    which counts only when the flow crosses it. "observer": a crossing without a reset. "terminal": its event ends
    the execution. touch says what happens where g comes within rounding of zero and goes back: "error", "event" or
    "ignore". modes is a list of the modes that have the guard; None for all.

    Two optional functions make its crossings certain: signal(mode, x) returns g along the flow from x as a
    QuasiPolynomial, or None; enclosure(mode, x, order, times) returns bounds (low, high) on a derivative of g along
    the flow over the times (from, to), or None. Without them a guard of a closed-form flow is sampled, and one of
    an integrated flow is followed along the steps.
    """
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
    """Events at preset times.

    name names them. reset(mode, x) is as that of a Guard; without it nothing changes. The times are one of: times,
    a rising sequence, or a function from a time to the next event strictly after it, or None; period, with the time
    of the first event in first.
    """
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
    """An event: a jump between two arcs."""
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
    """The limit of infinitely many events in finite time."""
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
    """A point of a surface at which the fields on both sides point."""
    surface: str
    below: _Mode
    above: _Mode
    time: float
    state: _State
    rates: tuple[float, float]
    field: _State | None

@final
class SlidingMode:
    """The mode of a motion along a surface, by Filippov's convention.

    Two of them are equal if the surface and the modes on both sides are.
    """
    surface: str
    below: _Mode
    above: _Mode

@final
class Arc:
    """A piece of continuous motion in one mode, between two events."""
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: object, /) -> Self: ...
    @property
    def mode(self) -> _Mode:
        """The mode; a SlidingMode along a surface."""
    @property
    def time(self) -> float:
        """The time at the start."""
    @property
    def jump(self) -> int:
        """The number of events before the arc."""
    @property
    def start(self) -> _State:
        """The state at the start."""
    @property
    def duration(self) -> float:
        """The duration; infinite if the arc never ends."""
    @property
    def end(self) -> Literal["event", "zeno", "sliding", "time limit", "never", "unfinished"]:
        """How it ends: "event", "zeno", "sliding", "time limit", "never", or "unfinished" if a budget of the search ended."""
    @property
    def certainty(self) -> Literal["exact", "certain", "interpolated", "sampled"] | None:
        """How certain it is that no event is missed: "exact", "certain", "interpolated" or "sampled"; None at a Zeno
        limit and where it slides.
        """
    @property
    def event(self) -> Event | None:
        """The event at the end; None if the arc ends in another way."""
    @property
    def zeno(self) -> Zeno | None:
        """The Zeno limit at the end; None if the arc ends in another way."""
    @property
    def sliding(self) -> Sliding | None:
        """The sliding point at the end; None if the arc ends in another way."""
    def states(self, elapsed: ArrayLike) -> NDArray[np.float64]:
        """The states at rising times after the start of the arc, one row for each."""

@final
class Execution:
    """An execution of a hybrid system: an iterator over its arcs.

    After an exception of a function, or Ctrl-C, it is where it was before the call: next() tries the same arc again.
    """
    def __iter__(self) -> Execution: ...
    def __next__(self) -> Arc: ...
    def run_until(self, time: float) -> Execution:
        """Sets the limit on time, also after the execution has stopped at an earlier one. Returns the execution."""
    def trajectory(self, grid: ArrayLike) -> dict[str, Any]:
        """The rest of the execution as a dictionary of arrays, with states at the times of `grid`, which rises.

        Every arc has a row at its start and at its end: each event has the states before and after it. times,
        jumps, modes, states and on_grid have one entry for each row. event_times, event_surfaces, event_modes,
        event_next_modes, event_before, event_after, event_kinds and event_certainties have one for each event.
        """
    @property
    def mode(self) -> _Mode:
        """The mode in which the execution is; a SlidingMode along a surface."""
    @property
    def state(self) -> _State:
        """The state at which it is."""
    @property
    def time(self) -> float:
        """The time at which it is."""
    @property
    def jump(self) -> int:
        """The number of events so far."""
    @property
    def stop(self) -> str | None:
        """Why it ended: "time limit", "event limit", "terminal", "no further event", "zeno", "sliding", "unfinished"
        or "failed"; None while it goes on.
        """

@final
class HybridSystem:
    """A hybrid system: a flow that is interrupted by events.

    The motion is either flow(mode, x, t), the state after the time t ≥ 0 from x in closed form, or field(mode, x),
    the right-hand side of ẋ = f(x), which is integrated with this tolerance. (A flow may have a field as well,
    which sliding needs.) x is an array; a function returns a list, a tuple or an array. A mode is any hashable
    object. guards is a list of Guard and Clock.

    rest(mode, x) returns the mode and the state after infinitely many events in finite time (Zeno), or None;
    slide(sliding) those on a surface at which the fields on both sides point. Without them the execution ends
    there. With slide="filippov" it goes on along the surface, in a SlidingMode, by the mean of both fields that is
    tangent to it (Filippov's convention), until the field of one side turns tangent.

    sampled is the interval at which guards of a flow in closed form are looked at, unless they have a signal or an
    enclosure. longest_step and check_interval bound the steps of an integration, and the distance of two looks at
    its guards.

    >>> from nonsmooth.hybrid import Guard, HybridSystem
    >>> ball = HybridSystem(
    ...     flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t],
    ...     guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0, -x[1] / 2]))],
    ...     sampled=0.01,
    ... )
    >>> [round(arc.event.time, 12) for arc in ball.run([0.5, 0], time=2.8) if arc.event]
    [1.0, 2.0, 2.5, 2.75]

    An exception in a function ends the call with this exception.
    """
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
    ) -> Execution:
        """The execution from a state in a mode, up to a time and to a number of events: an iterator over its arcs."""

@final
class CFunction:
    """A function of C with the signature `void (double, double *, double *, double *)`: of the time, the components of the state, the parameters, and the
    results that it writes.

    # Contract
    The caller of `CFunction(address, …)` promises that there is a function with this signature at the address, that it reads as many components and
    parameters as the system has, writes as many results as it is asked for, may be called from any thread, and stays as long as `owner` lives. The
    front checks the signature where the object tells it, and demands it of a bare address.
    """

    def __new__(cls, address: int, owner: Any) -> Self: ...
    def __call__(
        self, time: float, state: Sequence[float], parameters: Sequence[float], results: int
    ) -> list[float]: ...

@final
class CField:
    """The field of a model by functions of C, one for each mode. The last component of the state is the time."""

    def __new__(cls, functions: Sequence[tuple[Any, CFunction]], parameters: Sequence[float]) -> Self: ...
    def __call__(self, mode: Any, state: Sequence[float]) -> list[float]: ...

@final
class CSystem:
    """A system whose functions are all of C. The last component of a state is the time."""
    def __new__(
        cls,
        system: HybridSystem,
        fields: Sequence[tuple[str, CFunction]],
        surfaces: Sequence[tuple[CFunction | None, CFunction | None, str | None, bool, bool]],
    ) -> Self: ...
    def arcs(
        self, run: tuple[str, Sequence[float], Sequence[float]], times: tuple[float, float], events: int
    ) -> tuple[list[Arc], str | None, float, Exception | None]:
        """The arcs of a run between two times, why and when it ended, and its exception if it failed."""
    def fates(
        self,
        runs: Sequence[tuple[str, Sequence[float], Sequence[float]]],
        times: tuple[float, float],
        events: int,
        threads: int | None,
        progress: Any,
    ) -> dict[str, Any]:
        """How each of many runs ends: a dictionary of lists and arrays."""

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
    def dimension(self) -> int:
        """The number of coordinates."""
    def image(self, point: ArrayLike, parameter: float) -> dict[str, Any]:
        """The image of a point: a dictionary with the point, the return time, the itinerary and the certainty."""
    def linearized(self, point: ArrayLike, parameter: float) -> dict[str, Any]:
        """The image of a point, its derivatives by the point and by the parameter, and their errors."""
    def orbit(self, point: ArrayLike, parameter: float, images: int) -> NDArray[np.float64]:
        """The points of an orbit, one a row: the start, and its images."""
    def periodic_point(self, start: ArrayLike, parameter: float, period: int) -> dict[str, Any]:
        """The point of a period near a start: a dictionary."""
    def branch(
        self, start: ArrayLike, parameter: float, period: int, window: tuple[float, float], longest: float
    ) -> tuple[list[dict[str, Any]], list[dict[str, Any]], list[str]]:
        """The branch of periodic points through one near a start, in a window of parameters: dictionaries of its points and of its bifurcations, and the
        reasons of its ends.
        """
    def diagram(
        self,
        parameters: Sequence[float],
        seeds: Sequence[Sequence[float]],
        transient: int,
        keep: int,
        carried: bool = False,
        progress: Callable[[int, int], Any] | bool | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], list[tuple[float, str]]]:
        """The bifurcation diagram: parameters and points that belong together, with the texts of errors of orbits that failed."""
    def lyapunov(
        self, start: ArrayLike, parameter: float, transient: int, images: int
    ) -> list[tuple[float, float, float]]:
        """Lyapunov exponents of an orbit: for each image, with the lower and upper ends of their intervals."""

@final
class ProvedBasins:
    """The basins of nonsmooth.proved_basins. Codes count the traps, and then the surfaces."""
    def traps(self) -> list[tuple[tuple[Any, ...], list[float], list[list[float]], float]]:
        """The traps."""
    def surfaces(self) -> list[str]:
        """The surfaces at which points stop."""
    def images(self) -> int:
        """The images that were computed."""
    def shares(self) -> list[float]:
        """A lower bound of the share of each fate."""
    def certificate(self) -> str | None:
        """The certificate."""
    def codes(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        """The codes of the fates of points, each a row."""
    def cells(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """The cells with a fate, with the low and then the high ends of each one in a row, and the codes of their fates."""

@final
class Steps:
    """A map of states: of formulas, of a flow over some time, or of returns to a surface.

    Orbits that end at a surface which ends the run have a label of their own: 65001 for the first one of `ends`, 65002 for the second, and so on; of a
    surface that is not among them ESCAPED.
    """

    @staticmethod
    def of_flow(
        equations: Equations, modes: Sequence[str], times: tuple[float, float], ends: Sequence[str]
    ) -> Steps:
        """The flow of equations between two times. With several modes the number of the mode is the last coordinate of a state."""
    @staticmethod
    def of_returns(returns: ReturnMap, parameter: float, ends: Sequence[str]) -> Steps:
        """The returns of a return map at a value of its parameter."""
    @staticmethod
    def of_formulas(formulas: Formulas) -> Steps:
        """The map of formulas, one for each component of the state."""
    @property
    def dimension(self) -> int:
        """The number of coordinates of a state."""
    def __call__(self, state: Sequence[float]) -> list[float] | None: ...

def arc_states(arcs: Sequence[Arc], times: ArrayLike) -> NDArray[np.float64]:
    """The states of a run with these arcs at rising times, one row for each: after all events at each of them."""
def arc_trajectory(arcs: Sequence[Arc], grid: ArrayLike) -> dict[str, Any]:
    """A run with these arcs as arrays, as Execution.trajectory."""
def sensitivity(arcs: Sequence[Arc]) -> NDArray[np.float64]:
    """The derivative of the state at the end of the last arc, after its event, by the start of the first one: a matrix.

    arcs are consecutive ones of one execution. Orbits with other starts are compared at the same time: an event
    that comes later by δτ changes the state after it (saltation). The derivatives of the functions are central
    differences, with about ten digits; a field has its variational equation. The model needs field=, also beside a
    flow in closed form. A parameter is a component of the state that never changes.

    >>> from nonsmooth.hybrid import Guard, HybridSystem, sensitivity
    >>> ball = HybridSystem(
    ...     field=lambda mode, x: [x[1], -1.0],
    ...     guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0.0, -x[1] / 2]))],
    ... )
    >>> arcs = [arc for arc in ball.run([0.0, 3.0], time=7)]
    >>> round(float(sensitivity(arcs[:1])[1, 1]), 6)    # faster by δ: it leaves faster by δ/2, and 2δ later
    2.5

    ValueError where there is no derivative: an event that only touches its surface, two surfaces reached at one
    instant, a Zeno limit.
    """
def event_sensitivity(arc: Arc) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The derivatives of the event that ends an arc by the start of the arc: the matrix ∂x⁺/∂x₀ of the state right
    after the event, and the row ∂τ/∂x₀ of its time. States of different orbits are compared at their events, and
    sensitivity() compares them at one time.

    ValueError as for sensitivity(), and if no event ends the arc, or the event ends the execution.
    """
