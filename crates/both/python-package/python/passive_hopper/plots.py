"""Pictures with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nonsmooth import _native

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _matplotlib():
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("pictures need matplotlib: pip install 'passive-hopper[plots]'") from error
    return matplotlib.pyplot


def cobweb(mass_ratio: float, alpha: float, hops: int = 30, ax: Axes | None = None) -> Axes:
    """Draws the map and the orbit from ``alpha`` as a cobweb; returns the axes."""
    import numpy

    plt = _matplotlib()
    ax = ax or plt.figure(figsize=(4, 4), layout="constrained").add_subplot()
    lift_off_map = _native.LiftOffMap(mass_ratio)
    orbit = lift_off_map.orbit(alpha, hops)
    top = 1.05 * float(orbit.max())
    speeds = numpy.linspace(top / 4000, top, 4000)
    images = lift_off_map(speeds)
    ax.plot([0, top], [0, top], color="0.6", linewidth=0.8)
    # The map jumps: a line across a jump would be no part of it.
    images[1:][numpy.abs(numpy.diff(images)) > 0.05 * top] = numpy.nan
    ax.plot(speeds, images, color="black", linewidth=1)
    corners = numpy.repeat(orbit, 2)
    ax.plot(corners[:-1], corners[1:], color="tab:red", linewidth=0.9)
    ax.set(xlim=(0, top), ylim=(0, top), aspect="equal")
    ax.set_xlabel(r"lift-off speed $\alpha$")
    ax.set_ylabel(r"next lift-off speed $\alpha'$")
    ax.set_title(f"M = {mass_ratio:g}")
    return ax


def plot_basins(
    M: tuple[float, float] = (0.1, 1.0),
    alpha: tuple[float, float] | None = None,
    shape: tuple[int, int] = (512, 512),
    ax: Axes | None = None,
    legend: bool = True,
) -> Axes:
    """Draws the basins over a window of (M, α), with a legend unless that is switched off; returns the axes."""
    import numpy
    from matplotlib.colors import to_rgb
    from matplotlib.patches import Patch

    plt = _matplotlib()
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    alpha = _native.first_window() if alpha is None else alpha
    _, _, labels = _native.basin_labels(M=M, alpha=alpha, shape=shape)
    picture = numpy.empty(labels.T.shape + (3,))
    entries = []
    for code in (int(code) for code in numpy.unique(labels)):
        colour = _native.label_colour(code)
        picture[labels.T == code] = to_rgb(colour)
        entries.append(Patch(facecolor=colour, edgecolor="0.3", linewidth=0.5, label=_native.label_name(code)))
    ax.imshow(picture, origin="lower", extent=(*M, *alpha), aspect="auto", interpolation="nearest")
    ax.set_xlabel("mass ratio M")
    ax.set_ylabel(r"lift-off speed $\alpha$")
    if legend:
        ax.figure.legend(handles=entries, loc="outside right upper", frameon=False)
    return ax
