"""One step of a flow: power series in balls, with a remainder from Cauchy's estimate.

Solutions from a set stay in complex boxes about it for all complex times up to R: the boxes grow outwards by the largest
speed on the next ones. They are analytic there, and so are their derivatives with respect to the start, which grow by exp(R M) at
most for a bound M of the Jacobian. So coefficients fall like R^-k, and what a series of order p leaves is bounded.
"""

import math

from flint import acb, arb, arb_mat, arb_series, ctx

from certificate_file import Unconfirmed

from .duals import Dual, Duals, Series
from .formulas import Balls, Complex, Program
from .sets import column, common, identity, list_of

# The radii of the discs, as multiples of a step's length, that are tried: a large one needs few coefficients.
DISCS = (8, 5, 3.5, 2.5, 2, 1.6, 1.3)
# The pieces in which a complex box grows. More of them allow larger discs.
PIECES = 24
# The least order of a series, and the largest one: a step that needs more is too long.
LEAST_ORDER, LARGEST_ORDER = 8, 200
# How often a box of a piece is widened until it holds.
TRIES = 12


class Field:
    """The formulas of a mode, with the values of the parameters."""

    def __init__(self, states, parameters, field):
        self.states, self.parameters, self.field = states, parameters, field
        self.programs = {}

    def values(self, trees, x, kind):
        """The values of trees at a state."""
        key = tuple(trees)
        if key not in self.programs:
            self.programs[key] = Program(trees, self.states, self.parameters)
        return self.programs[key].run(x, kind)

    def with_derivatives(self, trees, x, kind=Balls):
        """Values and derivatives at a state, as lists."""
        one, zero = kind.number(arb(1)), kind.number(arb(0))
        size = len(x)
        duals = [Dual(value, [one if j == i else zero for j in range(size)]) for i, value in enumerate(x)]
        found = self.values(trees, duals, Duals(kind))
        values = [own.value if isinstance(own, Dual) else own for own in found]
        parts = [own.parts if isinstance(own, Dual) else [zero] * size for own in found]
        return values, parts


