"""Boxes of floats: whether some cover another one, and cells of windows that are halved."""

from flint import arb_mat

from certificate_file import Refuted

# A bound of the rounding errors of a sum of at most 32 products of floats, as a part of the sum of their sizes.
ROUNDING = 1e-13


def covers(boxes, whole):
    """True if boxes of floats cover another one: it is cut along their faces until each piece is in one box."""
    for box in boxes:
        if all(low <= own_low and own_high <= high for (low, high), (own_low, own_high) in zip(box, whole)):
            return True
    # A closed box that only touches the whole one covers nothing of its inside.
    boxes = [
        box
        for box in boxes
        if all(low < own_high and own_low < high or own_low == own_high for (low, high), (own_low, own_high) in zip(box, whole))
    ]
    best = None
    for box in boxes:
        for axis, ((low, high), (own_low, own_high)) in enumerate(zip(box, whole)):
            for face in (low, high):
                if own_low < face < own_high:
                    balance = min(face - own_low, own_high - face) / (own_high - own_low)
                    if best is None or balance > best[0]:
                        best = (balance, axis, face)
        if best is not None and best[0] > 0.3:
            break
    if best is None:
        return False
    _, axis, face = best
    low, high = whole[axis]
    return all(
        covers(boxes, [*whole[:axis], side, *whole[axis + 1 :]]) for side in ((low, face), (face, high))
    )


class Cells:
    """The cells of a window that have a fate: halves of halves of its sides."""

    def __init__(self, window):
        self.window, self.root, self.count = window, {}, 0

    def add(self, box, fate):
        """Gives a cell its fate. Refuses a box that is no cell, and one of which a part has a fate."""
        node, own = self.root, list(self.window)
        while own != box:
            if "fate" in node:
                raise Refuted("a cell that lies in another one")
            part = 0
            for axis, ((low, high), (own_low, own_high)) in enumerate(zip(own, box)):
                middle = (low + high) / 2
                if not low < middle < high:
                    raise Refuted("a box that is no cell of the window")
                upper = own_low >= middle
                part |= upper << axis
                own[axis] = (middle, high) if upper else (low, middle)
            if not all(low <= own_low and own_high <= high for (low, high), (own_low, own_high) in zip(own, box)):
                raise Refuted("a box that is no cell of the window")
            node = node.setdefault(part, {})
        if node:
            raise Refuted("a cell that stands twice, or of which a part has a fate")
        node["fate"] = fate
        self.count += 1

    def hold(self, centre, rows, radii, fate):
        """True if all points c + A r of a set are in cells of one fate, for certain. Floats with a margin for their rounding."""
        image = _Image(centre, rows, radii)
        inside = (low <= c - reach and c + reach <= high for (low, high), c, reach in zip(self.window, centre, image.reach))
        return all(inside) and self._hold(self.root, self.window, image, fate)

    def _hold(self, node, own, image, fate):
        if image.misses(own):
            return True
        if "fate" in node:
            return node["fate"] == fate
        if not node:
            return False
        for part in range(1 << len(own)):
            halves = []
            for axis, (low, high) in enumerate(own):
                middle = (low + high) / 2
                halves.append((middle, high) if part >> axis & 1 else (low, middle))
            if not self._hold(node.get(part, {}), halves, image, fate):
                return False
        return True


class _Image:
    def __init__(self, centre, rows, radii):
        self.centre, size = centre, len(centre)
        # Any rows will do to show that a box is apart: those of the inverse are good ones.
        try:
            inverse = arb_mat(rows).inv()
            self.tests = [[float(inverse[i, j].mid()) for j in range(size)] for i in range(size)]
        except ZeroDivisionError:
            self.tests = []
        self.reach = [sum(abs(a) * r for a, r in zip(row, radii)) * (1 + ROUNDING) for row in rows]
        columns = list(zip(*rows))
        self.ranges = [
            sum((abs(sum(w * a for w, a in zip(test, column))) + self._lost(test, column)) * r for column, r in zip(columns, radii))
            * (1 + ROUNDING)
            for test in self.tests
        ]

    @staticmethod
    def _lost(a, b):
        return ROUNDING * sum(abs(x * y) for x, y in zip(a, b))

    def misses(self, box):
        """True if no point of a box is in the image, for certain."""
        middle = [(low + high) / 2 - c for (low, high), c in zip(box, self.centre)]
        half = [(high - low) / 2 * (1 + ROUNDING) for low, high in box]
        sizes = [abs(low) + abs(high) + abs(c) for (low, high), c in zip(box, self.centre)]
        for m, h, reach, size in zip(middle, half, self.reach, sizes):
            if abs(m) > (h + reach) + ROUNDING * size:
                return True
        for test, reach in zip(self.tests, self.ranges):
            far = abs(sum(w * m for w, m in zip(test, middle)))
            wide = sum(abs(w) * h for w, h in zip(test, half))
            if far > (wide + reach) * (1 + ROUNDING) + self._lost(test, sizes):
                return True
        return False
