"""The share of each basin among the starts between α*₁ and α*₄, along the mass ratio, between bounds."""

import matplotlib.pyplot as plt
import numpy as np
import passive_hopper as hopper

ratios = np.linspace(0.1, 0.5, 33)
all_basins = [hopper.interval_basins(ratio, last=4, undecided=1e-3) for ratio in ratios]
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
for n in range(1, 5):
    bounds = [basins.fraction(n) for basins in all_basins]
    lower, upper = [own.lower for own in bounds], [own.upper for own in bounds]
    colour = hopper.label_colour(n)
    axes.fill_between(ratios, lower, upper, color=colour, edgecolor=colour, label=hopper.label_name(n))
axes.set(xlabel="mass ratio M", ylabel="share of the basin", yscale="log")
axes.legend(frameon=False, fontsize=8)
figure.savefig("basin_fractions.png", dpi=160)
