"""Makes false certificates from true ones, and fails unless `check_certificate.py` refuses each: python
false_certificates.py FOLDER.

The folder has the certificates of `cargo xtask prove`, one of each theorem. Each kind of line of each
theorem is left out, doubled, exchanged, and has a field missing, unknown, null, infinite and twice; headers and
statements are wrong or too strong; and numbers are changed so that a sentence is false or says less than its theorem.
Of a file only the claims of the changed line are confirmed, so that the reason is the change.

    python false_certificates.py --random 1000 [--seed S] FOLDER [THEOREM ...]

changes one number of a line at random instead, N times. A change that passes is harmless if what the file proves is no
more than the true file does, and if other formulas find no point at which a claim of the line is false
(`recomputed.py`). Enclosures of nothing but points prove no claim; what the checker accepts by mistake is seen if one
of the points shows it.
"""

import argparse
import copy
import json
import math
import os
import random
import sys
import tempfile

from flint import ctx

from ball_basins import BITS, GROUNDED, Refuted, Unconfirmed, star
from ball_hops import Undecided
from check_certificate import check
from claims import FIELDS, KINDS
from recomputed import refutes
from statements import STATEMENTS
from whole_theorems import WHOLE


def read(path):
    with open(path, encoding="utf-8") as file:
        return [json.loads(line) for line in file]


class Files:
    """A folder for changed files, beside the certificate of `rising`, on which another one rests."""

    def __init__(self, folder):
        self.own = tempfile.TemporaryDirectory()
        rising = os.path.join(folder, "rising.jsonl")
        if os.path.exists(rising):
            os.symlink(os.path.abspath(rising), os.path.join(self.own.name, "rising.jsonl"))

    def answer(self, lines, claims, texts=None, found=None):
        """(True, sentence) for a file that passes, or (False, reason). `texts` stand in the place of some lines; what
        it proves goes into `found`."""
        path = os.path.join(self.own.name, "changed.jsonl")
        with open(path, "w", encoding="utf-8") as file:
            for at, line in enumerate(lines):
                file.write((texts or {}).get(at, json.dumps(line, ensure_ascii=False)) + "\n")
        try:
            return True, check(path, claims, 1, found)
        except (Refuted, Unconfirmed, Undecided) as error:
            return False, str(error)


def claims_of(lines, at):
    """The places of the claims of a line."""
    before = sum(KINDS[line["kind"]].count(line) for line in lines[1:at])
    return range(before, before + KINDS[lines[at]["kind"]].count(lines[at]))


def changed(lines, at, fields=None, /, **more):
    """The lines with other fields in one of them, which is copied."""
    return lines[:at] + [{**lines[at], **(fields or {}), **more}] + lines[at + 1 :]


def without(lines, at):
    return lines[:at] + lines[at + 1 :]


def counted(lines):
    """The same with the right number of lines in the header."""
    return [{**lines[0], "lines": len(lines) - 1}] + lines[1:]


def first_of(lines, kind, nth=0):
    return [at for at, line in enumerate(lines) if line.get("kind") == kind][nth]


# Each of these yields (what, changed lines, claims to confirm, texts).


def of_the_header(theorem, lines):
    header = lines[0]
    other = "fig9-points" if theorem == "fig6-points" else "fig6-points"
    for what, fields in (
        ("another version", {"version": header["version"] + 1}),
        ("another format", {"format": "certificate"}),
        ("a version with a decimal point", {"version": float(header["version"])}),
        ("a number of lines with a decimal point", {"lines": float(header["lines"])}),
        ("a name of another theorem", {"theorem": "fig9-cells" if theorem == "fig6-cells" else other}),
        ("a wrong number of lines", {"lines": header["lines"] + 1}),
        ("another statement", {"statement": header["statement"] + " And for all M."}),
        ("an unknown field", {"proved": True}),
    ):
        yield f"header: {what}", changed(lines, 0, fields), [], None
    yield (
        "header: no statement",
        [{name: value for name, value in header.items() if name != "statement"}] + lines[1:],
        [],
        None,
    )
    stronger = stronger_statement(header["statement"])
    if stronger:
        yield "header: a statement that is too strong", changed(lines, 0, statement=stronger), [], None


