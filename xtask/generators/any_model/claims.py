"""Statements of certificates: fixed points, traps, boxes that are led into them, basins. Each derives what its runs prove."""

from flint import acb, acb_mat, arb, arb_mat

from certificate_file import Refuted, Unconfirmed

from .boxes import covers
from .runs import Run, ball_box, box_of, check_start
from .sets import WrittenSet, column, identity, list_of, number
from .systems import FormulaMap, SectionMap, at


def is_inside(inner, outer):
    """True if a ball lies in the inside of an interval of floats."""
    return inner > outer[0] and inner < outer[1]


def square_of(matrix, count):
    """The first columns: the derivatives with respect to the variables, without the parameters."""
    return arb_mat([[matrix[i, j] for j in range(count)] for i in range(count)])


class FixedPoint:
    """There is exactly one fixed point in a box, for all values of the parameters, with its multipliers in discs."""

    FIELDS = "map unique_in point parameters multipliers centre at_centre in_unique at_point".split()

    def __init__(self, line, maps):
        self.map, self.number = at(maps, line["map"]), line["map"]
        self.unique_in, self.point = box_of(line["unique_in"]), box_of(line["point"])
        self.parameters = [] if line["parameters"] == [] else box_of(line["parameters"])
        self.line, self.count = line, self.map.dimension
        sizes = [len(self.unique_in), len(self.point), len(line["centre"])]
        if sizes != [self.count] * 3 or self.count + len(self.parameters) != len(self.map.variables):
            raise Refuted("a fixed point in other variables than its map")

    def confirm(self):
        line, count = self.line, self.count
        centre = line["centre"]
        if not all(low <= c <= high for c, (low, high) in zip(centre, self.unique_in)):
            raise Refuted("the centre is not in the box")
        at_centre = self._run("at_centre", [(c, c) for c in centre])
        wide = self._run("in_unique", self.unique_in)
        krawczyk = self._krawczyk(at_centre, wide, self.unique_in)
        if not all(is_inside(own, box) for own, box in zip(krawczyk, self.unique_in)):
            raise Unconfirmed("Krawczyk's box is not inside of the box")
        # The fixed point is in Krawczyk's box, so that it is enough to look at the narrow one if this holds it.
        narrow = [(min(low, c), max(high, c)) for (low, high), c in zip(self.point, centre)]
        if not all(own >= low and own <= high for own, (low, high) in zip(krawczyk, narrow)):
            raise Unconfirmed("the narrow box does not hold the fixed point")
        near = self._run("at_point", narrow)
        point = self._krawczyk(at_centre, near, narrow)
        if not all(own >= low and own <= high for own, (low, high) in zip(point, self.point)):
            raise Unconfirmed("the fixed point may be outside of the box that the line gives")
        discs = multiplier_discs(square_of(near.derivatives(), count))
        check_discs(discs, line["multipliers"])
        kind = kind_of(discs)
        shown = ", ".join(f"{name} in [{low!r}, {high!r}]" for name, (low, high) in zip(self.map.variables, self.point))
        unique = ", ".join(f"[{low!r}, {high!r}]" for low, high in self.unique_in)
        given = [f"{name} in [{low!r}, {high!r}]" for name, (low, high) in zip(self.map.variables[count:], self.parameters)]
        return {
            "claim": "fixed point",
            "map": self.number,
            "box": self.point,
            "parameters": self.parameters,
            "width": max(high - low for low, high in self.point),
            "is": kind,
            "text": f"exactly one fixed point of map {self.number}, {self.map.text()}, in {unique},"
            + (f" for each {', '.join(given)}," if given else "")
            + f" it has {shown}, and is {kind}; multipliers in "
            + ", ".join(f"the disc of radius {r!r} about {x!r} + {y!r}i" for x, y, r in line["multipliers"]),
        }

    def _run(self, name, box):
        run = Run(self.map, self.line[name], with_derivatives=name != "at_centre")
        run.check_goes_on()
        check_start(run, box + self.parameters)
        return run

    def _krawczyk(self, at_centre, wide, box):
        """y - A F(y) + (I - A DF(X)) (X - y), with an A of the checker's own."""
        count, centre = self.count, column(self.line["centre"])
        slopes = square_of(wide.derivatives(), count) - identity(count)
        near = arb_mat([[slopes[i, j].mid() for j in range(count)] for i in range(count)])
        try:
            inverse = near.inv()
        except ZeroDivisionError:
            raise Unconfirmed("the derivatives may have the eigenvalue 1")
        inverse = arb_mat([[inverse[i, j].mid() for j in range(count)] for i in range(count)])
        off = ball_box(box) - centre
        found = centre - inverse * (at_centre.image.hull - centre) + (identity(count) - inverse * slopes) * off
        return list_of(found)


