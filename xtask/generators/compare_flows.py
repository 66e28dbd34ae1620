"""Compares enclosed boxes with points that are followed in 30 digits: python compare_flows.py < RECORDS.

The records are those of the example `random_boxes` of validated-dynamics. Of each start box a corner and a point inside are followed, by power series
with short steps, without enclosures. They must be in the enclosed box.
"""

import json
import random
import sys

from flint import arb, ctx

from any_model.flows import Field, horner, solution, terms
from any_model.formulas import read

# 30 digits and some more, for sums. 60 digits take fifteen times as long, and agree (420 points).
BITS = 128
# The order of the series, and the part of the radius of convergence that a step takes: 10^-30 is left.
ORDER = 30
PART = 10


def followed(field, point, time):
    """The state after a time."""
    left = arb(time)
    while left > 0:
        series = [terms(own, ORDER) for own in solution(field, point, ORDER)]
        # The last coefficients tell the radius.
        largest = max(float(abs(own[k]).upper()) ** (1 / k) for own in series for k in (ORDER - 1, ORDER) if own[k] != 0)
        step = arb(1 / (PART * largest))
        step = step if step < left else left
        point = [arb(horner(own, step).mid()) for own in series]
        left = arb((left - step).mid())
    return point


def main():
    ctx.prec = BITS
    generator = random.Random(7)
    total = outside = 0
    for line in sys.stdin:
        record = json.loads(line)
        field = Field(record["names"], {}, [read(rate) for rate in record["rates"]])
        corner = [arb(generator.choice(side)) for side in record["start"]]
        inside = [arb(low) + (arb(high) - arb(low)) * arb(generator.random()) for low, high in record["start"]]
        for point in (corner, [arb(x.mid()) for x in inside]):
            total += 1
            end = followed(field, point, record["time"])
            if not all(low <= x and x <= high for x, (low, high) in zip(end, record["end"])):
                outside += 1
                print(f"outside: {line.strip()}")
    print(f"{total} points of enclosed boxes, {outside} outside")
    return int(outside > 0 or total == 0)


if __name__ == "__main__":
    sys.exit(main())