def stronger_statement(statement):
    """The statement with its first decimal fraction made larger; None if it has none."""
    for word in statement.replace("[", " ").replace(",", " ").split():
        if word.count(".") == 1 and word.replace(".", "").isdigit():
            return statement.replace(word, repr(float(word) * 1.01), 1)
    return None


def of_each_kind(theorem, lines):
    for kind in WHOLE[theorem].KINDS:
        at = first_of(lines, kind)
        line = lines[at]
        yield f"{kind}: a line left out", counted(without(lines, at)), [], None
        yield f"{kind}: a line left out of the file alone", without(lines, at), [], None
        yield f"{kind}: a line doubled", counted(lines[: at + 1] + lines[at:]), [], None
        yield f"{kind}: an unknown kind", changed(lines, at, kind="axiom"), [], None
        later = next(
            (
                k
                for k in range(at + 1, len(lines))
                if lines[k]["kind"] != kind or theorem in ("one-sided", "crisis", "traps")
            ),
            None,
        )
        if later is not None:
            exchanged = list(lines)
            exchanged[at], exchanged[later] = lines[later], lines[at]
            yield f"{kind}: a line exchanged with another one", exchanged, [], None
        field = sorted(FIELDS[kind])[0]
        yield (
            f"{kind}: a field missing",
            lines[:at] + [{name: own for name, own in line.items() if name != field}] + lines[at + 1 :],
            [],
            None,
        )
        yield f"{kind}: an unknown field", changed(lines, at, remark=1), [], None
        for name in sorted(FIELDS[kind]):
            if name == "beyond" and theorem == "one-sided":
                continue
            yield f"{kind}: {name} is null", changed(lines, at, **{name: None}), [], None
            for what, other in other_types(line[name]):
                yield f"{kind}: {name} is {what}", changed(lines, at, **{name: other}), [], None
        text = json.dumps(line)
        yield f"{kind}: a key twice", lines, [], {at: text[:-1] + ', "kind": ' + json.dumps(kind) + "}"}
        digits = next((k for k, c in enumerate(text) if c.isdigit() and text[k - 1] in " ["), None)
        end = next(k for k in range(digits, len(text)) if text[k] in ",]}")
        for what in ("Infinity", "NaN", "1e999"):
            yield f"{kind}: {what} for a number", lines, [], {at: text[:digits] + what + text[end:]}


def other_types(value):
    """The value as other types of JSON, which a reader might take for the same."""
    if type(value) in (int, float):
        yield "a text", repr(value)
        yield "true", True
        yield "of the other type of numbers", float(value) if type(value) is int else int(value)
    elif isinstance(value, list) and value:
        for what, other in other_types(value[0]):
            yield f"{what} in its first part", [other] + value[1:]


def longer(line, factor=1.01):
    """The trap longer, with its speed beyond, so that only a hop tells."""
    a = float(star(line["n"]))
    right = a + factor * (line["right"] - a)
    return {"right": right, "beyond": line["beyond"] and right + 1e-12}


def moved(values, by):
    return [value + by for value in values]


def one_sudden(lines):
    line = lines[1]
    yield (
        "a mass ratio above M1",
        changed(
            changed(lines, 1, largest_mass_ratio=0.91),
            0,
            statement=lines[0]["statement"].replace("0.905619101548374", "0.91"),
        ),
        [0],
        None,
    )
    yield "a smaller mass ratio than is said", changed(lines, 1, largest_mass_ratio=0.5), [0], None
    yield (
        "less than M1 in lines and statement",
        changed(
            changed(lines, 1, largest_mass_ratio=0.5),
            0,
            statement=lines[0]["statement"].replace("0.905619101548374", "0.5"),
        ),
        [0],
        None,
    )
    yield "a side of the inequality too large", changed(lines, 1, needed=line["needed"] * 1.1), [0], None
    yield "a side of the inequality too small", changed(lines, 1, available=line["available"] * 0.9), [0], None
    yield (
        "a fixed point outside of its enclosure",
        changed(lines, 1, fixed_point=moved(line["fixed_point"], 1e-9)),
        [0],
        None,
    )
    yield "a wide enclosure of the fixed point", changed(lines, 1, fixed_point=[4.0, 5.0]), [0], None


