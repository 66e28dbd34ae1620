"""Hops of the passive hopper in ball arithmetic (Arb), from the equations of motion alone.

A state at a take-off is (x, V): the stretch 1 + x and the speed of the upper mass, with the lower mass at rest on the
ground. In flight (docs/model.md)

    s(t) = (1 + x) cos t + V sin t          stretch:             s'' = -s
    P(t) = (1 + x) + V t - t^2/2            momentum coordinate: P'' = -1
    G(t) = P - s                            height of the lower mass, times 1 + M

The next landing is the first t > 0 with G(t) = 0. Its time is enclosed by the signs of G: G'' = s - 1, so that G is
convex or concave between the times with s = 1, and at these times G = P - 1 is a parabola. After the landing the upper
mass has the speed (1-kappa) P' + kappa s', kappa = M/(1+M). For s > 1 the next flight follows. Otherwise contact
follows, in which V^2 + 2x + kappa x^2 is constant, because x'' = -1 - kappa x; where x = 0 again, its root is the next
lift-off speed.

No landing time is found by a formula of the Rust crates, which work with half the time of flight and with the sum of
the losses.
"""

import math

from flint import arb, ctx

from certificate_file import Undecided

# Balls narrower than this, relative to their size, are followed as a whole; of wider ones the two extreme corners.
NARROW = 2.0**-60
# Most flights of a hop.
MOST_FLIGHTS = 500


def parameter(mass_ratio):
    """kappa = M/(1+M), which rises with M."""
    return 1 - 1 / (1 + arb(mass_ratio))


def sign(ball):
    """1 or -1; 0 where the ball holds zero."""
    return 1 if ball > 0 else -1 if ball < 0 else 0


def squared(ball):
    """The squares, not below those of the ends."""
    low, high = abs(ball.lower()), abs(ball.upper())
    return ball * ball if ball.contains(0) else (low * low).union(high * high)


def energy(x, v, kappa):
    """V^2 + 2x + kappa x^2, which contact does not change: the square of the next lift-off speed."""
    return squared(v) + 2 * x + kappa * x * x


def height(t, x, v):
    s, c = t.sin_cos()
    return x + v * t - t * t / 2 - ((1 + x) * c - 1) - v * s


def slope(t, x, v):
    """G'(t)."""
    s, c = t.sin_cos()
    return v * (1 - c) - t + (1 + x) * s


def float_root(x, v, low, high):
    """A place near the landing in [low, high], by plain arithmetic; it proves nothing."""
    t = 3 * x / -v if v < 0 and x < 1e-3 * v * v else 0.5 * (low + high)
    if not low < t < high:
        t = 0.5 * (low + high)
    for _ in range(60):
        s, c = math.sin(t), math.cos(t)
        g = x + v * t - t * t / 2 - ((1 + x) * c - 1) - v * s
        if g > 0:
            low = t
        else:
            high = t
        down = v * (1 - c) - t + (1 + x) * s
        moved = t - g / down if down < 0 else 0.5 * (low + high)
        if not low < moved < high:
            moved = 0.5 * (low + high)
        if abs(moved - t) <= 1e-15 * t:
            return moved
        t = moved
    return t


