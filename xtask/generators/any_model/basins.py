"""Basins of certificates: cells of a window, each of which is led into cells of its fate that stand before it."""

from flint import arb

from certificate_file import Refuted, Unconfirmed

from .boxes import Cells
from .runs import Run, box_of, check_start
from .systems import FormulaMap, at


class Basins:
    """The cells of a window, and what is read of them so far."""

    FIELDS = "map window cells".split()

    def __init__(self, line, maps):
        self.map, self.window, self.wanted = at(maps, line["map"]), box_of(line["window"]), line["cells"]
        self.number = line["map"]
        if type(self.wanted) is not int or self.wanted < 1:
            raise Refuted(f"basins of {self.wanted!r} cells")
        if len(self.window) != self.map.dimension or self.map.dimension != len(self.map.variables):
            raise Refuted("a window in other variables than its map")
        self.cells, self.areas = Cells(self.window), {}

    def add(self, cell, joins):
        """Writes down a cell, whose image must be in cells of its fate, at which is looked if the cell joins those before."""
        if self.cells.count == self.wanted:
            raise Refuted("more cells than the line of the basins says")
        image = cell.image
        if joins and image is not None and not cell.is_led_in:
            if not self.cells.hold(*image, cell.fate):
                raise Refuted("a cell whose image may be outside of the cells of its fate that stand before it")
        self.cells.add(cell.box, cell.fate)
        area = arb(1)
        for (low, high), (first, last) in zip(cell.box, self.window):
            area *= (arb(high) - arb(low)) / (arb(last) - arb(first))
        self.areas[cell.fate] = self.areas.get(cell.fate, arb(0)) + area

    def end(self):
        if self.cells.count != self.wanted:
            raise Refuted(f"{self.cells.count} cells, and the line of the basins says {self.wanted}")

    def derived(self):
        end = "the set" if isinstance(self.map, FormulaMap) else "an end at"
        shown = ", ".join(f"at least {rounded_down(area)} {fate_text(fate, end)}" for fate, area in self.areas.items())
        window = " x ".join(f"[{low!r}, {high!r}]" for low, high in self.window)
        return {
            "claim": "basins",
            "map": self.number,
            "window": [list(side) for side in self.window],
            "share": float(rounded_down(sum(self.areas.values(), arb(0)))),
            "shares": {str(fate): float(rounded_down(area)) for fate, area in self.areas.items()},
            "text": f"of the points of {window}, by area, by the map {self.map.text()}: {shown or 'nothing'}",
        }


def fate_text(fate, end):
    return f"converge to the fixed point of trap {fate}" if isinstance(fate, int) else f'come to {end} "{fate}"'


def rounded_down(share):
    """A share with six digits, rounded down."""
    digits = int((share * 10**6).lower().floor().unique_fmpz())
    return f"{digits // 10**6}.{digits % 10**6:06}"


class Cell:
    """One cell with a fate: in a trap, led into one, led into cells of its fate, or to the end of the execution."""

    FIELDS = "box fate run".split()

    def __init__(self, line, basins, traps):
        self.basins, self.line, self.box, self.fate = basins, line, box_of(line["box"]), line["fate"]
        if len(self.box) != len(basins.window):
            raise Refuted("a cell in other variables than its window")
        self.trap = None
        if not isinstance(self.fate, str):
            self.trap = at(traps, self.fate)
            if self.trap.map is not basins.map or self.trap.parameters:
                raise Refuted("a trap of another map")
        run = line["run"]
        self.image = None if run is None or run["image"] is None else tuple(run["image"])
        self.is_led_in = self.trap is not None and self.image is not None and self.trap.holds_set(*self.image)
        if run is None and not (self.trap is not None and self.trap.holds(self.box)):
            raise Refuted("a cell without a run that may be outside of its trap")
        if run is not None and self.image is None and self.trap is not None:
            raise Refuted("a cell without an image")

    def confirm(self):
        if self.line["run"] is None:
            return
        run = Run(self.basins.map, self.line["run"])
        check_start(run, self.box)
        model = self.basins.map
        if isinstance(self.fate, str) and self.image is None:
            # Sets may overlap: the one of this fate counts.
            ends = model.holds(self.fate, run.set.hull) if isinstance(model, FormulaMap) else run.stopped == self.fate
            if not ends:
                raise Unconfirmed(f"not all points come to an end at {self.fate}")
        elif run.stopped is not None:
            raise Refuted("a cell whose execution ends")
