"""Runs of systems: what happened, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ._conventions import about, complete
from .errors import InputError

if TYPE_CHECKING:
    import pandas
    import xarray
    from numpy.typing import ArrayLike, NDArray

    from ._native import Event

#: Equal parts of the time of a run at which it has states, unless the caller gives times: enough for a picture of a page.
_PARTS = 1000


class _Solution(Protocol):
    @property
    def stop(self) -> str: ...
    @property
    def times(self) -> tuple[float, float]: ...
    @property
    def events(self) -> list[Event]: ...
    def states(self, times: ArrayLike, /) -> NDArray[np.float64]: ...
    def trajectory(self, grid: ArrayLike, /) -> dict[str, Any]: ...


class Run:
    """A run of a :class:`System`.

    ``t`` and ``y`` are its times and states, as SciPy has them: ``y[k]`` is the component k. Each event has two columns with one time, the states before
    and after it. ``events`` are the events, ``reason`` says why the run ended, and ``sol(t)`` is the state at any time between.

    >>> import nonsmooth as ns
    >>> ball = ns.System(
    ...     lambda t, x, p: [x[1], -9.81],
    ...     states=["height", "speed"],
    ...     guards=[ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -0.5 * x[1]])],
    ... )
    >>> run = ball.run([1, 0], time=1)
    >>> [(event.surface, round(event.time, 6)) for event in run.events]
    [('floor', 0.451524), ('floor', 0.903047)]
    >>> run.reason, run.y.shape[0], round(float(run.sol(0.5)[0]), 6)
    ('time limit', 2, 0.095817)
    """

    def __init__(self, states: list[str], solution: _Solution, times: ArrayLike | None) -> None:
        #: The names of the components.
        self.names = states
        self._solution = solution
        self._asked = None if times is None else np.asarray(times, dtype=float)

    @property
    def reason(self) -> str:
        """Why it ended: "time limit", "event limit", "terminal", "no further event", "zeno", "sliding", "unfinished" or "failed"."""
        return self._solution.stop

    @cached_property
    def events(self) -> list[Event]:
        """The events, in their order. Each has its ``surface``, ``time``, the states ``before`` and ``after``, and ``certainty``."""
        dimension = len(self.names)
        # The state of a model has the time behind its components, where functions use it.
        return [_of_dimension(event, dimension) for event in self._solution.events]

    @cached_property
    def trajectory(self) -> dict[str, Any]:
        """All rows and events as a dictionary of arrays: see :meth:`Execution.trajectory`."""
        begin, end = self._solution.times
        if self._asked is not None:
            grid = self._asked
        elif np.isfinite(end):
            grid = np.linspace(begin, end, _PARTS + 1)
        else:
            grid = np.array([begin])
        found = self._solution.trajectory(grid)
        found["states"] = found["states"][:, : len(self.names)]
        return found

    @property
    def t(self) -> NDArray[np.float64]:
        """The times, with two columns at each event. With ``t=`` of :meth:`System.run` the times asked for, as far as the run goes."""
        times: NDArray[np.float64] = self.trajectory["times"]
        return times if self._asked is None else times[self.trajectory["on_grid"]]

    @property
    def y(self) -> NDArray[np.float64]:
        """The states: one row for each component, one column for each time."""
        states: NDArray[np.float64] = self.trajectory["states"]
        return (states if self._asked is None else states[self.trajectory["on_grid"]]).T

    @property
    def modes(self) -> list[str]:
        """The mode at each time."""
        modes = self.trajectory["modes"]
        return modes if self._asked is None else [m for m, on in zip(modes, self.trajectory["on_grid"]) if on]

    def sol(self, t: ArrayLike) -> NDArray[np.float64]:
        """The state at a time, or one column for each of several times: after all events at each of them."""
        times = np.asarray(t, dtype=float)
        flat = times.ravel()
        order = np.argsort(flat, kind="stable")
        found = np.empty((len(flat), len(self.names)))
        found[order] = self._solution.states(flat[order])[:, : len(self.names)]
        return found[0] if times.ndim == 0 else found.T

    @property
    def end(self) -> NDArray[np.float64]:
        """The state at the end: before an event that ends the run."""
        return self.trajectory["states"][-1]

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each time: the components, the mode and the number of events before it."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas needs pandas: pip install pandas") from error
        self._check_names("t", "mode", "jump")
        rows = self.trajectory
        table = pandas.DataFrame(rows["states"], columns=self.names)
        table.insert(0, "t", rows["times"])
        table["mode"] = [str(mode) for mode in rows["modes"]]
        table["jump"] = rows["jumps"]
        return table if self._asked is None else table[rows["on_grid"]].reset_index(drop=True)

    def to_xarray(self) -> xarray.Dataset:
        """A Dataset with the components, the mode and the number of events, and the events along ``event``. The rows are along ``t``, if the run was asked for times;
        else along ``row`` with the coordinate ``t``, as an event has two rows at its time: ``found.x.plot(x="t")`` draws both."""
        try:
            import xarray
        except ImportError as error:
            raise ImportError("to_xarray needs xarray: pip install 'passive-hopper[xarray]'") from error
        self._check_names("t", "row", "mode", "jump", "event_time", "event_surface")
        rows = self.trajectory
        on, along = (slice(None), "row") if self._asked is None else (rows["on_grid"], "t")
        columns = {
            **{name: (along, rows["states"][on][:, k], name) for k, name in enumerate(self.names)},
            "mode": (along, np.array([str(mode) for mode in rows["modes"]])[on], "mode"),
            "jump": (along, rows["jumps"][on], "number of events before"),
            "event_time": ("event", rows["event_times"], "time of the event"),
            "event_surface": ("event", np.array(rows["event_surfaces"], dtype=str), "surface of the event"),
        }
        data = {name: (axis, values, {"long_name": text}) for name, (axis, values, text) in columns.items()}
        times = (along, rows["times"][on], {"long_name": "time"})
        return complete(xarray.Dataset(data, {"t": times}, {**about("a run of a hybrid system"), "reason": self.reason}))

    def _check_names(self, *columns: str) -> None:
        """A component with the name of another column would be lost."""
        for name in self.names:
            if name in columns:
                raise InputError(f"the component {name!r} has the name of another column of the table: name it otherwise; taken are {', '.join(columns)}")

    def __repr__(self) -> str:
        begin, end = self._solution.times
        return f"Run(t=({begin!r}, {end!r}), events={len(self.events)}, reason={self.reason!r})"


def _of_dimension(event: Event, dimension: int) -> Event:
    if len(event.before) == dimension:
        return event
    make, (kind, values) = event.__reduce__()
    cut = tuple(value[:dimension] if isinstance(value, np.ndarray) else value for value in values)
    found: Event = make(kind, cut)
    return found


@dataclass(frozen=True)
class Fates:
    """How each of many runs ended, in arrays with one entry for each run."""

    #: Why each run ended, as :attr:`Run.reason`; "failed: …" with the error for one that failed.
    reason: NDArray[np.str_]
    #: The surface whose event ended the run; empty for another reason.
    surface: NDArray[np.str_]
    #: The mode at the end.
    mode: NDArray[np.str_]
    #: The time at the end.
    time: NDArray[np.float64]
    #: The number of events.
    events: NDArray[np.uint64]
    #: The state at the end, one row for each run: before an event that ends it.
    state: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.reason)

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each run."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas needs pandas: pip install pandas") from error
        table = pandas.DataFrame(
            {"reason": self.reason, "surface": self.surface, "mode": self.mode, "time": self.time, "events": self.events}
        )
        for k in range(self.state.shape[1]):
            table[f"x{k}"] = self.state[:, k]
        return table