def one_sided(lines):
    low, high = lines[2]["fixed_point"]
    yield "a trap a hundredth too long", changed(lines, 3, **longer(lines[3])), [2], None
    yield "a trap of two ulps", changed(lines, 3, right=math.nextafter(lines[3]["fixed_point"][1], 9)), [2], None
    yield (
        "traps of two ulps",
        [lines[0]] + [{**line, "right": math.nextafter(line["fixed_point"][1], 99)} for line in lines[1:]],
        None,
        None,
    )
    yield "a trap that ends below its fixed point", changed(lines, 3, right=lines[3]["fixed_point"][0] - 0.1), [2], None
    yield "a fixed point outside of its enclosure", changed(lines, 2, fixed_point=[low - 1e-9, low]), [1], None
    yield "a wide enclosure of a fixed point", changed(lines, 2, fixed_point=[low - 0.1, high]), [1], None
    yield "a trap at another mass ratio", changed(lines, 2, mass_ratio=0.2), [1], None
    yield "a speed beyond", changed(lines, 2, beyond=lines[2]["right"] + 1.0), [1], None
    yield "half of the humps", counted(lines[:5]), [], None


def crisis(lines):
    low, high = lines[5]["mass_ratio"]
    part = 0.05 * (high - low)
    yield (
        "an enclosure shrunk to a twentieth at its lower end",
        changed(lines, 5, mass_ratio=[high - part, high]),
        [4],
        "or",
    )
    yield (
        "an enclosure shrunk to a twentieth at its upper end",
        changed(lines, 5, mass_ratio=[low, low + part]),
        [4],
        "or",
    )
    yield (
        "a crisis moved by three times its width",
        changed(lines, 5, mass_ratio=[3 * high - 2 * low, 4 * high - 3 * low]),
        [4],
        None,
    )
    # Every speed below alpha*_n falls below it at every mass ratio.
    yield (
        "a crisis too low, with a speed below the hump",
        changed(lines, 5, mass_ratio=[low - 1e-9, high - 1e-9], speed=1.0),
        [4],
        None,
    )
    yield "a speed beyond the contact part", changed(lines, 5, speed=19.0), [4], None
    yield "a number that no f64 is", changed(lines, 5, mass_ratio=[10**400, 10**400]), [4], None
    yield "an enclosure that says little", changed(lines, 5, mass_ratio=[1e-6, 0.9]), [4], None
    yield "an enclosure a thousandth wide", changed(lines, 5, mass_ratio=[low - 5e-4, high + 5e-4]), [4], None
    yield "an inverted enclosure", changed(lines, 5, mass_ratio=[high, low]), [4], None
    yield "three of ten crises", counted(lines[:4]), [], None
    yield "an eleventh that is the tenth", counted(lines + [{**lines[-1], "n": 11}]), [10], None


def traps(lines):
    at = 1005
    claims = claims_of(lines, at)
    right = lines[at]["right"]
    yield "a trap a hundredth too long", changed(lines, at, **longer(lines[at])), claims, None
    yield "a trap a hundredth too short", changed(lines, at, **longer(lines[at], 0.99)), claims, None
    yield "a trap that ends below its fixed point", changed(lines, at, right=1.0, beyond=1.0 + 1e-13), claims, None
    yield (
        "a speed beyond that does not fall",
        changed(lines, at, beyond=right + 1e-16, right=right - 1e-14),
        claims,
        None,
    )
    yield "a speed beyond the contact part", changed(lines, at, beyond=right + 10), claims, None
    yield "an end that is hardly enclosed", changed(lines, at, beyond=right + 1e-6), claims, None
    yield (
        "a mass ratio of another trap",
        changed(lines, at, mass_ratio=0.5 * (lines[at]["mass_ratio"] + lines[at + 1]["mass_ratio"])),
        claims,
        None,
    )
    yield "a mass ratio above 1", changed(lines, 1000, mass_ratio=1.5), [], None
    yield (
        "a fixed point outside of its enclosure",
        changed(lines, at, fixed_point=moved(lines[at]["fixed_point"], 1e-9)),
        claims,
        None,
    )
    yield "seven of eight humps", counted(lines[:7001]), [], None
    yield "every second mass ratio", counted([lines[0]] + lines[2::2]), [], None
    high = [line for line in lines[1:] if line["mass_ratio"] > 0.5]
    yield "high mass ratios alone", counted([lines[0]] + high), [], None


