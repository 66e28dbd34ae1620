"""What each basin has at least of the gaps between intervals of one fate, confirmed by the fates of parts of them.

The prover has the lengths from the slope of F (docs/theory.md, Theorem 96). Here a gap is halved, the widest part
first, until parts of each fate are as long as is said. A part has a fate if its images end in an interval of that fate,
or on the ground.
"""

import heapq

from flint import arb

from ball_basins import GROUNDED, Refuted, Unconfirmed
from ball_hops import Undecided

# Most parts of a gap, and hops of a part. Images that lie in a lower gap are followed.
MOST_PARTS, MOST_HOPS = 4000, 200


def fate_of_part(basins, low, high):
    """The fate of all speeds between two; None if it is open."""
    for _ in range(MOST_HOPS):
        try:
            least, most = basins.square_bounds(low, high, basins.kappas)
        except Undecided:
            return None
        if most < 0:
            return GROUNDED
        if not least > 0:
            return None
        # No hop ends above its speed (Theorem 4).
        low, high = least.sqrt().lower(), min(most.sqrt().upper(), high)
        fate = basins.holder(low, high)
        if fate is not None:
            return fate
    return None


def confirm_gap(basins, gap):
    """The lengths that a gap is said to have."""
    left, right, wanted = gap
    known = {fate: arb(0) for fate in wanted}
    whole, found = arb(right) - arb(left), arb(0)
    # Ends of parts are exact: they have some bits more than an f64.
    work = [(left - right, left, arb(left), arb(right))]
    for _ in range(MOST_PARTS):
        if all(known[fate] >= least for fate, least in wanted.items()):
            return
        if not work:
            break
        _, _, low, high = heapq.heappop(work)
        fate = fate_of_part(basins, low, high)
        length = high - low
        if fate is not None:
            known[fate] = known.get(fate, arb(0)) + length
            found += length
            for other, least in wanted.items():
                if whole - (found - known[other]) < least:
                    raise Refuted(f"{other!r} has less than {float(least)!r} of the gap [{left!r}, {right!r}]")
        else:
            middle = ((low + high) / 2).mid()
            for part in ((low, middle), (middle, high)):
                heapq.heappush(work, (-0.5 * float(length), float(part[0]), *part))
    raise Unconfirmed(f"the lengths of the gap [{left!r}, {right!r}]")
