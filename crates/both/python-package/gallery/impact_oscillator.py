"""An impact oscillator through grazing: it chatters, rests at its stop until the force turns, and grazes. Its velocity at each period, over the gap."""

from typing import Any

import matplotlib.pyplot as plt
import nonsmooth as ns
import numpy as np


def force(t: Any, x: Any, p: Any) -> Any:
    return -x[0] - 0.2 * x[1] + np.cos(2.7 * t)


oscillator = ns.System(
    {"free": lambda t, x, p: [x[1], force(t, x, p)], "at the stop": lambda t, x, p: [0, 0]},
    states="x v",
    parameters={"gap": 0.2},
    guards=[
        ns.Guard("stop", lambda t, x, p: x[0] - p.gap, "rising", lambda t, x, p: [x[0], -0.7 * x[1]], modes=["free"]),
        ns.Guard("release", force, "falling", to="free", modes=["at the stop"]),
        ns.Clock("period", 2 * np.pi / 2.7),
    ],
    rests={"free": ("at the stop", lambda t, x, p: [p.gap, 0])},
)
strobe = oscillator.returns("period", coordinates="x v", mode="free")
diagram = strobe.diagram(np.linspace(0.1, 0.17, 240), [[-0.1, 0.0]], transient=150, keep=40, carried=True)
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
ns.plots.plot_diagram(diagram, coordinate=1, ax=axes).set(xlabel="gap", ylabel="velocity at each period")
axes.set_title(f"{240 - len(diagram.failed)} of 240 orbits computed", fontsize=9)
figure.savefig("impact_oscillator.png", dpi=160)
