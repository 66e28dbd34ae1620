"""Phases at a fixed point: phases.jsonl and slow_orbits.jsonl.

The phase P of an offset comes from the expansion of abel.py, at a place so near to the fixed point that its terms
suffice. Exact hops lead there: on the left by the inverse of the map, on the right by the map itself. A second
calculation uses more digits, more terms and a place further in.

`python phases.py FOLDER` chooses the inputs with a fixed seed, and writes files of them into a folder.
"""

import json
import random
import sys

import gmpy2
from gmpy2 import mpfr
from mpmath import cbrt, floor, ln, mp, mpf, nstr

from abel import leading, solution, sum_of_series
from hop import Hop, Stuck, alpha_star

# Digits of the fraction, and of a and c.
FRACTION_DIGITS = 28
COEFFICIENT_DIGITS = 30
# Digits beyond those that are printed, count of terms, and the largest |a| x and x where the expansion is summed.
ATTEMPTS = (
    (20, 40, "0.015", "0.03"),
    (35, 48, "0.012", "0.024"),
    (50, 56, "0.009", "0.018"),
    (65, 64, "0.007", "0.014"),
)


def inwards(side, n, mass_ratio, size):
    """|delta| one hop nearer to the fixed point: the next offset on the right, the one before on the left."""
    star = alpha_star(n)
    if side == "right":
        return Hop(mass_ratio, star + size).next - star
    a, _ = leading(side, n, mass_ratio)
    x = cbrt(size)
    found = (x / (1 + a * x)) ** 3
    for _ in range(60):
        hop = Hop(mass_ratio, star - found, slopes=True)
        # The derivative of |delta'| by |delta| is that of alpha' by alpha.
        step = (size - (star - hop.next)) / hop.slopes[0]
        found += step
        if abs(step) < found * mpf(10) ** -(mp.dps // 2):
            # Newton's method doubles the digits: one more step has them all.
            return found + (size - (star - Hop(mass_ratio, star - found).next)) / hop.slopes[0]
    raise Stuck("the inverse of the map is not found")


def phase_of(side, n, mass_ratio, size, terms, reach, largest):
    """P on the left and -P on the right, at the precision in force."""
    a, c = leading(side, n, mass_ratio)
    limit, hops = min(mpf(reach) / abs(a), mpf(largest)) ** 3, 0
    digits = mp.dps
    while size > limit:
        # A hop's arithmetic loses four times the digits of the offset.
        with mp.workdps(digits + 20 + int(4 * abs(mp.log10(size)))):
            size, hops = inwards(side, n, mass_ratio, size), hops + 1
    x = cbrt(size)
    d = []
    if x > mpf(10) ** -FRACTION_DIGITS / 1000 / (1 + abs(a)) ** 2:
        with mp.workdps(max(60, digits // 2)):
            d = solution(side, n, mass_ratio, terms)[2]
    found = sum_of_series(x, a, c, d) if d else 1 / (a * x) + c * ln(x)
    # Inwards P grows by 1 a hop on the left; on the right -P does.
    return found - hops if side == "left" else -found - hops


def phase(record):
    """A line of phases.jsonl."""
    side, n, mass_ratio = record["side"], record["n"], record["mass_ratio"]
    # Digits of P before the point.
    before = max(0, -(record["exponent"] // 3)) + 6
    last = None
    for guard, terms, reach, largest in ATTEMPTS:
        with mp.workdps(before + FRACTION_DIGITS + guard):
            size = mpf(record["mantissa"]) * mpf(10) ** record["exponent"]
            found = phase_of(side, n, mass_ratio, size, terms, reach, largest)
            whole = floor(found)
            a, c = leading(side, n, mass_ratio)
            made = {name: record[name] for name in ("side", "n", "mass_ratio", "mantissa", "exponent")}
            made["whole"] = str(int(whole))
            made["fraction"] = mp.nstr(found - whole, FRACTION_DIGITS, min_fixed=-50, max_fixed=50, strip_zeros=False)
            # On the right these are those of -P: 3/lambda is the inverse of the first.
            sign = 1 if side == "left" else -1
            made["coefficients"] = {"a": nstr(sign * a, COEFFICIENT_DIGITS), "c": nstr(sign * c, COEFFICIENT_DIGITS)}
        if made == last:
            return made
        last = made
    raise Stuck("the digits do not settle")


class LocalHop:
    """Hops near alpha*_n by the first flight's own time, with a relative precision that small offsets do not spoil.

    Newton's method starts from a polynomial through the last hops. The cancellations are of the order t^4, in the small
    part t of the time; the precision covers them. gmpy2 alone is ten times as fast as mpmath.
    """

    # Differences that the start of Newton's method uses.
    ORDERS = 7

    def __init__(self, side, n, mass_ratio):
        self.sign = -1 if side == "left" else 1
        digits = mp.dps + 10
        self.close = mpfr(10) ** -(mp.dps // 2)
        m = mpfr(mass_ratio)
        self.kappa, self.mu = m / (1 + m), m / (1 + m) ** 2
        with mp.workdps(digits):
            self.star = mpfr(nstr(alpha_star(n), digits))
        square = 1 + self.star**2
        self.c2, self.s2 = (1 - self.star**2) / square, 2 * self.star / square
        self.beta = gmpy2.cbrt(12 * self.star**2 / square)
        self.first, self.second = [], []

    def remember(self, ladder, root):
        """The differences of the last roots: their sum is the polynomial through them, one place further."""
        for k in range(len(ladder)):
            ladder[k], root = root, root - ladder[k]
        if len(ladder) < self.ORDERS:
            ladder.append(root)

    def newton(self, function, ladder, otherwise):
        """The root of a function that gives its value and its slope."""
        t = sum(ladder[1:], ladder[0]) if ladder else otherwise
        for _ in range(100):
            value, slope = function(t)
            step = value / slope
            t -= step
            # The next step would be of the order of the square of this one.
            if abs(step) < abs(t) * self.close:
                self.remember(ladder, t)
                return t
        raise Stuck("a flight is not found")

    def next(self, size):
        """|delta'|."""
        star, delta = self.star, self.sign * size

        def landing(t):
            # N(t) - delta Q(t)
            s, c = gmpy2.sin_cos(t)
            at_s, at_c = self.s2 * c + self.c2 * s, self.c2 * c - self.s2 * s
            value = star * (t - s) + (t * t / 2 - 1 + c) - delta * (2 * star + t - at_s)
            return value, star * (1 - c) + t - s - delta * (1 - at_c)

        t = self.newton(landing, self.first, self.sign * self.beta * gmpy2.cbrt(size))
        alpha = star + delta
        s, c = gmpy2.sin_cos(t)
        at_s, at_c = self.s2 * c + self.c2 * s, self.c2 * c - self.s2 * s
        closing = alpha * (1 - at_c) - (2 * star + t) + at_s
        total = closing * closing
        if self.sign < 0:
            # The sudden lift-off: the second flight.
            y, v = at_c + alpha * at_s, alpha - (2 * star + t) - self.kappa * closing

            def second_landing(w):
                s, c = gmpy2.sin_cos(w)
                return y * (1 - c) - w * w / 2 + v * (w - s), v * (1 - c) - w + y * s

            w = self.newton(second_landing, self.second, -3 * t)
            s, c = gmpy2.sin_cos(w)
            if y * c + v * s > 1:
                raise Stuck("a second sudden lift-off")
            total += (v * (1 - c) - w + y * s) ** 2
        loss = self.mu * total / (alpha + gmpy2.sqrt(alpha * alpha - self.mu * total))
        return size - self.sign * loss


def slow_orbit(record):
    """A line of slow_orbits.jsonl: the hops are done one by one."""
    last = None
    # The cancellations cost four times the digits of t, which has a third of those of the offset.
    lost = int(4 * abs(record["exponent"]) / 3) + 10
    for digits in (50, 60, 75, 90):
        with mp.workdps(digits + lost), gmpy2.context(gmpy2.context(), precision=mp.prec):
            hop = LocalHop(record["side"], record["n"], record["mass_ratio"])
            size = mpfr(record["mantissa"]) * mpfr(f"1e{record['exponent']}")
            for _ in range(record["hops"]):
                size = hop.next(size)
            made = {name: record[name] for name in ("side", "n", "mass_ratio", "mantissa", "exponent", "hops")}
            made["offset_after"] = f"{hop.sign * size:.29e}"
        if made == last:
            return made
        last = made
    raise Stuck("the digits do not settle")


# The choice of inputs.

SIZES = (None, -6, -9, -12, -15, -30, -100, -300, -1000)
MASS_RATIOS = (0.02, 0.12, 0.2, 0.5, 0.8, 1.0, 3.0, 50.0)
FIXED_POINTS = (1, 2, 3, 5, 10)
ALL_SIZES = ((2, 0.2), (10, 1.0), (2, 0.12))


def largest(side, n, mass_ratio):
    """The largest |delta| of the grid: inside the monotone part on the left, and of the trap on the right."""
    strength = abs(leading(side, n, mass_ratio)[0]) * (3 if side == "right" else mpf(3) / 10)
    return 1e-3 / float(1 + strength**3) if side == "left" else min(0.05, 1e-3 / float(strength**3))


def choose_phases():
    pick, turn = random.Random("phases"), 0
    for side in ("left", "right"):
        for n in FIXED_POINTS:
            for mass_ratio in MASS_RATIOS:
                top = largest(side, n, mass_ratio)
                allowed = [size for size in SIZES if size is None or 10.0**size * 10 <= top]
                every = (n, mass_ratio) in ALL_SIZES
                for k in range(len(allowed) if every else 3):
                    # The sizes take turns: in three records each third of the range is met.
                    size = allowed[k if every else (turn % 3 + 3 * k) % len(allowed)]
                    if size is None:
                        mantissa, exponent = (f"{top * pick.uniform(0.3, 1):.16e}").split("e")
                    else:
                        mantissa, exponent = pick.uniform(1, 10), size
                    record = {"side": side, "n": n, "mass_ratio": mass_ratio}
                    yield dict(record, mantissa=float(mantissa), exponent=int(exponent))
                turn += 1


def choose_slow_orbits():
    pick = random.Random("slow orbits")
    for side in ("left", "right"):
        for n, mass_ratio, counts in (
            (2, 0.2, (10, 1000, 100000, 1000000)),
            (1, 0.02, (10, 1000, 100000)),
            (2, 0.12, (10, 1000)),
            (3, 50.0, (10, 1000)),
            (10, 1.0, (10, 1000, 100000)),
            (1, 0.8, (10, 1000)),
        ):
            a = abs(leading(side, n, mass_ratio)[0])
            for hops in counts:
                if side == "left":
                    # Places of about twice as many hops as are done.
                    size = float(1 / (a * hops * pick.uniform(1.5, 3))) ** 3
                    size = min(size, largest(side, n, mass_ratio) / 10)
                    if hops == 10:
                        size *= pick.uniform(0.01, 0.1)
                else:
                    size = largest(side, n, mass_ratio) * pick.uniform(0.01, 1)
                mantissa, exponent = f"{size:.16e}".split("e")
                record = {"side": side, "n": n, "mass_ratio": mass_ratio}
                yield dict(record, mantissa=float(mantissa), exponent=int(exponent), hops=hops)


if __name__ == "__main__":
    for name, choose in (("phases", choose_phases), ("slow_orbits", choose_slow_orbits)):
        with open(f"{sys.argv[1]}/{name}.jsonl", "w", encoding="utf-8") as file:
            file.writelines(json.dumps(record) + "\n" for record in choose())
