"""Intervals of lift-off speeds with one fate, confirmed by one hop of each part in ball arithmetic.

Let every interval [l, r] of a list have a fate, n (convergence to alpha*_n) or "grounded", and suppose that

    1. each speed of it leads into an interval of the same fate, or to the ground if that is its fate, at every mass
       ratio;
    2. it contains no alpha*_m but for l = alpha*_m, m its fate (alpha*_0 = 0).

Then each speed has the fate of its interval. Its orbit does not increase, and is grounded or converges from above to
some alpha*_m (docs/theory.md, Theorem 24). It stays in the intervals of one fate. They are closed and finitely many, so
that alpha*_m is in one of them.

Next to alpha*_n signs of heights cannot decide. On its right f stays above it, by `right_of_star.py`. On its left f
rises, by `left_of_star.py`.
"""

from bisect import bisect_right

from flint import arb, ctx

from ball_hops import Hop, Undecided, parameter, square_bounds
from certificate_file import Refuted, Unconfirmed
from left_of_star import REACH, REACH_LIGHT, rises
from right_of_star import stays_above

# A left end so near alpha*_n is taken as alpha*_n: what is between is shown with it.
AT_STAR = 1e-12
# Most parts of an interval, and hops of a single speed. At M = 3, where slopes reach thousands, an interval needs some
# ten thousand parts.
MOST_PARTS = 100000
MOST_HOPS = 20000
# Parts with fewer speeds than this part of the range of kappa are divided by kappa.
NARROW_PART = 0.01
# Hops of an image that lies between two intervals.
FURTHER_IMAGES = 2
# Bits of the first attempt, and of the last.
BITS, MOST_BITS = 128, 1024

GROUNDED = "grounded"


_stars = {}


def star(n):
    """alpha*_n, the root of tan x = x in (n pi, (n + 1/2) pi), by two signs of sin x - x cos x; 0 for n = 0."""
    key = (n, ctx.prec)
    if key not in _stars:
        _stars[key] = enclosed_star(n) if n else arb(0)
    return _stars[key]


def enclosed_star(n):
    low, high = (n * arb.pi()).upper(), ((n + arb(1) / 2) * arb.pi()).lower()
    # sin x - x cos x has the derivative x sin x of one sign, hence one root, where it changes its sign to that of sin
    # x.
    value = lambda x: (x.sin() - x * x.cos()) * (-1) ** n
    if not (value(low) < 0 and value(high) > 0):
        raise Unconfirmed(f"alpha*_{n} is not enclosed")
    for _ in range(ctx.prec):
        middle = ((low + high) / 2).mid()
        at = value(middle)
        if at > 0:
            high = middle
        elif at < 0:
            low = middle
        else:
            break
    return low.union(high)


def last_star_below(speed):
    """The largest n with alpha*_n <= speed, and whether the next one is above it for certain."""
    n = max(0, int(float(speed) / 3.141592653589793) - 1)
    while star(n + 1) <= speed:
        n += 1
    if not star(n + 1) > speed:
        raise Undecided(f"whether {speed!r} is above alpha*_{n + 1}")
    return n


