"""The bound of Theorem 68 of docs/theory.md a second time: the loss on the left of alpha*_n, from the equations of both
flights.

With u, kappa, P, c_1 and sigma of `left_of_star.py`, and v = |delta|^(1/3) = u P^(1/3),

    delta - delta' = mu u^4 (c_1^2 + c_2^2)/(alpha + f),    f^2 = alpha^2 - mu u^4 (c_1^2 + c_2^2)
    G = (delta - delta')/(10 lambda |delta|^(4/3)) = 4 (c_1^2 + c_2^2)/(5 a beta^4 P^(4/3) (alpha + f))

G is analytic in u. The rest G - 1 - c_1' v - c_2' v^2, with the coefficients of Theorem 36, begins with u^3 by that
theorem. So, by the maximum principle, on a disc |u| <= U the rest over u^3 is at most its largest value on the circle.
There nothing cancels: complex balls, in a Taylor form of the second order by the angle and by kappa, enclose it. On the
disc itself they only have to show that nothing is singular: that every divisor is away from zero, every root's argument
has a positive real part, and the time sigma is the one zero near 3 of its equation.

`left_of_star.py` shows for the same n that delta falls with u, that this zero is the landing, and that contact follows
it. Of the theorem's own derivation only Theorem 36 is used, to which `vanishes` compares the first coefficients: the
rest of it expands the equations in the real time, in models with remainders, in another language.
"""

import argparse
import sys
from collections import namedtuple

from flint import acb, acb_series, arb, ctx

from left_of_star import OF_CLOSING_SPEED, rises
from right_of_star import TERMS, coefficients

# The range of delta and the bound of Theorem 68.
REACH, BOUND = arb("1e-3"), "8.79"
# The first guess at the longest u, and the factor that makes it longer until its speed is below the range.
FIRST_TIME, LONGER = arb("0.17"), arb("1.01")
# The Taylor form: value, slope, and a remainder of the second order.
ORDER = 2
# All times sigma of the disc are this near 3, their limit at u = 0.
NEAR = acb(3) + acb(arb(0, 0.4), arb(0, 0.4))
# Newton steps to sigma in the middle of an arc.
STEPS = 3
# The first parts of kappa, on the disc and on the circle.
PARTS = 4
# Most cells of the disc for one n; 1142 are needed for n = 1.
MOST_CELLS = 20000
# Parts of the real line on the disc, for the least P.
REAL_PARTS = 64
# First arcs of the circle, and how much more the rest bends with the angle than with kappa.
ARCS, STEEPER = 64, 8
# Most arcs for one n: 3054 are needed for n = 1, and 1282 for n = 100.
MOST_ARCS = 20000
# The first three coefficients at u = 0 are zero in all binary digits but this many, which rounding may take.
SPARE_BITS = 40
UNIT = acb(arb(0, 1))

Arc = namedtuple("Arc", "low high kappa_low kappa_high")


class Singular(Exception):
    """A divisor may be zero, or a root's argument negative."""


def e(k, z):
    """E_k of a complex ball, by Horner's rule. What is left out is less than twice its first term: |z| < 3."""
    square = z * z
    *first, last, left_out = coefficients(k, ctx.prec)
    total = acb(last)
    for coefficient in reversed(first):
        total = coefficient + square * total
    reach = arb(0, 2 * abs(left_out * square**TERMS).upper())
    return total + acb(reach, reach)


def by_e(k, series):
    """E_k of a power series to the second order: E_k' = -z E_(k+1) + k z E_(k+2)."""
    slope = lambda m, z: -z * (e(m + 1, z) - m * e(m + 2, z))
    middle = series[0]
    rest = acb_series([0] + [series[order] for order in range(1, ctx.cap)])
    bend = k * (e(k + 2, middle) + middle * slope(k + 2, middle)) - e(k + 1, middle) - middle * slope(k + 1, middle)
    return e(k, middle) + slope(k, middle) * rest + bend / 2 * rest * rest


def divided(above, below):
    if below[0].contains(0):
        raise Singular
    return above / below


def positive(series):
    """The argument of a root, on the branch of the positive numbers."""
    if not series[0].real > 0:
        raise Singular
    return series


def height(x, v, u, sigma):
    s = u * sigma
    return x * by_e(2, s) + v * sigma * by_e(3, s) - u * sigma * sigma * by_e(4, s)


