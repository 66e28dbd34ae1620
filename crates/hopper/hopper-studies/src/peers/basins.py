"""Basins of three systems by compiled loops of numba: seconds, numbers of attractors, and shares of a basin.

python basins.py job.json results.json

Attractors are found by recurrences to cells of a grid, as Attractors.jl finds them: an orbit that visits only cells that it visited before is
followed on, and the cells of its next steps are those of an attractor. Some first starts find the attractors, one after the
other; then all starts are labelled in parallel, a block for each thread. Each map is measured twice: without tests of the attractors, and with
simple tests in parallel, by orbits from the cells and from those beside them. A label is wrong if most starts with this label end elsewhere after many plain
steps. The driven pendulum is integrated to its end by DOP853, with the coefficients and the
step control of SciPy.
"""

import json
import sys
import time

import numba
import numpy
from scipy.integrate._ivp import dop853_coefficients

RECURRENCES, LOCATE, BUDGET, LOST = 100, 1000, 100_000, 1000
# Stretches of a test with visits of the cells, and the steps in which an orbit is expected to repeat itself.
STRETCHES, LOOKED = 3, 256
# Plain steps to the true end of an orbit.
PLAIN = 500


@numba.njit
def newton(x, y):
    a, b = x * x - y * y, 2.0 * x * y
    d = 3.0 * (a * a + b * b)
    u, v = 2.0 * (a * x - b * y) + 1.0, 2.0 * (a * y + b * x)
    return (u * a + v * b) / d, (v * a - u * b) / d


@numba.njit
def henon(x, y):
    return 1.0 - 1.4 * x * x + y, 0.3 * x


@numba.njit
def root(x, y):
    """Which cube root of 1 is nearest."""
    return 0 if x > 0 else 1 if y > 0 else 2


@numba.njit
def is_bounded(x, y):
    return 1 if abs(x) < 100.0 and abs(y) < 100.0 else 0


@numba.njit
def uniform(k):
    """A number between 0 and 1 for each k (SplitMix64)."""
    z = numpy.uint64(k + 1) * numpy.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> numpy.uint64(27))) * numpy.uint64(0x94D049BB133111EB)
    return ((z ^ (z >> numpy.uint64(31))) >> numpy.uint64(11)) / 9007199254740992.0


def ends(step, end):
    @numba.njit
    def all_ends(xs, ys):
        found = numpy.empty(xs.size, numpy.uint8)
        for i in range(xs.size):
            x, y = xs[i], ys[i]
            for _ in range(PLAIN):
                x, y = step(x, y)
                if not (abs(x) < 1e30 and abs(y) < 1e30):
                    break
            found[i] = end(x, y)
        return found

    return all_ends


def wrong(labels, true_ends):
    """The share of labels that are undecided (-1), or whose start ends elsewhere than most starts with this label."""
    known = numpy.unique(labels[labels != -1])
    right = sum(numpy.bincount(true_ends[labels == label]).max() for label in known)
    return float(1 - right / labels.size)


