"""A pendulum over three magnets: where it comes to rest, for each place at which it is let go."""

from typing import Any

import matplotlib.pyplot as plt
import nonsmooth as ns
import numpy as np

ANGLES = 2 * np.pi * np.arange(3) / 3


def field(t: Any, x: Any, p: Any) -> list[Any]:
    ax, ay = -0.5 * x[0] - p.friction * x[2], -0.5 * x[1] - p.friction * x[3]
    for u, v in zip(np.cos(ANGLES), np.sin(ANGLES)):
        near = ((u - x[0]) ** 2 + (v - x[1]) ** 2 + 0.09) ** 1.5
        ax, ay = ax + (u - x[0]) / near, ay + (v - x[1]) / near
    return [x[2], x[3], ax, ay]


pendulum = ns.System(field, states="x y vx vy", parameters={"friction": 0.2}, tolerance=1e-7)
magnets = [[np.cos(angle), np.sin(angle), 0, 0] for angle in ANGLES]
region = {"x": (-2, 2), "y": (-2, 2), "vx": (-3, 3), "vy": (-3, 3)}
found = ns.attractors_of(pendulum, region, step=1.0, starts=magnets, cells=30, locate=50, tests=50)
basins = ns.basins_of(pendulum, {"x": (-2, 2), "y": (-2, 2)}, (120, 120), step=1.0, others={"vx": 0, "vy": 0}, attractors=found)
figure, axes = plt.subplots(figsize=(5, 4), layout="constrained")
ns.plots.plot_basins(basins, axes)
figure.savefig("magnetic_pendulum.png", dpi=160)
