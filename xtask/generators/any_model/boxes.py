"""Boxes of floats: whether some cover another one, and cells of windows that are halved."""

from flint import arb, arb_mat

from certificate_file import Refuted

from .sets import WrittenSet, list_of


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
        node, own, above = self.root, list(self.window), []
        while own != box:
            above.append(node)
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
        # A node all of whose parts have one fate answers for them.
        for parent in reversed(above):
            parts = [parent.get(part, {}) for part in range(1 << len(box))]
            if any(part.get("fate", part.get("all")) != fate for part in parts):
                break
            parent["all"] = fate

    def hold(self, centre, rows, radii, fate):
        """True if all points c + A r of a set are in cells of one fate, for certain."""
        image = _Image(centre, rows, radii)
        inside = (c - reach >= low and c + reach <= high for (low, high), c, reach in zip(self.window, image.centre, image.reach))
        return all(inside) and self._hold(self.root, self.window, image, fate)

    def _hold(self, node, own, image, fate):
        if image.misses(own):
            return True
        if "fate" in node:
            return node["fate"] == fate
        if not node:
            return False
        if node.get("all") == fate:
            return True
        for part in range(1 << len(own)):
            halves = []
            for axis, (low, high) in enumerate(own):
                middle = (low + high) / 2
                halves.append((middle, high) if part >> axis & 1 else (low, middle))
            if not self._hold(node.get(part, {}), halves, image, fate):
                return False
        return True


class _Image:
    """A set c + A r, in balls, for questions about where it is not."""

    def __init__(self, centre, rows, radii):
        own = WrittenSet.of_line([centre, rows, radii])
        self.size, self.centre = own.size, list_of(own.centre)
        self.reach = [sum((abs(own.directions[i, k]) * own.radii[k] for k in range(own.size)), arb(0)) for i in range(own.size)]
        # Any rows will do to show that a box is apart: those of the inverse are good ones.
        inverse = own.inverse()
        self.tests = [[inverse[i, j].mid() for j in range(own.size)] for i in range(own.size)]
        moved = arb_mat(self.tests) * own.directions
        self.ranges = [sum((abs(moved[i, k]) * own.radii[k] for k in range(own.size)), arb(0)) for i in range(own.size)]

    def misses(self, box):
        """True if no point of a box is in the image, for certain."""
        off = [(arb(low) + arb(high)) / 2 - c for (low, high), c in zip(box, self.centre)]
        half = [(arb(high) - arb(low)) / 2 for low, high in box]
        if any(abs(o) > h + reach for o, h, reach in zip(off, half, self.reach)):
            return True
        for test, reach in zip(self.tests, self.ranges):
            far = abs(sum((w * o for w, o in zip(test, off)), arb(0)))
            if far > sum((abs(w) * h for w, h in zip(test, half)), reach):
                return True
        return False
