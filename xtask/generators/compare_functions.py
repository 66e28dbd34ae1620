"""Compares enclosures of sine, cosine and arc tangent with Arb: python compare_functions.py < RECORDS.

The records are those of the example `wave_enclosures` of interval-arithmetic. An enclosure must hold the values at both
ends of its argument, in its middle, and at a multiple of pi/2 inside; and that of a point may be at most four ulps of
its value wide.
"""

import math
import struct
import sys

from flint import arb, ctx

RECORD = struct.Struct("<8d")
# Values below the smallest normal number have ulps of this size.
SMALLEST = 5e-324
ULPS = 4


def ulp(value):
    return max(SMALLEST, math.ulp(value))


def places(low, high):
    yield arb(low)
    if low < high:
        yield arb(high)
        yield arb(0.5 * (low + high))
        half = arb.pi() / 2
        first = math.ceil(low / (math.pi / 2))
        for k in range(first, first + 3):
            inside = k * half
            if low < inside and inside < high:
                yield inside


def main():
    ctx.prec = 200
    wrong = wide = count = 0
    widest = 0.0
    data = sys.stdin.buffer.read()
    for low, high, *bounds in RECORD.iter_unpack(data):
        count += 1
        for place in places(low, high):
            sine, cosine = place.sin_cos()
            for at, value in enumerate((sine, cosine, place.atan())):
                least, most = bounds[2 * at], bounds[2 * at + 1]
                if not (least <= value and value <= most):
                    # Ends at an extremum are met exactly, which a ball does not tell.
                    if not (abs(least) == 1 or abs(most) == 1) or value < least or value > most:
                        wrong += 1
                        print(f"function {at} of [{low!r}, {high!r}]: [{least!r}, {most!r}] does not hold {value}")
        if low == high:
            for at in range(3):
                least, most = bounds[2 * at], bounds[2 * at + 1]
                ulps = (most - least) / ulp(max(abs(least), abs(most)))
                widest = max(widest, ulps)
                wide += ulps > ULPS
    print(
        f"{count} arguments: {wrong} values outside, {wide} enclosures of points wider than {ULPS} ulps; the widest has"
        f" {widest:.0f}"
    )
    return int(count == 0 or wrong > 0 or wide > 0)


if __name__ == "__main__":
    sys.exit(main())
