"""An exception names what was wrong: the function, the argument, and its number."""

import numpy as np
import passive_hopper as hopper
import pytest
from nonsmooth import hybrid, labelling
from passive_hopper import motion

NAN, INF = float("nan"), float("inf")


def system(**given):
    return hybrid.HybridSystem(**({"field": lambda mode, x: [1.0]} | given))


def run(own, start=(0.0,), time=2.0, **given):
    return list(own.run(list(start), time=time, **given))


def at(where, **given):
    return hybrid.Guard("g", lambda x: x[0] - where, "rising", **({"reset": lambda mode, x: (mode, [0.0])} | given))


CALLS = {
    "field nan at once": (
        lambda: run(system(field=lambda mode, x: [NAN])),
        ArithmeticError,
        "field returned [nan] in mode None from the state [0.0]",
    ),
    "field nan at once, with a guard": (
        lambda: run(system(field=lambda mode, x: [NAN], guards=[at(1.0)])),
        ArithmeticError,
        "field returned [nan] in mode None",
    ),
    "field nan later": (
        lambda: run(system(field=lambda mode, x: [NAN if x[0] > 1 else 1.0])),
        ArithmeticError,
        "field returned [nan]",
    ),
    "field inf": (lambda: run(system(field=lambda mode, x: [INF])), ArithmeticError, "field returned [inf]"),
    "blow-up": (
        lambda: run(system(field=lambda mode, x: [x[0] ** 2]), start=[1.0]),
        ArithmeticError,
        "stopped at time 0.99",
    ),
    "field of a wrong type": (
        lambda: run(system(field=lambda mode, x: "no")),
        TypeError,
        "field returned something wrong",
    ),
    "field of a number": (lambda: run(system(field=lambda mode, x: 1.0)), TypeError, "field returned something wrong"),
    "field of two numbers": (
        lambda: run(system(field=lambda mode, x: [1.0, 2.0])),
        ValueError,
        "field returned 2 numbers",
    ),
    "flow nan": (
        lambda: run(system(field=None, flow=lambda mode, x, t: [NAN], guards=[at(1.0)], sampled=0.1)),
        ArithmeticError,
        "flow over the time",
    ),
    "guard nan": (
        lambda: run(system(guards=[hybrid.Guard("g", lambda x: NAN, "rising", reset=lambda mode, x: (mode, x))])),
        ArithmeticError,
        "the value of \"g\" is nan",
    ),
    "guard of an array": (
        lambda: run(system(guards=[hybrid.Guard("g", lambda x: [x[0]], "rising", reset=lambda mode, x: (mode, x))])),
        TypeError,
        "the value of \"g\" returned something wrong",
    ),
    "reset nan": (
        lambda: run(system(guards=[at(1.0, reset=lambda mode, x: (mode, [NAN]))])),
        ValueError,
        "the reset of \"g\" returned the state [nan]",
    ),
    "reset into no mode": (
        lambda: run(system(guards=[at(1.0, reset=lambda mode, x: ([], [0.0]))])),
        TypeError,
        "the reset of \"g\"",
    ),
    "clock nan": (
        lambda: run(system(guards=[hybrid.Clock("c", times=lambda time: NAN)])),
        ValueError,
        "the times of \"c\" returned nan",
    ),
    "clock of a text": (
        lambda: run(system(guards=[hybrid.Clock("c", times=lambda time: "no")])),
        TypeError,
        "the times of \"c\"",
    ),
    "clock of both": (lambda: hybrid.Clock("c", times=[1.0], period=1.0), ValueError, "has both"),
    "clock of times and first": (lambda: hybrid.Clock("c", times=[1.0], first=5.0), ValueError, "first=5.0"),
    "enclosure of one number": (
        lambda: run(
            system(
                field=None,
                flow=lambda mode, x, t: [x[0] + t],
                guards=[at(1.0, enclosure=lambda mode, x, order, times: [1.0])],
            )
        ),
        TypeError,
        "the enclosure of \"g\"",
    ),
    "enclosure nan": (
        lambda: run(
            system(
                field=None,
                flow=lambda mode, x, t: [x[0] + t],
                guards=[at(1.0, enclosure=lambda mode, x, order, times: (NAN, 1.0))],
            )
        ),
        ValueError,
        "the enclosure of \"g\" returned (nan, 1.0)",
    ),
    "enclosure reversed": (
        lambda: run(
            system(
                field=None,
                flow=lambda mode, x, t: [x[0] + t],
                guards=[at(1.0, enclosure=lambda mode, x, order, times: (2.0, 1.0))],
            )
        ),
        ValueError,
        "the enclosure of \"g\" returned (2.0, 1.0)",
    ),
    "signal nan": (
        lambda: run(
            system(
                field=None,
                flow=lambda mode, x, t: [x[0] + t],
                guards=[at(1.0, signal=lambda mode, x: hybrid.QuasiPolynomial.polynomial([NAN]))],
            )
        ),
        ValueError,
        "the signal of \"g\" returned a function that is nan",
    ),
    "guard of a bool": (
        lambda: run(system(guards=[hybrid.Guard("g", lambda x: x[0] > 1, "rising", reset=lambda mode, x: (mode, x))])),
        TypeError,
        "the value of \"g\" returned False",
    ),
    "guard of True": (
        lambda: run(
            system(guards=[hybrid.Guard("g", lambda x: bool(x[0] > -1), "rising", reset=lambda mode, x: (mode, x))])
        ),
        TypeError,
        "the value of \"g\" returned True",
    ),
    "time nan": (lambda: run(system(), time=NAN), ValueError, "the time"),
    "start of a text": (lambda: run(system(), start=["a"]), TypeError, "start is no vector of numbers"),
    "map nan": (
        lambda: labelling.Attractors(lambda x: [NAN], region=[(-1, 1)], starts=[[0.5]]),
        ArithmeticError,
        "the map returned [nan] from [0.5]",
    ),
    "StopIteration": (
        lambda: run(system(field=lambda mode, x: next(iter([])))),
        RuntimeError,
        "field raised StopIteration",
    ),
    "tolerance": (lambda: system(tolerance=NAN), ValueError, "tolerance must be positive"),
    "longest_step": (lambda: system(longest_step=0.0), ValueError, "longest_step must be positive"),
    "check_interval": (lambda: system(check_interval=-1.0), ValueError, "check_interval must be positive"),
    "sampled": (lambda: system(sampled=NAN), ValueError, "sampled must be positive"),
    "time before start_time": (
        lambda: run(system(), time=1.0, start_time=5.0),
        ValueError,
        "time=1.0 is before start_time=5.0",
    ),
    "states out of order": (
        lambda: run(system())[0].states([2.0, 1.0]),
        ValueError,
        "elapsed[1]=1.0 is before elapsed[0]=2.0",
    ),
    "states beyond the arc": (lambda: run(system())[0].states([5.0]), ValueError, "the arc lasts 2.0"),
    "motion of a moment": (
        lambda: hopper.animate(motion(7.0, hops=1).isel(sample=slice(0, 1)), "x.gif"),
        ValueError,
        "lasts no time",
    ),
    "animate a number": (lambda: hopper.animate(3, "x.gif"), ValueError, "it is int"),
    "animate without hops": (
        lambda: hopper.animate(motion(7.0, hops=1).drop_vars("hop"), "x.gif"),
        ValueError,
        "hop is missing",
    ),
    "negative mass ratios": (
        lambda: hopper.basins(M=(-1.0, 1.0), shape=(4, 4)),
        ValueError,
        "M=(-1.0, 1.0) is no window",
    ),
    "an empty window": (
        lambda: hopper.basins(alpha=(4.0, 4.0), shape=(4, 4)),
        ValueError,
        "alpha=(4.0, 4.0) is no window",
    ),
    "a window narrower than floats": (
        lambda: hopper.basins(alpha=(4.0, np.nextafter(4.0, 5.0)), shape=(4, 4)),
        ValueError,
        "fewer floats",
    ),
    "more points than memory": (
        lambda: labelling.region_fractions(lambda x, y: x > y, [(0, 1), (0, 1)], count=10**13),
        MemoryError,
        "10000000000000 results",
    ),
    "more pairs than memory": (
        lambda: labelling.uncertainty_exponent(lambda x, y: x > y, [(0, 1), (0, 1)], [0.1, 0.2], count=10**13),
        MemoryError,
        "20000000000000 results",
    ),
    "no name of a coordinate": (
        lambda: labelling.basins_of(lambda x, y: x > y, {3: (0, 1), 4: (0, 1)}, shape=(2, 2)),
        ValueError,
        "not 3",
    ),
    "label as a coordinate": (
        lambda: labelling.basins_of(lambda x, y: x > y, {"label": (0, 1), "y": (0, 1)}, shape=(2, 2)),
        ValueError,
        "'label'",
    ),
    "names that are no mapping": (
        lambda: labelling.basins_of(lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(2, 2), names=3),
        TypeError,
        "names maps labels",
    ),
    "two names that are one": (
        lambda: labelling.basins_of(
            lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(2, 2), names={0: "a", 1: "a"}
        ),
        ValueError,
        "two labels are named 'a'",
    ),
}


@pytest.mark.parametrize("name", CALLS)
def test_the_exception_names_its_cause(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, kind, text = CALLS[name]
    with pytest.raises(kind) as raised:
        call()
    assert text in str(raised.value), str(raised.value)


def test_progress_that_raises_stop_iteration_ends_with_an_error(tmp_path):
    pytest.importorskip("zarr", reason="stores need zarr")

    def stop(done, all):
        raise StopIteration

    for call in (
        lambda: hopper.basins(shape=(4, 4), store=tmp_path / "a.zarr", progress=stop),
        lambda: labelling.basins_of(lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(4, 4), progress=stop),
    ):
        with pytest.raises(RuntimeError, match="StopIteration"):
            call()
