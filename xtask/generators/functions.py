"""Taylor coefficients of elementary functions: f(x + s), and f(x + s, y + s/2), in powers of s (crates/any-system/equations).

The numbers x and y are the doubles of the record.
"""

import mpmath
from mpmath import mp, mpf, nstr

# Digits of the computation and of its results. Coefficient k is a difference of order k: it loses some 2k digits of many.
WORKING, PRINTED = 200, 30
ORDER = 8

FUNCTIONS = {
    "sqrt": mpmath.sqrt,
    "exp": mpmath.exp,
    "ln": mpmath.log,
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "tan": mpmath.tan,
    "asin": mpmath.asin,
    "acos": mpmath.acos,
    "atan": mpmath.atan,
    "sinh": mpmath.sinh,
    "cosh": mpmath.cosh,
    "tanh": mpmath.tanh,
    "asinh": mpmath.asinh,
    "acosh": mpmath.acosh,
    "atanh": mpmath.atanh,
    "sech": mpmath.sech,
    "cube": lambda x: x**3,
    "inverse_square": lambda x: x**-2,
    "power": lambda x, y: x**y,
    "quotient": lambda x, y: x / y,
    "atan2": mpmath.atan2,
    # Formulas with a decimal. Powers of 1/2 and 3/2 are computed as products of a root.
    "x^0.5": lambda x: x ** (mpf(1) / 2),
    "x^-0.5": lambda x: x ** (-mpf(1) / 2),
    "x^1.5": lambda x: x ** (mpf(3) / 2),
    "x^-1.5": lambda x: x ** (-mpf(3) / 2),
    "x^0.3": lambda x: x ** (mpf(3) / 10),
    "2^x": lambda x: mpf(2) ** x,
    "x/3": lambda x: x / 3,
}


def function(record):
    """The record with its coefficients."""
    with mp.workdps(WORKING):
        of, x = FUNCTIONS[record["function"]], mpf(record["x"])
        if "y" in record:
            y = mpf(record["y"])
            coefficients = mpmath.taylor(lambda s: of(x + s, y + s / 2), 0, ORDER)
        else:
            coefficients = mpmath.taylor(lambda s: of(x + s), 0, ORDER)
        return {**record, "coefficients": [nstr(c, PRINTED, strip_zeros=False) for c in coefficients]}
