"""The basins of the incessant hops over mass ratio and lift-off speed."""

import passive_hopper as hopper

axes = hopper.plot_basins(shape=(640, 400))
axes.figure.savefig("basins.png", dpi=80)
