"""Systems of functions f(t, x, p): formulas where they can be, callbacks where not, with the same answers."""

import concurrent.futures
import multiprocessing
import pickle

import nonsmooth as ns
import numpy as np
import pytest
from nonsmooth import _native, tracing


def oscillator(**settings):
    return ns.System(
        lambda t, x, p: [x[1], -x[0] - 0.1 * x[1] + np.cos(1.3 * t)],
        states=["x", "v"],
        parameters={"restitution": 0.8},
        guards=[ns.Guard("stop", lambda t, x, p: x[0] - 0.5, "rising", reset=lambda t, x, p: [x[0], -p.restitution * x[1]])],
        **settings,
    )


def thermostat(**settings):
    return ns.System(
        {"on": lambda t, x, p: [30 - x[0]], "off": lambda t, x, p: [10 - x[0]]},
        states="room",
        guards=[
            ns.Guard("warm", lambda t, x, p: x[0] - 21, "rising", modes=["on"], to="off"),
            ns.Guard("cold", lambda t, x, p: x[0] - 19, "falling", modes=["off"], to="on"),
        ],
        **settings,
    )


# Each function of NumPy that formulas have, at points of its domain.
FUNCTIONS = [
    *((name, (-1.7, 0.3)) for name in "sin cos tan arctan sinh cosh tanh arcsinh exp exp2 expm1 square negative".split()),
    *((name, (-1.7, 0.3)) for name in "positive absolute fabs sign deg2rad radians rad2deg degrees reciprocal".split()),
    *((name, (0.2, 3.0)) for name in "sqrt log log2 log10".split()),
    *((name, (-0.7, 0.3)) for name in "arcsin arccos arctanh".split()),
    ("arccosh", (1.5, 2.0)),
]


@pytest.mark.parametrize("name, points", FUNCTIONS, ids=lambda part: part if isinstance(part, str) else "")
def test_functions_of_numpy_are_formulas(name, points):
    function = getattr(np, name)
    model = tracing.Model(["x"], {})
    one = model.formulas("it", lambda t, x, p: [function(x[0])])
    # The same on an array of symbols.
    all_at_once = model.formulas("it", lambda t, x, p: function(x))
    for x in points:
        expected = function(x)
        for formulas in (one, all_at_once):
            assert abs(formulas.values(0.0, [x])[0] - expected) <= 4e-16 * max(1, abs(expected)), (name, x)


@pytest.mark.parametrize("name", "add subtract multiply divide power float_power arctan2 minimum maximum fmin fmax hypot".split())
def test_functions_of_two_are_formulas(name):
    function = getattr(np, name)
    model = tracing.Model(["x", "y"], {"a": 2.5})
    for traced in (
        lambda t, x, p: [function(x[0], x[1]), function(p.a, x[0]), function(x[0], 1.5)],
        lambda t, x, p: [*function(x[:1], x[1]), *function([p.a], x[0]), function(x[0], np.float32(1.5))],
    ):
        found = model.formulas("it", traced).values(0.0, [0.7, 1.9])
        expected = [function(0.7, 1.9), function(2.5, 0.7), function(0.7, 1.5)]
        assert np.allclose(found, expected, rtol=1e-15, atol=0)


def test_operators_matrices_and_numbers_are_formulas():
    matrix = np.array([[0.0, 1.0], [-2.0, -0.3]])
    functions = [
        lambda t, x, p: matrix @ x,
        lambda t, x, p: x @ matrix,
        lambda t, x, p: np.dot(matrix, x) + np.array([0.0, 1.0]),
        lambda t, x, p: x[::-1] ** 2 - (2 ** x) / (1 + x),
        lambda t, x, p: [+x[0] - (-x[1]), abs(x[0]) * t, 3, 2 - x[1], 1 / x[0], x[0] ** -3, x[0] ** 0.5][:2],
        lambda t, x, p: np.array([x.sum(), x.prod()]),
        lambda t, x, p: np.stack([np.mean(x), x[0]]),
        lambda t, x, p: (x[0], np.int64(3) * x[1]),
    ]
    model = tracing.Model(["x", "y"], {})
    for number, function in enumerate(functions):
        found = model.formulas("it", function).values(0.4, [0.7, 1.9])
        assert np.allclose(found, function(0.4, np.array([0.7, 1.9]), None), rtol=1e-15), number
    # Integer powers are products: they have values below zero.
    assert model.formulas("it", lambda t, x, p: [x[0] ** 3]).values(0.0, [-2.0, 0.0]) == [-8.0]


