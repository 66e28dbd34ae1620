"""Functions of C: what tells their signature, and what keeps them alive."""

from __future__ import annotations

import ctypes
from typing import Any

from ._native import CFunction

#: What a function of C must be. It gets the time, the state and the parameters, and writes its results.
SIGNATURE = "void (double, double *, double *, double *)"

_NUMBA = "(float64, float64*, float64*, float64*) -> none"


def c_function(function: Any, signature: str | None = None) -> CFunction:
    """A function of C for a :class:`System`: a field, a guard or a reset that is called without the interpreter.

    Its signature is ``void f(double t, const double *x, const double *p, double *out)``: it writes as many results as are asked for, and may be called
    from any thread. ``function`` is a ``cfunc`` of numba, a ``LowLevelCallable`` of SciPy, a function of ctypes with its types, or an address. The signature is
    checked where the object tells it; for an address it must be given, as :data:`SIGNATURE`: a wrong one ends the process.

    >>> import ctypes, nonsmooth as ns
    >>> numbers = ctypes.POINTER(ctypes.c_double)
    >>> decay = ctypes.CFUNCTYPE(None, ctypes.c_double, numbers, numbers, numbers)(lambda t, x, p, out: out.__setitem__(0, -x[0]))
    >>> system = ns.System(ns.c_function(decay), states="x")
    >>> round(float(system.run([1.0], time=1).end[0]), 6), system.compiled
    (0.367879, False)
    """
    if isinstance(function, CFunction):
        return function
    address, found = _address(function)
    told = found if found is not None else signature
    if told is None:
        raise TypeError(f"an address does not tell what is there: give signature={SIGNATURE!r}")
    if _plain(told) not in (_plain(SIGNATURE), _plain(_NUMBA)):
        raise TypeError(f"the function has the signature {told!r}, and {SIGNATURE!r} is needed; one of ctypes tells it by restype and argtypes")
    return CFunction(address, function)


def is_c_function(given: Any) -> bool:
    """Whether an object is a function of C that tells its address."""
    return isinstance(given, (CFunction, ctypes._CFuncPtr)) or _is_numba(given) or type(given).__name__ == "LowLevelCallable"


def _is_numba(given: Any) -> bool:
    return type(given).__module__.startswith("numba.") and hasattr(given, "address") and hasattr(given, "_sig")


def _plain(signature: str) -> str:
    return signature.replace("const ", "").replace(" ", "")


def _address(function: Any) -> tuple[int, str | None]:
    """The address, and the signature if the object tells it."""
    if isinstance(function, int):
        return function, None
    if _is_numba(function):
        return int(function.address), str(function._sig)
    if isinstance(function, ctypes._CFuncPtr):
        return int(ctypes.cast(function, ctypes.c_void_p).value or 0), _of_ctypes(function)
    if type(function).__name__ == "LowLevelCallable":
        if function.user_data is not None:
            raise TypeError("a LowLevelCallable with user_data is not taken: give the numbers as parameters")
        inner = function.function
        if type(inner).__name__ != "PyCapsule":
            return _address(inner)
        name = ctypes.pythonapi.PyCapsule_GetName
        name.restype, name.argtypes = ctypes.c_char_p, [ctypes.py_object]
        pointer = ctypes.pythonapi.PyCapsule_GetPointer
        pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        told = name(inner)
        return int(pointer(inner, told) or 0), function.signature
    raise TypeError(f"a cfunc of numba, a LowLevelCallable, a function of ctypes or an address is needed, not {type(function).__name__}")


def _of_ctypes(function: Any) -> str:
    numbers = ctypes.POINTER(ctypes.c_double)
    if function.restype is None and function.argtypes is not None and list(function.argtypes) == [ctypes.c_double, *[numbers] * 3]:
        return SIGNATURE
    shown = ", ".join(getattr(own, "__name__", str(own)) for own in function.argtypes or ())
    return f"{getattr(function.restype, '__name__', 'void')} ({shown})"
