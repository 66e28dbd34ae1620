"""Hops of the passive hopper by heyoka, SciPy, NumPy, numba and this repository's package: time a hop, and the speeds
found.

python peers.py hops.json results.json

Each program finds the landings of a hop: a landing is the first zero of the height after the take-off. The
collisions, and the contact phase after the last landing, have closed forms that are the same for all programs.
The flight is integrated in the stretch s and the momentum coordinate P: s'' = -s, P'' = -1, height P - s. The
height has a double or triple zero at the take-off, and no program can start there. All of them start a little
later, from the closed form.
"""

import json
import math
import sys
import time

import heyoka
import numba
import numpy
import passive_hopper
import scipy
from scipy.integrate import solve_ivp

LATEST = 1.0e3  # longer than any flight of these hops


def start(x, v, later):
    """The flight from stretch 1 + x with velocity v, `later` after the take-off: (s, s', P, P')."""
    s, c, y = math.sin(later), math.cos(later), 1.0 + x
    return (y * c + v * s, v * c - y * s, y + v * later - later * later / 2, v - later)


def later(x, v):
    """A time after the take-off and well before the landing."""
    if x <= 0.0:
        return min(0.1, v)
    root = math.sqrt(v * v + 3.0 * x)
    short = v + root if v > 0.0 else 3.0 * x / (root - v)
    return 0.05 * min(short, 1.0)


def after(state, ratio):
    """Closing speed, stretch minus one and velocity after a landing in `state`."""
    s, sd, _, pd = state
    closing = sd - pd
    return closing, s - 1.0, pd + ratio / (1.0 + ratio) * closing


def hop_by(landing, ratio, alpha):
    """The next lift-off speed, or None, by `landing(x, v) -> state`."""
    x, v, squares = 0.0, alpha, 0.0
    while True:
        closing, x, v = after(landing(x, v), ratio)
        squares += closing * closing
        if x <= 0.0:
            break
    rest = alpha * alpha - ratio / (1.0 + ratio) ** 2 * squares
    return math.sqrt(rest) if rest > 0.0 else None


def by_scipy(hops):
    def height(t, y):
        return y[2] - y[0]

    height.terminal, height.direction = True, -1

    def flow(t, y):
        return (y[1], -y[0], y[3], -1.0)

    def landing(x, v):
        first = later(x, v)
        solution = solve_ivp(flow, (first, LATEST), start(x, v, first), "DOP853", rtol=1e-10, atol=1e-12, events=height)
        return solution.y_events[0][0]

    return [hop_by(landing, *hop) for hop in hops]


def equations():
    s, sd, p, pd = heyoka.make_vars("s", "sd", "p", "pd")
    return [(s, sd), (sd, -s), (p, pd), (pd, heyoka.expression(-1.0))], p - s


def heyoka_scalar():
    flow, height = equations()
    event = heyoka.t_event(height, direction=heyoka.event_direction.negative)
    integrator = heyoka.taylor_adaptive(flow, [1.0, 1.0, 1.0, 1.0], t_events=[event])

    def landing(x, v):
        first = later(x, v)
        integrator.time = first
        integrator.state[:] = start(x, v, first)
        integrator.reset_cooldowns()
        integrator.propagate_until(LATEST)
        return integrator.state

    return lambda hops: [hop_by(landing, *hop) for hop in hops]