def test_texts_and_sympy_are_formulas():
    sympy = pytest.importorskip("sympy")
    x, v, t, k = sympy.symbols("x v t k")
    given = [v, -k * sympy.sin(x) + sympy.exp(-t) * sympy.sqrt(1 + x**2) + sympy.pi]
    positive = sympy.Symbol("x", positive=True)
    model = tracing.Model(["x", "v"], {"k": 0.3})
    expected = [0.4, -0.3 * np.sin(0.7) + np.exp(-0.2) * np.sqrt(1.49) + np.pi]
    for formulas in (
        model.formulas("it", given),
        model.formulas("it", [v, given[1].subs(x, positive)]),
        model.formulas("it", ["v", "-k*sin(x) + exp(-t)*sqrt(1 + x^2) + pi"]),
    ):
        assert np.allclose(formulas.values(0.2, [0.7, 0.4]), expected, rtol=1e-15)
    with pytest.raises(ValueError, match="without a meaning: .*q"):
        model.formulas("it", [sympy.Symbol("q")])
    with pytest.raises(ValueError, match="column 4"):
        model.formulas("it", ["x +* v"])


def caught(call, other):
    try:
        return call()
    except Exception:
        return other


WITHOUT_FORMULAS = [
    (lambda t, x, p: [x[1], 1.0 if x[0] > 0 else -1.0], "compared"),
    (lambda t, x, p: [x[1], -1.0 if x[0] == 0 else 1.0], "compared"),
    (lambda t, x, p: [x[1], 1.0 if x[0] else 2.0], "condition"),
    (lambda t, x, p: [x[1], np.where(x[0] > 0, 1, 2)], "compared"),
    (lambda t, x, p: [x[1], np.heaviside(x[0], 0)], "guard between two modes"),
    (lambda t, x, p: [x[1], np.floor(x[0])], "guard between two modes"),
    (lambda t, x, p: [x[1], np.cbrt(x[0])], "no numpy.cbrt"),
    (lambda t, x, p: [x[1], np.log1p(x[0] ** 2)], "write numpy.log"),
    (lambda t, x, p: [x[1], caught(lambda: 1.0 if x[0] > 5 else 2.0, 2.0)], "compared"),
    (lambda t, x, p: [x[1], 1.0 if x.dtype == float and x[0] > 5 else 2.0], "no function of its arguments alone"),
    (lambda t, x, p: [x[1], -abs(x[0]) ** p.a if p.a > 2.2 and isinstance(p.a, float) else x[0] * x[0]], "compared"),
    (lambda t, x, p: [x[1], __import__("math").sin(x[0])], "math"),
    (lambda t, x, p: [x[1], int(t)], "int"),
    (lambda t, x, p: [x[1], x[0] % 1.0], "wraps"),
    (lambda t, x, p: [x[1], np.maximum(x[0], 0)], "kink"),
    (lambda t, x, p: np.array([x[1], x[0]], dtype=float), "float"),
]


@pytest.mark.parametrize("field, why", WITHOUT_FORMULAS, ids=lambda part: part if isinstance(part, str) else "")
def test_what_has_no_formulas_says_why_and_runs(field, why):
    system = ns.System(field, states="x v", parameters={"a": 2.0})
    assert not system.compiled and why in system.why_not
    assert system.run([0.5, 0.0], time=0.1).reason == "time limit"
    with pytest.raises(ns.TracingError, match="field|kink"):
        ns.System(field, states="x v", parameters={"a": 2.0}, compiled=True)
    with pytest.raises(ns.TracingError):
        system.equations


def test_a_function_that_counts_its_calls_has_no_formulas():
    calls = []

    def field(t, x, p):
        calls.append(1)
        return [x[0] * len(calls)]

    assert "no function of its arguments" in ns.System(field, states="x").why_not


def test_a_mistake_is_no_reason_for_callbacks():
    with pytest.raises(AttributeError, match="no parameter 'k'; the parameters are: damping"):
        ns.System(lambda t, x, p: [-p.k * x[0]], states="x", parameters={"damping": 1.0})
    with pytest.raises(IndexError):
        ns.System(lambda t, x, p: [x[1]], states="x")
    with pytest.raises(ValueError, match="has 2 components, and the state of the model has 1"):
        ns.System(lambda t, x, p: [x[0], 1.0], states="x")
    with pytest.raises(NameError):
        ns.System(lambda t, x, p: [missing * x[0]], states="x")  # noqa: F821


def test_the_impact_oscillator_has_its_83_impacts():
    run = oscillator().run([0, 1], time=400)
    assert len(run.events) == 83 and run.reason == "time limit"
    # The last impact by two other programs, to 2e-12.
    assert abs(run.events[-1].time - 396.4881294366) < 2e-9
    assert all(event.certainty == "certain" for event in run.events)


