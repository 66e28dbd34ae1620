"""Functions of C: called without the interpreter, with a signature that is checked or demanded, and kept alive."""

import ctypes
import gc
import math
import shutil
import subprocess

import nonsmooth as ns
import numpy as np
import pytest
from nonsmooth.c_functions import SIGNATURE

NUMBERS = ctypes.POINTER(ctypes.c_double)
SOURCE = """
#include <math.h>
void field(double t, const double *x, const double *p, double *out) {
    out[0] = x[1];
    out[1] = -x[0] - 0.1 * x[1] + cos(1.3 * t);
}
void stop(double t, const double *x, const double *p, double *out) { out[0] = x[0] - 0.5; }
void bounce(double t, const double *x, const double *p, double *out) {
    out[0] = x[0];
    out[1] = -p[0] * x[1];
}
"""


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("SKIPPED functions of C: there is no C compiler")
    folder = tmp_path_factory.mktemp("c")
    (folder / "model.c").write_text(SOURCE)
    subprocess.run([compiler, "-O2", "-shared", "-fPIC", "model.c", "-o", "model.so", "-lm"], cwd=folder, check=True)
    found = ctypes.CDLL(str(folder / "model.so"))
    for name in ("field", "stop", "bounce"):
        getattr(found, name).restype = None
        getattr(found, name).argtypes = [ctypes.c_double, NUMBERS, NUMBERS, NUMBERS]
    return found


def oscillator(field, stop, bounce):
    return ns.System(
        field, states="x v", parameters={"restitution": 0.8}, guards=[ns.Guard("stop", stop, "rising", reset=bounce)]
    )


FORMULAS = (
    lambda t, x, p: [x[1], -x[0] - 0.1 * x[1] + np.cos(1.3 * t)],
    lambda t, x, p: x[0] - 0.5,
    lambda t, x, p: [x[0], -p.restitution * x[1]],
)


def test_functions_of_c_have_the_events_of_formulas(library):
    one = oscillator(library.field, library.stop, library.bounce)
    assert not one.compiled and one.why_not == "a function of C is called, and has no formulas"
    expected = oscillator(*FORMULAS).run([0, 1], time=40)
    # Functions of Python and of C may be mixed.
    for system in (one, oscillator(library.field, *FORMULAS[1:]), oscillator(FORMULAS[0], library.stop, library.bounce)):
        run = system.run([0, 1], time=40)
        assert np.allclose([event.time for event in run.events], [event.time for event in expected.events], atol=1e-8)
        assert np.allclose(run.end, expected.end, atol=1e-8)


def test_every_kind_of_object_is_taken(library):
    address = ctypes.cast(library.field, ctypes.c_void_p).value
    kinds = [ns.c_function(library.field), ns.c_function(address, signature=SIGNATURE)]
    kinds.append(ns.c_function(address, signature="void(double, const double*, const double*, double*)"))
    try:
        from scipy import LowLevelCallable

        kinds.append(ns.c_function(LowLevelCallable(library.field)))
    except ImportError:
        pass
    try:
        import numba

        own = numba.cfunc("void(float64, CPointer(float64), CPointer(float64), CPointer(float64))")

        @own
        def field(t, x, p, out):
            out[0] = x[1]
            out[1] = -x[0] - 0.1 * x[1] + math.cos(1.3 * t)

        kinds.append(ns.c_function(field))
    except ImportError:
        pass
    for kind in kinds:
        assert kind(0.0, [0.5, 2.0], [], 2) == pytest.approx([2.0, 0.3])
        assert ns.c_function(kind) is kind


def test_another_signature_is_refused(library):
    address = ctypes.cast(library.field, ctypes.c_void_p).value
    wrong = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(lambda t: t)
    for call, words in [
        (lambda: ns.c_function(address), "does not tell what is there: give signature="),
        (lambda: ns.c_function(address, signature="double (double)"), "has the signature 'double .double.'"),
        (lambda: ns.c_function(wrong), "'c_double .c_double.'"),
        (lambda: ns.c_function(len), "a cfunc of numba, a LowLevelCallable"),
        (lambda: ns.System(wrong, states="x"), "has the signature"),
    ]:
        with pytest.raises(TypeError, match=words):
            call()
    with pytest.raises(ValueError, match="address 0"):
        ns.c_function(0, signature=SIGNATURE)


def test_a_function_is_kept_as_long_as_it_may_be_called():
    def rates(t, x, p, out):
        out[0] = -x[0]

    system = ns.System(ctypes.CFUNCTYPE(None, ctypes.c_double, NUMBERS, NUMBERS, NUMBERS)(rates), states="x")
    gc.collect()
    assert abs(system.run([1.0], time=1).end[0] - np.exp(-1)) < 1e-8
    with pytest.raises(TypeError, match="cannot pickle"):
        import pickle

        pickle.dumps(system)


