"""Results, and what has no function of the user, go through pickle and copy and compare; the rest refuses and names the
function."""

import copy
import multiprocessing
import pickle

import numpy as np
import nonsmooth
import passive_hopper as hopper
import pytest
from nonsmooth import hybrid, labelling


def floor(x):
    return x[0]


def bounce(mode, x):
    return mode, [0.0, -x[1] / 2]


def ball(touch="error"):
    guard = hybrid.Guard("floor", floor, "falling", reset=bounce, touch=touch)
    return hybrid.HybridSystem(field=lambda mode, x: [x[1], -1.0], guards=[guard])


def sliding():
    both = lambda mode, x: [1.0 if mode == "down" else -1.0]
    guards = [
        hybrid.Guard("line", floor, "rising", reset=lambda mode, x: ("up", x), modes=["down"]),
        hybrid.Guard("line back", floor, "falling", reset=lambda mode, x: ("down", x), modes=["up"]),
    ]
    return list(hybrid.HybridSystem(field=both, guards=guards, slide="filippov").run([-1.0], mode="down", time=2))


IMAGE = np.arange(24, dtype=np.uint16).reshape(4, 6) % 3
MAP = hopper.LiftOffMap(0.2)

OBJECTS = {
    "LiftOffMap": lambda: MAP,
    "Hop": lambda: MAP.hop(7.0),
    "Landing": lambda: MAP.hop(7.0).landings[0],
    "grounded Hop": lambda: hopper.LiftOffMap(1.0).hop(2.0),
    "Fate": lambda: MAP.fate(7.0),
    "Trap": lambda: hopper.trap(1, 0.2),
    "Crisis": lambda: hopper.crisis(1),
    "Bounds": lambda: hopper.interval_basins(0.2, last=2, undecided=1e-2).fraction(1),
    "IntervalBasins": lambda: hopper.interval_basins(0.2, last=2, undecided=1e-2),
    "enclosed IntervalBasins": lambda: hopper.interval_basins(2.0, last=2, undecided=1e-1),
    "LabelImage": lambda: labelling.label_image(IMAGE),
    "BoxCount": lambda: labelling.label_image(IMAGE).boxes(2),
    "Interval": lambda: labelling.label_image(IMAGE).fractions()[1],
    "UncertaintyExponent": lambda: labelling.uncertainty_exponent(
        lambda x, y: x > y, [(0, 1), (0, 1)], [1e-3, 1e-2, 1e-1], count=2000
    ),
    "QuasiPolynomial": (
        lambda: hybrid.QuasiPolynomial.polynomial([0, -4, 0.5]) * hybrid.QuasiPolynomial.sine(5, 1.1).damped(0.3)
    ),
    "Clock of a period": lambda: hybrid.Clock("tick", period=0.5, first=0.25, modes=["a", ("b", 1)]),
    "Clock of times": lambda: hybrid.Clock("tick", times=[1.0, 2.5]),
    "Event": lambda: next(ball().run([1.0, 0.0], time=3)).event,
    "Zeno": lambda: next(arc.zeno for arc in ball().run([1.0, 0.0], time=9) if arc.zeno),
    "Sliding": lambda: next(arc.sliding for arc in sliding() if arc.sliding),
    "Equations": lambda: pendulum().equations,
    "Formulas": lambda: nonsmooth.tracing.Model(["x"], {"k": 0.1}).formulas("it", lambda t, x, p: [p.k * x[0] + 0.3]),
    "SlidingMode": lambda: next(arc.mode for arc in sliding() if isinstance(arc.mode, hybrid.SlidingMode)),
}


@pytest.mark.parametrize("name", OBJECTS)
def test_it_goes_through_pickle_and_copy_and_compares(name):
    own, again = OBJECTS[name](), OBJECTS[name]()
    assert own == again and not own != again
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        other = pickle.loads(pickle.dumps(own, protocol))
        assert other == own and type(other) is type(own) and repr(other) == repr(own)
    for other in (copy.copy(own), copy.deepcopy(own)):
        assert other == own
    assert own != "another thing"


def test_every_class_is_here_or_refuses():
    named = {name.split()[-1] for name in OBJECTS} | {"Clock"} | set(HOLDERS)
    # Parts of a call, and what a System makes plain objects of.
    named |= {"Symbol", "Trace", "Fates"}
    # They go through pickle, and are not compared.
    named |= {"Solution", "ReturnMap", "Steps"}
    # A proof with all its cells: nonsmooth.ProvedBasins says what to keep.
    named |= {"ProvedBasins"}
    # They hold a function of C.
    named |= {"CFunction", "CField", "CGuard", "CSystem"}
    classes = {name for name, own in vars(hopper._native).items() if isinstance(own, type)}
    assert classes <= named, classes - named


def test_other_objects_are_not_equal():
    assert hopper.trap(1, 0.2) != hopper.trap(2, 0.2)
    one, two = (next(ball().run([height, 0.0], time=3)).event for height in (1.0, 2.0))
    assert one != two
    assert hybrid.Clock("tick", period=0.5) != hybrid.Clock("tick", period=0.5, first=1.0)
    assert labelling.label_image(IMAGE) != labelling.label_image(IMAGE.T.copy())
    assert (labelling.label_image(IMAGE).array() == IMAGE).all()


def pendulum(**settings):
    field = lambda t, x, p: [x[1], -np.sin(x[0]) - p.damping * x[1]]  # noqa: E731
    return nonsmooth.System(field, states="x v", parameters={"damping": 0.1}, **settings)


HOLDERS = {
    "Guard": (lambda: hybrid.Guard("floor", floor, "falling", reset=bounce), ["value=", "reset=", "floor", "bounce"]),
    "Clock": (lambda: hybrid.Clock("tick", times=lambda time: time + 1), ["times=", "lambda"]),
    "HybridSystem": (ball, ["field=", "value of \"floor\"=", "reset of \"floor\"="]),
    "Arc": (lambda: next(ball().run([1.0, 0.0], time=3)), ["field="]),
    "Execution": (lambda: ball().run([1.0, 0.0], time=3), ["field="]),
    "Attractors": (lambda: labelling.Attractors(lambda x: x / 2, region=[(-1, 1)], starts=[[0.5]], tests=5), ["map="]),
}


@pytest.mark.parametrize("name", HOLDERS)
def test_what_holds_a_function_names_it(name):
    make, words = HOLDERS[name]
    own = make()
    with pytest.raises(TypeError, match="cannot pickle") as raised:
        pickle.dumps(own)
    for word in (*words, "make it again"):
        assert word in str(raised.value)
    if name != "Execution":
        # What never changes is its own copy.
        assert copy.copy(own) is own and copy.deepcopy(own) is own


def test_results_come_back_from_other_processes():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(MAP.fate, [7.0, 4.55]) == [MAP.fate(7.0), MAP.fate(4.55)]