def test_formulas_and_callbacks_have_the_same_answers():
    for make, start, mode in ((oscillator, [0, 1], None), (thermostat, [15], "on")):
        one, other = make(), make(compiled=False)
        assert one.compiled and not other.compiled
        first, second = (own.run(start, time=20, mode=mode, t=np.linspace(0, 20, 41)) for own in (one, other))
        assert [event.surface for event in first.events] == [event.surface for event in second.events]
        assert len(first.events) > 3
        times = [[event.time for event in run.events] for run in (first, second)]
        assert np.allclose(*times, rtol=0, atol=1e-8)
        assert np.allclose(first.y, second.y, rtol=0, atol=1e-7) and first.modes == second.modes
        assert np.allclose(first.sol([3.3, 1.1]), second.sol([3.3, 1.1]), rtol=0, atol=1e-7)
        fates = [own.fates([start, start], 20, mode=mode) for own in (one, other)]
        assert (fates[0].reason == fates[1].reason).all() and (fates[0].events == fates[1].events).all()
        assert np.allclose(fates[0].state, fates[1].state, atol=1e-7)


def test_a_run_has_what_scipy_has():
    run = oscillator().run([0, 1], time=10)
    assert run.y.shape == (2, len(run.t)) and (np.diff(run.t) >= 0).all()
    # Two columns at each event, with the states before and after it.
    for event in run.events:
        at = np.flatnonzero(run.t == event.time)
        assert len(at) == 2 and (run.y[:, at[0]] == event.before[:2]).all() and (run.y[:, at[1]] == event.after[:2]).all()
    asked = oscillator().run([0, 1], time=10, t=[0, 5, 10])
    assert asked.t.tolist() == [0, 5, 10] and (asked.y == run.sol([0, 5, 10])).all()
    assert run.sol(5.0).shape == (2,) and (run.sol([7.0, 2.0])[:, 1] == run.sol(2.0)).all()
    assert (run.end == run.sol(10.0)).all()
    for late in (-1.0, 11.0, np.nan):
        with pytest.raises(ValueError, match="time"):
            run.sol(late)


def test_a_run_is_a_table_and_a_dataset():
    pytest.importorskip("xarray")
    pytest.importorskip("pandas")
    run = thermostat().run([15], time=2, mode="on")
    table, data = run.to_pandas(), run.to_xarray()
    assert list(table.columns) == ["t", "room", "mode", "jump"] and len(table) == len(run.t)
    assert (data.room.values == run.y[0]).all() and data.attrs["reason"] == "time limit"
    assert data.event_surface.values.tolist() == [event.surface for event in run.events]
    assert len(thermostat().run([15], time=2, mode="on", t=[0.5, 1]).to_pandas()) == 2


def test_the_time_may_begin_anywhere():
    ramp = ns.System(lambda t, x, p: [t], states="x")
    assert abs(ramp.run([0], time=(1, 3)).end[0] - 4) < 1e-10
    slow = ns.System(lambda t, x, p: [t if t > -1 else 0.0], states="x")
    assert not slow.compiled and abs(slow.run([0], time=(1, 3)).end[0] - 4) < 1e-9


def test_args_are_those_of_scipy():
    field = lambda t, x, rate, scale: [-rate * x[0] * scale]  # noqa: E731
    for compiled in (None, False):
        system = ns.System(field, states="x", args=(2.0, 0.5), compiled=compiled)
        assert abs(system.run([1.0], time=1).end[0] - np.exp(-1)) < 1e-8
        with_both = ns.System(lambda t, x, p, k: [-p.r * x[0] * k], states="x", parameters={"r": 2}, args=(0.5,), compiled=compiled)
        assert abs(with_both.run([1.0], time=1).end[0] - np.exp(-1)) < 1e-8


def test_surfaces_end_observe_switch_and_rest():
    def ball(compiled):
        return ns.System(
            lambda t, x, p: [x[1], -1],
            states="height speed",
            guards=[
                ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -0.5 * x[1]], role="contact"),
                ns.Guard("top", lambda t, x, p: x[1], "falling"),
                ns.Guard("ceiling", lambda t, x, p: x[0] - 5, "rising", terminal=True),
            ],
            compiled=compiled,
        )

    for compiled in (None, False):
        run = ball(compiled).run([0.5, 0], time=9)
        assert run.reason == "zeno" and {event.surface for event in run.events} >= {"floor", "top"}
        up = ball(compiled).run([0.5, 4], time=9)
        assert up.reason == "terminal" and up.events[-1].surface == "ceiling" and up.events[-1].after is None
    rests = ns.System(
        {"flight": lambda t, x, p: [x[1], -1], "ground": lambda t, x, p: [0, 0]},
        states="height speed",
        guards=[ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -0.5 * x[1]], modes=["flight"])],
        rests={"flight": ("ground", lambda t, x, p: [0, 0])},
    )
    run = rests.run([0.5, 0], time=9, mode="flight")
    assert run.reason == "time limit" and run.modes[-1] == "ground" and run.end.tolist() == [0, 0]
    # A condition, and a clock.
    gate = ns.System(
        lambda t, x, p: [1],
        states="x",
        guards=[
            ns.Guard("open", lambda t, x, p: np.sin(x[0]), "rising", only_where=lambda t, x, p: x[0] - 7),
            ns.Clock("tick", period=5.0, reset=lambda t, x, p: [x[0] + 0.5]),
            ns.Clock("late", times=[13.0], terminal=True),
        ],
    )
    run = gate.run([0.1], time=20)
    # Of the zeros 2πn only that behind 7.
    assert [event.surface for event in run.events] == ["tick", "tick", "open", "late"] and run.reason == "terminal"
    assert [event.time for event in run.events][:2] == [5.0, 10.0]


