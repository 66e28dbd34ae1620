"""Periodic orbits that exist: what is proved holds what runs find, and what is not proved is an exception."""

import numpy as np
import pytest

import nonsmooth as ns


def oscillator(**parameters):
    return ns.System(
        lambda t, x, p: [x[1], p.F * np.cos(1.3 * t) - 0.1 * x[1] - x[0]],
        states="x v",
        parameters={"F": 1.0, **parameters},
        guards=[ns.Guard("stop", lambda t, x, p: x[0] - 0.5, "rising", reset=lambda t, x, p: [x[0], -0.8 * x[1]])],
    )


QUESTION = {"guess": {"v": -1.48, "s": 0.16}, "start": ["0.5", "v", "s"], "read": ["v", "t - 2*pi/1.3"]}


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
