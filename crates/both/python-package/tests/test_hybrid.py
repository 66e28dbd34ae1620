"""Hybrid systems given by Python functions."""

import math
import operator
import pickle

import numpy as np
import pytest
from nonsmooth.hybrid import (
    Clock,
    Guard,
    HybridSystem,
    QuasiPolynomial,
    SlidingMode,
    UndecidedError,
    event_sensitivity,
    sensitivity,
)


def ball(restitution=0.5, **more):
    """A ball under unit gravity. Dropped from ½ it lands after 1 with speed 1."""
    floor = Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0, -restitution * x[1]]), **more)
    return HybridSystem(
        flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t],
        guards=[floor],
        rest=lambda mode, x: ("rest", [0, 0]) if mode is None else None,
        sampled=0.01,
    )


def test_a_bouncing_ball_lands_at_the_times_of_its_series():
    times = [arc.event.time for arc in ball().run([0.5, 0], time=2.8) if arc.event]
    assert times == pytest.approx([1, 2, 2.5, 2.75], abs=1e-14)


def test_infinitely_many_bounces_end_in_their_limit():
    system = HybridSystem(
        flow=lambda mode, x, t: [0, 0] if mode == "rest" else [x[0] + t * (x[1] - t / 2), x[1] - t],
        guards=[
            Guard(
                "floor",
                lambda x: x[0],
                "falling",
                modes=["air"],
                reset=lambda mode, x: (mode, [0, -0.5 * x[1]]),
                signal=lambda mode, x: QuasiPolynomial.polynomial([x[0], x[1], -0.5]),
            )
        ],
        rest=lambda mode, x: ("rest", [0, 0]),
    )
    arcs = list(system.run([0.5, 0], mode="air", time=10))
    zeno = next(arc.zeno for arc in arcs if arc.zeno)
    # 1 + 2 (½ + ¼ + …) = 3.
    assert abs(zeno.time - 3) <= zeno.time_error + 1e-15 and zeno.time_error < 1e-9
    assert zeno.ratio == pytest.approx(0.5, abs=1e-6) and zeno.next_mode == "rest"
    assert arcs[-1].mode == "rest" and arcs[-1].end == "time limit"
    assert {arc.event.certainty for arc in arcs if arc.event} == {"certain"}


def test_a_thermostat_switches_at_the_times_of_its_exponentials():
    room = HybridSystem(
        field=lambda heater, x: [30 - x[0]] if heater == "on" else [10 - x[0]],
        guards=[
            Guard("warm", lambda x: x[0] - 21, "rising", modes=["on"], reset=lambda heater, x: ("off", x)),
            Guard("cold", lambda x: x[0] - 19, "falling", modes=["off"], reset=lambda heater, x: ("on", x)),
        ],
        tolerance=1e-12,
    )
    events = [arc.event for arc in room.run([15], mode="on", time=1.2) if arc.event]
    assert [event.surface for event in events] == ["warm", "cold", "warm", "cold"]
    # From 15 to 21 towards 30: ln(15/9); from 21 to 19 towards 10, and back: ln(11/9).
    step = math.log(11 / 9)
    assert [event.time for event in events] == pytest.approx([math.log(15 / 9) + k * step for k in range(4)], abs=1e-10)
    assert {event.certainty for event in events} == {"interpolated"}


def test_terminal_guards_observers_and_clocks():
    system = HybridSystem(
        flow=lambda mode, x, t: x + t,
        guards=[
            Guard(
                "seen",
                lambda x: x[0] - 1,
                "rising",
                role="observer",
                signal=lambda m, x: QuasiPolynomial.polynomial([x[0] - 1, 1]),
            ),
            Guard(
                "end",
                lambda x: x[0] - 3,
                "rising",
                role="terminal",
                signal=lambda m, x: QuasiPolynomial.polynomial([x[0] - 3, 1]),
            ),
            Clock("tick", period=0.75, first=0.5, reset=lambda mode, x: ("ticked", x)),
            Clock("list", times=[0.25, 2.5]),
            Clock("asked", times=lambda after: 1.5 if after < 1.5 else None),
        ],
    )
    run = system.run([0.0], time=10)
    events = [(arc.event.surface, arc.event.time) for arc in run]
    assert events == [
        ("list", 0.25), ("tick", 0.5), ("seen", 1.0), ("tick", 1.25), ("asked", 1.5), ("tick", 2.0), ("list", 2.5), ("tick", 2.75), ("end", 3.0),
    ]  # fmt: skip
    assert run.stop == "terminal" and run.mode == "ticked" and run.jump == 9


