"""Makes the committed reference values and constants again, and compares them with the committed ones.

Started by `cargo xtask regenerate`, in the virtual environment of requirements.txt.
"""

import argparse
import json
import multiprocessing
import os
import random
import sys
import time

from constants import CONSTANTS
from tables import ROOT, TABLES

OUT = ROOT / "target" / "regenerate"
# The seed of the samples: any fixed number serves.
SEED = 13
# Differences that are printed of one file.
SHOWN = 8


def remake(job):
    """One record of one table, in a worker. An exception is a result too: it belongs to its record."""
    table, index, record = job
    try:
        return index, TABLES[table].remake(record), None
    except Exception as error:  # reported with the record that caused it
        return index, None, f"{type(error).__name__}: {error}"


def differences(old, new):
    """The fields that differ, as text."""
    names = [name for name in dict.fromkeys([*old, *new]) if old.get(name) != new.get(name)]
    return [f"{name}: committed {json.dumps(old.get(name))}, made {json.dumps(new.get(name))}" for name in names]


class Comparison:
    """Counts of one file."""

    def __init__(self, table):
        self.table, self.compared, self.wrong = table, 0, 0

    def add(self, index, old, new, error):
        self.compared += 1
        found = [error] if error else differences(old, new)
        if found:
            self.wrong += 1
            if self.wrong <= SHOWN:
                for line in found:
                    print(f"  {self.table.name}, record {index + 1}: {line}", flush=True)

    def report(self, total, seconds):
        verdict = "equal" if not self.wrong else f"{self.wrong} DIFFER"
        print(
            f"{self.table.name}: {self.compared} of {total} records made again, {verdict} ({seconds:.0f} s)", flush=True
        )


def check(number, pool):
    """A sample of a file. Copies of the file must have its bytes."""
    table = TABLES[number]
    start, records, comparison = time.time(), table.records(), Comparison(table)
    count = min(table.sample, len(records))
    indices = sorted(random.Random(f"{SEED} {table.name}").sample(range(len(records)), count))
    for index, new, error in pool.imap(remake, [(number, index, records[index]) for index in indices]):
        comparison.add(index, records[index], new, error)
    wrong_layout = table.layout(records) != (ROOT / table.paths[0]).read_text(encoding="utf-8")
    copies = [path for path in table.paths[1:] if (ROOT / path).read_bytes() != (ROOT / table.paths[0]).read_bytes()]
    for path in copies:
        print(f"  {path} is not a copy of {table.paths[0]}")
    if wrong_layout:
        print(f"  {table.paths[0]} is not laid out as the generator lays it out")
    comparison.report(len(records), time.time() - start)
    return comparison.wrong + len(copies) + wrong_layout


def make_all(number, pool, write):
    """All of a file. Records that an earlier run made stand in its .part file and are not made again."""
    table = TABLES[number]
    start, records, comparison = time.time(), table.records(), Comparison(table)
    OUT.mkdir(parents=True, exist_ok=True)
    part = OUT / f"{table.name}.part"
    made = {}
    if part.exists():
        for line in part.read_text(encoding="utf-8").splitlines():
            try:
                index, old, new = json.loads(line)
            except ValueError:
                continue  # the last line of a run that was killed
            # A record whose committed line has changed is made again.
            if index < len(records) and records[index] == old:
                made[index] = new
    if made:
        print(f"{table.name}: {len(made)} records are there from an earlier run", flush=True)
    rest = [(number, index, record) for index, record in enumerate(records) if index not in made]
    failed, shown = 0, time.time()
    with part.open("a", encoding="utf-8") as file:
        # A killed run may have left half a line.
        file.write("\n" if made else "")
        for index, new, error in pool.imap_unordered(remake, rest):
            if error:
                failed += 1
                print(f"  {table.name}, record {index + 1}: {error}", flush=True)
                continue
            made[index] = new
            file.write(json.dumps([index, records[index], new]) + "\n")
            file.flush()
            if time.time() - shown > 10:
                shown = time.time()
                print(f"{table.name}: {len(made)} of {len(records)}", flush=True)
    if failed:
        return failed
    for index, record in enumerate(records):
        comparison.add(index, record, made[index], None)
    text = table.layout([made[index] for index in range(len(records))])
    (OUT / os.path.basename(table.paths[0])).write_text(text, encoding="utf-8")
    part.unlink()
    comparison.report(len(records), time.time() - start)
    if write and comparison.wrong:
        for path in table.paths:
            (ROOT / path).write_text(text, encoding="utf-8")
            print(f"  {path} is written anew")
        return 0
    return comparison.wrong


def main():
    names = [table.name for table in TABLES] + [constant.name for constant in CONSTANTS]
    parser = argparse.ArgumentParser(
        prog="cargo xtask regenerate",
        description="Make the committed reference values and constants again, and compare them",
    )
    parser.add_argument("--check", action="store_true", help="make a sample of each file only, with a fixed seed")
    parser.add_argument("--only", metavar="NAME", nargs="+", choices=names, help="these alone: " + ", ".join(names))
    parser.add_argument("--write", action="store_true", help="write files that differ into the repository")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes (default: one a core)")
    options = parser.parse_args()
    if options.check and options.write:
        parser.error("--write needs all records: leave out --check")
    chosen = options.only or names
    wrong = 0
    with multiprocessing.Pool(options.jobs) as pool:
        for number, table in enumerate(TABLES):
            if table.name in chosen:
                wrong += check(number, pool) if options.check else make_all(number, pool, options.write)
    for constant in CONSTANTS:
        if constant.name in chosen:
            start = time.time()
            failures = constant.verify(options.check)
            verdict = "in order" if not failures else f"{failures} FAIL"
            print(f"{constant.name}: {verdict} ({time.time() - start:.0f} s)", flush=True)
            wrong += failures
    if wrong:
        sys.exit(f"error: {wrong} committed values differ from what was made")


if __name__ == "__main__":
    main()
