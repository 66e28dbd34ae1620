"""Pictures with matplotlib. Each function draws into ``ax``, or into new axes, and returns them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .labelling import ESCAPED

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from ._native import Attractors
    from .along import AttractorsAlong
    from .returns import Branch, Diagram, ReturnMap
    from .runs import Run

#: Colours of basins, which readers with any colour vision tell apart (P. Tol, 2021): undecided pixels are white.
_COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as pyplot
    except ImportError as error:
        raise ImportError("pictures need matplotlib: pip install 'passive-hopper[plots]'") from error
    return pyplot.subplots()[1]


def plot_basins(
    dataset: xarray.Dataset, ax: Axes | None = None, *, attractors: Attractors | None = None, coordinates: tuple[int, int] | None = None
) -> Axes:
    """The labels of a Dataset of :func:`basins_of`, with a legend. Undecided pixels are white, those of orbits that escape grey. Points of ``attractors`` are
    dots, at the two ``coordinates`` of a state that the window has: by default those that the Dataset names."""
    axes = _axes(ax)
    from matplotlib.colors import to_rgb
    from matplotlib.patches import Patch

    labels = dataset["label"]
    first, second = labels.dims
    codes = np.unique(labels.values)
    names = str(labels.attrs.get("flag_meanings", "")).split()
    known = dict(zip(np.asarray(labels.attrs.get("flag_values", [])).tolist(), names))
    basins = [int(code) for code in codes if code < 65001]
    colours = {code: to_rgb(_COLOURS[k % len(_COLOURS)]) for k, code in enumerate(basins)}
    ends = [int(code) for code in codes if 65001 <= code <= 65529]
    colours.update({code: (0.75 - 0.3 * k / max(1, len(ends)),) * 3 for k, code in enumerate(ends)})
    image = np.ones((*labels.shape, 3))
    for code, colour in colours.items():
        image[labels.values == code] = colour
    x, y = dataset[first].values, dataset[second].values
    half = [0.5 * (axis[1] - axis[0]) if len(axis) > 1 else 0.5 for axis in (x, y)]
    extent = (x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1])
    axes.imshow(image.transpose(1, 0, 2), origin="lower", extent=extent, aspect="auto", interpolation="nearest")
    entries = [
        Patch(facecolor=colours.get(int(code), (1.0, 1.0, 1.0)), edgecolor="0.3", linewidth=0.5, label=known.get(int(code), str(code)).replace("_", " "))
        for code in codes
    ]
    for label, points in (attractors.points if attractors is not None else {}).items():
        dots = points[:, list(coordinates if coordinates is not None else dataset.attrs.get("components", (0, 1)))]
        axes.plot(*dots.T, "o", markersize=4, markerfacecolor=colours.get(label, "white"), markeredgecolor="black", markeredgewidth=0.8)
    axes.legend(handles=entries, loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)
    axes.set(xlabel=str(first), ylabel=str(second), xlim=extent[:2], ylim=extent[2:])
    return axes


def plot_fractions(along: AttractorsAlong, ax: Axes | None = None, name: str = "parameter") -> Axes:
    """The fractions of the basins along a parameter, with their 95 % intervals, and a dotted line where an attractor appears or vanishes."""
    axes = _axes(ax)
    for k, (label, (value, lower, upper)) in enumerate(along.fractions.items()):
        colour = _COLOURS[k % len(_COLOURS)]
        axes.fill_between(along.parameter, lower, upper, color=colour, alpha=0.25, linewidth=0)
        axes.plot(along.parameter, value, color=colour, label="escaped" if label == ESCAPED else f"basin {label}")
    for change in along.changes:
        axes.axvline(0.5 * (change.start + change.end), color="0.4", linestyle=":", linewidth=0.8)
    axes.set(xlabel=name, ylabel="fraction", ylim=(0, 1))
    axes.legend(frameon=False)
    return axes


def plot_run(run: Run, components: list[str] | None = None, ax: Axes | None = None) -> Axes:
    """The components of a run over time, broken at each event that moves them, with a thin line there."""
    axes = _axes(ax)
    rows = run.trajectory
    for name in components or run.names:
        k = run.names.index(name)
        times, values = _broken(rows, rows["times"], rows["states"][:, k])
        axes.plot(times, values, label=name)
    for time in rows["event_times"]:
        axes.axvline(time, color="0.85", linewidth=0.6, zorder=0)
    axes.set(xlabel="t")
    axes.legend(frameon=False)
    return axes


def plot_phase(run: Run, x: str | None = None, y: str | None = None, ax: Axes | None = None) -> Axes:
    """A run in the plane of two components, the first two by default, broken at each event that moves it."""
    axes = _axes(ax)
    across, up = x or run.names[0], y or run.names[min(1, len(run.names) - 1)]
    rows = run.trajectory
    columns = [rows["states"][:, run.names.index(name)] for name in (across, up)]
    axes.plot(*_broken(rows, *columns), linewidth=1.0)
    axes.set(xlabel=across, ylabel=up)
    return axes


def _broken(rows: dict[str, Any], *columns: Any) -> list[Any]:
    """Columns with a gap where an event moves the state."""
    at = np.flatnonzero(np.diff(rows["jumps"]) > 0) + 1
    moved = [k for k in at if not np.array_equal(rows["states"][k], rows["states"][k - 1])]
    return [np.insert(np.asarray(column, dtype=float), moved, np.nan) for column in columns]


def plot_cobweb(
    map: ReturnMap, start: float, window: tuple[float, float], images: int = 50, value: float | None = None, ax: Axes | None = None
) -> Axes:
    """The graph of a return map with one coordinate, the diagonal, and an orbit. Points without an image are left out."""
    axes = _axes(ax)
    points = np.linspace(*window, 500)
    values = np.array([_image(map, point, value) for point in points])
    axes.plot(points, values, linewidth=1.2)
    axes.plot(window, window, color="0.6", linewidth=0.8)
    orbit = map.orbit([start], images, value).ravel()
    path_x = np.repeat(orbit, 2)[:-1]
    path_y = np.concatenate([[orbit[0]], np.repeat(orbit[1:], 2)])
    axes.plot(path_x, path_y, color="#ee6677", linewidth=0.8)
    axes.set(xlabel="x", ylabel="f(x)", xlim=window)
    return axes


def _image(map: ReturnMap, point: float, value: float | None) -> float:
    try:
        return float(map([point], value)[0])
    except (ValueError, ArithmeticError):
        return float("nan")


def plot_diagram(diagram: Diagram, coordinate: int = 0, ax: Axes | None = None) -> Axes:
    """A bifurcation diagram, point by point."""
    axes = _axes(ax)
    axes.plot(diagram.parameter, diagram.point[:, coordinate], ",", color="black", rasterized=True)
    axes.set(xlabel="parameter", ylabel=f"x{coordinate}")
    return axes


def plot_branch(branch: Branch, coordinate: int = 0, ax: Axes | None = None) -> Axes:
    """A branch of periodic points: solid where it attracts, dashed where not, with its bifurcations."""
    axes = _axes(ax)
    values = branch.point[:, coordinate]
    for stable, style in ((True, "-"), (False, "--")):
        shown = np.where(branch.is_stable == stable, values, np.nan)
        axes.plot(branch.parameter, shown, style, color="#4477aa")
    for own in branch.bifurcations:
        axes.plot(own.parameter, own.point[coordinate], "o", color="#ee6677", markersize=4)
        axes.annotate(own.kind, (own.parameter, own.point[coordinate]), textcoords="offset points", xytext=(4, 4))
    axes.set(xlabel="parameter", ylabel=f"x{coordinate}")
    return axes
