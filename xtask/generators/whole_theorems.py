"""What joins the lines of a certificate: no line may be missing, strips and boxes leave no gap, and sums are as said.

Each theorem has a class: the kinds of lines that it may have, `add` for each line, `end` after the last, and what its
claims together prove: `derived`, numbers that `statements.py` compares and prints, and `means`, the words for them.
"""

import math
from bisect import bisect_right
from fractions import Fraction

from flint import arb

from ball_basins import GROUNDED, Basins, Refuted, Unconfirmed, star
from ball_hops import parameter
from claims import fate_of, gaps_of, intervals, pair
from left_of_star import REACH_LIGHT, rises

# Traps end so near a speed that falls below alpha*_n, and crises are enclosed so narrowly.
TRAP_WIDTH, CRISIS_WIDTH = 1e-12, 1e-13
# The theorem `rising` is for windows 1 to 10, and for M <= 0.9 in all of them.
RISING_WINDOWS, RISING_MASS_RATIO = 10, 0.9
# The edge of a pixel may be rounded so much, in units of the last place. The middle of one is one double.
EDGE_ULPS = 4


def require(holds, reason):
    if not holds:
        raise Refuted(reason)


class Whole:
    KINDS = ()

    def __init__(self):
        self.lines = 0

    def add(self, line):
        self.lines += 1
        getattr(self, "add_" + line["kind"].replace("-", "_"))(line)

    def end(self):
        require(self.lines > 0, "no lines")

    means = ""

    def derived(self):
        """What the lines prove."""
        raise NotImplementedError


class OneSudden(Whole):
    KINDS = ("one-sudden",)

    def add_one_sudden(self, line):
        require(self.lines == 1, "a second line")
        self.largest = line["largest_mass_ratio"]

    means = "at most one sudden lift-off up to this mass ratio (with Theorem 20)"

    def derived(self):
        return {"largest_mass_ratio": self.largest}


class Humps(Whole):
    """One line for each n from 1."""

    def next(self, line):
        require(line["n"] == self.lines, f"n = {line['n']!r} after {self.lines - 1} lines")


class OneSided(Humps):
    KINDS = ("trap",)

    def __init__(self):
        super().__init__()
        self.lengths = []

    def add_trap(self, line):
        self.next(line)
        require(line["mass_ratio"] == 1, "not at M = 1, where traps are shortest")
        require(line["beyond"] is None, "a speed beyond a trap is no part of this theorem")
        self.lengths.append(line["right"] - pair(line["fixed_point"])[1])

    means = "traps of these lengths at least, at all M, for n from 1 (with Corollary 30)"

    def derived(self):
        return {"lengths": self.lengths}


class Crises(Humps):
    KINDS = ("crisis",)
    width = 0.0

    def __init__(self):
        super().__init__()
        self.crises = []

    def add_crisis(self, line):
        self.next(line)
        low, high = pair(line["mass_ratio"])
        self.crises.append((low, high))
        require(0 < low and high < 1 and high - low <= CRISIS_WIDTH, "the mass ratio is not enclosed to 1e-13")
        self.width = max(self.width, high - low)

    means = "M_c(n) for n = 1 to the number of humps, each enclosed to this width"

    def derived(self):
        return {"humps": self.lines, "width": self.width, "crises": self.crises}


