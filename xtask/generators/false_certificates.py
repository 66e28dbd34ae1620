"""Makes false certificates from true ones, and fails unless `check_certificate.py` refuses each: python false_certificates.py FOLDER.

The folder has the certificates of `cargo xtask prove`, at least one-sided, crisis, traps and everything-hops. Others are falsified if
they are there.
"""

import copy
import json
import os
import sys
import tempfile

from flint import ctx

from ball_basins import BITS, GROUNDED, Refuted, Unconfirmed, star
from ball_hops import Undecided
from check_certificate import FORMAT, VERSION, check

# A file of many equal lines is shortened to so many of each hump: what is falsified is then among the claims that are confirmed.
KEPT = 3


def read(path):
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def refused(lines, recount=True, claims=None):
    """The reason, or None if the certificate is confirmed, of which only some claims may be looked at."""
    lines = copy.deepcopy(lines)
    if recount:
        lines[0]["lines"] = len(lines) - 1
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl", encoding="utf-8", delete=False) as file:
        file.writelines(json.dumps(line) + "\n" for line in lines)
    try:
        check(file.name, claims, 1)
    except (Refuted, Unconfirmed, Undecided) as error:
        return str(error)
    finally:
        os.unlink(file.name)
    return None


def changed(lines, at, **fields):
    """A copy with other fields in one line."""
    lines = copy.deepcopy(lines)
    lines[at].update(fields)
    return lines


def longer(line):
    """The trap a hundredth longer, with its speed beyond, so that only a hop tells."""
    a = float(star(line["n"]))
    right = a + 1.01 * (line["right"] - a)
    return {"right": right, "beyond": line["beyond"] and right + 1e-12}


def without(lines, at):
    return lines[:at] + lines[at + 1 :]


def one_sided(lines):
    yield "a trap a hundredth too long", [changed(lines, 3, **longer(lines[3]))], "line 4"
    low = lines[2]["fixed_point"][0]
    yield "a fixed point outside of its enclosure", [changed(lines, 2, fixed_point=[low - 1e-9, low])], "line 3"
    yield "a hump left out", [without(lines, 2)], "line 3"


def crisis(lines):
    low, high = lines[5]["mass_ratio"]
    part = 0.05 * (high - low)
    shrunk = [changed(lines, 5, mass_ratio=ends) for ends in ([low, low + part], [high - part, high])]
    yield "one of two enclosures shrunk to a twentieth", shrunk, "line 6"
    yield "a crisis moved by three times its width", [changed(lines, 5, mass_ratio=[3 * high - 2 * low, 4 * high - 3 * low])], "line 6"
    # Every speed below alpha*_n falls below it at every mass ratio.
    lower = [low - 1e-9, high - 1e-9]
    yield "a crisis too low, with a speed below the hump", [changed(lines, 5, mass_ratio=lower, speed=1.0)], "line 6"
    yield "a number that no f64 is", [changed(lines, 5, mass_ratio=[10**400, 10**400])], "line 6"


def traps(lines):
    by_hump = {}
    for line in lines[1:]:
        by_hump.setdefault(line["n"], []).append(line)
    lines = [lines[0]] + [line for own in by_hump.values() for line in own[-KEPT:]]
    if refused(lines):
        raise Refuted(refused(lines))
    yield "a trap a hundredth too long", [changed(lines, 5, **longer(lines[5]))], "line 6"
    yield "a speed beyond that does not fall", [changed(lines, 5, beyond=lines[5]["right"] + 1e-16, right=lines[5]["right"] - 1e-14)], "line 6"
    yield "a trap left out", [without(lines, 4)], "line"
    yield "a line left out of the file", [without(lines, 4)], "line", False


def everything_hops(lines):
    bound = 1.2 * lines[40]["least_square"]
    yield "a bound a fifth higher", [changed(lines, 40, least_square=bound)], "line 41"
    yield "a part left out", [without(lines, 40)], "line 41"
    yield "the bound on losses too low", [changed(lines, len(lines) - 1, losses=0.9 * lines[-1]["losses"])], f"line {len(lines)}"


def rising(lines):
    last = next(at for at, line in enumerate(lines) if at > 1 and line["kind"] == "rising-window")
    lines = lines[:last]
    yield "a box left out", [without(lines, 100)], "boxes of window 1 leave a gap"
    low, high = lines[50]["speeds"]
    yield "a box made smaller", [changed(lines, 50, speeds=[low, 0.5 * (low + high)])], "leave a gap"