def multiplier_discs(matrix):
    """Discs that hold the eigenvalues of all matrices of a ball: Gershgorin's, in a basis near the eigenvectors."""
    count = matrix.nrows()
    middle = acb_mat([[acb(matrix[i, j].mid()) for j in range(count)] for i in range(count)])
    try:
        _, basis = middle.eig(right=True, algorithm="approx")
        inverse = basis.inv()
    except (ValueError, ZeroDivisionError):
        basis = inverse = acb_mat([[int(i == j) for j in range(count)] for i in range(count)])
    own = inverse * acb_mat([[acb(matrix[i, j]) for j in range(count)] for i in range(count)]) * basis
    discs = []
    for i in range(count):
        centre = acb(own[i, i].real.mid(), own[i, i].imag.mid())
        radius = sum((abs(own[i, j] if j != i else own[i, i] - centre) for j in range(count)), arb(0)).upper()
        discs.append((centre, radius))
    return discs


def check_discs(discs, claimed):
    """Raises an error unless each disc that holds an eigenvalue is in one that the line gives, and each of those has one."""
    left = [(acb(number(x), number(y)), number(r)) for x, y, r in claimed]
    if len(left) != len(discs):
        raise Refuted("another number of multipliers than variables")
    for centre, radius in discs:
        inside = [k for k, (c, r) in enumerate(left) if abs(c - centre) + radius <= r]
        if not inside:
            raise Unconfirmed(f"a multiplier near {complex(centre):.6g} may be outside of the discs that the line gives")
        left.pop(inside[0])


def kind_of(discs):
    sizes = [(abs(centre) + radius < 1, abs(centre) - radius > 1) for centre, radius in discs]
    if all(inside for inside, _ in sizes):
        return "attracting"
    if all(inside or outside for inside, outside in sizes):
        return "a saddle" if any(inside for inside, _ in sizes) else "repelling"
    return "not decided"