def everything_hops(lines):
    part = first_of(lines, "contact-part", 38)
    losses = first_of(lines, "losses")
    claims, own = claims_of(lines, part), lines[part]
    wide = [1e-6, 0.1115]
    at_wide = lambda line: {**line, "mass_ratio": 0.1115} if line["kind"] != "crisis" else line
    yield (
        "the crisis widened to [1e-6, 0.1115]",
        [changed(lines, 0, statement=of_crisis(lines, wide))[0]]
        + [at_wide(line) for line in changed(lines, 1, mass_ratio=wide)[1:]],
        [0],
        None,
    )
    yield (
        "the crisis widened a little",
        changed(lines, 1, mass_ratio=[lines[1]["mass_ratio"][0] - 1e-9, lines[1]["mass_ratio"][1]]),
        [0],
        None,
    )
    (low, high), tenth = lines[1]["mass_ratio"], 0.05 * (lines[1]["mass_ratio"][1] - lines[1]["mass_ratio"][0])
    for what, pair in (("lower", [high - tenth, high]), ("upper", [low, low + tenth])):
        at_pair = lambda line: {**line, "mass_ratio": pair[1]} if line["kind"] != "crisis" else line
        shrunk = [changed(lines, 0, statement=of_crisis(lines, pair))[0]] + [
            at_pair(line) for line in changed(lines, 1, mass_ratio=pair)[1:]
        ]
        yield f"the crisis shrunk to a twentieth at its {what} end", shrunk, [0], "or"
    low, high = moved(lines[1]["mass_ratio"], 1e-6)
    at_moved = lambda line: {**line, "mass_ratio": high} if line["kind"] != "crisis" else line
    yield (
        "the crisis moved upwards",
        [changed(lines, 0, statement=of_crisis(lines, [low, high]))[0]]
        + [at_moved(line) for line in changed(lines, 1, mass_ratio=[low, high])[1:]],
        [0],
        None,
    )
    lower = moved(lines[1]["mass_ratio"], -1e-3)
    at_lower = lambda line: {**line, "mass_ratio": lower[1]} if line["kind"] != "crisis" else line
    yield (
        "a smaller range of M",
        [changed(lines, 0, statement=of_crisis(lines, lower))[0]]
        + [at_lower(line) for line in changed(lines, 1, mass_ratio=lower)[1:]],
        [0],
        None,
    )
    yield "a bound a fifth higher", changed(lines, part, least_square=1.2 * own["least_square"]), claims, None
    yield "a bound below the fixed point", changed(lines, part, least_square=20.0), claims, None
    yield "a part made shorter", changed(lines, part, speeds=[own["speeds"][0], sum(own["speeds"]) / 2]), claims, None
    yield "a part made longer", changed(lines, part, speeds=[own["speeds"][0], own["speeds"][1] + 1e-3]), claims, None
    yield "a part at another mass ratio", changed(lines, part, mass_ratio=0.05), claims, None
    yield (
        "the bound on losses too low",
        changed(lines, losses, losses=0.9 * lines[losses]["losses"]),
        claims_of(lines, losses),
        None,
    )
    yield (
        "the square too large",
        changed(lines, losses, square=1.1 * lines[losses]["square"]),
        claims_of(lines, losses),
        None,
    )
    yield (
        "losses above the square",
        changed(lines, losses, losses=1.1 * lines[losses]["square"]),
        claims_of(lines, losses),
        None,
    )
    yield (
        "a square below the losses",
        changed(lines, losses, square=0.9 * lines[losses]["losses"]),
        claims_of(lines, losses),
        None,
    )
    yield "losses from elsewhere on", changed(lines, losses, multiple_of_pi=10), claims_of(lines, losses), None
    yield "the last hump left out", counted([line for line in lines if line.get("n") != 8]), [], None


def of_crisis(lines, pair):
    """The statement with another enclosure of the crisis."""
    low, high = lines[1]["mass_ratio"]
    return lines[0]["statement"].replace(repr(low), repr(pair[0])).replace(repr(high), repr(pair[1]))


