"""The choice behind the tables of the first flight: their pieces, and polynomials of degree 7.

The tables are made when the program runs; no coefficient is committed. This computes, with 40 digits, the polynomial
through the Chebyshev nodes of a piece, and its error before any rounding. The error is T_8 times a function that
changes little on the piece, so that it is computed at the nine extrema of T_8. It also computes the sizes of the
coefficients, on which the rounding depends. The values of WORST, against which a test compares the tables, are made
again with the same 40 digits.
"""

from mpmath import cos, cos_sin, cbrt, lu_solve, matrix, mp, mpf, nstr, pi

from contact import speed_and_loss, star
from rust import numbers

DEGREES = (5, 6, 7, 8)
# Every k-th piece of these intervals is measured: in a sample, and otherwise. The intervals that are not named have a
# step of COARSE: the errors change slowly from one to the next.
SAMPLE = {0: 3, 1: 12, 31: 24}
WHOLE = {0: 1, 1: 1, 2: 1, 31: 1}
COARSE = 8
# The bounds behind TABLE_ULPS: errors of the interpolation of Gamma and of alpha - h in units of 2^-52, and the sum of
# the coefficients after the first, relative to the first.
ALLOWED_ERROR = (mpf("0.45"), mpf("1.05"))
ALLOWED_SUM = mpf("0.065")


def half_time(n, delta):
    """h with A(h) = alpha*_n + delta: Newton's method on A, from the local expansion; A' = Gamma/D."""
    center = star(n)
    alpha = center + delta
    # A increases and |alpha - h| < pi. The last piece of an interval reaches beyond its end.
    low, high = max(mpf(0), alpha - pi), alpha + pi
    h = alpha
    if n and abs(delta) < 0.5:
        h = center + mp.sign(delta) * cbrt(12 * center**2 / (1 + center**2) * abs(delta)) / 2
    for _ in range(400):
        a, gamma = speed_and_loss(h)
        if a > alpha:
            high = h
        else:
            low = h
        c, s = cos_sin(h)
        step = (alpha - a) * (h - s * c) / gamma
        moved = h + step
        if not low <= moved <= high:
            moved = (low + high) / 2
        if abs(moved - h) < mpf(10) ** -32 * h:
            return moved
        h = moved
    raise ArithmeticError("no root")


def values(n, delta):
    h = half_time(n, delta)
    return speed_and_loss(h)[1], star(n) + delta - h


class Polynomials:
    """Interpolation of one degree: nodes, extrema of the error, and the matrix of powers of the nodes."""

    def __init__(self, degree):
        self.nodes = [cos(pi * (2 * k + 1) / (2 * degree + 2)) for k in range(degree + 1)]
        self.places = [cos(pi * k / (degree + 1)) for k in range(degree + 2)]
        self.powers = matrix(degree + 1, degree + 1)
        for row, x in enumerate(self.nodes):
            for power in range(degree + 1):
                self.powers[row, power] = x**power

    def measure(self, n, left, width, sign, floor):
        """The largest error, and the relative sum of the later coefficients, of Gamma and of alpha - h on a piece."""

        def at(x):
            return values(n, sign * (left + width * (x + 1) / 2))

        exact_nodes, exact = [at(x) for x in self.nodes], [at(x) for x in self.places]
        errors, sums = [], []
        for which, least in enumerate((0, floor)):
            c = list(lu_solve(self.powers, matrix([value[which] for value in exact_nodes])))
            errors.append(
                max(
                    abs(mp.polyval(c[::-1], x) - value[which]) / (abs(value[which]) + least)
                    for x, value in zip(self.places, exact)
                )
            )
            sums.append(sum(abs(x) for x in c[1:]) / (abs(c[0]) + least))
        return errors, sums


def spans(n, first, octaves):
    """(left, width, sign) of each piece of the interval, in the order of alpha on either side."""
    for sign in (1, -1):
        # Below alpha*_0 = 0 there is no speed.
        reach = (n + 1) * pi - star(n) if sign > 0 else star(n) - n * pi
        parts = 32 if n == 0 else 16
        for octave in range(octaves):
            width = mpf(2) ** (first + octave) / parts
            for part in range(parts):
                # The last piece reaches beyond the end of its interval.
                left = (parts + part) * width
                if left < reach:
                    yield left, width, sign


def verify_worst():
    """WORST: alpha, then Gamma and alpha - h as sums of two f64."""
    committed = numbers("WORST", "f64")
    rows = [committed[k : k + 5] for k in range(0, len(committed), 5)]
    wrong = 0
    for alpha, *parts in rows:
        n = int(mpf(alpha) / pi)
        gamma, beyond = values(n, mpf(alpha) - star(n))
        made = [part for value in (gamma, beyond) for part in (float(value), float(value - mpf(float(value))))]
        wrong += made != parts
    print(f"  WORST: {len(rows) - wrong} of {len(rows)} places equal")
    return wrong


def verify(check):
    degree = numbers("COEFFICIENTS", "usize")[0] - 1
    octaves = numbers("OCTAVES", "usize")[0]
    first = numbers("FIRST_OCTAVE", "u64")
    first = first[0] - abs(first[1]) - 1023 if len(first) > 1 else first[0] - 1023
    floor = mpf(numbers("BEYOND_FLOOR")[0])
    intervals = SAMPLE if check else dict.fromkeys(range(numbers("TABLES", "usize")[0]), COARSE) | WHOLE
    with mp.workdps(50):
        wrong = verify_worst()
    with mp.workdps(40):
        for name, chosen in (("interval 0", (0,)), ("other intervals", tuple(n for n in intervals if n))):
            for d in (degree,) if check else DEGREES:
                polynomials = Polynomials(d)
                # The other degrees are for comparison: two intervals show them.
                shown = chosen if d == degree else chosen[:2]
                found = [
                    polynomials.measure(n, left, width, sign, floor)
                    for n in shown
                    for left, width, sign in list(spans(n, first, octaves))[:: intervals[n]]
                ]
                errors = [max(errors[which] for errors, _ in found) * mpf(2) ** 52 for which in (0, 1)]
                sums = [max(sums[which] for _, sums in found) for which in (0, 1)]
                mark = " (committed)" if d == degree else ""
                print(
                    f"  {name}, degree {d}{mark}: Gamma {nstr(errors[0], 3)}, alpha - h {nstr(errors[1], 3)} in 2^-52, "
                    f"sums {nstr(sums[0], 2)}, {nstr(sums[1], 2)}, on {len(found)} pieces",
                    flush=True,
                )
                if d == degree:
                    wrong += any(e > allowed for e, allowed in zip(errors, ALLOWED_ERROR))
                    wrong += any(total > ALLOWED_SUM for total in sums)
    return wrong