def test_parameters_are_changed_by_name_and_by_arrays():
    system = oscillator()
    one = system.run([0, 1], time=40, parameters={"restitution": 0.3})
    other = system.with_parameters(restitution=0.3).run([0, 1], time=40)
    assert (one.y == other.y).all() and (one.y[:, -1] != system.run([0, 1], time=40).y[:, -1]).all()
    values = np.linspace(0.1, 0.9, 9)
    fates = system.fates([0, 1], 40, parameters={"restitution": values})
    assert len(fates) == 9
    for value, state in zip(values, fates.state):
        assert (system.run([0, 1], time=40, parameters={"restitution": value}).end == state).all()
    slow = oscillator(compiled=False).fates([0, 1], 5, parameters={"restitution": values[:2]})
    assert np.allclose(slow.state, system.fates([0, 1], 5, parameters={"restitution": values[:2]}).state, atol=1e-8)
    with pytest.raises(ValueError, match="no parameter 'q'; the parameters are: restitution"):
        system.run([0, 1], time=1, parameters={"q": 1})
    with pytest.raises(ValueError, match="do not fit together"):
        system.fates(np.zeros((3, 2)), 1, parameters={"restitution": values})


def test_fates_have_the_same_bits_on_any_number_of_threads():
    starts = np.random.default_rng(0).uniform(-1, 0.4, (200, 2))
    told = []
    one = oscillator().fates(starts, 20, threads=1, progress=lambda done, all: told.append((done, all)))
    two = oscillator().fates(starts, 20, threads=2)
    assert (one.state == two.state).all() and (one.events == two.events).all()
    assert told[-1] == (200, 200)
    assert (one.state[7] == oscillator().run(starts[7], time=20).end).all()
    pytest.importorskip("pandas")
    assert len(one.to_pandas()) == 200


def test_tolerances_are_those_of_each_component():
    fine = oscillator(tolerance=1e-12).run([0, 1], time=5).end
    rough = ns.System(lambda t, x, p: [x[1], -np.sin(x[0])], states="x v", tolerance=1e-4, absolute=[1e-3, 1e-2])
    exact = ns.System(lambda t, x, p: [x[1], -np.sin(x[0])], states="x v", tolerance=1e-13).run([2, 0], time=9).end
    error = np.abs(rough.run([2, 0], time=9).end - exact).max()
    assert 1e-9 < error < 1e-1 and np.isfinite(fine).all()
    with pytest.raises(ValueError, match="3 tolerances for 2 components"):
        oscillator(absolute=[1e-3] * 3)
    with pytest.raises(ValueError, match="need formulas"):
        oscillator(absolute=[1e-3] * 2, compiled=False)
    for bad in (0.0, -1.0, np.nan, 2.0):
        with pytest.raises(ValueError, match="tolerance"):
            oscillator(tolerance=bad)


def test_wrong_input_is_an_error_with_the_remedy():
    system, two = oscillator(), thermostat()
    for call, words in [
        (lambda: system.run([0], time=1), "2 components (x, v), not 1"),
        (lambda: system.run([0, np.nan], time=1), "finite"),
        (lambda: system.run([0, 1], time=-1), "before"),
        (lambda: system.run([0, 1], time=1, mode="fly"), "no mode 'fly'; the modes are: motion"),
        (lambda: two.run([15], time=1), "give mode="),
        (lambda: system.fates([[0, 1, 2]], 1), "2 components"),
        (lambda: ns.System(lambda t, x, p: [1], states="x", guards=["floor"]), "guards are of nonsmooth.Guard"),
        (lambda: ns.Guard("g", lambda t, x, p: 1, "up"), "one of rising"),
        (lambda: ns.Guard("g", lambda t, x, p: 1, terminal=True, to="b"), "ends the run"),
        (lambda: ns.Clock("c"), "either times= or period="),
        (lambda: ns.System({"a": ["1"]}, states="x", guards=[ns.Guard("g", "x", to="b")]), "names the mode 'b'"),
        (lambda: ns.System(["1"], states="x", guards=[ns.Guard("g", "x"), ns.Guard("g", "x")]), "two guards are named 'g'"),
        (lambda: ns.System(["x"], states="x x"), "used twice"),
        (lambda: ns.System(["1"], states="x", parameters={"a": np.inf}), "no decimal|without a value"),
    ]:
        with pytest.raises((ValueError, TypeError, ArithmeticError)) as raised:
            call()
        import re

        assert re.search(words.replace("(", r"\(").replace(")", r"\)"), str(raised.value)), str(raised.value)


