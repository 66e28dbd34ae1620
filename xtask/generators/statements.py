"""The sentence that a certificate proves, against the one that it prints and against the ones that are wanted.

`statements.json` is the manifest: for each theorem the text of its statement, with the numbers that a file must show in
braces, and its scopes: what a file must prove at least, such as the ranges of n and M, the widths, the window. What a
file *proves* is derived from its lines alone (`derived` of the classes in `whole_theorems.py`). A file whose text says
another number, or that falls short of every scope, is refused.
"""

import json
import os
import re

from ball_basins import Refuted

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "statements.json"), encoding="utf-8") as file:
    STATEMENTS = json.load(file)

PLACE = re.compile(r"(?<!\{)\{([a-z_]+)(?:\[(\d+)\])?\}(?!\})")


def numbers_of(theorem, statement):
    """The numbers in a statement: (name, place in a list or None, number). Refuses another text."""
    text, names, pattern, at = STATEMENTS[theorem]["text"], [], "", 0
    for place in PLACE.finditer(text):
        pattern += re.escape(plain(text[at : place.start()])) + r"([-+0-9.e]+)"
        names.append((place[1], place[2] and int(place[2])))
        at = place.end()
    match = re.fullmatch(pattern + re.escape(plain(text[at:])), statement) if isinstance(statement, str) else None
    if match is None:
        raise Refuted(f"line 1: the statement is not that of {theorem}")
    try:
        return [(name, index, float(number)) for (name, index), number in zip(names, match.groups())]
    except ValueError:
        raise Refuted("line 1: the statement has no number where one belongs")


def plain(text):
    return text.replace("{{", "{").replace("}}", "}")


def compare(header, derived):
    """The scope that a file fills. `derived` is what it proves."""
    theorem = header["theorem"]
    for name, index, stated in numbers_of(theorem, header.get("statement")):
        if name == "stated_mass_ratio":
            # It is printed with fewer digits, rounded down.
            if not stated <= derived["largest_mass_ratio"] <= stated + 1e-14:
                raise Refuted(
                    f"line 1: the statement says M <= {stated!r}, and the lines prove M <="
                    f" {derived['largest_mass_ratio']!r}"
                )
            continue
        proved = derived[name] if index is None else derived[name][index]
        if stated != proved:
            raise Refuted(f"line 1: the statement says {stated!r}, and the lines prove {proved!r} ({name})")
    misses = []
    for scope in STATEMENTS[theorem]["scopes"]:
        missed = [
            text for name, bound in scope.items() if name != "scope" for text in short_of(name, bound, derived[name])
        ]
        if not missed:
            return scope["scope"]
        misses.append(f"{scope['scope']}: {missed[0]}")
    raise Refuted(f"the lines prove less than every statement of {theorem} ({'; '.join(misses)})")


def short_of(name, bound, proved):
    """Why a number, or a list of numbers, falls short of a bound."""
    ((relation, wanted),) = bound.items()
    if isinstance(wanted, list):
        if not isinstance(proved, (list, tuple)) or len(proved) != len(wanted):
            yield f"{name} is {proved!r}, not {wanted!r}"
            return
        pairs = list(zip(proved, wanted))
    else:
        pairs = [(proved, wanted)]
    holds = {
        "is": lambda own, other: own == other,
        "least": lambda own, other: own >= other,
        "most": lambda own, other: own <= other,
    }
    if not all(holds[relation](own, other) for own, other in pairs):
        yield f"{name} is {proved!r}, and should be {'' if relation == 'is' else 'at ' + relation + ' '}{wanted!r}"


def sentence(derived):
    """What is proved, as the numbers that a reader needs."""
    return ", ".join(f"{name.replace('_', ' ')} {shown(value)}" for name, value in derived.items())


def shown(value):
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(shown, value))}]" if len(value) <= 12 else f"{len(value)} of them"
    return repr(value)
