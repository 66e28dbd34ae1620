"""Runs of certificates: each step is confirmed by itself, from the set before it into the set behind it."""

import math

from flint import arb, arb_mat

from certificate_file import Refuted, Unconfirmed

from .crossings import Guards
from .flows import Step
from .formulas import Balls
from .sets import WrittenSet, column, list_of
from .systems import SectionMap

# The errors that are tried for the series of a step, as parts of the width of the set behind it. A wrong step costs all of them.
ERRORS = (1e-2, 1e-4, 1e-8)
# The errors of derivatives whose product is wanted, as parts of those: multipliers are known to twelve digits then.
OF_DERIVATIVES = 1e-10


class Run:
    """A run that is confirmed: where the map leads its start, with the derivatives."""

    def __init__(self, model, line, with_derivatives=False):
        self.model, self.with_derivatives = model, with_derivatives
        self.start = WrittenSet(line["start"])
        if self.start.size != len(model.variables):
            raise Refuted("a run whose start is in other variables than its map")
        # The derivatives of the coordinates along a set's directions with respect to the variables.
        self.chain = self.start.inverse()
        self.stopped = None
        if isinstance(model, SectionMap):
            self.set = self._applied(model.chart, self.start, WrittenSet(line["begin"]), "begin")
            _Replay(self).run(line["steps"])
            end = model.end
        else:
            self.set = self.start
            if len(line["steps"]) != model.times or line["begin"] is not None:
                raise Refuted(f"a run of {len(line['steps'])} steps of a map that is applied {model.times} times")
            for place, step in enumerate(line["steps"]):
                if len(step) != 2 or step[0] != "applied":
                    raise Refuted("a step that is not one of a map")
                self.set = self._applied(model.field, self.set, WrittenSet(step[1]), f"step {place}")
            end = None
        if self.stopped is not None and line["image"] is None:
            self.image = None
        elif end is not None:
            self.image = self._applied(end, self.set, WrittenSet(line["image"]), "image")
        else:
            self.image = self._first_components(WrittenSet(line["image"]))

    def derivatives(self):
        """The derivatives of what is read with respect to the variables of the start."""
        return self.image.directions * self.chain

    def carried(self, start, target, at_centre, derivatives, where):
        """The next set, which holds the image of the one before."""
        try:
            target.holds(at_centre, derivatives, start)
        except Unconfirmed as error:
            raise Unconfirmed(f"{where}: {error}")
        if self.with_derivatives:
            self.chain = target.inverse() * derivatives * start.directions * self.chain
        return target

    def _applied(self, field, start, target, where):
        """Formulas, by their value at the centre and their derivatives on the set."""
        if target.size != len(field.field):
            raise Refuted(f"{where}: a set of another size than its formulas")
        at_centre = column(field.values(field.field, list_of(start.centre), Balls))
        _, parts = field.with_derivatives(field.field, list_of(start.hull))
        return self.carried(start, target, at_centre, arb_mat(parts), where)

    def _first_components(self, target):
        """The variables without the parameters, which stay behind them."""
        size, count = self.set.size, self.model.dimension
        if target.size != count:
            raise Refuted("image: a set of another size than the map's")
        first = arb_mat([[int(row == other) for other in range(size)] for row in range(count)])
        return self.carried(self.set, target, first * self.set.centre, first, "image")