class Basins:
    """The intervals of one strip of mass ratios."""

    def __init__(self, low, high, intervals):
        if not 0 < low <= high:
            raise Refuted(f"[{low}, {high}] is no interval of mass ratios")
        self.kappas = parameter(low), parameter(high)
        self.light = high <= 1
        self.high = high
        self.intervals = intervals
        last, self.lefts = -1.0, []
        for left, right, fate in intervals:
            if not (last <= left < right):
                raise Refuted(f"the interval [{left!r}, {right!r}] is not above the one before it")
            last = right
            at_star = fate != GROUNDED and 0 <= left - star(fate).lower() <= AT_STAR
            self.lefts.append(star(fate).upper() if at_star else arb(left))

    def holder(self, low, high):
        """The fate of the interval that contains two speeds, from alpha*_n on if it begins there; None if none does."""
        at = bisect_right(self.lefts, low) - 1
        if at >= 0 and high <= self.intervals[at][1]:
            return self.intervals[at][2]
        return None

    def contains_no_other_star(self, left, right, fate):
        """Condition 2. True if the interval begins at its own alpha*_n."""
        n = last_star_below(right)
        if left == 0 and fate == 0 and n == 0:
            return True
        if star(n) < left:
            return fate == n and left - star(n) <= AT_STAR
        if star(n) > left or fate != n:
            raise Refuted(f"alpha*_{n} is in [{left!r}, {right!r}], which is said to have the fate {fate!r}")
        return True

    def confirm(self, at):
        """Condition 1 for one interval. Returns the number of its parts."""
        left, right, fate = self.intervals[at]
        begins_at_star = self.contains_no_other_star(left, right, fate)
        if begins_at_star and not self.stays_right_of(fate, left):
            raise Unconfirmed(f"the speeds from alpha*_{fate} to {left!r}")
        parts, work = 0, [(left, right, self.kappas)]
        while work:
            low, high, kappas = work.pop()
            parts += 1
            if parts > MOST_PARTS:
                raise Unconfirmed(
                    f"the speeds [{low!r}, {high!r}] of the interval [{left!r}, {right!r}], after {MOST_PARTS} parts"
                )
            if low == left and begins_at_star and self.stays_right_of(fate, high):
                continue
            if self.all_have_fate(arb(low), arb(high), kappas, fate, FURTHER_IMAGES):
                continue
            first, last = kappas
            if high - low < NARROW_PART * (last - first):
                middle = first.union(last).mid()
                work += [(low, high, (first, middle)), (low, high, (middle, last))]
                continue
            middle = 0.5 * (low + high)
            if not low < middle < high:
                raise Unconfirmed(f"the speed {low!r} of the interval [{left!r}, {right!r}]")
            work += [(middle, high, kappas), (low, middle, kappas)]
        return parts

    def stays_right_of(self, n, high):
        """f(alpha) > alpha*_n for alpha*_n < alpha <= high."""
        kappa = self.kappas[0].union(self.kappas[1])
        return stays_above(n, star(n), high, kappa * (1 - kappa))

    def square_bounds(self, low, high, kappas):
        """Bounds of F over speeds from `low` to `high`."""
        above = last_star_below(low) + 1
        reach = arb(REACH_LIGHT if self.light else REACH)
        if not (high < star(above) and star(above) - low <= reach and rises(above, star(above), self.light)):
            return square_bounds((low, high), kappas)
        # Left of alpha*_n the landings nearly coincide, and balls lose the signs of the derivatives. There F rises with
        # alpha, and for M <= 1 it falls with kappa.
        if self.light:
            ends = (low, kappas[1]), (high, kappas[0])
            first, last = (Hop(*end, derivatives=False).square for end in ends)
            return first.lower(), last.upper()
        return square_bounds((low, low), kappas)[0], square_bounds((high, high), kappas)[1]

    def all_have_fate(self, low, high, kappas, fate, further):
        """All speeds from `low` to `high` lead into an interval of this fate, or to the ground. False if that is open.

        An image between two intervals is followed for `further` hops.
        """
        try:
            least, most = self.square_bounds(low, high, kappas)
        except Undecided:
            return False
        if most < 0:
            if fate != GROUNDED:
                raise Refuted(f"all speeds of [{float(low)!r}, {float(high)!r}] are grounded, not {fate!r}")
            return True
        if not least > 0:
            return False
        # No hop ends above its speed (Theorem 4).
        first, last = least.sqrt().lower(), min(most.sqrt().upper(), high)
        found = self.holder(first, last)
        if found is not None and found != fate:
            raise Refuted(f"all speeds of [{float(low)!r}, {float(high)!r}] have the fate {found!r}, not {fate!r}")
        if found is None and fate != GROUNDED and last < star(fate):
            raise Refuted(f"all speeds of [{float(low)!r}, {float(high)!r}] fall below alpha*_{fate}")
        if found is None and further > 0:
            return self.all_have_fate(first, last, kappas, fate, further - 1)
        return found is not None


def orbit_fate(alpha, mass_ratio, basins):
    """The fate of one speed, and the number of its hops into an interval of `basins`, or to the ground."""
    bits = BITS
    while True:
        before, ctx.prec = ctx.prec, bits
        try:
            speed, kappa = arb(alpha), parameter(mass_ratio)
            for hops in range(MOST_HOPS):
                fate = basins.holder(speed.lower(), speed.upper())
                if fate is not None:
                    return fate, hops
                square = Hop(speed, kappa, derivatives=False).square
                if square < 0:
                    return GROUNDED, hops + 1
                if not square > 0:
                    raise Undecided("grounded or not")
                speed = square.sqrt()
            raise Unconfirmed(f"the fate of {alpha!r} within {MOST_HOPS} hops")
        except Undecided as error:
            bits *= 2
            if bits > MOST_BITS:
                raise Unconfirmed(f"the fate of {alpha!r} in {MOST_BITS} bits: {error}")
        finally:
            ctx.prec = before