def heyoka_batch():
    flow, height = equations()
    lanes = heyoka.recommended_simd_size()
    job = {}

    def landed(integrator, _, lane):
        """Records the landing; the lane continues with the next flight, or the next hop."""
        if job["hop"][lane] is None:
            return True
        number, ratio, alpha = job["hop"][lane]
        closing, x, v = after(integrator.state[:, lane], ratio)
        job["squares"][lane] += closing * closing
        if x <= 0.0:
            rest = alpha * alpha - ratio / (1.0 + ratio) ** 2 * job["squares"][lane]
            job["next"][number] = math.sqrt(rest) if rest > 0.0 else None
            x, v = next_hop(lane)
        integrator.state[:, lane] = start(x, v, later(x, v))
        return job["left"] > 0

    def next_hop(lane):
        try:
            number, (ratio, alpha) = next(job["hops"])
            job["hop"][lane] = (number, ratio, alpha)
        except StopIteration:
            job["left"] -= job["hop"][lane] is not None
            job["hop"][lane], alpha = None, 5.0
        job["squares"][lane] = 0.0
        return 0.0, alpha

    event = heyoka.t_event_batch(height, direction=heyoka.event_direction.negative, callback=landed)
    integrator = heyoka.taylor_adaptive_batch(flow, numpy.ones((4, lanes)), t_events=[event])

    def run(hops):
        job.update(
            hops=iter(enumerate(hops)),
            next=[None] * len(hops),
            hop=[(-1, 0.0, 0.0)] * lanes,
            squares=[0.0] * lanes,
            left=lanes,
        )
        integrator.set_time(0.0)
        integrator.reset_cooldowns()
        for lane in range(lanes):
            x, v = next_hop(lane)
            integrator.state[:, lane] = start(x, v, later(x, v))
        while job["left"] > 0:
            integrator.propagate_until(numpy.array(integrator.time) + LATEST)
        return job["next"]

    return run


def heyoka_flights():
    """Only the first flight of every hop, each lane to the end of its bracket. Python only records the time of the
    landing."""
    flow, height = equations()
    lanes = heyoka.recommended_simd_size()
    found = []
    event = heyoka.nt_event_batch(
        height, lambda integrator, at, sign, lane: found.append(at), direction=heyoka.event_direction.negative
    )
    integrator = heyoka.taylor_adaptive_batch(flow, numpy.ones((4, lanes)), nt_events=[event])

    def run(hops):
        found.clear()
        for first in range(0, len(hops) - lanes + 1, lanes):
            alphas = [alpha for _, alpha in hops[first : first + lanes]]
            begins = [later(0.0, alpha) for alpha in alphas]
            integrator.set_time(numpy.array(begins))
            integrator.state[:] = numpy.array([start(0.0, alpha, begin) for alpha, begin in zip(alphas, begins)]).T
            ends = [2.0 * math.pi * (math.floor(alpha / math.pi) + 1.0) for alpha in alphas]
            integrator.propagate_until(numpy.array(ends))
        if len(found) < len(hops) - lanes:
            raise RuntimeError(f"{len(found)} landings of {len(hops)} flights")
        return []

    return run


@numba.njit
def numba_hop(ratio, alpha):
    x, v, squares = 0.0, alpha, 0.0
    kappa = ratio / (1.0 + ratio)
    while True:
        y = 1.0 + x
        # Scan for the change of sign, then bisect.
        step = 0.05
        left = 0.1 if x <= 0.0 else 1e-6
        right = left + step
        while y + v * right - right * right / 2 - y * math.cos(right) - v * math.sin(right) > 0.0:
            left, right = right, right + step
        for _ in range(60):
            middle = 0.5 * (left + right)
            height = y + v * middle - middle * middle / 2 - y * math.cos(middle) - v * math.sin(middle)
            if height > 0.0:
                left = middle
            else:
                right = middle
        t = 0.5 * (left + right)
        closing = t - v + v * math.cos(t) - y * math.sin(t)
        x = y * math.cos(t) + v * math.sin(t) - 1.0
        v = v - t + kappa * closing
        squares += closing * closing
        if x <= 0.0:
            break
    rest = alpha * alpha - kappa / (1.0 + ratio) * squares
    return math.sqrt(rest) if rest > 0.0 else -1.0


@numba.njit
def numba_hops(ratios, alphas):
    images = numpy.empty(len(ratios))
    for k in range(len(ratios)):
        images[k] = numba_hop(ratios[k], alphas[k])
    return images


def by_numba(hops):
    ratios, alphas = numpy.array(hops).T
    return [speed if speed > 0.0 else None for speed in numba_hops(ratios.copy(), alphas.copy())]


