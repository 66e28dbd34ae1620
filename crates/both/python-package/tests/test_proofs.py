"""Periodic orbits that exist, and basins: what is proved holds what runs find, and what is not proved is an exception."""

import json
import pickle

import numpy as np
import pytest

import nonsmooth as ns


def oscillator(**parameters):
    return ns.System(
        lambda t, x, p: [x[1], p.F * np.cos(p.w * t) - 0.1 * x[1] - x[0]],
        states="x v",
        parameters={"F": 1.0, "w": 1.3, **parameters},
        guards=[ns.Guard("stop", lambda t, x, p: x[0] - 0.5, "rising", reset=lambda t, x, p: [x[0], -0.8 * x[1]])],
    )


QUESTION = {"guess": {"v": -1.48, "s": 0.16}, "start": ["0.5", "v", "s"], "read": ["v", "t - 2*pi/w"]}


def test_an_orbit_with_impacts_is_proved_and_holds_that_of_a_long_run():
    orbit = ns.proved_orbit(oscillator(), "stop", **QUESTION)
    assert orbit.attracting and not orbit.saddle
    assert orbit.variables == ["v", "s"] and orbit.point.shape == (2, 2)
    assert np.ptp(orbit.point, axis=1).max() < 1e-12
    run = oscillator().run([0, 1], time=400)
    speed = run.events[-1].after[1]
    assert abs(speed - orbit.point[0].mean()) < 1e-7
    assert orbit.events[0].surface == "stop"
    assert orbit.events[0].time[0] <= 2 * np.pi / 1.3 <= orbit.events[0].time[1]
    sizes = [abs(own.centre) for own in orbit.multipliers]
    assert max(sizes) + orbit.multipliers[0].radius < 1


def test_an_interval_of_a_parameter():
    wide = ns.proved_orbit(oscillator(), "stop", intervals={"F": (0.999, 1.001)}, **QUESTION)
    narrow = ns.proved_orbit(oscillator(), "stop", **QUESTION)
    assert wide.attracting
    assert (wide.point[:, 0] <= narrow.point[:, 0]).all() and (narrow.point[:, 1] <= wide.point[:, 1]).all()


def test_what_is_not_proved_says_why():
    with pytest.raises(ns.UndecidedError, match="Newton|undecided"):
        ns.proved_orbit(oscillator(), "stop", intervals={"F": (0.5, 1.5)}, **QUESTION)
    with pytest.raises(ns.InputError, match="no parameter 'G'"):
        ns.proved_orbit(oscillator(), "stop", intervals={"G": (0, 1)}, **QUESTION)
    with pytest.raises(ns.InputError, match="lower"):
        ns.proved_orbit(oscillator(), "stop", intervals={"F": (1, 0)}, **QUESTION)
    with pytest.raises(ns.InputError, match="surface"):
        ns.proved_orbit(oscillator(), "floor", **QUESTION)
    with pytest.raises(ns.InputError):
        ns.proved_orbit(oscillator(), "stop", guess={"v": np.nan, "s": 0.1}, start=["0.5", "v", "s"])
    with pytest.raises(ns.TracingError, match="no formulas"):
        called = ns.System(lambda t, x, p: [1.0 if x[0] > 0 else 2.0], states="x")
        ns.proved_orbit(called, "stop", guess={"x": 1.0}, start=["x"])


def well():
    return ns.System(["v", "x - x^3 - v/2"], states="x v", guards=[ns.Guard("later", "t - 3", "rising")])


BASINS = {
    "guesses": [{"x": 1, "v": 0}, {"x": -1, "v": 0}],
    "start": ["x", "v", "0"],
    "window": {"x": (-1.5, 1.5), "v": (-1, 1)},
    "first": 4,
    "last": 6,
}