def between_signs(x, v, left, right):
    """The zero of G in [left, right], where G changes its sign once, from + to -: a ball whose ends have these
    signs."""
    low, high = left.mid(), right.mid()
    t = arb(float_root(float(x.mid()), float(v.mid()), float(low), float(high)))
    mid_x, mid_v = x.mid(), v.mid()
    smallest = abs(t).mid() * arb(2) ** (8 - ctx.prec)
    last = None
    for _ in range(200):
        down = slope(t, mid_x, mid_v).mid()
        g = height(t, mid_x, mid_v).mid()
        low, high = (t, high) if g > 0 else (low, t)
        before = t
        t = (t - g / down).mid() if down < 0 else high
        # The first place has 53 bits, too few for a short flight: G may rise there.
        if not (low <= t and t <= high and down < 0):
            t = ((low + high) / 2).mid()
        size = abs(t - before).mid()
        if size <= smallest or (last is not None and size >= last and size < smallest * 2**20):
            break
        last = size
    reach = smallest * 4
    start = finish = None
    for _ in range(ctx.prec // 2):
        if start is None:
            at = (t - reach).mid()
            start = left.lower() if not at > left else at if height(at, x, v) > 0 else None
        if finish is None:
            at = (t + reach).mid()
            finish = right.upper() if not at < right else at if height(at, x, v) < 0 else None
        if start is not None and finish is not None:
            return start.union(finish)
        reach = reach * 8
    raise Undecided("the signs beside a landing")


def dips(x, v, left, right):
    """A time in a convex cell, with G > 0 at its ends, at which G < 0; None if G > 0 on all of it."""
    if slope(left, x, v) >= 0 or slope(right, x, v) <= 0:
        return None
    low, high = float(left), float(right)
    xf, vf = float(x.mid()), float(v.mid())
    for _ in range(60):
        t = 0.5 * (low + high)
        if vf * (1 - math.cos(t)) - t + (1 + xf) * math.sin(t) < 0:
            low = t
        else:
            high = t
    t = arb(0.5 * (low + high))
    g = height(t, x, v)
    if g < 0:
        return t
    # A convex function lies above its tangents.
    if g - abs(slope(t, x, v)) * (right - left) > 0:
        return None
    raise Undecided("a touch or a landing")


def landing(x, v):
    """The time of the first landing of the flight from (x, v): x > 0, or x = 0 exactly and v > 0. One ball for all
    states of x, v."""
    y = 1 + x
    radius = (y * y + v * v).sqrt()
    turn = 2 * arb.pi()
    if x.is_zero():
        first = 2 * v.atan()
        second = turn
    else:
        phi, gamma = arb.atan2(v, y), (1 / radius).acos()
        first, second = phi + gamma, phi - gamma + turn
    on_lattice = lambda t: x + t * (v - t / 2)
    # Up to `first` G is convex with G = G' = 0 at the start, so that G > 0 there. Concave cells begin at `first`,
    # convex ones at `second`.
    k, jumped = 0, False
    for _ in range(100000):
        left, right, after = first + k * turn, second + k * turn, first + (k + 1) * turn
        g = on_lattice(right)
        if g < 0:
            return between_signs(x, v, left, right)
        if not g > 0:
            raise Undecided("a landing at s = 1")
        far = g > radius - 1
        g = on_lattice(after)
        if g < 0:
            return between_signs(x, v, right, after)
        if not g > 0:
            raise Undecided("a landing at s = 1")
        # G >= P - radius: a cell with P > radius at both ends has no landing, nor have all cells between two such
        # times.
        if not (far and g > radius - 1):
            bottom = dips(x, v, right, after)
            if bottom is not None:
                return between_signs(x, v, right, bottom)
        elif not jumped:
            jumped = True
            square = float(v * v - 2 * (radius - y))
            if square > 0:
                down = float(v) + math.sqrt(square)
                further = int((down - float(first)) / (2 * math.pi)) - 1
                if further > k + 1 and on_lattice(first + further * turn) > radius - 1:
                    k = further - 1
        k += 1
    raise Undecided("too many turns")


def landing_times(x, v):
    """All first landings of states in x, v. G rises with x and V at fixed t: it is least at the lower corner, greatest
    at the upper."""
    if x.rad() <= NARROW * (1 + abs(x).mid()) and v.rad() <= NARROW * abs(v).mid():
        return landing(x, v)
    if x.is_zero():
        return landing(x, v.lower()).union(landing(x, v.upper()))
    last = landing(x.upper(), v.upper())
    if not x.lower() > 0:
        if v.lower() > 0:
            raise Undecided("a landing at s = 1")
        return arb(0).union(last)  # from x = 0 such a flight ends at once
    return landing(x.lower(), v.lower()).union(last)


def falls_to(time, y, v):
    """The stretch s falls up to this time. A landing before it has s <= 1: as long as s > 1, G'' > 0 and G > 0."""
    sin, cos = arb(0).union(time).sin_cos()
    return v * cos - y * sin < 0


def time_less_sine(t):
    """t - sin t over a ball; it rises."""
    low, high = t.lower(), t.upper()
    return (low - low.sin()).union(high - high.sin())


class Hop:
    """F = square of the next lift-off speed, below 0 where the hopper is grounded, over all alpha and kappa of two
    balls.

    `by_alpha` and `by_kappa` are its derivatives, None where the hop may or may not have one more short flight.
    `in_window` says that all speeds are in a window, whose first landing is sudden (docs/theory.md, Theorem 8): balls
    lose this at the end of a window.
    """

    def __init__(self, alpha, kappa, derivatives=True, in_window=False):
        x, v = arb(0), alpha
        x_a, v_a, x_k, v_k = arb(0), arb(1), arb(0), arb(0)
        self.flights = 0
        self.by_alpha = self.by_kappa = None
        while True:
            self.flights += 1
            if self.flights > MOST_FLIGHTS:
                raise Undecided("too many flights")
            t = landing_times(x, v)
            sin, cos = t.sin_cos()
            y = 1 + x
            stretch, momentum = y * cos + v * sin, v - t
            spring = v * cos - y * sin
            # spring - momentum, in terms that keep their digits in short flights.
            rise, lag = 2 * (t / 2).sin() ** 2, time_less_sine(t)
            closing = lag - v * rise - x * sin
            next_x = (x + v * t - t * t / 2).intersection(stretch - 1)
            next_v = momentum + kappa * closing
            before, before_v = (x_a, v_a, x_k, v_k), v
            if derivatives:
                # G(t; x, V) = 0 defines t: its derivative follows from those of G.
                t_a = (rise * x_a + lag * v_a) / closing
                t_k = (rise * x_k + lag * v_k) / closing
                change = lambda dx, dv, dt: (
                    dx + t * dv + momentum * dt,
                    (1 - kappa) * (dv - dt) + kappa * (cos * dv - sin * dx - stretch * dt),
                )
                (x_a, v_a), (x_k, v_k) = change(x_a, v_a, t_a), change(x_k, v_k, t_k)
                v_k += closing
            x, v = next_x, next_v
            if x < 0:
                break
            if in_window and self.flights == 1:
                continue
            if in_window and falls_to(t.upper(), y, before_v):
                break
            if not x > 0:
                self.square = self.next_to_joint(x, v, kappa)
                return
        self.square = energy(x, v, kappa)
        if derivatives:
            # The derivative of V^2 + 2x + kappa x^2 after the last flight. The terms with dt add up to -2 kappa (1 +
            # kappa x) closing dt, in which the closing speed cancels.
            x_a, v_a, x_k, v_k = before
            tilt = 1 + kappa * x
            change = lambda dx, dv: 2 * tilt * ((1 - kappa * rise) * dx + (t - kappa * lag) * dv) + 2 * v * (
                (1 - kappa * rise) * dv - kappa * sin * dx
            )
            self.by_alpha = change(x_a, v_a)
            self.by_kappa = change(x_k, v_k) + 2 * v * closing + x * x

    @staticmethod
    def next_to_joint(x, v, kappa):
        """F after landings with s below and above 1: contact follows, or one more flight, which is short."""
        if not v < 0:
            raise Undecided("a landing at s = 1")
        found = energy(x, v, kappa)
        upper = x.upper()
        if upper > 0:
            last = landing(upper, v.upper()).upper()
            start = arb(0).union(upper)
            if not falls_to(last, 1 + start, v):
                raise Undecided("a long flight at s = 1")
            t = arb(0).union(last)
            sin, cos = t.sin_cos()
            spring = v * cos - (1 + start) * sin
            momentum = v - t
            found = found.union(energy(start + v * t - t * t / 2, momentum + kappa * (spring - momentum), kappa))
        return found


def square_bounds(alphas, kappas):
    """Lower and upper bound of F over two intervals, each given by its ends: from ends where F is monotone, from the
    middle and the slope elsewhere.

    The ends are kept beside the balls, because the radius of a ball has 30 bits.
    """
    sides = [(low, high, low.union(high)) for low, high in (alphas, kappas)]
    whole = Hop(sides[0][2], sides[1][2])
    low, high = whole.square.lower(), whole.square.upper()
    slopes = (whole.by_alpha, whole.by_kappa)
    if any(slope is None or not slope.is_finite() for slope in slopes):
        return low, high
    for side in (-1, 1):
        places, spread = [], arb(0)
        for (first, last, ball), slope in zip(sides, slopes):
            rises = sign(slope)
            if rises:
                places.append(last if rises == side else first)
            else:
                places.append(ball.mid())
                spread += abs(slope).upper() * ball.rad()
        at = Hop(*places, derivatives=False).square
        if side < 0:
            low = max(low, (at - spread).lower())
        else:
            high = min(high, (at + spread).upper())
    return low, high