class Traps(Whole):
    KINDS = ("trap",)

    def __init__(self):
        super().__init__()
        self.counts, self.lowest, self.highest = [], [], []
        self.step = self.width = 0.0

    def add_trap(self, line):
        n = line["n"]
        if n == len(self.counts) + 1:
            self.counts.append(0)
            self.lowest.append(line["mass_ratio"])
            self.highest.append(0.0)
            self.last = 0.0
        require(n == len(self.counts) and n > 0, f"n = {n!r} is out of order")
        require(self.last < line["mass_ratio"] <= 1, "the mass ratios do not rise to 1")
        if self.last > 0:
            self.step = max(self.step, line["mass_ratio"] - self.last)
        self.last = self.highest[-1] = line["mass_ratio"]
        self.counts[-1] += 1
        require(line["beyond"] is not None, "no speed beyond the trap")
        require(0 < line["beyond"] - line["right"] <= TRAP_WIDTH, "the end is not enclosed to 1e-12")
        self.width = max(self.width, line["beyond"] - line["right"])

    def end(self):
        super().end()
        require(len(set(self.counts)) == 1, f"humps have {self.counts} mass ratios")

    means = (
        "ends of traps, for n from 1, at so many mass ratios each from the lowest to the highest, with these largest"
        " steps and widths"
    )

    def derived(self):
        return {
            "humps": len(self.counts),
            "each": self.counts[0],
            "lowest": self.lowest,
            "highest": min(self.highest),
            "step": self.step,
            "width": self.width,
        }


class EverythingHops(Whole):
    KINDS = ("crisis", "contact-part", "losses")

    def __init__(self):
        super().__init__()
        self.mass_ratio = self.losses = None
        self.hump, self.reached = 1, None

    def add_crisis(self, line):
        require(self.lines == 1 and line["n"] == 1, "the crisis of hump 1 comes first")
        self.crisis = pair(line["mass_ratio"])
        require(
            0 < self.crisis[0] and self.crisis[1] - self.crisis[0] <= CRISIS_WIDTH,
            "the crisis is not enclosed to 1e-13",
        )
        # The parts are at the upper end, which is the worst for all below (Theorem 4); the hump of the crisis is above
        # alpha*_1 at its lower end only.
        self.mass_ratio = self.crisis[1]

    def add_contact_part(self, line):
        low, high = pair(line["speeds"])
        require(line["mass_ratio"] == self.mass_ratio, "not at the crisis")
        require(arb(line["least_square"]) >= star(1) ** 2, "the bound is below alpha*_1^2")
        if line["n"] == self.hump + 1:
            self.end_of_hump()
            self.hump, self.reached = line["n"], None
            require(low <= star(self.hump), f"hump {self.hump} begins too late")
        require(line["n"] == self.hump and self.reached in (None, low), "a gap between parts")
        self.reached = high

    def end_of_hump(self):
        if self.hump > 1:
            require(arb(self.reached) >= (self.hump + 1) * arb.pi(), f"hump {self.hump} ends too early")

    def add_losses(self, line):
        require(self.losses is None, "a second bound on losses")
        self.losses = line["multiple_of_pi"]
        require(line["mass_ratio"] == self.mass_ratio, "not at the crisis")

    def end(self):
        super().end()
        self.end_of_hump()
        require(self.losses == self.hump + 1, "the bound on losses does not begin where the humps end")
        require(self.hump <= RISING_WINDOWS and self.mass_ratio <= RISING_MASS_RATIO, "`rising` has no such windows")

    means = (
        "f >= alpha*_1 from alpha*_1 up, for M up to the largest mass ratio, the lower end of the crisis (windows by"
        " `rising`; from loss_bound pi on Lemma 32)"
    )

    def derived(self):
        low, high = self.crisis
        return {"largest_mass_ratio": low, "crisis": [low, high], "width": high - low, "loss_bound": self.losses}


