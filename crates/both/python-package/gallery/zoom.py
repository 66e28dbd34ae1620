"""Three windows into the basins about one point, each a twentieth of the one before."""

import matplotlib.pyplot as plt
import passive_hopper as hopper

ratio, speed = 0.2, hopper.trap(2, 0.2).right
figure, frames = plt.subplots(1, 3, figsize=(9, 3), layout="constrained")
for k, axes in enumerate(frames):
    width, height = 0.1 / 20**k, 1.0 / 20**k
    hopper.plot_basins(
        M=(ratio - width / 2, ratio + width / 2),
        alpha=(speed - height / 2, speed + height / 2),
        shape=(300, 300),
        ax=axes,
        legend=False,
    )
    axes.ticklabel_format(useOffset=False)
    axes.tick_params(labelsize=6)
figure.savefig("zoom.png", dpi=160)