def test_an_error_has_the_run_up_to_it():
    """ẋ = 1/(2 − x) loses its value at x = 2, at t = 2."""
    for compiled in (None, False):
        system = ns.System(
            lambda t, x, p: [1 / np.sqrt(2 - x[0])],
            states="x",
            guards=[ns.Guard("half", lambda t, x, p: x[0] - 1, "rising")],
            compiled=compiled,
        )
        with np.errstate(all="ignore"), pytest.raises(ArithmeticError) as raised:
            system.run([0.0], time=50)
        run = raised.value.run
        assert [event.surface for event in run.events] == ["half"] and run.reason == "failed"


def test_systems_and_runs_go_through_pickle_and_other_processes():
    system = oscillator()
    again = pickle.loads(pickle.dumps(system))
    assert repr(again) == repr(system) and again.equations == system.equations
    run = system.run([0, 1], time=40)
    other = pickle.loads(pickle.dumps(run))
    assert (other.y == run.y).all() and other.events == run.events and (other.sol(3.3) == run.sol(3.3)).all()
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.apply(system.run, ([0, 1], 40))
        fates = pool.apply(system.fates, ([[0, 1]], 40))
    assert (found.y == run.y).all() and (fates.state[0] == run.end).all()
    with pytest.raises(TypeError, match="cannot pickle a System without formulas.*compiled=False"):
        pickle.dumps(oscillator(compiled=False))


def test_threads_of_python_run_side_by_side():
    system = oscillator()
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        runs = list(pool.map(lambda k: system.run([0, 1 + 0.01 * k], time=100).end.tolist(), range(12)))
    assert runs == [system.run([0, 1 + 0.01 * k], time=100).end.tolist() for k in range(12)]


@pytest.mark.parametrize("call", ["run", "fates"])
def test_ctrl_c_ends_a_compiled_run_at_once(call, ctrl_c):
    system = ns.System(lambda t, x, p: [x[1], -np.sin(x[0]) + np.cos(t) * np.sin(2 * x[0])], states="x v")
    with ctrl_c():
        if call == "run":
            system.run([0.1, 0.0], time=1e5)
        else:
            system.fates(np.zeros((2000, 2)) + 0.1, 1e4)


def test_return_maps_have_derivatives_branches_and_diagrams():
    ball = ns.System(
        lambda t, x, p: [x[1], -1],
        states=["height", "speed"],
        parameters={"r": 0.5},
        guards=[ns.Guard("floor", lambda t, x, p: x[0], "falling", reset=lambda t, x, p: [0, -p.r * x[1] + 0.3])],
    )
    bounces = ball.returns("floor", coordinates=["speed"])
    image = bounces.image([1.0])
    assert abs(image.point[0] - 0.8) < 1e-12 and abs(image.time - 2) < 1e-12
    assert image.itinerary == ["motion: floor"] and image.certainty in ("exact", "certain")
    slopes = bounces.linearized([1.0])
    assert abs(slopes.slopes[0, 0] - 0.5) < 1e-9 and abs(slopes.parameter_slopes[0] - 1.0) < 1e-9
    assert np.allclose(bounces.orbit([1.0], 2).ravel(), [1.0, 0.8, 0.7], atol=1e-12)
    fixed = bounces.periodic_point([0.7])
    assert abs(fixed.point[0] - 0.6) < 1e-12 and fixed.is_stable and abs(fixed.multipliers[0] - 0.5) < 1e-9
    branch = bounces.branch([0.7], (0.1, 0.9), longest_step=0.2)
    assert branch.ends == ("window", "window") and np.allclose(branch.point[:, 0], 0.3 / (1 - branch.parameter), atol=1e-9)
    assert branch.is_stable.all() and not branch.bifurcations
    diagram = bounces.diagram([0.2, 0.5], [[0.1]], keep=3)
    assert diagram.parameter.tolist() == [0.2] * 3 + [0.5] * 3 and not diagram.failed
    assert np.allclose(diagram.point.ravel(), [0.375] * 3 + [0.6] * 3)
    value, lower, upper = bounces.lyapunov([0.5], transient=50, images=300)[0]
    assert lower <= np.log(0.5) + 1e-9 and np.log(0.5) - 1e-9 <= upper and abs(value - np.log(0.5)) < 1e-6
    again = pickle.loads(pickle.dumps(bounces))
    assert (again([1.0]) == bounces([1.0])).all()
    for call, words in [
        (lambda: ball.returns("roof", coordinates=["speed"])([1.0]), "roof|no return"),
        (lambda: ball.returns("floor", coordinates=["speed"], parameter="q"), "no parameter 'q'"),
        (lambda: bounces([1.0, 2.0]), "1 coordinates, not 2"),
        (lambda: thermostat().returns("warm", coordinates=["room"], mode="on"), "depends on a parameter"),
    ]:
        with pytest.raises(ValueError, match=words):
            call()


