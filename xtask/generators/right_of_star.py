"""On the right of alpha*_n the map stays above it, from the equations of the first flight alone.

There the landing is a triple root in the limit, which signs do not enclose, and the loss is of the order
(alpha - a)^(4/3), a = alpha*_n. So the time of flight is taken as the parameter, tau = 2a + t. A lift-off at alpha lands when
tau^2/2 - 1 + cos tau = alpha Q with Q = tau - sin tau. Let N = tau^2/2 - 1 + cos tau - a Q, so that alpha - a = N/Q. As
tan a = a, N and its first two derivatives vanish at t = 0, and its third derivative is sin t + a cos t. With E_k = sum
over j of (-1)^j t^(2j) / (2j+k)! this gives

    N = a t^3 E_3 + t^4 E_4,    N' = a t^2 E_2 + t^3 E_3

without cancellation. The closing speed is tau - sin tau - alpha (1 - cos tau) = N' - (alpha - a) (1 - cos tau). On the
contact part of hump n the first landing is the only one of the hop, and alpha rises with tau (docs/theory.md, Theorems
7 and 8). So f(alpha) > a if and only if mu times the closing speed squared is below alpha^2 - a^2. With
P = (a E_3 + t E_4)/Q, alpha - a = t^3 P, this reads

    mu t (a E_2 + t E_3 - t P (1 - cos tau))^2 < P (2a + t^3 P)

For n = 0, where a = 0 and Q = t^3 E_3, it reads mu (t^2 (E_3^2/E_4 - E_2))^2 < 1 with alpha = t E_4/E_3.
"""

from functools import lru_cache
from math import factorial

from flint import arb, ctx

# Terms of E_k. For t below LONGEST the first one left out is below 10^-20.
TERMS = 16
# Longest t. The contact part ends at a smaller one than 3.6 for n >= 1; for n = 0 at 2 pi, where balls no longer
# decide.
LONGEST = 3.6
# Most parts of the times of flight. Near the end of a trap both sides are nearly equal; what is left there is followed
# by a hop instead.
MOST_PARTS = 6
# Steps to the time of a speed, and the part of it that is added for what they leave.
STEPS, LATER = 6, 1e-6


def stays_above(n, a, high, mu):
    """f(alpha) > a = alpha*_n for a < alpha <= high and all mu of a ball. False if that is open."""
    if not arb(high) < (n + 1) * arb.pi():
        return False
    if arb(high) <= a:
        return True  # there is no such speed
    end = time_of(n, a, high)
    if end is None:
        return False
    work = [(arb(0), end)]
    for _ in range(MOST_PARTS):
        if not work:
            return True
        first, last = work.pop()
        if loses_less(n, a, first.union(last), mu):
            continue
        middle = ((first + last) / 2).mid()
        work += [(middle, last), (first, middle)]
    return not work


def loses_less(n, a, t, mu):
    e2, e3, e4 = (series(t, k) for k in (2, 3, 4))
    if n == 0:
        return mu * (t * t * (e3 * e3 / e4 - e2)) ** 2 < 1
    tau = 2 * a + t
    p = (a * e3 + t * e4) / (tau - tau.sin())
    closing = a * e2 + t * e3 - t * p * (1 - tau.cos())
    return mu * t * closing**2 < p * (2 * a + t**3 * p)


def time_of(n, a, high):
    """A time t so late that the speed that lands then is at least `high`. None if it is too late, or not found."""
    t = arb(1)
    for _ in range(STEPS):
        # alpha - a is t^3 times a slow function of t, and alpha for n = 0 is t times one.
        t = min(t * ((high - a) / (speed_at(n, a, t) - a)).root(3 if n else 1).mid(), arb(LONGEST)).mid()
    t *= 1 + arb(LATER)
    return t if speed_at(n, a, t) >= high else None


def speed_at(n, a, t):
    e3, e4 = series(t, 3), series(t, 4)
    if n == 0:
        return t * e4 / e3
    tau = 2 * a + t
    return a + t**3 * (a * e3 + t * e4) / (tau - tau.sin())


def series(t, k):
    """E_k of a ball, by Horner's rule, with a bound on what is left out: its terms fall and alternate."""
    square = t * t
    *first, last, left_out = coefficients(k, ctx.prec)
    total = last
    for coefficient in reversed(first):
        total = coefficient + square * total
    return total + arb(0, abs(left_out * square**TERMS).upper())


@lru_cache
def coefficients(k, bits):
    """Those of E_k, and that of the first term left out."""
    return [arb((-1) ** j) / factorial(2 * j + k) for j in range(TERMS + 1)]