def test_fates_of_c_are_those_of_single_runs_with_any_number_of_threads(library):
    system = oscillator(library.field, library.stop, library.bounce)
    starts = np.random.default_rng(3).uniform(-1, 0.4, (40, 2))
    restitution = np.linspace(0.5, 0.9, 40)
    told = []
    all = system.fates(starts, 30, parameters={"restitution": restitution}, progress=lambda done, count: told.append((done, count)))
    one = system.fates(starts, 30, parameters={"restitution": restitution}, threads=1)
    assert np.array_equal(all.state, one.state) and np.array_equal(all.events, one.events) and told[-1] == (40, 40)
    for k in (0, 7, 39):
        run = system.run(starts[k], 30, parameters={"restitution": restitution[k]})
        assert np.array_equal(run.end, all.state[k]) and len(run.events) == all.events[k] and all.reason[k] == run.reason
    assert (all.time == 30).all() and set(all.mode) == {system.modes[0]}
    assert len(system.fates(np.empty((0, 2)), 1)) == 0


def test_other_threads_of_python_run_beside_functions_of_c(library):
    import threading

    system = oscillator(library.field, library.stop, library.bounce)
    counted, ended = [0], threading.Event()

    def count():
        while not ended.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    try:
        before = counted[0]
        system.run([0, 1], time=3000)
        assert counted[0] - before > 10_000
    finally:
        ended.set()
        thread.join()


def test_ctrl_c_ends_a_run_of_c(library, ctrl_c):
    with ctrl_c():
        oscillator(library.field, library.stop, library.bounce).run([0, 1], time=1e7)


def test_clocks_modes_and_terminal_events_of_c(library):
    """Against the same model in formulas."""
    surfaces = lambda stop, bounce: [
        ns.Guard("stop", stop, "rising", reset=bounce),
        ns.Clock("tick", period=2.5),
        ns.Clock("switch", times=[3.0], to="other"),
        ns.Clock("end", times=[20.0], terminal=True),
    ]
    parts = {"c": (library.field, library.stop, library.bounce), "formulas": FORMULAS}
    runs = {}
    for name, (field, stop, bounce) in parts.items():
        system = ns.System(
            {"one": field, "other": field}, states="x v", parameters={"restitution": 0.8}, guards=surfaces(stop, bounce)
        )
        runs[name] = system.run([0, 1], time=40, mode="one")
    one, other = runs.values()
    assert [event.surface for event in one.events] == [event.surface for event in other.events]
    assert one.reason == other.reason == "terminal"
    assert np.allclose(one.end, other.end, atol=1e-8)
    assert np.allclose(one.sol([1.0, 10.0]), other.sol([1.0, 10.0]), atol=1e-8)


def test_an_error_of_a_field_of_c_has_the_run_up_to_it(tmp_path):
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("SKIPPED functions of C: there is no C compiler")
    (tmp_path / "m.c").write_text("void f(double t, const double *x, const double *p, double *out) { out[0] = x[0] * x[0]; }")
    subprocess.run([compiler, "-O2", "-shared", "-fPIC", "m.c", "-o", "m.so"], cwd=tmp_path, check=True)
    field = ctypes.CDLL(str(tmp_path / "m.so")).f
    field.restype, field.argtypes = None, [ctypes.c_double, NUMBERS, NUMBERS, NUMBERS]
    system = ns.System(field, states="x")
    with pytest.raises(ns.NonsmoothError):
        system.run([1.0], time=2)
    fates = system.fates([[1.0], [0.1]], time=2)
    assert fates.reason[0].startswith("failed: ") and fates.reason[1] == "time limit"


def test_a_reset_of_c_beside_functions_of_python(library):
    system = oscillator(*FORMULAS[:2], library.bounce)
    assert not system.compiled and "function of C" in system.why_not
    expected = oscillator(*FORMULAS).run([0, 1], time=20)
    assert np.allclose(system.run([0, 1], time=20).end, expected.end, atol=1e-8)


def test_further_arguments_of_a_function_of_c_are_refused(library):
    with pytest.raises(ns.InputError, match="parameters="):
        ns.System(library.field, states="x v", args=(2.0,)).run([0, 1], 1)


def test_counts_are_told_by_their_numbers(library):
    system = oscillator(library.field, library.stop, library.bounce)
    with pytest.raises(ValueError, match="-1"):
        system.run([0, 1], 1, events=-1)
