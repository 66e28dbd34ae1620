"""Basins of systems, and pictures of what one has: into given axes, or new ones."""

import nonsmooth as ns
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
pytest.importorskip("xarray")

WINDOW = {"x": (-2.2, 2.2), "v": (-2.2, 2.2)}


def duffing(**parameters):
    return ns.System(
        lambda t, x, p: [x[1], x[0] - x[0] ** 3 - 0.15 * x[1] + p.f * np.cos(t)], states="x v", parameters={"f": 0.2, **parameters}
    )


def ball():
    return ns.System(
        lambda t, x, p: [x[1], -1],
        states="height speed",
        parameters={"r": 0.5},
        guards=[ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -p.r * x[1] + 0.3])],
    )


def test_basins_of_a_system_are_those_of_its_attractors():
    system = duffing()
    found = ns.attractors_of(system, WINDOW, step=2 * np.pi, starts=[[1, 0], [-1, 0]], locate=50, tests=50)
    one = ns.basins_of(system, WINDOW, (24, 16), step=2 * np.pi, attractors=found)
    assert one.label.shape == (24, 16) and set(np.unique(one.label)) == {1, 2} and one.steps.shape == (24, 16)
    x, v = float(one.x[3]), float(one.v[5])
    label, steps = found.convergences([[x, v]])
    assert (one.label.values[3, 5], one.steps.values[3, 5]) == (label[0], steps[0])
    # A search of its own, on one thread, in the other order of the axes.
    own = ns.basins_of(system, {"v": WINDOW["v"], "x": WINDOW["x"]}, (16, 24), step=2 * np.pi, region=WINDOW, starts=[[1, 0], [-1, 0]], locate=50, tests=50, threads=1)
    assert (own.label.values.T == one.label.values).all()
    # Any labelling, as before.
    assert ns.basins_of(lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, (4, 4)).label.values.sum() == 6


def test_a_window_of_a_system_needs_what_it_needs():
    system = duffing()
    returns = ball().returns("floor", coordinates="speed")
    for call, words in [
        (lambda: ns.basins_of(system, WINDOW), "give step="),
        (lambda: ns.basins_of(system, {"x": (0, 1), "y": (0, 1)}, step=1), "the components of the state are: x, v"),
        (lambda: ns.basins_of(ns.System(["y", "z", "x"], states="x y z"), {"x": (0, 1), "y": (0, 1)}, step=1), "not in the window: z"),
        (lambda: ns.basins_of(ns.System(["y", "z", "x"], states="x y z"), {"x": (0, 1), "y": (0, 1)}, step=1, others={"z": 0}), "none of: z"),
        (lambda: ns.attractors_of(system, {"v": (0, 1), "x": (0, 1)}, step=1), "in this order: x, v"),
        (lambda: ns.basins_of(returns, WINDOW), "steps of a return map|not callable"),
        (lambda: ns.basins_of(system.steps(1), WINDOW, step=1), "have their own time"),
        (lambda: ns.map_steps(lambda t, x, p: [x[0] + t], states="x"), "time"),
        (lambda: system.steps(-1), "positive and finite time"),
    ]:
        with pytest.raises((ValueError, TypeError), match=words):
            call()


def test_every_picture_is_drawn_into_given_axes_or_new_ones():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    system, bounces = ball(), ball().returns("floor", coordinates="speed")
    run = system.run([1, 0], time=5)
    basins = ns.basins_of(lambda x, y: np.where(x > 0.5, 65001, np.where(y > 0.5, 65535, 1)), {"x": (0, 1), "y": (0, 1)}, (8, 8))
    draw = [
        lambda ax: ns.plots.plot_basins(basins, ax),
        lambda ax: ns.plots.plot_run(run, ax=ax),
        lambda ax: ns.plots.plot_phase(run, ax=ax),
        lambda ax: ns.plots.plot_cobweb(bounces, 1.0, (0.1, 2.0), ax=ax),
        lambda ax: ns.plots.plot_diagram(bounces.diagram([0.2, 0.5], [[0.3]], keep=2), ax=ax),
        lambda ax: ns.plots.plot_branch(bounces.branch([0.6], (0.2, 0.8)), ax=ax),
    ]
    for own in draw:
        axes = pyplot.subplots()[1]
        assert own(axes) is axes and axes.has_data()
        assert own(None) is not axes
        pyplot.close("all")
    # The image has the labels where they are, and undecided pixels are white.
    (image,) = ns.plots.plot_basins(basins).images
    pixels = image.get_array()
    assert (pixels[0, 7] == pixels[7, 7]).all() and (pixels[7, 0] == 1.0).all() and not (pixels[0, 0] == pixels[0, 7]).all()
    # A curve is broken where an event moves it, and only there.
    (line,) = ns.plots.plot_phase(run).lines
    assert np.isnan(line.get_xdata()).sum() == len(run.events)
    pyplot.close("all")