def loss(a, beta, u, kappa, sigma_of):
    """The rest, from power series in u and kappa. `sigma_of` solves the second flight from its X, V and u."""
    tau = 2 * a - u
    sine, cosine = tau.sin(), tau.cos()
    q = tau - sine
    p = divided(a * by_e(3, u) - u * by_e(4, u), q)
    c1 = a * by_e(2, u) - u * by_e(3, u) + u * p * (1 - cosine)
    alpha = a - u * u * u * p
    x, v = tau * (acb(0.5) - u * u * p), alpha - tau + kappa * u * u * c1
    sigma = sigma_of(x, v, u)
    s = u * sigma
    functions = [by_e(k, s) for k in (1, 2, 3, 4)]
    if functions[1][0].contains(0):
        raise Singular
    by_s, by_v = (f(*functions) for f in OF_CLOSING_SPEED)
    c2 = sigma * sigma * (s * by_s - v * by_v)
    squares, mu = c1 * c1 + c2 * c2, kappa * (1 - kappa)
    f = positive(alpha * alpha - mu * u * u * u * u * squares).sqrt()
    root = (positive(p).log() / 3).exp()
    third_root, second = root * u, 31 / (80 * a * a) - 9 * kappa / 10 + acb(arb(34) / 25)
    g = divided(4 * squares, 5 * a * beta**4 * p * root * positive(alpha + f))
    return g - 1 + beta / a * third_root + beta**2 * second * third_root * third_root


def newton(place, ball):
    """Newton's step from a point over a ball, for the second flight. The slope's real part is negative on the convex
    ball, so that it has one zero."""

    def step(x, v, u):
        order, ctx.cap = ctx.cap, 2
        constant = lambda series: acb_series([series[0]])
        at = lambda sigma: height(constant(x), constant(v), constant(u), sigma)
        try:
            down, value = at(acb_series([ball, 1]))[1], at(acb_series([place]))[0]
        finally:
            ctx.cap = order
        if not down.real < 0:
            raise Singular
        return place - value / down

    return step


def sigma_near(x, v, u):
    """sigma at all u of a ball: the one zero near 3."""
    found = newton(acb(3), NEAR)(x, v, u)
    if not NEAR.contains(found):
        raise Singular
    return found


def sigma_series(x, v, u, found=None):
    """The power series of sigma: its height, zero for all arguments, gives one coefficient after the other."""
    if found is None:
        found = sigma_near(x, v, u)
        for _ in range(STEPS):
            found = newton(found.mid(), found)(x, v, u)
    slope = newton_slope(x, v, u, found)
    series = [found]
    for order in range(1, ctx.cap):
        series.append(-height(x, v, u, acb_series(series))[order] / slope)
    return acb_series(series)


def newton_slope(x, v, u, sigma):
    return height(*(acb_series([series[0]]) for series in (x, v, u)), acb_series([sigma, 1]))[1]


def on_arc(a, beta, radius, arc):
    """|rest| on an arc of the circle: its value and both slopes in the middle, and the second order over all of it."""
    angle, angle_reach = (arc.low + arc.high) / 2, (arc.high - arc.low) / 2
    kappa, kappa_reach = (arc.kappa_low + arc.kappa_high) / 2, (arc.kappa_high - arc.kappa_low) / 2

    def at(angle, kappa, sigma_of):
        u = radius * (acb_series(angle) * acb(0, 1)).exp()
        found = []
        keep = lambda *start: found.append(sigma_of(*start)) or found[0]
        return loss(a, beta, u, acb_series(kappa), keep), found[0]

    by_angle, sigma_by_angle = at([angle, angle_reach], [kappa], sigma_series)
    by_kappa, sigma_by_kappa = at([angle], [kappa, kappa_reach], sigma_series)

    def centred(x, v, u):
        """sigma over the whole arc, by its own slopes in the middle: twice as narrow and more."""
        bend = sigma_series(x, v, u)[2]
        return sigma_series(
            x, v, u, sigma_by_angle[0] + sigma_by_angle[1] * UNIT + sigma_by_kappa[1] * UNIT + bend * UNIT
        )

    # Any direction: each of the two first-order terms is a number of its size.
    angles, kappas = arc.low.union(arc.high), arc.kappa_low.union(arc.kappa_high)
    all_of_it, _ = at([angles, angle_reach * UNIT], [kappas, kappa_reach * UNIT], centred)
    return sum(abs(part).upper() for part in (by_angle[0], by_angle[1], by_kappa[1], all_of_it[2]))


