"""Makes false certificates of any model from true ones, and fails unless the checker refuses each: python
false_any_model.py FOLDER.

The folder has `rossler.jsonl`, `impact_oscillator.jsonl`, `spring_leg.jsonl` and `henon.jsonl` of the examples of validated-dynamics. They are cut to one
statement of each kind, which passes, so that the reason of a refusal is the change: of the equations, the maps, the statements, the
steps, the fields.
"""

import copy
import json
import os
import sys
import tempfile

from flint import ctx

from any_model.check import check
from ball_basins import BITS
from certificate_file import Refuted, Unconfirmed, Undecided


def read(folder, name):
    with open(os.path.join(folder, f"{name}.jsonl"), encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def cut(lines, keep):
    """The lines that are kept, with models that they need, under a name of one's own."""
    kept = [line for line in lines[1:] if line["kind"] in ("system", "map") or keep(line)]
    return [{**lines[0], "name": "cut", "lines": len(kept)}, *kept]


def with_cells(lines, nth, count, keep):
    """The first cells of the basins with this number, and the lines that are kept."""
    basins = at(lines, "basins", nth)
    own = [{**lines[basins], "cells": count}, *lines[basins + 1 : basins + 1 + count]]
    kept = [*cut(lines, keep), *own]
    return put(kept, 0, ["lines"], len(kept) - 1)


def answer(folder, lines, texts=None):
    """(True, sentence) for a file that passes, or (False, reason)."""
    path = os.path.join(folder, "changed.jsonl")
    with open(path, "w", encoding="utf-8") as file:
        for at, line in enumerate(lines):
            file.write((texts or {}).get(at, json.dumps(line, ensure_ascii=False)) + "\n")
    try:
        return True, check(path)
    except (Refuted, Unconfirmed, Undecided) as error:
        return False, str(error)


def at(lines, kind, nth=0):
    return [place for place, line in enumerate(lines) if line.get("kind") == kind][nth]


def put(lines, place, path, value):
    """The lines with another value at a path of one of them: a value, or a function of the one before."""
    lines = lines[:place] + [copy.deepcopy(lines[place])] + lines[place + 1 :]
    own = lines[place]
    for key in path[:-1]:
        own = own[key]
    own[path[-1]] = value(own[path[-1]]) if callable(value) else value
    return lines


# Each of these yields (what, changed lines, texts of lines or None).


def of_the_form(lines):
    """What is no certificate: in every kind of line."""
    for field, value in (("version", 2), ("version", True), ("format", "certificate"), ("name", 7)):
        yield f"header: {field} is {value!r}", put(lines, 0, [field], value), None
    for lines_more in (-1, 1):
        yield f"header: {lines_more} lines", put(lines, 0, ["lines"], lambda n: n + lines_more), None
    kinds = {line["kind"]: place for place, line in reversed(list(enumerate(lines))) if place}
    for kind, place in kinds.items():
        yield f"{kind}: left out", put(lines[:place] + lines[place + 1 :], 0, ["lines"], len(lines) - 2), None
        yield f"{kind}: an unknown field", put(lines, place, ["proved"], True), None
        yield f"{kind}: of another kind", put(lines, place, ["kind"], "claim"), None
        text = json.dumps(lines[place], ensure_ascii=False)
        yield f"{kind}: a field twice", lines, {place: text.replace("{", '{"kind": "claim", ', 1)}
        yield f"{kind}: half of it", lines, {place: text[: len(text) // 2]}
        for field in lines[place]:
            if field != "kind":
                less = {name: value for name, value in lines[place].items() if name != field}
                yield f"{kind}: no {field}", lines[:place] + [less] + lines[place + 1 :], None
            if lines[place][field] is not None and (kind, field) not in HARMLESS_NULLS:
                yield f"{kind}: {field} is null", put(lines, place, [field], None), None


# No target is a weaker statement: points are led to the surface.
HARMLESS_NULLS = {("leads", "to")}


def of_rossler(lines):
    system, map_, fixed = at(lines, "system"), at(lines, "map"), at(lines, "fixed-point")
    field = ["modes", 0, "field"]
    yield "another parameter", put(lines, system, ["parameters", 2, 1], "5.7000001"), None
    yield "a sign of the field", put(lines, system, [*field, 0], "-y + z"), None
    yield "a factor of the field", put(lines, system, [*field, 1], "x + 1.0001*a*y"), None
    yield "another surface", put(lines, system, ["modes", 0, "guards", 0, "guard"], "x - 0.001"), None
    yield "the other direction", put(lines, system, ["modes", 0, "guards", 0, "side_after"], -1.0), None
    yield "no direction", put(lines, system, ["modes", 0, "guards", 0, "side_after"], None), None
    yield "a direction of 2", put(lines, system, ["modes", 0, "guards", 0, "side_after"], 2.0), None
    yield "a condition that fails", put(lines, system, ["modes", 0, "guards", 0, "condition"], "-1 - z^2"), None
    yield "a surface that stops", put(lines, system, ["modes", 0, "guards", 0, "stops"], True), None
    yield "a reset", put(lines, system, ["modes", 0, "guards", 0, "after"], ["x", "y", "z + 0.001"]), None
    yield "a mode that is not there", put(lines, system, ["modes", 0, "guards", 0, "mode"], "fly"), None
    second = {"surface": "wall", "guard": "y + 8.5", "side_after": -1.0, "bounds_flow": True, "condition": None,
              "stops": True, "mode": "flow", "after": None}  # fmt: skip
    yield "a wall on the way", put(lines, system, ["modes", 0, "guards"], lambda own: [*own, second]), None
    guard = ["modes", 0, "guards", 0]
    yield "a surface without a name", put(lines, system, [*guard, "surface"], None), None
    yield "a surface that is a number", put(put(lines, system, [*guard, "surface"], "0"), map_, ["surface"], "0"), None
    yield "a mode that is a number", put(lines, system, ["modes", 0, "mode"], "1"), None
    yield "a state that is a constant", put(lines, system, ["states", 0], "pi"), None
    yield "two states of one name", put(lines, system, ["states", 2], "y"), None
    yield "a state like a parameter", put(lines, system, ["states", 2], "c"), None
    yield "two parameters of one name", put(lines, system, ["parameters", 0, 0], "b"), None
    yield "a variable like a parameter", put(lines, map_, ["variables", 0], "a"), None
    yield "two variables of one name", put(lines, map_, ["variables"], ["y", "y"]), None
    yield "a parameter that is a sentence", put(lines, system, ["parameters", 0, 0], "all is proved for a"), None
    yield "a number that is infinite", put(lines, system, ["parameters", 0, 1], "1/f64(1e999)"), None
    yield "a name of two lines", put(lines, 0, ["name"], "rossler (as it should)\nproves: everything"), None
    yield "a map from behind", put(lines, map_, ["system"], -1), None
    yield "a map that is true", put(lines, fixed, ["map"], False), None
    yield "the second event", put(lines, map_, ["count"], 2), None
    yield "half an event", put(lines, map_, ["count"], 0.5), None
    yield "another surface's event", put(lines, map_, ["surface"], "wall"), None
    yield "another reading", put(lines, map_, ["read", 0], "y + 1e-9"), None
    yield "another chart", put(lines, map_, ["states", 0], "1e-9"), None
    yield "a chart that runs away", put(lines, map_, ["states", 2], "z + 0.1*y"), None
    yield from of_a_run(lines, fixed, ["at_centre"])


def of_a_fixed_point(lines):
    fixed = at(lines, "fixed-point")
    low = lines[fixed]["point"][0][0]
    for name in ("unique_in", "point"):
        for side, sign in ((0, -1), (1, 1)):
            wider = lambda x, sign=sign: x + sign * 0.3
            narrower = lambda x, sign=sign: x - sign * 1e-9
            yield f"{name}: wider", put(lines, fixed, [name, 0, side], wider), None
            yield f"{name}: elsewhere", put(lines, fixed, [name, 1, side], narrower), None
    yield "a box that is too narrow", put(lines, fixed, ["unique_in", 0], [low, low]), None
    yield "a point that is too narrow", put(lines, fixed, ["point", 0], [low, low]), None
    yield "a centre outside", put(lines, fixed, ["centre", 0], low - 1), None
    yield "a multiplier elsewhere", put(lines, fixed, ["multipliers", 1, 0], -0.9), None
    yield "a multiplier that is real", put(lines, fixed, ["multipliers", 1, 1], 0), None
    yield "a disc that is too small", put(lines, fixed, ["multipliers", 1, 2], 1e-16), None
    yield "a multiplier less", put(lines, fixed, ["multipliers"], lambda own: own[:1]), None
    yield "runs exchanged", put(lines, fixed, ["in_unique"], lines[fixed]["at_centre"]), None


def of_a_run(lines, place, path):
    """Changes of the steps of a run."""
    own = lines[place]
    for key in path:
        own = own[key]
    name, last = f"run {path[-1]}", len(own["steps"]) - 1
    change = lambda more, value: put(lines, place, [*path, *more], value)
    middle = last // 2
    yield f"{name}: a step left out", change(["steps"], lambda all_: all_[:middle] + all_[middle + 1 :]), None
    yield f"{name}: a step twice", change(["steps"], lambda all_: all_[: middle + 1] + all_[middle:]), None
    yield f"{name}: no end", change(["steps"], lambda all_: all_[:-1]), None
    yield f"{name}: no steps", change(["steps"], []), None
    yield f"{name}: an end twice", change(["steps"], lambda all_: [*all_, all_[-1]]), None
    yield f"{name}: an unknown step", change(["steps", middle, 0], "jump"), None
    for step in (0, middle, last):
        centre = own["steps"][step][-1][0]
        widest = max(range(len(centre)), key=lambda k: abs(centre[k]))
        set_ = ["steps", step, len(own["steps"][step]) - 1]
        moved = lambda x: x + 1e-3 * abs(x) + 1e-3
        yield f"{name}: step {step} elsewhere", change([*set_, 0, widest], moved), None
        yield f"{name}: step {step} narrower", change([*set_, 2], lambda radii: [radius / 3 for radius in radii]), None
        yield f"{name}: step {step} flat", change([*set_, 1, 0], lambda row: [0.0] * len(row)), None
        yield f"{name}: step {step} with a radius below 0", change([*set_, 2, 0], -1.0), None
        if own["steps"][step][0] == "flow":
            yield f"{name}: step {step} longer", change(["steps", step, 1], lambda length: 1.01 * length), None
            yield f"{name}: step {step} back", change(["steps", step, 1], lambda length: -length), None
        if own["steps"][step][0] == "event":
            yield f"{name}: step {step} at another surface", change(["steps", step, 1], "wall"), None
            yield f"{name}: step {step} too soon", change(["steps", step, 2], lambda length: 0.01 * length), None
    yield f"{name}: an image elsewhere", change(["image", 0, 0], lambda x: x + 1e-3), None
    yield f"{name}: a narrower image", change(["image", 2], lambda radii: [radius / 3 for radius in radii]), None
    yield f"{name}: no image", change(["image"], None), None
    yield f"{name}: a start elsewhere", change(["start", 0, 0], lambda x: x + 1e-3), None
    if own["begin"] is not None:
        yield f"{name}: it begins elsewhere", change(["begin", 0, 0], lambda x: x + 1e-3), None


def of_impacts(lines):
    system, map_ = at(lines, "system"), at(lines, "map")
    guard = ["modes", 0, "guards", 0]
    yield "another restitution", put(lines, system, ["parameters", 4, 1], "0.81"), None
    yield "a stop that is passed", put(lines, system, [*guard, "after"], None), None
    yield "a stop from the other side", put(lines, system, [*guard, "side_after"], -1.0), None
    yield "a mirror for the stop", put(lines, system, [*guard, "after", 1], "-v"), None
    yield "a reset that moves", put(lines, system, [*guard, "after", 0], "x - 1e-6"), None
    yield "an event that is none", put(lines, system, [*guard, "condition"], "v - 1.86"), None
    yield "another period", put(lines, map_, ["read", 1], "t - 2*pi/1.3000001"), None
    yield "a start beyond the stop", put(lines, map_, ["states", 0], "stop + 1e-9"), None


def of_intervals(lines):
    fixed = at(lines, "fixed-point")
    yield "more of a parameter", put(lines, fixed, ["parameters", 0, 1], lambda x: x + 1e-3), None
    yield "another parameter", put(lines, fixed, ["parameters", 0], [1.2, 1.21]), None
    yield "an interval that is inverted", put(lines, fixed, ["parameters", 0], [0.96, 0.95]), None
    yield "no parameter", put(lines, fixed, ["parameters"], []), None


def of_a_trap(lines):
    trap = at(lines, "trap")
    yield "a larger trap", put(lines, trap, ["size"], lambda size: 2 * size), None
    yield "a trap without size", put(lines, trap, ["size"], 0), None
    yield "a trap elsewhere", put(lines, trap, ["centre", 0], lambda x: x + 0.1), None
    yield "longer directions", put(lines, trap, ["directions", 0, 0], lambda x: 3 * x), None
    if lines[trap]["growth"]:
        last = ["growth", len(lines[trap]["growth"]) - 1]
        yield "a larger end of growth", put(lines, trap, [*last, "size"], lambda size: 1.1 * size), None
        yield "a part left out", put(lines, trap, [*last, "parts"], lambda parts: parts[1:]), None
        yield "a wider part", put(lines, trap, [*last, "parts", 0, "box", 0, 0], lambda x: x - 0.1), None
        yield "growth to a smaller size", put(lines, trap, [*last, "size"], 1e-9), None
        yield "a run of another part", put(
            lines, trap, [*last, "parts", 0, "run"], lines[trap]["growth"][last[1]]["parts"][-1]["run"]
        ), None


def of_a_fall(lines):
    system, leads = at(lines, "system"), at(lines, "leads")
    yield "a box that is not led", put(lines, leads, ["box", 0], [1.9, 2.0]), None
    yield "no parts", put(lines, leads, ["parts"], []), None
    yield "a part that is another", put(lines, leads, ["parts", 0, "box", 0], [2.0, 2.1]), None
    yield "a target that is not there", put(lines, leads, ["to"], ["trap", 3]), None
    yield "a target of no kind", put(lines, leads, ["to"], ["cell", 0]), None
    yield "ground below", put(lines, system, ["modes", 0, "guards", 2, "guard"], "height + 5"), None
    yield "a softer leg", put(lines, system, ["parameters", 1, 1], "1e4"), None
    yield from of_a_run(lines, leads, ["parts", 0, "run"])


def of_cells(lines):
    basins, first = at(lines, "basins"), at(lines, "cell")
    maps = at(lines, "map")
    led = next(place for place in range(first, len(lines)) if lines[place]["run"] is not None)
    yield "a larger window", put(lines, basins, ["window", 0], [-8.0, 8.0]), None
    yield "a cell more", put(lines, basins, ["cells"], lambda n: n + 1), None
    yield "a cell less", put(lines, basins, ["cells"], lambda n: n - 1), None
    yield "another fate", put(lines, first, ["fate"], 1), None
    yield "a fate from behind", put(lines, first, ["fate"], -1), None
    yield "a fate that is true", put(lines, first, ["fate"], False), None
    yield "a parameter that moves", put(put(lines, maps, ["variables"], ["x", "y", "p"]), maps, ["formulas"],
                                        lambda own: [*own, "p + 1"]), None  # fmt: skip
    yield "a fate at a surface", put(lines, led, ["fate"], "wall"), None
    yield "a cell elsewhere", put(lines, led + 1, ["box"], lines[led]["box"]), None
    yield "a cell that is none", put(lines, led, ["box", 0, 0], lambda x: x + 1e-3), None
    yield "a cell twice", put(lines[: led + 1] + lines[led:], 0, ["lines"], len(lines)), None
    yield "a cell without a run", put(lines, led, ["run"], None), None
    far = next(place for place in range(len(lines) - 1, led, -1) if lines[place]["run"] is not None)
    swapped = lines[:led] + [lines[far]] + lines[led + 1 : far] + [lines[led]] + lines[far + 1 :]
    yield "a cell before those that it needs", swapped, None
    yield "another map", put(lines, maps, ["formulas", 0], "1 - a*x^2 + 1.01*y"), None
    yield "a map applied twice", put(lines, maps, ["times"], 2), None
    yield "another number of variables", put(lines, maps, ["dimension"], 1), None
    yield from of_a_run(lines, led, ["run"])


def of_sets(lines):
    wild, keeps = at(lines, "map", 1), at(lines, "keeps")
    basins, first = at(lines, "basins"), at(lines, "cell")
    escapes, stays = ["sets", 1, 1], ["sets", 0, 1]
    part = next(k for k, part in enumerate(lines[keeps]["parts"]) if near_the_middle(part["box"]))
    own = ["parts", part]
    yield "a smaller set that escapes", put(lines, wild, [*escapes, 0], "x^2 - 1e6"), None
    yield "a smaller set that stays", put(lines, wild, [*stays, 0], lambda text: text + " - 0.5"), None
    yield "a larger set that stays", put(lines, wild, stays, lambda all_: all_[:3]), None
    yield "a condition of another variable", put(lines, wild, [*escapes, 0], "z - 1"), None
    yield "a set without conditions", put(lines, wild, escapes, []), None
    yield "a set with the name of another", put(lines, wild, ["sets", 1, 0], "stays"), None
    yield "a set without a name", put(lines, wild, ["sets", 1, 0], ""), None
    yield "another map with the sets", put(lines, wild, ["parameters", 0, 1], "1.5"), None
    yield "a map with sets that is applied twice", put(lines, wild, ["times"], 2), None
    yield "another set that is kept", put(lines, keeps, ["set"], "escapes"), None
    yield "no set that is kept", put(lines, keeps, ["set"], "wall"), None
    yield "a set of another map", put(lines, keeps, ["map"], 0), None
    yield "a box that images leave", put(lines, keeps, ["box", 0, 1], 1.0), None
    yield "a wider box", put(lines, keeps, ["box", 1, 1], 0.7), None
    yield "a part less", put(lines, keeps, ["parts"], lambda parts: parts[:part] + parts[part + 1 :]), None
    yield "a part wider than its run", put(lines, keeps, [*own, "run", "start", 2, 0], lambda r: r / 2), None
    yield "a part of another run", put(lines, keeps, [*own, "run"], lines[keeps]["parts"][0]["run"]), None
    yield "a part without steps", put(lines, keeps, [*own, "run", "steps"], []), None
    yield "an image that is smaller", put(lines, keeps, [*own, "run", "steps", 0, 1, 2], [1e-9, 1e-9]), None
    yield "the other set", put(lines, first, ["fate"], "escapes" if lines[first]["fate"] == "stays" else "stays"), None
    yield "a set that is none", put(lines, first, ["fate"], "wall"), None
    yield "a cell of a set without a run", put(lines, first, ["run"], None), None
    yield "a name that breaks the line", put(lines, wild, [*escapes, 0], "x^2 -\n2.25"), None
    yield "a set that is a text", put(lines, wild, escapes, "x"), None
    yield "no cells", put(put(lines[: first], basins, ["cells"], 0), 0, ["lines"], first - 1), None
    yield "a box without a point of the set", put(
        put(lines, keeps, ["box"], [[-1.4, -1.39], [0.5, 0.6]]), keeps, ["parts"], [{"box": [[-1.4, -1.39], [0.5, 0.6]], "run": None}]
    ), None  # fmt: skip
    yield "a cell of a set without steps", put(lines, first, ["run", "steps"], []), None
    yield "more cells of sets", put(lines, basins, ["cells"], lambda n: n + 1), None


def near_the_middle(box):
    """True for a part of Hénon's quadrilateral, whose run is looked at."""
    return all(low <= 0 <= high for low, high in box)


def without_growth(lines):
    """The lines with traps that do not grow."""
    return [{**line, "growth": []} if line.get("kind") == "trap" else line for line in lines]


def main():
    ctx.prec = BITS
    folder = sys.argv[1]
    rossler, impacts, runner, henon = (
        read(folder, name) for name in ("rossler", "impact_oscillator", "spring_leg", "henon")
    )
    first = [line for line in impacts if line.get("kind") == "fixed-point"][0]
    interval = next(line for line in impacts if line.get("kind") == "fixed-point" and line["parameters"])
    traps = cut(without_growth(runner), lambda line: line["kind"] == "trap")
    falls = cut(runner, lambda line: line["kind"] == "leads")
    grown = cut(henon, lambda line: line["kind"] == "trap")
    few = with_cells(henon, 0, 400, lambda line: line["kind"] == "trap")
    sets = with_cells(henon, 1, 40, lambda line: line["kind"] == "keeps")
    suites = [
        ("rossler", rossler, (of_rossler,)),
        ("impacts", cut(impacts, lambda line: line == first), (of_the_form, of_impacts, of_a_fixed_point)),
        ("intervals", cut(impacts, lambda line: line == interval), (of_intervals,)),
        ("trap", traps, (of_a_trap,)),
        ("fall", falls, (of_the_form, of_a_fall)),
        ("grown trap", grown, (of_a_trap,)),
        ("cells", few, (of_the_form, of_cells)),
        ("sets", sets, (of_sets,)),
    ]
    failed = total = 0
    with tempfile.TemporaryDirectory() as own:
        for name, lines, changes in suites:
            passes, why = answer(own, lines)
            if not passes:
                print(f"FAILED {name}: the true certificate is refused: {why}")
                failed += 1
            for what, changed, texts in (found for change in changes for found in change(lines)):
                passes, sentence = answer(own, changed, texts)
                total += 1
                if passes:
                    failed += 1
                    print(f"FAILED {name}: {what}: it passes: {sentence[:300]}")
    print(f"{total} false certificates of any model, {total - failed} refused")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
