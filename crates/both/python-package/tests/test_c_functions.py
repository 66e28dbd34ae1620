"""Functions of C: called without the interpreter, with a signature that is checked or demanded, and kept alive."""

import ctypes
import gc
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
        kinds.append(ns.c_function(own(lambda t, x, p, out: None)))
        kinds.pop()
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
