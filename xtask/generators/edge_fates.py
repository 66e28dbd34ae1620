"""Fates close to the edges of basins: edges.jsonl and edge_fates.jsonl.

An edge is a speed whose orbit comes exactly to alpha*_n. On one side of it the orbit then falls to the left of
alpha*_n, and needs many hops to leave. No hop is jumped here. Far from the fixed points the hops are those of hop.py.
Within NEAR to the left of one they are those of phases.py, which are faster there; the first and the last of these are
compared with hop.py.

`python edge_fates.py FOLDER` chooses the inputs with a fixed seed, and writes files of them into a folder.
"""

import json
import math
import random
import sys

import gmpy2
from gmpy2 import mpfr
from mpmath import cbrt, floor, mp, mpf, nstr

from abel import solution, sum_of_series
from basins import cell, edge
from hop import Hop, Stuck, alpha_star, confirmed, text
from phases import LocalHop, phase_of

# Left of a fixed point the hops are local ones up to this distance.
NEAR = mpf("1e-4")


def agree(mass_ratio, star, before, after):
    """Stuck unless hop.py leads from one local offset to the other."""
    found = star - Hop(mass_ratio, star - before).next
    if abs(found - after) > abs(after) * mpf(10) ** -(mp.dps // 2):
        raise Stuck("a local hop and a hop differ")


def leave(mass_ratio, n, size):
    """|delta| and the count of hops when the orbit has come farther than NEAR to the left of alpha*_n."""
    with mp.workdps(mp.dps + 40), gmpy2.context(gmpy2.context(), precision=mp.prec):
        star, local, hops = alpha_star(n), LocalHop("left", n, mass_ratio), 0
        digits, near = mp.dps + 5, mpfr(nstr(NEAR, 10))
        current = mpfr(nstr(size, digits))
        while current < near:
            before, current, hops = current, local.next(current), hops + 1
            if hops == 1 or current >= near:
                agree(mass_ratio, star, mpf(str(before)), mpf(str(current)))
        return mpf(str(current)), hops


def follow(mass_ratio, alpha):
    """The n of the trap that the orbit enters, or None where it ends; and the count of hops, with the last one.

    The traps are those of basins.py: on the contact interval.
    """
    hops = 0
    while True:
        n = cell(alpha)
        if alpha < (n + 1) * mp.pi:
            end = edge(n, mass_ratio)
            if end is None or alpha <= end:
                return n, hops
        size = alpha_star(n + 1) - alpha
        if size < NEAR:
            size, more = leave(mass_ratio, n + 1, size)
            alpha, hops = alpha_star(n + 1) - size, hops + more
        else:
            alpha, hops = Hop(mass_ratio, alpha).next, hops + 1
            if alpha is None:
                return None, hops


def fate(record):
    """A line of edge_fates.jsonl."""

    def make():
        n, hops = follow(record["mass_ratio"], mpf(record["alpha"]))
        made = {"mass_ratio": record["mass_ratio"], "alpha": record["alpha"]}
        made["fate"] = "grounded" if n is None else "incessant" if n else "decaying"
        if n:
            made["n"] = n
        made["hops"] = hops
        return made

    return confirmed(make)


def find_edge(mass_ratio, alpha):
    """(n, hops, edge, slope) for a speed close to an edge, by Newton's method on f^hops = alpha*_n."""
    place, hops = mpf(alpha), 0
    while True:
        place, hops = Hop(mass_ratio, place).next, hops + 1
        n = max(1, int(floor(place / mp.pi)))
        if abs(place - alpha_star(n)) < mpf("1e-12"):
            break
    found = mpf(alpha)
    for _ in range(20):
        place, slope = found, mpf(1)
        for _ in range(hops):
            hop = Hop(mass_ratio, place, slopes=True)
            place, slope = hop.next, slope * hop.slopes[0]
        step = (place - alpha_star(n)) / slope
        found -= step
        if abs(step) < mpf(10) ** -(mp.dps // 2):
            return n, hops, found, slope
    raise Stuck("the edge is not found")


def edge_record(record):
    """A line of edges.jsonl: f^hops(edge) = alpha*_n, with the slope of f^hops."""

    def make():
        n, hops, place, slope = find_edge(record["mass_ratio"], record["alpha"])
        made = {"mass_ratio": record["mass_ratio"], "alpha": record["alpha"], "n": n, "hops": hops}
        return dict(made, edge=text(place), slope=text(slope, 17))

    return confirmed(make)


# The choice of inputs.

EDGES = ((0.2, 8.473039723398273), (0.12, 11.920553918335777), (0.8, 8.457399673997674), (0.2, 15.025371092446333))
DISTANCES = (1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13)
FALLING, RISING, PAIRS, AROUND = 60, 20, 40, 3


class Proposals:
    """Fates left of an edge by their phase alone: quick, and used only to propose pairs of doubles."""

    # The offset of every phase is looked for with the same whole part, where |a| x is about 0.03.
    WHOLE = 26

    def __init__(self, mass_ratio, alpha):
        self.mass_ratio = mass_ratio
        self.n, self.hops, self.edge, self.slope = find_edge(mass_ratio, alpha)
        self.star = alpha_star(self.n)
        self.series = solution("left", self.n, mass_ratio, 40)
        self.known = {}

    def offset(self, turn):
        """The |delta| whose phase is WHOLE + turn: bisection."""
        low, high = mpf("0.005") / self.series[0], mpf("0.1") / self.series[0]
        for _ in range(90):
            middle = (low + high) / 2
            if sum_of_series(middle, *self.series) > self.WHOLE + turn:
                low = middle
            else:
                high = middle
        return low**3

    def fate(self, alpha):
        if alpha not in self.known:
            place = mpf(alpha)
            for _ in range(self.hops):
                place = Hop(self.mass_ratio, place).next
            size = self.star - place
            if size <= 0:
                raise ValueError("not left of the fixed point")
            phase = phase_of("left", self.n, self.mass_ratio, size, 40, "0.03", "0.03")
            self.known[alpha] = follow(self.mass_ratio, self.star - self.offset(phase - floor(phase)))[0]
        return self.known[alpha]

    def pair(self, pick, distance):
        """Two neighbouring doubles of different fates near a place at a random distance, or None."""
        side = -1 if self.slope > 0 else 1
        for _ in range(60):
            first = float(self.edge + side * distance * pick.uniform(0.3, 1))
            # One period of the phase: 3 a x^4 in offset, less if a double's spacing is more.
            x = cbrt(abs(first - self.edge) * abs(self.slope))
            period = float(3 * self.series[0] * x**4 / abs(self.slope))
            second = first + max(period * pick.uniform(0, 1), math.ulp(first))
            if side * (second - self.edge) <= 0 or self.fate(first) == self.fate(second):
                continue
            while math.nextafter(first, second) != second:
                middle = first + (second - first) / 2
                if self.fate(middle) == self.fate(first):
                    first = middle
                else:
                    second = middle
            return first, second
        return None


def choose(mass_ratio, alpha):
    """The speeds of one edge, in order."""
    pick = random.Random(f"edges {mass_ratio} {alpha}")
    proposals = Proposals(mass_ratio, alpha)
    side = -1 if proposals.slope > 0 else 1
    chosen = set()
    for count, where in ((FALLING, side), (RISING, -side)):
        for k in range(count):
            distance = DISTANCES[k % len(DISTANCES)]
            while True:
                place = float(proposals.edge + where * distance * pick.uniform(0.3, 1))
                if place not in chosen:
                    chosen.add(place)
                    break
    below = float(proposals.edge)
    below = below if below < proposals.edge else math.nextafter(below, 0)
    above = math.nextafter(below, math.inf)
    for _ in range(AROUND):
        chosen |= {below, above}
        below, above = math.nextafter(below, 0), math.nextafter(above, math.inf)
    for k in range(PAIRS):
        pair = proposals.pair(pick, DISTANCES[k % len(DISTANCES)])
        if pair is None:
            # One colour: no pair anywhere near.
            break
        chosen |= set(pair)
    return [{"mass_ratio": mass_ratio, "alpha": place} for place in sorted(chosen)]


if __name__ == "__main__":
    mp.dps = 50
    with open(f"{sys.argv[1]}/edges.jsonl", "w", encoding="utf-8") as file:
        file.writelines(json.dumps({"mass_ratio": m, "alpha": alpha}) + "\n" for m, alpha in EDGES)
    with open(f"{sys.argv[1]}/edge_fates.jsonl", "w", encoding="utf-8") as file:
        for m, alpha in EDGES:
            records = choose(m, alpha)
            print(m, alpha, len(records), flush=True)
            file.writelines(json.dumps(record) + "\n" for record in records)