class Step:
    """All solutions from a written set for some time."""

    def __init__(self, field, start, length, guards, errors):
        """A step of this length. The order follows from the errors that may be made: of each component, of the derivatives, of guards."""
        self.field, self.start, self.length, self.guards = field, start, arb(length), guards
        self.size = start.size
        self._bounds(errors)
        self._series()

    def _bounds(self, errors):
        """The disc, the complex boxes, and bounds of coefficients."""
        best = None
        for multiple in DISCS:
            found = self._bounds_in(self.length * arb(multiple), errors)
            if found is not None and best is not None and found[0] >= best[0]:
                break
            best = found if found is not None else best
        if best is None:
            raise Unconfirmed(f"solutions have no bound for complex times up to {DISCS[-1]} steps")
        self.order, radius, rates, growth, guards, slopes = best
        if self.order > LARGEST_ORDER:
            raise Unconfirmed(f"a series of order {self.order} would be needed")
        p, q = self.order, self.length / radius
        # A solution's coefficient k is at most its speed's variation on the boxes, over k R^(k-1); a guard's is its own over R^k.
        tail = q ** (p + 1) / (1 - q)
        slow = radius * tail / (p + 1)
        rate_tail = q**p * ((p + 1) - p * q) / ((1 - q) ** 2 * radius)
        grown = growth - identity(self.size)
        self.rest = [around(rate * slow) for rate in rates]
        self.rest_of_derivatives = [[around(grown[i, j] * tail) for j in range(self.size)] for i in range(self.size)]
        ranges = range(len(self.guards))
        self.rest_of_guards = [(around(guards[g] * tail), around(guards[g] * rate_tail)) for g in ranges]
        self.rest_of_slopes = [
            [(around(slopes[g, j] * tail), around(slopes[g, j] * rate_tail)) for j in range(self.size)] for g in ranges
        ]

    def _bounds_in(self, radius, errors):
        """For a disc: the order that is needed, the disc, the boxes, and bounds of speeds and of the growth of derivatives; or None."""
        boxes = self._complex_boxes(radius)
        if boxes is None:
            return None
        try:
            values, parts = self.field.with_derivatives(self.field.field, boxes, Complex)
            guards, slopes = self.field.with_derivatives(self.guards, boxes, Complex)
        except Unconfirmed:
            return None
        rates = [spread(value) for value in values]
        growth = (radius * arb_mat([[size_of(part) for part in row] for row in parts])).exp()
        growth = arb_mat([[growth[i, j].upper() for j in range(self.size)] for i in range(self.size)])
        # The largest growth of a derivative, and how far the error of one may be.
        largest = max(float(growth[i, j]) for i in range(self.size) for j in range(self.size))
        guards = [spread(value) for value in guards]
        slopes = arb_mat([[size_of(part) for part in row] for row in slopes]) * growth if guards else None
        of_states, of_derivatives, of_guards = errors
        sizes = [float(rate * radius) for rate in rates] + [largest] + [float(own) for own in guards]
        if not all(math.isfinite(size) for size in sizes):
            return None
        wanted = [*of_states, of_derivatives] + [of_guards] * len(guards)
        return order_of(sizes, wanted, float(self.length / radius)), radius, rates, growth, guards, slopes

    def _complex_boxes(self, radius):
        """Boxes in which all solutions are for complex times up to a radius, or None."""
        hull = list_of(self.start.hull)
        reach = [arb(0)] * self.size
        piece = radius / PIECES
        try:
            rates = self.field.values(self.field.field, [acb(x) for x in hull], Complex)
            for _ in range(PIECES):
                guess = [r + 2 * piece * size_of(rate) for r, rate in zip(reach, rates)]
                for _ in range(TRIES):
                    boxes = [acb(x + around(r), around(r)) for x, r in zip(hull, guess)]
                    rates = self.field.values(self.field.field, boxes, Complex)
                    found = [(r + piece * size_of(rate)).upper() for r, rate in zip(reach, rates)]
                    if all(new <= old for new, old in zip(found, guess)):
                        break
                    guess = [arb.max(1.2 * new, old) for new, old in zip(found, guess)]
                else:
                    return None
                reach = found
        except Unconfirmed:
            return None
        return [acb(x + around(r), around(r)) for x, r in zip(hull, reach)]

    def _series(self):
        """The coefficients from the centre, from all states, and those of the guards."""
        field, order, size = self.field, self.order, self.size
        ctx.cap = order + 1
        centre = solution(field, list_of(self.start.centre), order)
        states = solution(field, list_of(self.start.hull), order)
        ctx.cap = order + 1
        _, jacobian = self._slopes(field.field, states)
        derivatives = linear_solution(jacobian, order)
        self.guards_of_centre = [terms(own, order) for own in field.values(self.guards, centre, Series)]
        values, slopes = self._slopes(self.guards, states)
        self.guards_of_all = [terms(value, order) for value in values]
        self.slopes_of_guards = [
            [terms(sum((row[i] * derivatives[i][j] for i in range(size)), arb_series([0])), order) for j in range(size)]
            for row in slopes
        ]
        self.centre = [terms(own, order) for own in centre]
        self.states = [terms(own, order) for own in states]
        self.derivatives = [[terms(own, order) for own in row] for row in derivatives]

    def _slopes(self, trees, states):
        """The values of trees along solutions, and their derivatives there, as series."""
        one, zero = arb_series([1]), arb_series([0])
        duals = [Dual(x, [one if j == i else zero for j in range(self.size)]) for i, x in enumerate(states)]
        found = self.field.values(trees, duals, Duals(Series))
        found = [own if isinstance(own, Dual) else Dual(own, [zero] * self.size) for own in found]
        return [own.value for own in found], [own.parts for own in found]

    def centre_at(self, time):
        return column([horner(own, time) + rest for own, rest in zip(self.centre, self.rest)])

    def derivatives_at(self, time):
        return arb_mat(
            [
                [horner(own, time) + rest for own, rest in zip(row, rests)]
                for row, rests in zip(self.derivatives, self.rest_of_derivatives)
            ]
        )

    def states_at(self, time):
        """A box of all states at the times of a ball."""
        plain = [horner(own, time) + rest for own, rest in zip(self.states, self.rest)]
        spread_of = self.derivatives_at(time) * self.start.directions * self.start.offsets
        by_mean = list_of(self.centre_at(time) + spread_of)
        return column([common(a, b) for a, b in zip(plain, by_mean)])

    def guard_at(self, guard, time):
        return self._guard(guard, time, horner, 0)

    def guard_rate_at(self, guard, time):
        return self._guard(guard, time, horner_of_rate, 1)

    def guard_of_centre(self, guard, time):
        return horner(self.guards_of_centre[guard], time) + self.rest_of_guards[guard][0]

    def guard_rate_of_centre(self, guard, time):
        return horner_of_rate(self.guards_of_centre[guard], time) + self.rest_of_guards[guard][1]

    def _guard(self, guard, time, of, which):
        rest, rests = self.rest_of_guards[guard][which], self.rest_of_slopes[guard]
        plain = of(self.guards_of_all[guard], time) + rest
        if plain != 0:
            return plain
        slopes = [of(own, time) + own_rest[which] for own, own_rest in zip(self.slopes_of_guards[guard], rests)]
        offset = arb_mat([slopes]) * self.start.directions * self.start.offsets
        return common(plain, of(self.guards_of_centre[guard], time) + rest + offset[0, 0])

    def guard_over_time(self, guard, time):
        """A guard that is 0 at the time 0, divided by the time: its coefficients from the first on."""
        # The remainder at a time is at most that at the end, by a power of the time of at least one.
        rest = self.rest_of_guards[guard][0] / self.length
        return horner(self.guards_of_all[guard][1:], time) + rest


