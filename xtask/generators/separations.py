"""Distances of the f64 to the multiples of pi and to the fixed points alpha*_n: the numbers of docs/theory.md, Lemma
65.

Multiples of pi: in the binade [2^E, 2^(E+1)) every f64 is a multiple of 2^(E-52). |m 2^(E-52) - n pi| is smallest, over
all m and all n up to a limit, at the last convergent of pi/2^(E-52) whose denominator is within this limit.

Fixed points: alpha*_n for each n, in whole numbers of 2^-FRACTION, and its distance to the nearest multiple of
2^(E-52).
"""

from mpmath import atan, floor, mp, mpf, nint, nstr, pi

BITS = 600
BINADES = range(1, 43)
# What Lemma 65 states: the smallest distance to a multiple of pi, the smallest quotient of a distance and the error
# 2^-105 n pi of the computed multiple, and the smallest distance to alpha*_n relative to it.
NEAREST_MULTIPLE = mpf("1.2e-18")
LEAST_QUOTIENT = 100
NEAREST_FIXED_POINT = mpf("5.3e-24")
FIXED_POINTS = 3_000_000
FIXED_POINTS_OF_A_SAMPLE = 20_000
# Largest expected number of wrong decisions beyond FIXED_POINTS, and the relative error of the computed alpha*_n behind
# it.
EXPECTED = mpf("0.008")
FIXED_POINT_ERROR = mpf(2) ** -101
LARGEST_SPEED = 2**43

FRACTION = 256
# alpha*_n comes from the contraction below this n, and from the series of Lemma 40 up to q^-9 from it on. The series
# errs by at most 5.177 q^-11 (Theorem 71), which is 2e-38 here.
SERIES_FROM = 1000
SERIES = ((1, 1), (2, 3), (13, 15), (146, 105), (781, 315))


def last_convergent(x, most):
    """The convergent m/n of x with the largest n <= most."""
    (m0, n0), (m, n), rest = (1, 0), (int(floor(x)), 1), x - floor(x)
    while rest:
        rest = 1 / rest
        digit = int(floor(rest))
        rest -= digit
        following = (digit * m + m0, digit * n + n0)
        if following[1] > most:
            break
        (m0, n0), (m, n) = (m, n), following
    return m, n


def multiples():
    """(distance, n, smallest quotient of a distance and the error of the multiple) for each binade."""
    found = []
    for binade in BINADES:
        spacing = mpf(2) ** (binade - 52)
        most = int(floor(2 ** (binade + 1) / pi))
        m, n = last_convergent(pi / spacing, most)
        distance = abs(m * spacing - n * pi)
        found.append((distance, n, distance / (most * pi * mpf(2) ** -105)))
    return found


def contraction(n):
    """alpha*_n = q - arctan(1/alpha*_n), q = (n + 1/2) pi."""
    q = (n + mpf(1) / 2) * pi
    alpha = q
    for _ in range(200):
        following = q - atan(1 / alpha)
        if abs(following - alpha) < mpf(2) ** (-BITS + 30):
            return following
        alpha = following
    raise ArithmeticError("no fixed point")


def by_series(n, half_pi):
    """alpha*_n in units of 2^-FRACTION, by the series; `half_pi` is pi/2 in these units."""
    q = (2 * n + 1) * half_pi
    inverse = (1 << 2 * FRACTION) // q
    square = inverse * inverse >> FRACTION
    power, total = inverse, q
    for numerator, denominator in SERIES:
        total -= power * numerator // denominator
        power = power * square >> FRACTION
    return total


def distance(alpha):
    """The distance to the nearest f64, relative to alpha, of alpha in units of 2^-FRACTION."""
    # The leading bit of alpha has the weight of 2^52 spacings.
    cut = alpha.bit_length() - 53
    part = alpha & (1 << cut) - 1
    return min(part, (1 << cut) - part) / alpha


def fixed_points(most):
    """The smallest relative distance of 1 <= n < most, and its n."""
    half_pi = int(nint(pi * mpf(2) ** (FRACTION - 1)))
    exact = [int(nint(contraction(n) * mpf(2) ** FRACTION)) for n in range(1, SERIES_FROM + 1)]
    if abs(exact[-1] - by_series(SERIES_FROM, half_pi)) >> FRACTION - 124:
        raise ArithmeticError("the series and the contraction differ")
    least = min((distance(alpha), n) for n, alpha in enumerate(exact, 1))
    for n in range(SERIES_FROM, most):
        here = distance(by_series(n, half_pi))
        if here < least[0]:
            least = (here, n)
    return least


def expected():
    """Expected number of f64 between alpha*_n and its computed value, for all n from FIXED_POINTS on, if distances are
    spread evenly: the sum of error/spacing."""
    total, low = mpf(0), FIXED_POINTS * pi
    while low < LARGEST_SPEED:
        binade = int(floor(mp.log(low, 2)))
        high = min(mpf(2) ** (binade + 1), mpf(LARGEST_SPEED))
        # One fixed point in pi: the integral of alpha/pi.
        total += FIXED_POINT_ERROR / mpf(2) ** (binade - 52) * (high**2 - low**2) / (2 * pi)
        low = high
    return total


def verify(check):
    with mp.workprec(BITS):
        found = multiples()
        nearest, n, _ = min(found)
        quotient = min(quotient for _, _, quotient in found)
        print(
            f"  multiples of pi: nearest {nstr(nearest, 4)} (n = {n}), at least {nstr(quotient, 3)} errors; "
            f"at E = 42 {nstr(found[-1][0], 3)}",
            flush=True,
        )
        wrong = (nearest < NEAREST_MULTIPLE) + (quotient < LEAST_QUOTIENT)
        most = FIXED_POINTS_OF_A_SAMPLE if check else FIXED_POINTS
        least, n = fixed_points(most)
        print(f"  fixed points with n < {most}: nearest {least:.4g} of alpha*_n (n = {n})")
        wrong += least < NEAREST_FIXED_POINT
        chance = expected()
        print(f"  expected wrong decisions for n >= {FIXED_POINTS}: {nstr(chance, 3)}")
        wrong += chance > EXPECTED
    return wrong
