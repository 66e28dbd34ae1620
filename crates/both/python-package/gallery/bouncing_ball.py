"""A bouncing ball: infinitely many bounces in finite time, and rest after them (Zeno)."""

import matplotlib.pyplot as plt
import numpy as np
from nonsmooth.hybrid import Guard, HybridSystem, QuasiPolynomial

restitution = 0.8
floor = Guard(
    "floor",
    lambda x: x[0],
    "falling",
    modes=["air"],
    reset=lambda mode, x: (mode, [0, -restitution * x[1]]),
    signal=lambda mode, x: QuasiPolynomial.polynomial([x[0], x[1], -0.5]),
)
ball = HybridSystem(
    flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t] if mode == "air" else [0, 0],
    guards=[floor],
    rest=lambda mode, x: ("rest", [0, 0]),
)
zeno = next(arc.zeno for arc in ball.run([0.5, 0], mode="air", time=12) if arc.zeno)
found = ball.run([0.5, 0], mode="air", time=12).trajectory(np.linspace(0, 12, 2000))
figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
axes.plot(found["times"], found["states"][:, 0], color="#10386e", linewidth=0.9)
axes.axvline(zeno.time, color="#d55e00", linewidth=0.8)
axes.set(
    xlabel="time", ylabel="height", title=f"{len(found['event_times'])} bounces followed; their limit is at {zeno.time:.12f}"
)
figure.savefig("bouncing_ball.png", dpi=160)
