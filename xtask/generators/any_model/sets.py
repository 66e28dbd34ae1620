"""Sets of certificates, c + A r with |r_k| <= a radius, and matrices of balls."""

from flint import arb, arb_mat

from certificate_file import Refuted, Unconfirmed


class WrittenSet:
    """The set that a line has as [centre, rows of directions, radii], all of whose numbers are exact, or a part of one."""

    def __init__(self, centre, directions, radii):
        self.size, self.centre, self.directions, self.radii = len(radii), centre, directions, radii
        self.offsets = arb_mat(self.size, 1, [around_zero(radius) for radius in radii])
        self.hull = centre + directions * self.offsets

    @staticmethod
    def of_line(line):
        if not isinstance(line, list) or len(line) != 3:
            raise Refuted("no set")
        centre, rows, radii = line
        size = len(centre)
        if not size or len(rows) != size or len(radii) != size or any(len(row) != size for row in rows):
            raise Refuted("a set whose centre, directions and radii are not of one size")
        if not all(radius >= 0 for radius in radii):
            raise Refuted("a set with a radius below 0")
        directions = arb_mat([[number(x) for x in row] for row in rows])
        return WrittenSet(column(centre), directions, [number(radius) for radius in radii])

    def halves(self):
        """The two halves across the direction in which the set is widest."""
        lengths = [
            max(float(abs(self.directions[row, k]).upper()) for row in range(self.size)) * float(self.radii[k])
            for k in range(self.size)
        ]
        widest = lengths.index(max(lengths))
        radii = [radius / 2 if k == widest else radius for k, radius in enumerate(self.radii)]
        step = arb_mat(self.size, 1, [self.directions[row, widest] * radii[widest] for row in range(self.size)])
        return [WrittenSet(centre, self.directions, radii) for centre in (self.centre - step, self.centre + step)]

    def inverse(self):
        """The inverse of the directions."""
        try:
            return self.directions.inv()
        except ZeroDivisionError:
            raise Refuted("a set whose directions depend on each other")

    def holds(self, at_centre, derivatives, start):
        """Raises an error unless the image of `start` is in this set, by the value at the centre and the derivatives. These, along the
        directions of both sets."""
        inverse = self.inverse()
        middle = inverse * (at_centre - self.centre)
        moved = inverse * derivatives * start.directions
        spread = moved * start.offsets
        for row, radius in enumerate(self.radii):
            own = middle[row, 0] + spread[row, 0]
            if not abs(own) <= radius:
                far = float((abs(own) / radius).upper()) if radius > 0 else float("inf")
                raise Unconfirmed(f"the image leaves the set: direction {row}, {far:.6g} of its radius")
        return moved


def number(x):
    """An exact number of a line."""
    if isinstance(x, bool) or not isinstance(x, (int, float)):
        raise Refuted(f"{x!r} is no number")
    return arb(x)


def interval(pair):
    """The ball about an interval of a line."""
    if not isinstance(pair, list) or len(pair) != 2:
        raise Refuted(f"{pair!r} is no interval")
    low, high = number(pair[0]), number(pair[1])
    if not low <= high:
        raise Refuted(f"{pair!r} is no interval")
    return low.union(high)


def around_zero(radius):
    """The ball of all numbers up to a size."""
    return (-radius).union(radius)


def column(numbers):
    return arb_mat(len(numbers), 1, [x if isinstance(x, arb) else number(x) for x in numbers])


def list_of(matrix):
    return [matrix[row, 0] for row in range(matrix.nrows())]


def identity(size):
    return arb_mat([[int(row == other) for other in range(size)] for row in range(size)])


def common(a, b):
    """The common part of two balls, both of which hold something."""
    try:
        return a.intersection(b)
    except ValueError:
        raise Unconfirmed(f"{a} and {b} have no common number")