def test_sliding_points_are_found_and_followed():
    system = HybridSystem(
        field=lambda side, x: {"left": [1.0], "right": [-1.0]}.get(side, [0.0]),
        guards=[
            Guard("switch", lambda x: x[0], "rising", modes=["left"], reset=lambda mode, x: ("right", x)),
            Guard("back", lambda x: x[0], "falling", modes=["right"], reset=lambda mode, x: ("left", x)),
        ],
        slide=lambda sliding: ("slides", sliding.state),
    )
    run = system.run([-1.0], mode="left", time=5)
    ends = [arc.end for arc in run]
    assert "sliding" in ends and ends[-1] == "time limit" and run.mode == "slides"
    assert run.state[0] == pytest.approx(0, abs=1e-12)


def belt(**more):
    """A mass on a spring, on a belt of speed 1, which pulls with a force of at most 2."""
    return HybridSystem(
        field=lambda pull, x: [x[1], 2 * pull - x[0]],
        guards=[
            Guard("faster", lambda x: x[1] - 1, "rising", modes=[1], reset=lambda pull, x: (-1, x)),
            Guard("slower", lambda x: x[1] - 1, "falling", modes=[-1], reset=lambda pull, x: (1, x)),
        ],
        tolerance=1e-12,
        **more,
    )


def test_a_mass_sticks_to_its_belt_until_the_spring_takes_it():
    run = belt(slide="filippov").run([-1.0, 0.0], mode=1, time=9)
    arcs = list(run)
    stick = next(arc for arc in arcs if isinstance(arc.mode, SlidingMode))
    assert {stick.mode.below, stick.mode.above} == {1, -1} and stick.start[1] == 1
    # It moves with the belt to where the force of the spring is 2, and leaves in the mode of that pull.
    assert stick.event.surface.endswith("end of sliding") and stick.event.next_mode == 1
    assert stick.event.before == pytest.approx([2, 1], abs=1e-12)
    assert stick.duration == pytest.approx(2 - stick.start[0], abs=1e-12)
    middle = stick.states([0, 0.25])
    assert middle[1] == pytest.approx([stick.start[0] + 0.25, 1], abs=1e-12)
    # The same mode again: equal, and with the same hash.
    sticks = {arc.mode for arc in arcs if isinstance(arc.mode, SlidingMode)}
    assert len(sticks) == 1 and stick.mode in sticks and stick.mode != 1
    found = belt(slide="filippov").run([-1.0, 0.0], mode=1, time=3).trajectory([0, 2.5])
    assert found["modes"][-1] == stick.mode


def test_without_filippov_it_ends_at_the_belt():
    run = belt().run([-1.0, 0.0], mode=1, time=9)
    assert [arc.end for arc in run][-1] == "sliding" and run.stop == "sliding"
    assert run.state[1] == pytest.approx(1, abs=1e-12)
    with pytest.raises(ValueError, match="needs field="):
        HybridSystem(flow=lambda mode, x, t: x, slide="filippov")
    with pytest.raises(ValueError, match="'filippov', not \"fillipov\""):
        HybridSystem(field=lambda mode, x: x, slide="fillipov")
    sliding = next(
        arc.mode for arc in belt(slide="filippov").run([-1.0, 0.0], mode=1, time=9) if isinstance(arc.mode, SlidingMode)
    )
    with pytest.raises(ValueError, match="starts in a mode of the model"):
        belt(slide="filippov").run([0.0, 1.0], mode=sliding, time=1)