def rising(lines):
    window, box = first_of(lines, "rising-window"), first_of(lines, "rising-box", 50)
    own = lines[box]
    (low, high), (first, last) = own["speeds"], own["kappas"]
    claims = claims_of(lines, box)
    yield "a box made smaller", changed(lines, box, speeds=[low, 0.5 * (low + high)]), claims, None
    yield "a box made flatter", changed(lines, box, kappas=[first, 0.5 * (first + last)]), claims, None
    yield (
        "a box up to M = 1 next to the fixed point",
        changed(lines, first_of(lines, "rising-box"), kappas=[0.0, 1.0]),
        claims_of(lines, first_of(lines, "rising-box")),
        None,
    )
    yield "a box of another window", changed(lines, box, n=2), claims, None
    yield "a window for all M up to 1", changed(lines, window, largest_mass_ratio=1.0), [], None
    yield "a window for M up to 1e-9", changed(lines, window, largest_mass_ratio=1e-9), [], None
    tiny = [{**line, "largest_mass_ratio": 1e-9} if line.get("kind") == "rising-window" else line for line in lines]
    yield "all windows for M up to 1e-9", tiny, [], None
    yield "a window that begins late", changed(lines, window, speeds=[4.0, lines[window]["speeds"][1]]), [], None
    begin, end = lines[window]["speeds"]
    yield "a window that begins early", changed(lines, window, speeds=[begin - 1e-3, end]), [], None
    yield "a window that ends late", changed(lines, window, speeds=[begin, end + 1e-3]), [], None
    yield "a window that ends early", changed(lines, window, speeds=[lines[window]["speeds"][0], 4.0]), [], None
    last_window = [at for at, line in enumerate(lines) if line.get("kind") == "rising-window"][-1]
    yield "nine of ten windows", counted(lines[:last_window]), [], None


def measures(lines):
    gaps, before = lines[2]["gaps"], len(lines[1]["intervals"])
    at, (left, right, (one, least), (other, more)) = next(
        (at, gap) for at, gap in enumerate(gaps) if len(gap) == 4 and gap[1] - gap[0] > 1e-6
    )
    claim = [before + at]
    changed_to = lambda *gap: changed(lines, 2, gaps=gaps[:at] + list(gap) + gaps[at + 1 :])
    yield (
        "a length in a gap that is too large",
        changed_to([left, right, [one, least + 0.02 * (right - left)], [other, more]]),
        claim,
        None,
    )
    yield "lengths in a gap that are exchanged", changed_to([left, right, [one, more], [other, least]]), claim, None
    yield "lengths longer than their gap", changed_to([left, right, [one, 2 * (right - left)]]), [], None
    yield "a gap counted twice", changed_to(gaps[at], gaps[at]), [], None
    yield "an interval as a gap", changed(lines, 2, gaps=[[*lines[1]["intervals"][5][:2], [0, 1e-9]]]), [], None
    widest = max(range(len(gaps)), key=lambda own: sum(least for _, least in gaps[own][2:]))
    none = [[*gap[:2], *([fate, 0.0] for fate, _ in gap[2:])] for gap in gaps]
    yield "no lengths in any gap", changed(lines, 2, gaps=none), [], None
    yield "a gap left out", changed(lines, 2, gaps=without(gaps, widest)), [], None
    intervals = lines[1]["intervals"]
    place = max(range(1, len(intervals) - 1), key=lambda own: intervals[own][1] - intervals[own][0])
    wider = copy.deepcopy(intervals)
    wider[place][1] = 0.5 * (wider[place][1] + wider[place + 1][0])
    yield "an interval too long", changed(lines, 1, intervals=wider), [place], None
    swapped = copy.deepcopy(intervals)
    swapped[place][2] = 0 if swapped[place][2] != 0 else 1
    shorter = copy.deepcopy(intervals)
    shorter[place][1] = 0.5 * sum(shorter[place][:2])
    yield "an interval too short", changed(lines, 1, intervals=shorter), [place], None
    yield "a fate of an interval exchanged", changed(lines, 1, intervals=swapped), [place], None
    yield "an interval left out", changed(lines, 1, intervals=without(intervals, place)), [], None
    yield "another mass ratio", changed(lines, 1, mass_ratios=[0.3, 0.3]), [], None
    yield "a strip of mass ratios", changed(lines, 1, mass_ratios=[0.1, 0.2]), [], None
    yield "fractions of no humps", changed(lines, 3, humps=0), [], None
    yield (
        "fractions of four humps",
        [lines[0]] + [{**line, "humps": 4} if line["kind"] == "fraction" else line for line in lines[1:]],
        [],
        None,
    )
    open_all = [
        {**line, "uniform": [0.0, 1.0], "by_humps": [0.0, 1.0]} if line.get("kind") == "fraction" else line
        for line in lines
    ]
    yield "fractions between 0 and 1", open_all, [], None
    largest = max(
        (at for at, line in enumerate(lines) if line.get("kind") == "fraction"),
        key=lambda own: lines[own]["uniform"][0],
    )
    for name in ("uniform", "by_humps"):
        low, high = lines[largest][name]
        yield f"{name} shrunk from above", changed(lines, largest, **{name: [low, 0.5 * (low + high)]}), [], None
        yield f"{name} shrunk from below", changed(lines, largest, **{name: [0.5 * (low + high), high]}), [], None


