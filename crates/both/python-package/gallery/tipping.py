"""Tipping: the share of the basin of α*₁ whose hoppers end elsewhere after the mass ratio has changed at once from 0.2."""

import matplotlib.pyplot as plt
import numpy as np
import passive_hopper as hopper

before = hopper.interval_basins(0.2, last=3, undecided=1e-4)
ratios = np.linspace(0.1, 0.3, 21)
lower, upper = [], []
for ratio in ratios:
    stays = before.tipping_to(hopper.interval_basins(ratio, last=3, undecided=1e-4)).get((1, 1))
    lower.append(1 - (stays.upper if stays else 0))
    upper.append(1 - (stays.lower if stays else 0))
figure, axes = plt.subplots(figsize=(4.5, 3), layout="constrained")
axes.fill_between(ratios, lower, upper, color="#10386e", linewidth=1, edgecolor="#10386e")
axes.set(xlabel="mass ratio after the change", ylabel="probability to leave the basin of $α^*_1$", ylim=(0, 1), xticks=np.linspace(0.1, 0.3, 5))
figure.savefig("tipping.png", dpi=160)