def test_an_exception_of_a_field_passes_through_a_sliding_motion():
    mine = Mine("with its text")
    stuck = {"yes": False}

    def field(pull, x):
        if stuck["yes"]:
            raise mine
        return [x[1], 2 * pull - x[0]]

    system = HybridSystem(
        field=field,
        guards=[
            Guard("faster", lambda x: x[1] - 1, "rising", modes=[1], reset=lambda pull, x: (-1, x)),
            Guard("slower", lambda x: x[1] - 1, "falling", modes=[-1], reset=lambda pull, x: (1, x)),
        ],
        slide="filippov",
    )
    run = system.run([-1.0, 0.0], mode=1, time=9)
    while not isinstance(run.mode, SlidingMode):
        next(run)
    before = run.time
    stuck["yes"] = True
    with pytest.raises(Mine) as caught:
        next(run)
    assert caught.value is mine and run.time == before
    stuck["yes"] = False
    assert next(run).end == "event"


def test_derivatives_pass_events():
    floor = Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0.0, -x[1] / 2]))
    fall = {"field": lambda mode, x: [x[1], -1.0], "guards": [floor], "tolerance": 1e-12}
    flow = {"flow": lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t], "sampled": 0.01}
    for ball in (HybridSystem(**fall), HybridSystem(**fall, **flow)):
        arcs = list(ball.run([1.0, 0.0], time=2.5))
        assert [arc.end for arc in arcs] == ["event", "time limit"]
        # From height h it lands after √(2h) with that speed: ∂τ/∂h = 1/√2, and ∂τ/∂v = v/√(v² + 2h) + 1 → 1 at v = 0.
        state, time = event_sensitivity(arcs[0])
        assert state == pytest.approx(np.array([[0, 0], [0.5 / math.sqrt(2), 0]]), abs=1e-8)
        assert time == pytest.approx([1 / math.sqrt(2), 1], abs=1e-8)
        # The difference of two orbits at t = 2.5.
        found = sensitivity(arcs)
        h = 1e-4

        def end(start):
            run = ball.run(start, time=2.5)
            list(run)
            return run.state

        columns = [(end([1 + h, 0]) - end([1 - h, 0])) / (2 * h), (end([1, h]) - end([1, -h])) / (2 * h)]
        assert found == pytest.approx(np.array(columns).T, abs=1e-6)


def test_a_parameter_is_a_component_that_does_not_change():
    falls = HybridSystem(
        field=lambda mode, x: [x[1], -x[2], 0.0],
        guards=[
            Guard("floor", lambda x: x[0], "falling", role="switch", reset=lambda mode, x: (mode, [0.0, -x[1], x[2]]))
        ],
        tolerance=1e-12,
    )
    arc = next(falls.run([1.0, 0.0, 2.0], time=5))
    _, time = event_sensitivity(arc)
    # τ = √(2h/g), ∂τ/∂g = −τ/(2g).
    assert arc.event.time == pytest.approx(1) and time[2] == pytest.approx(-0.25, abs=1e-8)


def test_derivatives_pass_a_sliding_motion():
    arcs = []
    for arc in belt(slide="filippov").run([-1.0, 0.0], mode=1, time=3):
        arcs.append(arc)
    assert any(isinstance(arc.mode, SlidingMode) for arc in arcs)
    # The velocity of the start is forgotten along the belt, but for its effect on the place; on the belt no change of
    # the velocity is left.
    found = sensitivity(arcs)
    assert found[1] == pytest.approx([0, 0], abs=1e-7)
    assert found.shape == (2, 2) and abs(found[0]).max() > 0.1


def test_an_event_says_how_its_guard_has_changed_its_sign():
    zero = Guard("zero", lambda x: x[0], "either", role="observer")
    swing = HybridSystem(field=lambda mode, x: [x[1], -x[0]], guards=[zero])
    events = [arc.event for arc in swing.run([1.0, 0.0], time=9.5) if arc.event]
    assert [event.direction for event in events] == ["falling", "rising", "falling"]
    assert pickle.loads(pickle.dumps(events[0])) == events[0]


