"""On the left of alpha*_n the map rises, and for M <= 1 it falls with kappa, from the equations of both flights.

As on the right (`right_of_star.py`) the time of the first flight is the parameter: tau = 2a - u, a = alpha*_n, u >= 0.
With the E_k of that file, P = (a E_3(u) - u E_4(u))/(tau - sin tau), and c_1 = a E_2(u) - u E_3(u) + u P (1 - cos tau),

    alpha = a - u^3 P,    Gamma_1 = u^2 c_1,    d alpha/du = -u^2 c_1/(tau - sin tau)

Gamma being the closing speed. In a window the landing is sudden (docs/theory.md, Theorem 8). The second flight starts
from

    x = alpha tau - tau^2/2 = u X,  X = tau (1/2 - u^2 P),    V = alpha - tau + kappa Gamma_1

and lands at the time s = u sigma, where G/(s^2 u) = X E_2(s) + V sigma E_3(s) - u sigma^2 E_4(s) is zero. There, with x
from this equation,

    Gamma_2 = u^2 c_2,    c_2 = sigma^2 [s (E_3 - E_1 E_4/E_2) - V (E_2 - E_1 E_3/E_2)]

No term is singular at u = 0. F = alpha^2 - mu (Gamma_1^2 + Gamma_2^2) with mu = kappa (1 - kappa), so that

    -dF/du/u^2 = 2 alpha c_1/(tau - sin tau) + mu [4u (c_1^2 + c_2^2) + u^2 d(c_1^2 + c_2^2)/du]
    -dF/dkappa/u^4 = (1 - 2 kappa) (c_1^2 + c_2^2) + mu u^2 c_1 d(c_2^2)/dV

F rises with alpha where the first is positive. For kappa <= 1/2 it falls with kappa where d(c_2^2)/dV is positive.
Balls of u and kappa show both.
"""

from collections import namedtuple

from flint import arb

from right_of_star import series

# So far left of alpha*_n: for all M, and for M <= 1. The ranges of docs/theory.md, Theorem 81 and Corollary 93.
REACH, REACH_LIGHT = "0.0109", "0.0586"
# Most parts of the range of u and kappa: some 1300 are needed for M <= 1, and 165 for all M.
MOST_PARTS = 10000
# The first guess at the longest u, and the factor that makes it longer until its speed is below the range.
FIRST_TIME, LONGER = 0.4, 1.01
# Newton steps to the time of the second flight.
STEPS = 4
# The two brackets of c_2.
OF_CLOSING_SPEED = lambda e1, e2, e3, e4: e3 - e1 * e4 / e2, lambda e1, e2, e3, e4: e2 - e1 * e3 / e2


class Dual:
    """A ball with its derivatives by u and by V."""

    def __init__(self, value, by_u=0, by_v=0):
        self.value, self.by_u, self.by_v = arb(value), arb(by_u), arb(by_v)

    def of(self, value, slope):
        """A function of this number, from its value and its slope."""
        return Dual(value, slope * self.by_u, slope * self.by_v)

    def __add__(self, other):
        other = dual(other)
        return Dual(self.value + other.value, self.by_u + other.by_u, self.by_v + other.by_v)

    def __mul__(self, other):
        other = dual(other)
        by = lambda mine, others: mine * other.value + self.value * others
        return Dual(self.value * other.value, by(self.by_u, other.by_u), by(self.by_v, other.by_v))

    def __truediv__(self, other):
        other = dual(other)
        return self * other.of(1 / other.value, -1 / other.value**2)

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + -dual(other)

    def __rsub__(self, other):
        return dual(other) - self

    __radd__, __rmul__ = __add__, __mul__

    def sin(self):
        return self.of(self.value.sin(), self.value.cos())

    def cos(self):
        return self.of(self.value.cos(), -self.value.sin())

    def e(self, k):
        """E_k, whose slope is -t (E_(k+1) - k E_(k+2))."""
        return self.centred(lambda t: series(t, k), lambda t: -t * (series(t, k + 1) - k * series(t, k + 2)))

    def centred(self, f, slope):
        """f by its value in the middle and its slope."""
        middle, slope = self.value.mid(), slope(self.value)
        return self.of(f(middle) + slope * (self.value - middle), slope)


def dual(number):
    return number if isinstance(number, Dual) else Dual(number)


_rising = {}


def rises(n, a, light):
    """F rises on [a - REACH, a) for all M, or, if `light`, on [a - REACH_LIGHT, a) for all M <= 1, where it also falls
    with kappa."""
    key = n, light
    if key not in _rising:
        _rising[key] = found_to_rise(a, light)
    return _rising[key]


