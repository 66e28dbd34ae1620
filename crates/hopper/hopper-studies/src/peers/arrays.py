"""Images of one array of speeds for some mass ratios, with this repository's package: seconds a hop, and the images.

python arrays.py job.json speeds.bin seconds.json images.bin
"""

import json
import sys
import time

import numpy
import passive_hopper

job, speeds, seconds, images = sys.argv[1:]
with open(job) as file:
    job = json.load(file)
speeds = numpy.fromfile(speeds)
least = []
with open(images, "wb") as file:
    for ratio in job["ratios"]:
        image = passive_hopper.LiftOffMap(ratio)
        # The first large array of a process waits for its memory, which later ones use again.
        image(speeds)
        times = []
        for _ in range(job["repeats"]):
            begin = time.perf_counter()
            found = image(speeds)
            times.append(time.perf_counter() - begin)
        least.append(min(times) / len(speeds))
        found.tofile(file)
with open(seconds, "w") as file:
    json.dump(least, file)