def test_derivatives_that_do_not_exist_are_told():
    falls = HybridSystem(field=lambda mode, x: [x[1], -1.0], guards=[])
    with pytest.raises(ValueError, match="no sensitivity"):
        event_sensitivity(next(falls.run([1.0, 0.0], time=1)))
    # The top of a throw touches its surface: nearby throws miss it.
    top = Guard("top", lambda x: x[0] - 0.5, "rising", touch="event", reset=lambda mode, x: ("down", x), modes=["up"],
                signal=lambda mode, x: QuasiPolynomial.polynomial([x[0] - 0.5, x[1], -0.5]))  # fmt: skip
    thrown = HybridSystem(
        flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t], field=lambda mode, x: [x[1], -1.0], guards=[top]
    )
    touch = next(thrown.run([0.0, 1.0], mode="up", time=2))
    assert touch.event.kind == "touch" and touch.event.direction is None
    with pytest.raises(ValueError, match="changes at a rate of 0"):
        sensitivity([touch])
    with pytest.raises(ValueError, match="at least one"):
        sensitivity([])
    floor = Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0.0, -x[1] / 2]))
    arcs = list(HybridSystem(field=lambda mode, x: [x[1], -1.0], guards=[floor]).run([1.0, 0.0], time=2.5))
    with pytest.raises(ValueError, match="arc 1 does not begin where arc 0 ends"):
        sensitivity(arcs[::-1])
    wide = HybridSystem(field=lambda mode, x: np.zeros(9))
    with pytest.raises(ValueError, match="1 to 8 numbers, not 9"):
        sensitivity(list(wide.run(np.zeros(9), time=1)))
    no_field = HybridSystem(flow=lambda mode, x, t: [x[0] + t], guards=[Guard("one", lambda x: x[0] - 1, "rising", reset=lambda mode, x: (mode, [0.0]))], sampled=0.1)  # fmt: skip
    with pytest.raises(ValueError, match="field"):
        sensitivity([next(no_field.run([0.0], time=3))])


def test_an_exception_passes_through_a_derivative():
    mine = Mine("with its text")
    broken = {"yes": False}

    def value(x):
        if broken["yes"]:
            raise mine
        return x[0]

    floor = Guard("floor", value, "falling", reset=lambda mode, x: (mode, [0.0, -x[1] / 2]))
    arc = next(HybridSystem(field=lambda mode, x: [x[1], -1.0], guards=[floor]).run([1.0, 0.0], time=4))
    broken["yes"] = True
    with pytest.raises(Mine) as caught:
        sensitivity([arc])
    assert caught.value is mine


def test_trajectories_are_arrays():
    found = ball().run([0.5, 0], time=1.5).trajectory([0, 0.5, 1, 1.5])
    assert found["times"].tolist() == [0, 0.5, 1, 1, 1.5]
    assert found["jumps"].tolist() == [0, 0, 0, 1, 1]
    assert found["states"].shape == (5, 2) and found["states"][:, 1] == pytest.approx([0, -0.5, -1, 0.5, 0])
    assert found["event_times"].tolist() == [1] and found["event_after"].tolist() == [[0, 0.5]]
    arc = next(iter(ball().run([0.5, 0], time=1.5)))
    assert arc.states([0, 0.5]).tolist() == [[0.5, 0], [0.375, -0.5]]
    with pytest.raises(ValueError, match="-1"):
        arc.states([-1])


def test_an_execution_goes_on_after_its_limit():
    run = ball().run([0.5, 0], time=0)
    for frame in range(1, 21):
        for _ in run.run_until(0.125 * frame):
            pass
        assert run.state[0] >= 0 and run.time == 0.125 * frame
    assert run.jump == 3


class Mine(Exception):
    pass


