"""The choice behind the tables of the first flight: pieces of a 16th of their distance from alpha*_n, degree 7.

The tables are made when the program runs; no coefficient is committed. This measures the error of the polynomial
through the Chebyshev nodes of a piece, before any rounding, for Gamma and for alpha - h, relative to the
largest value of each on the piece.
"""

from mpmath import cos, cos_sin, cbrt, lu_solve, matrix, mp, mpf, nstr, pi

from contact import speed_and_loss, star
from rust import numbers

# A few intervals, with the first and the last table.
INTERVALS = (0, 1, 2, 5, 12, 31)
DEGREES = (5, 6, 7, 8)
PLACES = 17
# The committed degree has to keep these relative errors of Gamma and of alpha - h, in units of 2^-52. From alpha*_1 on
# they are 0.5 and 2.5 (measured). In interval 0 the pieces above alpha = 2.6 are too long for degree 7: next to pi the
# errors grow to 20 and 340 units (measured), which adds up to 7 units to the error of a hop from there.
ALLOWED = {True: (1, 3), False: (24, 400)}


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


def errors(n, left, width, sign, degree):
    """Largest relative errors of Gamma and of alpha - h on a piece."""
    def at(x):
        return values(n, sign * (left + width * (x + 1) / 2))
    nodes = [cos(pi * (2 * k + 1) / (2 * degree + 2)) for k in range(degree + 1)]
    powers = matrix(degree + 1, degree + 1)
    for row, x in enumerate(nodes):
        for power in range(degree + 1):
            powers[row, power] = x**power
    exact_nodes = [at(x) for x in nodes]
    places = [mpf(2 * k) / (PLACES - 1) - 1 for k in range(PLACES)]
    exact = [at(x) for x in places]
    found = []
    for which in (0, 1):
        c = list(lu_solve(powers, matrix([value[which] for value in exact_nodes])))[::-1]
        largest = max(abs(value[which]) for value in exact)
        found.append(max(abs(mp.polyval(c, x) - value[which]) for x, value in zip(places, exact)) / largest)
    return found


def verify(check):
    degree = numbers("COEFFICIENTS", "usize")[0] - 1
    octaves = numbers("OCTAVES", "usize")[0]
    first = numbers("FIRST_OCTAVE", "u64")
    first = first[0] - abs(first[1]) - 1023 if len(first) > 1 else first[0] - 1023
    wrong = 0
    with mp.workdps(40):
        wrong += sum(measure(chosen, degree, first, octaves, check) for chosen in ((0,), INTERVALS[1:]))
    return wrong


def measure(intervals, degree, first, octaves, check):
    """Prints the largest errors over the pieces of these intervals; whether they pass the limit."""
    worst = {d: [mpf(0), mpf(0)] for d in DEGREES}
    count = 0
    for n in intervals[:2] if check else intervals:
        for sign in (1, -1):
            # Below alpha*_0 = 0 there is no speed.
            reach = (n + 1) * pi - star(n) if sign > 0 else star(n) - n * pi
            for octave in range(octaves):
                for part in range(0, 16, 8 if check else 3):
                    width = mpf(2) ** (first + octave) / 16
                    left = (16 + part) * width
                    # The last piece reaches beyond the end of its interval.
                    if left < reach:
                        count += 1
                        for d in DEGREES:
                            worst[d] = [max(a, b) for a, b in zip(worst[d], errors(n, left, width, sign, d))]
    label = "interval 0" if intervals == (0,) else "other intervals"
    for d in DEGREES:
        mark = " (committed)" if d == degree else ""
        print(f"  {label}, degree {d}{mark}: Gamma {nstr(worst[d][0], 3)}, alpha - h {nstr(worst[d][1], 3)} "
              f"on {count} pieces")
    allowed = ALLOWED[intervals != (0,)]
    return any(found > limit * mpf(2) ** -52 for found, limit in zip(worst[degree], allowed))