def recurrences(step):
    @numba.njit
    def cell(x, y, half, cells):
        if not (-half <= x <= half and -half <= y <= half):
            return -1
        i, j = int((x + half) / (2 * half) * cells), int((y + half) / (2 * half) * cells)
        return min(j, cells - 1) * cells + min(i, cells - 1)

    @numba.njit
    def label(x, y, owner, visited, stamp, half, cells, escape, found):
        recurrences, lost = 0, 0
        for _ in range(BUDGET):
            if abs(x) > escape or abs(y) > escape or x != x:
                return -2, found
            c = cell(x, y, half, cells)
            if c < 0:
                lost += 1
                if lost > LOST:
                    return -1, found
            else:
                lost = 0
                if owner[c] > 0:
                    return owner[c], found
                if visited[c] == stamp:
                    recurrences += 1
                else:
                    visited[c] = stamp
                    recurrences = 0
                if recurrences >= RECURRENCES:
                    found += 1
                    for _ in range(LOCATE):
                        c = cell(x, y, half, cells)
                        if c >= 0:
                            owner[c] = found
                        x, y = step(x, y)
                    return found, found
            x, y = step(x, y)
        return -1, found

    @numba.njit
    def stays(x, y, owner, own, half, cells):
        anchor_x, anchor_y, anchored = x, y, 1
        for k in range(1, LOCATE):
            x, y = step(x, y)
            if k < LOOKED:
                if x == anchor_x and y == anchor_y:
                    c = cell(x, y, half, cells)
                    return c >= 0 and owner[c] == own
                if k == 2 * anchored:
                    anchor_x, anchor_y, anchored = x, y, k
        for _ in range(STRETCHES):
            comes = False
            for _ in range(LOCATE):
                if not comes:
                    c = cell(x, y, half, cells)
                    comes = c >= 0 and owner[c] == own
                x, y = step(x, y)
            if not comes:
                return False
        return True

    @numba.njit(parallel=True)
    def is_trap(owner, own, half, cells, tests):
        its = numpy.flatnonzero(owner == own)
        good = numpy.zeros(tests, numpy.bool_)
        for k in numba.prange(tests):
            c = its[int(uniform(5 * k) * its.size)]
            i, j = c % cells, c // cells
            if k % 2 == 0:
                i, j = i + int(3 * uniform(5 * k + 1)) - 1, j + int(3 * uniform(5 * k + 2)) - 1
            x = -half + 2 * half * (i + uniform(5 * k + 3)) / cells
            y = -half + 2 * half * (j + uniform(5 * k + 4)) / cells
            good[k] = stays(x, y, owner, own, half, cells)
        return good.all()

    @numba.njit
    def search(xs, ys, owner, visited, half, cells, escape, tests):
        found, refused = 0, 0
        for i in range(xs.size):
            known = found
            _, found = label(xs[i], ys[i], owner, visited, i + 1, half, cells, escape, found)
            if found > known and tests > 0 and not is_trap(owner, found, half, cells, tests):
                refused += 1
        return found, refused

    @numba.njit(parallel=True)
    def basins(xs, ys, owner, half, cells, escape, found):
        labels = numpy.empty(xs.size, numpy.int32)
        blocks = numba.get_num_threads()
        for block in numba.prange(blocks):
            own = numpy.zeros(cells * cells, numpy.int64)
            begin, end = xs.size * block // blocks, xs.size * (block + 1) // blocks
            for i in range(begin, end):
                labels[i], _ = label(xs[i], ys[i], owner, own, i + 1, half, cells, escape, found)
        return labels

    def both(first, starts, half, cells, escape, tests):
        begin = time.perf_counter()
        owner, visited = numpy.zeros(cells * cells, numpy.int32), numpy.zeros(cells * cells, numpy.int64)
        found, refused = search(*first, owner, visited, half, cells, escape, tests)
        middle = time.perf_counter()
        labels = basins(*starts, owner, half, cells, escape, found)
        return middle - begin, time.perf_counter() - begin, labels, found, refused

    return both


A, B, E3, E5 = (
    numpy.ascontiguousarray(part)
    for part in (
        dop853_coefficients.A[:12, :12],
        dop853_coefficients.B,
        dop853_coefficients.E3,
        dop853_coefficients.E5,
    )
)


@numba.njit
def field(x, v):
    return v, 0.5 - 0.1 * v - numpy.sin(x)


