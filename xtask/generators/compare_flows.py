"""Compares enclosed boxes with points that are followed in 60 digits: python compare_flows.py [DIGITS] < RECORDS.

The records are those of the example `random_boxes` of validated-dynamics: a start box, times, and the enclosed box at each of them. Of each start box a
corner, or a point inside, is followed by power series with short steps, without enclosures. It must be in the enclosed box at each time.
"""

import json
import random
import sys

from flint import arb, ctx

from any_model.flows import Field, horner, solution, terms
from any_model.formulas import read

# More bits than the digits need, for sums.
BITS_OF_DIGIT, MORE_BITS = 3.33, 30
# The part of the radius of convergence that a step takes: a series of as many terms as digits leaves 10^-digits.
PART = 10


def followed(field, point, times, order):
    """The states at growing times."""
    at, series, step = arb(0), None, arb(0)
    for time in times:
        while series is None or at + step < time:
            if series is not None:
                point = [arb(horner(own, step).mid()) for own in series]
                at = arb((at + step).mid())
            series = [terms(own, order) for own in solution(field, point, order)]
            # The last coefficients tell the radius.
            largest = max(float(abs(own[k]).upper()) ** (1 / k) for own in series for k in (order - 1, order) if own[k] != 0)
            step = arb(1 / (PART * largest))
        yield [horner(own, time - at) for own in series]


def main():
    digits = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    ctx.prec = int(BITS_OF_DIGIT * digits) + MORE_BITS
    generator = random.Random(7)
    total = outside = 0
    for number, line in enumerate(sys.stdin):
        record = json.loads(line)
        field = Field(record["names"], {}, [read(rate) for rate in record["rates"]])
        corner = [arb(generator.choice(side)) for side in record["start"]]
        inside = [arb(low) + (arb(high) - arb(low)) * arb(generator.random()) for low, high in record["start"]]
        point = [arb(x.mid()) for x in (inside if number % 2 else corner)]
        times = [arb(time) for time in record["times"]]
        for states, box in zip(followed(field, point, times, digits), record["boxes"], strict=True):
            total += 1
            if not all(low <= x and x <= high for x, (low, high) in zip(states, box)):
                outside += 1
                print(f"outside: {line.strip()}")
    print(f"{total} enclosed boxes, {outside} points outside, {digits} digits")
    return int(outside > 0 or total == 0)


if __name__ == "__main__":
    sys.exit(main())