def by_numpy(hops):
    """The closed form for all hops at once: those that have not landed yet are scanned on, and bisected together."""
    ratio, alpha = numpy.array(hops).T
    kappa = ratio / (1.0 + ratio)
    x, v, squares = numpy.zeros_like(alpha), alpha.copy(), numpy.zeros_like(alpha)
    flying = numpy.arange(len(hops))
    while len(flying):
        y, speed = 1.0 + x[flying], v[flying]

        def height(t, of=slice(None)):
            return y[of] + speed[of] * t - t * t / 2 - y[of] * numpy.cos(t) - speed[of] * numpy.sin(t)

        left = numpy.where(x[flying] <= 0.0, 0.1, 1e-6)
        above = numpy.arange(len(flying))
        while len(above):
            above = above[height(left[above] + 0.05, above) > 0.0]
            left[above] += 0.05
        right = left + 0.05
        for _ in range(60):
            middle = 0.5 * (left + right)
            high = height(middle) > 0.0
            left, right = numpy.where(high, middle, left), numpy.where(high, right, middle)
        t = 0.5 * (left + right)
        closing = t - speed + speed * numpy.cos(t) - y * numpy.sin(t)
        x[flying] = y * numpy.cos(t) + speed * numpy.sin(t) - 1.0
        v[flying] = speed - t + kappa[flying] * closing
        squares[flying] += closing * closing
        flying = flying[x[flying] > 0.0]
    rest = alpha * alpha - kappa / (1.0 + ratio) * squares
    return [math.sqrt(square) if square > 0.0 else None for square in rest]


def none_for_nan(speeds):
    return [speed if speed == speed else None for speed in speeds]


def by_package(all_hops):
    # A program makes its maps before it needs images.
    pairs = [(passive_hopper.LiftOffMap(ratio), alpha) for ratio, alpha in all_hops]
    return lambda hops: none_for_nan([image(alpha) for image, alpha in pairs[: len(hops)]])


def by_package_arrays(hops):
    """The time of a hop in arrays of a million speeds of the same window, and each hop in an array of its own."""
    maps = [passive_hopper.LiftOffMap(ratio) for ratio, _ in hops]
    found = [float(image(numpy.full(32, alpha))[0]) for image, (_, alpha) in zip(maps, hops)]
    least, most = min(alpha for _, alpha in hops), max(alpha for _, alpha in hops)
    speeds = least + (most - least) * (numpy.arange(10**6) * 0.7548776662466927 % 1.0)
    times = []
    # Every hundredth map: light and heavy lower masses.
    for image in maps[::100]:
        begin = time.perf_counter()
        image(speeds)
        times.append(time.perf_counter() - begin)
    name = f"passive_hopper {passive_hopper.__version__} in Python, arrays"
    return {"name": name, "seconds": sum(times) / len(times) / len(speeds), "next": none_for_nan(found)}


def measure(name, run, hops, repeats):
    """Once to warm up, then the median of some runs."""
    run(hops[:16])
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        found = run(hops)
        times.append(time.perf_counter() - begin)
    return {"name": name, "seconds": sorted(times)[repeats // 2] / len(hops), "next": found}


def main():
    with open(sys.argv[1]) as file:
        hops = [tuple(hop) for hop in json.load(file)]
    lanes = heyoka.recommended_simd_size()
    results = [
        measure(f"SciPy {scipy.__version__}, DOP853, events, 1e-10", by_scipy, hops[:200], 1),
        measure(f"NumPy {numpy.__version__}, closed form, scan and bisect at once", by_numpy, hops, 5),
        measure(f"numba {numba.__version__}, closed form, scan and bisect", by_numba, hops, 5),
        measure(f"heyoka {heyoka.__version__}, terminal event", heyoka_scalar(), hops, 5),
        measure(f"heyoka {heyoka.__version__}, batch of {lanes}", heyoka_batch(), hops, 5),
        measure(f"heyoka {heyoka.__version__}, batch of {lanes}, first flights alone", heyoka_flights(), hops, 5),
        measure(f"passive_hopper {passive_hopper.__version__} in Python, one by one", by_package(hops), hops, 5),
        by_package_arrays(hops),
    ]
    with open(sys.argv[2], "w") as file:
        json.dump(results, file)


main()
