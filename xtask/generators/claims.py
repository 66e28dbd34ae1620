"""The kinds of lines of a certificate: how many claims a line has, and how each is confirmed."""

import math

from flint import arb

from ball_basins import Basins, Refuted, Unconfirmed, GROUNDED, orbit_fate, star
from ball_hops import Hop, Undecided, parameter, square_bounds
from gap_lengths import confirm_gap

# Most halvings of a part of a hump, and of a box.
MOST_PARTS = 20000


def pair(values):
    """Two numbers in order, as exact f64."""
    low, high = map(float, values)
    if not -math.inf < low <= high < math.inf:
        raise Refuted(f"[{low!r}, {high!r}] is no interval")
    return low, high


def fate_of(value):
    """n or "grounded"."""
    if value == GROUNDED or (isinstance(value, int) and value >= 0):
        return value
    raise Refuted(f"{value!r} is no fate")


def intervals(line, key):
    return [(float(left), float(right), fate_of(fate)) for left, right, fate in line[key]]


def gaps_of(line):
    """(left, right, {fate: least length}) of each gap."""
    gaps, last = [], 0.0
    for left, right, *bounds in line["gaps"]:
        left, right = float(left), float(right)
        if not last <= left < right:
            raise Refuted(f"the gap [{left!r}, {right!r}] is not above the one before it")
        if any(not 0 <= least <= right - left for _, least in bounds) or len({fate for fate, _ in bounds}) < len(
            bounds
        ):
            raise Refuted(f"the gap [{left!r}, {right!r}] has wrong lengths")
        gaps.append((left, right, {fate_of(fate): arb(least) for fate, least in bounds}))
        last = right
    return gaps


# A fixed point is enclosed so narrowly.
FIXED_POINT_WIDTH = 1e-13


def encloses(values, ball, what):
    low, high = pair(values)
    if not (low < ball and ball < high):
        raise Refuted(f"{what} is not in [{low!r}, {high!r}]")
    if high - low > FIXED_POINT_WIDTH * high:
        raise Refuted(f"{what} is not enclosed to {FIXED_POINT_WIDTH}")


class Kind:
    """A kind with one claim a line."""

    @staticmethod
    def count(line):
        return 1

    @classmethod
    def confirm(cls, line, wanted, shared):
        if wanted:
            cls.check(line)


class Given(Kind):
    """A line that `whole_theorems.py` checks as a whole."""

    @staticmethod
    def count(line):
        return 0

    @staticmethod
    def check(line):
        pass


class OneSudden(Kind):
    @staticmethod
    def check(line):
        a = star(1)
        encloses(line["fixed_point"], a, "alpha*_1")
        if not arb(line["largest_mass_ratio"]) <= -(2 * a).cos():
            raise Refuted("the largest mass ratio is too large")
        # V + Y/a of a flight that lasts a: from G(a) = 0, with tan a = a.
        needed = a * a / 2 / (a - a.sin())
        if not (1 / a <= line["available"] < line["needed"] <= needed):
            raise Refuted("the two sides of the inequality are not as said")


class Trap(Kind):
    @staticmethod
    def check(line):
        n, mass_ratio, right = line["n"], float(line["mass_ratio"]), float(line["right"])
        encloses(line["fixed_point"], star(n), f"alpha*_{n}")
        if not float(line["fixed_point"][1]) < right:
            raise Refuted("the trap ends before its fixed point")
        if not arb(right) < (n + 1) * arb.pi():
            raise Refuted("the trap is longer than the contact part")
        if line["beyond"] is not None and not (right < line["beyond"] and arb(line["beyond"]) < (n + 1) * arb.pi()):
            raise Refuted("the speed beyond the trap is not between its end and that of the contact part")
        Basins(mass_ratio, mass_ratio, [(float(line["fixed_point"][1]), right, n)]).confirm(0)
        if line["beyond"] is not None and not square_at(line["beyond"], mass_ratio) < star(n) ** 2:
            raise Refuted(f"the speed {line['beyond']!r} beyond the trap does not fall below alpha*_{n}")


