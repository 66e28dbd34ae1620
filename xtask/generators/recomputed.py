"""The numbers of a certificate once more, by other formulas, without enclosures: half the time of flight, bisection, sums of losses, 200 bits.

The checker uses the equations of motion and balls. Here a landing is the root of V_Y(h) = V on one branch (docs/theory.md, Lemmas 5 and 15), and
the next lift-off speed follows from the sum of the losses (Theorem 4). `refutes` tries points of what a line says. It proves nothing; a fault
that the checker has in its formulas, signs or rules is seen here.
"""

from functools import lru_cache

from flint import arb, ctx

# Far beyond the digits that any number of a certificate decides by.
BITS = 200
# Bisections before secant steps, and secant steps.
HALVINGS, SECANTS = 60, 8
# Flights of a hop, and hops of an orbit, after which the answer is left open.
MOST_FLIGHTS, MOST_HOPS = 300, 400
# Points of an interval, and of each side of a box.
POINTS, SIDE = 9, 4
GROUNDED = "grounded"


def point(number):
    return arb(number).mid()


def pi():
    return arb.pi().mid()


def root(rising, low, high):
    """Where a function that rises through 0 does so."""
    low, high = point(low), point(high)
    a, b = low, high
    for _ in range(HALVINGS):
        middle = point((a + b) / 2)
        a, b = (a, middle) if rising(middle) > 0 else (middle, b)
    at_a, at_b = rising(a), rising(b)
    for _ in range(SECANTS):
        if at_a == at_b or abs(b - a) < abs(b) * arb(2) ** (20 - BITS):
            break
        c = point(b - at_b * (b - a) / (at_b - at_a))
        if not low <= c <= high:
            break
        a, at_a, b, at_b = b, at_b, c, rising(c)
    return b


@lru_cache(None)
def star(n):
    if n == 0:
        return arb(0)
    return root(lambda x: point((x.sin() - x * x.cos()) * (-1) ** n), n * pi(), (n + arb(1) / 2) * pi())


def parts(h):
    """sin h, D = h - sin h cos h and u = h cos h - sin h."""
    s, c = h.sin_cos()
    return point(s), point(h - s * c), point(h * c - s)


def start_speed(h, x):
    """V_Y(h): the speed at a stretch 1 + x whose flight lasts 2h."""
    s, d, u = parts(h)
    return point(h + s * (u - x * s) / d)


def parameter(mass_ratio):
    return point(arb(mass_ratio) / (1 + arb(mass_ratio)))


def branch(v, x):
    """The ends of the branch on which the flight from (1 + x, v) lands; a first flight has x = 0."""
    k = max(0, int(float(v) / 3.141592653589793))
    while k > 0 and k * pi() > v:
        k -= 1
    while (k + 1) * pi() <= v:
        k += 1
    if x == 0:
        return (k * pi() if k else v), (k + 1) * pi()
    if k and (-1) ** k * point(v * v.cos() - (1 + x) * v.sin()) >= 0:
        return k * pi(), v
    least = star(k) if k else arb(2) ** -HALVINGS * min(x, arb(1))
    return max(v, least), (k + 1) * pi()


def square(speed, kappa):
    """F; None after too many flights."""
    x, v, lost = arb(0), point(speed), arb(0)
    for _ in range(MOST_FLIGHTS):
        h = root(lambda h: point(start_speed(h, x) - v), *branch(v, x))
        s, d, u = parts(h)
        closing = point(2 * u * (u - x * s) / d)
        lost = point(lost + closing * closing)
        x, v = point(x + 2 * h * (v - h)), point(v - 2 * h + kappa * closing)
        if x <= 0:
            return point(arb(speed) ** 2 - kappa * (1 - kappa) * lost)
    return None


def fate(speed, mass_ratio):
    """n, or grounded; None if it is open. An orbit that stays above alpha*_n as long as it is followed converges to it."""
    kappa, speed = parameter(mass_ratio), point(speed)
    for _ in range(MOST_HOPS):
        if speed <= 1:
            return 0  # f falls no faster than half below 1
        found = square(speed, kappa)
        if found is None:
            return None
        if found <= 0:
            return GROUNDED
        following = point(found.sqrt())
        if speed - following <= SLOW * speed:
            n = 0
            while star(n + 1) <= following:
                n += 1
            return n if following - star(n) <= NEAR else None
        speed = following
    return None


# An orbit that loses so little in a hop, and is so near above alpha*_n, is on its right. (On its left it is near the next one below.)
SLOW, NEAR = 1e-4, 0.05


def between(low, high, count):
    return [point(arb(low) + (arb(high) - arb(low)) * k / (count - 1)) for k in range(count)]


def trap(line):
    kappa, goal = parameter(line["mass_ratio"]), star(line["n"]) ** 2
    inside = between(line["fixed_point"][1], line["right"], POINTS)
    falls = [float(speed) for speed in inside[1:] if square(speed, kappa) < goal]
    beyond = line["beyond"] is not None and not square(line["beyond"], kappa) < goal
    return f"f falls below alpha* at {falls[0]!r}" if falls else "beyond the trap f stays above alpha*" if beyond else None


def crisis(line):
    n, (low, high) = line["n"], line["mass_ratio"]
    goal, end = star(n) ** 2, (n + 1) * pi()
    least = min(square(speed, parameter(low)) for speed in between(line["speed"] - 0.01, line["speed"] + 0.01, POINTS) if star(n) < speed < end)
    if least < goal:
        return f"at M = {low!r} f falls below alpha*_{n} already"
    return None if square(line["speed"], parameter(high)) < goal else f"at M = {high!r} f does not fall below alpha*_{n}"


def contact_part(line):
    kappa = parameter(line["mass_ratio"])
    least = min(square(speed, kappa) for speed in between(*line["speeds"], 2 * POINTS))
    return None if least >= line["least_square"] else f"f^2 is {float(least)!r} at a speed of the part"


def rising_box(line):
    step = arb(2) ** -HALVINGS
    for kappa in between(*line["kappas"], SIDE):
        for speed in between(*line["speeds"], SIDE):
            if not square(speed + 2 * step, kappa) > square(speed + step, kappa):
                return f"f falls at {float(speed)!r}, kappa = {float(kappa)!r}"
    return None


def basins(line, at):
    left, right, goal = line["intervals"][at]
    low, high = line["mass_ratios"]
    for mass_ratio in {low, high, (low + high) / 2}:
        for speed in between(left, right, POINTS):
            found = fate(speed, mass_ratio) if speed > 0 else 0
            if found is not None and found != goal:
                return f"the speed {float(speed)!r} has the fate {found!r} at M = {mass_ratio!r}"
    return None


def refutes(line, places):
    """Why a line is false, as far as points show it; None if none of them does. `places` are those of its intervals that are tried."""
    before, ctx.prec = ctx.prec, BITS
    try:
        rules = {"trap": trap, "crisis": crisis, "contact-part": contact_part, "rising-box": rising_box}
        if line["kind"] in rules:
            return rules[line["kind"]](line)
        if line["kind"] == "basins":
            tried = (basins(line, at) for at in places)
            return next((reason for reason in tried if reason), None)
        return None
    finally:
        ctx.prec = before