def points(lines):
    at = len(lines) - 2
    fates = copy.deepcopy(lines[at]["fates"])
    fates[0][0] = 0 if fates[0][0] != 0 else 1
    claims = list(claims_of(lines, at))[:1]
    yield "a fate exchanged", changed(lines, at, fates=fates), claims, None
    longer_run = copy.deepcopy(lines[at]["fates"])
    longer_run[0][1] += 1
    yield "one row too many", changed(lines, at, fates=longer_run), claims, None
    shorter_run = copy.deepcopy(lines[at]["fates"])
    shorter_run[0][1] -= 1
    yield "a row too few", changed(lines, at, fates=shorter_run), claims, None
    own = copy.deepcopy(lines[at]["traps"])
    own[1][1] = own[1][0] + 1.01 * (own[1][1] - own[1][0])
    yield "a trap a hundredth too long", changed(lines, at, traps=own), claims, None
    yield "a column at another mass ratio", changed(lines, at, mass_ratio=lines[at]["mass_ratio"] + 1e-4), claims, None
    for part in (1e-3, 1e-12, 1e-14):
        yield (
            f"speeds beside the middle by {part}",
            changed(lines, 2, speeds=[speed * (1 + part) for speed in lines[2]["speeds"]]),
            [],
            None,
        )
    row = copy.deepcopy(lines[2]["speeds"])
    row[1] = math.nextafter(row[1], math.inf)
    yield "a speed an ulp beside the middle", changed(lines, 2, speeds=row), [], None
    yield (
        "a column an ulp beside the middle",
        changed(lines, at, mass_ratio=math.nextafter(lines[at]["mass_ratio"], 1e9)),
        claims,
        None,
    )
    yield "the window of another figure", changed(lines, 1, mass_ratios=[0.1, 0.2]), [], None
    yield "speeds of another window", changed(lines, 1, speeds=moved(lines[1]["speeds"], 1.0)), [], None
    yield "a grid of fewer columns", changed(lines, 1, columns=lines[1]["columns"] - 1), [], None
    yield "a grid of more columns", changed(lines, 1, columns=lines[1]["columns"] + 1), [], None


