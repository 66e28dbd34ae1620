"""A runner on a spring leg (SLIP): the map from apex to apex, and an orbit that comes to its stable run."""

import matplotlib.pyplot as plt
import nonsmooth as ns
import numpy as np

FORCE = "stiffness/mass*(leg/sqrt(x^2 + height^2) - 1)"
HEIGHT = "height - leg*sin(attack*pi/180)"
runner = ns.System(
    {"flight": lambda t, x, p: [x[2], x[3], 0, -9.81], "stance": ["speed", "climb", f"{FORCE}*x", f"{FORCE}*height - 9.81"]},
    states="x height speed climb",
    parameters={"attack": 68, "mass": 80, "stiffness": 2e4, "leg": 1},
    guards=[
        ns.Guard("touchdown", HEIGHT, "falling", ["-leg*cos(attack*pi/180)", "height", "speed", "climb"], "stance", ["flight"], role="crossing"),
        ns.Guard("apex", lambda t, x, p: x[3], "falling", modes=["flight"]),
        ns.Guard("take-off", lambda t, x, p: np.sqrt(x[0] ** 2 + x[1] ** 2) - p.leg, "rising", None, "flight", ["stance"], role="crossing"),
    ],
)
apexes = runner.returns("apex", coordinates="h", start=lambda t, q, p: [0, q[0], np.sqrt(25 + 2 * 9.81 * (1 - q[0])), 0], image=["height"], mode="flight")
ns.plots.plot_cobweb(apexes, 0.99, (0.928, 1.1), images=30).set(xlabel="apex height, m", ylabel="next apex height, m")
plt.savefig("spring_leg.png", dpi=160, bbox_inches="tight")