class Rising(Whole):
    KINDS = ("rising-window", "rising-box")

    def __init__(self):
        super().__init__()
        self.windows = []

    def add_rising_window(self, line):
        n, (low, high) = line["n"], pair(line["speeds"])
        require(n == len(self.windows) + 1, f"window {n!r} is out of order")
        require(0 < line["largest_mass_ratio"] <= 1, "what is next to alpha*_n is shown for M <= 1 alone")
        require(low <= n * arb.pi() and arb(high) >= star(n) - arb(REACH_LIGHT), "the window is not whole")
        if not rises(n, star(n), True):
            raise Unconfirmed(f"f rises next to alpha*_{n}")
        self.windows.append((n, line["largest_mass_ratio"], (low, high), []))

    def add_rising_box(self, line):
        n, _, _, boxes = self.windows[-1]
        require(line["n"] == n, f"a box of window {line['n']!r}")
        box = (*pair(line["speeds"]), *pair(line["kappas"]))
        require(not boxes or boxes[-1] != box, "a box stands twice")
        boxes.append(box)

    def end(self):
        super().end()
        for n, largest, (low, high), boxes in self.windows:
            last = max(box[3] for box in boxes)
            require(arb(last) >= parameter(largest), f"window {n} is not covered up to M = {largest!r}")
            gap = uncovered((low, high, 0.0, last), boxes)
            require(
                gap is None, f"the boxes of window {n} leave a gap: speeds {gap and gap[:2]}, kappa {gap and gap[2:]}"
            )

    means = "f rises in these windows up to these mass ratios (up to alpha*_n)"

    def derived(self):
        return {
            "windows": [n for n, *_ in self.windows],
            "largest_mass_ratios": [largest for _, largest, *_ in self.windows],
        }


