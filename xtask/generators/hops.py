"""Hops and losses: the files hops_*.jsonl and losses_*.jsonl.

The inputs (mass ratio, speed or offset) and the choice of fields are those of the committed line. Each result is
computed anew. A line that has no slopes lies where the branch of the map changes within the next digits.
"""

from mpmath import mpf, nstr

from hop import Hop, alpha_star, confirmed, scientific, text

# A line lists the flights of one hop up to this count.
LISTED_FLIGHTS = 32
# Slopes are for comparison with f64 and have the digits of one.
SLOPE_DIGITS = 17


def hop(record):
    """A line of hops_{random,window,extreme,boundaries}.jsonl."""

    def make():
        slopes = "dalpha_next_dalpha" in record
        found = Hop(record["mass_ratio"], mpf(record["alpha"]), slopes=slopes)
        made = dict(record)
        made["sudden"] = found.sudden
        made["flight_times"] = [text(t) for t in found.times[:LISTED_FLIGHTS]]
        made["stretch_at_impact"] = [text(s) for s in found.stretches[:LISTED_FLIGHTS]]
        made["energy_radicand"] = text(found.radicand)
        made["alpha_next"] = text(found.next)
        if slopes:
            made["dalpha_next_dalpha"] = text(found.slopes[0], SLOPE_DIGITS)
            made["dalpha_next_dM"] = text(found.slopes[1], SLOPE_DIGITS)
        return made

    return confirmed(make, record["alpha"])


def near_fixed_point(record):
    """A line of hops_near_fixed_point.jsonl."""

    def make():
        star = alpha_star(record["n"])
        found = Hop(record["mass_ratio"], star + mpf(record["offset"]))
        made = dict(record)
        made["sudden"] = found.sudden
        made["offset_next"] = text(found.next - star)
        made["flight_time_minus_2alpha_star"] = text(found.times[0] - 2 * star)
        made["alpha_next"] = text(found.next)
        return made

    return confirmed(make, record["offset"])


def hard_offset(record):
    """A line of hops_hard_offsets.jsonl; zeros at the end are dropped."""

    def make():
        star = alpha_star(record["n"])
        found = Hop(record["mass_ratio"], star + mpf(record["offset"]))
        made = dict(record)
        made["sudden"] = found.sudden
        made["offset_next"] = None if found.next is None else nstr(found.next - star, 40)
        return made

    return confirmed(make, record["offset"])


def hard_verdict(record):
    """A line of hops_hard_verdicts.jsonl. The chain of 7829 sudden lift-offs is given to 17 digits."""
    digits = 17 if record["mass_ratio"] == 100000.0 else 40

    def make():
        found = Hop(record["mass_ratio"], mpf(record["alpha"]))
        made = dict(record)
        made["sudden"], made["alpha_next"] = found.sudden, text(found.next, digits)
        return made

    return confirmed(make, record["alpha"])


def tiny_loss(record):
    """A line of losses_tiny.jsonl."""

    def make():
        found = Hop(record["mass_ratio"], mpf(record["alpha"]))
        return dict(record, loss=scientific(found.loss))

    return confirmed(make, record["alpha"])


def loss_near_fixed_point(record):
    """A line of losses_near_first_fixed_point.jsonl.

    `loss` belongs to `alpha`, the f64 nearest to alpha_star + offset. It stands only where `alpha` lies on the
    same side of alpha_star as the exact place.
    """

    def make():
        star = alpha_star(record["n"])
        found = Hop(record["mass_ratio"], star + mpf(record["offset"]))
        made = dict(record)
        made["offset_loss"], made["sudden"] = scientific(found.loss), found.sudden
        made["alpha"] = float(star + mpf(record["offset"]))
        offset = mpf(made["alpha"]) - star
        if (offset > 0) == (record["offset"] > 0):
            made["loss"] = scientific(Hop(record["mass_ratio"], mpf(made["alpha"])).loss)
            made["alpha_offset"] = scientific(offset)
        return made

    return confirmed(make, record["offset"])


def orbit(record):
    """A line of orbits.jsonl: the offset from alpha_star after a count of hops."""

    def make():
        star = alpha_star(record["n"])
        alpha = star + mpf(record["offset"])
        for _ in range(record["hops"]):
            alpha = Hop(record["mass_ratio"], alpha).next
        return dict(record, offset_after=scientific(alpha - star))

    return confirmed(make, record["offset"])


def fixed_point(record):
    """An entry of fixed_points.json: 50 digits."""
    return confirmed(lambda: dict(record, alpha_star=text(alpha_star(record["n"]), 50)))