@pytest.mark.parametrize("place", ["flow", "value", "reset", "signal", "enclosure", "next", "field"])
def test_an_exception_of_a_function_passes_unchanged(place):
    mine = Mine("with its text")
    after = {"calls": 0}

    def broken(*arguments):
        after["calls"] += 1
        raise mine

    def at(name, function):
        return broken if name == place else function

    motion = {"field": at("field", lambda mode, x: [1.0])}
    if place != "field":
        motion = {"flow": at("flow", lambda mode, x, t: [x[0] + t])}
    guard = Guard(
        "one",
        at("value", lambda x: x[0] - 1),
        "rising",
        reset=at("reset", lambda mode, x: (mode, [0.0])),
        signal=broken if place == "signal" else None,
        enclosure=broken if place == "enclosure" else None,
    )
    guards = [guard, Clock("tick", times=broken)] if place == "next" else [guard]
    run = HybridSystem(guards=guards, sampled=0.1, **motion).run([0.0], time=3)
    with pytest.raises(Mine) as caught:
        for _ in run:
            pass
    assert caught.value is mine
    assert after["calls"] == 1
    # The execution is where it was before, and says the same again.
    with pytest.raises(Mine):
        next(run)


@pytest.mark.parametrize("place", ["flow", "value", "reset", "next", "field"])
def test_stop_iteration_of_a_function_is_a_runtime_error(place):
    mine = StopIteration("mine")

    def broken(*arguments):
        raise mine

    motion = {"field": broken if place == "field" else lambda mode, x: [1.0]}
    if place == "flow":
        motion = {"flow": broken}
    value = broken if place == "value" else lambda x: x[0] - 1
    reset = broken if place == "reset" else lambda mode, x: (mode, [0.0])
    guards = [Guard("one", value, "rising", reset=reset)]
    if place == "next":
        guards = [Clock("tick", times=broken)]
    run = HybridSystem(guards=guards, sampled=0.1, **motion).run([0.0], time=3)
    with pytest.raises(RuntimeError, match="StopIteration") as caught:
        list(run)
    assert caught.value.__cause__ is mine


def test_a_jump_beyond_a_guard_needs_a_word():
    def steps(role):
        guards = [
            Guard("leap", lambda x: x[0] - 1, "rising", reset=lambda mode, x: ("after", [x[0]]), modes=["before"]),
            Guard(
                "past",
                lambda x: x[0] - 0.5,
                "rising",
                reset=lambda mode, x: ("end", [x[0]]),
                modes=["after"],
                role=role,
            ),
        ]
        system = HybridSystem(field=lambda mode, x: [1.0], guards=guards)
        return [arc.event.surface for arc in system.run([0.0], mode="before", time=3) if arc.event]

    assert steps("contact") == ["leap", "past"]
    assert steps("crossing") == ["leap"]
    with pytest.raises(ValueError, match="`contact`.*`crossing`"):
        steps("switch")
    with pytest.raises(ValueError, match="contact and needs reset"):
        Guard("floor", lambda x: x[0], "falling", role="contact")


def test_exceptions_of_rest_and_slide_pass_too():
    def broken(*arguments):
        raise Mine

    system = HybridSystem(
        flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t],
        guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0, -0.5 * x[1]]),
                      signal=lambda mode, x: QuasiPolynomial.polynomial([x[0], x[1], -0.5]))],
        rest=broken,
    )  # fmt: skip
    with pytest.raises(Mine):
        list(system.run([0.5, 0], time=10))


@pytest.mark.parametrize("value", [lambda x: x[0], operator.itemgetter(0)])
def test_ctrl_c_ends_a_search(value, ctrl_c):
    system = HybridSystem(
        flow=lambda mode, x, t: [x[0] + t],
        guards=[Guard("never", value, "falling", reset=lambda mode, x: (mode, x))],
        sampled=1e-3,
    )
    with ctrl_c():
        list(system.run([1.0], time=1e5))


@pytest.mark.parametrize(
    "arguments, error, part",
    [
        ({}, ValueError, "flow= or field="),
        ({"flow": 3}, TypeError, "flow must be a function"),
        ({"field": lambda m, x: [1.0, 2.0]}, ValueError, "field returned 2 numbers, and the state has 1"),
        ({"flow": lambda m, x, t: "no"}, TypeError, "number"),
        ({"field": lambda m, x: np.array([1j])}, TypeError, "complex128"),
        ({"field": lambda m, x: np.array([[1.0]])}, TypeError, "2 dimensions"),
        ({"field": lambda m, x: [math.nan]}, ArithmeticError, "not finite"),
        ({"field": lambda m, x: [1.0], "tolerance": -1.0}, ValueError, "-1"),
    ],
)
def test_wrong_models_are_told(arguments, error, part):
    with pytest.raises(error, match=part):
        guards = [Guard("one", lambda x: x[0] - 1, "rising", reset=lambda mode, x: (mode, [0.0]))]
        list(HybridSystem(guards=guards, sampled=0.1, **arguments).run([0.0], time=3))