@numba.njit
def end_speed(x, v, end, tolerance):
    k, l = numpy.empty(13), numpy.empty(13)
    k[0], l[0] = field(x, v)
    s, r = tolerance * (1 + abs(x)), tolerance * (1 + abs(v))
    d0 = numpy.sqrt(((x / s) ** 2 + (v / r) ** 2) / 2)
    d1 = numpy.sqrt(((k[0] / s) ** 2 + (l[0] / r) ** 2) / 2)
    h0 = 1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1
    a, b = field(x + h0 * k[0], v + h0 * l[0])
    d2 = numpy.sqrt((((a - k[0]) / s) ** 2 + ((b - l[0]) / r) ** 2) / 2) / h0
    h1 = max(1e-6, h0 * 1e-3) if d1 <= 1e-15 and d2 <= 1e-15 else (0.01 / max(d1, d2)) ** (1 / 8)
    h, t, rejected = min(100 * h0, h1), 0.0, False
    while t < end:
        h = min(h, end - t)
        for i in range(1, 12):
            p = q = 0.0
            for j in range(i):
                p += A[i, j] * k[j]
                q += A[i, j] * l[j]
            k[i], l[i] = field(x + h * p, v + h * q)
        p = q = 0.0
        for j in range(12):
            p += B[j] * k[j]
            q += B[j] * l[j]
        next_x, next_v = x + h * p, v + h * q
        k[12], l[12] = field(next_x, next_v)
        p3 = q3 = p5 = q5 = 0.0
        for j in range(13):
            p3 += E3[j] * k[j]
            q3 += E3[j] * l[j]
            p5 += E5[j] * k[j]
            q5 += E5[j] * l[j]
        s = tolerance * (1 + max(abs(x), abs(next_x)))
        r = tolerance * (1 + max(abs(v), abs(next_v)))
        fifth, third = (p5 / s) ** 2 + (q5 / r) ** 2, (p3 / s) ** 2 + (q3 / r) ** 2
        error = 0.0 if fifth == 0 else abs(h) * fifth / numpy.sqrt((fifth + 0.01 * third) * 2)
        if error < 1:
            factor = 10.0 if error == 0 else min(10.0, 0.9 * error ** (-1 / 8))
            t, x, v = t + h, next_x, next_v
            k[0], l[0] = k[12], l[12]
            h *= min(1.0, factor) if rejected else factor
            rejected = False
        else:
            h *= max(0.2, 0.9 * error ** (-1 / 8))
            rejected = True
    return v


@numba.njit(parallel=True)
def rotates(side, end, tolerance):
    found = numpy.empty(side * side, numpy.bool_)
    for k in numba.prange(side * side):
        x = -numpy.pi + 2 * numpy.pi * ((k % side) + 0.5) / side
        v = -10 + 20 * ((k // side) + 0.5) / side
        found[k] = end_speed(x, v, end, tolerance) > 2.5
    return found


job, results = sys.argv[1:]
with open(job) as file:
    job = json.load(file)
rows, true_ends = [], {}
for scene, step, end in (("Newton", newton, root), ("Hénon", henon, is_bounded)):
    given = job[scene]
    first, starts = ([numpy.array(column) for column in given[name]] for name in ("first", "starts"))
    true_ends[scene] = ends(step, end)(*starts)
    both = recurrences(step)
    for cells in given["cells"]:
        for tests in (0, job["tests"]):
            # The compiler does its work in the first one.
            runs = [
                both(first, starts, given["half"], cells, given["escape"], tests)
                for _ in range(job["repeats"] + 1)
            ]
            search, seconds, labels, found, refused = min(runs[1:], key=lambda run: run[1])
            rows.append(
                {
                    "scene": scene,
                    "program": f"numba, {cells} cells, {'tests' if tests else 'no tests'}",
                    "tested": tests > 0,
                    "search": search,
                    "seconds": seconds,
                    "attractors": found,
                    "refused": refused,
                    "share": float(numpy.bincount(labels[labels > 0]).max() / labels.size),
                    "wrong": wrong(labels, true_ends[scene]),
                }
            )
given = job["pendulum"]
rotates(4, 1.0, 1e-3)
exact = rotates(given["side"], given["end"], given["reference"])
true_ends["pendulum"] = exact
for tolerance in given["tolerances"]:
    begin = time.perf_counter()
    found = rotates(given["side"], given["end"], tolerance)
    seconds = time.perf_counter() - begin
    rows.append(
        {
            "scene": "pendulum",
            "program": f"numba, DOP853, {tolerance:.0e}",
            "tested": True,
            "seconds": seconds,
            "refused": 0,
            "share": float(found.mean()),
            "wrong": float((found != exact).mean()),
        }
    )
true_ends = {scene: found.astype(int).tolist() for scene, found in true_ends.items()}
with open(results, "w") as file:
    json.dump({"rows": rows, "ends": true_ends}, file)