def holds(n, bound):
    """Theorem 68 next to one alpha*_n, with another bound if one is given: the number of arcs, or None if it is
    open."""
    a = star(n)
    if not rises(n, a, False):
        return None
    ctx.cap = ORDER + 1
    beta = (12 * a * a / (1 + a * a)).root(3)
    radius = radius_of(a)
    if not is_regular(a, beta, radius) or not vanishes(a, beta):
        return None
    largest = arb(bound) * least_p(a, radius) * radius**3
    ends = [arb(k) / PARTS for k in range(PARTS + 1)]
    angles = [arb.pi() * k / ARCS for k in range(ARCS + 1)]
    work, done = [Arc(*arc, *part) for arc in zip(angles, angles[1:]) for part in zip(ends, ends[1:])], 0
    while work:
        arc = work.pop()
        try:
            if on_arc(a, beta, radius, arc) < largest:
                done += 1
                continue
        except Singular:
            pass
        if done + len(work) > MOST_ARCS:
            return None
        work += halves(arc)
    return done


def is_regular(a, beta, radius):
    """Whether nothing is singular on the disc. The half below the real line is the other's mirror image."""
    ends = [arb(k) / PARTS for k in range(PARTS + 1)]
    work = [(-radius, radius, arb(0), radius, *kappas) for kappas in zip(ends, ends[1:])]
    for _ in range(MOST_CELLS):
        if not work:
            return True
        low, high, below, above, first, last = work.pop()
        cell = acb(low.union(high), below.union(above))
        if abs(cell) > radius:
            continue
        try:
            on_cell(a, beta, cell, first.union(last))
        except Singular:
            middle, half = (low + high) / 2, (below + above) / 2
            sides = [(low, middle), (middle, high)], [(below, half), (half, above)]
            work += [(*across, *up, first, last) for across in sides[0] for up in sides[1]]
    return False


def on_cell(a, beta, u, kappa):
    order, ctx.cap = ctx.cap, 1
    try:
        loss(a, beta, acb_series([u]), acb_series([acb(kappa)]), lambda x, v, u: acb_series([sigma_near(x, v, u)]))
    finally:
        ctx.cap = order


def least_p(a, radius):
    """The least P for real u on the disc."""
    ends = [radius * k / REAL_PARTS for k in range(REAL_PARTS + 1)]
    return min((drop(a, low.union(high)) for low, high in zip(ends, ends[1:])), key=lambda p: p.lower()).lower()


def vanishes(a, beta):
    """The first three coefficients at u = 0 are zero, as Theorem 36 says, as far as balls of points can show it.

    They are of the first degree in kappa, which enters the second flight with u^2 and mu with u^4: its two ends tell
    for all.
    """
    tiny = arb(2) ** (SPARE_BITS - ctx.prec)
    rests = [loss(a, beta, acb_series([0, 1]), acb_series([acb(kappa)]), sigma_series) for kappa in (0, 1)]
    return all(abs(rest[order]) < tiny for rest in rests for order in range(3))


def halves(arc):
    low, high, first, last = arc
    if STEEPER * (high - low) > last - first:
        middle = ((low + high) / 2).mid()
        return [Arc(low, middle, first, last), Arc(middle, high, first, last)]
    middle = ((first + last) / 2).mid()
    return [Arc(low, high, first, middle), Arc(low, high, middle, last)]


def radius_of(a):
    """A real u whose speed is more than the range below a."""
    u = FIRST_TIME
    while not u**3 * drop(a, u) > REACH:
        u = (u * LONGER).mid()
    return u


def drop(a, u):
    """P = |delta|/u^3 for real u."""
    tau = 2 * a - u
    return (a * e(3, acb(u)) - u * e(4, acb(u))).real / (tau - tau.sin())


def star(n):
    """alpha*_n, from q - arctan(1/alpha) = alpha."""
    q = (2 * n + 1) * arb.pi() / 2
    a = q
    for _ in range(ctx.prec):
        a = (q - (1 / a).atan()).mid()
    # The map contracts: its derivative 1/(1 + a^2) is below 1/20.
    error = abs(q - (1 / a).atan() - a).upper() * 2
    return a + arb(0, error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("n", nargs="*", type=int, default=[*range(1, 11), 100])
    parser.add_argument("--bound", default=BOUND, help="a larger one takes seconds for minutes")
    options = parser.parse_args()
    if min(options.n) < 1:
        parser.error("n is 1 or more: the map is steep next to alpha*_0 = 0")
    ctx.prec = 128
    for n in options.n:
        arcs = holds(n, options.bound)
        if arcs is None:
            sys.exit(f"n = {n}: open")
        print(
            f"n = {n}: |G - 1 - c_1 v - c_2 v^2| <= {options.bound} v^3 for all M and -10^-3 <= delta < 0, by {arcs}"
            " arcs",
            flush=True,
        )


if __name__ == "__main__":
    main()
