"""Which guards are crossed on a step, by which states, and where."""

from flint import arb, arb_mat

from certificate_file import Unconfirmed

from .formulas import Balls
from .sets import column, common, identity, list_of

# How often a step is halved where a guard may be zero.
HALVES = 12
# The most steps of Newton's method for the time at which the centre crosses.
NEWTON_STEPS = 12


def times(low, high):
    return arb(low).union(arb(high))


class Guards:
    """The guards of a mode along a step. `on` says of each one whether it is 0 at the start, at all states."""

    def __init__(self, step, guards, on):
        self.step, self.guards, self.on = step, guards, on

    def check_begin(self):
        """Raises an error unless the states are where the mode flows: not beyond a surface that bounds it."""
        for place, guard in enumerate(self.guards):
            if not guard.bounds_flow or guard.side_after is None:
                continue
            if self.on[place]:
                soon = self.step.guard_over_time(place, times(0, self.step.length / 1024))
                if not soon * guard.side_after < 0:
                    raise Unconfirmed(f"states on {guard.surface} may begin beyond it")
            elif not self.step.guard_at(place, arb(0)) * guard.side_after < 0:
                raise Unconfirmed(f"states may begin beyond {guard.surface}")

    def check_clear(self, until, apart_from=None):
        """Raises an error unless no guard has an event up to a time."""
        for place, guard in enumerate(self.guards):
            if place != apart_from and self.first_open(place, arb(0), until) is not None:
                raise Unconfirmed(f"states may cross {guard.surface}")

    def is_clear(self, place, low, high):
        """True if no state crosses in a direction that counts, at times of the interval beyond its start."""
        guard, during = self.guards[place], times(low, high)
        if low == 0 and self.on[place]:
            soon = self.step.guard_over_time(place, during)
            if soon != 0:
                is_beyond = guard.side_after is not None and soon * guard.side_after > 0
                if not (guard.bounds_flow and is_beyond):
                    return True
        if self.step.guard_at(place, during) != 0:
            return True
        return guard.side_after is not None and self.step.guard_rate_at(place, during) * guard.side_after < 0

    def first_open(self, place, low, high, halves=HALVES):
        """A time before which no state crosses; None if none does."""
        if self.is_clear(place, low, high):
            return None
        middle = ((low + high) / 2).mid()
        if halves == 0:
            return low
        found = self.first_open(place, low, middle, halves - 1)
        return found if found is not None else self.first_open(place, middle, high, halves - 1)

    def crossing(self, place, until):
        """The times at which all states cross a surface for the first time, with no other event before."""
        guard, step = self.guards[place], self.step
        low = self.first_open(place, arb(0), until)
        if low is None:
            raise Unconfirmed(f"no state crosses {guard.surface}")
        before = step.guard_at(place, low)
        side = guard.side_after
        if side is None:
            side = -1 if before > 0 else 1
        if not before * side < 0:
            raise Unconfirmed(f"states may be on {guard.surface} before they cross it")
        high = self._time_beyond(place, low, until, side)
        during = times(low, high)
        if not step.guard_rate_at(place, during) * side > 0:
            raise Unconfirmed(f"states may touch {guard.surface} without crossing it")
        found = newton(
            during, lambda time: step.guard_at(place, time), lambda time: step.guard_rate_at(place, time)
        )
        self.check_clear(found.upper(), apart_from=place)
        return found, during

    def _time_beyond(self, place, low, until, side):
        """A time at which all states are beyond, as soon as possible."""
        for halves in range(HALVES, -1, -1):
            time = low + (until - low) / 2**halves
            time = time.mid() if halves else until
            if self.step.guard_at(place, time) * side > 0:
                return time
        raise Unconfirmed(f"not all states are beyond {self.guards[place].surface} at the end")

    def image(self, place, found, during):
        """Where the states are when they cross: from the centre, the derivatives of all, and a box."""
        step, guard = self.step, self.guards[place]
        of_centre = newton(
            during,
            lambda time: step.guard_of_centre(place, time),
            lambda time: step.guard_rate_of_centre(place, time),
        )
        at_centre = step.centre_at(of_centre)
        varied = step.derivatives_at(found)
        box = step.states_at(found)
        for _ in range(2):
            derivatives = self._projection(guard, list_of(box)) * varied
            spread = derivatives * step.start.directions * step.start.offsets
            box = column([common(a, b) for a, b in zip(list_of(box), list_of(at_centre + spread))])
        return at_centre, self._projection(guard, list_of(box)) * varied, box

    def _projection(self, guard, box):
        """I - f grad g / (grad g . f). A surface that is a value of one component does not change this component."""
        field, size = self.step.field, len(box)
        rates = field.values(field.field, box, Balls)
        _, (gradient,) = field.with_derivatives([guard.tree], box)
        along = sum((a * b for a, b in zip(gradient, rates)), arb(0))
        if not along != 0:
            raise Unconfirmed(f"states may touch {guard.surface} without crossing it")
        moved = [i for i in range(size) if not gradient[i] == 0]
        if len(moved) == 1:
            (axis,) = moved
            rows = [list(row) for row in identity(size).tolist()]
            for row in range(size):
                rows[row][axis] = arb(0) if row == axis else -rates[row] / rates[axis]
            return arb_mat(rows)
        return identity(size) - arb_mat([[rates[i] * gradient[j] / along for j in range(size)] for i in range(size)])


def newton(during, value, rate):
    """Narrower times at which a function is zero, which it is at one time of the ball at least."""
    for _ in range(NEWTON_STEPS):
        slope = rate(during)
        if not slope != 0:
            break
        middle = arb(during.mid())
        narrower = common(middle - value(middle) / slope, during)
        if not narrower.rad() < during.rad() * 0.9:
            break
        during = narrower
    return during