def order_of(sizes, errors, q):
    """The order at which what is left of each component is smaller than its error."""
    order = LEAST_ORDER
    for size, error in zip(sizes, errors):
        if size > 0 and 0 < error < math.inf:
            order = max(order, math.ceil(math.log(error * (1 - q) / size) / math.log(q)))
    return order


def solution(field, start, order):
    """The power series of a solution, coefficient by coefficient: the integral of the speed gains one each time."""
    x = [arb_series([value], prec=1) for value in start]
    for k in range(order):
        ctx.cap = k + 1
        rates = [terms(rate, k) for rate in field.values(field.field, x, Series)]
        ctx.cap = k + 2
        x = [
            arb_series([value] + [rate[j] / (j + 1) for j in range(k + 1)], prec=k + 2)
            for value, rate in zip(start, rates)
        ]
    return x


def linear_solution(jacobian, order):
    """The solution of V' = A V from the identity, as series, by the coefficients of A."""
    size = len(jacobian)
    entries = [[terms(own, order) for own in row] for row in jacobian]
    rates = [arb_mat([[entries[i][j][k] for j in range(size)] for i in range(size)]) for k in range(order)]
    found = [identity(size)]
    for k in range(order):
        sum_of = arb_mat(size, size)
        for j in range(k + 1):
            sum_of += rates[j] * found[k - j]
        found.append(sum_of / (k + 1))
    return [[arb_series([own[i, j] for own in found]) for j in range(size)] for i in range(size)]


def terms(series, order):
    """The coefficients up to an order."""
    if isinstance(series, arb_series):
        return [series[k] for k in range(order + 1)]
    return [arb(series)] + [arb(0)] * order


def horner(own, time):
    found = arb(0)
    for c in reversed(own):
        found = found * time + c
    return found


def horner_of_rate(own, time):
    return horner([k * c for k, c in enumerate(own)][1:], time)


def size_of(x):
    return abs(x).upper()


def spread(x):
    """How far a function's values on a box of balls are from each other."""
    return (2 * (x.real.rad() + x.imag.rad())).upper()


def around(radius):
    radius = abs(radius).upper()
    return (-radius).union(radius)