def test_wrong_guards_are_told():
    with pytest.raises(ValueError, match="needs reset="):
        Guard("a", lambda x: x, "rising")
    with pytest.raises(ValueError, match='"up"'):
        Guard("a", lambda x: x, "up", role="observer")
    with pytest.raises(ValueError, match="role"):
        Guard("a", lambda x: x, "rising", role="king")
    guard = Guard("a", lambda x: x[0], "rising", role="observer")
    with pytest.raises(ValueError, match="two guards"):
        HybridSystem(field=lambda m, x: x, guards=[guard, guard])
    with pytest.raises(TypeError, match="int"):
        HybridSystem(field=lambda m, x: x, guards=[3])
    with pytest.raises(ValueError, match="times= or period="):
        Clock("c")
    with pytest.raises(ValueError, match="rise"):
        Clock("c", times=[1.0, 0.5])
    with pytest.raises(TypeError):
        HybridSystem(field=lambda m, x: x).run([1.0], mode=[], time=1)
    with pytest.raises(ValueError, match="at least one"):
        HybridSystem(field=lambda m, x: x).run([], time=1)


def test_messages_have_the_names_of_guards_and_modes():
    guard = Guard("wall", lambda x: x[0], "rising", modes=["inside"], reset=lambda mode, x: (mode, x))
    with pytest.raises(ValueError, match="\"wall\".*'inside'"):
        list(HybridSystem(field=lambda m, x: [1.0], guards=[guard]).run([1.0], mode="inside", time=1))
    grazing = Guard("top", lambda x: x[0] - 0.5, "rising", reset=lambda mode, x: (mode, x),
                    signal=lambda mode, x: QuasiPolynomial.polynomial([x[0] - 0.5, x[1], -0.5]))  # fmt: skip
    system = HybridSystem(flow=lambda m, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t], guards=[grazing])
    with pytest.raises(UndecidedError, match="top"):
        list(system.run([0.0, 1.0], time=2))


def test_what_a_reset_returns_is_checked():
    def run(found):
        guards = [Guard("one", lambda x: x[0] - 1, "rising", reset=lambda mode, x: found)]
        return list(HybridSystem(field=lambda m, x: [1.0], guards=guards).run([0.0], time=3))

    assert run(None)[-1].event.after is None
    for wrong in (3, [1.0], ("mode", [1.0, 2.0])):
        with pytest.raises((TypeError, ValueError)):
            run(wrong)


def test_quasi_polynomials_are_functions():
    q = QuasiPolynomial
    height = q.polynomial([0, -4, 0.5]) + q.sine(5, 1)
    assert height(2.0) == pytest.approx(-6 + 5 * math.sin(2), rel=1e-15)
    assert (2 * height - height * 2 + height.derivative())(0.0) == pytest.approx(1)
    assert (q.exponential(1, -1) * q.cosine(1, 3)).damped(1)(1.0) == pytest.approx(math.exp(-2) * math.cos(3))
    assert q.polynomial([1]).first_crossing("either", 5) is None
    with pytest.raises(ValueError):
        height.first_crossing("rising", -1.0)


def test_a_function_that_calls_its_own_execution_is_told():
    holder = {}

    def value(x):
        next(holder["run"])

    guards = [Guard("one", value, "rising", role="observer")]
    holder["run"] = HybridSystem(field=lambda m, x: [1.0], guards=guards).run([0.0], time=1)
    with pytest.raises(RuntimeError, match="at work"):
        next(holder["run"])


def test_states_are_copies():
    arc = next(iter(ball().run([0.5, 0], time=1.5)))
    arc.start[0] = 7
    assert arc.start[0] == 0.5
    assert np.array_equal(arc.event.before[1:], [-1.0])