class Trap:
    """All points of a parallelepiped converge to the one fixed point in it."""

    FIELDS = "map centre directions parameters size run growth".split()

    def __init__(self, line, maps):
        self.map, self.line, self.number = at(maps, line["map"]), line, line["map"]
        count = self.count = self.map.dimension
        self.centre = column(line["centre"])
        self.directions = arb_mat([[number(x) for x in row] for row in line["directions"]])
        self.parameters = [] if line["parameters"] == [] else box_of(line["parameters"])
        if self.centre.nrows() != count or count + len(self.parameters) != len(self.map.variables):
            raise Refuted("a trap in other variables than its map")
        try:
            self.inverse = self.directions.inv()
        except ZeroDivisionError:
            raise Refuted("a trap whose directions depend on each other")
        sizes = [line["size"]] + [larger["size"] for larger in line["growth"]]
        if not 0 < sizes[0] or sizes != sorted(set(sizes)):
            raise Refuted("a trap whose sizes do not grow")
        self.size = sizes[-1]

    def confirm(self):
        size, count = self.line["size"], self.count
        run = self._run(self.line["run"], [(-size, size)] * count, with_derivatives=True)
        own = self.inverse * square_of(run.derivatives(), count) * self.directions
        norm = arb(0)
        for i in range(count):
            norm = norm.max(sum((abs(own[i, j]) for j in range(count)), arb(0)).upper())
        if not norm < 1:
            raise Unconfirmed("the derivatives may be no contraction")
        self.check_inside(run, size, strictly=True)
        for larger in self.line["growth"]:
            parts = [box_of(part["box"]) for part in larger["parts"]]
            known = [[(-size, size)] * count, *parts]
            if not covers(known, [(-larger["size"], larger["size"])] * count):
                raise Refuted(f"the parts leave a gap in the trap of size {larger['size']!r}")
            for box, part in zip(parts, larger["parts"]):
                self.check_inside(self._run(part["run"], box), size)
            size = larger["size"]
        radii = self.size * arb_mat([[abs(self.directions[i, j]) for j in range(count)] for i in range(count)])
        reach = [sum((radii[i, j] for j in range(count)), arb(0)) for i in range(count)]
        # A little less, so that the number as it is printed holds.
        reach = [float((own * (1 - arb(2) ** -40)).lower()) for own in reach]
        given = zip(self.map.variables[count:], self.parameters)
        given = ", ".join(f"{name} in [{low!r}, {high!r}]" for name, (low, high) in given)
        return {
            "claim": "trap",
            "map": self.number,
            "parameters": self.parameters,
            "size": self.size,
            "reach": min(reach),
            "text": (f"for each {given}: " if given else "")
            + f"all points of a parallelepiped about {self.line['centre']!r} that reaches {reach!r} from it converge to the one"
            f" fixed point in it, of map {self.number}, {self.map.text()}",
        }

    def _run(self, line, box, with_derivatives=False):
        run = Run(self.map, line, with_derivatives)
        run.check_goes_on()
        count, more = self.count, len(self.parameters)
        wide = identity(count + more).tolist()
        for i in range(count):
            wide[i][:count] = [self.directions[i, j] for j in range(count)]
        centre = column(list_of(self.centre) + [arb(0)] * more)
        check_start(run, box + self.parameters, (centre, arb_mat(wide)))
        return run

    def check_inside(self, run, size, strictly=False):
        """Raises an error unless the image of a run is in the trap of a size."""
        middle = self.inverse * (run.image.centre - self.centre)
        spread = self.inverse * run.image.directions * run.image.offsets
        for row in range(self.count):
            own = abs(middle[row, 0] + spread[row, 0])
            if not (own < size if strictly else own <= size):
                raise Unconfirmed(f"an image leaves the trap of size {size!r}")

    def holds_set(self, centre, rows, radii):
        """True if the points c + A r of a set of a line are in the trap."""
        own = WrittenSet.of_line([centre, rows, radii])
        if own.size != self.count:
            raise Refuted("a set of another size than the trap's")
        middle = self.inverse * (own.centre - self.centre)
        spread = self.inverse * own.directions * own.offsets
        return all(abs(middle[row, 0] + spread[row, 0]) <= self.size for row in range(self.count))

    def holds(self, box):
        """True if a box of intervals is in the trap."""
        own = self.inverse * (ball_box(box) - self.centre)
        return all(abs(own[row, 0]) <= self.size for row in range(self.count))


