"""One hop of the passive hopper, with as many digits as are asked for.

The state after a lift-off is (Y, V): stretch and speed of the upper mass. During a flight
    s(t) = Y cos t + V sin t                stretch
    P(t) = Y + V t - t^2/2                  momentum coordinate
    G(t) = P - s                            height of the lower mass, times 1 + M
The first landing is the first zero t > 0 of G. The search is certain (docs/model.md, the first landing):
G'' = s - 1 changes sign only on the lattice t = phi +- gamma + 2 pi k. Between two neighbours of the lattice
G is convex or concave, and on the lattice G = P - 1. One sign on each end therefore decides each cell.

All functions work at the precision that mpmath has when they are called. `confirmed` raises that precision
until the printed digits no longer change.
"""

import math

from mpmath import mp, mpf, cos_sin, sqrt, atan2, acos, cbrt, ceil, floor, nstr


class Stuck(Exception):
    """The precision does not suffice for a verdict."""


def height(y, v, t):
    """G, G' and s - 1 at the time t."""
    c, s = cos_sin(t)
    stretch = y * c + v * s
    return (y + t * (v - t / 2)) - stretch, v * (1 - c) - t + y * s, stretch - 1


def guess(y, v, start, left, right):
    """A place in [left, right] near the zero of G; `start` where none is known.

    Near a fixed point, and for the short flight after a sudden lift-off there, G is nearly a cube and f64 sees
    nothing: the leading order serves. Elsewhere Newton's method in f64 does.
    """
    if y == 1:
        n = int(floor(v / mp.pi))
        star = alpha_star(n) if n else mpf(0)
        offset = v - star
        if n and abs(offset) < 0.01:
            return 2 * star + mp.sign(offset) * cbrt(12 * star**2 / (1 + star**2) * abs(offset))
    elif v < 0 and y - 1 < 0.01:
        return 3 * (y - 1) / -v
    y, v, t = float(y), float(v), float(start)
    low, high = float(left), float(right)
    for _ in range(60):
        c, s = math.cos(t), math.sin(t)
        g = (y - y * c - v * s) + t * (v - t / 2)
        slope = v * (1 - c) - t + y * s
        if slope == 0:
            break
        moved = t - g / slope
        if not low < moved < high:
            break
        if abs(moved - t) <= 1e-14 * t:
            return mpf(moved)
        t = moved
    return start


def newton(y, v, start, left, right):
    """The zero of G in [left, right], where G has one sign of curvature, from an end where G G'' >= 0.

    From such an end Newton's iterates approach the zero from one side and never pass it. A step against that
    direction is rounding, and ends the search. A place that f64 proposes replaces the end where G has the sign
    that it has at the end; one step from any other place leads to that side, or out of the cell.
    """
    sign = mp.sign(height(y, v, start)[0])
    direction = 1 if start == left else -1
    t = guess(y, v, start, left, right)
    g, slope, _ = height(y, v, t)
    if slope * sign * direction < 0 and mp.sign(g) == -sign:
        t -= g / slope
    if not left <= t <= right or mp.sign(height(y, v, t)[0]) != sign:
        t = start
    for _ in range(100000):
        g, slope, _ = height(y, v, t)
        if g == 0 or slope == 0:
            return t
        step = -g / slope
        moved = t + step
        if mp.sign(step) != direction or moved == t:
            return t
        if not left <= moved <= right:
            raise Stuck("a step of Newton's method leaves its cell")
        t = moved
    raise Stuck("Newton's method does not end")


def dip(y, v, left, right):
    """A place with G < 0 in a convex cell with G'(left) < 0 < G'(right); None where G > 0 on the whole cell.

    The bracket always holds the lowest point. G lies above each of its tangents, which ends the search.
    """
    t = (left + right) / 2
    for _ in range(20 * mp.prec):
        g, slope, curvature = height(y, v, t)
        if g < 0:
            return t
        if slope < 0:
            left = t
        else:
            right = t
        if g - abs(slope) * (right - left) > 0:
            return None
        moved = t - slope / curvature if curvature > 0 else left
        if not left < moved < right:
            moved = (left + right) / 2
        t = moved
    raise Stuck("a touch or a landing")


