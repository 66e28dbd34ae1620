"""The polynomials of sine and cosine, and pi/2 in parts.

(sin r - r)/r^3 and (1/2 - (1 - cos r)/r^2)/r^2 in powers of z = r^2, through the six Chebyshev nodes of
0 <= z <= (1.0005 pi/4)^2, each coefficient rounded to f64. The factor 1.0005 covers the rounding of the reduction.
"""

from mpmath import cos, floor, lu_solve, matrix, mp, mpf, nint, nstr, pi, sin, sqrt

from rust import numbers

TERMS = 6
DIGITS = 60
# Places where the error of a polynomial is measured.
PLACES = 2000


def sine(z):
    r = sqrt(z)
    return (sin(r) - r) / r**3


def cosine(z):
    r = sqrt(z)
    return (mpf(1) / 2 - (1 - cos(r)) / z) / z


def end():
    return (mpf(10005) / 10000 * pi / 4) ** 2


def interpolate(function, terms=TERMS):
    """Coefficients in powers of z, rounded to f64."""
    half = end() / 2
    nodes = [half * (1 + cos(pi * (2 * k + 1) / (2 * terms))) for k in range(terms)]
    powers = matrix(terms, terms)
    for row, node in enumerate(nodes):
        for power in range(terms):
            powers[row, power] = node**power
    return [float(c) for c in lu_solve(powers, matrix([function(node) for node in nodes]))]


def worst(function, coefficients, power):
    """Largest error of z^power times the polynomial: in sin r relative to r, in cos r absolutely."""

    def error(z):
        return abs(mp.polyval([mpf(c) for c in reversed(coefficients)], z) - function(z)) * z**power

    return max(error(end() * k / PLACES) for k in range(1, PLACES + 1))


def half_pi():
    """pi/2 in 33 bits, 33 more, and the rest rounded."""
    first = floor(pi / 2 * 2**32) / mpf(2) ** 32
    second = floor((pi / 2 - first) * mpf(2) ** 66) / mpf(2) ** 66
    return [float(first), float(second), float(pi / 2 - first - second)]


def verify(_check):
    wrong = 0
    with mp.workdps(DIGITS):
        for name, function, power in (("SIN", sine, 1), ("COS", cosine, 2)):
            made, committed = interpolate(function), numbers(name)
            equal = sum(a == b for a, b in zip(made, committed)) if len(made) == len(committed) else 0
            wrong += equal < len(made)
            print(
                f"  {name}: {equal} of {len(made)} coefficients equal; "
                f"error committed {nstr(worst(function, committed, power), 3)}, "
                f"made {nstr(worst(function, made, power), 3)}, "
                f"with {TERMS - 1} terms {nstr(worst(function, interpolate(function, TERMS - 1), power), 3)}"
            )
    with mp.workdps(400):
        parts = [float(pi), float(pi - float(pi))]
        parts.append(float(pi - parts[0] - parts[1]))
        # std::f64::consts::PI stands in the source instead of the first part.
        quarter = int(nint(pi / 4 * mpf(2) ** 1024))
        words = [quarter >> 64 * k & (2**64 - 1) for k in range(16)]
        for name, kind, made in (
            ("HALF_PI", "f64", half_pi()),
            ("PI_PARTS", "f64", parts[1:]),
            ("QUARTER_PI", "u64", words),
        ):
            committed = [x for x in numbers(name, kind) if x != 64]
            print(f"  {name}: {sum(a == b for a, b in zip(made, committed))} of {len(made)} parts equal")
            wrong += made != committed
    return wrong