class _Replay:
    """The steps of a run of a system, one after the other."""

    def __init__(self, run):
        self.run_of, self.system = run, run.model.system
        self.mode, self.on = run.model.mode, run.model.on
        self.begins, self.left = True, run.model.count

    def run(self, steps):
        for place, line in enumerate(steps):
            where = f"step {place} of {len(steps)}"
            if self.left == 0 or self.run_of.stopped is not None:
                raise Refuted(f"{where}: it is behind the end of the run")
            self.guards = self.system.guards[self.mode]
            if line[0] == "flow" and len(line) == 3:
                self.tried(where, self.flow, line[1], WrittenSet(line[2]))
            elif line[0] == "pass" and len(line) == 4:
                self.tried(where, self.cross, line[2], WrittenSet(line[3]), line[1])
            elif line[0] == "event" and len(line) == 4:
                self.tried(where, self.event, line[2], WrittenSet(line[3]), line[1])
            else:
                raise Refuted(f"{where}: no step")
        if self.left > 0 and self.run_of.stopped is None:
            raise Refuted(f"the run ends before {self.run_of.model.surface}")

    def tried(self, where, action, length, target, *arguments):
        """A step, with narrower series where wide ones do not do."""
        if isinstance(length, bool) or not isinstance(length, (int, float)) or not length > 0:
            raise Refuted(f"{where}: a step of the length {length!r}")
        if target.size != self.run_of.set.size:
            raise Refuted(f"{where}: a set of another size")
        why = None
        trees, widths = [guard.tree for guard in self.guards], [float(x.rad()) for x in list_of(target.hull)]
        # The set behind an event is hardly wider than rounding across its surface.
        least = math.inf if action == self.flow else min(float(radius) for radius in target.radii)
        slopes = OF_DERIVATIVES if self.run_of.with_derivatives else 1
        for part in ERRORS:
            try:
                errors = [part * width for width in widths], part * slopes, part * least
                step = Step(self.system.fields[self.mode], self.run_of.set, length, trees, errors)
                seen = Guards(step, self.guards, self.on)
                if self.begins:
                    seen.check_begin()
                return action(where, step, seen, target, *arguments)
            except Unconfirmed as error:
                why = error
        raise Unconfirmed(why if str(why).startswith(where) else f"{where}: {why}")

    def flow(self, where, step, seen, target):
        seen.check_clear(step.length)
        self._flowed(where, step, target)

    def _flowed(self, where, step, target):
        run = self.run_of
        run.set = run.carried(run.set, target, step.centre_at(step.length), step.derivatives_at(step.length), where)
        self.on, self.begins = [False] * len(self.guards), False

    def place_of(self, surface, where):
        found = [place for place, guard in enumerate(self.guards) if guard.surface == surface]
        if len(found) != 1:
            raise Refuted(f"{where}: the mode {self.mode} has no surface {surface!r}, or more than one")
        return found[0]

    def cross(self, where, step, seen, target, surface):
        """All states cross a surface that changes nothing, or at which no state has an event."""
        place = self.place_of(surface, where)
        found, during = seen.crossing(place, step.length)
        _, _, box = seen.image(place, found, during)
        is_event = self._holds(self.guards[place], box)
        if is_event and not self.guards[place].observes(self.mode):
            raise Unconfirmed(f"{where}: {surface} changes the states")
        seen.check_clear(step.length, apart_from=place)
        if not step.guard_rate_at(place, found.union(step.length)) != 0:
            raise Unconfirmed(f"{where}: states may cross {surface} once more")
        self._flowed(where, step, target)
        self.left -= int(is_event and surface == self.run_of.model.surface)
        if self.left == 0:
            raise Refuted(f"{where}: the run goes on behind its end")

    def event(self, where, step, seen, target, surface):
        run, place = self.run_of, self.place_of(surface, where)
        guard = self.guards[place]
        found, during = seen.crossing(place, step.length)
        at_centre, derivatives, box = seen.image(place, found, during)
        if not self._holds(guard, box):
            raise Unconfirmed(f"{where}: no state has an event at {surface}")
        if guard.after is not None:
            field = step.field
            _, parts = field.with_derivatives(guard.after, list_of(box))
            at_centre = column(field.values(guard.after, list_of(at_centre), Balls))
            derivatives = arb_mat(parts) * derivatives
        run.set = run.carried(run.set, target, at_centre, derivatives, where)
        self.left -= int(surface == run.model.surface)
        if guard.observes(self.mode) and self.left > 0:
            raise Refuted(f"{where}: {surface} changes nothing: the flow goes on through it")
        self.mode, self.on, self.begins = guard.mode, self.system.begins_on(guard), True
        run.stopped = surface if guard.stops else None

    def _holds(self, guard, box):
        """Whether the condition of an event holds, at all states."""
        if guard.condition is None:
            return True
        value = self.system.fields[self.mode].values([guard.condition], list_of(box), Balls)[0]
        if not value != 0:
            raise Unconfirmed(f"the condition of {guard.surface} may hold or not")
        return value > 0


def box_of(pairs):
    """A box of a line, as intervals of floats."""
    if not isinstance(pairs, list) or not pairs:
        raise Refuted("no box")
    for pair in pairs:
        if not isinstance(pair, list) or len(pair) != 2 or not all(type(x) in (int, float) for x in pair):
            raise Refuted(f"{pair!r} is no interval")
        if not pair[0] <= pair[1]:
            raise Refuted(f"{pair!r} is no interval")
    return [(pair[0], pair[1]) for pair in pairs]


def ball_box(box):
    """The balls about the intervals of a box."""
    return column([arb(low).union(arb(high)) for low, high in box])


def check_start(run, box, transform=None):
    """Raises an error unless a run starts from all points of a box, moved by a centre and directions if they are given."""
    points = ball_box(box)
    if transform is not None:
        centre, directions = transform
        inverse = run.start.inverse()
        # The offset of each point, in the directions of the written start: correlations stay.
        middle = column([(arb(low) + arb(high)) / 2 for low, high in box])
        half = column([((arb(high) - arb(low)) / 2) for low, high in box])
        offset = inverse * (centre + directions * middle - run.start.centre)
        spread = inverse * directions
        for row, radius in enumerate(run.start.radii):
            reach = abs(offset[row, 0]) + sum((abs(spread[row, k]) * half[k, 0] for k in range(len(box))), arb(0))
            if not reach <= radius:
                raise Refuted("a run does not start from all points of its part")
        return
    own = run.start.inverse() * (points - run.start.centre)
    for row, radius in enumerate(run.start.radii):
        if not abs(own[row, 0]) <= radius:
            raise Refuted("a run does not start from all points of its part")