def cells(lines):
    at = first_of(lines, "basins", 1)
    own = lines[at]["intervals"]
    # One in the window, whose length counts.
    low, high = lines[1]["speeds"]
    place = max(
        (k for k, (left, right, fate) in enumerate(own) if right > low and left < high and fate != 0),
        key=lambda k: own[k][1] - own[k][0],
    )
    claim = [claims_of(lines, at)[place]]
    swapped = copy.deepcopy(own)
    swapped[place][2] = 0
    yield "a fate exchanged", changed(lines, at, intervals=swapped), claim, None
    # One below the window: no area tells it.
    for below, line in enumerate(lines):
        if (
            line.get("kind") == "basins"
            and len(line["intervals"]) > 1
            and line["intervals"][1][1] < lines[1]["speeds"][0]
        ):
            other = copy.deepcopy(line["intervals"])
            other[1][2] = 0 if other[1][2] != 0 else GROUNDED
            yield (
                "a fate exchanged below the window",
                changed(lines, below, intervals=other),
                [claims_of(lines, below)[1]],
                None,
            )
            break
    wider = copy.deepcopy(own)
    wider[place][1] = 0.5 * (wider[place][1] + wider[place + 1][0])
    yield "an interval too long", changed(lines, at, intervals=wider), claim, None
    shorter = copy.deepcopy(own)
    shorter[place][1] = 0.5 * sum(shorter[place][:2])
    yield "an interval too short", changed(lines, at, intervals=shorter), claim, None
    yield "an interval left out", changed(lines, at, intervals=without(own, place)), [], None
    low, high = lines[-1]["share"]
    yield "an area shrunk from above", changed(lines, len(lines) - 1, share=[low, 0.5 * (low + high)]), [], None
    yield "an area shrunk from below", changed(lines, len(lines) - 1, share=[0.5 * (low + high), high]), [], None
    yield (
        "areas that are open",
        [{**line, "share": [0.0, 1.0]} if line.get("kind") == "area" else line for line in lines],
        [],
        None,
    )
    edges = [first + 1e-9 for first in lines[2]["edges"]]
    edges[0], edges[-1] = lines[2]["edges"][0], lines[2]["edges"][-1]
    yield "rows of another height", changed(lines, 2, edges=edges), [], None
    # One more strip for each column, all of them from one strip: equally many for each, at other places.
    ends, columns = lines[at]["mass_ratios"], lines[1]["columns"]
    cuts = [ends[0] + (ends[1] - ends[0]) * k / (columns + 1) for k in range(columns + 1)] + [ends[1]]
    parts = [{**lines[at], "mass_ratios": list(pair)} for pair in zip(cuts, cuts[1:])]
    yield "columns of another width", counted(lines[:at] + parts + lines[at + 1 :]), [], None
    yield "a cell too many", changed(lines, 2, of_one_basin=lines[2]["of_one_basin"] + 1), [], None
    yield "a cell too few", changed(lines, 2, of_one_basin=lines[2]["of_one_basin"] - 1), [], None
    yield "the window of another figure", changed(lines, 1, mass_ratios=[0.1, 0.2]), [], None


FALSE = {
    "one-sudden": one_sudden,
    "one-sided": one_sided,
    "crisis": crisis,
    "traps": traps,
    "everything-hops": everything_hops,
    "rising": rising,
    "measures": measures,
    "fig6-points": points,
    "fig9-points": points,
    "fig6-cells": cells,
    "fig9-cells": cells,
}


def by_name(files, theorem, lines):
    """How many false certificates of a theorem there are, and how many of them pass."""
    passes, reason = files.answer(lines, [])
    if not passes:
        raise Refuted(f"{theorem}: the true one is refused: {reason}")
    number = failures = 0
    either = []
    for source in (of_the_header(theorem, lines), of_each_kind(theorem, lines), FALSE[theorem](lines)):
        for what, own, claims, texts in source:
            passes, reason = files.answer(
                own, None if claims is None else list(claims), texts if isinstance(texts, dict) else None
            )
            number += 1
            if texts == "or":
                # Of an enclosure's two halves one may be true.
                either.append(passes)
                if len(either) < 2 or not all(either):
                    continue
            if passes:
                failures += 1
                print(f"NOT REFUSED {theorem}, {what}: {reason}", flush=True)
    print(f"refused  {theorem}: {number - failures} of {number} false certificates", flush=True)
    return number, failures


def numbers_in(value, path=()):
    """The paths of all numbers in a line."""
    if isinstance(value, bool):
        return
    if isinstance(value, (int, float)):
        yield path
    elif isinstance(value, list):
        for at, own in enumerate(value):
            yield from numbers_in(own, (*path, at))
    elif isinstance(value, dict):
        for name, own in value.items():
            yield from numbers_in(own, (*path, name))


def put(value, path, number):
    """The value with another number at a path."""
    if not path:
        return number
    if isinstance(value, list):
        return value[: path[0]] + [put(value[path[0]], path[1:], number)] + value[path[0] + 1 :]
    return {**value, path[0]: put(value[path[0]], path[1:], number)}


def number_at(value, path):
    for part in path:
        value = value[part]
    return value


