"""Times of the events of scenes whose answers are known, and the state at the end (crates/hopper/hopper-studies).

ball          x'' = -9.81 from x = 1 at rest, x' -> -0.8 x' at x = 0; the first 40 impacts; at rest at t = 5
pendulum      x'' = -sin x from x = 2 at rest; x = 0 up to t = 400
turning points  the same pendulum; x = 1.9999
van der Pol   x'' = 5 (1 - x^2) x' - x from (2, 0); x = 0 up to t = 300
relay with hysteresis   x' = s + 0.3 from x = 1, s = -1; s changes its sign at s x = 0.01; up to t = 5
relay         x' = 0.3 - sgn x from x = 1; it reaches x = 0 and stays there
"""

from mpmath import asin, ellipf, ellipfun, ellipk, floor, mp, mpf, nstr, sin, sqrt

# Digits of the computation and of its results. The results are compared with doubles.
WORKING, PRINTED = 40, 25


def ball():
    fall, ratio = sqrt(2 / mpf("9.81")), mpf("0.8")
    times, flight = [fall], 2 * fall * ratio
    while len(times) < 40:
        times.append(times[-1] + flight)
        flight *= ratio
    return times, mpf(0)


def pendulum(level):
    """x = 2 asin(k sn(t + K)) with k = sin 1: the times of x = level."""
    k, until = sin(mpf(1)), mpf(400)
    quarter = ellipk(k * k)
    # The time from x = 2 down to the level.
    down = quarter - ellipf(asin(sin(level / 2) / k), k * k)
    count = int(floor(until / (4 * quarter))) + 2
    times = [4 * quarter * turn + sign * down for turn in range(count) for sign in (-1, 1)]
    end = 2 * asin(k * ellipfun("sn", until + quarter, m=k * k))
    return [t for t in sorted(times) if 0 < t <= until], end


def series(x, v, order):
    """Taylor coefficients of van der Pol's x."""
    xs, vs, squares = [x], [v], []
    for n in range(order):
        squares.append(sum(xs[i] * xs[n - i] for i in range(n + 1)))
        bend = 5 * (vs[n] - sum(squares[i] * vs[n - i] for i in range(n + 1))) - xs[n]
        xs.append(vs[n] / (n + 1))
        vs.append(bend / (n + 1))
    return xs, vs


def value(coefficients, h):
    total = mpf(0)
    for c in reversed(coefficients):
        total = total * h + c
    return total


def van_der_pol():
    """Taylor steps of order 40, each so long that its last two terms are below 1e-36."""
    t, x, v, until, order, times = mpf(0), mpf(2), mpf(0), mpf(300), 40, []
    small = mpf(10) ** -36
    while t < until:
        xs, vs = series(x, v, order)
        h = min((small / max(abs(c[-1]), abs(c[-2]))) ** (mpf(1) / order) for c in (xs, vs))
        h = min(h, until - t)
        after = value(xs, h)
        if (after > 0) != (x > 0):
            left, right = mpf(0), h
            # Bisection: x may bend on the step.
            for _ in range(mp.prec):
                middle = (left + right) / 2
                if (value(xs, middle) > 0) == (x > 0):
                    left = middle
                else:
                    right = middle
            times.append(t + left)
        t, x, v = t + h, after, value(vs, h)
    return times, x


def hysteresis():
    t, x, s, times = mpf(0), mpf(1), -1, []
    drift, width = mpf("0.3"), mpf("0.01")
    while True:
        arc = (s * width - x) / (s + drift)
        if t + arc > 5:
            return times, x + (s + drift) * (5 - t)
        t, x, s = t + arc, s * width, -s
        times.append(t)


def relay():
    return [1 / mpf("0.7")], mpf(0)


SCENES = {
    "ball": ball,
    "pendulum": lambda: pendulum(mpf(0)),
    "turning points": lambda: pendulum(mpf("1.9999")),
    "van der Pol": van_der_pol,
    "relay with hysteresis": hysteresis,
    "relay": relay,
}


def scene(record):
    """One record: the scene's name, the times, the state at the end."""
    with mp.workdps(WORKING):
        times, end = SCENES[record["scene"]]()
        return {"scene": record["scene"], "times": [nstr(t, PRINTED) for t in times], "end": nstr(end, PRINTED)}
