"""Checks a certificate of any model: reads every line, confirms its runs, and derives what they prove."""

import hashlib
import random
import re

from certificate_file import Refuted, guarded, lines_of

from .basins import Basins, Cell
from .claims import FixedPoint, Keeps, Leads, Trap
from .known import check_known
from .systems import FormulaMap, SectionMap, System

FORMAT, VERSION = "hybrid system certificate", 1

FIELDS = {
    "system": "states parameters modes".split(),
    "map": None,
    "fixed-point": FixedPoint.FIELDS,
    "trap": Trap.FIELDS,
    "leads": Leads.FIELDS,
    "keeps": Keeps.FIELDS,
    "basins": Basins.FIELDS,
    "cell": Cell.FIELDS,
}
MAPS = [
    "system mode variables states surface count read".split(),
    "system variables parameters formulas dimension times".split(),
    "system variables parameters formulas dimension times sets".split(),
]


def wrong_field(kind, line):
    """What is wrong with the fields of a line, or None."""
    if kind is None:
        wanted = [["format", "version", "name", "lines"]]
    elif kind not in FIELDS:
        return f"no kind of line: {kind!r}"
    else:
        wanted = MAPS if kind == "map" else [FIELDS[kind]]
    own = set(line) - ({"kind"} if kind is not None else set())
    if all(own != set(fields) for fields in wanted):
        return f"its fields are {sorted(own)}, not {sorted(wanted[0])}"
    return None


class Reader:
    """What the lines before have said, and what each line claims. What holds between lines takes the most time: one of two readings looks at it."""

    def __init__(self, joins=True):
        self.joins = joins
        self.systems, self.maps, self.traps, self.led, self.derived = [], [], [], [], []
        self.open = None

    def add(self, line):
        """The claims of a line: (number of them, what confirms one)."""
        kind = line["kind"]
        if kind != "cell":
            self.end()
        if kind == "system":
            self.systems.append(System(line))
        elif kind == "map":
            self.maps.append((FormulaMap if line["system"] is None else SectionMap)(line, self.systems))
        elif kind == "fixed-point":
            claim = FixedPoint(line, self.maps)
            return 1, lambda _: self.derived.append(claim.confirm())
        elif kind == "trap":
            claim = Trap(line, self.maps)
            self.traps.append(claim)
            return 1, lambda _: self.derived.append(claim.confirm())
        elif kind in ("leads", "keeps"):
            if kind == "leads":
                claim = Leads(line, self.maps, self.traps, self.led)
                self.led.append(claim)
            else:
                claim = Keeps(line, self.maps)
            if self.joins:
                claim.join()
            self.derived.append(claim.derived())
            return len(claim.boxes), claim.confirm
        elif kind == "basins":
            self.open = Basins(line, self.maps)
        else:
            if self.open is None:
                raise Refuted("a cell without basins")
            claim = Cell(line, self.open, self.traps)
            self.open.add(claim, self.joins)
            return 1, lambda _: claim.confirm()
        return 0, None

    def end(self):
        if self.open is not None:
            self.open.end()
            self.derived.append(self.open.derived())
            self.open = None


# Claims that are confirmed in any sample: all others rest on them.
ALWAYS = ("fixed-point", "trap")


def check(path, sample=None, seed=1, found=None):
    """A sentence about the file. Raises an error for the first line that is not confirmed. `found` gets what the file proves."""
    digests = [hashlib.sha256(), hashlib.sha256()]
    counts = []
    lines = lines_of(path, digests[0], wrong_field)
    _, header = next(lines, (1, {}))
    if header.get("format") != FORMAT or header.get("version") != VERSION or type(header.get("version")) is not int:
        raise Refuted(f"line 1: no certificate of version {VERSION}")
    if not isinstance(header["name"], str) or not re.fullmatch(r"[\w-]+", header["name"]):
        raise Refuted("line 1: its name is none of letters, digits and signs")
    reader, models = Reader(joins=False), []
    for number, line in lines:
        count, _ = guarded(number, reader.add, line)
        counts.append((line["kind"], count))
        if line["kind"] in ("system", "map"):
            models.append(line)
    if len(counts) != header["lines"]:
        raise Refuted(f"line 1: {len(counts)} lines follow the header, which says {header['lines']}")
    guarded(len(counts) + 1, reader.end)
    places = [(line, claim) for line, (kind, count) in enumerate(counts) if kind not in ALWAYS for claim in range(count)]
    total, chosen = len(places), set(places)
    if sample is not None and sample < total:
        chosen = set(random.Random(seed).sample(places, sample))
    reader = Reader()
    lines = lines_of(path, digests[1], wrong_field)
    next(lines)
    for place, (number, line) in enumerate(lines):
        count, confirm = guarded(number, reader.add, line)
        for claim in range(count):
            if line["kind"] in ALWAYS or (place, claim) in chosen:
                guarded(number, confirm, claim)
    guarded(len(counts) + 1, reader.end)
    if digests[0].digest() != digests[1].digest():
        raise Refuted("the file changed while it was read")
    if not reader.derived:
        raise Refuted("line 1: no statement")
    scope = guarded(1, check_known, header["name"], models, reader.derived)
    if found is not None:
        found.update(models=models, derived=reader.derived)
    word = "confirmed" if len(chosen) == total else "sampled"
    about = "; ".join(f"system {number}, {system.text()}" for number, system in enumerate(reader.systems)) or "maps"
    name = f"{header['name']} ({scope})"
    proved = "; ".join(claim["text"] for claim in reader.derived)
    parts = f"{len(chosen)} of {total} parts, " if total else ""
    return f"{word:9} {name}, of {about}: {parts}proves: {proved}; sha256 {digests[0].hexdigest()}"
