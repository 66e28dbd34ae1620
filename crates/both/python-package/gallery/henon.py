"""Hénon's map: the points whose orbits stay, and those that escape."""

import matplotlib.pyplot as plt
import nonsmooth as ns

henon = ns.map_steps(lambda t, x, p: [1 - p.a * x[0] ** 2 + x[1], p.b * x[0]], states="x y", parameters={"a": 1.4, "b": 0.3})
window = {"x": (-2, 2), "y": (-2, 2)}
basins = ns.basins_of(henon, window, (400, 400), escape=100, starts=20, names={1: "stays"})
figure, axes = plt.subplots(figsize=(5, 3.4), layout="constrained")
ns.plots.plot_basins(basins, axes)
figure.savefig("henon.png", dpi=160)
