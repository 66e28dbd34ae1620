"""A pressure relief valve whose disc chatters on its seat (Hős, Champneys)."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from nonsmooth.hybrid import Guard, HybridSystem

damping, load, filling, restitution, flow_rate = 1.25, 10, 20, 0.8, 0.3


def field(mode: str, y: Any) -> Any:
    if mode == "closed":
        return [0, 0, filling * flow_rate]
    return [y[1], y[2] - load - y[0] - damping * y[1], filling * (flow_rate - y[0] * np.sqrt(y[2]))]


bounce = lambda mode, y: (mode, [0, -restitution * y[1], y[2]])
let_go = lambda mode, y: ("open", [0, 0, load])
rest = lambda mode, y: ("closed", [0, 0, y[2]]) if y[2] < load else None
seat = Guard("seat", lambda y: y[0], "falling", role="contact", modes=["open"], reset=bounce)
release = Guard("release", lambda y: y[2] - load, "rising", modes=["closed"], reset=let_go)
valve = HybridSystem(field=field, guards=[seat, release], rest=rest)
found = valve.run([0.2, 0, load], mode="open", time=60).trajectory(np.linspace(40, 60, 4000))
late = found["times"] >= 40
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(found["times"][late], found["states"][late, 0], color="#10386e", linewidth=0.9)
axes.set(xlabel="time", ylabel="displacement of the disc", title=f"{len(found['event_times'])} impacts up to time 60")
figure.savefig("valve.png", dpi=160)
