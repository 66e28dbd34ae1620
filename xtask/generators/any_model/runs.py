"""Runs of certificates: each step is confirmed by itself, from the set before it into the set behind it."""

import math

from flint import arb, arb_mat

from certificate_file import Refuted, Unconfirmed

from .crossings import Guards
from .flows import Step
from .formulas import Balls
from .sets import WrittenSet, column, list_of
from .systems import SectionMap

# The error of a series, as a part of the width of the set behind its step, and that of its derivatives: directions of sets may be nearly
# the same, so that these must be known well.
OF_WIDTH, OF_DERIVATIVES = 1e-8, 1e-16
# How often a set is halved whose image leaves the next one: balls are wider than what they hold, the less so the narrower they are.
HALVINGS = 3


class Run:
    """A run that is confirmed: where the map leads its start, with the derivatives."""

    def __init__(self, model, line, with_derivatives=False):
        self.model, self.with_derivatives = model, with_derivatives
        self.start = WrittenSet.of_line(line["start"])
        if self.start.size != len(model.variables):
            raise Refuted("a run whose start is in other variables than its map")
        # The derivatives of the coordinates along a set's directions with respect to the variables.
        self.chain = self.start.inverse()
        self.stopped = None
        if isinstance(model, SectionMap):
            self.set = self.start
            self._apply(model.chart, line["begin"], "begin")
            arrives = _Replay(self).run(line["steps"])
            end = model.end
        else:
            self.set = self.start
            arrives, count = line["image"] is not None, len(line["steps"])
            if count != model.times or line["begin"] is not None:
                raise Refuted(f"a run of {count} steps of a map that is applied {model.times} times")
            for place, step in enumerate(line["steps"]):
                if len(step) != 2 or step[0] != "applied":
                    raise Refuted("a step that is not one of a map")
                self._apply(model.field, step[1], f"step {place}")
            end = None
            if not arrives:
                self.stopped = model.set_of(self.set.hull)
                if self.stopped is None:
                    raise Unconfirmed("the last images may be in no set of the map")
        self.image = None
        if arrives != (line["image"] is not None):
            raise Refuted("a run that comes to the surface of its map has an image, and no other one")
        if arrives:
            if end is not None:
                self._apply(end, line["image"], "image")
            else:
                self._take_variables(line["image"])
            self.image = self.set

    def derivatives(self):
        """The derivatives of what is read with respect to the variables of the start."""
        return self.image.directions * self.chain

    def check_goes_on(self):
        """Raises an error if the execution ends: nothing comes back then."""
        if self.stopped is not None:
            raise Refuted(f"the execution ends at {self.stopped}")

    def move(self, target, moved):
        """Goes on from the next set, with the derivatives from the one before along the directions of both."""
        if self.with_derivatives:
            self.chain = moved * self.chain
        self.set = target

    def _apply(self, field, line, where):
        """Formulas, by their value at the centre and their derivatives on the set."""
        target = WrittenSet.of_line(line)
        if target.size != len(field.field):
            raise Refuted(f"{where}: a set of another size than its formulas")

        def led(start):
            at_centre = column(field.values(field.field, list_of(start.centre), Balls))
            _, parts = field.with_derivatives(field.field, list_of(start.hull))
            return target.holds(at_centre, arb_mat(parts), start)

        self.move(target, in_parts(led, self.set, where))

    def _take_variables(self, line):
        """The variables without the parameters, which stay behind them."""
        target, size, count = WrittenSet.of_line(line), self.set.size, self.model.dimension
        if target.size != count:
            raise Refuted("image: a set of another size than the map's")
        first = arb_mat([[int(row == other) for other in range(size)] for row in range(count)])
        self.move(target, target.holds(first * self.set.centre, first, self.set))


def in_parts(led, start, where, halvings=HALVINGS):
    """What `led` gives for a set, or for halves of it, and halves of those, where the whole is too wide for balls: the union."""
    try:
        return led(start)
    except Unconfirmed as error:
        if halvings == 0:
            raise Unconfirmed(str(error) if str(error).startswith(where) else f"{where}: {error}")
    first, second = (in_parts(led, half, where, halvings - 1) for half in start.halves())
    rows, columns = first.nrows(), first.ncols()
    return arb_mat([[first[i, j].union(second[i, j]) for j in range(columns)] for i in range(rows)])