def test_a_fold_of_a_map_by_functions_of_the_section():
    """The phase of a forcing is the coordinate: an orbit begins at a time, and its image is the time of the next stop."""
    system = ns.System(
        lambda t, x, p: [x[1], p.g],
        states="x v",
        parameters={"g": -1.0},
        guards=[ns.Guard("table", lambda t, x, p: x[0] - 0.1 * np.sin(t), "falling", reset=lambda t, x, p: [x[0], -0.5 * x[1] + 0.15 * np.cos(t)])],
    )
    table = system.returns(
        "table",
        coordinates="phase speed",
        start=lambda t, q, p: [0.1 * np.sin(q[0]), q[1], q[0]],
        image=lambda t, x, p: [t, x[1]],
    )
    phase, speed = table([0.3, 1.5])
    # A flight from the phase with this speed, to the table again.
    assert abs(0.1 * np.sin(0.3) + 1.5 * (phase - 0.3) - 0.5 * (phase - 0.3) ** 2 - 0.1 * np.sin(phase)) < 1e-9
    assert speed > 0


def test_attractors_of_steps_need_no_python():
    duffing = ns.System(
        lambda t, x, p: [x[1], x[0] - x[0] ** 3 - 0.15 * x[1] + p.f * np.cos(t)], states="x v", parameters={"f": 0.2}
    )
    steps = duffing.steps(2 * np.pi)
    found = ns.labelling.Attractors(steps, region=[(-2.2, 2.2)] * 2, starts=[[1, 0], [-1, 0]], locate=50, tests=50)
    assert found.periods == {1: 1, 2: 1}
    starts = np.random.default_rng(0).uniform(-2, 2, (300, 2))
    labels, times = found.convergences(starts)
    assert set(labels) == {1, 2} and (found.labels(starts, threads=1) == labels).all() and times.max() < 1000
    other = pickle.loads(pickle.dumps(steps))
    assert other([0.3, 0.4]) == steps([0.3, 0.4])
    # A surface that ends the run is a fate of its own.
    well = ns.System(
        ["v", "-x + x^3 - v"],
        states="x v",
        guards=[ns.Guard("right", "x - 2", "rising", terminal=True), ns.Guard("left", "x + 2", "falling", terminal=True)],
    )
    found = ns.labelling.Attractors(well.steps(0.5), region=[(-2, 2)] * 2, starts=[[0.5, 0]], cells=20, locate=20, tests=20)
    assert found.labels([[0.1, 0.0], [1.8, 0.5], [-1.8, -0.5]]).tolist() == [1, 65001, 65002]
    henon = _native.Steps.of_formulas(tracing.Model(["x", "y"], {}).formulas("it", lambda t, x, p: [1 - 1.4 * x[0] ** 2 + x[1], 0.3 * x[0]]))
    assert henon([0.5, 0.1]) == pytest.approx([0.75, 0.15])


def test_old_names_work_with_a_warning():
    import importlib
    import sys

    for name in ("hybrid", "labelling"):
        sys.modules.pop(f"passive_hopper.{name}", None)
        with pytest.warns(DeprecationWarning, match=f"nonsmooth.{name}"):
            module = importlib.import_module(f"passive_hopper.{name}")
        assert all(getattr(module, own) is getattr(getattr(ns, name), own) for own in module.__all__)


def test_pickles_of_the_version_before_are_read():
    # Bounds(0.25, 0.5), as version 0.2 has written them.
    old = b"cpassive_hopper._native\n_restored\n(VBounds\n(F0.25\nF0.5\nttR."
    found = pickle.loads(old)
    assert (found.lower, found.upper) == (0.25, 0.5)


def test_exceptions_are_one_family():
    import passive_hopper as hopper

    assert issubclass(ns.InputError, (ns.NonsmoothError, ValueError)) and issubclass(ns.UndecidedError, ns.ComputationError)
    for call, kind in [
        (lambda: ns.System(["x"], states="x x"), ns.InputError),
        (lambda: ns.System(["1/x"], states="x").run([1.0], time=-1), ns.InputError),
        (lambda: ns.System(["-1/x"], states="x").run([1.0], time=9), ns.ComputationError),
        (lambda: ns.System(lambda t, x, p: [int(t)], states="x", compiled=True), ns.TracingError),
        (lambda: hopper.LiftOffMap(-1.0), ns.InputError),
        (lambda: ns.basins_of(lambda x, y: x > y, {"x": (0, 1)}), ns.InputError),
    ]:
        with pytest.raises(ns.NonsmoothError) as raised:
            call()
        assert type(raised.value) is kind and pickle.loads(pickle.dumps(raised.value)).args == raised.value.args


