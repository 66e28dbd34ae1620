"""The basins of the incessant hops over mass ratio and lift-off speed."""

import matplotlib.pyplot as plt
import passive_hopper as hopper

hopper.plot_basins(shape=(640, 400))
plt.savefig("basins.png", dpi=160)
