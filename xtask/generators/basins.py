"""Fates, crises and local basins: fates.jsonl, critical.json, local_basin.json."""

from mpmath import cbrt, floor, mp, mpf, sin

from contact import smaller_mass_ratio, star, touch, trap_edge
from hop import Hop, alpha_star, confirmed, text

# Above this mass ratio dips of the map are narrower than f64 can see (docs/model.md).
NEEDLES = 30
# Up to this mass ratio a hop has at most one sudden lift-off, so a scan misses no dip.
ONE_SUDDEN = mpf("0.9056")
# Places of a scan over a sudden interval.
SCAN = 400

_edges = {}


def edge(n, mass_ratio):
    key = (n, mass_ratio, mp.prec)
    if key not in _edges:
        _edges[key] = trap_edge(n, mass_ratio)
    return _edges[key]


def cell(alpha):
    """The n with alpha*_n <= alpha < alpha*_{n+1}."""
    n = int(floor(alpha / mp.pi))
    return n if n == 0 or alpha >= alpha_star(n) else n - 1


def fate(record):
    """A line of fates.jsonl: the orbit is followed until it enters a trap on a contact interval, or ends."""

    def make():
        alpha = mpf(record["alpha"])
        made = {"mass_ratio": record["mass_ratio"], "alpha": record["alpha"]}
        while True:
            n = cell(alpha)
            if alpha < (n + 1) * mp.pi:
                end = edge(n, record["mass_ratio"])
                if end is None or alpha <= end:
                    made["fate"] = "incessant" if n else "decaying"
                    if n:
                        made["n"] = n
                    return made
            alpha = Hop(record["mass_ratio"], alpha).next
            if alpha is None:
                made["fate"] = "grounded"
                return made

    return confirmed(make)


def crisis(record):
    """An entry of critical.json."""

    def make():
        mu, alpha = touch(record["n"])
        return dict(
            record,
            mu_c=text(mu, 30),
            M_c=text(smaller_mass_ratio(mu), 30),
            alpha_touch=text(alpha, 18),
            M_grounding=text(smaller_mass_ratio(touch(record["n"], of_ground=True)[0]), 30),
        )

    return confirmed(make)


def sudden_edge(n, m):
    """The first place of a scan over ((n+1) pi, alpha*_{n+1}) where the map is below alpha*_n, refined; or None."""
    left, right = (n + 1) * mp.pi, alpha_star(n + 1)
    floor_ = alpha_star(n)

    def below(alpha):
        following = Hop(m, alpha).next
        return following is None or following < floor_

    width = (right - left) / SCAN
    for k in range(1, SCAN):
        place = left + k * width
        if below(place):
            low = place - width
            while place - low > mpf(10) ** -25:
                middle = (low + place) / 2
                low, place = (low, middle) if below(middle) else (middle, place)
            return place
    return None


def local_basin(record):
    """An entry of local_basin.json. The mass ratio is the decimal that stands there."""

    def make():
        n, m = record["n"], mpf(record["mass_ratio"])
        alpha, mu = alpha_star(n), m / (1 + m) ** 2
        part = 2 * alpha - sin(2 * alpha)
        beta = cbrt(6 * part / alpha)
        printed = beta * mu * part
        corrected = printed * 3 / 4
        made = dict(
            record,
            beta=text(beta),
            lambda_corrected=text(corrected),
            lambda_printed=text(printed),
            delta_corrected=text(corrected**-3),
            delta_printed=text(printed**-3),
        )
        end = trap_edge(n, m)
        if end is not None:
            made["delta_exact"], made["edge"] = text(end - alpha), "contact: the only crossing, proved"
            return made
        made["delta_exact"] = None
        if m > NEEDLES:
            made["edge"] = "not decided: needles narrower than f64 can see"
            return made
        with mp.workdps(40):
            end = sudden_edge(n, m)
        if end is not None:
            # 14 digits: the scan has a width, and the place comes from bisection.
            made["delta_exact"] = text(end - alpha, 14)
            made["edge"] = "sudden: from dense scans, not proved"
        elif m <= ONE_SUDDEN:
            made["edge"] = "none: the whole interval up to the next fixed point is the trap"
        return made

    return confirmed(make)