def measures(lines):
    gaps, before = lines[2]["gaps"], len(lines[1]["intervals"])
    at, (left, right, (one, least), (other, more)) = next(
        (at, gap) for at, gap in enumerate(gaps) if len(gap) == 4 and gap[1] - gap[0] > 1e-6
    )
    # The sums are looked at in any case, of the claims that of the gap alone.
    claim = [before + at]
    changed_to = lambda *gap: [changed(lines, 2, gaps=gaps[:at] + list(gap) + gaps[at + 1 :])]
    if refused(lines, claims=claim):
        raise Refuted(refused(lines, claims=claim))
    longer = least + 0.02 * (right - left)
    yield "a length in a gap that is too large", changed_to([left, right, [one, longer], [other, more]]), "line 3", True, claim
    yield "lengths in a gap that are swapped", changed_to([left, right, [one, more], [other, least]]), "line", True, claim
    yield "lengths longer than their gap", changed_to([left, right, [one, 2 * (right - left)]]), "line 3", True, []
    yield "a gap counted twice", changed_to(gaps[at], gaps[at]), "line 3", True, []
    yield "an interval as a gap", [changed(lines, 2, gaps=[[*lines[1]["intervals"][5][:2], [0, 1e-9]]])], "line 3", True, []
    widest = max(range(len(gaps)), key=lambda own: sum(least for _, least in gaps[own][2:]))
    yield "a gap left out", [changed(lines, 2, gaps=without(gaps, widest))], "do not show", True, []
    yield "fractions of no humps", [changed(lines, 3, humps=0)], "line 4", True, []


def points(lines):
    at = len(lines) - 2
    fates = copy.deepcopy(lines[at]["fates"])
    fates[0][0] = 0 if fates[0][0] != 0 else 1
    yield "a fate swapped", [changed(lines, at, fates=fates)], f"line {at + 1}"
    own = copy.deepcopy(lines[at]["traps"])
    own[1][1] = own[1][0] + 1.01 * (own[1][1] - own[1][0])
    yield "a trap a hundredth too long", [changed(lines, at, traps=own)], f"line {at + 1}"
    yield "a column left out", [without(lines, at)], "line"


def cells(lines):
    at = next(at for at, line in enumerate(lines) if line.get("kind") == "basins") + 1
    own = lines[at]["intervals"]
    swapped = copy.deepcopy(own)
    place = next(k for k, (_, _, fate) in enumerate(own) if k > len(own) // 2 and fate != 0)
    swapped[place][2] = 0
    yield "a label swapped", [changed(lines, at, intervals=swapped)], "line"
    # One label swapped below the window: no area tells it.
    for below, line in enumerate(lines):
        if line.get("kind") == "basins" and len(line["intervals"]) > 1 and line["intervals"][1][1] < lines[1]["speeds"][0]:
            other = copy.deepcopy(line["intervals"])
            other[1][2] = 0 if other[1][2] != 0 else GROUNDED
            yield "a label swapped below the window", [changed(lines, below, intervals=other)], f"line {below + 1}"
            break
    wider = copy.deepcopy(own)
    wider[place][1] = 0.5 * (wider[place][1] + wider[place + 1][0])
    yield "an interval too long", [changed(lines, at, intervals=wider)], f"line {at + 1}"
    yield "an interval left out", [changed(lines, at, intervals=without(own, place))], "line"
    yield "a strip left out", [without(lines, at)], f"line {at + 1}"
    low, high = lines[-1]["share"]
    yield "an area shrunk", [changed(lines, len(lines) - 1, share=[low, 0.5 * (low + high)])], f"line {len(lines)}"
    edges = [first + 1e-9 for first in lines[2]["edges"]]
    edges[0], edges[-1] = lines[2]["edges"][0], lines[2]["edges"][-1]
    yield "rows of another height", [changed(lines, 2, edges=edges)], "line 3"
    # One more strip for each column, all of them from one strip: equally many for each, at other places.
    ends, columns = lines[at]["mass_ratios"], lines[1]["columns"]
    cuts = [ends[0] + (ends[1] - ends[0]) * k / (columns + 1) for k in range(columns + 1)] + [ends[1]]
    parts = [{**lines[at], "mass_ratios": list(pair)} for pair in zip(cuts, cuts[1:])]
    yield "columns of another width", [lines[:at] + parts + lines[at + 1 :]], "edge of a column"
    more = lines[2]["of_one_basin"] + 1
    yield "a cell too many", [changed(lines, 2, of_one_basin=more)], "line"


FALSE = {
    "one-sided": one_sided,
    "crisis": crisis,
    "traps": traps,
    "everything-hops": everything_hops,
    "rising": rising,
    "measures": measures,
    "fig6-points": points,
    "fig6-cells": cells,
}
NEEDED = ("one-sided", "crisis", "traps", "everything-hops")


def main():
    folder = sys.argv[1]
    ctx.prec = BITS
    failures = 0
    for theorem, falsify in FALSE.items():
        path = os.path.join(folder, f"{theorem}.jsonl")
        if not os.path.exists(path) and theorem not in NEEDED:
            continue
        for what, variants, reason, *how in falsify(read(path)):
            # Of an enclosure's two halves one may be true.
            reasons = [refused(lines, *how) for lines in variants]
            found = next((text for text in reasons if text and reason in text), None)
            print(f"{'refused ' if found else 'NOT REFUSED'} {theorem}, {what}: {found or reasons}", flush=True)
            failures += found is None
    return int(failures > 0)


if __name__ == "__main__":
    sys.exit(main())