def first_landing(y, v):
    """The first t > 0 with G(t) = 0, for y > 1, or y = 1 and v > 0."""
    radius = sqrt(y * y + v * v)
    if y == 1 and v <= 0:
        raise ValueError("not a lift-off")
    phi = atan2(v, y)
    gamma = acos(1 / radius)
    turn = 2 * mp.pi

    # Cell 2k is convex, from phi - gamma + 2 pi k; cell 2k + 1 is concave, from phi + gamma + 2 pi k.
    def start_of(cell):
        return phi + (gamma if cell % 2 else -gamma) + turn * (cell // 2)

    # t = 0 lies in cell 0, which is convex with G = 0 and G' >= 0: no landing in it.
    cell = 1
    # Where P >= radius, also P >= s and G >= 0. That is so between the two times of P = radius.
    square = v * v - 2 * (radius - y)
    if v > 0 and square > 0:
        up, down = v - sqrt(square), v + sqrt(square)
        above = int(floor((down - phi + gamma) / turn)) * 2 - 2
        first_above = int(ceil((up - phi + gamma) / turn)) * 2 + 2
        skip = (first_above, above)
    else:
        skip = (1, 0)
    while True:
        if skip[0] <= cell < skip[1]:
            cell = skip[1]
        left, right = start_of(cell), start_of(cell + 1)
        height_right = (y - 1) + right * (v - right / 2)
        if cell % 2:
            if height_right < 0:
                return newton(y, v, right, left, right)
        else:
            if height_right < 0:
                return newton(y, v, left, left, right)
            slope_left, slope_right = height(y, v, left)[1], height(y, v, right)[1]
            if slope_left < 0 < slope_right:
                bottom = dip(y, v, left, right)
                if bottom is not None:
                    return newton(y, v, left, left, bottom)
        cell += 1


class Hop:
    """The hop from a gradual lift-off with speed alpha."""

    def __init__(self, mass_ratio, alpha, slopes=False):
        m = mpf(mass_ratio)
        kappa, mu = m / (1 + m), m / (1 + m) ** 2
        d_kappa, d_mu = 1 / (1 + m) ** 2, (1 - m) / (1 + m) ** 3
        y, v = mpf(1), mpf(alpha)
        # Derivatives of (Y, V, sum of the squares of G') by alpha and by M.
        d_y, d_v, d_sum = [mpf(0), mpf(0)], [mpf(1), mpf(0)], [mpf(0), mpf(0)]
        total = mpf(0)
        self.times, self.stretches, self.velocities = [], [], []
        while True:
            t = first_landing(y, v)
            c, s = cos_sin(t)
            closing = v * (1 - c) - t + y * s
            next_y, next_v = y * c + v * s, v - t - kappa * closing
            total += closing * closing
            if slopes:
                spring = v * c - y * s
                for k in (0, 1):
                    d_t = -((1 - c) * d_y[k] + (t - s) * d_v[k]) / closing
                    d_closing = s * d_y[k] + (1 - c) * d_v[k] + (next_y - 1) * d_t
                    d_sum[k] += 2 * closing * d_closing
                    d_y[k] = c * d_y[k] + s * d_v[k] + spring * d_t
                    d_v[k] += -d_t - kappa * d_closing - (d_kappa * closing if k else 0)
            self.times.append(t)
            self.stretches.append(next_y)
            self.velocities.append(next_v)
            y, v = next_y, next_v
            if y <= 1:
                break
        self.sudden = len(self.times) - 1
        self.radicand = alpha * alpha - mu * total
        self.next = sqrt(self.radicand) if self.radicand >= 0 else None
        # alpha - alpha', without a difference of neighbours.
        self.loss = None if self.next is None else mu * total / (alpha + self.next)
        self.slopes = None
        if slopes and self.next is not None:
            by_alpha = (2 * alpha - mu * d_sum[0]) / (2 * self.next)
            by_mass = (-mu * d_sum[1] - d_mu * total) / (2 * self.next)
            self.slopes = (by_alpha, by_mass)


_stars = {}


def alpha_star(n):
    """The n-th positive root of tan x = x, at the precision in force."""
    key = (n, mp.prec)
    if key not in _stars:
        with mp.extraprec(40):
            q = (n + mpf(1) / 2) * mp.pi
            # x = q - atan(1/x) is a contraction with factor 1/x^2; Newton's method ends it.
            x = q - 1 / q
            for _ in range(mp.prec):
                c, s = cos_sin(x)
                step = (s - x * c) / (x * s)
                x -= step
                if abs(step) <= mp.eps * x:
                    break
        _stars[key] = +x
    return _stars[key]


def confirmed(make, smallest=1.0):
    """`make()` at rising precision, until two successive results are equal.

    `smallest` is the speed, or its distance from a fixed point. G is of its fourth power at small speeds, so the
    first precision holds 70 digits beside that.
    """
    digits = 70 + int(4 * abs(math.log10(abs(smallest))))
    last = None
    for _ in range(9):
        with mp.workdps(digits):
            try:
                found = make()
            except Stuck:
                found = None
        if found is not None and found == last:
            return found
        last, digits = found, digits * 3 // 2
    raise Stuck("the digits do not settle")


def text(x, digits=40):
    """Fixed count of digits, zeros at the end kept."""
    return None if x is None else nstr(x, digits, strip_zeros=False)


def scientific(x, digits=40):
    """Always with an exponent, zeros at the end dropped."""
    return nstr(x, digits, min_fixed=0, max_fixed=0)