def found_to_rise(a, light):
    longest, widest = time_of(a, arb(REACH_LIGHT if light else REACH)), arb(1) / 2 if light else arb(1)
    work = [((arb(0), longest), (arb(0), widest))]
    for _ in range(MOST_PARTS):
        if not work:
            return True
        times, kappas = work.pop()
        if rises_on(a, times[0].union(times[1]), kappas[0].union(kappas[1]), light):
            continue
        if times[1] - times[0] > longest * (kappas[1] - kappas[0]):
            work += [(half, kappas) for half in halves(*times)]
        else:
            work += [(times, half) for half in halves(*kappas)]
    return False


def halves(low, high):
    middle = ((low + high) / 2).mid()
    return (low, middle), (middle, high)


def time_of(a, reach):
    """A time u whose speed is more than `reach` below a."""
    u = arb(FIRST_TIME)
    while not a - take_off(a, Dual(u), arb(0)).alpha.value > reach:
        u = (u * LONGER).mid()
    return u


TakeOff = namedtuple("TakeOff", "alpha c1 x v")


def take_off(a, u, kappa):
    """alpha, c_1, and X and V of the second flight."""
    tau = 2 * a - u
    q = tau - tau.sin()
    p = (a * u.e(3) - u * u.e(4)) / q
    c1 = a * u.e(2) - u * u.e(3) + u * p * (1 - tau.cos())
    alpha = a - u * u * u * p
    v = alpha - tau + kappa * u * u * c1
    v.by_v = arb(1)
    return TakeOff(alpha, c1, tau * (0.5 - u * u * p), v)


def rises_on(a, u, kappa, falls_with_kappa):
    """Both signs, for all u and kappa of two balls. False if one is open."""
    _, c1, x, v = take_off(a, Dual(u, 1), kappa)
    sigma = second_time(u, x, v)
    if sigma is None or not c1.value > 0:
        return False
    sigma = sharpened(sigma, a, u, kappa)
    u = Dual(u, 1)
    s = u * sigma
    # Contact follows the second landing.
    if not (x + v * sigma - 0.5 * u * sigma * sigma).value < 0:
        return False
    by_s, by_v = (lambda t, f=f: f(*(Dual(t, 1).e(k) for k in (1, 2, 3, 4))) for f in OF_CLOSING_SPEED)
    part = lambda f: s.centred(lambda t: f(t).value, lambda t: f(t).by_u)
    c2 = sigma * sigma * (s * part(by_s) - v * part(by_v))
    grows = lambda c: (2 * c + u * c.by_u).value > 0
    return c2.value > 0 and grows(c1) and grows(c2) and (not falls_with_kappa or c2.by_v > 0)


def sharpened(sigma, a, u, kappa):
    """sigma from the ends of u and kappa, if it is monotone in both: it rises with V, and so with kappa."""
    if not sigma.by_v > 0 or sigma.by_u.contains(0):
        return sigma
    first, last = (u.upper(), u.lower()) if sigma.by_u < 0 else (u.lower(), u.upper())
    ends = []
    for at, k in ((first, kappa.lower()), (last, kappa.upper())):
        start = take_off(a, Dual(at, 1), k)
        end = second_time(at, start.x, start.v)
        if end is None:
            return sigma
        ends.append(end.value)
    return Dual(ends[0].union(ends[1]), sigma.by_u, sigma.by_v)


def second_time(u, x, v):
    """sigma with its derivatives, or None.

    G starts with G = G' = 0, is convex while the stretch is above 1, then concave for a time of at least pi. So it has
    one zero before s = pi at most, the landing.
    """
    u = Dual(u, 1)

    def scaled_height(u, x, v, sigma):
        s = u * sigma
        return x * s.e(2) + v * sigma * s.e(3) - u * sigma * sigma * s.e(4)

    slope = lambda sigma: scaled_height(*(Dual(number.value) for number in (u, x, v)), Dual(sigma, 1)).by_u
    place, middles = arb(3), [Dual(number.value.mid()) for number in (u, x, v)]
    for _ in range(STEPS):
        at = scaled_height(*middles, Dual(place, 1))
        place = (place - at.value / at.by_u).mid()
    height = scaled_height(u, x, v, Dual(place)).value
    # Newton's step over a ball that is twice as wide as the first guess at the width.
    reach = 2 * abs(height / slope(place)).upper()
    ball = (place - reach).union(place + reach)
    found = place - height / slope(ball)
    if not (ball.contains(found) and (u * found).value < arb.pi()):
        return None
    at, down = scaled_height(u, x, v, Dual(found)), slope(found)
    return Dual(found, -at.by_u / down, -at.by_v / down)
