"""The numbers of a certificate once more, by other formulas, without enclosures: half the time of flight, bisection,
sums of losses, 200 bits.

The checker uses the equations of motion and balls. Here a landing is the root of V_Y(h) = V on one branch
(docs/theory.md, Lemmas 5 and 15), and the next lift-off speed follows from the sum of the losses (Theorem 4). `refutes`
tries points of what a line says, and adds its sums again. It proves nothing; a fault that the checker has in its
formulas, signs or rules is seen here.
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
    """n, or grounded; None if it is open. An orbit that stays above alpha*_n as long as it is followed converges to
    it."""
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


# An orbit that loses so little in a hop, and is so near above alpha*_n, is on its right. (On its left it is near the
# next one below.)
SLOW, NEAR = 1e-4, 0.05


def between(low, high, count):
    return [point(arb(low) + (arb(high) - arb(low)) * k / (count - 1)) for k in range(count)]


def trap(line):
    kappa, goal = parameter(line["mass_ratio"]), star(line["n"]) ** 2
    inside = between(line["fixed_point"][1], line["right"], POINTS)
    falls = [float(speed) for speed in inside[1:] if square(speed, kappa) < goal]
    beyond = line["beyond"] is not None and not square(line["beyond"], kappa) < goal
    return (
        f"f falls below alpha* at {falls[0]!r}" if falls else "beyond the trap f stays above alpha*" if beyond else None
    )


def crisis(line):
    n, (low, high) = line["n"], line["mass_ratio"]
    goal, end = star(n) ** 2, (n + 1) * pi()
    least = min(
        square(speed, parameter(low))
        for speed in between(line["speed"] - 0.01, line["speed"] + 0.01, POINTS)
        if star(n) < speed < end
    )
    if least < goal:
        return f"at M = {low!r} f falls below alpha*_{n} already"
    return (
        None if square(line["speed"], parameter(high)) < goal else f"at M = {high!r} f does not fall below alpha*_{n}"
    )


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


def one_sudden(line):
    """M_1 of Theorem 20."""
    largest = (star(1) ** 2 - 1) / (star(1) ** 2 + 1)
    return None if arb(line["largest_mass_ratio"]) <= largest else f"the largest mass ratio is {float(largest)!r}"


def losses(line):
    """Lemma 32 by its own bound of each of two closing speeds, R + B."""
    kappa, speed = parameter(line["mass_ratio"]), line["multiple_of_pi"] * pi()
    y, v, total = arb(1), speed, arb(0)
    for _ in range(2):
        r = point((y * y + v * v).sqrt())
        b = point((v * v + 2 * (y + r)).sqrt())
        total, y, v = point(total + (r + b) ** 2), r, max(r, b)
    left = point(kappa * (1 - kappa) * total + star(1) ** 2)
    holds = left <= line["losses"] <= line["square"] <= speed * speed
    return None if holds else f"{float(left)!r} and {float(speed * speed)!r} are the two sides"


def points(lines, at, places):
    """The fates of some rows: the end of each run beside the change, and its middle."""
    line, speeds, first = lines[at], lines[2]["speeds"], 0
    for k, (said, count) in enumerate(line["fates"]):
        rows = {first, first + count // 2, first + count - 1} if k in places else ()
        for row in (row for row in rows if row < len(speeds)):
            found = fate(speeds[row], line["mass_ratio"])
            if found is not None and found != said:
                return f"row {row} has the fate {found!r}"
        first += count
    return None


def gaps(lines, at, places):
    """The length of each fate in a gap, by points: a claim is too large if it is longer than the points allow."""
    mass_ratio = lines[1]["mass_ratios"][0]
    for k in places:
        left, right, *lengths = lines[at]["gaps"][k]
        # From end to end, so that each stands for its part of the gap.
        found = [fate(left + (right - left) * (j + 0.5) / GAP_POINTS, mass_ratio) for j in range(GAP_POINTS)]
        for own, least in lengths:
            share = sum(other in (own, None) for other in found) / GAP_POINTS
            if least > (share + GAP_ROOM) * (right - left):
                return f"{own!r} has a part of about {share:.2f} of the gap from {left!r}"
    return None


# Points of a gap, and the part of it by which they may mislead: three standard deviations of a random count.
GAP_POINTS, GAP_ROOM = 64, 0.19


def known_lengths(lines, left, right):
    """The length of each fate between two speeds, as intervals and gaps say."""
    lengths = {}
    add = lambda own, length: lengths.__setitem__(own, lengths.get(own, arb(0)) + length)
    for line in lines:
        for low, high, own in line.get("intervals", []):
            add(own, max(point(0), min(arb(high), right) - max(arb(low), left)))
        for low, high, *parts in line.get("gaps", []):
            if low >= left and high <= right:
                for own, least in parts:
                    add(own, arb(least))
    return lengths


def fraction(lines, at):
    """What is known of a fate is not more than the upper bound, and with what is open not less than the lower one."""
    line = lines[at]
    means = {
        "uniform": [(star(1), star(line["humps"] + 1))],
        "by_humps": [(star(n), star(n + 1)) for n in range(1, line["humps"] + 1)],
    }
    for name, windows in means.items():
        known = sum(
            known_lengths(lines, *ends).get(line["fate"], arb(0)) / (ends[1] - ends[0]) for ends in windows
        ) / len(windows)
        low, high = line[name]
        if low > known + SUM_ROOM or high < known - SUM_ROOM:
            return f"{name}: {float(known)!r} is known"
    return None


def area(lines, at):
    line, (first, last), (bottom, top) = lines[at], lines[1]["mass_ratios"], lines[1]["speeds"]
    known = arb(0)
    for strip in (own for own in lines if own.get("kind") == "basins"):
        low, high = strip["mass_ratios"]
        known += known_lengths([strip], arb(bottom), arb(top)).get(line["fate"], arb(0)) * (arb(high) - arb(low))
    known /= (arb(last) - arb(first)) * (arb(top) - arb(bottom))
    low, high = line["share"]
    return f"{float(known)!r} is known" if low > known + SUM_ROOM or high < known - SUM_ROOM else None


# Bounds of sums are rounded outwards, and may be so much beside the sum.
SUM_ROOM = 1e-13


def refutes(lines, at, places):
    """Why a line is false, as far as points and sums show it; None if none of them does. `places` are those of its
    parts that are tried."""
    line = lines[at]
    before, ctx.prec = ctx.prec, BITS
    try:
        alone = {
            "trap": trap,
            "crisis": crisis,
            "contact-part": contact_part,
            "rising-box": rising_box,
            "one-sudden": one_sudden,
            "losses": losses,
        }
        sums = {"fraction": fraction, "area": area}
        parts = {"points": points, "gaps": gaps}
        if line["kind"] in alone:
            return alone[line["kind"]](line)
        if line["kind"] in sums:
            return sums[line["kind"]](lines, at)
        if line["kind"] in parts:
            return parts[line["kind"]](lines, at, places)
        if line["kind"] == "basins":
            tried = (basins(line, place) for place in places)
            return next((reason for reason in tried if reason), None)
        # The grid, speeds, windows of rising boxes and the number of cells are claims of the whole file: `stronger`
        # compares them.
        return None
    finally:
        ctx.prec = before
