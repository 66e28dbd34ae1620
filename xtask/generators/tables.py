"""The committed files of reference values: where they are, how a line is made again, how they are laid out."""

import json
from pathlib import Path
from typing import Callable, NamedTuple

import basins
import hops

ROOT = Path(__file__).resolve().parents[2]
HOPPER = "crates/passive-hopper/tests/data"
BASIN = "crates/hopper-basin/tests/data"
ASYMPTOTICS = "crates/hopper-asymptotics/tests/data"


class Table(NamedTuple):
    """A file of records, each made again by itself from its own inputs."""

    name: str
    # The file, and its copies in other crates, which have the same bytes.
    paths: tuple
    remake: Callable
    # Records that --check makes again.
    sample: int

    def records(self):
        text = (ROOT / self.paths[0]).read_text(encoding="utf-8")
        return [json.loads(line) for line in text.splitlines()] if self.is_lines() else json.loads(text)

    def is_lines(self):
        return self.paths[0].endswith(".jsonl")

    def layout(self, records):
        """The text of the file with these records."""
        if self.is_lines():
            return "".join(json.dumps(record) + "\n" for record in records)
        return json.dumps(records, indent=0)


def _hopper(name, remake, sample):
    return Table(name.split(".")[0], (f"{HOPPER}/{name}",), remake, sample)


TABLES = (
    _hopper("hops_random.jsonl", hops.hop, 30),
    _hopper("hops_window.jsonl", hops.hop, 30),
    _hopper("hops_boundaries.jsonl", hops.hop, 30),
    _hopper("hops_extreme.jsonl", hops.hop, 20),
    _hopper("hops_near_fixed_point.jsonl", hops.near_fixed_point, 60),
    _hopper("hops_hard_offsets.jsonl", hops.hard_offset, 30),
    _hopper("hops_hard_verdicts.jsonl", hops.hard_verdict, 4),
    _hopper("losses_tiny.jsonl", hops.tiny_loss, 50),
    _hopper("losses_near_first_fixed_point.jsonl", hops.loss_near_fixed_point, 60),
    _hopper("orbits.jsonl", hops.orbit, 3),
    _hopper("fixed_points.json", hops.fixed_point, 33),
    Table("fates", (f"{BASIN}/fates.jsonl",), basins.fate, 60),
    Table("critical", (f"{BASIN}/critical.json",), basins.crisis, 10),
    Table(
        "local_basin",
        (f"{BASIN}/local_basin.json", f"{ASYMPTOTICS}/local_basin.json"),
        basins.local_basin,
        20,
    ),
)