class Leads:
    """All points of a box are led into a trap, into the box of such a statement before, or to a surface."""

    FIELDS = "map box to parts".split()

    def __init__(self, line, maps, traps, led):
        self.map, self.number, self.line, self.box = at(maps, line["map"]), line["map"], line, box_of(line["box"])
        self.boxes = [box_of(part["box"]) for part in line["parts"]]
        if len(self.box) != len(self.map.variables):
            raise Refuted("a box in other variables than its map")
        kind, number = line["to"] if line["to"] is not None else (None, None)
        if kind not in ("trap", "box", None):
            raise Refuted(f"{kind!r} is nothing that points are led to")
        self.trap = at(traps, number) if kind == "trap" else None
        self.target = at(led, number) if kind == "box" else None
        self.into = None if kind is None else self.trap or self.target
        if self.into is not None and self.into.map.dimension != self.map.dimension:
            raise Refuted("a target in other variables than the map's")
        if self.into is not None and len(self.into.map.variables) != self.map.dimension:
            raise Refuted("a target for which there are parameters")
        if self.into is None and not isinstance(self.map, SectionMap):
            raise Refuted("a map of formulas has no surface")

    def join(self):
        if not covers(self.boxes, self.box):
            raise Refuted("the parts leave a gap in the box")

    def confirm(self, part):
        run = Run(self.map, self.line["parts"][part]["run"])
        if run.image is None:
            raise Refuted("a run that does not come to the surface of its map")
        if self.into is not None:
            run.check_goes_on()
        check_start(run, self.boxes[part])
        if self.trap is not None:
            self.trap.check_inside(run, self.trap.size)
        if self.target is not None:
            for own, (low, high) in zip(list_of(run.image.hull), self.target.box):
                if not (own >= low and own <= high):
                    raise Unconfirmed("an image leaves the box into which it is led")

    def derived(self):
        shown = ", ".join(f"{name} in [{low!r}, {high!r}]" for name, (low, high) in zip(self.map.variables, self.box))
        if self.trap is not None:
            where = f"into the trap about {self.trap.line['centre']!r} of map {self.trap.number}"
        elif self.target is not None:
            where = f"into the box {self.target.line['box']!r} of map {self.target.number}"
        else:
            where = f"to {self.map.surface}"
        return {
            "claim": "leads",
            "map": self.number,
            "target_map": None if self.into is None else self.into.number,
            "box": self.box,
            "to": self.map.surface if self.line["to"] is None else "{} {}".format(*self.line["to"]),
            "text": f"all points with {shown} are led {where} by map {self.number}, {self.map.text()}",
        }


class Keeps:
    """The part of a set of a map in a box is led into itself."""

    FIELDS = "map set box parts".split()

    def __init__(self, line, maps):
        self.map, self.number, self.line, self.box = at(maps, line["map"]), line["map"], line, box_of(line["box"])
        self.boxes = [box_of(part["box"]) for part in line["parts"]]
        if not isinstance(self.map, FormulaMap) or self.map.times != 1 or line["set"] not in self.map.sets:
            raise Refuted("a set of no map that is applied once")
        if len(self.box) != len(self.map.variables) or self.map.dimension != len(self.box):
            raise Refuted("a box in other variables than its map")

    def join(self):
        if not covers(self.boxes, self.box):
            raise Refuted("the parts leave a gap in the box")
        if not any(self._has_its_middle(box) for box in self.boxes):
            raise Refuted("a set that has the middle of no part of the box")

    def _has_its_middle(self, box):
        """True if the middle of a part is in the whole box and in the set."""
        middle = [((low + high) / 2,) * 2 for low, high in box]
        inside = all(low <= x <= high for (x, _), (low, high) in zip(middle, self.box))
        return inside and all(value > 0 for value in self._conditions(middle))

    def _conditions(self, box):
        return self.map.conditions_at(self.line["set"], ball_box(box))

    def confirm(self, part):
        box, name = self.boxes[part], self.line["set"]
        if any(value <= 0 for value in self._conditions(box)):
            return
        run = Run(self.map, self.line["parts"][part]["run"])
        check_start(run, box)
        hull = list_of(run.set.hull)
        if not self.map.holds(name, run.set.hull):
            raise Unconfirmed(f"an image may leave the set {name}")
        if not all(own >= low and own <= high for own, (low, high) in zip(hull, self.box)):
            raise Unconfirmed("an image may leave the box")

    def derived(self):
        shown = ", ".join(f"{name} in [{low!r}, {high!r}]" for name, (low, high) in zip(self.map.variables, self.box))
        return {
            "claim": "keeps",
            "map": self.number,
            "box": self.box,
            "set": self.line["set"],
            "text": f"all points of the set \"{self.line['set']}\" with {shown} (points of it outside of this box are not looked at) are led into it and the box again by map {self.number}, {self.map.text()}",
        }
