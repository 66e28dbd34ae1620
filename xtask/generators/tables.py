"""The committed files of reference values: where they are, how a line is made again, how they are laid out."""

import json
from pathlib import Path
from typing import Callable, NamedTuple

import basins
import edge_fates
import functions
import hops
import motions
import phases
import scenes

ROOT = Path(__file__).resolve().parents[2]


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


def _table(file, remake, sample):
    """The table of a file, wherever among the crates' test data it stands."""
    paths = sorted(ROOT.glob(f"crates/*/*/tests/data/{file}"))
    if not paths:
        raise FileNotFoundError(f"no crate has tests/data/{file}")
    return Table(file.split(".")[0], tuple(path.relative_to(ROOT).as_posix() for path in paths), remake, sample)


TABLES = (
    _table("hops_random.jsonl", hops.hop, 100),
    _table("hops_window.jsonl", hops.hop, 100),
    _table("hops_boundaries.jsonl", hops.hop, 100),
    _table("hops_extreme.jsonl", hops.hop, 50),
    _table("hops_near_fixed_point.jsonl", hops.near_fixed_point, 60),
    _table("hops_hard_offsets.jsonl", hops.hard_offset, 40),
    _table("hops_hard_verdicts.jsonl", hops.hard_verdict, 4),
    _table("losses_tiny.jsonl", hops.tiny_loss, 50),
    _table("losses_near_first_fixed_point.jsonl", hops.loss_near_fixed_point, 60),
    _table("orbits.jsonl", hops.orbit, 2),
    _table("fixed_points.json", hops.fixed_point, 33),
    _table("fates.jsonl", basins.fate, 60),
    _table("edges.jsonl", edge_fates.edge_record, 4),
    _table("edge_fates.jsonl", edge_fates.fate, 24),
    _table("critical.json", basins.crisis, 10),
    _table("local_basin.json", basins.local_basin, 20),
    _table("phases.jsonl", phases.phase, 16),
    _table("slow_orbits.jsonl", phases.slow_orbit, 8),
    _table("events.jsonl", scenes.scene, 5),
    _table("motions.jsonl", motions.scene, 4),
    _table("functions.jsonl", functions.function, 81),
)
