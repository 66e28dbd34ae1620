"""A user's own system with events, and basins, from Python: seconds of a run, of each of many starts, and of rasters.

python systems.py results.json labels.bin
"""

import json
import sys
import time

import heyoka
import nonsmooth
import numpy
import passive_hopper

END, STARTS, BATCH, REPEATS, SIDE = 400.0, 1000, 8, 15, 512
RESTITUTION = 0.8
LEFT, RIGHT = -1.0, 0.4


def starts():
    return numpy.stack([LEFT + (RIGHT - LEFT) * numpy.arange(STARTS) / STARTS, numpy.ones(STARTS)], axis=1)


def least(run, repeats=REPEATS):
    """The least time of some runs, and the last result."""
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        found = run()
        times.append(time.perf_counter() - begin)
    return min(times), found


def by_heyoka():
    x, v = heyoka.make_vars("x", "v")
    field = [(x, v), (v, heyoka.cos(1.3 * heyoka.time) - 0.1 * v - x)]
    count = [0]

    def impact(motion, sign):
        motion.state[1] *= -RESTITUTION
        count[0] += 1
        return True

    def impact_of(motion, sign, lane):
        motion.state[1, lane] *= -RESTITUTION
        return True

    rising = heyoka.event_direction.positive
    one = heyoka.taylor_adaptive(field, [0.0, 1.0], t_events=[heyoka.t_event(x - 0.5, direction=rising, callback=impact)], tol=1e-15)
    all_starts = starts().T
    many = heyoka.taylor_adaptive_batch(
        field, all_starts[:, :BATCH].copy(), t_events=[heyoka.t_event_batch(x - 0.5, direction=rising, callback=impact_of)], tol=1e-15
    )

    def run():
        one.time, one.state[:], count[0] = 0.0, [0.0, 1.0], 0
        one.reset_cooldowns()
        one.propagate_until(END)
        return [float(number) for number in one.state], count[0]

    def batches():
        for first in range(0, STARTS, BATCH):
            many.set_time(0.0)
            many.state[:] = all_starts[:, first : first + BATCH]
            many.reset_cooldowns()
            many.propagate_until(END)

    return run, batches


def ours():
    return nonsmooth.System(
        lambda t, x, p: [x[1], numpy.cos(1.3 * t) - 0.1 * x[1] - x[0]],
        states="x v",
        parameters={"restitution": RESTITUTION},
        guards=[nonsmooth.Guard("stop", lambda t, x, p: x[0] - 0.5, "rising", reset=lambda t, x, p: [x[0], -p.restitution * x[1]])],
    )


results, labels = sys.argv[1:]
run, batches = by_heyoka()
system = ours()
heyoka_one, (heyoka_end, heyoka_events) = least(run)
own_one, own = least(lambda: system.run([0.0, 1.0], END))
heyoka_many, _ = least(batches, 3)
own_many, _ = least(lambda: system.fates(starts(), END), 3)
raster, (_, _, numbers) = least(lambda: passive_hopper.basin_labels(shape=(SIDE, SIDE)), 5)
numbers.tofile(labels)
with open(results, "w") as file:
    json.dump(
        {
            "heyoka": heyoka.__version__,
            "one": [heyoka_one, own_one],
            "each": [heyoka_many / STARTS, own_many / STARTS],
            "raster": raster,
            "end": [heyoka_end, own.end.tolist()],
            "events": [heyoka_events, len(own.events)],
        },
        file,
    )