def at_random(files, theorem, lines, count, seed):
    """Changes one number of one line at random. Returns how many pass although they prove more than the true file, or a
    false claim."""
    dice = random.Random(f"{theorem} {seed}")
    truth = {}
    files.answer(lines, [], found=truth)
    passed = wrong = 0
    for _ in range(count):
        at = dice.randrange(1, len(lines))
        paths = list(numbers_in(lines[at]))
        path = dice.choice(paths)
        old = number_at(lines[at], path)
        if isinstance(old, int):
            new = dice.choice([old + 1, old - 1, 0, -old, 2 * old])
        else:
            part = 10.0 ** -dice.uniform(0, 16)
            new = dice.choice(
                [
                    old * (1 + part),
                    old * (1 - part),
                    math.nextafter(old, math.inf),
                    math.nextafter(old, -math.inf),
                    -old,
                    0.0,
                ]
            )
        if new == old:
            continue
        own = lines[:at] + [put(lines[at], path, new)] + lines[at + 1 :]
        claims = list(claims_of(own, at)) if KINDS[lines[at]["kind"]].count(own[at]) <= 64 else near(own, at, path)
        proved = {}
        passes, said = files.answer(own, claims, found=proved)
        if not passes:
            continue
        passed += 1
        # All claims of the line hold in balls; other formulas must not find a point where one is false, and what the
        # file proves is what it proved or less.
        reason = refutes(own, at, places(own[at], path)) or (
            stronger(theorem, proved, truth) and "it proves more than is true"
        )
        if reason:
            wrong += 1
            print(f"NOT REFUSED {theorem}, line {at + 1}, {path}: {old!r} as {new!r}: {said}; {reason}", flush=True)
    print(f"random   {theorem}: {count} changes, {passed} harmless ones pass, {wrong} false ones", flush=True)
    return wrong


def places(line, path):
    """The parts of a line that a change touches: all of them if it touches the whole line."""
    name = next((name for name in ("intervals", "gaps", "fates") if name in line), None)
    count = len(line[name]) if name else 0
    if path[0] != name:
        return range(0, count, max(1, count // 8))
    own = next((part for part in path if isinstance(part, int)), 0)
    return range(max(0, own - 1), min(count, own + 2))


def near(lines, at, path):
    """The claims of a long line next to a changed number."""
    own = claims_of(lines, at)
    place = next((part for part in path if isinstance(part, int)), 0)
    return [own[k] for k in range(max(0, place - 1), min(len(own), place + 2))]


def stronger(theorem, proved, truth):
    """Whether a file proves more than the true one, by the relations of the manifest: longer traps, a larger range,
    another window."""
    for name, bound in STATEMENTS[theorem]["scopes"][0].items():
        if name == "scope":
            continue
        (relation,) = bound
        as_list = lambda value: value if isinstance(value, (list, tuple)) else [value]
        own, true = as_list(proved[name]), as_list(truth[name])
        if len(own) != len(true):
            return True
        for a, b in zip(own, true):
            # Beyond the digits to which the true number is known. An enclosure some ulps wide may lose one or two of
            # them, and still contain the truth: its line is recomputed.
            room = 0.5 if name.startswith("width") else 1e-2
            too_large, too_small = a > b + room * abs(b), a < b - room * abs(b)
            if relation == "is" and a != b or relation == "least" and too_large or relation == "most" and too_small:
                return True
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--random", type=int, metavar="N", help="make N random changes of each certificate instead")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    parser.add_argument("folder")
    parser.add_argument("theorems", nargs="*", metavar="THEOREM")
    options = parser.parse_args()
    ctx.prec = BITS
    if FALSE.keys() != WHOLE.keys():
        print(f"NOT REFUSED: no false certificates of {set(WHOLE) ^ set(FALSE)}")
        return 1
    number = failures = 0
    files = Files(options.folder)
    for theorem in FALSE:
        path = os.path.join(options.folder, f"{theorem}.jsonl")
        if options.theorems and theorem not in options.theorems:
            continue
        if not os.path.exists(path):
            print(f"NOT REFUSED: {path} is not there, so nothing false about {theorem} was tried")
            failures += 1
            continue
        lines = read(path)
        if options.random:
            failures += at_random(files, theorem, lines, options.random, options.seed)
        else:
            more, wrong = by_name(files, theorem, lines)
            number, failures = number + more, failures + wrong
    if not options.random:
        print(f"{number} false certificates, {failures} not refused")
    return int(failures > 0)


if __name__ == "__main__":
    sys.exit(main())
