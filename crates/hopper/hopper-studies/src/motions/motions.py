"""Motions with known answers by SciPy and by heyoka: the answer and the time of a start, at many tolerances.

python motions.py motions.jsonl results.json

The fields stand in motions.jsonl as texts. heyoka gets symbols for the names, SciPy a function that is compiled from the
texts. heyoka's batches have eight starts, as many as the vectors of ours, and a thousand starts in all.
"""

import json
import math
import sys
import time

import heyoka
import numpy
import scipy
from scipy.integrate import solve_ivp

TOLERANCES = [10.0**-k for k in range(3, 16)]
STARTS, BATCH, APART = 1000, 8, 1e-6
# Time for the runs at one tolerance.
SHARE = 0.1


def function(scene, text):
    """A function of time and state."""
    code = f"lambda t, {', '.join(scene['states'])}: {text}"
    compiled = eval(code, {"sin": math.sin, "cos": math.cos})
    return lambda t, x: compiled(t, *x)


def planets(scene):
    """The field with NumPy: as text it is 18 long sums."""
    gravity = 0.000295912208286
    masses = numpy.array(
        [1.00000597682, 0.000954786104043, 0.000285583733151, 4.37273164546e-5, 5.17759138449e-5, 7.6923076923076923e-9]
    )

    def rates(t, x):
        places = x[:18].reshape(6, 3)
        away = places[None, :, :] - places[:, None, :]
        squares = (away**2).sum(axis=2)
        numpy.fill_diagonal(squares, 1.0)
        pulls = gravity * ((masses * squares**-1.5)[:, :, None] * away).sum(axis=1)
        return numpy.concatenate([x[18:], pulls.ravel()])

    return rates


def scipy_run(scene, tolerance):
    start, end = [float(x) for x in scene["start"]], float(scene["end"])
    name = scene["scene"]
    rates = planets(scene) if name == "outer planets" else function(scene, f"({', '.join(scene['field'])})")
    options = {"method": "DOP853", "rtol": max(tolerance, 3e-14), "atol": tolerance}
    if "guard" not in scene:
        return lambda: solve_ivp(rates, (0.0, end), start, **options).y[:, -1]
    guard = function(scene, scene["guard"])
    event = lambda t, x: guard(t, x)
    if "reset" not in scene:
        return lambda: solve_ivp(rates, (0.0, end), start, events=event, **options).t_events[0][-1:]
    event.terminal, event.direction = True, 1
    jump = function(scene, f"({', '.join(scene['reset'])})")

    def run():
        t, x, last = 0.0, start, []
        while t < end:
            arc = solve_ivp(rates, (t, end), x, events=event, **options)
            t, x = arc.t[-1], arc.y[:, -1]
            if arc.status == 1:
                last, x = [t], jump(t, x)
        return last

    return run


def symbols(scene):
    names = dict(zip(scene["states"], heyoka.make_vars(*scene["states"])))
    names.update({"t": heyoka.time, "sin": heyoka.sin, "cos": heyoka.cos})
    system = [(names[state], eval(text, {}, names) + 0.0) for state, text in zip(scene["states"], scene["field"])]
    return names, system


def heyoka_run(scene, tolerance):
    start, end = [float(x) for x in scene["start"]], float(scene["end"])
    names, system = symbols(scene)
    times, events = [], {}
    if "reset" in scene:
        jump = function(scene, f"({', '.join(scene['reset'])})")

        def impact(integrator, _):
            times.append(integrator.time)
            integrator.state[:] = jump(integrator.time, integrator.state)
            return True

        guard = eval(scene["guard"], {}, names)
        event = heyoka.t_event(guard, direction=heyoka.event_direction.positive, callback=impact)
        events["t_events"] = [event]
    elif "guard" in scene:
        guard = eval(scene["guard"], {}, names) + 0.0
        events["nt_events"] = [heyoka.nt_event(guard, lambda _, t, sign: times.append(t))]
    motion = heyoka.taylor_adaptive(system, start, tol=tolerance, **events)

    def run():
        times.clear()
        motion.time, motion.state[:] = 0.0, start
        motion.reset_cooldowns() if "reset" in scene else None
        motion.propagate_until(end)
        return times[-1:] if events else list(motion.state)

    return run


def heyoka_batches(scene, tolerance):
    start, end = numpy.array([float(x) for x in scene["start"]]), float(scene["end"])
    all_starts = start[:, None] * (1.0 + APART * numpy.arange(STARTS))
    motion = heyoka.taylor_adaptive_batch(symbols(scene)[1], all_starts[:, :BATCH].copy(), tol=tolerance)

    def run():
        answer = None
        for first in range(0, STARTS, BATCH):
            motion.set_time(0.0)
            motion.state[:] = all_starts[:, first : first + BATCH]
            motion.propagate_until(end)
            answer = list(motion.state[:, 0]) if first == 0 else answer
        return answer

    return run


def measure(scene, program, tolerance, run, starts=1):
    begin = time.perf_counter()
    answer = [float(x) for x in run()]
    smallest = time.perf_counter() - begin
    while time.perf_counter() - begin < SHARE:
        start = time.perf_counter()
        run()
        smallest = min(smallest, time.perf_counter() - start)
    return {
        "scene": scene["scene"],
        "program": program,
        "tolerance": tolerance,
        "seconds": smallest / starts,
        "answer": answer,
    }


def main(scenes, output):
    results = []
    with open(scenes, encoding="utf-8") as lines:
        scenes = [json.loads(line) for line in lines]
    by_heyoka, by_scipy = f"heyoka {heyoka.__version__}", f"SciPy {scipy.__version__}"
    for scene in scenes:
        for tolerance in TOLERANCES:
            results.append(measure(scene, by_heyoka, tolerance, heyoka_run(scene, tolerance)))
            if "guard" not in scene:
                run = heyoka_batches(scene, tolerance)
                results.append(measure(scene, f"{by_heyoka}, 1000 starts by 8", tolerance, run, STARTS))
            results.append(measure(scene, by_scipy, tolerance, scipy_run(scene, tolerance)))
    with open(output, "w", encoding="utf-8") as file:
        json.dump(results, file)


main(*sys.argv[1:])