def test_proved_basins_have_the_fates_of_runs():
    seen = []
    basins = ns.proved_basins(well(), "later", progress=lambda done, all: seen.append((done, all)), **BASINS)
    assert seen[0][1] == 20_000 and seen[-1] == (basins.images, basins.images)
    assert basins.surfaces == [] and len(basins.traps) == 2
    assert basins.shares.sum() > 0.6 and abs(basins.shares[0] - basins.shares[1]) < 0.01
    points = np.random.default_rng(1).uniform([-1.5, -1], [1.5, 1], (60, 2))
    codes = basins.at(points)
    assert (codes >= 0).sum() > 30
    for point, code in zip(points, codes, strict=True):
        if code >= 0:
            end = ns.System(["v", "x - x^3 - v/2"], states="x v").run(point, time=60).y[:, -1]
            assert np.hypot(end[0] - [1, -1][code], end[1]) < 1e-3
    # Cells and pixels say the same.
    middles = basins.cells.mean(axis=2)
    assert (basins.at(middles) == basins.codes).all()
    raster = basins.raster((31, 20))
    assert raster.shape == (31, 20) and raster[15, 10] == -1 and (raster == basins.raster([31, 20])).all()
    assert basins.traps[0].orbit.attracting
    directions = basins.traps[0].directions
    inside = basins.traps[0].centre + directions @ (0.99 * basins.traps[0].size * np.array([1, -1]))
    assert basins.at(inside) in (0, -1) and basins.at(basins.traps[0].centre) == 0


def test_a_start_that_stops_has_the_fate_of_the_surface():
    ball = ns.System(
        ["v", "-x - v"],
        states="x v",
        guards=[ns.Guard("later", "t - 5", "rising"), ns.Guard("wall", "x - 1", "rising", terminal=True)],
    )
    window = {"x": (-0.9, 0.9), "v": (-0.5, 4)}
    basins = ns.proved_basins(
        ball, "later", guesses=[{"x": 0, "v": 0}], start=["x", "v", "0"], window=window, first=4, last=6
    )
    assert basins.surfaces == ["wall"] and (basins.shares > 0.2).all()
    assert list(basins.at([[0.9, 3.5], [0.05, 0.0]])) == [1, 0]


def test_certificates_are_written(tmp_path):
    file = tmp_path / "mine.jsonl"
    orbit = ns.proved_orbit(oscillator(), "stop", certificate=file, **QUESTION)
    assert orbit.attracting
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert lines[0]["name"] == "mine" and lines[-1]["kind"] == "fixed-point"
    basins = ns.proved_basins(well(), "later", certificate=str(file), **{**BASINS, "last": 5})
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert sum(line.get("kind") == "cell" for line in lines) == len(basins.codes)


def test_wrong_questions_about_basins_say_why():
    with pytest.raises(ns.InputError, match="guess"):
        ns.proved_basins(well(), "later", **{**BASINS, "guesses": [{"x": 1}]})
    with pytest.raises(ns.InputError, match="images"):
        ns.proved_basins(well(), "later", images=10, **BASINS)
    with pytest.raises(ns.InputError, match="first"):
        ns.proved_basins(well(), "later", **{**BASINS, "first": 8})
    with pytest.raises(ns.InputError):
        ns.proved_basins(well(), "later", **{**BASINS, "window": {"x": (1, -1), "v": (0, 1)}})
    with pytest.raises(ns.UndecidedError):
        # A saddle attracts nothing.
        ns.proved_basins(well(), "later", **{**BASINS, "guesses": [{"x": 0, "v": 0}]})
    basins = ns.proved_basins(well(), "later", **{**BASINS, "last": 4})
    with pytest.raises(ns.InputError, match="variables"):
        basins.at([1.0, 2.0, 3.0])
    with pytest.raises(TypeError, match="certificate"):
        pickle.dumps(basins)
    assert basins.at([5.0, 0.0]) == -1 and basins.at([np.nan, 0.0]) == -1


def test_a_map_that_ends_in_another_mode_is_no_return():
    relay = ns.System(
        {"a": ["1 - x"], "b": ["-x"]},
        states="x",
        guards=[
            ns.Guard("switch", "x - 0.5", "rising", modes=["a"], to="b"),
            ns.Guard("back", "x - 0.2", "falling", modes=["b"]),
        ],
    )
    with pytest.raises(ns.UndecidedError, match="ends in the mode b"):
        ns.proved_orbit(relay, "back", guess={"x": 0.2}, start=["x"], mode="a")
