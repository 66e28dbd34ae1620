"""A DC-DC buck converter: a switch that a ramp controls, at an input of 25 V, behind a period doubling."""

import matplotlib.pyplot as plt
import nonsmooth as ns
import numpy as np

R, C, L, T = 22.0, 47e-6, 20e-3, 400e-6


def above_ramp(t, x, p):
    return 8.4 * (x[0] - 11.3) - 3.8 - 4.4 * x[2]


converter = ns.System(
    {
        "on": lambda t, x, p: [(x[1] - x[0] / R) / C, (p.input - x[0]) / L, 1 / T],
        "off": lambda t, x, p: [(x[1] - x[0] / R) / C, -x[0] / L, 1 / T],
    },
    states="voltage current phase", parameters={"input": 25.0},
    guards=[
        ns.Guard("off", above_ramp, "rising", to="off", modes=["on"], role="contact"),
        ns.Guard("on", above_ramp, "falling", to="on", modes=["off"], role="contact"),
        ns.Guard("period", lambda t, x, p: x[2] - 1, "rising", lambda t, x, p: [x[0], x[1], 0]),
    ],
)
run = converter.run([12, 0.55, 0], time=(0, 240 * T), mode="off", t=np.linspace(200 * T, 240 * T, 8001))
figure, axes = plt.subplots(figsize=(5, 3), layout="constrained")
axes.plot(*run.y[:2], linewidth=0.8)
axes.set(xlabel="voltage, V", ylabel="current, A")
figure.savefig("buck_converter.png", dpi=80)