class _Replay:
    """The steps of a run of a system, one after the other."""

    def __init__(self, run):
        self.run_of, self.system = run, run.model.system
        self.mode, self.on = run.model.mode, run.model.on
        self.begins, self.left = True, run.model.count

    def run(self, steps):
        """Confirms all steps. True if they end at the surface of the map."""
        for place, line in enumerate(steps):
            where = f"step {place} of {len(steps)}"
            if self.left == 0 or self.run_of.stopped is not None:
                raise Refuted(f"{where}: it is behind the end of the run")
            self.guards = self.system.guards[self.mode]
            if line[0] == "flow" and len(line) == 3:
                self.tried(where, self.flow, line[1], WrittenSet.of_line(line[2]))
            elif line[0] == "pass" and len(line) == 4:
                self.tried(where, self.cross, line[2], WrittenSet.of_line(line[3]), line[1])
            elif line[0] == "event" and len(line) == 4:
                self.tried(where, self.event, line[2], WrittenSet.of_line(line[3]), line[1])
            else:
                raise Refuted(f"{where}: no step")
        if self.left > 0 and self.run_of.stopped is None:
            raise Refuted(f"the run ends before {self.run_of.model.surface}")
        return self.left == 0

    def tried(self, where, action, length, target, *arguments):
        """A step, in parts where balls are too wide for the whole."""
        if isinstance(length, bool) or not isinstance(length, (int, float)) or not length > 0:
            raise Refuted(f"{where}: a step of the length {length!r}")
        if target.size != self.run_of.set.size:
            raise Refuted(f"{where}: a set of another size")
        trees, widths = [guard.tree for guard in self.guards], [float(x.rad()) for x in list_of(target.hull)]
        # The set behind an event is hardly wider than rounding across its surface.
        least = math.inf if action == self.flow else min(float(radius) for radius in target.radii)
        errors = [OF_WIDTH * width for width in widths], OF_DERIVATIVES, OF_WIDTH * least
        after = []

        def led(start):
            step = Step(self.system.fields[self.mode], start, length, trees, errors)
            seen = Guards(step, self.guards, self.on)
            if self.begins:
                seen.check_begin()
            moved, then = action(where, step, seen, target, *arguments)
            after.append(then)
            return moved

        self.run_of.move(target, in_parts(led, self.run_of.set, where))
        if any(then != after[0] for then in after):
            raise Unconfirmed(f"{where}: its parts do different things")
        self.mode, self.on, self.begins, self.left, self.run_of.stopped = after[0]

    def flow(self, _where, step, seen, target):
        seen.check_clear(step.length)
        return self._flowed(step, target), self._then(0)

    def _flowed(self, step, target):
        return target.holds(step.centre_at(step.length), step.derivatives_at(step.length), step.start)

    def _then(self, events):
        """What is so behind a flow with some events of the map's surface."""
        return self.mode, [False] * len(self.guards), False, self.left - events, None

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
            raise Refuted(f"{where}: {surface} changes the states")
        seen.check_clear(step.length, apart_from=place)
        if not step.guard_rate_at(place, found.union(step.length)) != 0:
            raise Unconfirmed(f"states may cross {surface} once more")
        events = int(is_event and surface == self.run_of.model.surface)
        if self.left == events:
            raise Refuted(f"{where}: the run goes on behind its end")
        return self._flowed(step, target), self._then(events)

    def event(self, where, step, seen, target, surface):
        place = self.place_of(surface, where)
        guard = self.guards[place]
        found, during = seen.crossing(place, step.length)
        at_centre, derivatives, box = seen.image(place, found, during)
        if not self._holds(guard, box):
            raise Refuted(f"{where}: no state has an event at {surface}")
        if guard.after is not None:
            field = step.field
            _, parts = field.with_derivatives(guard.after, list_of(box))
            at_centre = column(field.values(guard.after, list_of(at_centre), Balls))
            derivatives = arb_mat(parts) * derivatives
        left = self.left - int(surface == self.run_of.model.surface)
        if guard.observes(self.mode) and left > 0:
            raise Refuted(f"{where}: {surface} changes nothing: the flow goes on through it")
        moved = target.holds(at_centre, derivatives, step.start)
        return moved, (guard.mode, self.system.begins_on(guard), True, left, surface if guard.stops else None)

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