def test_what_an_attack_made_false():
    # A clock that ends the run ends it, also by callbacks.
    for compiled in (None, False):
        run = ns.System(lambda t, x, p: [1], states="x", guards=[ns.Clock("c", times=[1.0], terminal=True)], compiled=compiled).run([0], time=3)
        assert run.reason == "terminal" and abs(run.end[0] - 1) < 1e-9
        # Events have the components of the state, and no time behind them.
        assert oscillator(compiled=compiled).run([0, 1], time=2).events[0].before.shape == (2,)

    # In-place operators are formulas.
    def in_place(t, x, p):
        x *= 2.0
        x += np.array([1.0, t])
        return x

    system = ns.System(in_place, states="x v")
    assert system.compiled and np.allclose(system.equations.run("motion", [1.0, 2.0], (0.0, 1.0), 9).states([1.0])[0][0], 1.5 * np.exp(2) - 0.5)
    # A power that is a parameter has values below zero where it is whole; formulas have none.
    power = ns.System(lambda t, x, p: [-(x[0] ** p.a)], states="x", parameters={"a": 3.0})
    assert not power.compiled and "has a value where its formulas have none" in power.why_not
    assert abs(power.run([-1.0], time=1).end[0] + 1 / np.sqrt(3)) < 1e-7
    # A function that looks at a parameter.
    looks = ns.System(lambda t, x, p: [1.0 if caught(lambda: p.a > 0.5, True) else 2.0], states="x", parameters={"a": 1.0})
    assert not looks.compiled and looks.run([0], time=1, parameters={"a": 0.1}).end[0] == pytest.approx(2.0)
    assert oscillator().fates(np.empty((0, 2)), 3).state.shape == (0, 2)
    one = ns.Guard("half", lambda t, x, p: [x[0] - 0.5], "rising")
    for compiled in (None, False):
        assert len(ns.System(lambda t, x, p: [1], states="x", guards=[one], compiled=compiled).run([0], time=1).events) == 1
    sympy = pytest.importorskip("sympy")
    for call, words in [
        (lambda: ns.System([sympy.Piecewise((sympy.Symbol("x"), sympy.Symbol("x") > 0), (0, True))], states="x"), "there are no formulas .the field"),
        (lambda: oscillator().returns("foo", coordinates="x v"), "no guard 'foo'; the guards are: stop"),
        (lambda: oscillator().returns("stop", coordinates="x v").steps(np.nan), "must be finite"),
        (lambda: oscillator().returns("stop", coordinates="x v").steps(0.5, "stop"), "not the text 'stop'"),
        (lambda: oscillator().fates([[0, 1]], 1, threads=-1), "from 1 on, not -1"),
        (lambda: ns.System({"fly": ["1"]}, states="x", rests={"fly": "foo"}), "names the mode 'foo'"),
        (lambda: ns.System({}, states="x"), "at least one mode"),
        (lambda: oscillator().run([0, 1], time=(1, 2, 3)), "a pair of its start and end"),
        (lambda: ns.attractors_of(oscillator(), {"x": (0, 1), "v": (0, 1)}, step=1, starts=[[0, np.nan]]), "not finite"),
        (lambda: ns.basins_of(oscillator(), {"x": (0, 1), "v": (0, 1)}, step=1, others={"z": 1}), "others= names"),
    ]:
        with pytest.raises((ValueError, TypeError), match=words):
            call()


def test_masked_numbers_and_times_outside_of_the_run_are_refused():
    well = ns.System(["v", "x - x^3 - 0.3*v"], states="x v")
    masked = np.ma.array([0.5, 0.0], mask=[False, True])
    with pytest.raises(TypeError, match="masked"):
        well.run(masked, 1)
    with pytest.raises(TypeError, match="masked"):
        well.fates(np.ma.array([[0.5, 0.0]], mask=[[True, False]]), 1)
    # A masked array without masked numbers is an array.
    assert well.run(np.ma.array([0.5, 0.0]), 1).reason == "time limit"
    with pytest.raises(ns.InputError, match="the time 2.0"):
        well.run([0.5, 0], 1, t=[0.5, 2.0])
    with pytest.raises(ns.InputError, match="the time nan"):
        well.run([0.5, 0], 1, t=[0.5, np.nan])


def test_steps_take_the_tolerances_of_the_system():
    """A flow over a time has the bits of a run of the same tolerances."""
    for settings in ({}, {"tolerance": 1e-6}, {"tolerance": 1e-6, "absolute": 1e-3}, {"absolute": [1e-2, 1e-9]}, {"longest_step": 0.05}):
        well = ns.System(["v", "x - x^3 - 0.3*v + 0.2*cos(t)"], states="x v", **settings)
        # Without guards the steps are those of many states at a time; with one they are runs.
        assert well.steps(2.0)([0.3, 0.1]) == well.run([0.3, 0.1], 2.0).end.tolist(), settings


