"""Checks certificates of `cargo xtask prove` and of any model: python check_certificate.py [--sample N] [--seed S] FILE...

The format is that of docs/certificates.md. Every line is read, and what joins the lines is checked: their number, that
strips and boxes leave no gap, the sums of lengths and areas. Each claim (an interval, a point, a box, a trap) is then
confirmed in ball arithmetic, or with
--sample a random choice of so many claims of a file; the sentence about such a file begins with "sampled". What the
lines prove is derived from them, compared with the statement of the file and with the manifest `statements.json`, and
printed. The exit status is 0 if all is confirmed. Otherwise it is 1, and the first line that is not confirmed is named
with the reason.
"""

import argparse
import hashlib
import os
import random
import sys
import time

from flint import ctx

from any_model import check as any_model
from ball_basins import BITS
from certificate_file import Refuted, Unconfirmed, Undecided, format_of, guarded, lines_of
from claims import KINDS, wrong_field
from statements import STATEMENTS, compare, sentence
from whole_theorems import WHOLE

FORMAT, VERSION = "passive hopper certificate", 2


def read_header(lines):
    _, header = next(lines, (1, {}))
    if header.get("format") != FORMAT or header.get("version") != VERSION:
        raise Refuted(f"line 1: no certificate of version {VERSION}")
    if not isinstance(header.get("theorem"), str) or header["theorem"] not in WHOLE:
        raise Refuted(f"line 1: no theorem {header.get('theorem')!r}")
    return header


def check(path, sample, seed, found=None):
    """A sentence about the file. Raises an error for the first line that is not confirmed.

    `sample` is the number of claims to confirm, or a list of their places, or None for all. What the file proves goes
    into `found`.
    """
    digests = [hashlib.sha256(), hashlib.sha256()]
    lines = lines_of(path, digests[0], wrong_field)
    header = read_header(lines)
    whole = WHOLE[header["theorem"]]()
    counts = []
    for number, line in lines:
        if line.get("kind") not in whole.KINDS:
            raise Refuted(f"line {number}: no line of kind {line.get('kind')!r} belongs to {header['theorem']}")
        kind = KINDS[line["kind"]]
        guarded(number, whole.add, line)
        counts.append(guarded(number, kind.count, line))
    if len(counts) != header.get("lines"):
        raise Refuted(
            f"line {len(counts) + 1}: {len(counts)} lines follow the header, which says {header.get('lines')}"
        )
    guarded(len(counts) + 1, whole.end)
    derived = guarded(len(counts) + 1, whole.derived)
    scope = guarded(1, compare, header, derived)
    if found is not None:
        found.update(derived)
    total, all_below = sum(counts), True
    if header["theorem"] == "everything-hops":
        all_below = guarded(1, rest_on_rising, path, derived, sample if not isinstance(sample, list) else 0, seed)
    if sample is None or isinstance(sample, list):
        chosen = sample
    else:
        # A claim of some theorems takes a second.
        sample = min(sample, STATEMENTS[header["theorem"]].get("most_sampled", sample))
        chosen = None if sample >= total else sorted(random.Random(seed).sample(range(total), sample))
    confirmed, before, shared = 0, 0, {}
    lines = lines_of(path, digests[1], wrong_field)
    next(lines)
    at = 0
    for (number, line), count in zip(lines, counts):
        if chosen is None:
            wanted = range(count)
        else:
            first = at
            while at < len(chosen) and chosen[at] < before + count:
                at += 1
            wanted = [choice - before for choice in chosen[first:at]]
        before += count
        # A line may prepare what those after it need.
        guarded(number, KINDS[line["kind"]].confirm, line, wanted, shared)
        confirmed += len(wanted)
    if digests[0].digest() != digests[1].digest():
        raise Refuted("the file changed while it was read")
    if found is not None:
        found["is_complete"] = confirmed == total
    word = "confirmed" if confirmed == total and all_below else "sampled"
    proved = f"{confirmed} of {total} claims; proves: {sentence(derived)}; {whole.means}"
    return f"{word:9} {header['theorem']} ({scope}): {proved}; sha256 {digests[0].hexdigest()}"


# Certificates that others rest on, which are looked at once: path and time of writing, to what they prove.
RISING = {}


def rest_on_rising(path, derived, sample, seed):
    """The windows of `everything-hops` rise by the theorem `rising`, whose certificate lies beside it: whether all its
    claims are confirmed."""
    beside = os.path.join(os.path.dirname(os.path.abspath(path)), "rising.jsonl")
    if not os.path.exists(beside):
        raise Refuted(f"it rests on the certificate of `rising`, and {beside} is not there")
    key = (os.path.realpath(beside), os.stat(beside).st_mtime_ns, sample, seed)
    if key not in RISING:
        found = {}
        check(beside, sample, seed, found)
        RISING[key] = found
    rising = dict(zip(RISING[key]["windows"], RISING[key]["largest_mass_ratios"]))
    for n in range(2, derived["loss_bound"]):
        if rising.get(n, 0) < derived["crisis"][1]:
            raise Refuted(f"`rising` does not show that window {n} rises for M <= {derived['crisis'][1]!r}")
    return RISING[key]["is_complete"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--sample", type=int, metavar="N", help="confirm so many random claims of each file [default: all]"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of the random choice [default: 1]")
    parser.add_argument("files", nargs="+", metavar="FILE")
    options = parser.parse_args()
    ctx.prec = BITS
    failed = False
    for path in options.files:
        begin = time.time()
        try:
            own = any_model.check if format_of(path) == any_model.FORMAT else check
            print(f"{own(path, options.sample, options.seed)}; {time.time() - begin:.1f} s", flush=True)
        except (Refuted, Unconfirmed, Undecided) as error:
            word = "refuted" if isinstance(error, Refuted) else "not confirmed"
            print(f"{word:9} {path}, {error}", flush=True)
            failed = True
        except OSError as error:
            print(f"unreadable {path}: {error}", flush=True)
            failed = True
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