class Crisis(Kind):
    @staticmethod
    def check(line):
        n, (low, high) = line["n"], pair(line["mass_ratio"])
        contact_end = (n + 1) * arb.pi()
        end = float(contact_end.lower())
        while not arb(end) < contact_end:
            end = math.nextafter(end, 0)
        # Up to the last f64 of the contact part, and from there to its end.
        Basins(low, low, [(math.nextafter(float(star(n)), math.inf), end, n)]).confirm(0)
        last = Hop(arb(end).union(contact_end), parameter(low), derivatives=False).square
        if not last > star(n) ** 2:
            raise Unconfirmed(f"f > alpha*_{n} at {n + 1} pi")
        # Below alpha*_n and beyond the contact part a fall through alpha*_n is no sign of a crisis.
        if not star(n) < arb(line["speed"]) < contact_end:
            raise Refuted(f"the speed {line['speed']!r} is not on the contact part of hump {n}")
        if not square_at(line["speed"], high) < star(n) ** 2:
            raise Refuted(f"the speed {line['speed']!r} does not fall below alpha*_{n} at M = {high!r}")


def square_at(speed, mass_ratio):
    return Hop(arb(speed), parameter(mass_ratio), derivatives=False).square


class ContactPart(Kind):
    @staticmethod
    def check(line):
        kappa = parameter(line["mass_ratio"])
        wanted, work = arb(line["least_square"]), [tuple(map(arb, pair(line["speeds"])))]
        for _ in range(MOST_PARTS):
            if not work:
                return
            low, high = work.pop()
            try:
                bounds = square_bounds((low, high), (kappa, kappa))
                if bounds[0] >= wanted:
                    continue
                if bounds[1] < wanted:
                    raise Refuted(f"f^2 is below {line['least_square']!r} at {float(low)!r}")
            except Undecided:
                pass
            middle = ((low + high) / 2).mid()
            work += [(low, middle), (middle, high)]
        raise Unconfirmed(f"f^2 >= {line['least_square']!r}")


class Losses(Kind):
    @staticmethod
    def check(line):
        """Lemma 32: a flight from (Y, V) with R = |(Y, V)| and B^2 = V^2 + 2 (Y + R) has a closing speed of at most R +
        B."""
        alpha = line["multiple_of_pi"] * arb.pi()
        kappa = parameter(line["mass_ratio"])
        y, v, total = arb(1), alpha, arb(0)
        for _ in range(2):
            r = (y * y + v * v).sqrt()
            b = (v * v + 2 * (y + r)).sqrt()
            total += (r + b) ** 2
            y, v = r, max(r.upper(), b.upper())
        left = kappa * (1 - kappa) * total + star(1) ** 2
        if not (left <= line["losses"] <= line["square"] <= alpha**2):
            raise Refuted("the two sides of the inequality are not as said")


class RisingBox(Kind):
    @staticmethod
    def check(line):
        work = [(*pair(line["speeds"]), *pair(line["kappas"]))]
        for _ in range(MOST_PARTS):
            if not work:
                return
            low, high, first, last = work.pop()
            alpha, kappa = arb(low).union(arb(high)), arb(first).union(arb(last))
            try:
                by_alpha = Hop(alpha, kappa, in_window=True).by_alpha
                if by_alpha is not None and by_alpha > 0:
                    continue
            except Undecided:
                pass
            if high - low >= last - first:
                middle = 0.5 * (low + high)
                parts = (low, middle, first, last), (middle, high, first, last)
            else:
                middle = 0.5 * (first + last)
                parts = (low, high, first, middle), (low, high, middle, last)
            if middle in (low, high, first, last):
                break
            work += parts
        raise Unconfirmed("f rises on the box")


class BasinLines(Kind):
    """One claim for each interval."""

    @staticmethod
    def count(line):
        return len(line["intervals"])

    @staticmethod
    def confirm(line, wanted, shared):
        shared["basins"] = line
        if wanted:
            basins = Basins(*pair(line["mass_ratios"]), intervals(line, "intervals"))
            for at in wanted:
                basins.confirm(at)


class GapLines(Kind):
    """One claim for each gap between the intervals of the line before."""

    @staticmethod
    def count(line):
        return len(line["gaps"])

    @staticmethod
    def confirm(line, wanted, shared):
        if wanted:
            basins = Basins(*pair(shared["basins"]["mass_ratios"]), intervals(shared["basins"], "intervals"))
            gaps = gaps_of(line)
            for at in wanted:
                confirm_gap(basins, gaps[at])


class Speeds(Given):
    @staticmethod
    def confirm(line, wanted, shared):
        shared["speeds"] = line["speeds"]