def uncovered(region, boxes):
    """A part of a rectangle that no box contains; None if there is none."""
    work = [(region, boxes)]
    while work:
        (a, b, c, d), boxes = work.pop()
        if any(p <= a and b <= q and r <= c and d <= s for p, q, r, s in boxes):
            continue
        inside = [box for box in boxes if box[0] < b and a < box[1] and box[2] < d and c < box[3]]
        across = sorted(x for box in inside for x in box[:2] if a < x < b)
        along = sorted(x for box in inside for x in box[2:] if c < x < d)
        if not across and not along:
            return (a, b, c, d)
        if len(across) >= len(along):
            cut = across[len(across) // 2]
            work += [((a, cut, c, d), inside), ((cut, b, c, d), inside)]
        else:
            cut = along[len(along) // 2]
            work += [((a, b, c, cut), inside), ((a, b, cut, d), inside)]
    return None


def implied(claimed, lengths, fate, whole):
    """The share of `fate` is between what is known of it, and that with all that is open."""
    low, high = map(arb, claimed)
    open_length = whole - sum(lengths.values(), arb(0))
    own = lengths.get(fate, arb(0))
    require(
        low * whole <= own and own + open_length <= high * whole, f"the intervals do not show the share of {fate!r}"
    )


class Measures(Whole):
    KINDS = ("basins", "gaps", "fraction")

    def __init__(self):
        super().__init__()
        self.mass_ratios, self.list, self.wanted = [], None, set()
        self.widths, self.all_humps = [], None

    def add_basins(self, line):
        self.complete()
        low, high = pair(line["mass_ratios"])
        require(low == high, "a strip of mass ratios")
        self.mass_ratios.append(low)
        self.widths.append(0.0)
        self.list, self.gaps = intervals(line, "intervals"), None
        Basins(low, high, self.list)
        self.wanted, self.humps = None, None

    def add_gaps(self, line):
        require(self.list is not None and self.gaps is None and self.wanted is None, "gaps come after intervals")
        self.gaps = gaps_of(line)
        require_disjoint(self.list, self.gaps)

    def add_fraction(self, line):
        fate, humps = fate_of(line["fate"]), line["humps"]
        require(humps >= 1, "no humps")
        if self.wanted is None:
            self.measure(humps)
        require(fate in self.wanted and humps == self.humps, f"the share of {fate!r} is out of order")
        self.wanted.remove(fate)
        require(self.all_humps in (None, humps), "fractions of other humps than before")
        self.all_humps = humps
        for bounds in (line["uniform"], line["by_humps"]):
            low, high = pair(bounds)
            require(0 <= low and high <= 1, f"[{low!r}, {high!r}] is no fraction")
            self.widths[-1] = max(self.widths[-1], high - low)
        whole = [star(n + 1) - star(n) for n in range(1, humps + 1)]
        together = {}
        for of_hump in self.lengths:
            for key, length in of_hump.items():
                together[key] = together.get(key, arb(0)) + length
        implied(line["uniform"], together, fate, sum(whole, arb(0)))
        shares = [{key: length / part for key, length in of_hump.items()} for of_hump, part in zip(self.lengths, whole)]
        means = {key: sum((of_hump.get(key, arb(0)) for of_hump in shares), arb(0)) / humps for key in together}
        implied(line["by_humps"], means, fate, arb(1))

    def measure(self, humps):
        """The length of each fate on each hump, at least."""
        require(self.gaps is not None, "no gaps")
        self.humps, self.wanted = humps, {*range(humps + 1), GROUNDED}
        self.lengths = [{} for _ in range(humps)]
        stars = [star(n) for n in range(1, humps + 2)]
        lengths_between(stars, self.list, self.lengths)
        for left, right, own in self.gaps:
            for first, last, of_hump in zip(stars, stars[1:], self.lengths):
                if left > first and right < last:
                    for fate, least in own.items():
                        of_hump[fate] = of_hump.get(fate, arb(0)) + least

    def complete(self):
        require(not self.wanted and self.wanted is not None, f"no share of {self.wanted or 'any fate'}")

    def end(self):
        super().end()
        self.complete()

    means = "fractions of the humps from 1 on at these mass ratios, each between bounds of this width"

    def derived(self):
        return {"humps": self.all_humps, "mass_ratios": self.mass_ratios, "widths": self.widths}


def require_disjoint(intervals, gaps):
    """No speed is counted twice."""
    last = 0.0
    for left, right, _ in sorted([*intervals, *gaps], key=lambda own: own[:2]):
        require(last <= left, f"[{left!r}, {right!r}] is not above the interval or gap before it")
        last = right


def lengths_between(edges, intervals, lengths):
    """Adds the length of each interval between neighbouring edges to the dictionaries of fates."""
    for left, right, fate in intervals:
        for (first, last), of_part in zip(zip(edges, edges[1:]), lengths):
            if right > first and left < last:
                low = left if left > first else first
                high = right if right < last else last
                of_part[fate] = of_part.get(fate, arb(0)) + (arb(high) - arb(low))


def require_edge(value, ends, at, count, what):
    """`value` is at this part of the way between the ends, up to some ulps."""
    first, last = map(Fraction, ends)
    wanted = first + (last - first) * at / count
    require(
        abs(Fraction(value) - wanted) <= EDGE_ULPS * Fraction(math.ulp(max(map(abs, ends)))), f"{value!r} is not {what}"
    )


def require_middle(value, ends, at, count):
    """`value` is the double of the middle of a pixel: three roundings, in this order. Beside it the fate may be another
    one."""
    wanted = ends[0] + (ends[1] - ends[0]) * ((at + 0.5) / count)
    require(value == wanted, f"{value!r} is not in the middle of a pixel, {wanted!r}")


class Raster(Whole):
    """A grid, and its columns from the left."""

    def __init__(self):
        super().__init__()
        self.grid = None

    def add_grid(self, line):
        require(self.lines == 1, "the grid comes first")
        self.grid = line
        self.ratios, self.speeds = pair(line["mass_ratios"]), pair(line["speeds"])
        require(line["columns"] >= 1 and line["rows"] >= 1, "no pixels")

    def derived(self):
        return {
            "mass_ratios": list(self.ratios),
            "speeds": list(self.speeds),
            "columns": self.grid["columns"],
            "rows": self.grid["rows"],
        }


class RasterPoints(Raster):
    KINDS = ("grid", "speeds", "points")
    has_speeds = False

    def __init__(self):
        super().__init__()
        self.columns = 0

    def add_speeds(self, line):
        require(self.lines == 2 and len(line["speeds"]) == self.grid["rows"], "not one speed for each row")
        self.has_speeds = True
        for row, speed in enumerate(line["speeds"]):
            require_middle(speed, self.speeds, row, self.grid["rows"])

    def add_points(self, line):
        require(sum(count for _, count in line["fates"]) == self.grid["rows"], "not one fate for each row")
        require_middle(line["mass_ratio"], self.ratios, self.columns, self.grid["columns"])
        for fate, _ in line["fates"]:
            fate_of(fate)
        self.columns += 1

    def end(self):
        require(self.grid and self.has_speeds and self.columns == self.grid["columns"], f"{self.columns} columns")

    means = "the fate of the middle of every pixel of this window"


class RasterCells(Raster):
    KINDS = ("grid", "cells", "basins", "area")

    def __init__(self):
        super().__init__()
        self.strips, self.lengths, self.areas = [], [{}], set()
        self.least = 0.0

    def add_cells(self, line):
        self.edges, self.claimed = line["edges"], line["of_one_basin"]
        require(self.lines == 2 and len(self.edges) == self.grid["rows"] + 1, "not one edge for each row")
        require((self.edges[0], self.edges[-1]) == self.speeds, "the rows do not end at the window")
        require(all(a < b for a, b in zip(self.edges, self.edges[1:])), "the edges do not rise")
        for row, edge in enumerate(self.edges):
            require_edge(edge, self.speeds, row, self.grid["rows"], "the edge of a row")

    def add_basins(self, line):
        low, high = pair(line["mass_ratios"])
        before = self.strips[-1][1] if self.strips else self.ratios[0]
        require(low == before and high > low, f"a gap between strips at M = {before!r}")
        own = intervals(line, "intervals")
        Basins(low, high, own)
        lengths = [{}]
        lengths_between(list(map(arb, self.speeds)), own, lengths)
        for fate, length in lengths[0].items():
            self.lengths[0][fate] = self.lengths[0].get(fate, arb(0)) + length * (arb(high) - arb(low))
        lefts = [left for left, _, _ in own]
        fates = []
        for low_edge, high_edge in zip(self.edges, self.edges[1:]):
            at = bisect_right(lefts, low_edge) - 1
            fates.append(own[at][2] if at >= 0 and high_edge <= own[at][1] else None)
        self.strips.append((low, high, fates))

    def add_area(self, line):
        fate = fate_of(line["fate"])
        require(fate not in self.areas, f"a second area of {fate!r}")
        self.areas.add(fate)
        self.least += pair(line["share"])[0]
        whole = (arb(self.ratios[1]) - arb(self.ratios[0])) * (arb(self.speeds[1]) - arb(self.speeds[0]))
        implied(line["share"], self.lengths[0], fate, whole)

    def end(self):
        columns, strips = self.grid["columns"], len(self.strips)
        require(strips and self.strips[-1][1] == self.ratios[1], "the strips end before the window")
        require(strips % columns == 0, f"{strips} strips in {columns} columns")
        require(self.areas == set(self.lengths[0]), "not one area for each fate")
        each, count = strips // columns, 0
        for column in range(columns):
            require_edge(self.strips[column * each][0], self.ratios, column, columns, "the edge of a column")
            together = zip(*(fates for _, _, fates in self.strips[column * each : (column + 1) * each]))
            count += sum(first is not None and all(fate == first for fate in rest) for first, *rest in together)
        require(count == self.claimed, f"{count} cells lie in intervals of one fate, not {self.claimed}")

    means = "so many cells of one fate, and the area of each fate, with this share of the window open"

    def derived(self):
        return {**super().derived(), "cells": self.claimed, "open": 1 - self.least}


WHOLE = {
    "one-sudden": OneSudden,
    "one-sided": OneSided,
    "crisis": Crises,
    "traps": Traps,
    "everything-hops": EverythingHops,
    "rising": Rising,
    "measures": Measures,
    "fig6-points": RasterPoints,
    "fig9-points": RasterPoints,
    "fig6-cells": RasterCells,
    "fig9-cells": RasterCells,
}