def branching(t, x, p):
    """A function without formulas."""
    return [x[0] * x[0]] if x[0] < 1e9 else [x[0]]


def test_a_batch_by_callbacks_has_a_row_for_each_start():
    system = ns.System(branching, states="x", compiled=False)
    # 1/(1 − t) ends at 1, beside one that does not.
    fates = system.fates([[1.0], [0.1]], 2)
    assert fates.reason[0].startswith("failed: ") and fates.reason[1] == "time limit"
    assert fates.state.shape == (2, 1) and fates.state[1, 0] == pytest.approx(0.125)
    for own in (system, ns.System(["-x"], states="x")):
        with pytest.raises(ns.InputError, match="1 modes are given for 3 starts"):
            own.fates([[1.0], [2.0], [3.0]], 1, mode=[own.modes[0]])


def test_an_arithmetic_error_of_a_user_is_no_fate():
    def field(t, x, p):
        return [1 / 0] if x[0] > 0 else [0.0]

    system = ns.System(field, states="x", compiled=False)
    for call in (system.run, lambda start, time: system.fates([start], time)):
        with pytest.raises(ZeroDivisionError):
            call([1.0], 1)


def test_attractors_of_a_system_with_modes_have_the_mode_as_a_coordinate():
    room = ns.System(
        {"on": lambda t, x, p: [30 - x[0]], "off": lambda t, x, p: [10 - x[0]]},
        states="room",
        guards=[
            ns.Guard("warm", lambda t, x, p: x[0] - 21, "rising", modes=["on"], to="off"),
            ns.Guard("cold", lambda t, x, p: x[0] - 19, "falling", modes=["off"], to="on"),
        ],
    )
    found = ns.attractors_of(room, {"room": (15.0, 25.0)}, step=0.01, starts=[[18.0, 0], [22.0, 1]], locate=200, tests=20)
    assert found.points and all(rows.shape[1] == 2 for rows in found.points.values())
    for rows in found.points.values():
        assert 18.9 < rows[:, 0].min() and rows[:, 0].max() < 21.1 and set(rows[:, 1]) <= {0.0, 1.0}
    pytest.importorskip("xarray")
    basins = ns.basins_of(room, {"room": (15, 25), "mode": (-0.4, 1.4)}, (6, 2), step=0.01, attractors=found)
    assert basins.label.shape == (6, 2)
    with pytest.raises(ns.InputError, match="mode"):
        ns.basins_of(room, {"room": (15, 25), "nothing": (0, 1)}, (2, 2), step=0.01, attractors=found)


def test_basins_of_steps_with_more_coordinates_than_the_window():
    pytest.importorskip("xarray")
    steps = ns.map_steps(["x/2", "y/2", "z/2"], states="x y z")
    found = ns.basins_of(steps, {"x": (-1, 1), "y": (-1, 1)}, (3, 2), others={"z": 0.5}, region={"x": (-1, 1), "y": (-1, 1), "z": (-1, 1)}, starts=5, tests=5)
    assert (found.label == 1).all()


def test_components_with_the_names_of_other_columns_are_refused_in_tables():
    run = ns.System(["-mode"], states="mode").run([1.0], 1)
    with pytest.raises(ns.InputError, match="name it otherwise"):
        run.to_pandas()
    pytest.importorskip("xarray")
    with pytest.raises(ns.InputError, match="'mode'"):
        run.to_xarray()


def test_tolerances_may_be_lists():
    fine = ns.System(["v", "-x"], states="x v", tolerance=[1e-12, 1e-12])
    assert np.array_equal(fine.run([1, 0], 3).end, ns.System(["v", "-x"], states="x v", tolerance=1e-12).run([1, 0], 3).end)
    for wrong in ([1e-8], [1e-8, 0.0], [1e-8, -1.0]):
        with pytest.raises(ns.InputError, match="tolerance="):
            ns.System(["v", "-x"], states="x v", tolerance=wrong)


def test_a_stiff_system_is_told_a_method():
    stiff = ns.System(["v", "1e6*((1 - x^2)*v - x)"], states="x v", tolerance=1e-4)
    with pytest.raises(ns.ComputationError, match="Radau or BDF"):
        stiff.run([2, 0], 30)


def test_a_long_step_lets_other_threads_run_and_ctrl_c_through(ctrl_c):
    slow = ns.System(["v", "-x + 0.1*(1 - x^2)*v"], states="x v", tolerance=1e-14).steps(1e7)
    with ctrl_c():
        slow([1.0, 0.0])