class Points(Kind):
    """One claim for each speed; the traps of the column are confirmed with the first one."""

    @staticmethod
    def count(line):
        return sum(count for _, count in line["fates"])

    @staticmethod
    def confirm(line, wanted, shared):
        if not wanted:
            return
        mass_ratio = float(line["mass_ratio"])
        traps = Basins(mass_ratio, mass_ratio, intervals(line, "traps"))
        for at in range(len(traps.intervals)):
            traps.confirm(at)
        fates = [fate_of(fate) for fate, count in line["fates"] for _ in range(count)]
        for at in wanted:
            speed = shared["speeds"][at]
            found, _ = orbit_fate(speed, mass_ratio, traps)
            if found != fates[at]:
                raise Refuted(f"the speed {speed!r} has the fate {found!r}, not {fates[at]!r}")


KINDS = {
    "one-sudden": OneSudden,
    "trap": Trap,
    "crisis": Crisis,
    "contact-part": ContactPart,
    "losses": Losses,
    "rising-window": Given,
    "rising-box": RisingBox,
    "basins": BasinLines,
    "gaps": GapLines,
    "fraction": Given,
    "grid": Given,
    "speeds": Speeds,
    "points": Points,
    "area": Given,
    "cells": Given,
}


# The shapes of fields: the types of JSON numbers, and of the parts of arrays. The last shape of an array may stand any
# number of times.
def is_natural(value):
    return type(value) is int and 0 <= value < 10**10


def is_number(value):
    return type(value) is float


def is_fate(value):
    return is_natural(value) or type(value) is str and value == GROUNDED


def is_pair(value):
    return type(value) is list and len(value) == 2 and all(map(is_number, value))


def some(*shapes):
    """Arrays of arrays, whose parts have these shapes in turn."""
    return lambda value: type(value) is list and all(
        type(part) is list and len(part) == len(shapes) and all(has(own) for has, own in zip(shapes, part))
        for part in value
    )


def is_gaps(value):
    return type(value) is list and all(
        type(gap) is list and len(gap) >= 2 and is_pair(gap[:2]) and some(is_fate, is_number)(gap[2:]) for gap in value
    )


def is_numbers(value):
    return type(value) is list and all(map(is_number, value))


def is_number_or_null(value):
    return value is None or is_number(value)


def is_text(value):
    return type(value) is str


SHAPES = {
    is_natural: "a natural number",
    is_number: "a number with a decimal point",
    is_pair: "two numbers with decimal points",
}

# The fields of each kind of line: no more and no less. None is the header.
FIELDS = {
    None: {"format": is_text, "version": is_natural, "theorem": is_text, "statement": is_text, "lines": is_natural},
    "one-sudden": {
        "fixed_point": is_pair,
        "largest_mass_ratio": is_number,
        "available": is_number,
        "needed": is_number,
    },
    "trap": {
        "n": is_natural,
        "fixed_point": is_pair,
        "mass_ratio": is_number,
        "right": is_number,
        "beyond": is_number_or_null,
    },
    "crisis": {"n": is_natural, "mass_ratio": is_pair, "speed": is_number},
    "contact-part": {"n": is_natural, "mass_ratio": is_number, "speeds": is_pair, "least_square": is_number},
    "losses": {"multiple_of_pi": is_natural, "mass_ratio": is_number, "losses": is_number, "square": is_number},
    "rising-window": {"n": is_natural, "speeds": is_pair, "largest_mass_ratio": is_number},
    "rising-box": {"n": is_natural, "speeds": is_pair, "kappas": is_pair},
    "basins": {"mass_ratios": is_pair, "intervals": some(is_number, is_number, is_fate)},
    "gaps": {"gaps": is_gaps},
    "fraction": {"fate": is_fate, "humps": is_natural, "uniform": is_pair, "by_humps": is_pair},
    "grid": {"mass_ratios": is_pair, "speeds": is_pair, "columns": is_natural, "rows": is_natural},
    "speeds": {"speeds": is_numbers},
    "points": {
        "mass_ratio": is_number,
        "traps": some(is_number, is_number, is_fate),
        "fates": some(is_fate, is_natural),
    },
    "area": {"fate": is_fate, "share": is_pair},
    "cells": {"edges": is_numbers, "of_one_basin": is_natural},
}


def wrong_field(kind, line):
    """What is wrong with the fields of a line of a kind, or None. An unknown kind is found later."""
    fields = FIELDS.get(kind)
    if fields is None:
        return None
    own = set(line) - {"kind"}
    if own != set(fields):
        return f"its fields are {sorted(own)}, not {sorted(fields)}"
    for name, has in fields.items():
        if not has(line[name]):
            return f"{name} is null" if line[name] is None else f"{name} is not {SHAPES.get(has, 'of its shape')}"
    return None
