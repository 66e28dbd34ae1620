"""What certificates of known names must prove at least: `known.json`, with their equations and maps."""

import json
import os

from certificate_file import Refuted

from .boxes import covers

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "known.json"), encoding="utf-8") as file:
    KNOWN = json.load(file)


def check_known(name, lines, derived):
    """Refuses a file of a known name about other equations or maps, or one that proves less. `lines` are those of systems and maps."""
    if name not in KNOWN:
        return "a name of one's own"
    wanted = KNOWN[name]
    for kind in ("system", "map"):
        own = [{key: value for key, value in line.items() if key != "kind"} for line in lines if line["kind"] == kind]
        if own != wanted[kind + "s"]:
            raise Refuted(f"line 1: {name} has other {kind}s")
    left = list(derived)
    for least in wanted["proves"]:
        found = [claim for claim in left if meets(claim, least)]
        if not found:
            raise Refuted(f"line 1: {name} should prove {least}, and does not")
        left.remove(found[0])
    for within in wanted.get("for_all", []):
        # The intervals of parameters of all claims of this kind, together.
        known = [claim["parameters"] for claim in derived if claim.get("parameters") and meets(claim, within["claim"])]
        if not covers(known, within["parameters"]):
            raise Refuted(f"line 1: {name} should prove {within}, and does not")
    return "as it should"


def meets(claim, least):
    """True if a claim is at least what is wanted."""
    for key, wanted in least.items():
        own = claim.get(key)
        if isinstance(wanted, dict):
            if own is None or not wanted.get("least", own) <= own <= wanted.get("most", own):
                return False
        elif key in ("box_holds", "box_in") and len(claim["box"]) != len(wanted):
            return False
        elif key == "box_holds":
            if not all(low <= a and b <= high for (low, high), (a, b) in zip(claim["box"], wanted)):
                return False
        elif key == "box_in":
            if not all(a <= low and high <= b for (low, high), (a, b) in zip(claim["box"], wanted)):
                return False
        elif own != wanted:
            return False
    return True
