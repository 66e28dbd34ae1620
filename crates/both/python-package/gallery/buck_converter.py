"""A DC-DC buck converter: a switch that a ramp controls, at an input of 25 V, behind a period doubling."""

import matplotlib.pyplot as plt
import nonsmooth as ns
import numpy as np

T = 400e-6
CHARGE, ABOVE_RAMP = "(current - voltage/22)/47e-6", "8.4*(voltage - 11.3) - 3.8 - 4.4*phase"
converter = ns.System(
    {
        "on": [CHARGE, "(input - voltage)/20e-3", "1/400e-6"],
        "off": [CHARGE, "-voltage/20e-3", "1/400e-6"],
    },
    states="voltage current phase",
    parameters={"input": 25.0},
    guards=[
        ns.Guard("off", ABOVE_RAMP, "rising", to="off", modes=["on"], role="contact"),
        ns.Guard("on", ABOVE_RAMP, "falling", to="on", modes=["off"], role="contact"),
        ns.Guard("period", "phase - 1", "rising", ["voltage", "current", "0"]),
    ],
)
run = converter.run([12, 0.55, 0], time=(0, 240 * T), mode="off", t=np.linspace(200 * T, 240 * T, 8001))
figure, axes = plt.subplots(figsize=(5, 3), layout="constrained")
axes.plot(*run.y[:2], linewidth=0.8)
axes.set(xlabel="voltage, V", ylabel="current, A")
figure.savefig("buck_converter.png", dpi=160)
