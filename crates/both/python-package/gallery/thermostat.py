"""A thermostat: two modes, each with a guard at which the other one begins."""

import matplotlib.pyplot as plt
import numpy as np
from nonsmooth.hybrid import Guard, HybridSystem

room = HybridSystem(
    field=lambda heater, x: [30 - x[0]] if heater == "on" else [10 - x[0]],
    guards=[
        Guard("warm", lambda x: x[0] - 21, "rising", modes=["on"], reset=lambda heater, x: ("off", x)),
        Guard("cold", lambda x: x[0] - 19, "falling", modes=["off"], reset=lambda heater, x: ("on", x)),
    ],
)
found = room.run([15], mode="on", time=3).trajectory(np.linspace(0, 3, 300))
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(found["times"], found["states"][:, 0], color="#10386e")
axes.plot(found["event_times"], found["event_before"][:, 0], ".", color="#d55e00")
axes.set(xlabel="time", ylabel="temperature")
figure.savefig("thermostat.png", dpi=160)
