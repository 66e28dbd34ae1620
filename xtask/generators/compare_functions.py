"""Compares enclosures of functions with Arb: python compare_functions.py < RECORDS.

The records are those of the example `function_enclosures` of interval-arithmetic. An enclosure must hold the values at
the ends and in the middle of its arguments, and at a multiple of pi/2 inside. That of a point may be so many ulps wide.
A function may refuse only arguments outside its domain.
"""

import math
import struct
import sys

from flint import arb, ctx

RECORD = struct.Struct("<7d")
# Values below the smallest normal number have ulps of this size.
SMALLEST = 5e-324
INFINITY = float("inf")


def exponent(y):
    """The integer exponent that the example takes from a number."""
    size = struct.unpack("<Q", struct.pack("<d", y))[0] % 41
    return -size if y < 0 else size


def power(x, y):
    return (y * x.log()).exp() if x > 0 else arb(1 if y == 0 else 0)


def angle(y, x):
    return arb.atan2(y, x)


def always(x, y):
    return True


def at_most_1(x, y):
    return abs(x) <= 1


# Name, value, domain, and the largest width at a point in ulps. Powers next to the smallest numbers are squares.
FUNCTIONS = [
    ("sin", lambda x, y: x.sin(), always, 4),
    ("cos", lambda x, y: x.cos(), always, 4),
    ("tan", lambda x, y: x.tan(), always, 6),
    ("arctan", lambda x, y: x.atan(), always, 4),
    ("asin", lambda x, y: x.asin(), at_most_1, 6),
    ("acos", lambda x, y: x.acos(), at_most_1, 6),
    ("exp", lambda x, y: x.exp(), always, 6),
    ("ln", lambda x, y: x.log(), lambda x, y: x > 0, 6),
    ("sinh", lambda x, y: x.sinh(), always, 6),
    ("cosh", lambda x, y: x.cosh(), always, 6),
    ("tanh", lambda x, y: x.tanh(), always, 6),
    ("asinh", lambda x, y: x.asinh(), always, 6),
    ("acosh", lambda x, y: x.acosh(), lambda x, y: x >= 1, 6),
    ("atanh", lambda x, y: x.atanh(), lambda x, y: abs(x) < 1, 6),
    ("sqrt", lambda x, y: x.sqrt(), lambda x, y: x >= 0, 3),
    ("powi", None, always, 16),
    ("powf", power, lambda x, y: x > 0 or (x == 0 and y >= 0), 16),
    ("atan2", angle, lambda x, y: not (x == 0 and y == 0), 6),
    ("divide", lambda x, y: x / y, lambda x, y: y != 0, 3),
]


def places(low, high, waves):
    yield low
    if low < high:
        yield high
        yield 0.5 * low + 0.5 * high
        if waves and abs(low) < 1e10:
            half = arb.pi() / 2
            first = math.ceil(low / (math.pi / 2))
            for k in range(first, first + 3):
                if low < k * half and k * half < high:
                    yield k * half


def inside(least, most, value):
    """True if the value is inside for certain, or is an end as far as a ball of 200 bits tells: at extrema it is."""
    if not value.is_finite():
        # A pole, or a value that is too large for Arb.
        return least == -INFINITY or most == INFINITY
    return (least <= value and value <= most) or value.overlaps(arb(least)) or value.overlaps(arb(most))


def main():
    ctx.prec = 200
    arguments, wrong, wide, refused = 0, 0, 0, 0
    checked = [0] * len(FUNCTIONS)
    widest = [0.0] * len(FUNCTIONS)
    data = sys.stdin.buffer.read()
    for place, x_low, x_high, y_low, y_high, least, most in RECORD.iter_unpack(data):
        at = int(place)
        name, function, domain, ulps = FUNCTIONS[at]
        arguments += at == 0
        takes_two = at >= 16
        if name == "powi":
            whole = exponent(y_low)
            function, domain = (lambda x, y: x**whole), (lambda x, y: whole >= 0 or x != 0)
        ys = list(places(y_low, y_high, False)) if takes_two else [y_low]
        for x in places(x_low, x_high, at < 3):
            for y in ys:
                if not domain(x, y):
                    continue
                if math.isnan(least):
                    # All of the numbers must be in the domain, not this one alone.
                    others = [domain(end, other) for end in (x_low, x_high) for other in ys]
                    refused += all(others) and not (name == "atanh" and max(abs(x_low), abs(x_high)) > 1)
                    continue
                value = function(arb(x), arb(y))
                checked[at] += 1
                if not inside(least, most, value):
                    wrong += 1
                    print(
                        f"{name} of [{x_low!r}, {x_high!r}], [{y_low!r}, {y_high!r}]:"
                        f" [{least!r}, {most!r}] does not hold {value}"
                    )
        size = max(abs(least), abs(most))
        # The place of a larger argument among the multiples of pi is not looked for.
        far = at < 3 and abs(x_low) > 1e9
        if x_low == x_high and (y_low == y_high or not takes_two) and size < 1e300 and not far:
            width = (most - least) / max(SMALLEST, math.ulp(size))
            widest[at] = max(widest[at], width)
            if width > ulps:
                wide += 1
                if wide < 20:
                    print(f"{name} of {x_low!r}, {y_low!r}: [{least!r}, {most!r}] is {width:.0f} ulps wide")
    table = ", ".join(f"{f[0]} {w:.0f}" for f, w in zip(FUNCTIONS, widest))
    print(f"widest enclosures of points, in ulps: {table}")
    print(
        f"{arguments} arguments of {len(FUNCTIONS)} functions: {wrong} of {sum(checked)} values outside, {wide} enclosures of"
        f" points too wide, {refused} refused without a reason"
    )
    return int(min(checked) == 0 or wrong > 0 or wide > 0 or refused > 0)


if __name__ == "__main__":
    sys.exit(main())
